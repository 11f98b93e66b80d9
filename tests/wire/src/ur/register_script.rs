//! Script of a public client (`RTDEControlInterface` of `ur-rtde`), which takes commands from input registers and answers in output registers.
//!
//! A real controller runs the script. The emulator recognises the script by its first line, and serves the registers without running it. It supports
//! motions of tip and joints, paths of motions, targets to follow, a velocity without rotation, stops, and questions about rest and tool. Any other
//! command ends the script, as an error in the script would. The script states whether it uses the lower or the upper half of the registers.

use super::inputs::Inputs;
use super::joints;
use super::path::{self, Waypoint};

/// First line of the script.
pub(super) const FIRST_LINE: &str = "def rtde_control():\n";

/// Comment line in the script. The number of the first integer register follows it.
const FIRST_REGISTER: &str = "# int register offset\n";
/// First register of the upper half of the registers.
const UPPER: usize = 24;
/// Least and greatest time within which a followed target is reached, s.
const LOOKAHEAD_S: [f64; 2] = [0.03, 0.2];

/// Facts that the client writes into its script.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Setup {
    /// First register of each type that the script uses.
    first: usize,
    path: Vec<Waypoint>,
}

/// Command in the input registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Command {
    /// The registers contain no command.
    None,
    /// Moves the tip straight to a pose in m and rad.
    Move {
        pose: [f64; 6],
        speed_m_s: f64,
        /// True if the script does not wait for the end of the motion.
        is_asynchronous: bool,
    },
    /// Moves along the path of the script.
    Path { is_asynchronous: bool },
    /// Follows a target in m and rad, which the next command replaces.
    Servo { pose: [f64; 6], within_s: f64 },
    /// Moves at a velocity until the next command.
    Cruise { velocity_m_s: [f64; 3] },
    /// Stops the motion in progress.
    Stop,
    /// Asks if the arm rests.
    IsSteady,
    /// Asks for the offset of the tool, which is 0.
    ToolOffset,
    /// Ends the script.
    End,
}

/// State of the running script.
#[derive(Clone, Debug)]
pub(super) struct RegisterScript {
    setup: Setup,
    /// Number of the next motion of the path in progress, if any.
    next: Option<usize>,
    state: State,
    /// Stage of the present command.
    stage: Stage,
    /// Answer to the last question.
    result: i32,
    progress: Progress,
}

/// State of the script, as its first output register shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Ready = 1,
    Done = 2,
}

/// Stage of a command that is executed only once, even if it stays in the register.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    /// The script is ready for a command: the command register was 0, or has a command that may be repeated.
    Free,
    /// A motion is in progress, and the script waits for its end.
    Moving,
    Done,
}

/// Progress of motions for which the script does not wait.
#[derive(Clone, Copy, Debug, Default)]
struct Progress {
    reports: i32,
    motions: i32,
    /// Number of completed motions of the path.
    steps: i32,
    is_moving: bool,
}

impl Setup {
    /// Reads the facts that the client wrote into `script`.
    pub(super) fn of(script: &str) -> Setup {
        let after = script.split_once(FIRST_REGISTER).map(|(_, after)| after);
        let upper = after.is_some_and(|after| after.starts_with(&UPPER.to_string()));
        Setup {
            first: if upper { UPPER } else { 0 },
            path: path::of(script),
        }
    }
}

impl Command {
    /// Parses the command in the registers from `first` on.
    pub(super) fn read(inputs: &Inputs, first: usize) -> Command {
        let registers = (inputs.doubles.get(first..), inputs.integers.get(first..));
        let (
            Some(&[a, b, c, d, e, f, speed, _, _, lookahead_s, ..]),
            Some(&[command, is_asynchronous, ..]),
        ) = registers
        else {
            return Command::End;
        };
        let six = [a, b, c, d, e, f];
        let line = |pose: [f64; 6], speed_m_s: f64| Command::Move {
            pose,
            speed_m_s,
            is_asynchronous: is_asynchronous == 1,
        };
        let turn = |pose: [f64; 6]| line(pose, joints::tip_speed_m_s(pose, speed));
        let [least_s, most_s] = LOOKAHEAD_S;
        let servo = |pose: [f64; 6]| Command::Servo {
            pose,
            within_s: lookahead_s.clamp(least_s, most_s),
        };
        if !six
            .iter()
            .chain([&lookahead_s])
            .all(|number| number.is_finite())
        {
            return Command::End;
        }
        match (command, six) {
            (0, _) => Command::None,
            (1, angles) => turn(joints::pose(angles)),
            (2, pose) => turn(pose),
            (3, pose) => line(pose, speed),
            (4, angles) => line(joints::pose(angles), speed),
            (10, [x, y, z, 0.0, 0.0, 0.0]) => Command::Cruise {
                velocity_m_s: [x, y, z],
            },
            (11, angles) => servo(joints::pose(angles)),
            (15 | 16 | 33 | 34, _) => Command::Stop,
            (24, pose) => servo(pose),
            (40, _) => Command::ToolOffset,
            (45, _) => Command::Path {
                is_asynchronous: is_asynchronous == 1,
            },
            (47, _) => Command::IsSteady,
            _ => Command::End,
        }
    }
}

impl RegisterScript {
    /// Creates the state of a script that has just begun.
    pub(super) fn begun(setup: Setup) -> RegisterScript {
        let mut progress = Progress::default();
        progress.report(false);
        RegisterScript {
            setup,
            next: None,
            state: State::Ready,
            stage: Stage::Free,
            result: 0,
            progress,
        }
    }

    /// First register of each type that the script uses.
    pub(super) fn first(&self) -> usize {
        self.setup.first
    }

    /// Processes the present command in the registers. Returns the command if it must be executed now; `None` otherwise.
    pub(super) fn take(&mut self, command: Command, is_moving: bool) -> Option<Command> {
        match (self.stage, command) {
            (Stage::Moving, _) => return None,
            (_, Command::None) => {
                (self.stage, self.state) = (Stage::Free, State::Ready);
                return None;
            }
            // Repeated while it is in the register.
            (_, Command::Cruise { .. } | Command::Servo { .. }) => {
                (self.state, self.next) = (State::Ready, None);
                return Some(command);
            }
            (Stage::Done, _) => return None,
            (Stage::Free, _) => {}
        }
        (self.stage, self.state) = (Stage::Done, State::Done);
        match command {
            Command::Move {
                is_asynchronous, ..
            }
            | Command::Path { is_asynchronous } => {
                self.progress.end();
                self.next = matches!(command, Command::Path { .. }).then_some(0);
                if is_asynchronous {
                    self.progress.begin();
                } else {
                    (self.stage, self.state) = (Stage::Moving, State::Ready);
                }
            }
            Command::Stop => {
                self.next = None;
                self.progress.end();
            }
            Command::IsSteady => self.result = i32::from(!is_moving),
            Command::None
            | Command::Cruise { .. }
            | Command::Servo { .. }
            | Command::ToolOffset
            | Command::End => {}
        }
        Some(command)
    }

    /// Notes that the arm rests. Returns the next motion of the path in progress.
    pub(super) fn rest(&mut self) -> Option<Waypoint> {
        if let Some(step) = self.next {
            let waypoint = self.setup.path.get(step).copied();
            self.next = waypoint.map(|_| step + 1);
            if waypoint.is_some() {
                // Reports of a path that the script waits for are not emulated.
                if self.stage != Stage::Moving {
                    self.progress.advance(step);
                }
                return waypoint;
            }
        }
        if self.stage == Stage::Moving {
            (self.stage, self.state) = (Stage::Done, State::Done);
        }
        self.progress.end();
        None
    }

    /// Content of an integer output register; `None` if the script does not write the register.
    pub(super) fn output(&self, number: usize) -> Option<i32> {
        let outputs = [self.state as i32, self.result, self.progress.register()];
        let at = number.checked_sub(self.setup.first)?;
        outputs.get(at).copied()
    }
}

impl Progress {
    fn begin(&mut self) {
        (self.motions, self.steps) = ((self.motions + 1) % 128, 0);
        self.report(true);
    }

    /// Reports that motion number `step` of a path begins. Motion 0 is reported as a new motion, later ones as progress.
    fn advance(&mut self, step: usize) {
        if step == 0 {
            return self.begin();
        }
        self.steps = i32::try_from(step).unwrap_or(i32::MAX).min(0x7fff);
        self.report(true);
    }

    fn end(&mut self) {
        if self.is_moving {
            self.steps = 0;
            self.report(false);
        }
    }

    fn report(&mut self, is_moving: bool) {
        self.reports = (self.reports + 1) % 128;
        self.is_moving = is_moving;
    }

    /// Content of the output register: the number of the motion, the number of the report, a bit while the arm moves, and the completed motions of
    /// the path.
    fn register(self) -> i32 {
        let moves = i32::from(self.is_moving);
        self.motions * 0x0100_0000 + self.reports * 0x0001_0000 + moves * 0x8000 + self.steps
    }
}

#[cfg(test)]
mod tests;
