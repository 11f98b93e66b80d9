//! The tip of the robot. Every motion is checked and followed by a reading. Near the gel, it is divided into segments.

use std::time::Duration;

use taceva_core::{
    Deadline, Degree, DriverError, ErrorKind, ForceTransducer, Millimetre, Nanometre, Point, Pose,
    Robot, Rotation, Speed, Wrench,
};

use super::align::Look;
use super::bounds::Bounds;
use super::error::StopCause;
use super::load_limit::{Bearing, Felt};
use super::reading::READ_DEADLINE;

use super::halt_reason::Trip;
use super::supervisor::{MotionStage, SharedSupervisor};
use super::surface_fit::DepthForce;
use super::time::{Cancel, Timekeeper};
use super::way::{distance, part_way, settled};
use crate::limits::FROZEN_READINGS;
use crate::plan::Plan;

/// Deadline of every call to a device except motions.
pub(super) const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));
/// Number of motions in addition to twice the segments of a path. After these, the robot counts as stuck.
pub(super) const SPARE_SEGMENTS: f64 = 8.0;

/// Stage while the zero or the present force is unknown: only saturation of the transducer limits the force.
pub(super) const ANY_FORCE: MotionStage = MotionStage::Retreat {
    force_n: f64::INFINITY,
};
/// Force that counts as a collision in the air, in multiples of the contact threshold. It is high because arms shake the objects they carry.
const COLLISION_THRESHOLDS: f64 = 10.0;

/// Result of a step of a press; the error is the cause that stops it.
pub(super) type Step<T> = Result<T, StopCause>;

/// The tip of the robot, with the devices and the supervisor that watch it.
pub(super) struct Tip<'a> {
    pub(super) robot: &'a mut dyn Robot,
    pub(super) force: &'a mut dyn ForceTransducer,
    pub(super) clock: &'a mut dyn Timekeeper,
    pub(super) cancel: &'a Cancel,
    pub(super) supervisor: SharedSupervisor,
    /// True if threads pass every force reading to the supervisor.
    pub(super) is_guarded: bool,
    pub(super) bounds: Bounds,
    pub(super) pace: Pace,
    /// Last pose that was read.
    pub(super) at: Pose,
    /// Target of the last motion.
    pub(super) target: Pose,
    /// Height of the first contact in the sensor frame, in mm; `None` if the tip cannot be in the gel.
    pub(super) contact_mm: Option<f64>,
    /// Stage of the press, which the supervisor knows.
    pub(super) stage: MotionStage,
    /// Normal and shear force of the last reading.
    pub(super) felt: Felt,
    /// Height of the highest known point of the gel, in mm; `None` before the first contact.
    pub(super) surface_mm: Option<f64>,
    /// Readings of the search in progress, or of its repeated last steps; `None` outside of a search.
    pub(super) readings: Option<Vec<DepthForce>>,
    /// True if the robot reported a fault. A person must then check the robot first.
    pub(super) robot_failed: bool,
    /// True while a retreat ignores cancellation.
    pub(super) ignores_cancel: bool,
    /// Zero that the transducer set itself: 0 if it cannot, `None` before. If the host zeroes the force, the transducer sets a zero only once.
    pub(super) box_zero: Option<Wrench>,
    /// True if the zero of the force is valid for the present load of the robot.
    pub(super) is_zero_known: bool,
    /// True if a motion of the robot has been sent in this run.
    pub(super) has_moved: bool,
    /// True while the robot is halted at or above the travel height, so that an operator may reach in.
    pub(super) stands_clear: bool,
}

/// Speeds, lengths, times and forces that control the motions of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    pub(super) contact: Speed,
    pub(super) travel: Speed,
    pub(super) segment_mm: f64,
    pub(super) step_mm: f64,
    pub(super) search_mm: f64,
    settle: Duration,
    pub(super) threshold_n: f64,
    /// Least force that counts as contact while the tip rests in the air, in N: the contact threshold, or more if noise requires it.
    pub(super) air_n: f64,
    pub(super) normal_max_n: f64,
    pub(super) bearing: Bearing,
    pub(super) clearance_mm: f64,
    /// Tolerance of a reported pose along each axis, in mm. A tip this close to its target has arrived.
    pub(super) slack_mm: f64,
    pub(super) host_zero: bool,
    /// Greatest change of the zero force during a press, along any axis, in N.
    pub(super) zero_step_n: f64,
}

impl Pace {
    /// Pace of `plan`; `None` if the plan moves nothing.
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
            air_n: contact.threshold_n.value.max(limits.signals.air_n()),
            normal_max_n: limits.normal_max.0,
            bearing: Bearing {
                depth_max_mm: limits.depth_max.0,
                normal_max_n: limits.normal_max.0,
                shear_max_n: limits.shear_max.0,
                threshold_n: contact.threshold_n.value,
            },
            clearance_mm: contact.clearance_mm.value,
            slack_mm: limits.signals.slack_mm(),
            host_zero: limits.signals.host_zero,
            zero_step_n: limits.signals.zero_step_n(contact.threshold_n.value),
        })
    }
}

/// True if `error` is a timeout without a fault.
pub(super) fn is_silent(error: &DriverError) -> bool {
    error.kind() == ErrorKind::Timeout && error.fault().is_none()
}

impl<'a> Tip<'a> {
    pub(super) fn new(
        robot: &'a mut dyn Robot,
        force: &'a mut dyn ForceTransducer,
        clock: &'a mut dyn Timekeeper,
        cancel: &'a Cancel,
        supervisor: SharedSupervisor,
        bounds: Bounds,
        pace: Pace,
    ) -> Tip<'a> {
        Tip {
            robot,
            force,
            clock,
            cancel,
            supervisor,
            is_guarded: false,
            bounds,
            pace,
            at: Pose::default(),
            target: Pose::default(),
            contact_mm: None,
            stage: ANY_FORCE,
            felt: Felt::default(),
            surface_mm: None,
            readings: None,
            robot_failed: false,
            ignores_cancel: false,
            box_zero: None,
            is_zero_known: false,
            has_moved: false,
            stands_clear: false,
        }
    }

    /// Pose at which the tip is assumed: the target if the reported pose differs from it by no more than the noise.
    pub(super) fn here(&self) -> Pose {
        settled(&self.at, &self.target, self.pace.slack_mm)
    }

    /// Reads the pose of the tip, and raises the tip straight to the travel height if it is lower.
    pub(super) fn find(&mut self) -> Step<()> {
        self.release()?;
        self.find_pose()?;
        let height = -self.pace.clearance_mm;
        if self.target.position.z.0 > height {
            // The tip may have been left in the gel.
            self.contact_mm = Some(self.target.position.z.0);
            self.retreat()?;
        }
        Ok(())
    }

    /// Moves through the air to `place` at `height_mm`, and zeroes the force there. `turn` is the rotation about z.
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
        // The tip is at this height or above it, so the motion is in the air.
        self.watch_way()?;
        self.go(over, self.pace.travel)?;
        self.call_zero()?;
        let threshold_n = self.pace.air_n;
        self.watch(MotionStage::Travel { threshold_n });
        self.look().map(drop)
    }

    /// Sets the stage for a motion through the air. If the zero of the force is known, guard threads watch the motion for collisions.
    pub(super) fn watch_way(&mut self) -> Step<()> {
        if self.is_zero_known || !self.pace.host_zero {
            let threshold_n = match self.is_guarded {
                true => COLLISION_THRESHOLDS * self.pace.air_n,
                false => f64::INFINITY,
            };
            self.watch(MotionStage::Travel { threshold_n });
            return Ok(());
        }
        self.watch(ANY_FORCE);
        let force_n = self.look()?.wrench.force[2].0 + self.pace.normal_max_n;
        self.watch(MotionStage::Retreat { force_n });
        Ok(())
    }

    /// Moves straight to a place in mm, in motions as long as is allowed. Each motion is followed by a reading.
    ///
    /// Each motion starts at the actual pose, so that a lagging tip does not jump to its target.
    pub(super) fn approach(&mut self, [x, y, z]: [f64; 3]) -> Step<()> {
        let [x, y, z] = [x, y, z].map(Millimetre);
        let goal = Pose {
            position: Point { x, y, z },
            ..self.target
        };
        let segment_mm = self.pace.segment_mm;
        let mut patience = SPARE_SEGMENTS + 2.0 * distance(&self.here(), &goal) / segment_mm;
        loop {
            let here = self.here();
            let (way_mm, stride_mm) = (distance(&here, &goal), self.stride_mm(&here, &goal));
            if way_mm <= stride_mm {
                self.go(goal, self.pace.contact)?;
                // After a long motion, a lagging tip moves on. In the last segment, a lag is accepted, because the label has the actual depth.
                if way_mm <= segment_mm || distance(&self.here(), &goal) <= segment_mm {
                    return Ok(());
                }
            } else {
                let next = part_way(&here, &goal, stride_mm / way_mm);
                self.go(next, self.pace.contact)?;
            }
            patience -= 1.0;
            if patience < 0.0 {
                let distance_mm = distance(&self.here(), &goal);
                return Err(self.halt_for(Trip::Diverged { distance_mm }));
            }
        }
    }

    /// Waits for the gel to relax, then reads until the force differs from the force before the last motion.
    pub(super) fn settle(&mut self) -> Step<Look> {
        self.clock.rest(self.pace.settle);
        for _ in 0..FROZEN_READINGS {
            let look = self.look()?;
            if self.supervisor.lock().is_fresh() {
                return Ok(look);
            }
        }
        let readings = FROZEN_READINGS;
        Err(self.halt_for(Trip::Frozen { readings }))
    }

    /// Sets the stage that the supervisor checks. A trip of a guard thread is not cleared, and the robot remains halted.
    pub(super) fn watch(&mut self, stage: MotionStage) {
        self.stage = stage;
        let now_s = self.clock.now_s();
        self.supervisor.lock().watch(stage, now_s);
    }

    /// Ends the halt of the robot. The force is not limited until it is known.
    pub(super) fn release(&mut self) -> Step<()> {
        self.stands_clear = false;
        let supervisor = self.supervisor.clone();
        // Guard threads wait meanwhile: their next readings belong to the new stage.
        let mut held = supervisor.lock();
        let asked_s = self.clock.now_s();
        match self.clear_halt() {
            // A robot that does not answer has a stale pose and stays halted.
            Err(StopCause::Device(error)) if is_silent(&error) => {
                let age_s = self.clock.now_s() - asked_s;
                return Err(StopCause::Tripped(held.trip(Trip::StalePose { age_s })));
            }
            cleared => cleared?,
        }
        self.stage = ANY_FORCE;
        held.release(ANY_FORCE, self.clock.now_s());
        Ok(())
    }

    pub(super) fn halt_for(&mut self, trip: Trip) -> StopCause {
        StopCause::Tripped(self.supervisor.lock().trip(trip))
    }

    fn clear_halt(&mut self) -> Step<()> {
        self.robot.clear_halt(DEADLINE).map_err(|error| {
            // A timeout may pass; any other error needs a person.
            self.robot_failed |= !is_silent(&error);
            StopCause::Device(error)
        })
    }

    /// Reads the pose and makes it the target. A difference from the old target within the noise is ignored.
    pub(super) fn find_pose(&mut self) -> Step<()> {
        let (pose, _) = match self.robot.pose(DEADLINE) {
            Ok(read) => read,
            Err(error) => return Err(self.failed(error)),
        };
        self.at = pose;
        self.target = self.here();
        Ok(())
    }

    /// Halts a robot that failed, and returns the cause.
    ///
    /// After a [`Fault`](taceva_core::Fault) the robot is not moved again, and the fault is not cleared.
    pub(super) fn failed(&mut self, error: DriverError) -> StopCause {
        let _ = self.robot.halt();
        let is_grave = [ErrorKind::DeviceFault, ErrorKind::Disconnected].contains(&error.kind());
        let (tripped, fault) = {
            let supervisor = self.supervisor.lock();
            (supervisor.tripped(), supervisor.fault())
        };
        let error = match fault.filter(|_| error.fault().is_none()) {
            Some(fault) => error.with_fault(fault),
            None => error,
        };
        self.robot_failed |= is_grave || error.fault().is_some();
        let may_be_halted = [ErrorKind::Interrupted, ErrorKind::Timeout].contains(&error.kind());
        if !may_be_halted || error.fault().is_some() {
            return StopCause::Device(error);
        }
        // A guard thread has halted the robot, or has detected first that a signal is missing.
        match tripped {
            Some(trip) => StopCause::Tripped(trip),
            None if error.kind() == ErrorKind::Timeout => StopCause::Device(error),
            None if self.cancel.is_cancelled() => StopCause::Cancelled,
            None => match self.force.read(Deadline::after(READ_DEADLINE)) {
                Err(silent) if silent.kind() != ErrorKind::Timeout => StopCause::Device(silent),
                _ => StopCause::Device(error),
            },
        }
    }

    /// Position for a waypoint, in mm: over `place`, displaced by `shear`, at `depth` below `height_mm`.
    pub(super) fn waypoint(
        place: [Nanometre; 2],
        shear: [Nanometre; 2],
        height_mm: f64,
        depth: Nanometre,
    ) -> [f64; 3] {
        let side = |axis: usize| Nanometre(place[axis].0 + shear[axis].0).to_millimetres();
        [side(0), side(1), height_mm + depth.to_millimetres()]
    }
}

#[cfg(test)]
mod tests;
