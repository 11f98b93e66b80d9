//! Devices through a child process give the same bytes as without one, and a failing child harms nothing.
//!
//! This program is its own child, so it has its own `main`.

#[path = "../support/built_in.rs"]
mod built_in;
mod delivery;
mod failure;
mod model;
mod odd;
#[path = "../support/runner.rs"]
mod runner;
mod urgent;

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use built_in::BuiltIn;
use taceva_core::{Deadline, DriverKey, ErrorKind};
use taceva_host::{ChildSession, ChildSpec, Patience, main_if_child_with};
use taceva_sim as _;

fn main() -> ExitCode {
    main_if_child_with(|_| match served() {
        Ok(session) => Ok(Arc::new(session)),
        Err(error) => Err((ErrorKind::Internal, error.to_string())),
    });
    let tests = [delivery::TESTS, failure::TESTS, model::TESTS, urgent::TESTS].concat();
    runner::run(&tests)
}

/// Drivers of the simulated bench, and misbehaving ones.
fn served() -> Result<BuiltIn, taceva_core::RegistryError> {
    let mut served = BuiltIn::new()?;
    served.sensors.add(Box::new(odd::OddSensorFactory::new()))?;
    served
        .robots
        .add(Box::new(odd::PatientRobotFactory::new()))?;
    served.fit = model::fit;
    served.load = model::load;
    Ok(served)
}

/// Deadline for calls that do not hang.
const LONG: Deadline = Deadline::after(Duration::from_secs(20));

/// Starts a child of this program with the timeouts `patience`.
fn child(patience: Patience) -> ChildSession {
    let mut spec = ChildSpec::new("org.example.test", Vec::new());
    spec.patience = patience;
    let served = served().expect("sound drivers");
    let mut arguments = BTreeMap::new();
    let mut note = |descriptor: &taceva_core::Descriptor| {
        arguments.insert(descriptor.key().clone(), descriptor.arguments().to_vec())
    };
    for factory in served.sensors.iter() {
        note(factory.descriptor());
    }
    for factory in served.robots.iter() {
        note(factory.descriptor());
    }
    for factory in served.force_transducers.iter() {
        note(factory.descriptor());
    }
    for factory in served.lightings.iter() {
        note(factory.descriptor());
    }
    let plugin = DriverKey::fixed("org.example.test");
    ChildSession::start(spec, plugin, arguments).expect("a child")
}
