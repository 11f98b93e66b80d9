//! A rig, a scene and metrics for planner tests.

use taceva_core::Field;
use taceva_core::{
    Axes, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts, FieldSet, Footprint,
    ForceFacts, FrameInfo, Hertz, LightingFacts, Newton, PixelFormat, RobotFacts, SensorFacts,
};

use crate::plan::collect::MetricNeeds;
use crate::source::RigInfo;

fn descriptor(key: &'static str, facts: Facts) -> Descriptor {
    DescriptorSpec::new(DriverKey::fixed(key), key, DriverSource::Simulated, facts)
        .check()
        .expect("no contradiction")
}

pub(crate) fn sensor() -> SensorFacts {
    SensorFacts::default()
        .with_frame(FrameInfo {
            width: 64,
            height: 48,
            format: PixelFormat::Rgb8,
        })
        .with_rate(Hertz(25.0))
        .with_opaque(false)
        .with_markers(true)
        .with_footprint(Footprint::rectangle(8.0, 10.0, Some(1.0)).expect("lengths"))
        .with_force_max(Newton(1.83))
}

pub(crate) fn rig_of(sensor: SensorFacts, axes: Axes) -> RigInfo {
    RigInfo {
        sensor: Some(descriptor("test/gel", Facts::Sensor(Box::new(sensor)))),
        robot: Some(descriptor(
            "test/robot",
            Facts::Robot(RobotFacts::default()),
        )),
        force: Some(descriptor(
            "test/force",
            Facts::Force(
                ForceFacts::default()
                    .with_axes(axes)
                    .with_force_max(Newton(20.0)),
            ),
        )),
        lighting: Some(descriptor(
            "test/light",
            Facts::Lighting(
                LightingFacts::default()
                    .with_scenes(["normal", "S1", "S2"].map(str::to_owned).to_vec()),
            ),
        )),
    }
}

/// Needs of the metrics in the TacEva paper.
pub(crate) fn paper_metrics() -> Vec<MetricNeeds> {
    let truth = FieldSet::EMPTY.with(Field::Truth);
    let cells = FieldSet::EMPTY.with(Field::Prediction).with(Field::Point);
    let spacing = FieldSet::EMPTY
        .with(Field::Kind)
        .with(Field::Spacing)
        .with(Field::PredictedSpacing);
    vec![
        MetricNeeds::new("mae", FieldSet::PAIRS, &[]),
        MetricNeeds::new("sr", spacing, &[]),
        MetricNeeds::new("sensitivity", truth, &["Px", "Py", "Pz", "Fz"]),
        MetricNeeds::new("r_spatial", FieldSet::PAIRS, &["Px", "Py", "Pz"]),
        MetricNeeds::new(
            "r_light",
            FieldSet::PAIRS.with(Field::Scene).with(Field::Intensity),
            &[],
        ),
        MetricNeeds::new("repeatability", cells.with(Field::DepthStep), &[]),
        MetricNeeds::new("hysteresis", truth.with(Field::Phase), &["Pz", "Fz"]),
        MetricNeeds::new(
            "inter_sensor",
            truth.with(Field::UnitId),
            &["Px", "Py", "surface_z"],
        ),
        MetricNeeds::new("intrinsic", FieldSet::EMPTY, &[]),
    ]
}

pub(crate) const SMALL: &str = r#"
scene_version = 1
name = "small"
[sensor]
driver = "test/gel"
units = ["a", "b"]
[model]
name = "ridge"
[protocol]
calibration = { points = 5, indentations = 4 }
spatial = { points = 6 }
gratings = { step_mm = 0.5, presses = 2 }
lighting = { points = 3 }
repeatability = { points = 2, trials = 3, depth_step_mm = 0.25 }
hysteresis = { points = 2 }
surface = { points = 4 }
idle = { frames = 10 }
"#;
