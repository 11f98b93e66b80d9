//! Comparison of two models or two sensors: published examples, and the resulting words.

use crate::support::rows::{Row, evaluate};
use taceva_core::Unit;
use taceva_metrics::{
    Better, ClusterSums, ComparisonError, Difference, DifferenceTest, Estimate, Question, Scale,
    Side, Sides, SignFlip, StatedInterval, Verdict, by_intervals, decide,
};

/// Additional hours of sleep of ten patients with each of two drugs (Student 1908, after Cushny and Peebles).
const SLEEP: Sides<[f64; 10]> = Sides {
    a: [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0],
    b: [1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4],
};

/// Mean and its standard error, by the textbook formula.
fn estimate(values: &[f64; 10]) -> Estimate {
    let mean = values.iter().sum::<f64>() / 10.0;
    let squares = values.iter().map(|value| (value - mean).powi(2));
    let variance = squares.sum::<f64>() / 9.0;
    Estimate::try_new(mean, (variance / 10.0).sqrt(), 10).expect("ten numbers")
}

fn sleep_of_strangers() -> Difference {
    let difference = by_intervals(Sides {
        a: estimate(&SLEEP.a),
        b: estimate(&SLEEP.b),
    });
    difference.expect("both vary")
}

fn by_patient(values: &[f64; 10]) -> ClusterSums {
    let mut sums = ClusterSums::default();
    for (patient, &value) in values.iter().enumerate() {
        sums.try_add(&format!("patient {patient}"), value)
            .expect("a number");
    }
    sums
}

fn sleep_of_patients() -> Difference {
    let (a, b) = (by_patient(&SLEEP.a), by_patient(&SLEEP.b));
    let difference = SignFlip::default().test(Sides { a: &a, b: &b });
    difference.expect("ten patients")
}

fn near(found: f64, expected: f64) {
    // Half of the last published decimal, or of a float's.
    assert!((found - expected).abs() < 5e-8, "{found} is not {expected}");
}

#[test]
fn intervals_of_two_means_give_the_interval_and_p_of_their_difference() {
    // Each mean ± t(9) × its standard error, combined and inverted independently with mpmath.
    let difference = sleep_of_strangers();
    near(difference.value, -1.58);
    near(difference.value / difference.standard_error, -1.860_813_47);
    near(difference.p, 0.095_689_32);
    near(difference.interval[0], -3.500_777_33);
    near(difference.interval[1], 0.340_777_33);
    let freedom = Sides { a: 9.0, b: 9.0 };
    assert_eq!(difference.test, DifferenceTest::Intervals { freedom });
    assert_eq!(difference.test.to_string(), "by the intervals of both");
}

#[test]
fn intervals_on_a_logarithmic_scale_are_inverted_on_it() {
    // Scores 0.5 and 0.9. Standard errors 0.2 and 0.25 of their logarithms, 10 and 5 degrees of freedom; by mpmath.
    let estimate = |value, ends, freedom| {
        let stated = StatedInterval::new(ends, freedom, 12).on(Scale::Logarithm);
        Estimate::try_from_interval(value, stated).expect("an estimate")
    };
    let difference = by_intervals(Sides {
        a: estimate(0.5, [0.320_211_055_884_3, 0.780_735_066_469_2], 10.0),
        b: estimate(0.9, [0.473_309_403_382_6, 1.711_354_125_253_3], 5.0),
    });
    let difference = difference.expect("both vary");
    near(difference.interval[0], -1.231_035_25);
    near(difference.interval[1], 0.110_761_24);
    near(difference.p, 0.113_831_82);
}

#[test]
fn intervals_that_cannot_be_are_refused() {
    let said = |value, ends, freedom| {
        let found = Estimate::try_from_interval(value, StatedInterval::new(ends, freedom, 12));
        found.expect_err("no interval").to_string()
    };
    assert_eq!(
        said(0.5, [0.6, 0.7], 11.0),
        "interval 0.6…0.7 of score 0.5, expected finite ends that enclose the score"
    );
    assert_eq!(
        said(0.5, [0.4, f64::INFINITY], 11.0),
        "interval 0.4…inf of score 0.5, expected finite ends that enclose the score"
    );
    assert_eq!(
        said(0.5, [0.4, 0.6], 0.5),
        "0.5 degrees of freedom, expected a finite number from 1 on"
    );
}

#[test]
fn the_paired_test_meets_the_published_interval_and_its_p_is_counted() {
    // No difference is positive and one is 0, so only 2 × 2 of the 2¹⁰ patterns give as large a sum.
    let difference = sleep_of_patients();
    near(difference.value, -1.58);
    // The 52nd of the 1,024 means of halves, from below and from above, counted independently.
    near(difference.interval[0], -7.4 / 3.0);
    near(difference.interval[1], -2.5 / 3.0);
    near(difference.p, 4.0 / 1024.0);
    let test = difference.test.to_string();
    assert_eq!(test, "paired sign flip by cluster, G=10, all 1024 flips");
}

#[test]
fn equivalence_is_two_one_sided_tests() {
    // Tails of t = (margin − 1.58) / 0.849091 with 9 degrees of freedom, by mpmath.
    let difference = sleep_of_strangers();
    for (margin, expected) in [
        (4.0, 0.009_542_93),
        (3.0, 0.064_390_46),
        (1.0, 0.744_123_40),
    ] {
        near(
            difference.equivalence_p(margin).expect("a margin"),
            expected,
        );
    }
    let on_the_bound = difference.equivalence_p(difference.value.abs());
    near(on_the_bound.expect("a margin"), 0.5);
    for margin in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(difference.equivalence_p(margin).is_err(), "{margin}");
    }
}

fn question(better: Better, margin: Option<f64>) -> Question {
    Question::new(Unit::Newton, better).with_margin(margin)
}

#[test]
fn verdicts_are_sentences() {
    let say = |difference, margin| {
        Verdict::of(Ok(difference), question(Better::Lower, margin)).to_string()
    };
    assert_eq!(
        say(sleep_of_patients(), None),
        "A better by 1.6 N (95 % 0.8…2.5, p = 0.004)"
    );
    assert_eq!(
        say(sleep_of_strangers(), None),
        "no difference shown (difference −1.6 N, 95 % −3.5…0.3)"
    );
    assert_eq!(
        say(sleep_of_strangers(), Some(4.0)),
        "equivalent within 4 N"
    );
    assert_eq!(
        say(sleep_of_strangers(), Some(0.5)),
        "no difference shown (difference −1.6 N, 95 % −3.5…0.3)"
    );
    let ratio = Question::new(Unit::One, Better::Higher);
    let sure = by_intervals(Sides {
        a: Estimate::try_new(0.75, 0.2, 32).expect("an estimate"),
        b: Estimate::try_new(2.33, 0.2, 32).expect("an estimate"),
    });
    assert_eq!(
        Verdict::of(sure, ratio).to_string(),
        "A worse by 1.6 (95 % 1.0…2.2, p < 0.001)"
    );
    let apart = Verdict::of(Ok(sleep_of_patients()), question(Better::Described, None));
    assert_eq!(
        apart.to_string(),
        "A and B differ by −1.6 N (95 % −2.5…−0.8, p = 0.004)"
    );
}

#[test]
fn which_side_is_better_follows_from_the_metric() {
    let difference = sleep_of_patients();
    let better = |difference: &Difference, better| {
        Verdict::of(Ok(difference.clone()), question(better, None)).better()
    };
    assert_eq!(better(&difference, Better::Lower), Some(Side::A));
    assert_eq!(better(&difference, Better::Higher), Some(Side::B));
    // Means 0.75 and 2.33: both above 0.
    assert_eq!(better(&difference, Better::NearZero), Some(Side::A));
    let (a, b) = (
        by_patient(&SLEEP.a.map(|hours| hours - 1.0)),
        by_patient(&SLEEP.b),
    );
    let apart = SignFlip::default().test(Sides { a: &a, b: &b });
    let apart = apart.expect("ten patients");
    assert_eq!(better(&apart, Better::NearZero), None);
    assert_eq!(better(&sleep_of_strangers(), Better::Lower), None);
}

#[test]
fn a_difference_that_is_one_of_many_needs_more_to_be_shown() {
    let mut family: Vec<Difference> = (0..20).map(|_| sleep_of_patients()).collect();
    decide(&mut family);
    let one = family.remove(0);
    assert!(one.interval[0] <= 0.0 && one.interval[1] >= 0.0, "{one:?}");
    assert!(one.confidence > 0.997 && one.adjusted_p > 0.05 && one.p < 0.05);
    let verdict = Verdict::of(Ok(one), question(Better::Lower, None));
    assert!(
        matches!(verdict, Verdict::NoDifferenceShown { .. }),
        "{verdict}"
    );
}

#[test]
fn scores_of_two_sensors_are_compared_by_their_own_intervals() {
    let rows = |factor: f64, points: u32| -> Vec<Row> {
        let row = |row| {
            Row::same(
                f64::from(row),
                f64::from(row) + factor * f64::from(row % 7),
                row % points,
            )
        };
        (0..400).map(row).collect()
    };
    let (a, b) = (evaluate(&rows(0.1, 50)), evaluate(&rows(0.3, 40)));
    let score = |evaluation: &taceva_metrics::Evaluation, metric| {
        evaluation.score(metric, "Fx").cloned().expect("a score")
    };
    let (mae_a, mae_b) = (score(&a, "mae"), score(&b, "mae"));
    let estimates = Estimate::try_from_scores(Sides {
        a: &mae_a,
        b: &mae_b,
    });
    let difference = by_intervals(estimates.expect("both have intervals")).expect("both vary");
    let [low, high] = difference.interval;
    assert!(low < difference.value && difference.value < high && high < 0.0);
    assert!(difference.p < 0.001, "{}", difference.p);
}

#[test]
fn what_cannot_be_compared_says_why() {
    let rows: Vec<Row> = (0..40)
        .map(|row| Row::same(1.0, f64::from(row), row % 8))
        .collect();
    let whole = evaluate(&rows);
    let score = |metric| whole.score(metric, "Fx").expect("a score");
    let said = |a, b| {
        let estimates = Estimate::try_from_scores(Sides { a, b });
        let verdict = Verdict::of(
            estimates.and_then(by_intervals),
            question(Better::Lower, None),
        );
        verdict.to_string()
    };
    assert_eq!(
        said(score("r2"), score("r2")),
        "no answer: A is undefined: constant truth"
    );
    assert_eq!(
        said(score("mae"), score("rmse")),
        "no answer: A is `mae/1 in N` and B is `rmse/2 in N`, expected the same quantity"
    );
    let few = evaluate(&rows[..4]);
    assert_eq!(
        said(score("mae"), few.score("mae", "Fx").expect("a score")),
        "no answer: B is undefined: 4 clusters, 5 are needed"
    );
    let same: Vec<Row> = (0..9).map(|row| Row::same(1.0, 1.25, row)).collect();
    let same = evaluate(&same);
    let constant = same.score("mae", "Fx").expect("a score");
    assert_eq!(
        said(constant, constant),
        "no answer: neither score varies between clusters"
    );
    assert_eq!(
        Estimate::try_new(1.0, -0.5, 9)
            .expect_err("no error")
            .to_string(),
        "standard error -0.5, expected a finite number from 0 on"
    );
    assert_eq!(
        Estimate::try_new(1.0, 0.5, 4),
        Err(ComparisonError::TooFewClusters { have: 4 })
    );
}

#[test]
fn the_smallest_and_the_largest_errors_are_squared_without_loss() {
    for scale in [1e-300, 1e-200, 1.0, 1e150] {
        let estimate = |value: f64, error: f64| {
            Estimate::try_new(value * scale, error * scale, 10).expect("numbers")
        };
        let difference = by_intervals(Sides {
            a: estimate(1.0, 0.3),
            b: estimate(3.0, 0.4),
        });
        let difference = difference.expect("both vary");
        near(difference.standard_error / scale, 0.5);
        // P(|t(9)| ≥ 4), by scipy.
        near(difference.p, 0.003_110_43);
    }
}

#[test]
fn success_rates_are_compared_board_by_board() {
    let boards = |hits: [u32; 6]| {
        let mut sums = ClusterSums::default();
        for (board, hits) in hits.into_iter().enumerate() {
            for press in 0..100 {
                sums.try_add(&format!("board {board}"), f64::from(u8::from(press < hits)))
                    .expect("0 or 1");
            }
        }
        sums
    };
    let (a, b) = (
        boards([90, 80, 70, 60, 50, 40]),
        boards([80, 75, 60, 50, 55, 30]),
    );
    let difference = SignFlip::default()
        .test(Sides { a: &a, b: &b })
        .expect("six boards");
    near(difference.scores.a, 390.0 / 600.0);
    near(difference.value, 40.0 / 600.0);
    // Differences 10, 5, 10, 10, −5, 10: sum 40 of 50. A sum is as large if the negated magnitudes add up to at most 5: none, or one of the
    // two fives. That is 3 of 2⁶ patterns, and as many reversed.
    near(difference.p, 6.0 / 64.0);
}
