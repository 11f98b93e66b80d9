//! Taps: the tip touches the gel at one place again and again, fast and slowly in turn, while others listen to every device.
//!
//! Tip, force and picture change at the same moment; what a device says later is its latency. A force that is read at half of its rise was
//! felt a little beside the height at which the pose is taken: that way takes less time the faster the tip goes, and a latency does not.

mod edges;
mod heard;

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

/// The slow ones go at this part of the speed of contact.
const SLOW_PART: f64 = 1.0 / 3.0;
/// So far above the gel a tap begins, in mm: far enough for a few frames in the air.
const LEAD_MM: f64 = 0.5;
/// It ends at this part of the greatest depth, and of the greatest force as far as the first touch foretells it.
const PART: f64 = 0.4;
/// How long is listened before the tip moves, and after it came to rest: the latest device has spoken then.
const BEFORE: Duration = Duration::from_millis(150);
const AFTER: Duration = Duration::from_millis(600);
/// Silence may break a tap off so many times in a row.
const TRIES: u32 = 3;

/// Somebody who listens to the devices of a rig while it taps, in threads of its own.
pub trait TapListener {
    /// A tap begins, with the tip at rest above the gel.
    fn begins(&mut self);
    /// The tap is over, or was broken off: what was heard since it began.
    fn ends(&mut self) -> TapHeard;
    /// The tap was made to its end, and is not made again.
    fn counts(&mut self);
}

/// Taps the gel at its middle, and says by how much later each device says it than the robot says where the tip is.
///
/// It begins as a session does (see [`run_guarded`](super::run_guarded)): somebody enables the robot, readings are timed, and a gentle touch
/// must contradict nothing in the rig file. `supervisor` is shown every reading of force and every pose by threads. The presses of `plan` are
/// not made; they have no pictures, since the sensor is the listener's.
///
/// # Errors
/// [`RunError`] as of [`run_guarded`](super::run_guarded).
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
        self.enable()?;
        self.hold(None)?;
        self.tip
            .find()
            .map_err(|cause| self.abandoned(None, cause))?;
        let mut begun = Begun(None);
        if let Some(first) = self.plan.presses.first() {
            self.begin(&[first.press.place], first, &mut begun)?;
        }
        let touch = begun.0.map(|record| record.touch).ok_or_else(|| {
            let missing = StopCause::Missing("a press: nothing in it touches".to_owned());
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

    /// One tap, again from its beginning where silence or a released switch broke it off.
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

/// From where to where a tap goes, in mm of the sensor's frame.
#[derive(Clone, Copy, Debug)]
struct Way {
    from_mm: f64,
    contact_mm: f64,
    bottom_mm: f64,
    /// The height whose passage is the moment of a tap.
    reference_mm: f64,
}

impl Way {
    fn of(touch: &ReferenceTouch, plan: &Plan) -> Way {
        let limits = plan.limits.as_ref();
        let [depth_max_mm, normal_max_n] =
            limits.map_or([0.0; 2], |limits| [limits.depth_max.0, limits.normal_max.0]);
        // A ball on a gel is pressed by a force that grows as the depth to 3/2 (Hertz 1881), a flat tip by one that grows slower.
        let rise = (PART * normal_max_n / touch.force_n).powf(2.0 / 3.0);
        let by_force_mm = touch.depth_mm * rise;
        // What was touched gently before may be touched again.
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

/// Keeps how the session began; nothing is recorded.
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
