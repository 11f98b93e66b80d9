//! Encoding of requests to the controller and decoding of its answers. No I/O.

use super::firmware::Firmware;
use super::frame::{Reply, Request};

/// Command or query to the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Command {
    /// Query the firmware version.
    GetVersion,
    /// Set the state: become ready, or stop.
    SetState(TargetState),
    /// Query the state of the controller.
    GetState,
    /// Query the number of queued motions.
    GetQueued,
    /// Query the codes of the current error and warning.
    GetError,
    /// Set the motion mode.
    SetMode(Mode),
    /// Query the pose of the tip.
    GetPose,
    /// Move in a straight line.
    MoveLine(MoveLine),
    /// Move at a velocity that ends after a stated time.
    MoveVelocity(MoveVelocity),
}

/// Motion mode of the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// Moves to queued positions.
    Position = 0,
    /// Moves at the commanded velocity of the tip.
    Velocity = 5,
}

/// State that a command requests from the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TargetState {
    /// Accepts motions.
    Ready = 0,
    /// Stops, and empties the queue of motions.
    Stopped = 4,
}

/// A straight motion of the tip in the base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MoveLine {
    /// Target pose: x, y, z in mm; roll, pitch, yaw in rad. All six are sent, because the controller fills in omitted numbers itself.
    pub(super) pose: [f32; 6],
    pub(super) speed_mm_s: f32,
    pub(super) acceleration_mm_s2: f32,
}

/// Velocity of the tip in the base frame, without rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MoveVelocity {
    pub(super) velocity_mm_s: [f32; 3],
    /// Time without a new velocity after which the controller stops, s.
    pub(super) duration_s: f32,
}

const GET_VERSION: u8 = 1;
const SET_STATE: u8 = 12;
const GET_STATE: u8 = 13;
const GET_QUEUED: u8 = 14;
const GET_ERROR: u8 = 15;
const SET_MODE: u8 = 19;
const MOVE_LINE: u8 = 21;
const GET_POSE: u8 = 41;
const MOVE_VELOCITY: u8 = 82;

/// Blending radius that makes the tip stop at the end of each line.
const NO_BLENDING: f32 = -1.0;

impl Command {
    /// Encodes the command for a controller with `firmware`.
    pub(super) fn request(self, firmware: Firmware) -> Request {
        let (register, parameters) = match self {
            Command::GetVersion => (GET_VERSION, Vec::new()),
            Command::SetState(state) => (SET_STATE, vec![state as u8]),
            Command::GetState => (GET_STATE, Vec::new()),
            Command::GetQueued => (GET_QUEUED, Vec::new()),
            Command::GetError => (GET_ERROR, Vec::new()),
            Command::SetMode(mode) if firmware.takes_collision_detection() => {
                (SET_MODE, vec![mode as u8, 0])
            }
            Command::SetMode(mode) => (SET_MODE, vec![mode as u8]),
            Command::GetPose => (GET_POSE, Vec::new()),
            Command::MoveLine(line) => (MOVE_LINE, line.parameters(firmware)),
            Command::MoveVelocity(velocity) => (MOVE_VELOCITY, velocity.parameters()),
        };
        Request {
            register,
            parameters,
        }
    }

    /// Name of the command in error messages.
    pub(super) fn name(self) -> &'static str {
        match self {
            Command::GetVersion => "the query of its version",
            Command::SetState(TargetState::Ready) => "the command to become ready",
            Command::SetState(TargetState::Stopped) => "the command to stop",
            Command::GetState => "the query of its state",
            Command::GetQueued => "the query of queued motions",
            Command::GetError => "the query of errors",
            Command::SetMode(Mode::Position) => "the command for position mode",
            Command::SetMode(Mode::Velocity) => "the command for velocity mode",
            Command::GetPose => "the query of its pose",
            Command::MoveLine(_) | Command::MoveVelocity(_) => "the command to move",
        }
    }
}

impl MoveVelocity {
    fn parameters(self) -> Vec<u8> {
        let [x, y, z] = self.velocity_mm_s;
        let turning = [0.0; 3];
        let numbers = [x, y, z].into_iter().chain(turning);
        let mut bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
        // Base frame.
        bytes.push(0);
        bytes.extend(self.duration_s.to_le_bytes());
        bytes
    }
}

impl MoveLine {
    fn parameters(self, firmware: Firmware) -> Vec<u8> {
        let time_s = 0.0;
        let [x, y, z, roll, pitch, yaw] = self.pose;
        let numbers = [
            x,
            y,
            z,
            roll,
            pitch,
            yaw,
            self.speed_mm_s,
            self.acceleration_mm_s2,
            time_s,
        ];
        let mut bytes: Vec<u8> = numbers.into_iter().flat_map(f32::to_le_bytes).collect();
        if firmware.takes_long_lines() {
            bytes.extend(NO_BLENDING.to_le_bytes());
            // Base frame; roll, pitch and yaw; move instead of only checking.
            bytes.extend([0, 0, 0]);
        }
        bytes
    }
}

/// Decoders of the values in an answer.
impl Reply {
    /// State number of the controller; `None` if the answer is too short.
    pub(super) fn state(&self) -> Option<u8> {
        self.parameters.first().copied()
    }

    /// Number of queued motions in the answer; `None` if the answer is too short.
    pub(super) fn queued(&self) -> Option<u16> {
        self.parameters
            .first_chunk()
            .copied()
            .map(u16::from_be_bytes)
    }

    /// Error code and warning code in the answer; `None` if the answer is too short.
    pub(super) fn codes(&self) -> Option<[u8; 2]> {
        self.parameters.first_chunk().copied()
    }

    /// Pose: x, y, z in mm and roll, pitch, yaw in rad; `None` if the answer is too short.
    pub(super) fn pose(&self) -> Option<[f32; 6]> {
        floats(&self.parameters)
    }

    /// Text of the answer, without trailing NUL characters.
    pub(super) fn text(&self) -> String {
        let text = String::from_utf8_lossy(&self.parameters);
        text.trim_end_matches('\0').to_owned()
    }
}

/// First six little-endian single-precision numbers of `bytes`; `None` if `bytes` is too short.
pub(super) fn floats(bytes: &[u8]) -> Option<[f32; 6]> {
    let bytes: &[u8; 24] = bytes.first_chunk()?;
    Some(std::array::from_fn(|index| {
        let at = 4 * index;
        f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
    }))
}

#[cfg(test)]
mod tests {
    use super::super::frame::Status;
    use super::*;
    use crate::link::hexadecimal;

    const OLD: Firmware = Firmware::new(1, 10, 0);
    const NEW: Firmware = Firmware::new(2, 7, 0);

    fn sent(command: Command, firmware: Firmware) -> Vec<u8> {
        let request = command.request(firmware);
        [vec![request.register], request.parameters].concat()
    }

    fn line() -> Command {
        Command::MoveLine(MoveLine {
            pose: [300.0, 0.0, 200.0, std::f32::consts::PI, 0.0, 0.0],
            speed_mm_s: 100.0,
            acceleration_mm_s2: 2000.0,
        })
    }

    /// Compares requests with those that xarm-python-sdk 1.18.4 sends for the same calls. Headers are omitted.
    #[test]
    fn commands_are_those_of_the_public_client_for_both_layouts() {
        let recorded = [
            (Command::GetVersion, NEW, "01"),
            (Command::SetMode(Mode::Position), NEW, "13 00 00"),
            (
                Command::MoveVelocity(MoveVelocity {
                    velocity_mm_s: [0.0, 0.0, -2.0],
                    duration_s: 0.2,
                }),
                NEW,
                "52 00000000 00000000 000000c0 00000000 00000000 00000000 00 cdcc4c3e",
            ),
            (Command::SetState(TargetState::Ready), NEW, "0c 00"),
            (Command::SetState(TargetState::Stopped), NEW, "0c 04"),
            (Command::GetState, NEW, "0d"),
            (Command::GetQueued, NEW, "0e"),
            (Command::GetError, NEW, "0f"),
            (Command::GetPose, NEW, "29"),
            (
                line(),
                NEW,
                "15 00009643 00000000 00004843 db0f4940 00000000 00000000 0000c842 0000fa44 00000000 000080bf 00 00 00",
            ),
            (
                line(),
                OLD,
                "15 00009643 00000000 00004843 db0f4940 00000000 00000000 0000c842 0000fa44 00000000",
            ),
        ];
        for (command, firmware, expected) in recorded {
            assert_eq!(
                sent(command, firmware),
                hexadecimal(expected),
                "{command:?}"
            );
        }
    }

    #[test]
    fn an_answer_that_is_too_short_says_nothing() {
        let reply = |parameters: &str| Reply {
            transaction: 1,
            register: 41,
            status: Status(0),
            parameters: hexadecimal(parameters),
        };
        assert_eq!(reply("").state(), None);
        assert_eq!(reply("01").queued(), None);
        assert_eq!(reply("01").codes(), None);
        assert_eq!(reply("00009643").pose(), None);
        assert_eq!(reply("0102").queued(), Some(0x0102));
        assert_eq!(reply("1f00").codes(), Some([31, 0]));
        assert_eq!(reply("76322e 0000").text(), "v2.");
    }
}
