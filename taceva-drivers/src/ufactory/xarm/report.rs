//! Decoder of the reports that the controller sends without a request. No I/O.

use taceva_core::{Degree, Millimetre, Point, Pose, Rotation};
use thiserror::Error;

use super::command::floats;

/// Kind of report, one for each report port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ReportKind {
    /// State and pose of the arm, 100 reports per second.
    Pose,
    /// State, pose, errors and joints of the arm, a few reports per second.
    Status,
}

/// Content of a report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArmReport {
    pub(super) state: State,
    /// Motion mode; 0 for queued positions.
    pub(super) mode: u8,
    /// Number of motions that are queued or running.
    pub(super) queued: u16,
    /// Pose of the tip in the base frame: x, y, z in mm; roll, pitch, yaw in rad; may contain NaN.
    pub(super) pose: [f32; 6],
    /// Error code and motor states; `None` except in reports of [`ReportKind::Status`].
    pub(super) status: Option<ArmStatus>,
}

/// Fields that only reports of [`ReportKind::Status`] have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ArmStatus {
    /// Bit mask of the joints whose motors are on.
    pub(super) enabled: u8,
    pub(super) error: u8,
}

/// State number that the controller reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct State(pub(super) u8);

impl State {
    pub(super) const MOVING: State = State(1);
    pub(super) const SLOWING_DOWN: State = State(6);

    /// True if the controller is ready for the next motion.
    pub(super) fn is_ready(self) -> bool {
        matches!(self.0, 0 | 2)
    }

    /// True if the arm is neither moving nor ready, or if its state is unknown. The arm may be paused, stopped or slowing down.
    pub(super) fn is_stopped(self) -> bool {
        self != State::MOVING && !self.is_ready()
    }

    /// Name of the state in error messages.
    pub(super) fn name(self) -> &'static str {
        match self.0 {
            0 | 2 => "ready",
            1 => "moving",
            3 => "paused",
            4 => "stopped",
            5 => "waiting to be made ready",
            6 => "slowing down",
            _ => "unknown",
        }
    }
}

/// Error for an invalid report: the stream has lost synchronisation.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum ReportError {
    #[error("a report of {found} bytes, expected {least} to {LENGTH_MAX}")]
    Length { found: usize, least: usize },
    #[error("a report of state {state} and mode {mode}, expected at most 9 and 11")]
    State { state: u8, mode: u8 },
}

/// Maximum length of a report, bytes. Reports of newer firmware have more fields but are far shorter.
const LENGTH_MAX: usize = 4096;
/// Offset of the state in a report, bytes. The next constants are the offsets of other fields.
const STATE: usize = 4;
const QUEUED: usize = 5;
const POSE: usize = 35;
const ENABLED: usize = 88;
const ERROR: usize = 89;

impl ReportKind {
    /// Minimum length of a report, bytes: up to the last field that this driver reads.
    fn least(self) -> usize {
        match self {
            ReportKind::Pose => POSE + 24,
            ReportKind::Status => ERROR + 1,
        }
    }
}

/// Splits bytes that arrive in pieces of any size into reports.
#[derive(Debug)]
pub(super) struct Reports {
    kind: ReportKind,
    waiting: Vec<u8>,
}

impl Reports {
    pub(super) fn new(kind: ReportKind) -> Reports {
        Reports {
            kind,
            waiting: Vec::new(),
        }
    }

    /// Appends received bytes.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
    }

    /// Returns the next complete report; `None` until it has arrived.
    ///
    /// # Errors
    /// [`ReportError`], which is permanent: the link must be closed.
    pub(super) fn next(&mut self) -> Result<Option<ArmReport>, ReportError> {
        let Some(head) = self.waiting.first_chunk() else {
            return Ok(None);
        };
        let length = usize::try_from(u32::from_be_bytes(*head)).unwrap_or(usize::MAX);
        let least = self.kind.least();
        if !(least..=LENGTH_MAX).contains(&length) {
            return Err(ReportError::Length {
                found: length,
                least,
            });
        }
        if self.waiting.len() < length {
            return Ok(None);
        }
        let report = self.read(&self.waiting[..length])?;
        self.waiting.drain(..length);
        Ok(Some(report))
    }

    fn read(&self, report: &[u8]) -> Result<ArmReport, ReportError> {
        let (state, mode) = (report[STATE] & 0x0f, report[STATE] >> 4);
        if state > 9 || mode > 11 {
            return Err(ReportError::State { state, mode });
        }
        Ok(ArmReport {
            state: State(state),
            mode,
            queued: u16::from_be_bytes([report[QUEUED], report[QUEUED + 1]]),
            pose: floats(&report[POSE..]).expect("the length was checked to include the pose"),
            status: (self.kind == ReportKind::Status).then(|| ArmStatus {
                enabled: report[ENABLED],
                error: report[ERROR],
            }),
        })
    }
}

/// Converts the controller's six numbers, in mm and rad, to a pose in mm and degrees, rounded to 10⁻⁶ mm and 10⁻⁹ degrees.
pub(super) fn pose_of(numbers: [f32; 6]) -> Pose {
    let [x, y, z, roll, pitch, yaw] = numbers.map(f64::from);
    let pose = Pose {
        position: Point {
            x: Millimetre(x),
            y: Millimetre(y),
            z: Millimetre(z),
        },
        rotation: Rotation {
            x: Degree(roll.to_degrees()),
            y: Degree(pitch.to_degrees()),
            z: Degree(yaw.to_degrees()),
        },
    };
    pose.on_grid()
}

/// Converts a pose to the controller's six numbers, in mm and rad. Single precision resolves 0.03 µm at 300 mm.
pub(super) fn numbers_of(pose: &Pose) -> [f32; 6] {
    let Pose { position, rotation } = pose;
    let numbers = [
        position.x.0,
        position.y.0,
        position.z.0,
        rotation.x.0.to_radians(),
        rotation.y.0.to_radians(),
        rotation.z.0.to_radians(),
    ];
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the protocol sends f32, and a cast rounds to the nearest"
    )]
    let numbers = numbers.map(|number| number as f32);
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Report of `length` bytes with the pose (300 mm, 0, 300 mm, π rad, 0, 0), in the layout of the public client.
    fn report(length: usize, state_and_mode: u8) -> Vec<u8> {
        let mut bytes = vec![0; length];
        bytes[..4].copy_from_slice(&u32::try_from(length).expect("small").to_be_bytes());
        bytes[STATE] = state_and_mode;
        bytes[QUEUED + 1] = 3;
        let pose =
            crate::link::hexadecimal("00009643 00000000 00009643 db0f4940 00000000 00000000");
        bytes[POSE..POSE + 24].copy_from_slice(&pose);
        if length > ERROR {
            bytes[ENABLED] = 0x3f;
            bytes[ERROR] = 31;
        }
        bytes
    }

    fn all(reports: &mut Reports) -> Vec<ArmReport> {
        std::iter::from_fn(|| reports.next().expect("good reports")).collect()
    }

    #[test]
    fn reports_of_every_firmware_are_read_up_to_what_is_known() {
        for length in [135, 133, 245, 494, 587] {
            let mut reports = Reports::new(ReportKind::Pose);
            reports.push(&report(length, 0x04));
            let [found] = all(&mut reports)[..] else {
                panic!("one report of {length} bytes")
            };
            assert_eq!((found.state, found.mode, found.queued), (State(4), 0, 3));
            assert_eq!(found.pose[..3], [300.0, 0.0, 300.0]);
            assert_eq!(found.status, None);
        }
        let mut reports = Reports::new(ReportKind::Status);
        reports.push(&report(145, 0x12));
        let [found] = all(&mut reports)[..] else {
            panic!("one report")
        };
        assert_eq!((found.state, found.mode), (State(2), 1));
        let expected = ArmStatus {
            enabled: 0x3f,
            error: 31,
        };
        assert_eq!(found.status, Some(expected));
    }

    #[test]
    fn reports_are_the_same_however_they_are_split_and_merged() {
        let stream = [report(135, 1), report(135, 2), report(587, 2)].concat();
        for piece in [1, 3, 134, 135, 136, 400, stream.len()] {
            let mut reports = Reports::new(ReportKind::Pose);
            let mut found = Vec::new();
            for part in stream.chunks(piece) {
                reports.push(part);
                found.extend(all(&mut reports));
            }
            let states: Vec<u8> = found.iter().map(|report| report.state.0).collect();
            assert_eq!(states, [1, 2, 2], "in pieces of {piece}");
        }
    }

    #[test]
    fn an_absurd_length_and_an_unknown_state_end_the_stream() {
        let ends = |bytes: &[u8]| {
            let mut reports = Reports::new(ReportKind::Status);
            reports.push(bytes);
            reports.next().expect_err("no report")
        };
        for length in [0_u32, 4, 89, 4097, u32::MAX] {
            assert!(matches!(
                ends(&length.to_be_bytes()),
                ReportError::Length { .. }
            ));
        }
        assert!(matches!(
            ends(&report(145, 0x0a)),
            ReportError::State { state: 10, mode: 0 }
        ));
        assert!(matches!(
            ends(&report(145, 0xc1)),
            ReportError::State { state: 1, mode: 12 }
        ));
    }

    #[test]
    fn a_pose_is_read_back_as_it_was_written() {
        let mut pose = Pose::default();
        pose.position.x = Millimetre(300.125);
        pose.position.z = Millimetre(-0.5);
        pose.rotation.x = Degree(180.0);
        pose.rotation.z = Degree(-90.0);
        let back = pose_of(numbers_of(&pose));
        assert_eq!(back.position, pose.position);
        assert!((back.rotation.x.0 - 180.0).abs() < 1e-4);
        assert!((back.rotation.z.0 + 90.0).abs() < 1e-4);
    }
}
