//! `signals.parquet`: taxel values in one FLOAT column per value of a sample, beside the table of labels.

mod read;
mod spec;
#[cfg(test)]
mod tests;
mod write;

pub use read::SignalsReader;
pub(crate) use spec::WrittenSignals;
pub use spec::{SignalsInfo, SignalsSpec};
pub use write::SignalsWriter;

/// Number of values in a row group: 4 MiB, for any number of taxels.
const GROUP_VALUES: usize = 1 << 20;

/// Number of rows in a row group, for samples of `length` values.
fn rows_of_group(length: usize) -> usize {
    (GROUP_VALUES / length.max(1)).max(1)
}
