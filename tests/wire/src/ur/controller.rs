//! State of an emulated controller of Universal Robots, which all its ports share.

use std::sync::{Mutex, MutexGuard, PoisonError};

use taceva_core::{Pose, Speed};

use super::inputs::{Inputs, Recipe};
use super::program::{Program, REGISTER};
use super::register_script::{Command, RegisterScript};
use crate::base::Base;
use crate::bench::WallBench;
use crate::fault::ArmFault;

/// Rotation vector of a tool that points down, rad.
const DOWN: [f64; 3] = [std::f64::consts::PI, 0.0, 0.0];
/// Duration, s, of a motion at constant velocity that only the next command ends.
const ENDLESS_S: f64 = 600.0;

/// Emulated controller, shared by the servers of all ports.
#[derive(Debug)]
pub(super) struct Controller {
    pub(super) bench: WallBench,
    /// Version: major and minor.
    pub(super) version: [u32; 2],
    inside: Mutex<Inside>,
}

#[derive(Debug)]
struct Inside {
    /// Fault that only a person can clear; `None` without a fault.
    fault: Option<ArmFault>,
    /// Rotation vector of the tool, rad. The rotation has no effect on the gel.
    turned: [f64; 3],
    /// Number of the last stop command that had a number.
    stop_number: i32,
    /// Position of the speed slider, 0 to 1, which slows every motion.
    slider: f64,
    /// Registers that clients wrote.
    inputs: Inputs,
    /// Script of a public client, while it runs.
    script: Option<RegisterScript>,
}

impl Controller {
    /// Creates a controller of a version, major and minor, that is switched on.
    pub(super) fn new(bench: &WallBench, version: [u32; 2]) -> Controller {
        Controller {
            bench: bench.clone(),
            version,
            inside: Mutex::new(Inside {
                fault: None,
                turned: DOWN,
                stop_number: 0,
                slider: 1.0,
                inputs: Inputs::default(),
                script: None,
            }),
        }
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Pose of the tip in m and as a rotation vector in rad, in the base frame.
    pub(super) fn pose(&self) -> [f64; 6] {
        let position = self.bench.pose().position;
        let [x, y, z] = Base::to_base([position.x.0, position.y.0, position.z.0]);
        let [rx, ry, rz] = self.inside().turned;
        [x / 1e3, y / 1e3, z / 1e3, rx, ry, rz]
    }

    pub(super) fn slider(&self) -> f64 {
        self.inside().slider
    }

    pub(super) fn set_slider(&self, slider: f64) {
        self.inside().slider = slider;
    }

    pub(super) fn fault(&self) -> Option<ArmFault> {
        self.inside().fault
    }

    /// Stops the arm and its program by a fault.
    pub(super) fn suffer(&self, fault: ArmFault) {
        self.inside().fault = Some(fault);
        self.stop();
    }

    /// Ends the program and its motion.
    pub(super) fn stop(&self) {
        self.inside().script = None;
        self.bench.stand();
    }

    /// True while a program runs.
    pub(super) fn is_running(&self) -> bool {
        self.inside().script.is_some() || self.bench.is_moving()
    }

    /// Content of an integer output register, written by the script of a public client or by a numbered stop.
    pub(super) fn output_register(&self, number: usize) -> i32 {
        let mut inside = self.inside();
        if !self.bench.is_moving() {
            self.go_on(&mut inside);
        }
        let of_script = inside.script.as_ref();
        match of_script.and_then(|script| script.output(number)) {
            Some(content) => content,
            None if number == usize::from(REGISTER) => inside.stop_number,
            None => 0,
        }
    }

    /// Begins the next motion of a path, or notes that the arm rests.
    fn go_on(&self, inside: &mut Inside) {
        if let Some(next) = inside.script.as_mut().and_then(RegisterScript::rest) {
            self.move_line(inside, next.pose, next.speed_m_s);
        }
    }

    /// Writes the values of a client's message to the registers, and executes the command in them.
    pub(super) fn write(&self, recipe: &Recipe, values: &[u8]) {
        let mut inside = self.inside();
        if !recipe.write(values, &mut inside.inputs) {
            return;
        }
        if let Some(slider) = inside.inputs.take_slider() {
            inside.slider = slider;
        }
        let first = inside.script.as_ref().map_or(0, RegisterScript::first);
        let command = Command::read(&inside.inputs, first);
        let is_moving = self.bench.is_moving();
        let taken = match &mut inside.script {
            Some(script) => script.take(command, is_moving),
            None => None,
        };
        match taken {
            None | Some(Command::None | Command::IsSteady | Command::ToolOffset) => {}
            Some(Command::Move {
                pose, speed_m_s, ..
            }) => self.move_line(&mut inside, pose, speed_m_s),
            Some(Command::Path { .. }) => {
                self.bench.stand();
                self.go_on(&mut inside);
            }
            Some(Command::Servo { pose, within_s }) => self.servo(&mut inside, pose, within_s),
            Some(Command::Cruise { velocity_m_s }) => {
                self.cruise(&inside, velocity_m_s, ENDLESS_S);
            }
            Some(Command::Stop) => self.bench.stand(),
            Some(Command::End) => {
                inside.script = None;
                self.bench.stand();
            }
        }
    }

    /// Ends a protective stop, but not an emergency stop.
    pub(super) fn unlock(&self) {
        let mut inside = self.inside();
        inside.fault = inside.fault.filter(|fault| *fault != ArmFault::Collision);
    }

    /// Moves the tip straight to a pose.
    fn move_line(&self, inside: &mut Inside, pose: [f64; 6], speed_m_s: f64) {
        let [x, y, z, rx, ry, rz] = pose;
        self.bench.stand();
        let Ok(speed) = Speed::try_new(speed_m_s * 1e3 * inside.slider) else {
            return;
        };
        inside.turned = [rx, ry, rz];
        let yaw_rad = 0.0;
        let place = [x, y, z].map(|metres| metres * 1e3);
        self.bench.set_out(Base::pose(place, yaw_rad), speed);
    }

    /// Moves the tip straight to a pose in `within_s`, s. A later target may replace this one before the tip arrives.
    fn servo(&self, inside: &mut Inside, pose: [f64; 6], within_s: f64) {
        let at = self.bench.pose().position;
        let here_mm = Base::to_base([at.x.0, at.y.0, at.z.0]);
        let [x, y, z] = [0, 1, 2].map(|axis| pose[axis] - here_mm[axis] / 1e3);
        self.move_line(inside, pose, x.hypot(y).hypot(z) / within_s);
    }

    /// Moves the tip at a velocity for `lasts_s`, s.
    fn cruise(&self, inside: &Inside, velocity_m_s: [f64; 3], lasts_s: f64) {
        self.bench.stand();
        let speed_mm_s = velocity_m_s.map(|side| side * 1e3 * inside.slider);
        let [x, y, z] = speed_mm_s;
        let Ok(speed) = Speed::try_new(x.hypot(y).hypot(z)) else {
            return;
        };
        let here = self.bench.pose();
        let at = here.position;
        let base_mm = Base::to_base([at.x.0, at.y.0, at.z.0]);
        let there_mm = [0, 1, 2].map(|axis| base_mm[axis] + speed_mm_s[axis] * lasts_s);
        let target = Pose {
            rotation: here.rotation,
            ..Base::pose(there_mm, 0.0)
        };
        self.bench.set_out(target, speed);
    }

    /// Replaces the running program.
    pub(super) fn run(&self, program: &Program) {
        let mut inside = self.inside();
        if inside.fault.is_some() {
            return;
        }
        self.bench.stand();
        inside.script = None;
        match program {
            &Program::MoveLine { pose, speed_m_s } => self.move_line(&mut inside, pose, speed_m_s),
            &Program::Cruise {
                velocity_m_s,
                lasts_s,
            } => self.cruise(&inside, velocity_m_s, lasts_s),
            Program::Stop { number } => {
                inside.stop_number = number.unwrap_or(inside.stop_number);
            }
            Program::Registers(setup) => {
                inside.script = Some(RegisterScript::begun(setup.clone()));
            }
            Program::Other => {}
        }
    }
}
