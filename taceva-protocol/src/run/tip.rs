//! The tip of the robot: every motion is admitted, cut into segments where the gel may be touched, and followed by a look.

use std::time::Duration;

use taceva_core::{
    Deadline, Degree, ErrorKind, ForceTransducer, Millimetre, Nanometre, Point, Pose, Robot,
    Rotation, Speed,
};

use super::align::Look;
use super::bounds::Bounds;
use super::error::StopCause;
use super::supervisor::{Observation, Stage, Supervisor, distance};
use super::time::{Cancel, Timekeeper};
use super::trip::Trip;
use crate::plan::Plan;

/// A transducer that says nothing for so long is asked again, until the supervisor calls it silent.
const READ_DEADLINE: Duration = Duration::from_millis(20);
/// Questions in a row that remain without answer, should the clock stand still.
const READ_TRIES: u32 = 16;
/// For everything that is no motion.
pub(super) const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));
/// Above the first contact by this much the tip is in the air again, in mm.
const AIR_MM: f64 = 0.5;
/// Looks that must find force and pose healthy before the tip moves again after a fault.
const RECOVERY_TRIES: u32 = 10;
const RECOVERY_REST: Duration = Duration::from_millis(20);

/// A step of a press: done, or the reason why the run must stop.
pub(super) type Step<T> = Result<T, StopCause>;

/// The tip, and those who watch it.
pub(super) struct Tip<'a> {
    pub(super) robot: &'a mut dyn Robot,
    pub(super) force: &'a mut dyn ForceTransducer,
    pub(super) clock: &'a mut dyn Timekeeper,
    pub(super) cancel: &'a Cancel,
    pub(super) supervisor: Supervisor,
    pub(super) bounds: Bounds,
    pub(super) pace: Pace,
    /// Where it was sent last.
    target: Pose,
    /// The height of the first contact, while it may be in the gel.
    contact_mm: Option<f64>,
    /// Whether the robot itself reported a fault: then a person must look first.
    robot_failed: bool,
    /// Whether a wish to stop is left for later, because the tip is leaving already.
    deaf: bool,
}

/// How fast, how far, how hard.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    contact: Speed,
    travel: Speed,
    segment_mm: f64,
    step_mm: f64,
    search_mm: f64,
    settle: Duration,
    threshold_n: f64,
    pub(super) clearance_mm: f64,
}

impl Pace {
    /// The pace of `plan`; `None` of a plan in which nothing moves.
    pub(super) fn of(plan: &Plan) -> Option<Pace> {
        let limits = plan.limits.as_ref()?;
        let contact = &plan.contact;
        Some(Pace {
            contact: Speed::try_new(contact.speed_mm_s.value).ok()?,
            travel: Speed::try_new(limits.speed_max_mm_s).ok()?,
            segment_mm: limits.overshoot.segment_mm,
            step_mm: contact.step_mm.value,
            search_mm: contact.search_mm.value,
            settle: Duration::from_secs_f64(contact.settle_s.value),
            threshold_n: contact.threshold_n.value,
            clearance_mm: contact.clearance_mm.value,
        })
    }
}

impl<'a> Tip<'a> {
    pub(super) fn new(
        (robot, force): (&'a mut dyn Robot, &'a mut dyn ForceTransducer),
        (clock, cancel): (&'a mut dyn Timekeeper, &'a Cancel),
        supervisor: Supervisor,
        (bounds, pace): (Bounds, Pace),
    ) -> Tip<'a> {
        Tip {
            robot,
            force,
            clock,
            cancel,
            supervisor,
            bounds,
            pace,
            target: Pose::default(),
            contact_mm: None,
            robot_failed: false,
            deaf: false,
        }
    }

    /// Learns where it stands, and goes straight up to the height of travel if it stands below.
    pub(super) fn find(&mut self) -> Step<()> {
        self.clear_halt()?;
        self.target = self.pose()?.0;
        let height = -self.pace.clearance_mm;
        if self.target.position.z.0 > height {
            // Whoever left it there may have left it in the gel.
            self.contact_mm = Some(self.target.position.z.0);
            self.retreat()?;
        }
        Ok(())
    }

    /// Goes through the air to `place` at `height_mm`, and calls the force there zero.
    pub(super) fn travel(&mut self, place: [f64; 2], turn: Degree, height_mm: f64) -> Step<()> {
        let [x, y] = place.map(Millimetre);
        let z = Millimetre(height_mm);
        let over = Pose {
            position: Point { x, y, z },
            rotation: Rotation {
                z: turn,
                ..Rotation::default()
            },
        };
        // The tip stands at this height or above it, so the way there is in the air.
        self.watch_travel(f64::INFINITY);
        self.go(over, self.pace.travel)?;
        if let Some(tare) = self.force.tare() {
            tare.zero(DEADLINE)?;
        }
        self.watch_travel(self.pace.threshold_n);
        self.look().map(drop)
    }

    /// Goes down step by step until the gel is felt; the height of the tip then, or `None` at the end of the search.
    pub(super) fn search(&mut self) -> Step<Option<Look>> {
        let now_s = self.clock.now_s();
        self.supervisor.watch(Stage::Search, now_s);
        let start = self.target.position.z.0;
        // Until it is felt, the gel may be anywhere below.
        self.contact_mm = Some(start);
        for step in 1_u32.. {
            let z = start + f64::from(step) * self.pace.step_mm;
            if z > self.pace.search_mm {
                break;
            }
            self.approach([self.target.position.x.0, self.target.position.y.0, z])?;
            self.clock.rest(self.pace.settle);
            let look = self.look()?;
            if look.wrench.force[2].0 >= self.pace.threshold_n {
                let height_mm = look.pose.position.z.0;
                self.contact_mm = Some(height_mm);
                let now_s = self.clock.now_s();
                self.supervisor.watch(Stage::Press { height_mm }, now_s);
                return Ok(Some(look));
            }
        }
        Ok(None)
    }

    /// Goes straight to a place in mm, in segments, each followed by a look.
    pub(super) fn approach(&mut self, [x, y, z]: [f64; 3]) -> Step<()> {
        let from = self.target;
        let [x, y, z] = [x, y, z].map(Millimetre);
        let to = Pose {
            position: Point { x, y, z },
            ..from
        };
        let segments = (distance(&from, &to) / self.pace.segment_mm)
            .ceil()
            .max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a way within the bounds has some thousand segments"
        )]
        let segments = segments as u32;
        for segment in 1..segments {
            self.go(
                part_way(&from, &to, f64::from(segment) / f64::from(segments)),
                self.pace.contact,
            )?;
        }
        self.go(to, self.pace.contact)
    }

    /// Lets the gel come to rest, and looks.
    pub(super) fn settle(&mut self) -> Step<Look> {
        self.clock.rest(self.pace.settle);
        self.look()
    }

    /// Leaves the gel along the way it came, under watch, up to the height of travel.
    pub(super) fn retreat(&mut self) -> Step<()> {
        self.clear_halt()?;
        self.target = self.pose()?.0;
        let now_s = self.clock.now_s();
        self.supervisor.watch(
            Stage::Retreat {
                force_n: f64::INFINITY,
            },
            now_s,
        );
        let force_n = self.look()?.wrench.force[2].0;
        let now_s = self.clock.now_s();
        self.supervisor.watch(Stage::Retreat { force_n }, now_s);
        let Point { x, y, z } = self.target.position;
        let height = -self.pace.clearance_mm;
        let air = self
            .contact_mm
            .map_or(height, |contact| (contact - AIR_MM).max(height));
        if z.0 > air {
            self.approach([x.0, y.0, air])?;
        }
        let z = Millimetre(height.min(z.0));
        let up = Pose {
            position: Point { x, y, z },
            ..self.target
        };
        self.go(up, self.pace.travel)?;
        self.contact_mm = None;
        Ok(())
    }

    /// After a fault: leaves the gel if force and pose can be trusted again, else stays halted. Whether it is in the air.
    pub(super) fn abandon(&mut self) -> bool {
        let _ = self.robot.halt();
        if self.robot_failed {
            return false;
        }
        for _ in 0..RECOVERY_TRIES {
            self.clock.rest(RECOVERY_REST);
            let retreated = self.is_trustworthy() && self.go_clear().is_ok();
            if retreated {
                return true;
            }
            let _ = self.robot.halt();
            if self.robot_failed {
                return false;
            }
        }
        false
    }

    fn go_clear(&mut self) -> Step<()> {
        // A wish to stop is no reason to stay in the gel.
        self.deaf = true;
        let done = self.retreat();
        self.deaf = false;
        done
    }

    /// Whether two looks at the resting tip are healthy and differ, as those of a live transducer do.
    fn is_trustworthy(&mut self) -> bool {
        if self.clear_halt().is_err() {
            return false;
        }
        let now_s = self.clock.now_s();
        self.supervisor.watch(
            Stage::Retreat {
                force_n: f64::INFINITY,
            },
            now_s,
        );
        match self.pose() {
            Ok((pose, _)) => self.target = pose,
            Err(_) => return false,
        }
        match (self.look(), self.look()) {
            (Ok(one), Ok(other)) => one.wrench != other.wrench,
            _ => false,
        }
    }

    fn watch_travel(&mut self, threshold_n: f64) {
        let now_s = self.clock.now_s();
        self.supervisor.watch(Stage::Travel { threshold_n }, now_s);
    }

    fn clear_halt(&mut self) -> Step<()> {
        self.robot.clear_halt(DEADLINE).map_err(|error| {
            self.robot_failed = true;
            StopCause::Device(error)
        })
    }

    fn pose(&mut self) -> Step<(Pose, f64)> {
        match self.robot.pose(DEADLINE) {
            Ok((pose, stamp)) => Ok((pose, stamp.valid_s)),
            Err(error) => Err(self.failed(error)),
        }
    }

    /// A robot that fails is halted, whatever it says.
    fn failed(&mut self, error: taceva_core::DriverError) -> StopCause {
        let _ = self.robot.halt();
        let is_grave = [ErrorKind::DeviceFault, ErrorKind::Disconnected].contains(&error.kind());
        self.robot_failed |= is_grave;
        StopCause::Device(error)
    }

    /// One straight motion, then a look.
    fn go(&mut self, target: Pose, speed: Speed) -> Step<()> {
        if self.cancel.is_cancelled() && !self.deaf {
            return Err(StopCause::Cancelled);
        }
        if !is_straight_up(&self.target, &target) {
            self.bounds.admit(&target)?;
        }
        let seconds = 1.0 + 2.0 * distance(&self.target, &target) / speed.mm_per_s();
        let deadline = Deadline::after(Duration::from_secs_f64(seconds));
        self.target = target;
        if let Err(error) = self.robot.move_to(target, speed, deadline) {
            return Err(self.failed(error));
        }
        self.look().map(drop)
    }

    /// Reads force and pose and shows both to the supervisor.
    pub(super) fn look(&mut self) -> Step<Look> {
        let (wrench, wrench_s) = self.read_force()?;
        let (pose, stamp) = match self.robot.pose(DEADLINE) {
            Ok(read) => read,
            Err(error) => return Err(self.failed(error)),
        };
        let observation = Observation::Pose {
            pose,
            stamp,
            target: self.target,
        };
        self.show(&observation)?;
        Ok(Look {
            wrench,
            wrench_s,
            pose,
            pose_s: stamp.valid_s,
        })
    }

    fn read_force(&mut self) -> Step<(taceva_core::Wrench, f64)> {
        for _ in 0..READ_TRIES {
            match self.force.read(Deadline::after(READ_DEADLINE)) {
                Ok((wrench, stamp)) => {
                    self.show(&Observation::Force(wrench, stamp))?;
                    return Ok((wrench, stamp.valid_s));
                }
                Err(error) if error.kind() == ErrorKind::Timeout => {
                    self.show(&Observation::Silence)?
                }
                Err(error) if error.kind() == ErrorKind::OutOfRange => {
                    let force_n = f64::INFINITY;
                    let trip = self.supervisor.trip(Trip::Saturated { force_n });
                    return Err(StopCause::Tripped(trip));
                }
                Err(error) => {
                    let _ = self.robot.halt();
                    return Err(StopCause::Device(error));
                }
            }
        }
        let age_s = READ_DEADLINE.as_secs_f64() * f64::from(READ_TRIES);
        let trip = self.supervisor.trip(Trip::StaleForce { age_s });
        Err(StopCause::Tripped(trip))
    }

    fn show(&mut self, observation: &Observation) -> Step<()> {
        let now_s = self.clock.now_s();
        self.supervisor
            .observe(observation, now_s)
            .map_err(StopCause::Tripped)
    }

    /// The place of a station: over `place`, sheared, at `depth` below `height_mm`.
    pub(super) fn station(
        place: [Nanometre; 2],
        shear: [Nanometre; 2],
        height_mm: f64,
        depth: Nanometre,
    ) -> [f64; 3] {
        let side = |axis: usize| Nanometre(place[axis].0 + shear[axis].0).to_millimetres();
        [side(0), side(1), height_mm + depth.to_millimetres()]
    }
}

/// Whether a motion only leaves the gel: that is allowed from wherever the tip was found.
fn is_straight_up(from: &Pose, to: &Pose) -> bool {
    let (start, end) = (&from.position, &to.position);
    start.x == end.x && start.y == end.y && end.z <= start.z
}

/// A pose between two that are turned alike.
fn part_way(from: &Pose, to: &Pose, part: f64) -> Pose {
    let mix = |from: Millimetre, to: Millimetre| Millimetre(from.0 + (to.0 - from.0) * part);
    let (start, end) = (&from.position, &to.position);
    Pose {
        position: Point {
            x: mix(start.x, end.x),
            y: mix(start.y, end.y),
            z: mix(start.z, end.z),
        },
        ..*to
    }
}
