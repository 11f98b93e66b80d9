//! Variation of the difference of two configurations between seeds.

use taceva_metrics::TrainingSpread;

use crate::analysis::Group;

/// Standard error of the mean difference in the errors of `channel`, over the seeds of both groups. `None` for fewer than two seeds, or if all
/// differences are equal.
///
/// Both configurations use the same division for a seed, so differences are computed seed by seed. A seed also changes the tested contact points, which the
/// clusters represent too. The total variation is therefore overestimated rather than underestimated.
pub(super) fn between_seeds(
    chosen: &Group<'_>,
    other: &Group<'_>,
    channel: &str,
) -> Option<TrainingSpread> {
    let error = |group: &Group<'_>, seed: u64| {
        let mut results = group.results.iter();
        let (_, result) = results.find(|(own, _)| *own == seed)?;
        result.score("mae", channel)?.value.number()
    };
    let seeds = chosen.results.iter().map(|(seed, _)| *seed);
    let differences: Vec<f64> = seeds
        .filter_map(|seed| Some(error(chosen, seed)? - error(other, seed)?))
        .collect();
    TrainingSpread::of_mean(&differences).filter(TrainingSpread::varies)
}

#[cfg(test)]
mod tests {
    use super::super::example_groups::{group, result};
    use super::*;

    #[test]
    fn differences_are_formed_seed_by_seed_and_vary_as_their_mean_does() {
        let one = [0.5, 0.25, 0.75].map(result);
        let other = [1.0, 0.5, 0.75].map(result);
        // By seed −0.5, −0.25 and 0: standard deviation 0.25, of the mean 0.25 / √3.
        let spread = between_seeds(&group(&[1, 2, 3], &one), &group(&[1, 2, 3], &other), "Fz");
        let spread = spread.expect("three seeds");
        assert!((spread.standard_error - 0.25 / 3_f64.sqrt()).abs() < 1e-15);
        assert!((spread.freedom - 2.0).abs() < 1e-15);
        // The order of seeds does not matter; a seed without its counterpart is ignored.
        let turned = [0.75, 1.0, 0.5].map(result);
        let again = between_seeds(&group(&[1, 2, 3], &one), &group(&[3, 1, 2], &turned), "Fz");
        assert_eq!(again, Some(spread));
        let two = between_seeds(&group(&[1, 2, 3], &one), &group(&[1, 2, 4], &other), "Fz");
        assert!((two.expect("two seeds").freedom - 1.0).abs() < 1e-15);
        let none = between_seeds(&group(&[1, 2, 3], &one), &group(&[1, 5, 4], &other), "Fz");
        assert_eq!(none, None);
        // A model without random draws, scored on one division.
        let same = [0.5, 0.5, 0.5].map(result);
        let same = group(&[1, 2, 3], &same);
        assert_eq!(between_seeds(&same, &same, "Fz"), None);
    }
}
