//! Drivers that behave as their arguments request, correctly or not.

mod bench;
mod changer;
mod estimator;
mod force;
mod lighting;
mod robot;
mod sensor;

use taceva_core::{
    ArgSpec, ArgValue, Changer, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverKey, DriverSource, ErrorKind, Facts, ForceTransducer, FrameInfo, Lighting, PixelFormat,
    Robot, Sensor,
};
use taceva_plugin::{EstimatorFactory, export_plugin};

use self::changer::ChangerMaker;
use self::estimator::MeanMaker;
use self::force::ForceMaker;
use self::lighting::LightingMaker;
use self::robot::RobotMaker;
use self::sensor::SensorMaker;

const KEY: DriverKey = DriverKey::fixed("test/device");
const FRAME: FrameInfo = FrameInfo {
    width: 4,
    height: 3,
    format: PixelFormat::Rgb8,
};

export_plugin! {
    id: "org.example.test",
    drivers: [
        dyn Sensor => || Ok(Box::new(SensorMaker::new()?)),
        dyn Robot => || Ok(Box::new(RobotMaker::new()?)),
        dyn ForceTransducer => || Ok(Box::new(ForceMaker::new()?)),
        dyn Lighting => || Ok(Box::new(LightingMaker::new()?)),
        dyn Lighting => || Ok(Box::new(LightingMaker::on_a_port()?)),
        dyn Changer => || Ok(Box::new(ChangerMaker::new()?)),
        dyn EstimatorFactory => || Box::new(MeanMaker::new()),
    ],
}

fn descriptor(
    word: &'static str,
    facts: Facts,
    arguments: Vec<ArgSpec>,
) -> Result<Descriptor, DescriptorError> {
    let key = format!("test/{word}").parse().expect("a key");
    DescriptorSpec::new(key, word, DriverSource::Simulated, facts)
        .arguments(arguments)
        .check()
}

fn way() -> Vec<ArgSpec> {
    let ways = [
        "well",
        "panic",
        "nan",
        "refuse",
        "block",
        "panic-at-drop",
        "numbered",
    ];
    vec![ArgSpec::choice("way", ways).default(ArgValue::Text("well".to_owned()))]
}

fn error(kind: ErrorKind) -> DriverError {
    DriverError::new(kind, &KEY, "do it")
}
