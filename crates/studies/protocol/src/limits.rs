//! Limits of a rig. Each is the tightest value among scene, rig file and devices, and cannot be disabled or loosened.

mod signals;

pub use signals::{STALE_S, Signals, calm_threshold_n};

use taceva_core::{DriverSource, Millimetre, Newton, RobotFacts, Wrench};

use crate::limit_spec::LimitSpec;
use crate::scene::{Scene, Study};
use crate::source::RigInfo;
use crate::text::{SceneError, SceneProblem, Setting, Text};

/// Limits of motion and force, and the greatest overshoot of a stop.
///
/// # Units
/// mm, N and mm/s.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct RigLimits {
    /// Deepest indentation, measured from the zero of the press: the fitted surface, or the first contact.
    pub depth_max: Millimetre,
    /// Greatest normal force.
    pub normal_max: Newton,
    /// Greatest shear force; by default the smaller of the limit of the normal force and the range of the transducer. A simulated rig has only the
    /// range by default.
    pub shear_max: Newton,
    /// Greatest force that the transducer measures; `None` if its descriptor states no force.
    pub saturation: Option<Newton>,
    /// Greatest speed out of contact, in mm/s.
    pub speed_max_mm_s: f64,
    /// Travel of the tip beyond a limit until the tip rests.
    pub overshoot: Overshoot,
    /// True if all devices are simulated.
    pub simulated: bool,
    /// Noise, freshness and freeze detection of the signals.
    #[serde(skip_serializing_if = "Signals::is_default")]
    pub signals: Signals,
}

/// Travel of the tip after it passes a limit.
///
/// The tip moves at speed v, and brakes with deceleration a. Force is read every t_sample, sent in t_link and answered in t_react. An unsegmented
/// motion continues for v·(t_sample + t_link + t_react) + v²/2a. Therefore the tip moves in segments of length s = v·15 ms. After each segment it
/// rests until force and pose are stamped later than the stop, so latency adds no travel. The tip does not move while the link delays a force.
///
/// The braking distance b is v·t for a robot that states a stop time t, otherwise v²/2a. The margin m = 3·√2·σ covers the pose noise σ, because depth
/// is the difference of two poses. Every segment is at least 4·σ long, so that it is visible in the pose.
///
/// - With healthy signals, the tip exceeds a limit by at most s + b + m.
/// - With a frozen force signal, by at most n·s + b + m. The rig is halted after n = [`FROZEN_READINGS`](crate::FROZEN_READINGS) equal readings.
///
/// The overshoot in force is this length times the stiffness of the gel, plus the noise of the transducer.
///
/// # Units
/// mm.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Overshoot {
    /// Length of a segment of a motion in contact, mm.
    pub segment_mm: f64,
    /// Overshoot with healthy signals: one segment, the braking distance and the margin for pose noise.
    pub healthy_mm: f64,
    /// Overshoot with a frozen force signal.
    pub frozen_mm: f64,
}

/// Duration of a segment in contact, in s. A limit exceeded within a segment is detected at the segment's end.
pub const SEGMENT_S: f64 = 0.015;
/// Number of bit-equal readings, each after a motion, at which the signal counts as frozen.
pub const FROZEN_READINGS: u32 = 8;
/// Deceleration assumed for a robot that states no deceleration, in mm/s². At 1 m/s², an arm stops from 5 mm/s within 0.0125 mm.
const DECELERATION_MM_S2: f64 = 1_000.0;
/// Least length of a segment of motion, in standard deviations of the reported pose.
const SEGMENT_NOISES: f64 = 4.0;
/// Margin for pose noise, in standard deviations. Fewer than 3 in 1,000 normally distributed values exceed it.
const NOISE_SPREAD: f64 = 3.0;

impl Overshoot {
    /// Overshoot at the contact speed `speed_mm_s`, for a robot with this pose noise.
    pub(crate) fn at(speed_mm_s: f64, robot: &RobotFacts, pose_noise_mm: f64) -> Overshoot {
        let segment_mm = (speed_mm_s * SEGMENT_S).max(SEGMENT_NOISES * pose_noise_mm);
        let deceleration_mm_s2 = robot.deceleration_mm_s2.unwrap_or(DECELERATION_MM_S2);
        let braking_mm = match robot.stop_ms {
            Some(stop_ms) => speed_mm_s * stop_ms * 1e-3,
            None => speed_mm_s * speed_mm_s / (2.0 * deceleration_mm_s2),
        };
        let margin_mm = margin_mm(pose_noise_mm);
        Overshoot {
            segment_mm,
            healthy_mm: segment_mm + braking_mm + margin_mm,
            frozen_mm: f64::from(FROZEN_READINGS) * segment_mm + braking_mm + margin_mm,
        }
    }
}

/// Margin for pose noise in a depth, in mm. A depth is the difference of two poses.
fn margin_mm(pose_noise_mm: f64) -> f64 {
    NOISE_SPREAD * std::f64::consts::SQRT_2 * pose_noise_mm
}

impl RigLimits {
    /// Braking distance of a halted robot, in mm.
    pub(crate) fn braking_mm(&self) -> f64 {
        let Overshoot {
            segment_mm,
            healthy_mm,
            ..
        } = self.overshoot;
        (healthy_mm - segment_mm - margin_mm(self.signals.pose_noise_mm)).max(0.0)
    }

    /// True if a tip may rest at this depth under this force.
    pub(crate) fn hold(&self, depth_mm: f64, wrench: &Wrench) -> bool {
        let [x, y, z] = wrench.force.map(|force| force.0);
        depth_mm <= self.depth_max.0 + self.overshoot.healthy_mm
            && z.abs() <= self.normal_max.0
            && x.hypot(y) <= self.shear_max.0
    }
}

/// A limit, and the name of the device or file that sets it.
struct Stated {
    limit: f64,
    who: String,
}

/// Limits of `study` on `rig`.
pub(crate) fn limits(scene: &Scene, study: &Study, rig: &RigInfo) -> Result<RigLimits, SceneError> {
    let LimitSpec {
        depth_max_mm,
        normal_max_n,
        shear_max_n,
        speed_max_mm_s,
    } = study.limits;
    let sensor = rig.sensor.as_ref();
    let of_sensor = |limit: Option<f64>| {
        let descriptor = sensor?;
        let who = format!("the sensor `{}`", descriptor.key());
        limit.map(|limit| Stated { limit, who })
    };
    let facts = sensor.and_then(|descriptor| descriptor.sensor());
    let transducer = rig.force.as_ref();
    let force = transducer.and_then(|descriptor| descriptor.force());
    let of_force = || {
        let who = format!("the force transducer `{}`", transducer?.key());
        let limit = force?.force_max?.0;
        Some(Stated { limit, who })
    };
    let robot = rig.robot.as_ref();
    let of_robot = robot.and_then(|descriptor| {
        let limit = descriptor.robot()?.speed_max?.mm_per_s();
        let who = format!("the robot `{}`", descriptor.key());
        Some(Stated { limit, who })
    });

    let tighten = Tighten { scene, study };
    let depth = of_sensor(facts.and_then(|facts| Some(facts.depth_limit()?.0)));
    let depth_max = tighten.required("Pz_max_mm", depth_max_mm, [depth, None])?;
    let normal = of_sensor(facts.and_then(|facts| Some(facts.force_max?.0)));
    let normal_max = tighten.required("Fz_max_N", normal_max_n, [normal, of_force()])?;
    let shear_max = tighten.least("Fxy_max_N", shear_max_n, [of_force(), None])?;
    let travel_mm_s = scene.protocol.contact.travel_mm_s;
    let speed_max = tighten.least("speed_max_mm_s", speed_max_mm_s, [of_robot, None])?;
    if let Some(speed_max) = &speed_max
        && travel_mm_s.at().is_some()
        && travel_mm_s.value > speed_max.limit
    {
        return Err(tighten.beyond("travel_mm_s", travel_mm_s, "speed_max_mm_s", speed_max));
    }
    let signals = Signals::of(scene, study, rig)?;
    let arm = robot.and_then(|descriptor| descriptor.robot().copied());
    let devices = [&rig.sensor, &rig.robot, &rig.force, &rig.lighting];
    let simulated = devices
        .iter()
        .filter_map(|device| device.as_ref())
        .all(|device| device.source() == DriverSource::Simulated);
    let of_file = study.rig.as_ref().map(|rig| &rig.limits);
    let is_shear_written =
        shear_max_n.is_some() || of_file.is_some_and(|limits| limits.shear_max_n.is_some());
    let shear_max_n = match shear_max {
        // A simulated gel needs no protection, and its recordings stay the same.
        Some(stated) if is_shear_written || simulated => stated.limit,
        // A range of the transducer tightens this limit and never loosens it.
        Some(stated) => stated.limit.min(normal_max.limit),
        None => normal_max.limit,
    };
    Ok(RigLimits {
        depth_max: Millimetre(depth_max.limit),
        normal_max: Newton(normal_max.limit),
        shear_max: Newton(shear_max_n),
        saturation: of_force().map(|stated| Newton(stated.limit)),
        speed_max_mm_s: speed_max.map_or(travel_mm_s.value, |stated| {
            stated.limit.min(travel_mm_s.value)
        }),
        overshoot: Overshoot::at(
            scene.protocol.contact.speed_mm_s.value,
            &arm.unwrap_or_default(),
            signals.pose_noise_mm,
        ),
        simulated,
        signals,
    })
}

struct Tighten<'a> {
    scene: &'a Scene,
    study: &'a Study,
}

impl Tighten<'_> {
    /// Tightest value of the limit `key` in devices, rig file and scene; `None` if none states it. Rejects a file that loosens a limit.
    fn least(
        &self,
        key: &'static str,
        written: Option<Setting<f64>>,
        stated: [Option<Stated>; 2],
    ) -> Result<Option<Stated>, SceneError> {
        let tightest = stated
            .into_iter()
            .flatten()
            .min_by(|one, other| one.limit.total_cmp(&other.limit));
        let tightest = match &self.study.rig {
            Some(rig) => {
                let of_rig = rig.limits.named().into_iter();
                let of_rig = of_rig.filter(|(named, _)| *named == key);
                let limit = of_rig.filter_map(|(_, limit)| limit).next();
                let who = format!("[limits] of the rig file `{}`", rig.name());
                tightened(key, limit, tightest, &rig.text, who)?
            }
            None => tightest,
        };
        let who = "[limits] of the scene".to_owned();
        tightened(key, written, tightest, &self.scene.text, who)
    }

    fn required(
        &self,
        key: &'static str,
        written: Option<Setting<f64>>,
        stated: [Option<Stated>; 2],
    ) -> Result<Stated, SceneError> {
        self.least(key, written, stated)?.ok_or_else(|| {
            self.scene
                .text
                .error(None, SceneProblem::LimitAbsent { key })
        })
    }

    fn beyond(
        &self,
        key: &'static str,
        written: Setting<f64>,
        limit_key: &'static str,
        stated: &Stated,
    ) -> SceneError {
        let problem = SceneProblem::BeyondLimit {
            key,
            found: written.value,
            limit_key,
            limit: stated.limit,
            who: stated.who.clone(),
        };
        self.scene.text.error(written.at(), problem)
    }
}

/// The limit `written`, otherwise `tightest`; `None` if both are absent.
///
/// # Errors
/// `LimitLoosened` if `written` exceeds `tightest`.
fn tightened(
    key: &'static str,
    written: Option<Setting<f64>>,
    tightest: Option<Stated>,
    text: &Text,
    who: String,
) -> Result<Option<Stated>, SceneError> {
    match (written, tightest) {
        (Some(written), Some(tightest)) if written.value > tightest.limit => {
            let problem = SceneProblem::LimitLoosened {
                key,
                found: written.value,
                who: tightest.who,
                limit: tightest.limit,
            };
            Err(text.error(written.at(), problem))
        }
        (Some(written), _) => Ok(Some(Stated {
            limit: written.value,
            who,
        })),
        (None, tightest) => Ok(tightest),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounds a length to nm, so that floating-point errors do not show.
    fn nanometres(length_mm: f64) -> f64 {
        (length_mm * 1e6).round()
    }

    fn shown(overshoot: Overshoot) -> [f64; 3] {
        let Overshoot {
            segment_mm,
            healthy_mm,
            frozen_mm,
        } = overshoot;
        [segment_mm, healthy_mm, frozen_mm].map(nanometres)
    }

    #[test]
    fn an_arm_without_noise_that_states_nothing_goes_on_by_a_segment_and_half_a_micrometre() {
        let overshoot = Overshoot::at(1.0, &RobotFacts::default(), 0.0);
        assert!(shown(overshoot).iter().eq(&[15_000.0, 15_500.0, 120_500.0]));
    }

    #[test]
    fn what_an_arm_states_of_how_it_stops_counts_in_the_place_of_what_is_assumed() {
        let brakes = RobotFacts::default().with_deceleration_mm_s2(100.0);
        // 2²/(2·100) = 0.02 mm.
        let overshoot = Overshoot::at(2.0, &brakes, 0.0);
        assert!(shown(overshoot).iter().eq(&[30_000.0, 50_000.0, 260_000.0]));
        let stops = brakes.with_stop_ms(30.0);
        // 2 mm/s for 30 ms.
        let overshoot = Overshoot::at(2.0, &stops, 0.0);
        assert!(shown(overshoot).iter().eq(&[30_000.0, 90_000.0, 300_000.0]));
    }

    #[test]
    fn noise_makes_segments_longer_and_the_overshoot_wider() {
        let overshoot = Overshoot::at(1.0, &RobotFacts::default(), 0.05);
        // 4·0.05; and 3·√2·0.05 = 0.212 132 mm.
        let expected = [200_000.0, 412_632.0, 1_812_632.0];
        assert!(shown(overshoot).iter().eq(&expected), "{overshoot:?}");
    }
}
