//! Laws of the scores on every instruction set, and programs of random bytes.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_core::random::SplitMix64;
use taceva_metrics::bench::{Kernel, nasty_inputs, shuffled};
use taceva_metrics::{Isa, PairSpec, PairSums, Paired, Stream, Streams};

const PROGRAMS: u64 = 5000;

#[test]
fn no_program_of_random_bytes_panics() {
    let mut done = [0; 3];
    for seed in 0..PROGRAMS {
        let mut random = SplitMix64::new(seed);
        let length = random.below(200);
        let bytes: Vec<u8> = (0..length)
            .map(|_| random.next_u64().to_le_bytes()[0])
            .collect();
        let counts = crate::support::program::run(&bytes);
        done.iter_mut()
            .zip(counts)
            .for_each(|(all, count)| *all += count);
    }
    assert!(
        done.iter().all(|&count| count > 1000),
        "{done:?} batches, merges, states read back"
    );
}

#[test]
fn nasty_inputs_give_their_true_scores_in_every_order_on_every_instruction_set() {
    for (name, case) in nasty_inputs() {
        let columns = case.columns();
        let truth = Kernel::truth(columns.as_slices());
        assert!(truth.mae.is_some(), "{name}");
        for isa in Isa::available() {
            let exact = Kernel::Exact(isa);
            assert_eq!(exact.run(columns.as_slices()), truth, "{name} {isa}");
            for seed in 0..3 {
                let shuffled = shuffled(&columns, seed);
                assert_eq!(
                    exact.run(shuffled.as_slices()),
                    truth,
                    "{name} {isa} {seed}"
                );
            }
        }
    }
}

#[test]
fn more_rows_than_units_fit_into_a_word_are_settled_in_time() {
    // Every row holds the most units possible: 2^20 rows of the greatest value of its grid.
    const ROWS: usize = (1 << 20) + 7;
    let greatest = f64::from_bits(2.0_f64.to_bits() - 1);
    let columns = Paired {
        estimate: vec![0.0; ROWS],
        reference: vec![greatest; ROWS],
    };
    for isa in Isa::available() {
        let sums = sums(&columns, isa);
        let mut expected = taceva_metrics::ExactSum::default();
        expected.add_product(greatest, f64::from(u32::try_from(ROWS).expect("a million")));
        assert_eq!(sums.sum(Stream::Truth), expected, "{isa}");
        assert_eq!(sums.sum(Stream::Absolute), expected, "{isa}");
    }
}

fn sums(columns: &Paired<Vec<f64>>, isa: Isa) -> PairSums {
    let spec = PairSpec::new(Streams::ALL);
    let mut sums = PairSums::with_isa(spec, isa).expect("it is available");
    sums.update(columns.as_slices());
    sums
}

fn columns() -> impl Strategy<Value = Paired<Vec<f64>>> {
    // Multiples of 2^-20 up to 4: differences and small translations are exact.
    let value = (-(1_i32 << 22)..1 << 22).prop_map(|steps| f64::from(steps) * 2.0_f64.powi(-20));
    prop::collection::vec((value.clone(), value), 2..1400).prop_map(|rows| {
        let (estimate, reference) = rows.into_iter().unzip();
        Paired {
            estimate,
            reference,
        }
    })
}

fn mapped(columns: &Paired<Vec<f64>>, change: impl Fn(f64) -> f64 + Copy) -> Paired<Vec<f64>> {
    Paired {
        estimate: columns.estimate.iter().copied().map(change).collect(),
        reference: columns.reference.iter().copied().map(change).collect(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 60,
        rng_seed: RngSeed::Fixed(2026),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_power_of_two_scales_every_sum(columns in columns(), power in -480_i32..480) {
        let scale = 2.0_f64.powi(power);
        let scaled = mapped(&columns, |value| value * scale);
        for isa in Isa::available() {
            let (before, after) = (sums(&columns, isa), sums(&scaled, isa));
            for stream in [Stream::Absolute, Stream::Residual, Stream::Truth] {
                let expected = before.sum(stream).to_f64() * scale;
                prop_assert_eq!(after.sum(stream).to_f64().to_bits(), expected.to_bits());
            }
            for stream in [Stream::Squared, Stream::TruthSquared] {
                let expected = before.sum(stream).to_f64() * scale * scale;
                prop_assert_eq!(after.sum(stream).to_f64().to_bits(), expected.to_bits());
            }
        }
    }

    #[test]
    fn moving_truth_and_estimate_together_moves_no_error(columns in columns(), steps in -1000_i32..1000) {
        let offset = f64::from(steps) * 2.0_f64.powi(-4);
        let moved = mapped(&columns, |value| value + offset);
        for isa in Isa::available() {
            let (before, after) = (sums(&columns, isa), sums(&moved, isa));
            for stream in [Stream::Absolute, Stream::Residual, Stream::Squared] {
                prop_assert_eq!(before.sum(stream), after.sum(stream));
            }
            prop_assert_eq!(
                before.total_sum_of_squares().to_bits(),
                after.total_sum_of_squares().to_bits()
            );
        }
    }

    #[test]
    fn every_order_and_every_split_gives_the_same_sums(
        columns in columns(),
        seed in any::<u64>(),
        split in any::<prop::sample::Index>(),
    ) {
        let expected = sums(&columns, Isa::Portable);
        let shuffled = shuffled(&columns, seed);
        let at = split.index(shuffled.reference.len());
        for isa in Isa::available() {
            let mut parts = sums(&Paired::default(), isa);
            let ends = [(0, at), (at, shuffled.reference.len())];
            for (start, end) in ends {
                let part = Paired {
                    estimate: shuffled.estimate[start..end].to_vec(),
                    reference: shuffled.reference[start..end].to_vec(),
                };
                parts.try_merge(&sums(&part, isa)).expect("one specification");
            }
            prop_assert_eq!(&parts, &expected);
        }
    }
}
