//! An emulated arm, and the driver that is connected to it.

use taceva_core::{Factory, Rig, Robot};
use taceva_drivers::XarmFactory;
use taceva_wire::xarm::{Emulator, Port, Ports};
use taceva_wire::{BenchOptions, WallBench};

/// An arm over a quiet gel.
pub(crate) struct Setup {
    pub(crate) bench: WallBench,
    pub(crate) arm: Emulator,
}

pub(crate) fn setup(ports: Ports) -> Setup {
    let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a bench");
    let arm = Emulator::start(&bench, ports).expect("an arm");
    Setup { bench, arm }
}

impl Setup {
    /// The arguments of the driver for this arm.
    pub(crate) fn arguments(&self) -> String {
        let port = |port| self.arm.address(port).port();
        let [command, pose, status] = [Port::Command, Port::Pose, Port::Status].map(port);
        // Where a port of reports is missing, one is named at which nobody listens.
        let [pose, status] = [pose, status].map(|port| if port == command { 1 } else { port });
        format!(
            "host=127.0.0.1;port={command};pose_port={pose};status_port={status};workspace=240,-60,220,360,60,340"
        )
    }

    pub(crate) fn open(&self) -> Box<dyn Robot> {
        let factory = XarmFactory::new().expect("a factory");
        let args = factory.descriptor().args(&self.arguments()).expect("good");
        factory.open(&args, &mut Rig::new()).expect("an arm")
    }
}
