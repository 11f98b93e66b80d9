//! Ties: sensors with equal best values. A tie in gratings also states the finest predicted spacing.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::counted;
use taceva_metrics::Better;

use crate::names::listed;
use crate::number::{numeral, spaced};
use crate::results::Study;
use taceva_results::Samples;
use taceva_results::Score;

/// Metric of gratings. Values are shares of few presses, so ties are frequent.
pub(crate) const GRATINGS: &str = "sr";
/// Default tolerance of a spacing in mm, if a score states no tolerance.
const TOLERANCE_MM: f64 = 0.05;
const NM: f64 = 1e6;

/// Tie of several studies for the best value of one score.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tie {
    /// Positions of the tied studies, at least two.
    pub(crate) who: Vec<usize>,
    /// Sentence on the tie: `tie: GelSight and TacTip have the same value, 0.42 mm/N`.
    pub(crate) words: String,
}

/// Study with a value that takes part in a tie.
struct Rival<'a> {
    at: usize,
    study: &'a Study,
    name: &'a str,
    score: &'a Score,
    value: f64,
}

/// Position and value of the best of `values`, the first if several are equal. `None` for scores without a better direction.
pub(crate) fn best(
    values: impl IntoIterator<Item = (usize, f64)>,
    better: Better,
) -> Option<(usize, f64)> {
    let leads = |new: f64, old: f64| match better {
        Better::Lower => new < old,
        Better::Higher => new > old,
        Better::NearZero => new.abs() < old.abs(),
        _ => false,
    };
    let values = values.into_iter().filter(|_| better != Better::Described);
    values.reduce(|best, next| if leads(next.1, best.1) { next } else { best })
}

/// Tie of the studies that take part in verdicts and have exactly equal best values. `None` for a single best study, or a score without a better
/// direction.
pub(crate) fn tie(studies: &[Study], names: &[String], metric: &str, channel: &str) -> Option<Tie> {
    let named = studies.iter().zip(names).enumerate();
    let rivals = named.filter_map(|(at, (study, name))| {
        let score = study.score(metric, channel)?;
        let takes_part = score.standing.takes_part();
        let decides = score.decided_by().map_or(&score.value, |of| &of.value);
        Some(Rival {
            at,
            study,
            name,
            score,
            value: decides.number().filter(|_| takes_part)?,
        })
    });
    let rivals: Vec<Rival<'_>> = rivals.collect();
    let unit = rivals.first()?.score.unit;
    let same = || rivals.iter().filter(|one| one.score.unit == unit);
    let better = rivals.first()?.score.better();
    let (_, best) = best(same().map(|one| (one.at, one.value)), better)?;
    let tied: Vec<&Rival<'_>> = same()
        .filter(|one| one.value.total_cmp(&best).is_eq())
        .collect();
    if tied.len() < 2 {
        return None;
    }
    let words = match metric {
        GRATINGS => gratings(&tied, best, channel),
        _ => {
            let who: Vec<String> = tied.iter().map(|one| one.name.to_owned()).collect();
            let value = format!("{}{}", numeral(best), spaced(unit));
            format!("tie: {} have the same value, {value}", listed(&who))
        }
    };
    Some(Tie {
        who: tied.iter().map(|one| one.at).collect(),
        words,
    })
}

/// Sentence on the finest grating spacing that the tied studies predict. `best` is their common success rate.
fn gratings(tied: &[&Rival<'_>], best: f64, channel: &str) -> String {
    let who: Vec<String> = tied.iter().map(|one| one.name.to_owned()).collect();
    let who = match who.len() {
        2 => format!("{} both", listed(&who)),
        _ => format!("{} all", listed(&who)),
    };
    let stated = tied.iter().take(1).flat_map(|one| &one.score.parameters);
    let stated = stated
        .filter(|(name, _)| name == "tolerance_mm")
        .map(|(_, mm)| *mm);
    let tolerance = stated.reduce(f64::max).unwrap_or(TOLERANCE_MM);
    let finest = tied.iter().map(|one| {
        let samples = one.study.samples.as_ref()?;
        match best.total_cmp(&1.0).is_eq() {
            true => boards(samples, channel).reduce(f64::min),
            false => finest(samples, channel, tolerance),
        }
    });
    let finest: Option<Vec<f64>> = finest.collect();
    let finest = finest.filter(|all| {
        all.windows(2)
            .all(|pair| pair[0].total_cmp(&pair[1]).is_eq())
    });
    let said = match finest.as_deref() {
        Some([mm, ..]) => format!(
            "predict the spacing of gratings down to {} mm to within {} mm",
            numeral(*mm),
            numeral(tolerance)
        ),
        _ => format!(
            "predict the spacing of {} of the gratings to within {} mm",
            percent(best),
            numeral(tolerance)
        ),
    };
    let exact = tied.iter().map(|one| {
        let exact = one.score.variant("exact")?.value.number()?;
        Some((format!("{} {}", one.name, percent(exact)), exact))
    });
    let exact: Option<Vec<(String, f64)>> = exact.collect();
    let exact = exact.map(|all| {
        let is_same = all
            .windows(2)
            .all(|pair| pair[0].1.total_cmp(&pair[1].1).is_eq());
        let words: Vec<String> = all.into_iter().map(|(words, _)| words).collect();
        match is_same {
            true => ", and no finer tolerance separates them".to_owned(),
            false => format!("; exact predictions: {}", words.join(", ")),
        }
    });
    let means: Vec<Option<String>> = tied
        .iter()
        .map(|one| meaning(one.study.samples.as_ref()?, channel, tolerance))
        .collect();
    let is_same = means.windows(2).all(|pair| pair[0] == pair[1]);
    let means = means.into_iter().next().flatten().filter(|_| is_same);
    format!(
        "tie: {who} {said}{}{}",
        means.unwrap_or_default(),
        exact.unwrap_or_default()
    )
}

/// Clause for predictions that always equal the spacing of a training board: `, which means the right one of 16 learnt boards at least 0.1 mm
/// apart`. `None` without predictions, or if a prediction is not a training spacing.
fn meaning(samples: &Samples, kind: &str, tolerance_mm: f64) -> Option<String> {
    let nanometres = |mm: f64| (mm * NM).round();
    let known: BTreeSet<u64> = boards(samples, kind)
        .map(|mm| nanometres(mm).max(0.0).to_bits())
        .collect();
    let mut predicted = (0..samples.rows())
        .filter(|row| samples.word("kind", *row) == Some(kind))
        .filter_map(|row| samples.number("spacing_predicted_mm", row))
        .map(|mm| nanometres(mm).max(0.0).to_bits())
        .peekable();
    predicted.peek()?;
    if !predicted.all(|spacing| known.contains(&spacing)) {
        return None;
    }
    let sorted: Vec<f64> = known.iter().map(|bits| f64::from_bits(*bits)).collect();
    let steps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
    let step = steps.reduce(f64::min)?;
    let count = known.len();
    Some(match step > nanometres(tolerance_mm) {
        true => format!(
            ", which means the right one of {} at least {} mm apart",
            counted(count, "learnt board"),
            numeral(step / NM)
        ),
        false => format!(", each time as one of {}", counted(count, "learnt board")),
    })
}

/// Spacing of every pressed grating of `kind`.
fn boards<'a>(samples: &'a Samples, kind: &'a str) -> impl Iterator<Item = f64> + 'a {
    let rows = 0..samples.rows();
    let rows = rows.filter(move |row| samples.word("kind", *row) == Some(kind));
    rows.filter_map(|row| samples.number("spacing_mm", row))
}

/// Finest spacing down to which all gratings of `kind` are predicted to within `tolerance_mm`. `None` if even the coarsest grating is predicted worse.
fn finest(samples: &Samples, kind: &str, tolerance_mm: f64) -> Option<f64> {
    let nanometres = |mm: f64| (mm * NM).round();
    let mut boards: BTreeMap<u64, bool> = BTreeMap::new();
    for row in 0..samples.rows() {
        let (Some(of), Some(truth)) =
            (samples.word("kind", row), samples.number("spacing_mm", row))
        else {
            continue;
        };
        if of != kind {
            continue;
        }
        let predicted = samples.number("spacing_predicted_mm", row);
        let is_right = predicted.is_some_and(|predicted| {
            (nanometres(predicted) - nanometres(truth)).abs() <= nanometres(tolerance_mm)
        });
        // Spacings are positive, so their bits sort like their values.
        *boards.entry(truth.max(0.0).to_bits()).or_insert(true) &= is_right;
    }
    let right = boards.iter().rev().take_while(|(_, is_right)| **is_right);
    right.last().map(|(spacing, _)| f64::from_bits(*spacing))
}

/// Share in percent: `98.6 %`.
fn percent(share: f64) -> String {
    format!("{} %", numeral(100.0 * share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_value_of_any_metric_is_a_tie_and_one_bit_more_is_none() {
        let of = |name: &str, value: f64| {
            let text = format!(
                r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "{name}"}}, "metrics": {{"linearity": {{"Fz":
                   {{"value": {value:?}, "unit": "N"}}}}}}}}"#
            );
            crate::results::unsealed(&text).expect("a result").remove(0)
        };
        let tie_of = |values: [f64; 3]| {
            let studies = [of("a", values[0]), of("b", values[1]), of("c", values[2])];
            let names = crate::names::names(&studies);
            tie(&studies, &names, "linearity", "Fz")
        };
        let tied = tie_of([0.5, 2.5, 0.5]).expect("a tie");
        let words = "tie: a and c have the same value, 0.5 N";
        assert_eq!(
            (tied.who.as_slice(), tied.words.as_str()),
            ([0, 2].as_slice(), words)
        );
        assert_eq!(tie_of([0.5, 2.5, 0.500_000_000_000_000_1]), None);
        assert_eq!(tie_of([2.5, 0.5, 2.5]), None);
    }
}
