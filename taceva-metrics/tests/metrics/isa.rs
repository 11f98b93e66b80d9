//! Every instruction set of the machine gives the same sums as adding numbers one by one.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_metrics::{ExactSum, Isa, PairSpec, PairSums, Paired, Stream, Streams};

/// Numbers of all kinds: typical, with any exponent, denormal, at the limits of valid samples, and NaN.
fn number() -> impl Strategy<Value = f64> {
    let scaled = |exponents: std::ops::Range<i32>| {
        (-2.0..2.0, exponents).prop_map(|(value, power): (f64, i32)| value * 2.0_f64.powi(power))
    };
    prop_oneof![
        20 => -2.0..2.0,
        6 => scaled(-20..20),
        3 => scaled(-1021..1021),
        1 => (0..1_u64 << 52).prop_map(f64::from_bits),
        1 => prop::sample::select(vec![
            0.0,
            -0.0,
            f64::from_bits(1),
            f64::MIN_POSITIVE,
            2.0_f64.powi(1021),
            -f64::from_bits(2.0_f64.powi(1021).to_bits() + 1),
            f64::MAX,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ]),
    ]
}

/// Columns of several blocks, with numbers mostly of one kind.
fn columns() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let any = prop::collection::vec([number(), number()], 0..80);
    let tame = prop::collection::vec([-2.0..2.0, -2.0..2.0], 0..1500);
    let near = prop::collection::vec((-2.0..2.0, -1e-3..1e-3), 0..1500);
    (any, tame, near, 0_u64..64).prop_map(|(any, tame, near, seed)| {
        let near = near.into_iter().map(|(y, error)| [y + error, y]);
        let mut rows: Vec<[f64; 2]> = tame.into_iter().chain(near).chain(any).collect();
        let mut state = seed;
        for last in (1..rows.len()).rev() {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            let other = usize::try_from(state >> 33).expect("31 bits") % (last + 1);
            rows.swap(last, other);
        }
        rows
    })
}

/// Adds numbers one by one.
fn scalar(rows: &[[f64; 2]], gate: f64) -> (u64, u64, Vec<ExactSum>, ExactSum) {
    let mut sums = vec![ExactSum::default(); Stream::ALL.len()];
    let mut gated = ExactSum::default();
    let (mut n, mut n_gated) = (0, 0);
    for &[estimate, reference] in rows {
        let pair = Paired {
            estimate,
            reference,
        };
        if !pair.is_valid() {
            continue;
        }
        n += 1;
        let residual = pair.residual();
        sums[Stream::Absolute as usize].add(residual.abs());
        sums[Stream::Residual as usize].add(residual);
        sums[Stream::Squared as usize].add_product(residual, residual);
        sums[Stream::Truth as usize].add(reference);
        sums[Stream::TruthSquared as usize].add_product(reference, reference);
        sums[Stream::Symmetric as usize].add(pair.symmetric_term());
        if reference.abs() >= gate {
            n_gated += 1;
            gated.add(pair.symmetric_term());
        }
    }
    (n, n_gated, sums, gated)
}

/// Set of streams whose bits are `number`.
fn streams(number: u32) -> Streams {
    let members = Stream::ALL.into_iter();
    let members = members.filter(|stream| number >> (*stream as u32) & 1 == 1);
    members.fold(Streams::NONE, |set, stream| set | Streams::of(&[stream]))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        rng_seed: RngSeed::Fixed(2026),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn blocks_on_every_instruction_set_lose_nothing(
        rows in columns(),
        wanted in 0_u32..64,
        gate in prop::sample::select(vec![None, Some(-1.0), Some(0.0), Some(0.5), Some(f64::NAN)]),
        lengths in prop::collection::vec(1_usize..3000, 1..6),
    ) {
        let (n, n_gated, sums, gated) = scalar(&rows, gate.unwrap_or(f64::NAN));
        let columns: Paired<Vec<f64>> = Paired {
            estimate: rows.iter().map(|row| row[0]).collect(),
            reference: rows.iter().map(|row| row[1]).collect(),
        };
        let streams = streams(wanted);
        for isa in Isa::available() {
            let spec = PairSpec::new(streams).with_gate(gate);
            let mut blocks = PairSums::with_isa(spec, isa).expect("it is available");
            let mut start = 0;
            for length in lengths.iter().cycle() {
                let end = (start + length).min(rows.len());
                blocks.update(Paired {
                    estimate: &columns.estimate[start..end],
                    reference: &columns.reference[start..end],
                });
                start = end;
                if start == rows.len() {
                    break;
                }
            }
            prop_assert_eq!(blocks.n(), n, "{}", isa);
            prop_assert_eq!(blocks.n() + blocks.n_invalid(), rows.len() as u64, "{}", isa);
            for stream in Stream::ALL {
                let expected = if streams.contains(stream) {
                    sums[stream as usize].to_canonical()
                } else {
                    ExactSum::default().to_canonical()
                };
                let found = blocks.sum(stream).to_canonical();
                prop_assert_eq!(found, expected, "{} {}", isa, stream.name());
            }
            if blocks.gate().is_some() {
                prop_assert_eq!(blocks.n_gated(), n_gated, "{}", isa);
                prop_assert_eq!(blocks.gated_sum().to_canonical(), gated.to_canonical());
            } else {
                prop_assert_eq!(blocks.n_gated(), 0, "{}", isa);
            }
        }
    }
}

#[test]
fn a_machine_refuses_what_it_has_not() {
    let spec = PairSpec::default();
    for isa in Isa::ALL {
        assert_eq!(PairSums::with_isa(spec, isa).is_ok(), isa.is_available());
    }
}
