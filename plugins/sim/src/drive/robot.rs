//! A robot that carries a ball or a board over a simulated gel.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use taceva_core::{
    ArgSpec, ArgValue, Args, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, ErrorKind, Factory, Facts, Guard, GuardedMotion, GuardedStop, Halt, Millimetre,
    Point, Pose, Rig, Robot, RobotFacts, Speed, Stamp, Workspace, check_pose,
};

use super::error::{ROBOT as KEY, failed, rig_argument, rig_name};
use super::rig::SimulatedRig;
use super::state::{Ended, Motion};
use crate::bench::Bench;
use crate::parameters::Model;

/// Corner of the workspace with the least coordinates, mm, z into the gel; the next constant is the opposite corner.
const LEAST_MM: [f64; 3] = [-40.0, -40.0, -60.0];
const GREATEST_MM: [f64; 3] = [40.0, 40.0, 25.0];
const SPEED_MAX_MM_PER_S: f64 = 100.0;

/// Opens simulated robots.
#[derive(Debug)]
pub struct RobotFactory {
    descriptor: Descriptor,
}

impl RobotFactory {
    /// Creates the factory of `sim/robot`.
    ///
    /// # Errors
    /// [`DescriptorError`] if its description contradicts itself.
    pub fn new() -> Result<RobotFactory, DescriptorError> {
        let facts = RobotFacts::default()
            .with_workspace(workspace())
            .with_speed_max(Speed::try_new(SPEED_MAX_MM_PER_S).ok())
            .with_repeatability(Millimetre(
                Model::GelSight.parameters().robot.positioning_mm,
            ))
            .with_guarded_motion(true);
        let spec = DescriptorSpec::new(
            KEY,
            "simulated robot",
            DriverSource::Simulated,
            Facts::Robot(facts),
        );
        Ok(RobotFactory {
            descriptor: spec.arguments(arguments()).check()?,
        })
    }
}

impl Factory<dyn Robot> for RobotFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<dyn Robot>, DriverError> {
        let rig = SimulatedRig::of(rig, rig_name(args));
        if let Some(gel) = gel(args) {
            let mut state = rig.state();
            if state.sensor_is_open {
                let why = format!(
                    "`gel={gel}`: the bench `{}` already has a sensor, and the robot presses its gel: remove `gel`",
                    rig_name(args)
                );
                return Err(failed(
                    ErrorKind::InvalidArgument,
                    &KEY,
                    "open the robot",
                    why,
                ));
            }
            let seed = args.whole("seed").unsigned_abs();
            state.lay(Bench::new(gel.parameters(), NOMINAL, seed));
        }
        Ok(Box::new(SimulatedRobot {
            rig,
            latch: Arc::default(),
        }))
    }
}

/// Arguments of the robot. The argument `gel` names a gel for a sensor that this bench does not simulate. The gel determines the forces, but pictures
/// do not show the gel.
fn arguments() -> [ArgSpec; 3] {
    let gels = Model::ALL.map(Model::key);
    [
        rig_argument(),
        ArgSpec::choice("gel", gels)
            .optional()
            .help("gel under the tip, if the sensor is outside this bench"),
        ArgSpec::whole("seed", 0, i64::MAX)
            .default(ArgValue::Whole(0))
            .help("seed of the noise of that gel"),
    ]
}

/// Unit number of the gel that `gel` names.
const NOMINAL: u32 = 0;

/// Gel named in `args`; `None` if `args` name no gel.
fn gel(args: &Args) -> Option<Model> {
    Model::from_key(args.get("gel")?.as_text()?)
}

taceva_core::submit_builtin!(dyn Robot, || Ok(Box::new(RobotFactory::new()?)));

struct SimulatedRobot {
    rig: SimulatedRig,
    latch: Arc<Latch>,
}

/// Halt that remains until it is cleared. Each robot has its own latch.
#[derive(Debug, Default)]
struct Latch {
    is_halted: AtomicBool,
}

impl Halt for Latch {
    fn halt(&self) -> Result<(), DriverError> {
        self.is_halted.store(true, Ordering::Release);
        Ok(())
    }
}

impl SimulatedRobot {
    fn go(
        &mut self,
        target: Pose,
        speed: Speed,
        guard_n: Option<f64>,
        deadline: Deadline,
    ) -> Result<(Ended, Stamp), DriverError> {
        let doing = "move the tip";
        check_pose(&target)
            .map_err(|error| failed(ErrorKind::InvalidArgument, &KEY, doing, error))?;
        let Point { x, y, z } = target.position;
        if !workspace().contains(&target.position) {
            let why = format!(
                "{x}, {y}, {z} is outside the workspace from {LEAST_MM:?} to {GREATEST_MM:?} mm"
            );
            return Err(failed(ErrorKind::OutOfRange, &KEY, doing, why));
        }
        if speed.mm_per_s() > SPEED_MAX_MM_PER_S {
            let why = format!("a speed of {speed}, expected at most {SPEED_MAX_MM_PER_S} mm/s");
            return Err(failed(ErrorKind::OutOfRange, &KEY, doing, why));
        }
        // Rounded to the grid of the plugin interface, so a built-in bench and a plugin move alike.
        let speed = Speed::from_metres_per_second(speed.metres_per_second()).unwrap_or(speed);
        let is_halted = || self.latch.is_halted.load(Ordering::Acquire);
        let mut state = self.rig.state();
        let ended = state.travel(&Motion {
            target: target.on_grid(),
            speed_mm_per_s: speed.mm_per_s(),
            patience: deadline.remaining(),
            is_halted: &is_halted,
            guard_n,
        });
        match ended {
            Ended::Arrived | Ended::Guarded => Ok((ended, Stamp::at(state.now()))),
            Ended::OutOfTime => {
                let why = format!("the tip did not arrive within {deadline}");
                Err(failed(ErrorKind::Timeout, &KEY, doing, why))
            }
            Ended::Halted => Err(failed(ErrorKind::Interrupted, &KEY, doing, "it was halted")),
        }
    }
}

impl Robot for SimulatedRobot {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let state = self.rig.state();
        Ok((state.sent(), Stamp::at(state.now())))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        Ok(self.go(target, speed, None, deadline)?.1)
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::clone(&self.latch) as Arc<dyn Halt>
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.latch.is_halted.store(false, Ordering::Release);
        Ok(())
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        Some(self)
    }
}

impl GuardedMotion for SimulatedRobot {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        let force_n = guard.force.0;
        if !(force_n > 0.0 && force_n.is_finite()) {
            let why = format!("the guard force is {force_n} N, expected a finite number above 0");
            let doing = "move the tip under guard";
            return Err(failed(ErrorKind::InvalidArgument, &KEY, doing, why));
        }
        let (ended, stamp) = self.go(target, speed, Some(force_n), deadline)?;
        Ok(if ended == Ended::Guarded {
            let pose = self.rig.state().sent();
            GuardedStop::Guarded { pose, stamp }
        } else {
            GuardedStop::Arrived { stamp }
        })
    }
}

fn workspace() -> Workspace {
    let corner = |[x, y, z]: [f64; 3]| Point {
        x: Millimetre(x),
        y: Millimetre(y),
        z: Millimetre(z),
    };
    Workspace {
        least: corner(LEAST_MM),
        greatest: corner(GREATEST_MM),
    }
}
