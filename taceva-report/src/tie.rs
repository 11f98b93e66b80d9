//! Ties: sensors that tell the spacing of gratings equally often, and how fine that is.

use std::collections::BTreeMap;

use crate::figures::listed;
use crate::number::numeral;
use crate::results::{Score, Study};
use crate::samples::Samples;

/// The metric whose values are shares of few presses, so that they are often the same.
const METRIC: &str = "sr";
/// How far a spacing may be missed, where a score does not say.
const TOLERANCE_MM: f64 = 0.05;
const NM: f64 = 1e6;

/// The ties of `studies`, a line each: `sr line: tie: GelSight and TacTip both tell the gratings down to 0.25 mm to within 0.05 mm`.
pub fn ties(studies: &[Study]) -> Vec<String> {
    let names = crate::figures::names(studies);
    let mut channels: Vec<&str> = Vec::new();
    for score in studies.iter().flat_map(|study| study.of_metric(METRIC)) {
        if !channels.contains(&score.channel.as_str()) {
            channels.push(&score.channel);
        }
    }
    let channels = channels.into_iter();
    let lines = channels.filter_map(|channel| {
        let words = tie(studies, &names, METRIC, channel)?;
        Some(format!("{METRIC} {channel}: {words}"))
    });
    lines.collect()
}

/// What there is to say where the best of those that take part are several; nothing of other metrics, or of one winner.
pub(crate) fn tie(
    studies: &[Study],
    names: &[String],
    metric: &str,
    channel: &str,
) -> Option<String> {
    if metric != METRIC {
        return None;
    }
    let told: Vec<(&Study, &String, &Score, f64)> = studies
        .iter()
        .zip(names)
        .filter_map(|(study, name)| {
            let score = study.score(METRIC, channel)?;
            let share = score
                .value
                .number()
                .filter(|_| score.standing.takes_part())?;
            Some((study, name, score, share))
        })
        .collect();
    let best = told.iter().map(|(.., share)| *share).reduce(f64::max)?;
    let tied: Vec<_> = told
        .into_iter()
        .filter(|(.., share)| share.total_cmp(&best).is_eq())
        .collect();
    let [(_, _, score, _), _, ..] = tied[..] else {
        return None;
    };
    let who: Vec<String> = tied.iter().map(|(_, name, ..)| (*name).clone()).collect();
    let who = match who.len() {
        2 => format!("{} both", listed(&who)),
        _ => format!("{} all", listed(&who)),
    };
    let stated = score.parameters.iter();
    let stated = stated
        .filter(|(name, _)| name == "tolerance_mm")
        .map(|(_, mm)| *mm);
    let tolerance = stated.reduce(f64::max).unwrap_or(TOLERANCE_MM);
    let finest = tied.iter().map(|(study, ..)| {
        let samples = study.samples.as_ref()?;
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
            "tell the gratings down to {} mm to within {} mm",
            numeral(*mm),
            numeral(tolerance)
        ),
        _ => format!(
            "tell {} of the gratings to within {} mm",
            percent(best),
            numeral(tolerance)
        ),
    };
    let exact = tied.iter().map(|(_, name, score, _)| {
        let exact = score.variant("exact")?.value.number()?;
        Some((format!("{name} {}", percent(exact)), exact))
    });
    let exact: Option<Vec<(String, f64)>> = exact.collect();
    let exact = exact.map(|all| {
        let is_same = all
            .windows(2)
            .all(|pair| pair[0].1.total_cmp(&pair[1].1).is_eq());
        let words: Vec<String> = all.into_iter().map(|(words, _)| words).collect();
        match is_same {
            true => ", and no finer tolerance tells them apart".to_owned(),
            false => format!("; without any error {}", listed(&words)),
        }
    });
    Some(format!("tie: {who} {said}{}", exact.unwrap_or_default()))
}

/// The spacing of every grating of `kind` that was pressed.
fn boards<'a>(samples: &'a Samples, kind: &'a str) -> impl Iterator<Item = f64> + 'a {
    let rows = 0..samples.rows();
    let rows = rows.filter(move |row| samples.word("kind", *row) == Some(kind));
    rows.filter_map(|row| samples.number("spacing_mm", row))
}

/// The finest spacing from which on, up to the coarsest, every grating of `kind` is told to within `tolerance_mm`; none if not even the
/// coarsest is.
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
        let told = samples.number("spacing_predicted_mm", row);
        let is_told = told.is_some_and(|told| {
            (nanometres(told) - nanometres(truth)).abs() <= nanometres(tolerance_mm)
        });
        // Spacings are positive, so their bits are in their order.
        *boards.entry(truth.max(0.0).to_bits()).or_insert(true) &= is_told;
    }
    let told = boards.iter().rev().take_while(|(_, is_told)| **is_told);
    told.last().map(|(spacing, _)| f64::from_bits(*spacing))
}

/// `98.6 %`
fn percent(share: f64) -> String {
    format!("{} %", numeral(100.0 * share))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A study whose success rate is `share`, `exact` without any error, with samples if there are any.
    fn study(name: &str, [share, exact]: [f64; 2], samples: &str) -> Study {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.1", "subject": {{"sensor": "{name}"}}, "metrics": {{"sr": {{"line":
               {{"value": {share}, "unit": "1", "parameters": {{"tolerance_mm": 0.05}}, "exact": {{"value": {exact}, "unit": "1"}}}}}}}}}}"#
        );
        let mut study = Study::read(&text).expect("a result").remove(0);
        study.samples = (!samples.is_empty()).then(|| {
            let head = "id,kind,spacing_mm,spacing_predicted_mm\n";
            Samples::read(&format!("{head}{samples}")).expect("samples")
        });
        study
    }

    #[test]
    fn a_tie_says_how_fine_both_tell_and_a_winner_is_no_tie() {
        let fine = "1,line,0.5,0.5\n2,line,0.3,0.35\n3,line,0.2,0.4\n4,dot,0.1,0.1\n";
        let both = [study("a", [0.75, 0.5], fine), study("b", [0.75, 0.5], fine)];
        let expected = "sr line: tie: a and b both tell the gratings down to 0.3 mm to within 0.05 mm, and no finer tolerance tells them apart";
        assert_eq!(ties(&both), [expected]);
        let other = [study("a", [1.0, 0.5], ""), study("b", [0.9, 0.5], "")];
        assert!(ties(&other).is_empty());
    }

    #[test]
    fn whoever_tells_all_tells_the_finest_that_was_pressed() {
        let pressed = "1,line,0.5,\n2,line,0.25,\n3,dot,0.1,\n";
        let all = [
            study("a", [1.0, 0.5], pressed),
            study("b", [1.0, 0.25], pressed),
        ];
        let expected = "sr line: tie: a and b both tell the gratings down to 0.25 mm to within 0.05 mm; without any error a 50 % and b 25 %";
        assert_eq!(ties(&all), [expected]);
    }

    #[test]
    fn without_samples_shares_are_said_and_which_of_them_is_finer() {
        let of = |exact: f64| study("x", [0.9, exact], "");
        let mut all = [of(0.5), of(0.75), study("worse", [0.2, 0.2], "")];
        "a".clone_into(&mut all[0].sensor);
        "b".clone_into(&mut all[1].sensor);
        let expected = "sr line: tie: a and b both tell 90 % of the gratings to within 0.05 mm; without any error a 50 % and b 75 %";
        assert_eq!(ties(&all), [expected]);
    }

    #[test]
    fn what_has_no_skill_is_tied_with_nobody() {
        let mut all = [study("a", [0.9, 0.5], ""), study("b", [0.9, 0.5], "")];
        all[1].scores[0].standing = taceva_metrics::Standing::NoSkill;
        assert!(ties(&all).is_empty());
    }
}
