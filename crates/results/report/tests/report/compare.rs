//! Tests of comparisons of synthetic scores: the better sensor, the words, and readable lines and rows.

mod asked;
mod p_values;
mod pairs;
mod reach;
mod splits;
pub(crate) mod trainings;
mod variants;

use crate::support;
use serde_json::{Value, json};
use taceva_report::{CompareRequest, Comparison, OVERVIEW_LINES, Study, compare, figures};

/// Score with the standard error `error` over twenty clusters.
pub(crate) fn score(value: f64, error: f64, unit: &str) -> Value {
    json!({
        "value": value, "unit": unit, "n": 80, "ci95": [value - 2.0 * error, value + 2.0 * error],
        "standard_error": error, "clusters": 20, "method": "drawn", "definition": "drawn/1"
    })
}

/// A study of `scores` by metric and channel; its model has known skill on `channels`.
pub(crate) fn study(sensor: &str, scores: &[(&str, &str, Value)], channels: &[&str]) -> Study {
    let mut metrics = json!({});
    for (metric, channel, score) in scores {
        metrics[metric][channel] = score.clone();
    }
    for channel in channels {
        metrics["r2"][channel] = score(0.9, 0.01, "1");
    }
    let json = json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": sensor, "serial": "1", "gel": "1", "source": "simulated"},
        "metrics": metrics
    });
    support::study(&json)
}

/// Studies with skill, each with one mean absolute error of Fz from `values`.
pub(crate) fn errors(values: &[(&str, f64)]) -> Vec<Study> {
    let of = |&(sensor, value): &(&str, f64)| {
        study(sensor, &[("mae", "Fz", score(value, 0.01, "N"))], &["Fz"])
    };
    values.iter().map(of).collect()
}

fn of_metric(studies: &[Study], metric: &str) -> Comparison {
    let request = CompareRequest {
        metrics: vec![metric.to_owned()],
        ..CompareRequest::default()
    };
    compare(studies, &request)
}

#[test]
fn the_best_of_three_is_said_to_be_better_than_both_others_wherever_it_stands() {
    let values = [("Coarse", 0.75), ("Middle", 0.5), ("Fine", 0.25)];
    for turn in 0..3 {
        let mut values = values;
        values.rotate_left(turn);
        let comparison = of_metric(&errors(&values), "mae");
        let decisions = comparison.decisions();
        let fine = values.iter().position(|(sensor, _)| *sensor == "Fine");
        assert_eq!((decisions.len(), decisions[0].winner), (1, fine));
        assert_eq!(decisions[0].asked(), "Normal force (mae Fz ↓)");
        assert_eq!(
            decisions[0].words,
            "Fine, 0.25 N, better than all 2 others (p < 0.001)"
        );
    }
}

#[test]
fn a_winner_of_two_names_the_other_one() {
    for values in [
        [("Coarse", 0.75), ("Fine", 0.25)],
        [("Fine", 0.25), ("Coarse", 0.75)],
    ] {
        let comparison = of_metric(&errors(&values), "mae");
        assert_eq!(
            comparison.decisions()[0].words,
            "Fine, 0.25 N, better than Coarse (p < 0.001)"
        );
        assert_eq!(
            comparison.summary(),
            "1 pair of scores: 1 differs (5 %, Holm-corrected per metric)"
        );
        let overview = comparison.overview(None);
        let line = "\nNormal force (mae Fz ↓): Fine, 0.25 N, better than Coarse (p < 0.001)\n";
        assert!(overview.contains(line), "{overview}");
    }
}

#[test]
fn what_is_not_shown_to_differ_is_counted_as_such_and_has_no_winner() {
    let comparison = of_metric(&errors(&[("one", 0.5), ("two", 0.501)]), "mae");
    assert!(
        comparison
            .summary()
            .starts_with("1 pair of scores: 0 differ, 1 is not shown to differ (5 %")
    );
    let decision = &comparison.decisions()[0];
    assert_eq!(decision.winner, None);
    assert_eq!(
        decision.words,
        "no winner; the best value, one, 0.5 N, is not shown to be better"
    );
    let studies = errors(&[("one", 0.5), ("two", 0.501)]);
    assert!(
        comparison
            .page(&studies)
            .contains("No difference is shown between one and two.")
    );
}

#[test]
fn the_best_bias_is_the_nearest_to_zero_and_not_the_first() {
    let of = |sensor, value| {
        let score = score(value, 0.01, "N");
        study(sensor, &[("bias", "Fz", score)], &["Fz"])
    };
    let studies = [of("far", -0.5), of("near", -0.125), of("farther", -0.75)];
    let decision = &of_metric(&studies, "bias").decisions()[0];
    assert_eq!(decision.winner, Some(1));
    assert_eq!(
        decision.words,
        "near, −0.125 N, better than all 2 others (p < 0.001)"
    );
    assert_eq!(decision.asked(), "bias Fz →0");
}

#[test]
fn the_finest_of_gratings_that_two_tell_equally_often_is_a_tie_whomever_else_they_beat() {
    let of = |sensor, share| study(sensor, &[("sr", "line", score(share, 0.01, "1"))], &[]);
    let studies = [of("one", 0.875), of("two", 0.875), of("coarse", 0.25)];
    let decision = &of_metric(&studies, "sr").decisions()[0];
    assert_eq!(decision.winner, None);
    assert!(
        decision.words.starts_with("tie: one and two both"),
        "{}",
        decision.words
    );
}

#[test]
fn unknown_skill_is_said_of_those_it_is_unknown_of_and_of_no_other() {
    let known = study("known", &[("mae", "Fz", score(0.25, 0.01, "N"))], &["Fz"]);
    let unknown = study("untested", &[("mae", "Fz", score(0.75, 0.01, "N"))], &[]);
    let words = |studies: &[Study]| {
        let comparison = of_metric(studies, "mae");
        comparison.answers[0].words(&comparison.names)
    };
    let said = words(&[known.clone(), unknown.clone()]);
    assert!(
        said.ends_with("; not tested against predicting the mean: untested"),
        "{said}"
    );
    let other = Study {
        sensor: "other".to_owned(),
        ..known.clone()
    };
    let said = words(&[known, other]);
    assert!(!said.contains("not tested"), "{said}");
}

#[test]
fn a_score_without_skill_has_no_answer_but_its_reason() {
    let mut studies = errors(&[("one", 0.25), ("two", 0.75)]);
    studies[1] = study("two", &[("mae", "Fz", score(0.75, 0.01, "N"))], &[]);
    let without = json!({"value": 0.0, "unit": "1", "n": 80, "ci95": [-0.5, 0.5]});
    let unskilled = study(
        "none",
        &[
            ("mae", "Fz", score(0.125, 0.01, "N")),
            ("r2", "Fz", without),
        ],
        &[],
    );
    studies.push(unskilled);
    let comparison = of_metric(&studies, "mae");
    let reasons: Vec<Option<&str>> = comparison
        .answers
        .iter()
        .map(|answer| answer.reason.as_deref())
        .collect();
    let reason = "none: not better than predicting the mean: the skill of the model is not shown to be above zero";
    assert_eq!(reasons, [None, Some(reason), Some(reason)]);
    assert!(comparison.answers[0].difference.is_some());
    let decision = &comparison.decisions()[0];
    assert_eq!(decision.winner, Some(0));
    assert_eq!(
        decision.words,
        "one, 0.25 N, better than two (p < 0.001); none: not better than predicting the mean"
    );
}

#[test]
fn scores_that_no_question_names_are_at_most_two_lines_less_than_a_screen() {
    let metrics = [
        "mae",
        "rmse",
        "bias",
        "smape",
        "smape_gated",
        "r_spatial",
        "r_light",
        "repeatability",
        "hysteresis",
        "linearity",
        "crosstalk",
        "bias_level",
        "tolerance",
        "drift",
    ];
    let of = |sensor, value| {
        let scores = metrics.map(|metric| (metric, "Fx", score(value, 0.01, "N")));
        study(sensor, &scores, &["Fx"])
    };
    let comparison = compare(
        &[of("one", 0.25), of("two", 0.75)],
        &CompareRequest::default(),
    );
    assert!(comparison.answers.len() > OVERVIEW_LINES);
    assert!(comparison.decisions().len() >= OVERVIEW_LINES - 2);
    let overview = comparison.overview(None);
    assert_eq!(overview.lines().count(), OVERVIEW_LINES);
    assert!(overview.contains("\nmae Fx ↓: one, 0.25 N"), "{overview}");
}

#[test]
fn long_names_are_wrapped_on_the_first_screen_and_below_it() {
    let long = "a sensor whose name alone is as long as half a line";
    let longer = "another one whose name is rather longer than half a line";
    let comparison = of_metric(&errors(&[(long, 0.25), (longer, 0.75)]), "mae");
    let overview = comparison.overview(Some(100));
    let first = overview.lines().nth(1).expect("a line");
    assert!(
        first.starts_with("Normal force (mae Fz ↓): a sensor"),
        "{first}"
    );
    let text = comparison.text();
    assert!(text.contains("\nmae Fz ↓, in N\n"), "{text}");
    for line in overview.lines().chain(text.lines()) {
        assert!(line.chars().count() <= 100, "{line}");
    }
    // Wrapping loses nothing, and breaks no line that has room for the next word.
    let joined = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let words = comparison.answers[0].words(&comparison.names);
    assert!(joined(&text).contains(&words), "{text}");
    let words = &comparison.decisions()[0].words;
    assert!(joined(&overview).contains(words), "{overview}");
    for line in comparison.overview(Some(40)).lines() {
        assert!(line.chars().count() <= 40, "{line}");
    }
    let lines: Vec<&str> = text.lines().collect();
    for pair in lines
        .windows(2)
        .filter(|pair| pair[1].starts_with("      "))
    {
        let next = pair[1]
            .split_whitespace()
            .next()
            .map_or(0, |word| word.chars().count());
        assert!(pair[0].chars().count() + 1 + next > 100, "{pair:?}");
    }
}

#[test]
fn a_row_has_both_scores_their_difference_and_the_answer() {
    let comparison = of_metric(&errors(&[("one", 0.25), ("two", 0.75)]), "mae");
    let table = comparison.table();
    assert_eq!(table.rows.len(), 1);
    let row = table.rows[0].plain();
    assert_eq!(row.len(), table.columns.len());
    assert_eq!(
        row[..7],
        ["mae", "Fz", "one", "two", "0.25", "0.75", "−0.5"]
    );
    assert_eq!(row[8], "0.95");
    assert_eq!(row[11], "N");
    assert!(row[12].starts_with("one better by 0.5"), "{}", row[12]);
}

#[test]
fn a_page_says_who_is_better_and_has_radars_only_if_some_are_drawn() {
    let of = |sensor, value| {
        let scores = [("Fz", "N"), ("Fxy", "N"), ("Pz", "mm")];
        let scores = scores.map(|(channel, unit)| ("mae", channel, score(value, 0.01, unit)));
        study(sensor, &scores, &["Fz", "Fxy", "Pz"])
    };
    let studies = [of("one", 0.25), of("two", 0.75)];
    let page = of_metric(&studies, "mae").page(&studies);
    assert!(page.contains("<strong>one</strong> is better than two (0.25 and 0.75 N)"));
    let has_radars = |studies: &[Study]| {
        let drawn = figures(studies);
        drawn.iter().any(|figure| figure.id.starts_with("radar"))
    };
    assert!(has_radars(&studies) && page.contains("Side by side"));
    let of = |sensor, value| study(sensor, &[("rmse", "Fz", score(value, 0.01, "N"))], &[]);
    let studies = [of("one", 0.25), of("two", 0.75)];
    let page = of_metric(&studies, "rmse").page(&studies);
    assert!(!has_radars(&studies) && !page.contains("Side by side"));
}

#[test]
fn a_page_draws_the_values_of_each_asked_metric_with_intervals_and_n() {
    let studies = errors(&[("one", 0.25), ("two", 0.75)]);
    let comparison = of_metric(&studies, "mae");
    let page = comparison.page(&studies);
    assert_eq!(page.matches("id=\"figure-intervals-").count(), 1, "{page}");
    let figure = comparison.figures(&studies).remove(0);
    assert_eq!(figure.id, "intervals-mae");
    assert!(figure.caption.ends_with(" n is 80."), "{}", figure.caption);
    let svg = figure.svg();
    for words in [
        "one, Fz: 0.250 N (0.230 … 0.270), n = 80",
        "two, Fz: 0.750 N (0.730 … 0.770), n = 80",
    ] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
}

#[test]
fn the_summary_counts_single_pairs_of_units_as_one_cause() {
    let of = |sensor| {
        let mut units = score(0.5, 0.01, "N");
        units["counts"] = json!({"pairs_valid": 1});
        study(sensor, &[("inter_sensor", "Fz", units)], &["Fz"])
    };
    let summary = of_metric(&[of("one"), of("two")], "inter_sensor").summary();
    assert!(
        summary.contains("1 cannot be tested: only one pair of units was compared (1)"),
        "{summary}"
    );
}

#[test]
fn with_a_margin_a_row_has_one_decision() {
    let margins = [("mae".to_owned(), 0.05)].into();
    let request = CompareRequest {
        metrics: vec!["mae".to_owned()],
        margins,
        ..CompareRequest::default()
    };
    let decided = |values: &[(&str, f64)], error: f64| {
        let of = |&(sensor, value): &(&str, f64)| {
            study(sensor, &[("mae", "Fz", score(value, error, "N"))], &["Fz"])
        };
        let studies: Vec<Study> = values.iter().map(of).collect();
        let comparison = compare(&studies, &request);
        let words = comparison.decisions()[0].words.clone();
        (comparison.summary(), words)
    };
    let (summary, words) = decided(&[("one", 0.50), ("two", 0.52)], 0.002);
    assert_eq!(
        words,
        "no winner; the best value, one, 0.5 N, is equivalent to two within 0.05 N"
    );
    assert!(
        summary.starts_with("1 pair of scores: 0 differ, 1 is equivalent within the margin (5 %"),
        "{summary}"
    );
    let (_, words) = decided(&[("one", 0.50), ("two", 0.52), ("far", 0.9)], 0.002);
    assert_eq!(
        words,
        "one, 0.5 N, better than 1 of 2 others (p < 0.001), equivalent to two within 0.05 N"
    );
    let (_, words) = decided(&[("one", 0.50), ("two", 0.56)], 0.05);
    assert_eq!(
        words,
        "no winner; the best value, one, 0.5 N, is not shown to be better"
    );
}
