//! Distances between samples. The bits are the same on every machine, and for any number of samples at a time.

use rayon::prelude::*;
use taceva_core::single;

/// Number of features summed in single precision. The sums are added in double precision.
const RUN: usize = 256;

/// Number of partial sums in single precision, so that additions do not wait for each other.
const LANES: usize = 16;

/// Sum of (a − b)² over the features of two samples of equal length.
///
/// Products and sums are never fused and have a fixed order. The result therefore has the same bits for every instruction set.
pub(crate) fn squared_distance(a: &[f32], b: &[f32]) -> f32 {
    let runs = a.chunks(RUN).zip(b.chunks(RUN));
    single(runs.map(|(a, b)| f64::from(squares(a, b))).sum())
}

fn squares(a: &[f32], b: &[f32]) -> f32 {
    let (a, last_a) = a.as_chunks::<LANES>();
    let (b, last_b) = b.as_chunks::<LANES>();
    let mut sums = [0.0_f32; LANES];
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            let difference = a - b;
            *sum += difference * difference;
        }
    }
    let last = last_a.iter().zip(last_b).map(|(a, b)| (a - b) * (a - b));
    sums.iter().sum::<f32>() + last.sum::<f32>()
}

/// Number of samples per task of a thread.
const CHUNK: usize = 256;

/// Squared distances of `sample` from every row of `rows`, computed in parallel.
pub(crate) fn from_all(sample: &[f32], rows: &[f32], into: &mut [f32]) {
    let width = sample.len();
    into.par_chunks_mut(CHUNK)
        .zip(rows.par_chunks(CHUNK * width))
        .for_each(|(into, rows)| {
            for (place, row) in into.iter_mut().zip(rows.chunks_exact(width)) {
                *place = squared_distance(sample, row);
            }
        });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_lanes_and_the_rest_make_the_whole_sum() {
        let a: Vec<f32> = (0..601_u16).map(f32::from).collect();
        let b: Vec<f32> = a.iter().map(|value| value + 2.0).collect();
        assert!((squared_distance(&a, &b) - 4.0 * 601.0).abs() < f32::EPSILON);
    }
}
