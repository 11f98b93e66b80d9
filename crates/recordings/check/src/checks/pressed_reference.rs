//! TAC006: a reference frame taken while the gel was pressed.

use taceva_core::Field;

use crate::count::count;
use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC006",
    name: "pressed-reference",
    looks_for: "a reference frame that resembles deep presses more than light presses",
    hint: "record the reference while nothing touches the gel; differences from a pressed reference hide the press",
    reads: Some(Field::Frame),
    find,
};

/// Minimum number of samples for a rank correlation.
const LEAST: usize = 10;
/// Rank correlation of load and picture change since the reference, below which the reference is suspect. A correct reference gives a clearly
/// positive correlation.
pub(super) const SUSPECT: f64 = -0.3;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let Some(load) = evidence.load() else {
        return Vec::new();
    };
    let rows = evidence.frames.iter().enumerate();
    let pairs: Vec<(f64, f64)> = rows
        .filter_map(|(row, facts)| Some((table.truth(load).get(row)?, facts.as_ref()?.distance?)))
        .collect();
    if pairs.len() < LEAST {
        return Vec::new();
    }
    let correlation = rank_correlation(&pairs);
    if correlation > SUSPECT {
        return Vec::new();
    }
    let name = table.channels().as_slice()[load].name();
    let message = format!(
        "frames of greater {name} are more similar to the reference frame (rank correlation {correlation:.2}, n {})",
        pairs.len()
    );
    vec![Found::overall(Severity::Warning, message)]
}

/// Spearman's rank correlation. Equal values are ranked in the order of rows.
pub(super) fn rank_correlation(pairs: &[(f64, f64)]) -> f64 {
    let ranks = |values: Vec<f64>| -> Vec<usize> {
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        let mut rank = vec![0; values.len()];
        order
            .iter()
            .enumerate()
            .for_each(|(place, &position)| rank[position] = place);
        rank
    };
    let first = ranks(pairs.iter().map(|pair| pair.0).collect());
    let second = ranks(pairs.iter().map(|pair| pair.1).collect());
    let squares: f64 = first
        .iter()
        .zip(&second)
        .map(|(a, b)| square(a.abs_diff(*b)))
        .sum();
    1.0 - 6.0 * squares / (count(pairs.len()) * (square(pairs.len()) - 1.0))
}

fn square(number: usize) -> f64 {
    count(number) * count(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_in_the_same_and_in_the_opposite_order_give_plus_and_minus_one() {
        let rising: Vec<(f64, f64)> = (0..20_i32)
            .map(|i| (f64::from(i), f64::from(i * i)))
            .collect();
        let falling: Vec<(f64, f64)> = rising.iter().map(|(a, b)| (*a, -b)).collect();
        assert!((rank_correlation(&rising) - 1.0).abs() < 1e-12);
        assert!((rank_correlation(&falling) + 1.0).abs() < 1e-12);
    }
}
