//! `signals.parquet`: taxel values beside the table of labels, with one FLOAT column for each value of a sample.

mod read;
mod spec;
#[cfg(test)]
mod tests;
mod write;

pub use read::SignalsReader;
pub(crate) use spec::WrittenSignals;
pub use spec::{SignalsInfo, SignalsSpec};
pub use write::SignalsWriter;

/// Number of values in a row group, for any number of taxels. They take 4 MiB.
const GROUP_VALUES: usize = 1 << 20;

/// Number of rows in a row group, for samples of `length` values.
fn rows_of_group(length: usize) -> usize {
    (GROUP_VALUES / length.max(1)).max(1)
}
