//! Sequence of scores and their variants, for rows of tables.

use std::collections::BTreeMap;

use taceva_core::distinct;
use taceva_metrics::Standing;
use taceva_results::{EvaluationReport, Interval, Score, ScoreLine, described_method};

/// Lines of every score and of its variants with a single number. Only JSON contains maps and curves.
pub(super) fn lines(scores: &[Score]) -> Vec<ScoreLine<'_>> {
    scores.iter().flat_map(|score| score.lines()).collect()
}

/// Lines for readers. Omits reference constants and variants of undefined scores, which only JSON and CSV contain.
pub(super) fn read_lines(scores: &[Score]) -> Vec<ScoreLine<'_>> {
    let has_value = |line: &ScoreLine<'_>| {
        line.is_headline || line.value.number().is_some() || line.score.value.number().is_some()
    };
    let lines = lines(scores).into_iter();
    lines
        .filter(|line| !line.is_reference() && has_value(line))
        .collect()
}

/// Methods of intervals, with their metrics if there are several: `jackknife, 460 samples taken as independent in 32 groups, logarithmic (mae)`.
pub(super) fn methods(report: &EvaluationReport, foreign: impl Fn(&str) -> String) -> Vec<String> {
    let mut methods: BTreeMap<&str, (u64, Vec<&str>)> = BTreeMap::new();
    for score in &report.scores {
        if let Some(method) = score.interval.as_ref().and_then(Interval::method) {
            let (n, metrics) = methods.entry(method).or_default();
            *n = score.n.max(*n);
            if !metrics.contains(&score.metric.as_str()) {
                metrics.push(&score.metric);
            }
        }
    }
    let is_one = methods.len() == 1;
    let named = |(method, (n, metrics)): (&str, (u64, Vec<&str>))| {
        let method = described_method(method, n);
        let method = match report.provenance.group() {
            Some(group) => method.replace(" by group", &format!(" by {}", foreign(group))),
            None => method,
        };
        match is_one {
            true => method,
            false => format!("{method} ({})", metrics.join(", ")),
        }
    };
    methods.into_iter().map(named).collect()
}

/// Flags of scores, one line for each flag of a metric: `uniformity Fz: one bin`, `skill Pz Fz: constant is the mean of truth`.
pub(super) fn flags(scores: &[Score]) -> Vec<String> {
    let mut groups: Vec<(&str, &str, Vec<&str>)> = Vec::new();
    for score in scores {
        for flag in &score.flags {
            let found = groups
                .iter_mut()
                .find(|(metric, known, _)| *metric == score.metric && known == flag);
            match found {
                Some((_, _, channels)) => channels.push(&score.channel),
                None => groups.push((&score.metric, flag, vec![&score.channel])),
            }
        }
    }
    let groups = groups.into_iter();
    groups
        .map(|(id, flag, channels)| format!("{id} {}: {flag}", channels.join(" ")))
        .collect()
}

/// Parameters in the definitions of scores with a value: `tolerance: within 0.05 of the truth, in the unit of the channel`. If a parameter has
/// several values, each value is followed by its channels.
pub(super) fn limits(scores: &[Score]) -> Vec<String> {
    let of = |metric: &str, parameter: &str| {
        let own = scores.iter().filter(|score| score.metric == metric);
        let own = own.filter(|score| score.value.number().is_some());
        let mut limits: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        for score in own {
            let of_it = score
                .parameters
                .iter()
                .filter(|(name, _)| name == parameter);
            for (_, limit) in of_it {
                let channels = limits.entry(limit.to_string()).or_default();
                channels.push(&score.channel);
            }
        }
        let is_one = limits.len() == 1;
        let words = limits.into_iter().map(|(limit, channels)| match is_one {
            true => limit,
            false => format!("{limit} ({})", channels.join(" ")),
        });
        let words: Vec<String> = words.collect();
        (!words.is_empty()).then(|| words.join(" or "))
    };
    let within = of("tolerance", "tolerance");
    let within = within.map(|limit| format!("tolerance: within {limit} of the truth"));
    let from = of("smape_gated", "gate");
    let from = from.map(|limit| format!("smape_gated: truth of at least {limit}"));
    let both = within.into_iter().chain(from);
    both.map(|words| format!("{words}, in the unit of the channel"))
        .collect()
}

/// Scores with limited standing in verdicts: `not better than predicting the mean: mae Pz Fz`.
pub(super) fn standings(scores: &[Score]) -> Vec<String> {
    let mut said = Vec::new();
    for standing in Standing::ALL {
        let Some(words) = standing.phrase() else {
            continue;
        };
        let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
        let of_it = scores
            .iter()
            .filter(|score| score.standing == standing && score.value.number().is_some());
        for score in of_it {
            match groups.last_mut() {
                Some((id, channels)) if *id == score.metric => channels.push(&score.channel),
                _ => groups.push((&score.metric, vec![&score.channel])),
            }
        }
        let groups: Vec<String> = groups
            .into_iter()
            .map(|(id, channels)| format!("{id} {}", channels.join(" ")))
            .collect();
        if !groups.is_empty() {
            said.push(format!("{words}: {}", groups.join(", ")));
        }
    }
    said
}

/// Steps after which verdicts may use scores of `report` that they now exclude. Each step occurs once.
pub(super) fn remedies(report: &EvaluationReport) -> Vec<&'static str> {
    let scores = &report.scores;
    let is_cross_validated = report.provenance.cross_validation().is_some();
    let is_met = |standing: &Standing| {
        let mut valued = scores.iter().filter(|score| score.value.number().is_some());
        valued.any(|score| score.standing == *standing)
    };
    let met = Standing::ALL.into_iter().filter(is_met);
    distinct(met.filter_map(|standing| standing.remedy(is_cross_validated)))
}

/// Names of maps, curves and matrices that only JSON contains, one line for each metric: `r_spatial Px Py Fz: distance, depth`.
pub(super) fn pictures(scores: &[Score]) -> Vec<String> {
    let mut pictures: Vec<(&str, Vec<&str>, String)> = Vec::new();
    for score in scores {
        let many = score.variants.iter();
        let many = many.filter(|variant| variant.value.is_of_many());
        let names: Vec<&str> = many.map(|variant| variant.name.as_str()).collect();
        let names = names.join(", ");
        match pictures.last_mut() {
            _ if names.is_empty() => {}
            Some((id, channels, same)) if *id == score.metric && *same == names => {
                channels.push(&score.channel);
            }
            _ => pictures.push((&score.metric, vec![&score.channel], names)),
        }
    }
    let line = |(id, channels, names): (&str, Vec<&str>, String)| {
        format!("{id} {}: {names}", channels.join(" "))
    };
    pictures.into_iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use taceva_core::Unit;
    use taceva_results::{Value, Variant};

    use super::*;

    #[test]
    fn limits_that_differ_between_channels_name_them() {
        let of = |channel: &str, limit: f64| Score {
            parameters: vec![("tolerance".to_owned(), limit)],
            ..Score::of_number("tolerance", channel, 0.5, Unit::One)
        };
        let scores = [of("Fz", 0.05), of("Pz", 0.05), of("Rx", 0.5)];
        let differing =
            "tolerance: within 0.05 (Fz Pz) or 0.5 (Rx) of the truth, in the unit of the channel";
        assert_eq!(limits(&scores), [differing]);
        let common = "tolerance: within 0.05 of the truth, in the unit of the channel";
        assert_eq!(limits(&scores[..2]), [common]);
    }

    #[test]
    fn an_undefined_score_is_read_without_its_variants() {
        let undefined = |reason: &str| Value::Undefined(reason.to_owned());
        let variant = |value: Value| Variant {
            name: "critical".to_owned(),
            value,
            unit: Unit::Newton,
            interval: None,
        };
        let score = |value: Value, of: Value| Score {
            value,
            variants: vec![variant(of)],
            ..Score::of_number("noise_equivalent_force", "Fz", 0.5, Unit::Newton)
        };
        let few = || undefined("fewer than 10 samples");
        let names = |score: Score| -> Vec<String> {
            let scores = [score];
            let lines = read_lines(&scores).into_iter();
            lines.map(|line| line.name).collect()
        };
        let both = ["noise_equivalent_force", "noise_equivalent_force.critical"];
        assert_eq!(names(score(few(), few())), both[..1]);
        assert_eq!(names(score(few(), Value::Number(0.5))), both);
        assert_eq!(names(score(Value::Number(0.5), few())), both);
    }
}
