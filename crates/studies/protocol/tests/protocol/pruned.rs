//! Tests that a plan of fewer metrics skips presses, fields and channels, and changes no bit of the kept metrics.

use taceva_core::random::finalise;
use taceva_core::{
    Axes, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts, Footprint, ForceFacts,
    FrameInfo, GratingKind, Hertz, LightingFacts, Nanometre, Newton, PixelFormat, Readings,
    RobotFacts, Sample, SampleSink, Select, SensorFacts, Stamp,
};
use taceva_metrics::{
    Evaluation, Evaluator, Metric, MetricPlan, Score, Standing, Value, catalogue,
};
use taceva_protocol::{Motion, Plan, PlannedPress, RigInfo, Scene, SourceInfo, Specimen, plan};

const SCENE: &str = r#"
scene_version = 1
name = "pruned"
sensor = { driver = "test/gel", units = ["a", "b"] }
robot = { driver = "test/robot" }
force = { driver = "test/force" }
lighting = { driver = "test/light" }
model = { name = "ridge" }
[protocol]
calibration = { points = 12, indentations = 3 }
spatial = { points = 20 }
gratings = { step_mm = 0.5, presses = 3 }
lighting = { points = 8 }
repeatability = { points = 3, trials = 4, depth_step_mm = 0.25 }
hysteresis = { points = 6 }
surface = { points = 12 }
idle = { frames = 12 }
"#;

fn device(key: &'static str, facts: Facts) -> Option<Descriptor> {
    let spec = DescriptorSpec::new(DriverKey::fixed(key), key, DriverSource::Simulated, facts);
    Some(spec.check().expect("no contradiction"))
}

fn rig() -> RigInfo {
    let sensor = SensorFacts::default()
        .with_frame(FrameInfo {
            width: 4,
            height: 3,
            format: PixelFormat::Gray8,
        })
        .with_rate(Hertz(25.0))
        .with_opaque(false)
        .with_markers(true)
        .with_footprint(Footprint::rectangle(8.0, 10.0, Some(1.0)).expect("lengths"))
        .with_force_max(Newton(1.8));
    let force = ForceFacts::default().with_axes(Axes::FORCE);
    let scenes = ["normal", "S1", "S2"].map(str::to_owned).to_vec();
    RigInfo {
        sensor: device("test/gel", Facts::Sensor(Box::new(sensor))),
        robot: device("test/robot", Facts::Robot(RobotFacts::default())),
        force: device("test/force", Facts::Force(force)),
        lighting: device(
            "test/light",
            Facts::Lighting(LightingFacts::default().with_scenes(scenes)),
        ),
    }
}

/// Plan of a scene that requests the metrics `want`; of all metrics if `want` is empty.
fn planned(want: &[&str]) -> Plan {
    let metrics = match want {
        [] => String::new(),
        want => format!("[metrics]\nwant = {want:?}\n"),
    };
    let scene = Scene::parse("pruned", &format!("{SCENE}{metrics}")).expect("a scene");
    let source = SourceInfo::Rig(Box::new(rig()));
    plan(&scene, |_| source.clone()).expect("a plan").remove(0)
}

/// A simulated error from −1 to 1 that is fixed by the press, the number of the sample and the number `purpose`.
fn error(planned: &PlannedPress, number: u32, purpose: u64) -> f64 {
    let id = planned.id.to_string();
    let press = u64::from_str_radix(&id[..16], 16).expect("hexadecimal");
    let bits = finalise(press ^ finalise(u64::from(number) << 8 | purpose));
    f64::from(u32::try_from(bits >> 32).expect("32 bits")) / f64::from(1_u32 << 31) - 1.0
}

/// Samples of a press with every field and the channels of `plan`. Their forces are those of a linear spring.
fn samples(plan: &Plan, planned: &PlannedPress) -> Vec<Sample> {
    let press = &planned.press;
    let count = u32::try_from(press.samples()).expect("few");
    let sample = |number: u32| {
        let waypoint = press.waypoints().get(usize::try_from(number).expect("few"));
        let depth = waypoint.map_or(0.0, |waypoint| waypoint.depth.to_millimetres());
        let shear = waypoint.map_or([0.0; 2], |waypoint| {
            waypoint.shear.map(Nanometre::to_millimetres)
        });
        let [x, y] = press.place.map(Nanometre::to_millimetres);
        let value = |name: &str| match name {
            "Px" => Some(x + shear[0]),
            "Py" => Some(y + shear[1]),
            "Pz" => waypoint.map(|_| depth + 0.002 * error(planned, number, 1)),
            "Fx" => Some(0.6 * shear[0] + 0.004 * error(planned, number, 2)),
            "Fy" => Some(0.6 * shear[1] + 0.004 * error(planned, number, 3)),
            "Fz" => Some(1.4 * depth + 0.004 * error(planned, number, 4)),
            "surface_z" => (press.motion == Motion::Touch).then(|| 0.1 * error(planned, number, 5)),
            _ => None,
        };
        let truth: Vec<Option<f64>> = plan.channels.iter().map(|name| value(name)).collect();
        let predicted = (6..).zip(&truth);
        let predicted = predicted.map(|(purpose, value)| {
            value.map(|value| value + 0.05 * error(planned, number, purpose))
        });
        let (kind, spacing): (Option<GratingKind>, Option<Nanometre>) = match press.specimen {
            Specimen::Grating { kind, spacing } => (Some(kind), Some(spacing)),
            Specimen::Sphere { .. } => (None, None),
        };
        let moment = f64::from(number) + 0.1 * error(planned, number, 20);
        Sample::new(format!("{}/{number}", planned.id))
            .with_unit_id(press.unit.clone())
            .with_scene_id(press.light.clone())
            .with_point_id(press.point_id())
            .with_depth_step(waypoint.map(|_| number))
            .with_repeat(press.repeat)
            .with_phase(waypoint.map(|waypoint| waypoint.phase))
            .with_stamp(Stamp {
                valid_s: 0.04 * moment,
                received_s: None,
            })
            .with_kind(kind)
            .with_spacing(spacing)
            .with_predicted_spacing(spacing.map(|Nanometre(spacing)| {
                let off = 90_000.0 * error(planned, number, 21);
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "below a tenth of a millimetre"
                )]
                Nanometre(spacing + off as i64)
            }))
            .with_intensity(120.0 + 30.0 * error(planned, number, 22))
            .with_frame_digest(format!("sha256:{}{number}", planned.id))
            .with_prediction(Readings::new(predicted.collect()))
            .with_truth(Readings::new(truth))
    };
    (0..count).map(sample).collect()
}

/// Scores of `plan` on the simulated samples of its presses. Each metric reads only its own phase and the fields of the plan.
fn evaluate(plan: &Plan) -> Evaluation {
    let parts = plan.phases.iter().map(|phase| {
        let of_phase = plan.metrics.iter().filter(|metric| metric.phase == *phase);
        let metrics: Vec<&'static Metric> = of_phase
            .map(|metric| catalogue::find(&metric.id).expect("of the catalogue"))
            .collect();
        let metric_plan = MetricPlan::new(&metrics, plan.truth_channels(), plan.fields)
            .with_facts(plan.sensor_facts());
        let mut evaluator = Evaluator::new(&metric_plan);
        let mut sink = Select::new(&mut evaluator, plan.fields);
        for planned in plan.presses_of(*phase) {
            for sample in samples(plan, planned) {
                sink.accept(&sample).expect("of the channels of the plan");
            }
        }
        evaluator.finish().expect("all samples were taken in")
    });
    Evaluation::joined(parts, Vec::new())
}

#[test]
fn evaluate_of_pruned_equals_evaluate_of_everything() {
    let everything = planned(&[]);
    let of_everything = evaluate(&everything);
    let ids: Vec<&str> = catalogue::ALL.iter().map(|metric| metric.id).collect();
    assert_eq!(everything.metrics.len(), ids.len(), "{everything}");
    let alone = (0..ids.len()).map(|metric| 1_u64 << metric);
    let drawn = (1..=40).map(|seed| finalise(seed) & finalise(seed << 32));
    let (mut compared, mut fewer_fields, mut fewer_presses) = (0, 0, 0);
    for subset in alone.chain(drawn) {
        let is_wanted = |(place, _): &(usize, &&str)| subset >> place & 1 == 1;
        let wanted: Vec<&str> = ids
            .iter()
            .enumerate()
            .filter(is_wanted)
            .map(|(_, id)| *id)
            .collect();
        if wanted.is_empty() {
            continue;
        }
        let pruned = planned(&wanted);
        let kept: Vec<&str> = pruned
            .metrics
            .iter()
            .map(|metric| metric.id.as_str())
            .collect();
        assert_eq!(
            kept, wanted,
            "nothing that was asked for is left out, and nothing else is kept"
        );
        fewer_fields += usize::from(pruned.fields != everything.fields);
        fewer_presses += usize::from(pruned.presses.len() < everything.presses.len());
        let of_pruned = evaluate(&pruned);
        for id in &kept {
            assert!(
                of_pruned.scores().any(|(metric, ..)| metric.id == *id),
                "{id} of {wanted:?}"
            );
        }
        for (metric, channel, score) in of_pruned.scores() {
            let whole = of_everything.score(metric.id, channel);
            // Prints every digit, and the sign of zero.
            assert_eq!(
                format!("{:?}", Some(apart_from_standing(score))),
                format!("{:?}", whole.map(apart_from_standing)),
                "{} of {channel}, wanted {wanted:?}",
                metric.id
            );
            compared += 1;
        }
    }
    assert!(
        compared > 500 && fewer_fields > 40 && fewer_presses > 40,
        "{compared} {fewer_fields} {fewer_presses}"
    );
}

#[test]
fn scores_of_the_simulated_samples_are_numbers() {
    // Comparing scores that are undefined on both sides would show nothing.
    let evaluation = evaluate(&planned(&[]));
    // The samples have no frames, few presses are light, and surfaces are compared by a height alone.
    let without = |metric: &str, channel: &str| {
        ["intrinsic", "detection_limit"].contains(&metric) || channel == "surface_z"
    };
    let undefined: Vec<String> = evaluation
        .scores()
        .filter(|(metric, channel, _)| !without(metric.id, channel))
        .filter(|(_, _, score)| matches!(score.value, Value::Undefined(_)))
        .map(|(metric, channel, score)| format!("{} of {channel}: {:?}", metric.id, score.value))
        .collect();
    assert!(undefined.is_empty(), "{undefined:#?}");
}

/// Copy of `score` without its standing in verdicts, which depends on the skill metric that a study adds.
fn apart_from_standing(score: &Score) -> Score {
    let mut score = score.clone();
    score.standing = Standing::default();
    score
}
