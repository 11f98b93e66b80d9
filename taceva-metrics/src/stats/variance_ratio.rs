//! Distribution of the ratio of two variances.

/// Standard normal score of a ratio of two variances, by Paulson's approximation of the F distribution. `above` and `below` are the degrees of
/// freedom of numerator and denominator.
pub(super) fn paulson(ratio: f64, above: f64, below: f64) -> f64 {
    let root = cube_root(ratio);
    let (a, b) = (2.0 / (9.0 * above), 2.0 / (9.0 * below));
    ((1.0 - b) * root - (1.0 - a)) / (b * root * root + a).sqrt()
}

/// Cube root by Newton's method, with the same bits on every machine. Returns 0 for negative numbers and 0.
fn cube_root(of: f64) -> f64 {
    if of <= 0.0 {
        return 0.0;
    }
    // From a start above the root, steps only decrease.
    let mut root = if of > 1.0 { of } else { 1.0 };
    loop {
        let next = (2.0 * root + of / (root * root)) / 3.0;
        if next >= root || !next.is_finite() {
            return root;
        }
        root = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cube_roots_are_those_of_the_machine() {
        for value in [1e-30_f64, 0.001, 0.5, 1.0, 8.0, 1e9, 1e200] {
            let found = cube_root(value);
            assert!(
                (found / value.cbrt() - 1.0).abs() < 1e-14,
                "{value}: {found}"
            );
        }
        assert_eq!(cube_root(0.0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn upper_ends_of_the_f_distribution_agree_with_tables() {
        // 97.5 % quantiles: F(10, 20) 2.7737, F(40, 60) 1.7440, F(5, 120) 2.6740.
        for (ratio, above, below) in [
            (2.7737, 10.0, 20.0),
            (1.7440, 40.0, 60.0),
            (2.6740, 5.0, 120.0),
        ] {
            let found = paulson(ratio, above, below);
            assert!((found - 1.959_964).abs() < 0.02, "{above} {below}: {found}");
        }
    }
}
