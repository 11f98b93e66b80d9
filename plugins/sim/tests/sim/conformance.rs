//! Every device of the bench passes the conformance checks for drivers.

use taceva_conformance::{self as conformance, Trial};
use taceva_core::DriverKind;
use taceva_drivers::Drivers;
use taceva_sim::{ForceTransducerFactory, LightingFactory, Model, RobotFactory, SensorFactory};

#[test]
fn simulated_sensors_keep_the_contract() {
    for model in Model::ALL {
        let factory = SensorFactory::new(model).expect("a driver");
        let report = conformance::sensor(&factory, &Trial::with_arguments("seed=3;unit=1"));
        assert!(report.passed(), "{report}");
    }
}

#[test]
fn the_simulated_robot_keeps_the_contract() {
    let factory = RobotFactory::new().expect("a driver");
    let report = conformance::robot(&factory, &Trial::default());
    assert!(report.passed(), "{report}");
}

#[test]
fn the_simulated_transducer_keeps_the_contract() {
    let factory = ForceTransducerFactory::new().expect("a driver");
    let report = conformance::force(&factory, &Trial::default());
    assert!(report.passed(), "{report}");
}

#[test]
fn the_simulated_lamps_keep_the_contract() {
    let factory = LightingFactory::new().expect("a driver");
    let report = conformance::lighting(&factory, &Trial::default());
    assert!(report.passed(), "{report}");
}

#[test]
fn all_seven_devices_are_linked_in() {
    let drivers = Drivers::builtin().expect("no contradiction");
    for key in [
        "sim/vitactip",
        "sim/magictac",
        "sim/gelsight",
        "sim/gelsight-wm",
    ] {
        let descriptor = drivers.sensors.get(key).expect(key).descriptor();
        assert_eq!(descriptor.kind(), DriverKind::Sensor);
        assert!(descriptor.title().starts_with("simulated "));
    }
    assert!(drivers.robots.get("sim/robot").is_ok());
    assert!(drivers.forces.get("sim/force-transducer").is_ok());
    assert!(drivers.lightings.get("sim/lighting").is_ok());
}
