//! Tests of predicted widths on results with random errors.

use taceva_core::Channel;
use taceva_core::random::{mix, unit};
use taceva_metrics::{Evaluator, Rows};

use super::*;

/// Result in which every press has a random error. The mean size of the errors differs between points, by up to the share `spread`.
fn report(points: u64, presses: u64, spread: f64, seed: u64) -> EvaluationReport {
    let mut table = "sample,point_id,Fz,Fz_predicted\n".to_owned();
    let (mut truths, mut predictions, mut names) = (Vec::new(), Vec::new(), Vec::new());
    for point in 0..points {
        let of_point = mix(seed ^ mix(point));
        let size = 0.1 * (1.0 + spread * (2.0 * unit(of_point) - 1.0));
        for press in 0..presses {
            let error = size * 2.0 * unit(mix(of_point ^ (press + 1)));
            table += &format!("{point}/{press},p{point},1.0,{:?}\n", 1.0 - error);
            truths.push(1.0);
            predictions.push(1.0 - error);
            names.push(format!("p{point}"));
        }
    }
    let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one channel");
    let rows = Rows::new().pairs(Channel::FZ, truths, predictions);
    evaluator
        .update_rows(rows.points(&names))
        .expect("rows of this channel");
    let evaluation = evaluator.finish().expect("scores");
    let mut report = EvaluationReport::of_arrays(&evaluation);
    report.samples = Some(Samples::read(&table).expect("a table"));
    report
}

fn wanted(metric: &str, channel: &str) -> WantedWidth {
    WantedWidth {
        metric: metric.to_owned(),
        channel: channel.to_owned(),
        width: 0.1,
    }
}

fn scored(report: &EvaluationReport) -> ScoredWidth {
    ScoredWidth::of(report, &wanted("mae", "Fz")).expect("a width")
}

#[test]
fn the_reached_width_is_that_of_the_interval_in_the_result() {
    let report = report(40, 4, 0.8, 1);
    for metric in WantedWidth::METRICS {
        let found = ScoredWidth::of(&report, &wanted(metric, "Fz")).expect("a width");
        let score = report.score(metric, "Fz").expect("scored");
        let [low, high] = score
            .interval
            .as_ref()
            .and_then(Interval::ends)
            .expect("ends");
        assert!((found.width() - (high / low - 1.0)).abs() < 1e-15);
        let reached = ScoredWidth::reached(&report, &wanted(metric, "Fz"));
        assert_eq!(reached, Ok(found.width()));
        assert_eq!(found.tested().points, 40);
        assert!((found.tested().samples - 4.0).abs() < 1e-12);
    }
}

#[test]
fn with_its_own_points_a_result_is_expected_to_have_its_own_width() {
    for points in [8, 40, 64, 400] {
        let found = scored(&report(points, 4, 0.8, points));
        let expected = found.expected(found.tested()).expect("enough points");
        assert!((expected / found.width() - 1.0).abs() < 1e-9, "{points}");
    }
}

#[test]
fn further_places_narrow_an_interval_more_than_presses_at_the_same_places() {
    let found = scored(&report(40, 4, 0.9, 3));
    let expected = |points, samples| {
        let tested = TestedPoints { points, samples };
        found.expected(tested).expect("enough points")
    };
    let (places, presses) = (expected(160, 4.0), expected(40, 16.0));
    assert!(places < presses, "{places} {presses}");
    assert!(presses < found.width(), "{presses}");
    let endless = expected(40, f64::INFINITY);
    assert!(0.0 < endless && endless < presses, "{endless} {presses}");
    // The logarithm of the ratio halves, apart from Student's t.
    let halved = places.ln_1p() / found.width().ln_1p();
    assert!(0.4 < halved && halved < 0.52, "{halved}");
}

#[test]
fn errors_of_one_size_everywhere_leave_all_to_chance_within_a_place() {
    let found = scored(&report(40, 50, 0.0, 5));
    let expected = |points, samples| {
        let tested = TestedPoints { points, samples };
        found.expected(tested).expect("enough points").ln_1p()
    };
    // Presses at the same places then help nearly as much as further places.
    let ratio = expected(40, 200.0) / expected(160, 50.0);
    assert!(0.9 < ratio && ratio < 1.5, "{ratio}");
}

#[test]
fn the_needed_points_reach_the_width_and_one_point_less_does_not() {
    let found = scored(&report(40, 4, 0.8, 7));
    let expected = |points| {
        let tested = TestedPoints {
            points,
            samples: 4.0,
        };
        found.expected(tested).expect("enough points")
    };
    for share in [2.0, 1.0, 0.8, 0.5, 0.2] {
        let width = share * found.width() * (1.0 + 1e-9);
        let needed = found.needed(width, 4.0, 100_000).expect("reached");
        assert!(expected(needed) <= width, "{share}: {needed}");
        let is_least = needed == LEAST_CLUSTERS || expected(needed - 1) > width;
        assert!(is_least, "{share}: {needed}");
        assert_eq!(found.needed(width, 4.0, needed), Some(needed));
        assert_eq!(found.needed(width, 4.0, needed - 1), None, "{share}");
    }
}

#[test]
fn a_width_is_never_reached_by_too_few_points() {
    let found = scored(&report(40, 4, 0.8, 9));
    let at_one_place = TestedPoints {
        points: 1,
        samples: f64::INFINITY,
    };
    assert_eq!(found.expected(at_one_place), None);
    assert_eq!(found.needed(10.0, 4.0, 4), None);
    assert_eq!(found.needed(1e-9, 4.0, 1_000_000), None);
}

/// Mean over 30 seeds of the logarithm of predicted width / reached width. Pilots have `points` contact points, the whole studies `others`.
fn bias(points: u64, others: u64) -> f64 {
    let ratio = |seed: u64| {
        let pilot = scored(&report(points, 4, 0.8, 2 * seed));
        let whole = scored(&report(others, 4, 0.8, 2 * seed + 1));
        let expected = pilot.expected(whole.tested()).expect("enough points");
        (expected.ln_1p() / whole.width().ln_1p()).ln()
    };
    (0..30).map(ratio).sum::<f64>() / 30.0
}

#[test]
fn a_pilot_predicts_the_width_of_more_points_without_bias() {
    // One prediction scatters by about 0.15.
    let bias = bias(20, 160);
    assert!(bias.abs() < 0.15, "{bias}");
}

#[test]
fn a_study_of_hashed_points_predicts_the_width_of_fewer_points_without_bias() {
    let bias = bias(400, 40);
    assert!(bias.abs() < 0.2, "{bias}");
}

#[test]
fn a_result_without_score_interval_or_samples_says_so() {
    let none = |report: &EvaluationReport, channel: &str| {
        let found = ScoredWidth::of(report, &wanted("mae", channel));
        found.expect_err("no width").to_string()
    };
    let few = report(4, 4, 0.8, 11);
    assert_eq!(none(&few, "Fx"), "no score `mae.Fx`");
    let few = none(&few, "Fz");
    assert!(few.starts_with("`mae.Fz` has no interval: "), "{few}");
    let bare = EvaluationReport {
        samples: None,
        ..report(8, 4, 0.8, 11)
    };
    assert_eq!(
        none(&bare, "Fz"),
        "the result has no table of samples, or the table names no contact points"
    );
    assert!(ScoredWidth::reached(&bare, &wanted("mae", "Fz")).is_ok());
}
