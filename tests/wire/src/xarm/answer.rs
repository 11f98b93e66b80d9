//! Answers to commands, by the register that a command names.

use super::client::{Client, Push};
use super::controller::{Controller, Snapshot, Taken};
use super::joint_motion::JointMotion;
use super::line::Line;
use crate::placement::Placement;

/// Settings of one client.
#[derive(Debug, Default)]
pub(super) struct Session {
    /// True if the client gets a message at the end of its later motions.
    wants_push: bool,
}

const HAS_ERROR: u8 = 0x40;
const HAS_WARNING: u8 = 0x20;
const NOT_READY: u8 = 0x10;
const INVALID: u8 = 0x08;
/// Length of the answers to queries of the version and of the serial numbers, bytes.
const TEXT_BYTES: usize = 40;

impl Session {
    /// Answer frames of a command. `head` contains the transaction number and the protocol number of the command.
    pub(super) fn answer(
        &mut self,
        controller: &Controller,
        client: &Client,
        head: [u8; 4],
        register: u8,
        parameters: &[u8],
    ) -> Vec<Vec<u8>> {
        let first = parameters.first().copied();
        let mut refused = 0;
        let mut pushed = None;
        let data = match (register, first) {
            (1, _) => version(controller),
            (2, _) => padded(serials(controller).join("\0")),
            (11, Some(_)) => {
                controller.enable(parameters.get(1) == Some(&1));
                Vec::new()
            }
            (12, Some(state)) => {
                controller.set_state(state);
                Vec::new()
            }
            (13, _) => vec![controller.snapshot().state],
            (14, _) => controller.snapshot().queued.to_be_bytes().to_vec(),
            (15, _) => {
                let Snapshot { error, warning, .. } = controller.snapshot();
                vec![error, warning]
            }
            (16, _) => {
                controller.clear_error();
                Vec::new()
            }
            (17, _) => {
                controller.clear_warning();
                Vec::new()
            }
            (19, Some(mode)) => {
                controller.set_mode(mode);
                Vec::new()
            }
            (21 | 23 | 24 | 28 | 83 | 92, _) => {
                let push = self.wants_push.then(|| Push {
                    client: client.clone(),
                    head,
                });
                let taken = taken(controller, register, parameters, push);
                let mut data = controller.snapshot().queued.to_be_bytes().to_vec();
                match taken {
                    Some(Taken::Accepted) => {}
                    Some(Taken::Checked(error)) => data.push(error),
                    Some(Taken::Refused) => refused = NOT_READY,
                    None => refused = INVALID,
                }
                data
            }
            (41, _) => numbers(&controller.snapshot().pose),
            (42, _) => {
                let mut angles = numbers(&controller.snapshot().angles);
                // The seventh joint of other arms.
                angles.extend([0; 4]);
                angles
            }
            (91, _) => {
                let Snapshot { pose, .. } = controller.snapshot();
                numbers(&Placement::of_pose(pose).rotation_vector())
            }
            (82, _) => {
                match velocity(parameters) {
                    Some((velocity_mm_s, duration_s))
                        if controller.cruise(velocity_mm_s, duration_s) => {}
                    Some(_) => refused = NOT_READY,
                    None => refused = INVALID,
                }
                Vec::new()
            }
            (254, Some(kind)) => {
                self.wants_push = kind & 2 != 0;
                Vec::new()
            }
            (253, _) => {
                pushed = Some(Push {
                    client: client.clone(),
                    head,
                });
                Vec::new()
            }
            _ => {
                refused = INVALID;
                Vec::new()
            }
        };
        let status = refused | status(&controller.snapshot());
        let length = u16::try_from(2 + data.len()).unwrap_or(u16::MAX);
        let mut frame = head.to_vec();
        frame.extend(length.to_be_bytes());
        frame.extend([register, status]);
        frame.extend(data);
        if let Some(push) = pushed {
            push.send(Push::SUCCEEDED);
        }
        vec![frame]
    }
}

/// Reply to the motion in the parameters of `register`; `None` if their length matches no message layout.
fn taken(
    controller: &Controller,
    register: u8,
    parameters: &[u8],
    push: Option<Push>,
) -> Option<Taken> {
    let joints = match register {
        23 | 24 => JointMotion::absolute(parameters),
        83 => JointMotion::relative(parameters),
        _ => None,
    };
    if let Some(joints) = joints {
        return Some(controller.turn_joints(&joints, push));
    }
    let line = match register {
        21 => Line::absolute(parameters, controller.takes_long_lines()),
        28 => Line::in_tool(parameters),
        83 => Line::relative(parameters),
        92 => Line::by_rotation_vector(parameters),
        _ => None,
    };
    Some(controller.take(&line?, push))
}

fn numbers(numbers: &[f32]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect()
}

/// Velocity in mm/s and its duration in s, from the parameters of register 82. `None` with rotation, in the tool frame, without an end, or
/// for an invalid number.
fn velocity(parameters: &[u8]) -> Option<([f64; 3], f64)> {
    const BYTES: usize = 29;
    const BASE_FRAME: u8 = 0;
    if parameters.len() != BYTES || parameters[24] != BASE_FRAME {
        return None;
    }
    let number = |at: usize| {
        let bytes = parameters.get(at..at + 4)?.try_into().ok()?;
        Some(f64::from(f32::from_le_bytes(bytes))).filter(|number| number.is_finite())
    };
    let [x, y, z] = [number(0)?, number(4)?, number(8)?];
    let turns = parameters[12..24].iter().any(|byte| *byte != 0);
    let duration_s = number(25)?;
    (!turns && duration_s >= 0.0).then_some(([x, y, z], duration_s))
}

fn status(snapshot: &Snapshot) -> u8 {
    let mut status = 0;
    if snapshot.error != 0 {
        status |= HAS_ERROR;
    }
    if snapshot.warning != 0 {
        status |= HAS_WARNING;
    }
    if snapshot.state > 3 {
        status |= NOT_READY;
    }
    status
}

/// Serial numbers of the arm, in the maker's format, and of the control box. The latter shows that the box is simulated.
fn serials(controller: &Controller) -> [String; 2] {
    let serial = controller.bench.serial();
    let number: String = serial.chars().filter(char::is_ascii_digit).collect();
    [format!("XF1300{number}"), serial]
}

/// Identity of the controller: six axes, type 12, serial numbers and firmware.
fn version(controller: &Controller) -> Vec<u8> {
    let [major, minor, revision] = controller.firmware;
    let serials = serials(controller).join(",");
    padded(format!("6,12,{serials},v{major}.{minor}.{revision}"))
}

/// Text in an answer of fixed length.
fn padded(text: String) -> Vec<u8> {
    let mut bytes = text.into_bytes();
    bytes.resize(TEXT_BYTES, 0);
    bytes
}
