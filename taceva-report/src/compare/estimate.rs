//! Scores as they are read back, as estimates that can be tested.

use taceva_metrics::{Estimate, Sides, welch};

use crate::results::{Interval, Score};

/// The flag of a skill that is measured by another constant than that of the training part.
const MEAN_OF_TRUTH: &str = "constant is the mean of truth";

/// Both scores, if they have one meaning; why not, in words.
pub(super) fn of_both(scores: Sides<&Score>) -> Result<Sides<Estimate>, String> {
    let Sides { a, b } = scores;
    let meaning = |score: &Score| {
        let constants = score.parameters.iter();
        let constants = constants.map(|(name, value)| format!(", {name} = {value}"));
        let mean = score.flags.iter().filter(|flag| **flag == MEAN_OF_TRUTH);
        let mean: String = mean.map(|flag| format!(", {flag}")).collect();
        let start = format!("{} in {}{mean}", score.definition, score.unit);
        constants.fold(start, |all, constant| all + &constant)
    };
    if meaning(a) != meaning(b) {
        return Err(format!(
            "the definitions `{}` and `{}` differ",
            meaning(a),
            meaning(b)
        ));
    }
    Ok(Sides {
        a: estimate(a)?,
        b: estimate(b)?,
    })
}

/// A score with the standard error that its interval was made from; where an older result does not say it, the half width of the interval
/// over the quantile of Student's t.
fn estimate(score: &Score) -> Result<Estimate, String> {
    let Some(value) = score.value.number() else {
        let reason = score.value.reason();
        return Err(reason.unwrap_or_else(|| "not a single number".to_owned()));
    };
    let Some(interval) = &score.interval else {
        return Err("no interval".to_owned());
    };
    let (ends, method, stated) = match interval {
        Interval::Ends {
            ends,
            method,
            standard_error,
            ..
        } => (ends, method, *standard_error),
        Interval::Absent(reason) => return Err(format!("no interval: {reason}")),
    };
    let Some(clusters) = interval.clusters() else {
        return Err(format!(
            "an interval by `{method}` has no number of clusters"
        ));
    };
    let standard_error = match stated {
        Some(stated) => stated,
        None => (ends[1] - ends[0]) / 2.0 / quantile(clusters).ok_or("too few clusters")?,
    };
    Estimate::try_new(value, standard_error, clusters).map_err(|error| error.to_string())
}

/// t of 95 % with one degree of freedom less than there are clusters, read off the interval of a score that moves by 1 beside one that
/// does not move.
fn quantile(clusters: usize) -> Option<f64> {
    let moving = Estimate::try_new(0.0, 1.0, clusters).ok()?;
    let still = Estimate::try_new(0.0, 0.0, clusters).ok()?;
    let difference = welch(Sides {
        a: moving,
        b: still,
    });
    Some(difference.ok()?.interval[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::Study;

    #[test]
    fn the_standard_error_that_is_stated_is_taken_as_it_is() {
        let read = |more: &str| {
            let text = format!(
                r#"{{"schema": "taceva.evaluation/1.1", "subject": {{"sensor": "x"}}, "metrics": {{"mae": {{"Fz":
                {{"value": 0.5, "unit": "N", "n": 40, "ci95": [0.4, 0.6], "method": "jackknife by point_id, G=10"{more}}}}}}}}}"#
            );
            let study = Study::read(&text).expect("a result").remove(0);
            estimate(&study.scores[0]).expect("an estimate")
        };
        let stated = 0.044_204_709_301_234_5;
        let exact = read(&format!(
            r#", "standard_error": {stated:?}, "clusters": 12"#
        ));
        let expected = Estimate::try_new(0.5, stated, 12).expect("an estimate");
        assert_eq!(exact, expected);
        let from_width = (0.6 - 0.4) / 2.0 / quantile(10).expect("enough clusters");
        let expected = Estimate::try_new(0.5, from_width, 10).expect("an estimate");
        assert_eq!(read(""), expected);
    }

    #[test]
    fn the_quantile_is_student_s() {
        // Tables: t of 0.975 with 9 and with 31 degrees of freedom.
        for (clusters, expected) in [(10, 2.262_157_163), (32, 2.039_513_446)] {
            let quantile = quantile(clusters).expect("enough clusters");
            assert!((quantile - expected).abs() < 1e-8, "{quantile}");
        }
        assert_eq!(quantile(4), None);
    }
}
