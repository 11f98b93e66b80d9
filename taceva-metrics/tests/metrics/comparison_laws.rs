//! Laws of comparisons: the order of samples and the names of the sides do not change the answer.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_core::Unit;
use taceva_metrics::{
    Better, ClusterSums, Difference, DifferenceTest, Estimate, Question, Side, Sides, SignFlip,
    Verdict, by_intervals, decide, holm,
};

/// Errors of both models, by cluster.
type Samples = Vec<(u32, f64, f64)>;

fn sums<'a>(samples: impl IntoIterator<Item = &'a (u32, f64, f64)>) -> Sides<ClusterSums> {
    let mut sums: Sides<ClusterSums> = Sides::default();
    for (cluster, error_a, error_b) in samples {
        let name = format!("point {cluster}");
        sums.a.try_add(&name, *error_a).expect("finite");
        sums.b.try_add(&name, *error_b).expect("finite");
    }
    sums
}

fn test(sums: &Sides<ClusterSums>, flips: u32) -> Difference {
    let sign_flip = SignFlip::default().with_flips(flips).with_seed(5);
    let sides = Sides {
        a: &sums.a,
        b: &sums.b,
    };
    sign_flip.test(sides).expect("enough clusters")
}

/// Samples of at least five clusters, with values of any magnitude and many equal values.
fn samples() -> impl Strategy<Value = Samples> {
    let value = || {
        prop_oneof![
            0.0..2.0,
            (0_u8..4).prop_map(f64::from),
            0.0..1e-9,
            0.0..1e100
        ]
    };
    let rest = prop::collection::vec((0_u32..90, value(), value()), 0..150);
    let first = prop::collection::vec((value(), value()), 5);
    (first, rest).prop_map(|(first, rest)| {
        let first = (0..).zip(first).map(|(at, (a, b))| (at, a, b));
        first.chain(rest).collect()
    })
}

/// p value from counting sign patterns in whole numbers.
fn counted(differences: &[i64]) -> f64 {
    let observed = differences.iter().sum::<i64>().abs();
    let patterns = 0..1_u32 << differences.len();
    let as_large = patterns.clone().filter(|pattern| {
        let signed = differences.iter().enumerate();
        let sum: i64 = signed
            .map(|(at, difference)| {
                if pattern >> at & 1 == 1 {
                    -difference
                } else {
                    *difference
                }
            })
            .sum();
        sum.abs() >= observed
    });
    let as_large = u32::try_from(as_large.count()).expect("at most 2^9");
    f64::from(as_large) / f64::from(patterns.end)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 100,
        rng_seed: RngSeed::Fixed(2027),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_order_of_samples_and_of_merges_changes_nothing(
        (samples, shuffled) in samples().prop_flat_map(|samples| {
            (Just(samples.clone()), Just(samples).prop_shuffle())
        }),
        cut in 0_usize..150,
    ) {
        let expected = test(&sums(&samples), 500);
        prop_assert_eq!(&test(&sums(&shuffled), 500), &expected);
        let (left, right) = shuffled.split_at(cut.min(shuffled.len()));
        let (left, mut right) = (sums(left), sums(right));
        right.a.merge(&left.a);
        right.b.merge(&left.b);
        prop_assert_eq!(test(&right, 500), expected);
    }

    #[test]
    #[expect(clippy::float_cmp, reason = "the law holds to the bit, but for the sign of zero")]
    fn exchanging_the_sides_reverses_the_difference_and_keeps_its_p(samples in samples()) {
        let sums = sums(&samples);
        let there = test(&sums, 500);
        let back = test(&Sides { a: sums.b, b: sums.a }, 500);
        prop_assert_eq!(back.value, -there.value);
        prop_assert_eq!(back.scores, Sides { a: there.scores.b, b: there.scores.a });
        prop_assert_eq!(back.interval, [-there.interval[1], -there.interval[0]]);
        prop_assert_eq!((back.p, back.test, back.is_shown), (there.p, there.test, there.is_shown));
    }

    #[test]
    fn p_is_what_counting_in_whole_numbers_gives(
        differences in prop::collection::vec(-20_i8..20, 5..10),
        power in -60_i32..60,
    ) {
        let scale = 2.0_f64.powi(power);
        let samples: Samples = (0..)
            .zip(&differences)
            .map(|(cluster, difference)| (cluster, f64::from(*difference) * scale, 0.0))
            .collect();
        let whole: Vec<i64> = differences.iter().copied().map(i64::from).collect();
        prop_assert_eq!(test(&sums(&samples), 10_000).p.to_bits(), counted(&whole).to_bits());
    }

    #[test]
    fn verdict_p_and_interval_of_a_family_never_contradict_each_other(
        strangers in prop::collection::vec((-4.0..4.0, 0.0..1.0, 0.01..1.0, 5_usize..70, 5_usize..70), 0..12),
        flips in prop::collection::vec(prop::collection::vec((-9_i8..12, 1_u32..4), 5..16), 0..6),
        margin in prop_oneof![Just(None), (0.01..4.0).prop_map(Some)],
    ) {
        let of_strangers = strangers.iter().map(|&(apart, own, other, many, few)| {
            let a = Estimate::try_new(apart, own, many).expect("an estimate");
            let b = Estimate::try_new(0.0, other, few).expect("an estimate");
            by_intervals(Sides { a, b }).expect("one varies")
        });
        let of_the_same = flips.iter().map(|clusters| {
            let samples: Samples = (0..)
                .zip(clusters)
                .flat_map(|(cluster, &(difference, times))| {
                    (0..times).map(move |_| (cluster, f64::from(difference) / 8.0, 0.0))
                })
                .collect();
            test(&sums(&samples), 4000)
        });
        let mut family: Vec<Difference> = of_strangers.chain(of_the_same).collect();
        let raw = family.clone();
        decide(&mut family);
        let p_values: Vec<f64> = raw.iter().map(|difference| difference.p).collect();
        let adjusted = holm(&p_values).expect("p values");
        for ((decided, raw), adjusted_p) in family.iter().zip(&raw).zip(adjusted) {
            let [low, high] = decided.interval;
            prop_assert_eq!((decided.p, decided.adjusted_p), (raw.p, adjusted_p));
            prop_assert_eq!(decided.is_shown, adjusted_p <= 0.05);
            prop_assert!(low <= decided.value && decided.value <= high);
            prop_assert!(decided.confidence >= raw.confidence);
            // An interval that ends at 0 has a p value equal to the level.
            let excludes = low >= 0.0 || high <= 0.0;
            let includes = low <= 0.0 && high >= 0.0;
            prop_assert!(if decided.is_shown { excludes } else { includes }, "{:?}", decided);
            let question = Question::new(Unit::Newton, Better::Lower).with_margin(margin);
            match Verdict::of(Ok(decided.clone()), question) {
                Verdict::Differs { better, .. } => {
                    prop_assert!(decided.is_shown);
                    let lower = if decided.value < 0.0 { Side::A } else { Side::B };
                    prop_assert_eq!(better, Some(lower));
                }
                Verdict::NoDifferenceShown { .. } => prop_assert!(!decided.is_shown),
                Verdict::Equivalent { margin, .. } => {
                    prop_assert!(-margin < low && high < margin);
                }
                other => prop_assert!(false, "{other}"),
            }
        }
        // The clamp at 0 hides nothing: the middle of a symmetric interval is the difference, to nine digits.
        for difference in &family {
            let [low, high] = difference.interval;
            if matches!(difference.test, DifferenceTest::Intervals { .. }) && low.abs() > 0.0 && high.abs() > 0.0 {
                let half = (high - low) / 2.0;
                let is_centred = (low + half - difference.value).abs() <= 1e-9 * (1.0 + half);
                prop_assert!(is_centred, "{:?}", difference);
            }
        }
    }

    #[test]
    fn a_sign_flip_interval_ends_where_the_test_of_shifted_samples_changes_its_mind(
        clusters in prop::collection::vec(-40_i8..40, 6..10),
    ) {
        let shifted = |shift: f64| {
            let samples: Samples = (0..)
                .zip(&clusters)
                .map(|(cluster, &difference)| (cluster, f64::from(difference) - shift, 0.0))
                .collect();
            test(&sums(&samples), 10_000).p
        };
        let [low, high] = test(&sums(&(0..).zip(&clusters).map(|(cluster, &difference)| {
            (cluster, f64::from(difference), 0.0)
        }).collect::<Samples>()), 10_000).interval;
        let width = high - low;
        if low.is_finite() && high.is_finite() && width > 0.0 && low.abs() > 0.0 && high.abs() > 0.0 {
            let step = 1e-6 * width;
            prop_assert!(shifted(low + step) > 0.05 && shifted(high - step) > 0.05);
            prop_assert!(shifted(low - step) <= 0.05 && shifted(high + step) <= 0.05);
        }
    }

    #[test]
    fn adjusted_p_values_rise_with_p_and_are_never_smaller(
        p_values in prop::collection::vec(prop_oneof![0.0..1.0, Just(0.25), Just(0.01)], 0..20),
    ) {
        let adjusted = holm(&p_values).expect("p values");
        for (p, adjusted_p) in p_values.iter().zip(&adjusted) {
            prop_assert!(p <= adjusted_p && *adjusted_p <= 1.0);
            for (other, adjusted_other) in p_values.iter().zip(&adjusted) {
                prop_assert!(p > other || adjusted_p <= adjusted_other);
            }
        }
        let mut reversed: Vec<f64> = p_values.iter().rev().copied().collect();
        reversed = holm(&reversed).expect("p values");
        reversed.reverse();
        prop_assert_eq!(reversed, adjusted);
    }
}
