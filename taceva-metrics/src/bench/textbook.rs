//! Scores by the formulas of common libraries, rounded at every step.

use super::compensation::{RunningSum, pairwise};
use super::scores::Scores;
use crate::pair::Paired;

/// Scores from rounded sums over `n` rows: `absolute` and `squared` residuals, `total` sum of squares of the truth, and `symmetric` terms of sMAPE.
fn finish(n: f64, absolute: f64, squared: f64, total: f64, symmetric: f64) -> Scores {
    Scores {
        mae: number(absolute / n),
        r2: number(1.0 - squared / total),
        smape: number(symmetric / n),
    }
}

pub(super) fn number(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

pub(super) fn one_pass<S: RunningSum>(pairs: Paired<&[f64]>) -> Scores {
    let [
        mut absolute,
        mut squared,
        mut truth,
        mut truth_squared,
        mut symmetric,
    ] = [S::default(); 5];
    for pair in pairs.iter() {
        let residual = pair.residual();
        absolute.add(residual.abs());
        squared.add(residual * residual);
        truth.add(pair.reference);
        truth_squared.add(pair.reference * pair.reference);
        symmetric.add(pair.symmetric_term());
    }
    let n = length(pairs);
    let total = truth_squared.total() - truth.total() * truth.total() / n;
    finish(
        n,
        absolute.total(),
        squared.total(),
        total,
        symmetric.total(),
    )
}

pub(super) fn two_pass(pairs: Paired<&[f64]>) -> Scores {
    let n = length(pairs);
    let mean = pairs.reference.iter().sum::<f64>() / n;
    let (mut absolute, mut squared, mut total, mut symmetric) = (0.0, 0.0, 0.0, 0.0);
    for pair in pairs.iter() {
        let (residual, deviation) = (pair.residual(), pair.reference - mean);
        absolute += residual.abs();
        squared += residual * residual;
        total += deviation * deviation;
        symmetric += pair.symmetric_term();
    }
    finish(n, absolute, squared, total, symmetric)
}

pub(super) fn in_halves(pairs: Paired<&[f64]>) -> Scores {
    let n = length(pairs);
    let rows: Vec<Paired<f64>> = pairs.iter().collect();
    let mean = pairwise(&rows, &|pair| pair.reference) / n;
    let square = |value: f64| value * value;
    finish(
        n,
        pairwise(&rows, &|pair| pair.residual().abs()),
        pairwise(&rows, &|pair| square(pair.residual())),
        pairwise(&rows, &|pair| square(pair.reference - mean)),
        pairwise(&rows, &|pair| pair.symmetric_term()),
    )
}

pub(super) fn welford(pairs: Paired<&[f64]>) -> Scores {
    let (mut absolute, mut squared, mut total, mut symmetric) = (0.0, 0.0, 0.0, 0.0);
    let (mut n, mut mean) = (0.0, 0.0);
    for pair in pairs.iter() {
        let residual = pair.residual();
        absolute += residual.abs();
        squared += residual * residual;
        symmetric += pair.symmetric_term();
        n += 1.0;
        let deviation = pair.reference - mean;
        mean += deviation / n;
        total += deviation * (pair.reference - mean);
    }
    finish(n, absolute, squared, total, symmetric)
}

pub(super) fn mean_error<S: RunningSum>(pairs: Paired<&[f64]>) -> Option<f64> {
    let mut absolute = S::default();
    pairs
        .iter()
        .for_each(|pair| absolute.add(pair.residual().abs()));
    number(absolute.total() / length(pairs))
}

pub(super) fn length(pairs: Paired<&[f64]>) -> f64 {
    pairs.estimate.len() as f64
}
