//! Names for single samples as clusters, for batches that do not name their samples.

use taceva_core::{Batch, Column, Labels};

use taceva_core::random::{FNV_OFFSET, fnv_1a_after};

/// Names the rows of `batch` by their values in all channels. Rows with equal values share a name, so that results depend only on the set of
/// rows.
pub(crate) fn rows_as_clusters(batch: &Batch) -> Labels {
    let channels = 0..batch.channels().len();
    let mut labels = Labels::default();
    for row in 0..batch.rows() {
        let hash = channels.clone().fold(FNV_OFFSET, |hash, channel| {
            let hash = with_value(hash, batch.truth(channel), row);
            with_value(hash, batch.prediction(channel), row)
        });
        labels.push(&format!("{hash:016x}"));
    }
    labels
}

fn with_value(hash: u64, column: &Column, row: usize) -> u64 {
    match column.get(row) {
        Some(value) => fnv_1a_after(hash, &value.to_bits().to_le_bytes()),
        None => fnv_1a_after(hash, b"absent"),
    }
}
