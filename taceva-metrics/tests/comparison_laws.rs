//! What must hold whatever is compared: neither the order of samples nor the naming of the sides changes an answer.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_metrics::{ClusterSums, Difference, Sides, SignFlip, holm};

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
    let sign_flip = SignFlip { flips, seed: 5 };
    let sides = Sides {
        a: &sums.a,
        b: &sums.b,
    };
    sign_flip.test(sides).expect("enough clusters")
}

/// At least five clusters; values of every size, and such as make ties.
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

/// The p value by counting in whole numbers.
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
        prop_assert_eq!(test(&sums(&shuffled), 500), expected);
        let (left, right) = shuffled.split_at(cut.min(shuffled.len()));
        let (left, mut right) = (sums(left), sums(right));
        right.a.merge(&left.a);
        right.b.merge(&left.b);
        prop_assert_eq!(test(&right, 500), expected);
    }

    #[test]
    fn exchanging_the_sides_reverses_the_difference_and_keeps_its_p(samples in samples()) {
        let sums = sums(&samples);
        let there = test(&sums, 500);
        let back = test(&Sides { a: sums.b, b: sums.a }, 500);
        let mut reversed = there;
        reversed.value = -there.value;
        reversed.scores = Sides { a: there.scores.b, b: there.scores.a };
        reversed.interval = [-there.interval[1], -there.interval[0]];
        prop_assert_eq!(back, reversed);
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
