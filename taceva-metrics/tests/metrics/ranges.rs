//! Every interval is within the range of its quantity and contains the value, for every metric of the catalogue and any samples.

use std::collections::BTreeSet;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, GratingKind, Nanometre, Phase, Readings, Sample,
    SampleSink, Stamp,
};
use taceva_metrics::{
    BootstrapEnds, Evaluation, Evaluator, Interval, IntervalMethod, MetricPlan, PoissonBootstrap,
    Range, SensorFacts, UndefinedReason, catalogue,
};

/// Every metric, for a sensor with all facts declared.
fn plan() -> MetricPlan {
    let fields: FieldSet = Field::ALL.into_iter().collect();
    let channels = Channels::new(Channel::SIX).expect("distinct channels");
    let facts = SensorFacts::default()
        .with_footprint(Some(Footprint::disc(12.5, Some(1.0)).expect("lengths")))
        .with_reference_scene("normal".to_owned());
    MetricPlan::new(&catalogue::ALL, channels, fields).with_facts(facts)
}

/// Kind of prediction errors.
#[derive(Clone, Copy, Debug)]
enum Errors {
    /// No errors.
    Perfect,
    /// The prediction is constant.
    Constant,
    /// The error is constant.
    Shifted,
    /// Errors at one location only.
    OnePoint,
    /// Mostly small errors, few large ones.
    HeavyTailed,
    /// Random errors.
    Spread,
}

#[derive(Clone, Debug)]
struct Recording {
    points: usize,
    errors: Errors,
    presses: Vec<[f64; 4]>,
    phases: bool,
}

impl Recording {
    fn samples(&self) -> Vec<Sample> {
        let presses = self.presses.iter().enumerate();
        let all = presses.flat_map(|(at, &[x, y, depth, noise])| {
            let point = at % self.points;
            let place = [
                (x * 7.0 + f64::from(narrow(point) * 3)) % 8.0,
                (y * 7.0) % 8.0,
            ];
            let truth = [
                place[0],
                place[1],
                depth,
                0.02 * x,
                0.02 * y,
                2.0 * depth * (1.0 + 0.3 * x),
            ];
            (0..2_u32).map(move |repeat| {
                let mut truth = truth;
                if self.phases && repeat == 1 {
                    // A gel pushes less during unloading.
                    truth[5] *= 0.8 + 0.1 * y;
                }
                let error = match self.errors {
                    Errors::Perfect | Errors::Constant => 0.0,
                    Errors::Shifted => 0.125,
                    Errors::OnePoint if point == 0 => 0.5 * noise,
                    Errors::OnePoint => 0.0,
                    Errors::HeavyTailed => 1e-6 / (1e-6 + noise.abs()).powi(3),
                    Errors::Spread => 0.3 * noise + 0.1 * f64::from(repeat) * x,
                };
                let predicted = match self.errors {
                    Errors::Constant => [0.25; 6],
                    _ => truth.map(|truth| truth + error),
                };
                let is_idle = at % 3 == 2;
                let spacing = Nanometre(500_000);
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "an error of a spacing, in whole nanometres"
                )]
                let off_nm = (error * 1e5) as i64;
                Sample::default()
                    .with_point_id(format!("p{point}"))
                    .with_unit_id(format!("unit {}", at % 2))
                    .with_scene_id(if repeat == 0 { "normal" } else { "S1" }.to_owned())
                    .with_depth_step(narrow(at / self.points))
                    .with_repeat(repeat)
                    .with_phase(self.phases.then_some(if repeat == 0 {
                        Phase::Load
                    } else {
                        Phase::Unload
                    }))
                    .with_stamp(Stamp {
                        valid_s: f64::from(narrow(at)) + 0.5 * f64::from(repeat),
                        received_s: None,
                    })
                    .with_kind(GratingKind::Line)
                    .with_spacing(spacing)
                    .with_predicted_spacing(Nanometre(spacing.0 + off_nm))
                    .with_intensity(100.0 + 20.0 * f64::from(repeat))
                    .with_truth(Readings::from_values(if is_idle {
                        [place[0], place[1], 0.0, 0.0, 0.0, 0.0]
                    } else {
                        truth
                    }))
                    .with_prediction(Readings::from_values(predicted))
            })
        });
        all.collect()
    }
}

fn narrow(at: usize) -> u32 {
    u32::try_from(at).expect("a small number")
}

fn recording() -> impl Strategy<Value = Recording> {
    let errors = prop_oneof![
        Just(Errors::Perfect),
        Just(Errors::Constant),
        Just(Errors::Shifted),
        Just(Errors::OnePoint),
        Just(Errors::HeavyTailed),
        Just(Errors::Spread),
    ];
    let points = prop_oneof![Just(5_usize), Just(6), Just(12), Just(13), Just(70)];
    let press = [-1.0..1.0, -1.0..1.0, 0.05..0.9, -1.0..1.0];
    (
        points,
        errors,
        prop::collection::vec(press, 15..160),
        any::<bool>(),
    )
        .prop_map(|(points, errors, presses, phases)| Recording {
            points,
            errors,
            presses,
            phases,
        })
}

fn evaluate(plan: &MetricPlan, samples: &[Sample]) -> Evaluation {
    let mut evaluator = Evaluator::new(plan);
    for sample in samples {
        evaluator.accept(sample).expect("the plan's channels");
    }
    evaluator.finish().expect("the plan's channels")
}

/// Fault of an interval, if any, and true if the score has an interval.
fn checked(
    what: &str,
    range: Range,
    value: Option<f64>,
    interval: &Interval,
) -> Result<bool, String> {
    let (Some(value), Some([low, high])) = (value, interval.ends()) else {
        return Ok(false);
    };
    let is_possible = range.holds(low) && range.holds(high);
    let holds_its_value = low <= value && value <= high;
    if is_possible && holds_its_value && low.is_finite() && high.is_finite() {
        Ok(true)
    } else {
        Err(format!("{what}: {value} ({low} … {high}) of {range:?}"))
    }
}

/// Names of scores and variants with an interval, or an error for the first invalid interval.
fn intervals(evaluation: &Evaluation) -> Result<BTreeSet<String>, String> {
    let mut found = BTreeSet::new();
    for (metric, label, score) in evaluation.scores() {
        let what = format!("{} {label}", metric.id);
        if checked(&what, metric.range, score.value.scalar(), &score.interval)? {
            found.insert(metric.id.to_owned());
        }
        for variant in &score.variants {
            let what = format!("{what} {}", variant.name);
            let Some(interval) = &variant.interval else {
                continue;
            };
            if checked(&what, variant.range, variant.value.scalar(), interval)? {
                found.insert(format!("{}.{}", metric.id, variant.name));
            }
        }
    }
    Ok(found)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 60,
        rng_seed: RngSeed::Fixed(2029),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn no_interval_leaves_the_range_of_its_quantity(recording in recording()) {
        let samples = recording.samples();
        for method in [
            IntervalMethod::Jackknife,
            IntervalMethod::PoissonBootstrap(PoissonBootstrap::default().with_replicates(39).with_seed(1).with_ends(BootstrapEnds::Normal)),
            IntervalMethod::PoissonBootstrap(PoissonBootstrap::default().with_replicates(39).with_seed(1).with_ends(BootstrapEnds::Percentile)),
        ] {
            let evaluation = evaluate(&plan().with_interval_method(method), &samples);
            prop_assert!(intervals(&evaluation).is_ok(), "{:?}", intervals(&evaluation));
        }
    }
}

#[test]
fn every_metric_that_can_have_an_interval_is_among_those_tried() {
    let presses: Vec<[f64; 4]> = (0..240)
        .map(|at| [0.37, 0.61, 0.83, 0.29].map(|step: f64| (f64::from(at) * step).fract()))
        .map(|[x, y, depth, noise]| {
            [
                2.0 * x - 1.0,
                2.0 * y - 1.0,
                0.05 + 0.85 * depth,
                2.0 * noise - 1.0,
            ]
        })
        .collect();
    let mut found = BTreeSet::new();
    // Every third press is without contact: at four of 12 points, or at all of 13.
    for (points, phases) in [(12, false), (12, true), (13, false)] {
        let recording = Recording {
            points,
            errors: Errors::Spread,
            presses: presses.clone(),
            phases,
        };
        let evaluation = evaluate(&plan(), &recording.samples());
        found.extend(intervals(&evaluation).expect("possible intervals"));
    }
    let metrics = catalogue::ALL.iter().map(|metric| metric.id);
    let absent: Vec<&str> = metrics.filter(|metric| !found.contains(*metric)).collect();
    // Maxima and scores of all times together have no interval. These samples lack light presses, and the surfaces that units are compared by.
    let expected = [
        "linearity",
        "crosstalk",
        "bias_level",
        "inter_sensor",
        "intrinsic",
        "detection_limit",
    ];
    assert!(absent.iter().all(|id| expected.contains(id)), "{absent:?}");
    assert_eq!(absent.len(), expected.len(), "{absent:?} {found:?}");
}

#[test]
fn a_greatest_value_has_no_interval_and_says_why() {
    let presses = (0..120)
        .map(|at| [0.37, 0.61, 0.83, 0.29].map(|step: f64| (f64::from(at) * step).fract()))
        .collect();
    let recording = Recording {
        points: 13,
        errors: Errors::Spread,
        presses,
        phases: false,
    };
    let samples = recording.samples();
    let bootstrap = PoissonBootstrap::default()
        .with_replicates(39)
        .with_seed(1)
        .with_ends(BootstrapEnds::Normal);
    let why = Interval::Undefined(UndefinedReason::Greatest);
    for method in [
        IntervalMethod::Jackknife,
        IntervalMethod::PoissonBootstrap(bootstrap),
    ] {
        let evaluation = evaluate(&plan().with_interval_method(method), &samples);
        let mut greatest = BTreeSet::new();
        for (metric, label, score) in evaluation.scores() {
            if score.value.scalar().is_some() && metric.range == Range::Greatest {
                assert_eq!(score.interval, why, "{} {label}", metric.id);
                greatest.insert(metric.id);
            }
            for variant in &score.variants {
                if variant.range == Range::Greatest {
                    assert_eq!(variant.interval, Some(why), "{} {label}", variant.name);
                    greatest.insert(&variant.name);
                }
            }
        }
        let found: Vec<&str> = greatest.into_iter().collect();
        assert_eq!(
            found,
            ["bias_level", "crosstalk", "greatest_deviation", "linearity"]
        );
    }
}
