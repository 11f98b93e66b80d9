//! Unsolicited reports of the control box.

use std::io::Write;
use std::net::TcpStream;
use std::time::Duration;

use taceva_core::single;

use super::controller::{Controller, JOINT_SPEEDS_RAD_S, SPEEDS_MM_S, Snapshot};
use crate::fault::{Device, FaultKind};
use crate::link::Link;
use crate::placement::Placement;
use crate::server::End;

/// Ports on which the control box sends reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ReportPort {
    Pose,
    Status,
    Rich,
}

impl ReportPort {
    fn length(self) -> usize {
        match self {
            ReportPort::Pose => 135,
            ReportPort::Status => 145,
            ReportPort::Rich => 587,
        }
    }

    fn period(self) -> Duration {
        match self {
            ReportPort::Pose => Duration::from_millis(10),
            ReportPort::Status | ReportPort::Rich => Duration::from_millis(200),
        }
    }
}

/// Header of a report with an absurd length.
const HOSTILE: &[u8] = &[0xff, 0xff, 0xff, 0xff, 0x00];

/// Sends reports until the client closes.
pub(super) fn serve(mut stream: TcpStream, port: ReportPort, controller: &Controller, end: &End) {
    let bench = &controller.bench;
    let mut shown = controller.snapshot();
    let mut due = bench.now();
    let mut link = Link::new(Device::Robot, HOSTILE);
    while !end.has_come() {
        if !bench.is_faulty(Device::Robot, FaultKind::Frozen) {
            shown = controller.snapshot();
        }
        if bench.is_faulty(Device::Robot, FaultKind::NotANumber) {
            shown.pose[2] = f32::NAN;
        }
        let report = write(port, &shown, controller.firmware);
        let sent = link.send(bench, &report, |bytes| stream.write_all(bytes));
        if sent.is_err() {
            return;
        }
        // Reports are made at regular times, independent of the sending time.
        due = (due + port.period()).max(bench.now());
        let rested = link.rest_until(bench, due, |bytes| stream.write_all(bytes));
        if rested.is_err() {
            return;
        }
    }
}

fn write(port: ReportPort, shown: &Snapshot, [major, minor, revision]: [u32; 3]) -> Vec<u8> {
    let length = port.length();
    let mut bytes = vec![0; length];
    let mut put = |at: usize, part: &[u8]| bytes[at..at + part.len()].copy_from_slice(part);
    put(0, &u32::try_from(length).unwrap_or(0).to_be_bytes());
    put(4, &[shown.state | shown.mode << 4]);
    put(5, &shown.queued.to_be_bytes());
    let numbers = |numbers: &[f32]| -> Vec<u8> {
        let bytes = numbers.iter().flat_map(|number| number.to_le_bytes());
        bytes.collect()
    };
    put(7, &numbers(&shown.angles));
    put(35, &numbers(&shown.pose));
    if port != ReportPort::Pose {
        // Brakes are open if motors are on.
        put(
            87,
            &[shown.enabled, shown.enabled, shown.error, shown.warning],
        );
        // Sensitivities of collision and of hand guiding, and gravity.
        put(131, &[3, 3]);
        put(133, &numbers(&[0.0, 0.0, -1.0]));
    }
    if port == ReportPort::Rich {
        // Type and axes, then the version.
        put(145, &[12, 6]);
        put(151, format!("v{major}.{minor}.{revision}").as_bytes());
        // Jerk, then least and greatest acceleration and speed of the tip, then of the joints.
        let [least, most] = SPEEDS_MM_S.map(single);
        let [slowest, fastest] = JOINT_SPEEDS_RAD_S.map(single);
        let limits = [
            1_000.0, 1.0, 50_000.0, least, most, 20.0, 0.01, 20.0, slowest, fastest,
        ];
        put(181, &numbers(&limits));
        let [.., rx, ry, rz] = Placement::of_pose(shown.pose).rotation_vector();
        put(482, &numbers(&[rx, ry, rz]));
    }
    bytes
}
