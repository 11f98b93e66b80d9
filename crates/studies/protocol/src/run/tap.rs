//! Taps: the tip touches the gel at one place repeatedly, fast and slowly in turn, while listeners record every device.
//!
//! Position, force and frame change at the same moment, so the delay of a device is its latency. The force reaches half of its rise at a fixed
//! distance from the reference height of the tip. The time over this distance decreases with speed; a latency does not.

mod edges;
mod heard;
mod line;

pub use edges::{TapError, Tapped};
pub use heard::TapHeard;

use std::time::Duration;

use taceva_core::{Degree, ForceTransducer, Frame, Millimetre, Robot, SinkError, Speed};

use super::error::{RunError, StopCause};
use super::log::{PressLog, PressRecord};
use super::oversight::Oversight;
use super::reference_touch::{ReferenceTouch, SessionRecord, SessionSpec};
use super::session::Run;
use super::supervisor::{MotionStage, SharedSupervisor};
use super::tip::Step;
use super::{Controls, Devices, Mode, RunSpec};
use crate::content_id::ContentId;
use crate::plan::Plan;

/// Speed of slow taps, as a share of the speed in contact.
const SLOW_PART: f64 = 1.0 / 3.0;
/// Height above the gel at which a tap begins, in mm. It leaves time for a few frames in the air.
const LEAD_MM: f64 = 0.5;
/// Depth and force at the end of a tap, as a share of their limits. The force is predicted from the gentle touch.
const PART: f64 = 0.4;
/// Duration of the recording before the motion.
const BEFORE: Duration = Duration::from_millis(150);
/// Duration of the recording after the motion. It is sufficient for the slowest device.
const AFTER: Duration = Duration::from_millis(600);
/// Number of consecutive interruptions of a tap by stale signals after which the run ends.
const TRIES: u32 = 3;

/// Listener to the devices of a rig during taps, on its own threads.
pub trait TapListener {
    /// Starts recording. The tip is at rest above the gel.
    fn begins(&mut self);
    /// Stops recording after a tap or its interruption, and returns the recording.
    fn ends(&mut self) -> TapHeard;
    /// Called when the last tap is valid and will not be repeated.
    fn counts(&mut self);
}

/// Taps the gel at its middle and measures the latency of each device relative to the pose of the robot.
///
/// Starts like a session (see [`run_guarded`](super::run_guarded)): the operator enables the robot, readings are timed, and a gentle touch must agree
/// with the rig file. Threads pass every force reading and every pose to `supervisor`. The presses of `plan` are not made. The listener captures the
/// frames, because it holds the sensor.
///
/// # Errors
/// [`RunError`] for the causes of [`run_guarded`](super::run_guarded).
pub fn tap<'a>(
    plan: &'a Plan,
    robot: &'a mut dyn Robot,
    force: &'a mut dyn ForceTransducer,
    controls: Controls<'a>,
    supervisor: SharedSupervisor,
    session: SessionSpec<'a>,
    listener: &mut dyn TapListener,
) -> Result<Tapped, RunError> {
    let stopped = |cause| RunError {
        press: None,
        cause,
        left: super::Left::Untouched,
    };
    let unit = plan.units.first().map_or("", String::as_str);
    let spec = RunSpec {
        plan,
        unit,
        mode: Mode::Acquire,
    };
    let devices = Devices {
        robot,
        force,
        sensor: None,
        lighting: None,
        specimens: None,
    };
    let begun = Run::new(
        &spec,
        devices,
        controls,
        Some(Oversight::new(supervisor).with_session(session)),
    );
    let mut run = begun.map_err(stopped)?;
    let tapped = run.tap(listener);
    let stopping = run.stop();
    let tapped = tapped?;
    stopping.map_err(|cause| RunError {
        left: super::Left::Clear,
        ..stopped(cause)
    })?;
    Ok(tapped)
}

impl Run<'_> {
    fn tap(&mut self, listener: &mut dyn TapListener) -> Result<Tapped, RunError> {
        let mounted = match self.plan.presses.first() {
            Some(first) => format!("the {}", first.press.specimen),
            None => "the specimen of the first press".to_owned(),
        };
        let way = format!(
            "up to {} mm above the gel, down for a gentle touch at its middle, then {} taps; {mounted} is mounted",
            self.tip.pace.clearance_mm,
            Tapped::TAPS
        );
        self.enable(way)?;
        self.hold(None)?;
        self.tip
            .find()
            .map_err(|cause| self.abandoned(None, cause))?;
        let mut begun = Begun(None);
        if let Some(first) = self.plan.presses.first() {
            self.begin(&[first.press.place], first, &mut begun)?;
        }
        let touch = begun.0.map(|record| record.touch).ok_or_else(|| {
            let missing = StopCause::Missing("at least one press".to_owned());
            self.abandoned(None, missing)
        })?;
        let way = Way::of(&touch, self.plan);
        let fast = self.tip.pace.contact;
        let slow = Speed::try_new(fast.mm_per_s() * SLOW_PART).unwrap_or(fast);
        let mut tapped = Tapped::new(way.contact_mm, way.reference_mm);
        for number in 0..Tapped::TAPS {
            let speed = if number.is_multiple_of(2) { fast } else { slow };
            tapped.add(self.tap_patiently(&way, speed, listener)?);
            listener.counts();
        }
        Ok(tapped)
    }

    /// Makes one tap; repeats it after stale signals or a released switch.
    fn tap_patiently(
        &mut self,
        way: &Way,
        speed: Speed,
        listener: &mut dyn TapListener,
    ) -> Result<TapHeard, RunError> {
        let mut silences = 0;
        loop {
            self.hold(None)?;
            let cause = match self.tap_once(way, speed, listener) {
                Ok(heard) => return Ok(heard),
                Err(cause) => cause,
            };
            drop(listener.ends());
            silences += u32::from(cause.is_silence());
            let may_try = cause.is_release() || cause.is_silence() && silences < TRIES;
            let error = self.abandoned(None, cause);
            if !may_try || error.left != super::Left::Clear {
                return Err(error);
            }
        }
    }

    fn tap_once(
        &mut self,
        way: &Way,
        speed: Speed,
        listener: &mut dyn TapListener,
    ) -> Step<TapHeard> {
        let tip = &mut self.tip;
        let height_mm = -tip.pace.clearance_mm;
        tip.travel([0.0; 2], Degree(0.0), height_mm)?;
        tip.watch(MotionStage::Search);
        tip.contact_mm = Some(way.contact_mm);
        tip.approach([0.0, 0.0, way.from_mm.max(height_mm)])?;
        let contact_mm = way.contact_mm;
        tip.watch(MotionStage::Press {
            height_mm: contact_mm,
        });
        listener.begins();
        tip.clock.rest(BEFORE);
        tip.look()?;
        let mut bottom = tip.target;
        bottom.position.z = Millimetre(way.bottom_mm);
        tip.go(bottom, speed)?;
        tip.clock.rest(AFTER);
        tip.look()?;
        let heard = listener.ends();
        tip.retreat()?;
        Ok(heard)
    }
}

/// Heights of the tip during a tap, in mm of the sensor frame.
#[derive(Clone, Copy, Debug)]
struct Way {
    from_mm: f64,
    contact_mm: f64,
    bottom_mm: f64,
    /// Reference height. The time at which the tip passes it counts as the time of the tap.
    reference_mm: f64,
}

impl Way {
    fn of(touch: &ReferenceTouch, plan: &Plan) -> Way {
        let limits = plan.limits.as_ref();
        let [depth_max_mm, normal_max_n] =
            limits.map_or([0.0; 2], |limits| [limits.depth_max.0, limits.normal_max.0]);
        // The force of a ball on a gel grows with depth^(3/2) (Hertz 1881); the force of a flat tip grows more slowly.
        let rise = (PART * normal_max_n / touch.force_n).powf(2.0 / 3.0);
        let by_force_mm = touch.depth_mm * rise;
        // At least the depth of the gentle touch is allowed.
        let depth_mm = by_force_mm
            .min(PART * depth_max_mm)
            .max(touch.depth_mm.min(depth_max_mm));
        Way {
            from_mm: touch.height_mm - LEAD_MM,
            contact_mm: touch.height_mm,
            bottom_mm: touch.height_mm + depth_mm,
            reference_mm: touch.height_mm + depth_mm / 2.0,
        }
    }
}

/// Test log that stores the start of the session, and records no press.
struct Begun(Option<SessionRecord>);

impl PressLog for Begun {
    fn is_finished(&self, _: ContentId) -> bool {
        false
    }

    fn append(&mut self, _: &PressRecord) -> Result<(), SinkError> {
        Err("a tap is no press".into())
    }

    fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
        Ok(())
    }

    fn session(&mut self, record: &SessionRecord) -> Result<(), SinkError> {
        self.0 = Some(record.clone());
        Ok(())
    }
}
