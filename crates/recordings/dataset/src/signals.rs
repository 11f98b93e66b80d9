//! `signals.parquet`: the numbers of taxels, one FLOAT column for each number of a sample, beside the table of labels.

mod read;
mod spec;
#[cfg(test)]
mod tests;
mod write;

pub use read::SignalsReader;
pub(crate) use spec::WrittenSignals;
pub use spec::{SignalsInfo, SignalsSpec};
pub use write::SignalsWriter;

/// Number of values of a row group: 4 MiB, whatever the number of taxels.
const GROUP_VALUES: usize = 1 << 20;

/// Number of rows of a row group of samples of `length` values.
fn rows_of_group(length: usize) -> usize {
    (GROUP_VALUES / length.max(1)).max(1)
}
