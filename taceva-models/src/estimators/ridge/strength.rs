//! Candidate strengths of ridge regression.

/// Candidate strengths from 10⁻⁶ to 10⁴, four per decade. The weakest is negligible. With the strongest, the model predicts nearly the mean.
pub(super) fn grid() -> Vec<f64> {
    (-24..=16)
        .map(|quarter| 10_f64.powf(f64::from(quarter) / 4.0))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strengths_grow_from_a_millionth_to_ten_thousand() {
        let grid = grid();
        assert_eq!(grid.len(), 41);
        assert!(grid.windows(2).all(|pair| pair[0] < pair[1]));
        assert!((grid[0] - 1e-6).abs() < 1e-20 && (grid[40] - 1e4).abs() < 1e-9);
    }
}
