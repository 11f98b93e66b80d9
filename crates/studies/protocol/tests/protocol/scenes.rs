//! Tests of valid scenes, and of every kind of invalid scene.

mod certificates;
mod on_a_rig;
mod planning;
mod reading;
mod wanted_widths;
mod wear;

use taceva_core::{
    Axes, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts, Footprint, ForceFacts,
    Newton, RobotFacts, SensorFacts, Speed,
};
use taceva_protocol::{RigInfo, Scene, SourceInfo, plan};

const GOOD: &str = r#"scene_version = 1
name = "my gel"
[sensor]
driver = "sim/gelsight"
[robot]
driver = "sim/robot"
[force]
driver = "sim/force-transducer"
"#;

fn message(text: &str) -> String {
    Scene::parse("s.toml", text).expect_err("wrong").to_string()
}

/// Message for the valid scene with `line` added as line 9, which is wrong.
fn with(line: &str) -> String {
    message(&format!("{GOOD}{line}\n"))
}

fn descriptor(key: &'static str, facts: Facts) -> Descriptor {
    DescriptorSpec::new(DriverKey::fixed(key), key, DriverSource::Simulated, facts)
        .check()
        .expect("no contradiction")
}

fn rig() -> RigInfo {
    RigInfo {
        sensor: Some(descriptor(
            "sim/gelsight",
            Facts::Sensor(Box::new(
                SensorFacts::default()
                    .with_opaque(true)
                    .with_markers(true)
                    .with_footprint(Footprint::rectangle(8.0, 10.0, Some(1.0)).expect("lengths"))
                    .with_force_max(Newton(1.83)),
            )),
        )),
        robot: Some(descriptor(
            "sim/robot",
            Facts::Robot(
                RobotFacts::default().with_speed_max(Speed::try_new(100.0).expect("a speed")),
            ),
        )),
        force: Some(descriptor(
            "sim/force-transducer",
            Facts::Force(
                ForceFacts::default()
                    .with_axes(Axes::FORCE)
                    .with_force_max(Newton(5.0)),
            ),
        )),
        lighting: None,
    }
}

/// Text of the plans for the valid scene with `lines` added, on `rig`, or of the error.
fn planned(lines: &str, rig: RigInfo) -> String {
    let scene = Scene::parse("s.toml", &format!("{GOOD}{lines}\n")).expect("reads");
    let source = SourceInfo::Rig(Box::new(rig));
    match plan(&scene, |_| source.clone()) {
        Ok(plans) => plans.iter().map(ToString::to_string).collect(),
        Err(error) => error.to_string(),
    }
}
