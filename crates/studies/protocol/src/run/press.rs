//! One press: sets specimen, light and place, then executes the motion.

use taceva_core::{Degree, Nanometre, PressOutcome};

use super::align::Look;
use super::depth_zero::{DepthZero, ZeroUnknown};
use super::error::StopCause;
use super::event::Event;
use super::log::{PressLog, PressRecord};
use super::observe::observe;
use super::sample::{self, Gathered, Spot};
use super::session::Run;
use super::shear_way::Sheared;
use super::tip::{DEADLINE, Step, Tip};
use crate::plan::PlannedPress;
use crate::press::Motion;
use crate::scene::DepthOrigin;

impl Run<'_> {
    /// Makes one press, starting and ending at the travel height. If the log `untouched` is given, first stores a frame of the untouched gel there.
    pub(super) fn acquire(
        &mut self,
        planned: &PlannedPress,
        untouched: Option<&mut dyn PressLog>,
    ) -> Step<PressRecord> {
        self.prepare(planned)?;
        if let Some(camera) = &mut self.camera {
            camera.leave();
        }
        if let (Some(log), Some(camera)) = (untouched, &mut self.camera) {
            let now_s = self.tip.clock.now_s();
            let (frame, _) = camera.frame(now_s, &self.tip, self.events)?;
            log.untouched(&frame).map_err(StopCause::Log)?;
            // No force was read while the picture was taken.
            self.tip.look()?;
        }
        let mut gathered = Gathered::default();
        let outcome = match self.press(planned, &mut gathered) {
            Ok(outcome) => outcome,
            Err(cause) => PressOutcome::Limited(self.limit_of(cause)?),
        };
        self.tip.retreat()?;
        if outcome.is_limited() {
            (self.events)(&Event::Retracted);
        }
        Ok(PressRecord {
            press: planned.id,
            outcome,
            zero: gathered.zero,
            force_zero: self.tip.compare_zero()?,
            samples: gathered.samples,
        })
    }

    /// Mounts the specimen, sets the light and moves the tip above the place of the press.
    fn prepare(&mut self, planned: &PlannedPress) -> Step<()> {
        let press = &planned.press;
        if self.mounted != Some(press.specimen) {
            match &mut self.specimens {
                // A moving changer has already mounted the specimen, while the robot was halted.
                Some(changer) if changer.patience().is_none() => {
                    changer.mount(press.specimen, DEADLINE)?;
                    (self.events)(&Event::Mounted(press.specimen));
                }
                _ if self.mounted.is_some() => {
                    let needed = format!("a person to mount a {}", press.specimen);
                    return Err(StopCause::Missing(needed));
                }
                _ => {}
            }
            self.mounted = Some(press.specimen);
        }
        // A press without frames may have no camera, and the camera may contain the lamps.
        if self.lit != press.light
            && (planned.frames || self.has_lamps())
            && let Some(light) = &press.light
        {
            self.set_light(light)?;
            self.lit = Some(light.clone());
            (self.events)(&Event::Lit(light.clone()));
        }
        let place = press.place.map(Nanometre::to_millimetres);
        let turn = Degree(f64::from(press.turn_millidegrees) / 1e3);
        let height = -self.tip.pace.clearance_mm;
        self.tip.travel(place, turn, height)
    }

    fn has_lamps(&mut self) -> bool {
        let camera = self.camera.as_mut();
        self.lighting.is_some() || camera.is_some_and(|camera| camera.sensor.lighting().is_some())
    }

    fn set_light(&mut self, light: &str) -> Step<()> {
        let own = self
            .camera
            .as_mut()
            .and_then(|camera| camera.sensor.lighting());
        match (&mut self.lighting, own) {
            (Some(lighting), _) => Ok(lighting.set(light, DEADLINE)?),
            (None, Some(lighting)) => Ok(lighting.set(light, DEADLINE)?),
            (None, None) => Err(StopCause::Missing(format!(
                "a lighting device that sets `{light}`"
            ))),
        }
    }

    pub(super) fn rehearse(&mut self, planned: &PlannedPress, height_mm: f64) -> Step<()> {
        let press = &planned.press;
        let height = -self.tip.pace.clearance_mm - height_mm;
        let place = press.place.map(Nanometre::to_millimetres);
        let turn = Degree(f64::from(press.turn_millidegrees) / 1e3);
        self.tip.travel(place, turn, height)?;
        for waypoint in press.waypoints() {
            let target = Tip::waypoint(press.place, waypoint.shear, height, waypoint.depth);
            self.tip.approach(target)?;
        }
        if let Some(cycle) = press.load() {
            self.tip.stroke(press.place, cycle, height)?;
        }
        (self.events)(&Event::Rehearsed(planned.id));
        Ok(())
    }

    /// Executes the motion between approach and retreat.
    fn press(&mut self, planned: &PlannedPress, gathered: &mut Gathered) -> Step<PressOutcome> {
        let press = &planned.press;
        if let Motion::Rest { frames } = press.motion {
            let mut before = self.tip.settle()?;
            for number in 0..frames {
                self.sample(planned, Spot::reached(number, 0.0), before, gathered)?;
                // No pause between pictures: the sensor sets the rate.
                before = self.tip.look()?;
            }
            return Ok(PressOutcome::Complete);
        }
        let Some(contact) = self.tip.search()? else {
            return Ok(PressOutcome::NoContact);
        };
        let height = contact.look.pose.position.z;
        (self.events)(&Event::Contact { height });
        match &press.motion {
            Motion::Indent(_) => {
                let is_depth_read = self.plan.reads_depth();
                let zero = match self.plan.contact.depth_from.value {
                    DepthOrigin::Surface => self.tip.depth_zero(contact, is_depth_read)?,
                    DepthOrigin::Contact => {
                        DepthZero::at_contact(height.0, ZeroUnknown::CountedFromContact)
                    }
                };
                gathered.zero = Some(zero);
                self.indent(planned, zero.height.0, gathered)
            }
            Motion::Load(cycle) => {
                self.tip.load(press.place, cycle, height.0)?;
                Ok(PressOutcome::Complete)
            }
            Motion::Touch | Motion::Rest { .. } => {
                let rested = self.tip.settle()?;
                self.sample(planned, Spot::reached(0, 0.0), rested, gathered)?;
                Ok(PressOutcome::Complete)
            }
        }
    }

    pub(super) fn sample(
        &mut self,
        planned: &PlannedPress,
        spot: Spot,
        before: Look,
        gathered: &mut Gathered,
    ) -> Step<()> {
        let camera = self.camera.as_mut().filter(|_| planned.frames);
        let observed = observe(before, &mut self.tip, camera, self.events)?;
        let waypoint = usize::try_from(spot.number)
            .ok()
            .and_then(|number| planned.press.waypoints().get(number))
            .filter(|_| spot.limited_by.is_none());
        let sheared = waypoint.map(|waypoint| Sheared::at(waypoint, &observed.wrench));
        if self.is_shear_known
            && let (Some(sheared), Some(earlier)) = (&sheared, &gathered.sheared)
            && let Some(fault) = sheared.fault(earlier, self.tip.pace.air_n)
        {
            return Err(StopCause::Shear(fault));
        }
        gathered.sheared = sheared;
        let sample = sample::sample(planned, spot, observed, &self.plan.channels);
        let zero_u = gathered.zero.and_then(|zero| zero.uncertainty.ok());
        let sample = sample.with_zero_u_mm(zero_u.map(|deviation| deviation.0));
        gathered.samples.push(sample);
        (self.events)(&Event::Sampled {
            number: gathered.samples.len() - 1,
        });
        Ok(())
    }
}
