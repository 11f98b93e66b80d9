//! A gentle touch at the middle of the gel. The tip descends to the first contact, presses to three times the contact force, and moves slightly
//! sideways. Then it presses deeper, for the comparison with other sessions, and retreats.

use taceva_core::{Axis, Degree};

use super::Reaction;
use super::picture::{FRAMES, Picture, Seen};
use super::signs::Felt;
use crate::plan::PlannedPress;
use crate::run::align::Look;
use crate::run::error::StopCause;
use crate::run::reference_touch::{ReferenceTouch, SessionRecord, SessionSpec, TouchFault};
use crate::run::session::Run;
use crate::run::supervisor::MotionStage;
use crate::run::surface_fit::Surface;
use crate::run::tip::{Step, Tip};
use crate::text::SceneProblem;

/// Number of readings averaged for one force.
const READINGS: u32 = 8;
/// Least ratio of the force of a push to its standard error at which the push counts as measured.
const ERRORS: f64 = 4.0;
/// Force of the touch before the sideways pushes, in multiples of the contact threshold.
const RISE: f64 = 3.0;
/// Greatest force of the touch, as a share of the force limit.
const FORCE_PART: f64 = 0.5;
/// Greatest depth of the touch, as a share of the depth limit.
const DEPTH_PART: f64 = 0.5;
/// Depth for the comparison with other sessions, in mm. A shallower touch varies with the height of the contact.
const REFERENCE_MM: f64 = 0.3;
/// Greatest share of the depth limit and of the force limit for this comparison. Taps use a greater share.
const REFERENCE_PART: f64 = 0.3;
/// Greatest ratio dF/dz ÷ (F/z) of the force F at the depth z: 1.5 for a ball (Hertz).
const SLOPE: f64 = 1.5;
/// Sideways push to each side, in mm.
const PUSH_MM: f64 = 0.2;

impl Run<'_> {
    /// Touches the gel. Compares the forces with the rig file, and the frames in contact with those in the air.
    pub(super) fn touch_gently(
        &mut self,
        session: &SessionSpec<'_>,
        first: &PlannedPress,
        reaction: Reaction,
    ) -> Step<SessionRecord> {
        let pace = self.tip.pace;
        self.tip.travel([0.0; 2], Degree(0.0), -pace.clearance_mm)?;
        let zero = self.tip.raw_zero();
        let in_air = [self.picture()?, self.picture()?];
        let unit = &first.press.unit;
        let specimen = first.press.specimen;
        let earlier = session.touched.iter().rev();
        let earlier = earlier
            .clone()
            .find(|earlier| earlier.unit == *unit && earlier.specimen == specimen);
        let Some(surface) = self.tip.feel_down(pace.air_n)? else {
            let problem = SceneProblem::NothingTouched {
                search_mm: self.plan.contact.search_mm.value,
            };
            let robot = session.rig.robot.as_ref();
            let at = robot.and_then(|robot| robot.origin_mm.at());
            return Err(StopCause::Rig(Box::new(session.rig.error(at, problem))));
        };
        let (height_mm, u_mm) = (surface.height_mm, surface.deviation_mm);
        let press = self.press_on(height_mm)?;
        let pushes = self.push_aside()?;
        let felt = Felt {
            press: press.mean_n,
            pushes,
        };
        if let Some(force) = &session.rig.force
            && let Err(problem) = felt.check(force.axes.value)
        {
            let problem = session.rig.error(force.axes.at(), problem);
            return Err(StopCause::Rig(Box::new(problem)));
        }
        let reference = self.press_deeper(height_mm, earlier.map(|earlier| earlier.depth_mm))?;
        let depth_mm = self.tip.target.position.z.0 - height_mm;
        let force_n = reference.mean_n[2];
        let picture = self.show_touch(height_mm, &in_air)?;
        self.tip.retreat()?;
        let left_n = self.tip.feel()?.magnitude_n();
        if left_n >= pace.air_n {
            return Err(StopCause::Touch(TouchFault::Clings { force_n: left_n }));
        }
        if let ([Some(before), _], Some(seen)) = (&in_air, picture)
            && let Some(later) = self.picture()?
            && let Some(after) = seen.stays(&before.change(&later))
        {
            let in_contact = seen.in_contact;
            return Err(StopCause::Touch(TouchFault::Stays { in_contact, after }));
        }
        Ok(SessionRecord {
            touch: ReferenceTouch {
                unit: unit.clone(),
                specimen,
                height_mm,
                depth_mm,
                force_n,
                height_u_mm: u_mm,
                force_u_n: reference.error_n.hypot(SLOPE * force_n / depth_mm * u_mm),
            },
            zero,
            pushes_felt: pushes.map(|push| push.is_some()),
            picture_changed: picture.is_some(),
            reaction_ms: reaction.reaction_ms,
            overshoot_mm: reaction.overshoot_mm,
        })
    }

    /// Continues the press from the first contact at `height_mm` to [`RISE`] times the contact threshold.
    fn press_on(&mut self, height_mm: f64) -> Step<Force> {
        let wanted_n = (RISE * self.tip.pace.air_n).min(FORCE_PART * self.tip.pace.normal_max_n);
        let deepest_mm = self.deepest_mm(height_mm);
        loop {
            let force = self.tip.feel()?;
            if force.magnitude_n() >= wanted_n {
                return Ok(force);
            }
            let here_mm = self.tip.target.position.z.0;
            if here_mm >= deepest_mm {
                return Err(StopCause::Touch(TouchFault::Weak {
                    force_n: force.magnitude_n(),
                    wanted_n,
                    depth_mm: here_mm - height_mm,
                }));
            }
            self.tip.deepen(deepest_mm)?;
        }
    }

    /// Continues the press to the depth at which sessions are compared. The depth is `earlier_mm`, or at most [`REFERENCE_MM`] in a first session.
    /// Stops earlier at a share of the force limit.
    fn press_deeper(&mut self, height_mm: f64, earlier_mm: Option<f64>) -> Step<Force> {
        let part = match earlier_mm {
            Some(_) => FORCE_PART,
            None => REFERENCE_PART,
        };
        let usual_mm = REFERENCE_MM.min(REFERENCE_PART * self.depth_max_mm());
        let wanted_mm = height_mm + earlier_mm.unwrap_or(usual_mm);
        let wanted_mm = wanted_mm.min(self.deepest_mm(height_mm));
        let greatest_n = part * self.tip.pace.normal_max_n;
        if earlier_mm.is_some() && self.tip.target.position.z.0 > wanted_mm {
            // The present touch was deeper than the earlier one.
            self.tip.deepen_to(wanted_mm)?;
        }
        loop {
            let force = self.tip.feel()?;
            let is_deep = self.tip.target.position.z.0 >= wanted_mm;
            if is_deep || force.magnitude_n() >= greatest_n {
                return Ok(force);
            }
            self.tip.deepen(wanted_mm)?;
        }
    }

    fn deepest_mm(&self, height_mm: f64) -> f64 {
        height_mm + DEPTH_PART * self.depth_max_mm()
    }

    fn depth_max_mm(&self) -> f64 {
        let limits = self.plan.limits.as_ref();
        limits.map_or(0.0, |limits| limits.depth_max.0)
    }

    /// Force of a sideways push to +x, and to +y: half the difference to the force of the opposite push. `None` if the force is not measurable.
    fn push_aside(&mut self) -> Step<[Option<[f64; 3]>; 2]> {
        let measured = self.tip.force.axes();
        let measures_shear = measured.contains(Axis::Fx) && measured.contains(Axis::Fy);
        let mut pushes = [None, None];
        if !measures_shear {
            return Ok(pushes);
        }
        let middle = self.tip.target.position;
        for (axis, push) in pushes.iter_mut().enumerate() {
            let mut forces = [Force::default(); 2];
            for (force, side_mm) in forces.iter_mut().zip([PUSH_MM, -PUSH_MM]) {
                let mut place = [middle.x.0, middle.y.0, middle.z.0];
                place[axis] += side_mm;
                self.tip.approach(place)?;
                *force = self.tip.feel()?;
            }
            self.tip.approach([middle.x.0, middle.y.0, middle.z.0])?;
            let [there, back] = forces;
            let half_n = [0, 1, 2].map(|axis| (there.mean_n[axis] - back.mean_n[axis]) / 2.0);
            let error_n = (there.error_n + back.error_n) / 2.0;
            let is_felt = half_n
                .iter()
                .any(|force_n| force_n.abs() > ERRORS * error_n);
            *push = is_felt.then_some(half_n);
        }
        Ok(pushes)
    }

    /// Continues the press until the frames show the touch. Returns the brightness changes; `None` without frames.
    fn show_touch(&mut self, height_mm: f64, in_air: &[Option<Picture>; 2]) -> Step<Option<Seen>> {
        let [Some(one), Some(other)] = in_air else {
            return Ok(None);
        };
        let in_air = one.change(other);
        let deepest_mm = self.deepest_mm(height_mm);
        let greatest_n = FORCE_PART * self.tip.pace.normal_max_n;
        loop {
            let Some(frame) = self.picture()? else {
                return Ok(None);
            };
            let seen = one.change(&frame).against(&in_air);
            if seen.shows() {
                return Ok(Some(seen));
            }
            let is_deep = self.tip.target.position.z.0 >= deepest_mm;
            if is_deep || self.tip.feel()?.magnitude_n() >= greatest_n {
                let Seen {
                    in_contact, in_air, ..
                } = seen;
                return Err(StopCause::Touch(TouchFault::Unseen { in_contact, in_air }));
            }
            self.tip.deepen(deepest_mm)?;
        }
    }

    /// Average of the next [`FRAMES`] frames; `None` without a camera.
    fn picture(&mut self) -> Step<Option<Picture>> {
        let Some(camera) = &mut self.camera else {
            return Ok(None);
        };
        let mut frames = Vec::new();
        let mut from_s = self.tip.clock.now_s();
        for _ in 0..FRAMES {
            let (frame, _) = camera.frame(from_s, &self.tip, self.events)?;
            frames.push(frame);
            from_s = self.tip.clock.now_s();
            // No force was read during the capture.
            self.tip.look()?;
        }
        Ok(Some(Picture::of(&frames)))
    }
}

impl Tip<'_> {
    /// Descends by steps until the magnitude of the force is at least `threshold_n`. Returns the height of contact, interpolated between the last
    /// step below the threshold and the first step above it. `None` if the search ends before.
    fn feel_down(&mut self, threshold_n: f64) -> Step<Option<Surface>> {
        self.watch(MotionStage::Search);
        let start_mm = self.target.position.z.0;
        self.contact_mm = Some(start_mm);
        let mut before_n = [0.0; 3];
        for step in 1_u32.. {
            let z_mm = start_mm + f64::from(step) * self.pace.step_mm;
            if z_mm > self.pace.search_mm {
                break;
            }
            let middle = self.target.position;
            self.approach([middle.x.0, middle.y.0, z_mm])?;
            let seen = self.settle()?;
            let seen_n = forces(&seen);
            if magnitude(&seen_n) < threshold_n {
                before_n = seen_n;
                continue;
            }
            let force = self.feel()?;
            let felt_n = force.magnitude_n();
            if felt_n < threshold_n {
                before_n = force.mean_n;
                continue;
            }
            // Projected on the direction of the present force, so that noise perpendicular to it does not count.
            let before_n = dot(&before_n, &force.mean_n) / felt_n;
            let rise_n = felt_n - before_n;
            let part = ((threshold_n - before_n) / rise_n).clamp(0.0, 1.0);
            let height_mm = z_mm - self.pace.step_mm * (1.0 - part);
            let of_pose_mm = self.pace.slack_mm / 3.0;
            let u_mm = between_steps_mm(self.pace.step_mm, force.single_n(), rise_n);
            let deviation_mm = u_mm.hypot(of_pose_mm);
            self.contact_mm = Some(height_mm);
            self.is_felt_at(height_mm);
            self.watch(MotionStage::Press { height_mm });
            return Ok(Some(Surface {
                height_mm,
                deviation_mm,
            }));
        }
        Ok(None)
    }

    /// Descends by a quarter of a step, but not below `deepest_mm`.
    fn deepen(&mut self, deepest_mm: f64) -> Step<()> {
        let z_mm = self.target.position.z.0 + 0.25 * self.pace.step_mm;
        self.deepen_to(z_mm.min(deepest_mm))
    }

    fn deepen_to(&mut self, z_mm: f64) -> Step<()> {
        let middle = self.target.position;
        self.approach([middle.x.0, middle.y.0, z_mm])
    }

    /// Mean force of [`READINGS`] readings while the tip rests.
    fn feel(&mut self) -> Step<Force> {
        let mut sum = [0.0; 3];
        let mut squares = [0.0; 3];
        let mut look = self.settle()?;
        for reading in 1..=READINGS {
            for (axis, force_n) in forces(&look).into_iter().enumerate() {
                sum[axis] += force_n;
                squares[axis] += force_n * force_n;
            }
            if reading < READINGS {
                look = self.look()?;
            }
        }
        let count = f64::from(READINGS);
        let mean_n = sum.map(|sum| sum / count);
        let variances = [0, 1, 2].map(|axis| squares[axis] / count - mean_n[axis].powi(2));
        let variance = variances.into_iter().fold(0.0, f64::max);
        Ok(Force {
            mean_n,
            error_n: (variance / (count - 1.0)).sqrt(),
        })
    }
}

/// Standard uncertainty of a height interpolated over a step, in mm. `noise_n` is the noise of a reading, `rise_n` the rise of the force in the step.
fn between_steps_mm(step_mm: f64, noise_n: f64, rise_n: f64) -> f64 {
    // The line between two steps deviates from the curve of a gel by up to an eighth of a step.
    let of_line_mm = step_mm / 8.0 / 3.0_f64.sqrt();
    // The height lies within the step, however small the rise.
    let of_noise_mm = step_mm * (noise_n / rise_n).min(1.0 / 3.0_f64.sqrt());
    of_line_mm.hypot(of_noise_mm)
}

/// Mean force of several readings, by component.
#[derive(Clone, Copy, Debug, Default)]
struct Force {
    mean_n: [f64; 3],
    /// Greatest standard error of the mean among the three components, in N.
    error_n: f64,
}

impl Force {
    fn magnitude_n(&self) -> f64 {
        magnitude(&self.mean_n)
    }

    /// Standard deviation of a single reading, in N.
    fn single_n(&self) -> f64 {
        self.error_n * f64::from(READINGS).sqrt()
    }
}

fn forces(look: &Look) -> [f64; 3] {
    look.wrench.force.map(|force| force.0)
}

fn magnitude(force: &[f64; 3]) -> f64 {
    dot(force, force).sqrt()
}

fn dot(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

#[cfg(test)]
mod tests {
    use super::between_steps_mm;

    #[test]
    fn the_height_of_a_contact_is_known_within_its_step_however_small_the_rise() {
        let [quiet, usual, flat] = [1e-9, 0.005, 10.0].map(|part| between_steps_mm(0.1, part, 1.0));
        assert!((quiet - 0.1 / 8.0 / 3.0_f64.sqrt()).abs() < 1e-6, "{quiet}");
        assert!(quiet < usual && usual < 0.01, "{usual}");
        assert!(flat < 0.06, "{flat}");
    }
}
