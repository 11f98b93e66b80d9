//! `rig check`: the rate, gaps and noise of each device of a rig, and how soon its robot stands after a halt.

use std::fmt;
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, EnablingSwitch, ErrorKind, ForceTransducer, FrameMut, Pose, Robot,
    Sensor, Speed,
};
use taceva_drivers::{Drivers, MonotonicClock};
use taceva_protocol::{Answer, Cancel, Operator, Question, RigFile};

use super::stream::{Listener, Stream};
use super::switch::{SwitchCheck, look_at};
use crate::error::AcquireError;
use crate::presses::{FileDevices, FileOpener};
use crate::scene::open_switch;

/// How long each device is listened to.
const LISTENED: Duration = Duration::from_secs(2);
const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));
const READ_DEADLINE: Deadline = Deadline::after(Duration::from_millis(100));
/// From one question for a pose to the next.
const LOOK: Duration = Duration::from_millis(10);
/// The way on which the robot is halted: straight up, away from the gel, in mm, and how fast, in mm/s.
const WAY_MM: f64 = 5.0;
const WAY_MM_S: f64 = 5.0;
/// The enabling switch is looked at until it was held for so long, or nobody has held it for so long, in s.
const HELD: Duration = Duration::from_secs(1);
const HOLD_PATIENCE_S: f64 = 10.0;
/// From one look at it to the next while the robot moves.
const FEEL: Duration = Duration::from_millis(5);
/// Into it, the halt comes so late.
const INTO: Duration = Duration::from_millis(300);
/// From a halt to a robot that stands, in ms: as the plan demands of a robot that states it.
const HALT_MS: f64 = 50.0;
/// Readings older than so many periods, but at least this, in ms, break a press off.
const STALE_PERIODS: f64 = 3.0;
const STALE_MS: f64 = 50.0;
/// A stated noise may be so much of the measured one.
const NOISE_PART: f64 = 0.5;

/// What was found.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct RigCheck {
    /// The force transducer, at rest; noise in N.
    pub force: Option<Stream>,
    /// The robot at rest, asked for its pose; noise in mm.
    pub robot: Option<Stream>,
    /// The frames of the sensor.
    pub sensor: Option<Stream>,
    /// The enabling switch, where the rig file names one.
    pub switch: Option<SwitchCheck>,
    /// The robot, halted on its way; absent where nobody let it move.
    pub halt: Option<HaltTrip>,
    /// What a run would refuse or be stopped by.
    pub problems: Vec<RigProblem>,
}

/// A robot that was halted on its way up.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct HaltTrip {
    /// Until the halt was acknowledged, in ms.
    pub acknowledged_ms: f64,
    /// Until the motion had ended, in ms.
    pub ended_ms: f64,
    /// How far above its place it was left, in mm.
    pub left_mm: f64,
}

/// What a run will stumble over, and what helps.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub enum RigProblem {
    /// A device that said nothing.
    Unheard {
        /// `force`, `robot` or `sensor`.
        device: &'static str,
    },
    /// Gaps that break presses off.
    Gaps {
        /// The longest, in ms.
        gap_ms: f64,
        /// What is allowed, in ms.
        allowed_ms: f64,
    },
    /// A noise that is greater than is stated.
    Noise {
        /// `force` or `robot`.
        device: &'static str,
        /// As measured, in N or mm.
        measured: f64,
        /// As stated.
        stated: f64,
    },
    /// A robot that stands too late.
    SlowHalt {
        /// In ms.
        ended_ms: f64,
    },
    /// A robot that did not stop.
    NotHalted,
    /// An enabling switch that nobody was seen to hold, though somebody was asked to.
    Unheld,
}

impl fmt::Display for RigProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RigProblem::Unheard { device } => write!(
                f,
                "the {device} said nothing: see its cable, its address in the rig file, and whether another program has it"
            ),
            RigProblem::Gaps { gap_ms, allowed_ms } => write!(
                f,
                "readings of force pause for up to {gap_ms:.0} ms, and a press is broken off at {allowed_ms:.0} ms: take the network or the machine of other work, or start by chrt -f 10"
            ),
            RigProblem::Noise {
                device,
                measured,
                stated,
            } => write!(
                f,
                "the {device} scatters by {measured:.4}, and its driver states {stated:.4}: presses may be halted for nothing; see what shakes it"
            ),
            RigProblem::SlowHalt { ended_ms } => write!(
                f,
                "the robot stood {ended_ms:.0} ms after a halt, expected at most {HALT_MS} ms: lower `speed_mm_s` in contact, or shorten its braking at the controller"
            ),
            RigProblem::Unheld => f.write_str(
                "the enabling switch was never seen held: hold it while the check asks for that, and see `byte` and `mask` of `enable` if it was; nothing moves without it",
            ),
            RigProblem::NotHalted => f.write_str(
                "the robot did not stop at a halt: do not run it; see the driver and the controller",
            ),
        }
    }
}

/// Listens to the devices of `rig`, and halts its robot once on its way up, where `operator` lets it move or it is emulated.
///
/// # Errors
/// [`AcquireError::Scene`] with the line of the rig file, [`AcquireError::Open`] if a device does not open, [`AcquireError::Device`] if one fails.
pub fn check_rig(
    rig: &RigFile,
    drivers: &Drivers,
    mut operator: Option<&mut dyn Operator>,
) -> Result<RigCheck, AcquireError> {
    // First: without it nothing is opened that could move.
    let switch = open_switch(rig, drivers)?;
    let FileDevices {
        robot,
        force,
        sensor,
    } = FileOpener::new(rig, drivers).all()?;
    let mut check = RigCheck {
        force: None,
        robot: None,
        sensor: None,
        switch: None,
        halt: None,
        problems: Vec::new(),
    };
    if let Some((mut force, descriptor)) = force {
        let heard = listen_to_force(&mut *force)?;
        let facts = descriptor.force();
        let period_ms = facts
            .and_then(|facts| facts.rate)
            .map_or(0.0, |rate| 1e3 / rate.0);
        let allowed_ms = STALE_MS.max(STALE_PERIODS * period_ms);
        if heard.gap_ms > allowed_ms {
            let gap_ms = heard.gap_ms;
            check.problems.push(RigProblem::Gaps { gap_ms, allowed_ms });
        }
        let stated = facts.and_then(|facts| facts.noise).map(|noise| noise.0);
        check.note("force", &heard, stated);
        check.force = Some(heard);
    }
    if let Some((mut sensor, _)) = sensor {
        let heard = listen_to_sensor(&mut *sensor)?;
        check.note("sensor", &heard, None);
        check.sensor = Some(heard);
    }
    if let Some(switch) = &switch {
        check.feel(&**switch, &mut operator)?;
    }
    if let Some((mut robot, descriptor)) = robot {
        let heard = listen_to_robot(&mut *robot)?;
        let facts = descriptor.robot();
        let stated = facts.and_then(|facts| facts.pose_noise.or(facts.repeatability));
        check.note("robot", &heard, stated.map(|noise| noise.0));
        check.robot = Some(heard);
        let name = descriptor.key().to_string();
        if rig.simulated || operator.is_some_and(|operator| is_let_move(operator, name)) {
            check.halt_on_its_way(&mut *robot, switch.as_deref())?;
        }
    }
    Ok(check)
}

fn is_let_move(operator: &mut dyn Operator, robot: String) -> bool {
    operator.ask(&Question::Enable(robot), &Cancel::new()) == Answer::Done
}

impl RigCheck {
    fn note(&mut self, device: &'static str, heard: &Stream, stated: Option<f64>) {
        if heard.count == 0 {
            self.problems.push(RigProblem::Unheard { device });
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

    /// Looks at the enabling switch, which somebody who is there is asked to hold.
    fn feel(
        &mut self,
        switch: &dyn EnablingSwitch,
        operator: &mut Option<&mut dyn Operator>,
    ) -> Result<(), AcquireError> {
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

    /// Nothing moves while somebody lets the enabling switch go, where there is one.
    fn halt_on_its_way(
        &mut self,
        robot: &mut dyn Robot,
        switch: Option<&dyn EnablingSwitch>,
    ) -> Result<(), AcquireError> {
        let is_let_go = || switch.is_some_and(|switch| !switch.is_held().unwrap_or(false));
        if is_let_go() {
            return Ok(());
        }
        robot.clear_halt(DEADLINE)?;
        let (from, _) = robot.pose(DEADLINE)?;
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
                return Ok(());
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error.into()),
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
        Ok(())
    }
}

/// Whether a device only said nothing in time.
fn came_late(error: &DriverError) -> bool {
    error.kind() == ErrorKind::Timeout
}

/// Calls `hear` until the time is over.
fn listen(
    mut hear: impl FnMut(&mut Listener) -> Result<(), DriverError>,
) -> Result<Stream, DriverError> {
    let mut listener = Listener::default();
    let until_s = MonotonicClock.now_s() + LISTENED.as_secs_f64();
    while MonotonicClock.now_s() < until_s {
        match hear(&mut listener) {
            Err(error) if !came_late(&error) => return Err(error),
            _ => {}
        }
    }
    Ok(listener.heard())
}

fn listen_to_force(force: &mut dyn ForceTransducer) -> Result<Stream, DriverError> {
    force.start(DEADLINE)?;
    let heard = listen(|listener| {
        let (wrench, stamp) = force.read(READ_DEADLINE)?;
        listener.hear(stamp.valid_s, MonotonicClock.now_s());
        listener.measure(wrench.force.map(|force| force.0));
        if let Some(number) = force.sequence() {
            listener.number(number);
        }
        Ok(())
    });
    let stopped = force.stop();
    let heard = heard?;
    stopped?;
    Ok(heard)
}

fn listen_to_robot(robot: &mut dyn Robot) -> Result<Stream, DriverError> {
    listen(|listener| {
        std::thread::sleep(LOOK);
        let (Pose { position, .. }, stamp) = robot.pose(READ_DEADLINE)?;
        listener.hear(stamp.valid_s, MonotonicClock.now_s());
        listener.measure([position.x.0, position.y.0, position.z.0]);
        Ok(())
    })
}

fn listen_to_sensor(sensor: &mut dyn Sensor) -> Result<Stream, AcquireError> {
    sensor.start(DEADLINE)?;
    let info = sensor.frame_info();
    let too_large =
        || AcquireError::Request(format!("frames of {info} are too large for this machine"));
    let mut bytes = vec![0; info.byte_len().ok_or_else(too_large)?];
    let heard = listen(|listener| {
        let into = FrameMut::new(info, &mut bytes)
            .expect("the buffer was made with the length of the frame");
        match sensor.capture(into, Deadline::after(Duration::from_secs(1))) {
            Ok(stamp) => listener.hear(stamp.valid_s, MonotonicClock.now_s()),
            // A damaged frame is a gap.
            Err(error) if error.kind() == ErrorKind::Protocol => {}
            Err(error) => return Err(error),
        }
        Ok(())
    });
    let stopped = sensor.stop();
    let heard = heard?;
    stopped?;
    Ok(heard)
}
