//! Selection of samples to draw.

use taceva_core::counted;

/// Positions of the samples to draw, ascending. Draws all samples up to `most`. Otherwise, a tenth of `most` has the largest errors, so that
/// outliers are visible, and the others are evenly spaced rows.
pub(crate) fn thin(errors: &[f64], most: usize) -> Vec<usize> {
    if errors.len() <= most {
        return (0..errors.len()).collect();
    }
    let worst = most / 10;
    let even = most - worst;
    let mut by_error: Vec<usize> = (0..errors.len()).collect();
    by_error.sort_by(|a, b| errors[*b].abs().total_cmp(&errors[*a].abs()).then(a.cmp(b)));
    let mut drawn: Vec<usize> = by_error[..worst].to_vec();
    drawn.extend((0..even).map(|at| at * errors.len() / even));
    drawn.sort_unstable();
    drawn.dedup();
    drawn
}

/// Sentence that describes the selection by [`thin`], for `drawn` of `all` samples.
pub(crate) fn rule(drawn: usize, all: usize) -> String {
    if drawn == all {
        format!("{}, all drawn", counted(all, "sample"))
    } else {
        format!(
            "{}, {drawn} drawn: evenly spaced ones and those with the largest errors",
            counted(all, "sample")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_counts_one_sample() {
        assert_eq!(rule(1, 1), "1 sample, all drawn");
        assert_eq!(rule(9, 9), "9 samples, all drawn");
    }

    #[test]
    fn few_are_all_drawn_and_of_many_the_worst_are_never_lost() {
        assert_eq!(thin(&[1.0, 2.0], 10), [0, 1]);
        let mut errors = vec![0.0; 100_000];
        errors[77_777] = -3.0;
        let drawn = thin(&errors, 100);
        assert!(drawn.len() <= 100 && drawn.contains(&77_777) && drawn.contains(&0));
    }
}
