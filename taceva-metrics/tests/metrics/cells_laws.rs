//! Sums by press, unit, time or level are independent of splitting, order and merging, and states survive a file.

use crate::support::laws::{self, states};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, Phase, Readings, Sample, SampleSink, Stamp, Unit,
};
use taceva_metrics::{Evaluator, MetricError, MetricPlan, SensorFacts, State, catalogue};

const METRICS: [&str; 15] = [
    "repeatability",
    "signal_to_repeatability",
    "hysteresis",
    "inter_sensor",
    "intrinsic",
    "noise_equivalent_force",
    "zero_error",
    "detection_limit",
    "linearity",
    "crosstalk",
    "bias_level",
    "tolerance",
    "drift",
    "agreement",
    "tolerance_interval",
];

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 60,
        rng_seed: RngSeed::Fixed(2025),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn plan() -> MetricPlan {
    let surface = Channel::named("surface_z", Unit::Millimetre).expect("a plain name");
    let channels = Channels::new(Channel::SIX.into_iter().chain([surface])).expect("distinct");
    let wanted = catalogue::select(METRICS).expect("known names");
    let facts = SensorFacts::default()
        .with_footprint(Some(Footprint::disc(4.0, None).expect("a length")))
        .with_frame_size(Some([640, 480]));
    let available: FieldSet = Field::ALL.into_iter().collect();
    let plan = MetricPlan::new(&wanted, channels, available).with_facts(facts);
    assert_eq!(plan.kept().len(), METRICS.len());
    plan
}

/// Few distinct values, so that many are equal; sometimes a value of any magnitude, none, or NaN.
fn value() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        12 => (-8_i32..9).prop_map(|step| Some(f64::from(step) * 0.3)),
        2 => (-2.0..2.0).prop_map(Some),
        1 => any::<f64>().prop_map(Some),
        1 => Just(Some(-0.0)),
        1 => Just(None),
    ]
}

/// Samples of few points, units and times. Some samples have no point.
fn samples() -> impl Strategy<Value = Vec<Sample>> {
    let points = prop_oneof![4 => Just(3_u32), 1 => Just(100_u32)];
    (points, prop::bool::weighted(0.8)).prop_flat_map(|(points, all_named)| {
        let named = prop::bool::weighted(0.95).prop_map(move |named| named || all_named);
        let readings = || prop::collection::vec(value(), 7);
        let labels = (
            0..points,
            named,
            0_u32..3,
            0_u32..3,
            0_u32..4,
            any::<bool>(),
        );
        let sample = (readings(), readings(), labels);
        let sample = sample.prop_map(|(truth, prediction, labels)| {
            let (point, named, step, unit, time, load) = labels;
            let phase = if load { Phase::Load } else { Phase::Unload };
            Sample::default()
                .with_point_id(named.then(|| format!("point {point}")))
                .with_unit_id((unit > 0).then(|| format!("unit {unit}")))
                .with_depth_step(step)
                .with_repeat(step)
                .with_phase(phase)
                .with_stamp((time > 0).then(|| Stamp {
                    valid_s: f64::from(time) * 0.1,
                    received_s: None,
                }))
                .with_frame_digest(load.then(|| format!("{step}")))
                .with_truth(Readings::new(truth))
                .with_prediction(Readings::new(prediction))
        });
        prop::collection::vec(sample, 0..60)
    })
}

fn evaluator<'a>(samples: impl IntoIterator<Item = &'a Sample>) -> Evaluator {
    let mut evaluator = Evaluator::new(&plan());
    for sample in samples {
        evaluator.accept(sample).expect("the plan's channels");
    }
    evaluator
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_whole_equals_its_merged_parts(samples in samples(), cut in any::<prop::sample::Index>()) {
        laws::a_whole_equals_its_merged_parts(&samples, cut.index(samples.len() + 1), |samples| evaluator(samples));
    }

    #[test]
    fn one_by_one_and_backwards_is_the_same(samples in samples()) {
        let mut single = Evaluator::new(&plan());
        for sample in samples.iter().rev() {
            single.accept(sample).expect("the plan's channels");
            single.states().expect("the plan's channels");
        }
        prop_assert_eq!(states(single), states(evaluator(&samples)));
    }

    #[test]
    fn merging_is_commutative_and_associative_and_nothing_is_its_identity(
        a in samples(), b in samples(), c in samples(),
    ) {
        laws::merging_is_commutative_and_associative_and_nothing_is_its_identity([&a, &b, &c], |samples| evaluator(samples));
    }

    #[test]
    fn a_state_that_was_written_and_read_is_the_same(samples in samples()) {
        laws::a_state_that_was_written_and_read_is_the_same(&samples, |samples| evaluator(samples));
    }
}

#[test]
fn a_broken_state_is_refused_by_name_and_changes_nothing() {
    let sample = |phase, depth: f64, time: f64| {
        Sample::default()
            .with_point_id("a".to_owned())
            .with_unit_id("u".to_owned())
            .with_depth_step(1)
            .with_repeat(0)
            .with_phase(phase)
            .with_stamp(Stamp {
                valid_s: time,
                received_s: None,
            })
            .with_truth(Readings::from_values([
                0.0, 0.0, depth, 0.0, 0.0, depth, 0.25,
            ]))
            .with_prediction(Readings::from_values([depth; 7]))
    };
    let samples = [
        sample(Phase::Load, 0.5, 1.0),
        sample(Phase::Load, 1.0, 2.0),
        sample(Phase::Unload, 0.5, 3.0),
    ];
    let whole = serde_json::to_string(&states(evaluator(&samples))).expect("a state");
    let edits = [
        ("\"1:a\":", "\"x:a\":"),
        ("\"values\":[0.5,1.0]", "\"values\":[1.0,0.5]"),
        ("\"values\":[0.0,0.0,0.25]", "\"values\":[0.0,0.0]"),
        ("\"load\":", "\"sideways\":"),
        ("\"plain\":", "\"bare\":"),
        ("\"10\":{\"counts\":[1]", "\"10\":{\"counts\":[0]"),
        ("\"values\":[1.0,2.0,3.0]", "\"values\":[1.0,2.0,1e999]"),
    ];
    for (from, to) in edits {
        let broken = whole.replacen(from, to, 1);
        assert_ne!(broken, whole, "{from} is in {whole}");
        let Ok(read) = serde_json::from_str::<Vec<State>>(&broken) else {
            continue;
        };
        let refused = read.iter().any(|state| {
            let mut fresh = Evaluator::new(&plan());
            let outcome = fresh.merge_states(std::slice::from_ref(state));
            let malformed = matches!(outcome, Err(MetricError::Malformed { .. }));
            let untouched = states(fresh) == states(Evaluator::new(&plan()));
            malformed && untouched
        });
        assert!(refused, "{to} was taken");
    }
}
