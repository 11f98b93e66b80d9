//! `rig check`: measures rate, gaps and noise of each device of a rig, and the stop time of its robot.

use std::time::Duration;

use taceva_core::{
    Deadline, Descriptor, DriverError, EnablingSwitch, ErrorKind, Robot, Speed, StampAge,
};
use taceva_drivers::{Drivers, MonotonicClock};
use taceva_protocol::{Answer, Cancel, Operator, Question, RigFile};

use super::listen::{
    LISTENED, listen_to_force, listen_to_robot, listen_to_sensor, unopened, without_answer,
};
use super::problem::{HALT_MS, RigProblem};
use super::stock::{Stock, TriedStock, take_stock};
use super::stream::Stream;
use super::switch::{SwitchCheck, look_at};
use crate::error::AcquireError;
use crate::presses::{FileOpener, add_settings};
use crate::scene::{check_switch, is_untaught, open_switch};

const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));
/// Length, mm, of the upward motion that is halted. Its speed is [`WAY_MM_S`], mm/s.
const WAY_MM: f64 = 5.0;
const WAY_MM_S: f64 = 5.0;
/// Duration for which the enabling switch must be held to end its check. The check waits for a hold for at most [`HOLD_PATIENCE_S`], s.
const HELD: Duration = Duration::from_secs(1);
const HOLD_PATIENCE_S: f64 = 10.0;
/// Interval between readings of the switch while the robot moves.
const FEEL: Duration = Duration::from_millis(5);
/// Delay from the start of the motion to the halt.
const INTO: Duration = Duration::from_millis(300);
/// Age of readings at which a press is aborted, in periods; at least [`STALE_MS`], ms.
const STALE_PERIODS: f64 = 3.0;
const STALE_MS: f64 = 50.0;
/// Minimum ratio of the stated noise to the measured noise.
const NOISE_PART: f64 = 0.5;

/// Result of checking a rig.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct RigCheck {
    /// True if the devices are emulated, as the rig file or the robot states.
    pub simulated: bool,
    /// Readings of the force transducer at rest, with noise in N; `None` without a measurement.
    pub force: Option<Stream>,
    /// Poses of the robot at rest, with noise in mm; `None` without a measurement.
    pub robot: Option<Stream>,
    /// Frames of the sensor; `None` without a measurement.
    pub sensor: Option<Stream>,
    /// Enabling switch, if the rig file names a switch.
    pub switch: Option<SwitchCheck>,
    /// Changers and lighting that the rig file names and that opened.
    pub changers: Vec<Stock>,
    /// Halt of the robot in motion; `None` if the halt was skipped.
    pub halt: Option<HaltTrip>,
    /// Reason why the halt was skipped; `None` if it was timed.
    pub halt_left_out: Option<String>,
    /// Settings that the devices report. Names of the transducer's and the robot's settings begin with `force_` and `robot_`.
    pub settings: std::collections::BTreeMap<String, String>,
    /// Warnings of the devices about their readings, and contradictions of certificates. Each has its remedy.
    pub warnings: Vec<String>,
    /// Problems that would reject or stop a run, including devices that failed.
    pub problems: Vec<RigProblem>,
}

/// A halt of the robot during an upward motion.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct HaltTrip {
    /// Time from the halt to its acknowledgement, in ms.
    pub acknowledged_ms: f64,
    /// Time from the halt to the end of the motion, in ms.
    pub ended_ms: f64,
    /// Height above the start at which the robot stopped, in mm.
    pub left_mm: f64,
}

/// Measures the devices of `rig`. Halts the robot once during an upward motion, if `operator` allows it or the rig is emulated.
///
/// Tests every device. A failed device is reported as a problem. Nothing moves if robot, force transducer or enabling switch failed, or if the
/// tip is not above the gel according to the file.
///
/// # Errors
/// [`AcquireError::Scene`] with the line of an invalid rig file, before a device is opened.
pub fn check_rig(
    rig: &RigFile,
    drivers: &Drivers,
    operator: Option<&mut dyn Operator>,
) -> Result<RigCheck, AcquireError> {
    let opener = FileOpener::new(rig, drivers);
    check_switch(rig, drivers)?;
    opener.check()?;
    let mut check = RigCheck {
        simulated: rig.simulated,
        ..RigCheck::default()
    };
    check.measure(rig, drivers, operator);
    check.look_at_certificates(rig);
    Ok(check)
}

fn is_let_move(operator: &mut dyn Operator, robot: String) -> bool {
    let way = format!("{WAY_MM} mm straight up at {WAY_MM_S} mm/s, halted on the way");
    operator.ask(&Question::Enable { robot, way }, &Cancel::new()) == Answer::Done
}

impl RigCheck {
    /// Opens and measures each device.
    fn measure(
        &mut self,
        rig: &RigFile,
        drivers: &Drivers,
        mut operator: Option<&mut dyn Operator>,
    ) {
        let opener = FileOpener::new(rig, drivers);
        // The switch comes first: without it, no robot moves.
        let switch = self.of("switch", open_switch(rig, drivers)).flatten();
        let sensor = self
            .of("sensor", opener.sensor().map_err(unopened))
            .flatten();
        let robot = self.of("robot", opener.robot().map_err(unopened)).flatten();
        let force = self.of("force", opener.force().map_err(unopened)).flatten();
        for TriedStock { key, holds } in take_stock(rig, &opener) {
            if let Some(holds) = self.of(key, holds).flatten() {
                self.changers.push(Stock { key, holds });
            }
        }
        if let Some((mut force, descriptor)) = force {
            let heard = listen_to_force(&mut *force).map_err(without_answer);
            if let Some(heard) = self.of("force", heard) {
                self.hear_force(heard, &descriptor);
            }
            add_settings(&mut self.settings, "force", force.settings());
            self.warnings = force.warnings();
        }
        if let Some((mut sensor, _)) = sensor {
            let heard = listen_to_sensor(&mut *sensor);
            self.settings.extend(sensor.settings());
            if let Some(heard) = self.of("sensor", heard) {
                self.note("sensor", &heard, None);
                self.sensor = Some(heard);
            }
        }
        if let Some(switch) = &switch {
            let felt = self.feel(&**switch, &mut operator).map_err(without_answer);
            self.of("switch", felt);
        }
        let Some((mut robot, descriptor)) = robot else {
            self.halt_left_out = Some(match rig.robot {
                Some(_) => self.obstacle().unwrap_or_default(),
                None => "the rig file has no [robot]".to_owned(),
            });
            return;
        };
        self.simulated |= robot.is_emulated();
        self.warnings.extend(robot.warnings());
        add_settings(&mut self.settings, "robot", robot.settings());
        let heard = listen_to_robot(&mut *robot).map_err(without_answer);
        if let Some(heard) = self.of("robot", heard) {
            let facts = descriptor.robot();
            let stated = facts.and_then(|facts| facts.pose_noise.or(facts.repeatability));
            self.note("robot", &heard, stated.map(|noise| noise.0));
            self.robot = Some(heard);
            let pose = robot.pose(DEADLINE).ok().filter(|_| heard.count > 0);
            let depth_mm = pose.map_or(0.0, |(tip, _)| tip.position.z.0);
            if is_untaught(rig, drivers) {
                self.problems.push(RigProblem::Untaught);
            } else if depth_mm > 0.0 {
                self.problems.push(RigProblem::InGel { depth_mm });
            }
        }
        let name = descriptor.key().to_string();
        self.halt_left_out = self.obstacle();
        if self.halt_left_out.is_some() {
            return;
        }
        if rig.simulated || operator.is_some_and(|operator| is_let_move(operator, name)) {
            let halted = self.halt_on_its_way(&mut *robot, switch.as_deref());
            self.of("robot", halted.map_err(without_answer));
        } else {
            self.halt_left_out = Some("the operator did not permit motion".to_owned());
        }
    }

    /// Result of a step for `device`. A failure is recorded as a problem, and gives `None`.
    fn of<T>(&mut self, device: &'static str, tried: Result<T, impl ToString>) -> Option<T> {
        match tried {
            Ok(done) => Some(done),
            Err(error) => {
                let why = error.to_string();
                self.problems.push(RigProblem::Failed { device, why });
                None
            }
        }
    }

    /// Reason why the robot must not move: a failed device, or an origin so wrong that an upward motion could go down. `None` if it may move.
    fn obstacle(&self) -> Option<String> {
        let failed = self.problems.iter().filter(|problem| problem.is_failure());
        let failed: Vec<&str> = failed
            .filter_map(|problem| match problem.device()? {
                "robot" => Some("the robot"),
                "force" => Some("the force transducer"),
                "switch" => Some("the enabling switch"),
                _ => None,
            })
            .collect();
        let mut problems = self.problems.iter();
        let is_misplaced =
            problems.any(|of| matches!(of, RigProblem::Untaught | RigProblem::InGel { .. }));
        match failed.as_slice() {
            [] if is_misplaced => Some(
                "nothing moves, because `origin_mm` or `axes` of the robot are wrong".to_owned(),
            ),
            [] => None,
            failed => Some(format!(
                "nothing moves, because {} failed",
                failed.join(" and ")
            )),
        }
    }

    /// Records the readings of the force transducer that `descriptor` describes.
    fn hear_force(&mut self, heard: Stream, descriptor: &Descriptor) {
        let facts = descriptor.force();
        let period_ms = facts
            .and_then(|facts| facts.rate)
            .map_or(0.0, |rate| 1e3 / rate.0);
        let allowed_ms = STALE_MS.max(STALE_PERIODS * period_ms);
        if heard.gap_ms > allowed_ms {
            let gap_ms = heard.gap_ms;
            self.problems.push(RigProblem::Gaps { gap_ms, allowed_ms });
        }
        let stated = facts.and_then(|facts| facts.noise).map(|noise| noise.0);
        self.note("force", &heard, stated);
        self.force = Some(heard);
    }

    fn note(&mut self, device: &'static str, heard: &Stream, stated: Option<f64>) {
        if heard.count == 0 {
            self.problems.push(RigProblem::Unheard { device });
        }
        if !StampAge::of(1e-3 * heard.late_ms).is_of_host_clock() {
            let late_ms = heard.late_ms;
            self.problems
                .push(RigProblem::OtherClock { device, late_ms });
        }
        if let (Some(measured), Some(stated)) = (heard.noise, stated)
            && NOISE_PART * measured > stated
        {
            self.problems.push(RigProblem::Noise {
                device,
                measured,
                stated,
            });
        }
    }

    /// Checks the enabling switch. Asks the operator, if any, to hold the switch.
    fn feel(
        &mut self,
        switch: &dyn EnablingSwitch,
        operator: &mut Option<&mut dyn Operator>,
    ) -> Result<(), DriverError> {
        let patience = match operator {
            Some(operator) => {
                operator.call_to_hold(HOLD_PATIENCE_S);
                Duration::from_secs_f64(HOLD_PATIENCE_S)
            }
            None => LISTENED,
        };
        let found = look_at(switch, HELD, patience)?;
        if found.held == 0 && operator.is_some() {
            self.problems.push(RigProblem::Unheld);
        }
        self.switch = Some(found);
        Ok(())
    }

    /// Halts the robot during an upward motion. Nothing moves while an enabling switch is released.
    fn halt_on_its_way(
        &mut self,
        robot: &mut dyn Robot,
        switch: Option<&dyn EnablingSwitch>,
    ) -> Result<(), DriverError> {
        let is_let_go = || switch.is_some_and(|switch| !switch.is_held().unwrap_or(false));
        if is_let_go() {
            self.halt_left_out = Some("the enabling switch was released".to_owned());
            return Ok(());
        }
        self.halt_left_out = Some("the robot failed on its way up".to_owned());
        robot.clear_halt(DEADLINE)?;
        let (from, _) = robot.pose(DEADLINE)?;
        let depth_mm = from.position.z.0;
        if depth_mm > 0.0 {
            // The robot has moved since the last pose, or its pose was not read before.
            self.problems.push(RigProblem::InGel { depth_mm });
            self.halt_left_out = self.obstacle();
            return Ok(());
        }
        let mut up = from;
        up.position.z.0 -= WAY_MM;
        let speed = Speed::try_new(WAY_MM_S).expect("it is above 0");
        let halt = robot.halt_handle();
        let (moved, halted) = std::thread::scope(|scope| {
            let halting = scope.spawn(move || {
                let into_s = MonotonicClock.now_s() + INTO.as_secs_f64();
                while MonotonicClock.now_s() < into_s && !is_let_go() {
                    std::thread::sleep(FEEL);
                }
                let sent_s = MonotonicClock.now_s();
                let done = halt.halt();
                (sent_s, MonotonicClock.now_s(), done)
            });
            let moved = robot.move_to(up, speed, Deadline::after(Duration::from_secs(5)));
            let ended_s = MonotonicClock.now_s();
            let halted = halting.join().expect("a halt does not panic");
            ((moved, ended_s), halted)
        });
        let ((moved, ended_s), (sent_s, acknowledged_s, done)) = (moved, halted);
        done?;
        match moved {
            Ok(_) => {
                self.problems.push(RigProblem::NotHalted);
                self.halt_left_out =
                    Some("the robot did not stop, so no stopping time was measured".to_owned());
                return Ok(());
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
        let (left, _) = robot.pose(DEADLINE)?;
        let trip = HaltTrip {
            acknowledged_ms: (acknowledged_s - sent_s) * 1e3,
            ended_ms: (ended_s - sent_s) * 1e3,
            left_mm: from.position.z.0 - left.position.z.0,
        };
        if trip.ended_ms > HALT_MS {
            let ended_ms = trip.ended_ms;
            self.problems.push(RigProblem::SlowHalt { ended_ms });
        }
        self.halt = Some(trip);
        self.halt_left_out = None;
        Ok(())
    }
}
