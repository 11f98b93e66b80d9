#![doc = include_str!("../README.md")]

use taceva_core::{ForceTransducer, Lighting, Robot, Sensor};
use taceva_sim::{ForceTransducerFactory, LightingFactory, Model, RobotFactory, SensorFactory};

taceva_plugin::export_plugin! {
    id: "org.taceva.sim",
    drivers: [
        dyn Sensor => || Ok(Box::new(SensorFactory::new(Model::ViTacTip)?)),
        dyn Sensor => || Ok(Box::new(SensorFactory::new(Model::MagicTac)?)),
        dyn Sensor => || Ok(Box::new(SensorFactory::new(Model::GelSight)?)),
        dyn Sensor => || Ok(Box::new(SensorFactory::new(Model::GelSightWm)?)),
        dyn Robot => || Ok(Box::new(RobotFactory::new()?)),
        dyn ForceTransducer => || Ok(Box::new(ForceTransducerFactory::new()?)),
        dyn Lighting => || Ok(Box::new(LightingFactory::new()?)),
    ],
}
