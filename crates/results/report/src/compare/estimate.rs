//! Converts scores from results to estimates for tests.

use taceva_metrics::{Estimate, Sides, StatedInterval};

use taceva_results::{Interval, Score};

/// Flag of a skill relative to a prediction of the mean of truth, instead of the mean of the training part.
const MEAN_OF_TRUTH: &str = "constant is the mean of truth";

/// Estimates of both scores, or the reason why the scores have different meanings.
pub(super) fn of_both(scores: Sides<&Score>) -> Result<Sides<Estimate>, String> {
    let Sides { a, b } = scores;
    let meaning = |score: &Score| {
        // Sorted by name, because a file may state constants in any order.
        let mut constants = score.parameters.clone();
        constants.sort_by(|left, right| left.0.cmp(&right.0));
        let constants = constants.iter();
        let constants = constants.map(|(name, value)| format!(", {name} = {value}"));
        let mean = score.flags.iter().filter(|flag| **flag == MEAN_OF_TRUTH);
        let mean: String = mean.map(|flag| format!(", {flag}")).collect();
        let start = format!("{} in {}{mean}", score.definition, score.unit);
        constants.fold(start, |all, constant| all + &constant)
    };
    // A score without a value has no unit in a file.
    let has_value = a.value.number().is_some() && b.value.number().is_some();
    if has_value && meaning(a) != meaning(b) {
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

/// Estimate of a score with its interval. Degrees of freedom default to the number of clusters minus one, for older results.
pub(crate) fn estimate(score: &Score) -> Result<Estimate, String> {
    let Some(value) = score.value.number() else {
        let reason = score.value.reason();
        return Err(reason.unwrap_or_else(|| "not a single number".to_owned()));
    };
    let Some(interval) = &score.interval else {
        return Err("no interval".to_owned());
    };
    let (ends, method, standard_error, freedom) = match interval {
        Interval::Ends {
            ends,
            method,
            standard_error,
            degrees_of_freedom,
            ..
        } => (ends, method, *standard_error, *degrees_of_freedom),
        Interval::Absent(reason) => return Err(format!("no interval: {reason}")),
    };
    let Some(clusters) = interval.clusters() else {
        return Err(format!(
            "the interval by `{method}` does not state its number of clusters"
        ));
    };
    let others = u32::try_from(clusters).map_or(0, |clusters| clusters.saturating_sub(1));
    let freedom = freedom.unwrap_or_else(|| f64::from(others));
    let stated = StatedInterval::new(*ends, freedom, clusters).on(interval.scale());
    let stated = stated.with_standard_error(standard_error);
    Estimate::try_from_interval(value, stated).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use taceva_metrics::Scale;

    use super::*;

    #[test]
    fn the_interval_that_is_stated_is_taken_as_it_is() {
        let read = |more: &str| {
            let text = format!(
                r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "x"}}, "metrics": {{"mae": {{"Fz":
                {{"value": 0.5, "unit": "N", "n": 40, "ci95": [0.4, 0.6], "method": "jackknife by point_id, G=10"{more}}}}}}}}}"#
            );
            let study = crate::results::unsealed(&text).expect("a result").remove(0);
            estimate(&study.scores[0]).expect("an estimate")
        };
        let stated = |freedom, clusters| StatedInterval::new([0.4, 0.6], freedom, clusters);
        let read_as = |stated| Estimate::try_from_interval(0.5, stated).expect("an estimate");
        let exact =
            read(r#", "standard_error": 0.0442, "clusters": 12, "degrees_of_freedom": 7.25"#);
        let expected = stated(7.25, 12).with_standard_error(0.0442);
        assert_eq!(exact, read_as(expected));
        assert_eq!(read(""), read_as(stated(9.0, 10)));
    }

    #[test]
    fn constants_are_compared_by_name_whatever_their_order() {
        let read = |constants: &str| {
            let text = format!(
                r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "x"}}, "metrics": {{"bias_level": {{"Fz":
                {{"value": 0.5, "unit": "N", "n": 40, "ci95": [0.4, 0.6], "method": "jackknife by point_id, G=10", "definition": "bias_level/1",
                "parameters": {{{constants}}}}}}}}}}}"#
            );
            let mut study = crate::results::unsealed(&text).expect("a result").remove(0);
            study.scores.remove(0)
        };
        let a = read(r#""width": 0.1, "n_min": 5.0"#);
        let [b, other] = [
            r#""n_min": 5.0, "width": 0.1"#,
            r#""n_min": 5.0, "width": 0.2"#,
        ]
        .map(read);
        assert!(of_both(Sides { a: &a, b: &b }).is_ok());
        let error = of_both(Sides { a: &a, b: &other }).expect_err("other constants");
        assert_eq!(
            error,
            "the definitions `bias_level/1 in N, n_min = 5, width = 0.1` and `bias_level/1 in N, n_min = 5, width = 0.2` differ"
        );
        // The unit of a file stands beside the value.
        let mut valueless = other;
        valueless.value = taceva_results::Value::Undefined("too few places".to_owned());
        let error = of_both(Sides {
            a: &a,
            b: &valueless,
        })
        .expect_err("no value");
        assert_eq!(error, "undefined: too few places");
    }

    #[test]
    fn the_scale_of_an_interval_is_read_off_its_method() {
        let scale = |method: &str| {
            let interval = Interval::Ends {
                ends: [0.4, 0.6],
                method: method.to_owned(),
                standard_error: None,
                clusters: None,
                degrees_of_freedom: None,
            };
            interval.scale()
        };
        assert_eq!(scale("jackknife by point_id, G=10"), Scale::Own);
        let logarithmic = "jackknife by point_id, G=10, logarithmic";
        assert_eq!(scale(logarithmic), Scale::Logarithm);
        let share = "jackknife by point_id, G=10, Wilson with effective samples";
        assert_eq!(scale(share), Scale::Wilson);
    }
}
