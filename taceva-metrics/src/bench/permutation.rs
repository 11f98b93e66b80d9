//! Columns with their rows shuffled.

use taceva_core::random::SplitMix64;

use crate::pair::Paired;

/// Shuffles the rows of `columns`. Equal seeds give equal orders.
pub fn shuffled(columns: &Paired<Vec<f64>>, seed: u64) -> Paired<Vec<f64>> {
    let mut rows: Vec<(f64, f64)> = columns
        .as_slices()
        .iter()
        .map(|pair| (pair.estimate, pair.reference))
        .collect();
    SplitMix64::new(seed).shuffle(&mut rows);
    let (estimate, reference) = rows.into_iter().unzip();
    Paired {
        estimate,
        reference,
    }
}
