//! An emulated arm with its connected driver.

use taceva_drivers::ufactory::xarm::XarmFactory;
use taceva_wire::xarm::{Emulator, Port, Ports};

use crate::waiting::setup::Setup;

/// Starts an emulated arm over a gel without noise, on the ports `ports`.
pub(crate) fn setup(ports: Ports) -> Setup<Emulator> {
    let factory = XarmFactory::new().expect("a factory");
    Setup::with_arguments(factory, |bench| Emulator::start(bench, ports), arguments)
}

/// Driver arguments for the emulated arm `arm`.
fn arguments(arm: &Emulator) -> String {
    let port = |port| arm.address(port).port();
    let [command, pose, status, rich] =
        [Port::Command, Port::Pose, Port::Status, Port::Rich].map(port);
    // A missing report port is replaced by a port without a listener.
    let [pose, status] = [pose, status].map(|port| if port == command { 1 } else { port });
    format!(
        "host=127.0.0.1;port={command};pose_port={pose};status_port={status};rich_port={rich};workspace=240,-60,220,360,60,340"
    )
}
