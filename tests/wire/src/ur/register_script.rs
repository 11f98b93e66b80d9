//! Script of a public client (`RTDEControlInterface` of `ur-rtde`), which takes commands from input registers and answers in output registers.
//!
//! A controller runs the script. The emulator recognises it by its first line, and serves its registers without running it. It supports
//! motions of tip and joints, a velocity without rotation, their stops, and questions about rest and tool. Any other command ends the script,
//! as an error in it would.

use super::inputs::Inputs;
use super::joints;

/// First line of the script.
pub(super) const FIRST_LINE: &str = "def rtde_control():\n";

/// Command in the input registers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Command {
    /// No command.
    None,
    /// Moves the tip straight to a pose in m and rad.
    Move {
        pose: [f64; 6],
        speed_m_s: f64,
        /// True if the script does not wait for the end of the motion.
        is_asynchronous: bool,
    },
    /// Moves at a velocity until the next command.
    Cruise { velocity_m_s: [f64; 3] },
    /// Brakes.
    Stop,
    /// Question for rest.
    IsSteady,
    /// Question for the offset of the tool, which is 0.
    ToolOffset,
    /// Ends the script.
    End,
}

/// State of the running script.
#[derive(Clone, Copy, Debug)]
pub(super) struct RegisterScript {
    state: State,
    /// Stage of the present command.
    stage: Stage,
    /// Answer to the last question.
    result: i32,
    progress: Progress,
}

/// Content of the first output register.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Ready = 1,
    Done = 2,
}

/// Stage of a command, which is executed once.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    /// The register of commands was 0, or has a repeated command.
    Free,
    /// A motion that the script waits for.
    Moving,
    Done,
}

/// Report of motions for which the script does not wait.
#[derive(Clone, Copy, Debug, Default)]
struct Progress {
    reports: i32,
    motions: i32,
    is_moving: bool,
}

impl Command {
    /// Command in the registers.
    pub(super) fn read(inputs: &Inputs) -> Command {
        let [a, b, c, d, e, f, speed, ..] = inputs.doubles;
        let six = [a, b, c, d, e, f];
        let [command, is_asynchronous, ..] = inputs.integers;
        let line = |pose: [f64; 6], speed_m_s: f64| Command::Move {
            pose,
            speed_m_s,
            is_asynchronous: is_asynchronous == 1,
        };
        // The tip moves straight, as fast as a turn of the base at the speed of the joints would move it.
        let turn = |pose: [f64; 6]| {
            let [x, y, z, ..] = pose;
            line(pose, speed * x.hypot(y).hypot(z))
        };
        if !six.iter().all(|number| number.is_finite()) {
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
            (15 | 33 | 34, _) => Command::Stop,
            (40, _) => Command::ToolOffset,
            (47, _) => Command::IsSteady,
            _ => Command::End,
        }
    }
}

impl RegisterScript {
    /// State of a script that has begun.
    pub(super) fn begun() -> RegisterScript {
        let mut progress = Progress::default();
        progress.report(false);
        RegisterScript {
            state: State::Ready,
            stage: Stage::Free,
            result: 0,
            progress,
        }
    }

    /// Takes the content of the registers. Returns it if it is to be executed now.
    pub(super) fn take(&mut self, command: Command, is_moving: bool) -> Option<Command> {
        match (self.stage, command) {
            (Stage::Moving, _) => return None,
            (_, Command::None) => {
                (self.stage, self.state) = (Stage::Free, State::Ready);
                return None;
            }
            // Repeated while it is in the register.
            (_, Command::Cruise { .. }) => {
                self.state = State::Ready;
                return Some(command);
            }
            (Stage::Done, _) => return None,
            (Stage::Free, _) => {}
        }
        (self.stage, self.state) = (Stage::Done, State::Done);
        match command {
            Command::Move {
                is_asynchronous, ..
            } => {
                self.progress.end();
                if is_asynchronous {
                    self.progress.begin();
                } else {
                    (self.stage, self.state) = (Stage::Moving, State::Ready);
                }
            }
            Command::Stop => self.progress.end(),
            Command::IsSteady => self.result = i32::from(!is_moving),
            Command::None | Command::Cruise { .. } | Command::ToolOffset | Command::End => {}
        }
        Some(command)
    }

    /// Notes that the arm rests.
    pub(super) fn rest(&mut self) {
        if self.stage == Stage::Moving {
            (self.stage, self.state) = (Stage::Done, State::Done);
        }
        self.progress.end();
    }

    /// Contents of the first three integer output registers.
    pub(super) fn outputs(&self) -> [i32; 3] {
        [self.state as i32, self.result, self.progress.register()]
    }
}

impl Progress {
    fn begin(&mut self) {
        self.motions = (self.motions + 1) % 128;
        self.report(true);
    }

    fn end(&mut self) {
        if self.is_moving {
            self.report(false);
        }
    }

    fn report(&mut self, is_moving: bool) {
        self.reports = (self.reports + 1) % 128;
        self.is_moving = is_moving;
    }

    /// Content of the register: numbers of the report and of the motion, and a bit while it moves.
    fn register(self) -> i32 {
        let moves = i32::from(self.is_moving);
        self.motions * 0x0100_0000 + self.reports * 0x0001_0000 + moves * 0x8000
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs(command: i32, is_asynchronous: i32, numbers: &[f64]) -> Inputs {
        let mut inputs = Inputs::default();
        [inputs.integers[0], inputs.integers[1]] = [command, is_asynchronous];
        inputs.doubles[..numbers.len()].copy_from_slice(numbers);
        inputs
    }

    #[test]
    fn a_motion_is_executed_once_and_done_when_the_arm_rests() {
        let mut script = RegisterScript::begun();
        let to = inputs(3, 0, &[0.3, 0.0, 0.26, 3.1, 0.0, 0.0, 0.05]);
        let command = Command::read(&to);
        assert_eq!(script.take(command, false), Some(command));
        assert_eq!(script.take(command, true), None, "it moves");
        assert_eq!(script.outputs()[0], 1);
        script.rest();
        assert_eq!(script.outputs()[0], 2);
        assert_eq!(script.take(command, false), None, "it is done");
        assert_eq!(script.take(Command::None, false), None);
        assert_eq!(script.outputs()[0], 1);
        assert_eq!(script.take(command, false), Some(command), "it is new");
    }

    #[test]
    fn a_motion_that_is_not_waited_for_is_reported_until_it_ends() {
        let mut script = RegisterScript::begun();
        assert_eq!(script.outputs()[2], 0x0001_0000);
        let to = inputs(3, 1, &[0.3, 0.0, 0.26, 3.1, 0.0, 0.0, 0.05]);
        assert!(script.take(Command::read(&to), false).is_some());
        assert_eq!(script.outputs(), [2, 0, 0x0102_8000]);
        script.take(Command::None, true);
        let question = Command::read(&inputs(47, 1, &[]));
        assert!(script.take(question, true).is_some());
        assert_eq!(script.outputs()[1], 0, "it moves");
        script.take(Command::None, true);
        assert_eq!(script.take(Command::Stop, true), Some(Command::Stop));
        assert_eq!(script.outputs()[2], 0x0103_0000);
        script.take(Command::None, false);
        assert!(script.take(question, false).is_some());
        assert_eq!(script.outputs()[1], 1, "it rests");
    }

    #[test]
    fn a_command_without_an_emulation_or_without_numbers_ends_the_script() {
        let turning = inputs(10, 0, &[0.0, 0.0, 0.0, 0.1]);
        let endless = inputs(3, 0, &[f64::NAN]);
        for inputs in [inputs(6, 0, &[]), inputs(255, 0, &[]), turning, endless] {
            assert_eq!(Command::read(&inputs), Command::End);
        }
        let down = inputs(10, 0, &[0.0, 0.0, -0.005]);
        let expected = Command::Cruise {
            velocity_m_s: [0.0, 0.0, -0.005],
        };
        assert_eq!(Command::read(&down), expected);
    }
}
