//! Differences of models with several trainings: examples worked out independently of this program.

use taceva_core::random::Draws;
use taceva_metrics::{
    ClusterSums, Difference, DifferenceTest, Estimate, Scale, Sides, SignFlip, StatedInterval,
    TrainingSpread, by_intervals, paired_over_trainings,
};

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

fn spread(values: &[f64]) -> TrainingSpread {
    TrainingSpread::of_one(values).expect("at least two trainings")
}

/// Difference between `estimate` and a constant without uncertainty.
fn from_constant(estimate: Estimate, constant: f64) -> Difference {
    let b = Estimate::try_new(constant, 0.0, 30).expect("an estimate");
    by_intervals(Sides { a: estimate, b }).expect("A varies")
}

fn stated(value: f64, ends: [f64; 2], freedom: f64, scale: Scale) -> Estimate {
    let stated = StatedInterval::new(ends, freedom, 30).on(scale);
    Estimate::try_from_interval(value, stated).expect("an estimate")
}

#[test]
fn the_variance_between_trainings_enters_interval_and_p_of_different_samples() {
    // A: 0.03 between ten points (ν = 9) and √((0.04² + 0.04²) / 2) = 0.04 between three trainings (ν = 2).
    // Together √(0.0009 + 0.0016) = 0.05 with ν = 0.05⁴ / (0.03⁴ / 9 + 0.04⁴ / 2) = 6.25e-6 / 1.37e-6 = 4.562.
    // B: 0.05 between six points (ν = 5). Each interval by Student's t, put together and inverted with mpmath.
    let a = Estimate::try_new(0.5, 0.03, 10).expect("an estimate");
    let b = Estimate::try_new(0.7, 0.05, 6).expect("an estimate");
    let alone = by_intervals(Sides { a, b }).expect("both vary");
    let a = a.over_trainings(spread(&[0.5, 0.54, 0.46]));
    let difference = by_intervals(Sides { a, b }).expect("both vary");
    near(difference.standard_error, 0.005_f64.sqrt());
    near(difference.interval[0], -0.384_475_168_321_997);
    near(difference.interval[1], -0.015_524_831_678_003_3);
    near(difference.p, 0.038_785_299_839_171_8);
    assert!(alone.p < difference.p && alone.interval[1] < difference.interval[1]);
    let DifferenceTest::Intervals { freedom } = difference.test else {
        panic!("{:?}", difference.test);
    };
    near(freedom.a, 625.0 / 137.0);
    near(freedom.b, 5.0);
}

#[test]
fn an_error_and_a_skill_take_the_variance_between_trainings_to_their_scale() {
    // The logarithm of 0.5 has 0.2 between points (ν = 10) and 0.075 / 0.5 = 0.15 between trainings (ν = 2): 0.25 with
    // ν = 0.25⁴ / (0.2⁴ / 10 + 0.15⁴ / 2) = 0.00390625 / 0.000413125 = 9.4554. The ends are 0.5 e^(±0.25 t).
    let ends = [0.320_211_055_884_3, 0.780_735_066_469_194];
    let error = stated(0.5, ends, 10.0, Scale::Logarithm);
    let error = from_constant(error.over_trainings(spread(&[0.5, 0.575, 0.425])), 0.1);
    near(error.interval[0], 0.285_200_801_201_871 - 0.1);
    near(error.interval[1], 0.876_575_377_581_233 - 0.1);
    // What is left to 1 of a skill of 0.9: 0.3 between points (ν = 8), 0.04 / 0.1 = 0.4 between trainings: 0.5 with
    // ν = 0.5⁴ / (0.3⁴ / 8 + 0.4⁴ / 2) = 0.0625 / 0.0138125 = 4.5249. The ends are 1 − 0.1 e^(±0.5 t).
    let t = 2.306_004_135_204_166;
    let ends = [0.3, -0.3].map(|step: f64| 1.0 - 0.1 * (step * t).exp());
    let skill = stated(0.9, ends, 8.0, Scale::Logarithm);
    let skill = from_constant(skill.over_trainings(spread(&[0.9, 0.94, 0.86])), 0.0);
    near(skill.interval[0], 0.623_042_235_897_7);
    near(skill.interval[1], 0.973_471_829_068_664);
}

#[test]
fn a_share_has_fewer_effective_samples_over_trainings() {
    // Wilson's interval of 0.8 of 100 samples (ν = 20). Trainings of 0.8, 0.9 and 0.7: 1/n′ = 1/100 + 0.1² / (0.8 × 0.2) = 0.0725,
    // ν = 0.0725² / (0.01² / 20 + 0.0625² / 2) = 2.6843. Wilson's interval of n′ samples with that t, by mpmath.
    let ends = [0.704_857_820_658_302, 0.870_123_348_570_273];
    let share = stated(0.8, ends, 20.0, Scale::Wilson);
    let share = from_constant(share.over_trainings(spread(&[0.8, 0.9, 0.7])), 0.5);
    near(share.interval[0], 0.359_939_384_169_431 - 0.5);
    near(share.interval[1], 0.966_046_366_768_468 - 0.5);
}

/// Sums of five points, whose differences are −0.1, −0.2, −0.2, −0.05 and −0.1.
fn five_points() -> Sides<ClusterSums> {
    let mut sums: Sides<ClusterSums> = Sides::default();
    let errors = [(0.1, 0.2), (0.2, 0.4), (0.1, 0.3), (0.3, 0.35), (0.2, 0.3)];
    for (point, (error_a, error_b)) in errors.into_iter().enumerate() {
        let point = format!("p{point}");
        sums.a.try_add(&point, error_a).expect("finite");
        sums.b.try_add(&point, error_b).expect("finite");
    }
    sums
}

#[test]
fn the_variance_between_trainings_enters_interval_and_p_of_the_same_samples() {
    // Mean −0.13; squares 0.0009 + 0.0049 + 0.0049 + 0.0064 + 0.0009 = 0.018, √(0.018 / (5 × 4)) = 0.03 (ν = 4).
    // With 0.04 between three trainings of one model (ν = 2): √(0.0009 + 0.0016) = 0.05,
    // ν = 6.25e-6 / (8.1e-7 / 4 + 2.56e-6 / 2) = 4.2159, t = 2.6; p and interval of Student's t by mpmath.
    let sums = five_points();
    let both = Sides {
        a: &sums.a,
        b: &sums.b,
    };
    let spread = spread(&[0.18, 0.22, 0.14]);
    let difference = paired_over_trainings(both, &[spread]).expect("five points");
    near(difference.value, -0.13);
    near(difference.standard_error, 0.05);
    near(difference.p, 0.056_989_172_236_165_5);
    near(difference.interval[0], -0.266_063_551_393_381);
    near(difference.interval[1], 0.006_063_551_393_381_22);
    assert!(!difference.is_shown);
    let DifferenceTest::PairedTrainings { clusters, freedom } = difference.test else {
        panic!("{:?}", difference.test);
    };
    assert_eq!(clusters, 5);
    near(freedom, 6.25 / 1.4825);
    assert_eq!(
        difference.test.to_string(),
        "paired t by cluster with the variance between trainings, G=5"
    );
    // The order of independent parts changes nothing but roundings, and equivalence is the same distribution.
    near(difference.equivalence_p(0.13).expect("a margin"), 0.5);
    let within = difference.equivalence_p(0.26).expect("a margin");
    near(within, difference.p / 2.0);
}

#[test]
fn trainings_that_agree_change_no_bit_of_a_comparison() {
    let a = Estimate::try_new(0.5, 0.03, 10).expect("an estimate");
    let same = a.over_trainings(spread(&[0.5, 0.5, 0.5]));
    assert_eq!(a, same);
    // The sum of three 0.1 is not three times 0.1.
    assert!(!spread(&[0.1; 3]).varies() && !spread(&[0.7; 3]).varies());
    assert_eq!(a, a.over_trainings(spread(&[0.1; 3])));
    let sums = five_points();
    let both = Sides {
        a: &sums.a,
        b: &sums.b,
    };
    let clusters = paired_over_trainings(both, &[]).expect("five points");
    let agreeing = paired_over_trainings(both, &[spread(&[0.2, 0.2])]).expect("five points");
    assert_eq!(clusters, agreeing);
    let flips = SignFlip::default().test(both).expect("five points");
    assert_eq!(
        clusters.standard_error.to_bits(),
        flips.standard_error.to_bits()
    );
}

#[test]
fn without_any_variance_there_is_no_answer() {
    let mut sums: Sides<ClusterSums> = Sides::default();
    for point in 0..6 {
        sums.a.try_add(&point.to_string(), 0.25).expect("finite");
        sums.b.try_add(&point.to_string(), 0.5).expect("finite");
    }
    let both = Sides {
        a: &sums.a,
        b: &sums.b,
    };
    let error = paired_over_trainings(both, &[]).expect_err("no spread");
    assert_eq!(error.to_string(), "neither score varies between clusters");
    let known = paired_over_trainings(both, &[spread(&[0.25, 0.75])]);
    // √(0.125) with one degree of freedom.
    near(
        known.expect("trainings vary").standard_error,
        0.125_f64.sqrt(),
    );
    assert_eq!(TrainingSpread::of_one(&[0.5]), None);
    assert_eq!(TrainingSpread::of_mean(&[0.5, f64::NAN]), None);
}

#[test]
fn without_a_true_difference_at_most_one_in_twenty_is_shown() {
    // Twenty points and three trainings a side, all normal; the trainings scatter 4.5 times as much as the mean of the points.
    let side = |draws: Draws, is_over: bool| {
        let points: Vec<f64> = (0..20).map(|counter| draws.normal(counter)).collect();
        let mean = points.iter().sum::<f64>() / 20.0;
        let squares = points.iter().map(|point| (point - mean) * (point - mean));
        let error = (squares.sum::<f64>() / 19.0 / 20.0).sqrt();
        let scores = [20, 21, 22].map(|counter| mean + draws.normal(counter));
        let estimate = Estimate::try_new(scores[0], error, 20).expect("an estimate");
        match is_over {
            true => estimate.over_trainings(spread(&scores)),
            false => estimate,
        }
    };
    let shown = |is_over: bool| {
        let mut shown = 0;
        for run in 0..200 {
            let draws = Draws::new(2027).of(run);
            let difference = by_intervals(Sides {
                a: side(draws.of(1), is_over),
                b: side(draws.of(2), is_over),
            });
            shown += u32::from(difference.expect("both vary").is_shown);
        }
        shown
    };
    let (clusters, trainings) = (shown(false), shown(true));
    assert!(clusters > 80, "{clusters}");
    assert!(trainings <= 15, "{trainings}");
}
