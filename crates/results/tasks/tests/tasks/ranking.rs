//! Rankings, compared with exact fractions.

use crate::golden::{above_a_half, entries, fraction, name, ranking, same, score, tasks, value};
use taceva_metrics::{ClusteredBy, Interval, LeftOut, Range};
use taceva_tasks::{Ranking, ScoreFlag, Undefined};

#[test]
fn every_exact_fraction_of_scores_comes_out_rounded_once() {
    let golden = tasks();
    for set in entries(&golden, "binary") {
        let exact = &set["exact"];
        let scores = ranking(set).scores();
        for metric in ["roc_auc", "average_precision"] {
            let found = value(&scores, metric, None).ok();
            same(
                found,
                fraction(&exact[metric]),
                &format!("{}, {metric}", name(set)),
            );
        }
        let prevalence = score(&scores, "average_precision", None)
            .estimate
            .of_constant;
        same(prevalence, fraction(&exact["prevalence"]), name(set));
        let f1 = value(&above_a_half(set).scores(), "f1", None).ok();
        same(f1, fraction(&exact["f1_at_0.5_strict"]), name(set));
    }
}

#[test]
fn one_class_in_truth_has_no_roc_auc_and_no_positive_no_average_precision() {
    let mut negatives = Ranking::default();
    negatives
        .push_rows("clip", &[0.1, 0.2], &[false; 2])
        .expect("scores");
    let scores = negatives.scores();
    assert_eq!(value(&scores, "roc_auc", None), Err(Undefined::OneClass));
    assert_eq!(
        value(&scores, "average_precision", None),
        Err(Undefined::NoPositive)
    );
    let mut positives = Ranking::default();
    positives
        .push_rows("clip", &[0.1, 0.2], &[true; 2])
        .expect("scores");
    let scores = positives.scores();
    assert_eq!(value(&scores, "roc_auc", None), Err(Undefined::OneClass));
    assert_eq!(value(&scores, "average_precision", None), Ok(1.0));
    for score in Ranking::default().scores() {
        assert_eq!(score.estimate.value, Err(Undefined::Empty));
    }
}

#[test]
fn equal_scores_rank_nothing_and_are_flagged() {
    let mut equal = Ranking::default();
    let is_positive = [false, true, true, false, true];
    equal
        .push_rows("clip", &[0.7; 5], &is_positive)
        .expect("scores");
    let scores = equal.scores();
    assert_eq!(value(&scores, "roc_auc", None), Ok(0.5));
    let precision = score(&scores, "average_precision", None);
    assert_eq!(
        precision.estimate.value.ok(),
        precision.estimate.of_constant
    );
    assert_eq!(precision.flags, [ScoreFlag::AllScoresEqual]);
}

#[test]
fn log_odds_are_ranked_and_flagged() {
    let mut log_odds = Ranking::default();
    let is_positive = [false, true, true];
    log_odds
        .push_rows("clip", &[-3.5, 2.0, 7.25], &is_positive)
        .expect("scores");
    let scores = log_odds.scores();
    assert_eq!(value(&scores, "roc_auc", None), Ok(1.0));
    assert_eq!(scores[0].flags, [ScoreFlag::OutsideUnit]);
    log_odds.push("clip", 1.0, true).expect("a score");
    assert!(log_odds.scores()[0].flags.is_empty());
}

#[test]
fn both_zeros_are_one_score() {
    let mut zeros = Ranking::default();
    zeros
        .push_rows("clip", &[0.0, -0.0], &[false, true])
        .expect("scores");
    let scores = zeros.scores();
    assert_eq!(value(&scores, "roc_auc", None), Ok(0.5));
    assert_eq!(scores[0].flags, [ScoreFlag::AllScoresEqual]);
}

/// 65,537 different scores in shuffled order. Every third sample is positive.
fn many() -> (Vec<f64>, Vec<bool>) {
    let scores = (0..65_537_u32).map(|row| f64::from(row * 7919 % 65_537) / 131_074.0);
    let is_positive = (0..65_537_u32).map(|row| row % 3 == 0);
    (scores.collect(), is_positive.collect())
}

#[test]
fn many_different_scores_are_rounded_to_a_grid_in_any_order_and_any_merge() {
    let (scores, is_positive) = many();
    let mut at_once = Ranking::default();
    at_once
        .push_rows("clip", &scores, &is_positive)
        .expect("scores");
    assert_eq!(at_once.scores()[0].flags, [ScoreFlag::ScoresOnGrid]);
    // Without the last score none is rounded.
    let mut all_but_one = Ranking::default();
    all_but_one
        .push_rows("clip", &scores[1..], &is_positive[1..])
        .expect("scores");
    assert!(all_but_one.scores()[0].flags.is_empty());
    all_but_one
        .push("clip", scores[0], is_positive[0])
        .expect("a score");
    assert_eq!(all_but_one, at_once);
    // Halves below the limit, merged both ways.
    let half = |rows: std::ops::Range<usize>| {
        let mut half = Ranking::default();
        half.push_rows("clip", &scores[rows.clone()], &is_positive[rows])
            .expect("scores");
        half
    };
    let [first, second] = [half(0..30_000), half(30_000..65_537)];
    assert_eq!(first.clone().merge(second.clone()), at_once);
    assert_eq!(second.merge(first), at_once);
    // A state on the grid, merged with one that is not.
    let mut other = Ranking::default();
    other.push("clip 2", 0.3, true).expect("a score");
    assert_eq!(at_once.clone().merge(other.clone()), other.merge(at_once));
}

#[test]
fn the_grid_moves_the_curves_by_less_than_a_thousandth() {
    let (scores, is_positive) = many();
    let mut on_grid = Ranking::default();
    on_grid
        .push_rows("clip", &scores, &is_positive)
        .expect("scores");
    let mut exact = Ranking::default();
    exact
        .push_rows("clip", &scores[1..], &is_positive[1..])
        .expect("scores");
    for (on_grid, exact) in on_grid.scores().iter().zip(exact.scores()) {
        let [on_grid, exact] =
            [on_grid, &exact].map(|score| score.estimate.value.expect("both classes"));
        assert!((on_grid - exact).abs() < 1e-3, "{on_grid} {exact}");
    }
}

#[test]
fn the_intervals_of_a_ranking_leave_out_each_stroke() {
    // Scores and classes of a stroke, with equal scores within strokes and between them.
    let stroke = |number: u32| -> [Vec<f64>; 2] {
        let frames = 0..4 + number % 3;
        let of = |frame: u32| (frame * 5 + number * 3) % 7;
        let scores = frames.clone().map(|frame| f64::from(of(frame)));
        let classes = frames.map(|frame| f64::from((of(frame) + frame * number) % 3));
        [scores.collect(), classes.collect()]
    };
    let of = |left_out: Option<u32>| {
        let mut ranking = Ranking::default();
        for number in (0..8).filter(|number| Some(*number) != left_out) {
            let [scores, classes] = stroke(number);
            let classes: Vec<bool> = classes.iter().map(|class| *class > 0.5).collect();
            let pushed = ranking.push_rows(&number.to_string(), &scores, &classes);
            pushed.expect("scores");
        }
        ["roc_auc", "average_precision"]
            .map(|metric| score(&ranking.scores(), metric, None).estimate.clone())
    };
    for (metric, found) in of(None).into_iter().enumerate() {
        let without = (0..8).map(|number| {
            let value = of(Some(number))[metric].value.expect("both classes");
            LeftOut::new(stroke(number)[0].len() as u64, Ok(value))
        });
        let value = found.value.expect("both classes");
        let without: Vec<LeftOut> = without.collect();
        let expected = Interval::jackknife(value, Range::Ratio, &without, ClusteredBy::Group);
        let ends = |interval: Interval| interval.ends().expect("eight strokes");
        let [found, expected] = [found.interval, expected].map(ends);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}
