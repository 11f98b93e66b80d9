//! Noise of the signals of a rig, the greatest age of a reading, and detection of a frozen signal.

use taceva_core::{Descriptor, DriverSource, ForceFacts};

use crate::scene::{Scene, Study};
use crate::source::RigInfo;
use crate::text::{SceneError, SceneProblem};

/// Noise and timing of the signals of a rig. [`Default`] is for signals without noise.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Signals {
    /// Noise of the reported pose: one standard deviation per axis, in mm.
    pub pose_noise_mm: f64,
    /// Noise of the force at rest: one standard deviation, in N; 0 if the transducer states no noise.
    pub force_noise_n: f64,
    /// Greatest age of a reading that counts as current, in s.
    pub stale_s: f64,
    /// True if bit-equal readings after a motion mean a frozen signal, even with new sequence numbers. False if the resolution of the transducer is as coarse
    /// as its noise. Then only a repeated sequence number means a frozen signal.
    pub equality_is_frozen: bool,
    /// True if the host subtracts the mean force of 0.25 s without contact. The transducer then sets its own zero only once per session.
    pub host_zero: bool,
    /// Greatest change of the zero force during a press, along any axis, in N. `None` for 5 times the least force that counts as contact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zero_step_max_n: Option<f64>,
}

/// Least value of the greatest age of a reading, in s: three periods of a 60 Hz transducer.
pub const STALE_S: f64 = 0.05;
/// Number of consecutive readings that a transducer slower than 60 Hz may miss.
const STALE_READINGS: f64 = 3.0;
/// Maximum travel of the tip in contact before readings count as stale, in mm.
const BLIND_MM: f64 = 0.25;

/// Force that counts as contact during a motion through the air, in standard deviations of the force noise.
const AIR_NOISES: f64 = 5.0;
/// Suggested contact threshold, in standard deviations of the force noise. It also covers the noise of the zero, and slow drift.
const CALM_NOISES: f64 = 10.0;

/// Default of the greatest change of the zero force during a press, in multiples of the least force that counts as contact.
const ZERO_STEPS: f64 = 5.0;

/// Suggested `threshold_N`, in N, for a force with the noise `noise_n`. `None` if `threshold_n` is at least 5 times the noise.
pub fn calm_threshold_n(noise_n: f64, threshold_n: f64) -> Option<f64> {
    let calm_n = (CALM_NOISES * noise_n * 100.0).ceil() / 100.0;
    (AIR_NOISES * noise_n > threshold_n).then_some(calm_n)
}

impl Default for Signals {
    fn default() -> Signals {
        Signals {
            pose_noise_mm: 0.0,
            force_noise_n: 0.0,
            stale_s: STALE_S,
            equality_is_frozen: true,
            host_zero: false,
            zero_step_max_n: None,
        }
    }
}

impl Signals {
    /// True for signals without noise.
    pub(crate) fn is_default(&self) -> bool {
        *self == Signals::default()
    }

    /// Tolerance of a reported pose along each axis, in mm. A tip this close to its target has arrived.
    pub(crate) fn slack_mm(&self) -> f64 {
        3.0 * self.pose_noise_mm
    }

    /// Least force that exceeds the noise while the tip is in the air, in N.
    pub(crate) fn air_n(&self) -> f64 {
        AIR_NOISES * self.force_noise_n
    }

    /// Greatest change of the zero force during a press, along any axis, in N. `threshold_n` is the contact threshold.
    pub(crate) fn zero_step_n(&self, threshold_n: f64) -> f64 {
        self.zero_step_max_n
            .unwrap_or(ZERO_STEPS * threshold_n.max(self.air_n()))
    }

    /// Derives the signals of `rig` from its descriptors and its rig file.
    pub(super) fn of(scene: &Scene, study: &Study, rig: &RigInfo) -> Result<Signals, SceneError> {
        let force = rig
            .force
            .as_ref()
            .and_then(|descriptor| Some((descriptor, descriptor.force()?)));
        let mut signals = Signals {
            pose_noise_mm: rig.robot.as_ref().map_or(0.0, pose_noise_mm),
            ..Signals::default()
        };
        let of_rig = study.rig.as_ref().and_then(|file| file.force.as_ref());
        signals.zero_step_max_n = of_rig.and_then(|force| force.zero_step_max_n);
        let at = study.force.as_ref().and_then(|force| force.driver.at());
        one_clock(scene, study, rig)?;
        if let Some((descriptor, facts)) = force {
            signals.force_noise_n = facts.noise.map_or(0.0, |noise| noise.0);
            signals.stale_s = stale_s(facts);
            // A transducer without a stated resolution counts as fine; an unnecessary halt is harmless.
            signals.equality_is_frozen = facts.seldom_repeats();
            signals.host_zero = descriptor.source() == DriverSource::Real;
            let who = || format!("the force transducer `{}`", descriptor.key());
            if let (false, false, Some(step)) =
                (facts.numbered, signals.equality_is_frozen, facts.resolution)
            {
                let problem = SceneProblem::FrozenUnseen {
                    who: who(),
                    resolution_n: step.0,
                    noise_n: facts.noise.map_or(0.0, |noise| noise.0),
                };
                return Err(study.device_text(scene).error(at, problem));
            }
            stops_in_time(scene, study, rig, facts)?;
            let speed = &scene.protocol.contact.speed_mm_s;
            if speed.value * signals.stale_s > BLIND_MM {
                let problem = SceneProblem::Blind {
                    found: speed.value,
                    who: who(),
                    stale_ms: signals.stale_s * 1e3,
                    greatest: BLIND_MM / signals.stale_s,
                };
                return Err(scene.text.error(speed.at(), problem));
            }
        }
        Ok(signals)
    }
}

/// Rejects a rig with two clocks: the clock of a simulated bench and the clock of the machine.
///
/// A real sensor may join a bench. Its frames are then stamped on arrival, and the recording counts as simulated.
fn one_clock(scene: &Scene, study: &Study, rig: &RigInfo) -> Result<(), SceneError> {
    let is_simulated = |device: &Descriptor| device.source() == DriverSource::Simulated;
    let Some(robot) = &rig.robot else {
        return Ok(());
    };
    let force = rig.force.as_ref();
    let force = force.filter(|force| is_simulated(force) != is_simulated(robot));
    let sensor = rig.sensor.as_ref();
    let sensor = sensor.filter(|sensor| is_simulated(sensor) && !is_simulated(robot));
    let Some(other) = force.or(sensor) else {
        return Ok(());
    };
    let (simulated, real) = match is_simulated(robot) {
        true => (robot, other),
        false => (other, robot),
    };
    let problem = SceneProblem::MixedClocks {
        simulated: simulated.key().to_string(),
        real: real.key().to_string(),
    };
    let at = study.robot.as_ref().and_then(|robot| robot.driver.at());
    Err(study.device_text(scene).error(at, problem))
}

/// Maximum time from an exceeded limit to a tip at rest, in ms. It includes one period of the transducer, the latency of the link, sending of the halt, and the
/// stop time of the arm.
const HALT_MS: f64 = 50.0;
/// Share of [`HALT_MS`] for the latency of the link and for sending the halt, in ms.
const SEND_MS: f64 = 2.0;

/// Rejects a robot whose stop after an exceeded limit takes longer than [`HALT_MS`].
fn stops_in_time(
    scene: &Scene,
    study: &Study,
    rig: &RigInfo,
    force: &ForceFacts,
) -> Result<(), SceneError> {
    let stop_ms = rig.robot.as_ref().and_then(|robot| {
        let stop_ms = robot.robot()?.stop_ms?;
        Some((robot.key(), stop_ms))
    });
    let Some((robot, stop_ms)) = stop_ms else {
        return Ok(());
    };
    let period_ms = force.rate.map_or(0.0, |rate| 1e3 / rate.0);
    let needed_ms = period_ms + SEND_MS + stop_ms;
    if needed_ms <= HALT_MS {
        return Ok(());
    }
    let problem = SceneProblem::SlowStop {
        robot: robot.to_string(),
        stop_ms,
        needed_ms,
        greatest_ms: HALT_MS,
    };
    let at = study.robot.as_ref().and_then(|robot| robot.driver.at());
    Err(study.device_text(scene).error(at, problem))
}

/// Pose noise that the robot states. The default is the repeatability for a real arm, and zero for a simulated robot.
fn pose_noise_mm(robot: &Descriptor) -> f64 {
    let Some(facts) = robot.robot() else {
        return 0.0;
    };
    let repeatability = facts
        .repeatability
        .filter(|_| robot.source() == DriverSource::Real);
    facts
        .pose_noise
        .or(repeatability)
        .map_or(0.0, |noise| noise.0)
}

fn stale_s(facts: &ForceFacts) -> f64 {
    let of_rate = facts.rate.map(|rate| STALE_READINGS / rate.0);
    of_rate.map_or(STALE_S, |stale_s| stale_s.max(STALE_S))
}

#[cfg(test)]
mod tests {
    use taceva_core::{
        Axes, DescriptorSpec, DriverKey, Facts, Hertz, Millimetre, Newton, RobotFacts,
    };

    use super::*;
    use crate::plan::tests::bench::{SMALL, rig_of, sensor};

    fn device(source: DriverSource, facts: Facts) -> Option<Descriptor> {
        let key = DriverKey::fixed("test/device");
        let spec = DescriptorSpec::new(key, "a device", source, facts);
        spec.check().ok()
    }

    fn rig(source: DriverSource, robot: RobotFacts, force: ForceFacts) -> RigInfo {
        let force = force.with_axes(Axes::FORCE);
        RigInfo {
            robot: device(source, Facts::Robot(robot)),
            force: device(source, Facts::Force(force)),
            sensor: device(source, Facts::Sensor(Box::new(sensor()))),
            ..rig_of(sensor(), Axes::FORCE)
        }
    }

    fn signals(rig: &RigInfo, speed_mm_s: f64) -> Result<Signals, String> {
        let mut scene = Scene::parse("small", SMALL).expect("a scene");
        scene.protocol.contact.speed_mm_s.value = speed_mm_s;
        Signals::of(&scene, &scene.studies[0], rig).map_err(|error| error.to_string())
    }

    #[test]
    fn a_threshold_within_five_times_the_noise_is_replaced_by_one_of_ten_times() {
        assert_eq!(calm_threshold_n(0.0042, 0.02), Some(0.05));
        assert_eq!(calm_threshold_n(0.0039, 0.02), None);
        assert_eq!(calm_threshold_n(0.0042, 0.05), None);
    }

    #[test]
    fn a_real_arm_reports_as_well_as_it_comes_back_and_a_simulated_one_where_it_was_sent() {
        let returns = RobotFacts::default().with_repeatability(Millimetre(0.02));
        let states = returns.with_pose_noise(Millimetre(0.05));
        for (source, facts, expected_mm) in [
            (DriverSource::Real, returns, 0.02),
            (DriverSource::Simulated, returns, 0.0),
            (DriverSource::Real, states, 0.05),
            (DriverSource::Simulated, states, 0.05),
        ] {
            let rig = rig(source, facts, ForceFacts::default());
            let signals = signals(&rig, 1.0).expect("no contradiction");
            assert!((signals.pose_noise_mm - expected_mm).abs() < 1e-12);
            assert_eq!(signals.host_zero, source == DriverSource::Real);
            assert_eq!(signals.is_default(), expected_mm <= 0.0);
        }
    }

    #[test]
    fn a_simulated_robot_and_a_real_transducer_have_two_clocks_and_are_refused_either_way() {
        let (real, simulated) = (DriverSource::Real, DriverSource::Simulated);
        let with = |robot, force, sensor| {
            let mut mixed = rig(robot, RobotFacts::default(), ForceFacts::default());
            let other = rig(force, RobotFacts::default(), ForceFacts::default());
            mixed.force = other.force;
            mixed.sensor = device(
                sensor,
                Facts::Sensor(Box::new(crate::plan::tests::bench::sensor())),
            );
            signals(&mixed, 1.0)
        };
        for (robot, force, sensor) in [
            (simulated, real, simulated),
            (real, simulated, real),
            (real, real, simulated),
        ] {
            let refused = with(robot, force, sensor).expect_err("two clocks");
            assert!(refused.contains("a rig has one clock"), "{refused}");
        }
        // The bench accepts a real sensor and stamps its frames.
        assert!(with(simulated, simulated, real).is_ok());
        assert!(with(real, real, real).is_ok());
    }

    #[test]
    fn a_slow_transducer_may_be_silent_for_three_readings_if_the_tip_is_as_slow() {
        let slow = |rate| {
            let force = ForceFacts::default().with_rate(Hertz(rate));
            rig(DriverSource::Simulated, RobotFacts::default(), force)
        };
        let stale_s = |rate, speed| signals(&slow(rate), speed).map(|signals| signals.stale_s);
        assert_eq!(stale_s(200.0, 5.0), Ok(0.05));
        assert_eq!(stale_s(60.0, 5.0), Ok(0.05));
        assert_eq!(stale_s(10.0, 0.8), Ok(0.3));
        let refused = stale_s(10.0, 1.0).expect_err("0.3 mm blind");
        assert!(
            refused.contains("test/device")
                && refused.contains("300 ms")
                && refused.contains("0.833"),
            "{refused}"
        );
    }

    #[test]
    fn a_robot_that_stops_later_than_a_guard_may_take_is_refused() {
        let with = |rate, stop_ms| {
            let robot = RobotFacts::default().with_stop_ms(stop_ms);
            let force = ForceFacts::default().with_rate(Hertz(rate));
            signals(&rig(DriverSource::Real, robot, force), 0.1)
        };
        assert!(with(200.0, 43.0).is_ok(), "5 + 2 + 43 ms");
        let refused = with(200.0, 44.0).expect_err("51 ms");
        assert!(
            refused.contains("51 ms") && refused.contains("50 ms"),
            "{refused}"
        );
        assert!(with(20.0, 0.0).is_err(), "a period of 50 ms");
    }

    #[test]
    fn equal_readings_betray_a_frozen_signal_only_where_steps_are_finer_than_noise() {
        let of = |noise: Option<f64>, resolution: Option<f64>, numbered| {
            let force = ForceFacts::default()
                .with_noise(noise.map(Newton))
                .with_resolution(resolution.map(Newton))
                .with_numbered(numbered);
            let rig = rig(DriverSource::Simulated, RobotFacts::default(), force);
            signals(&rig, 1.0).map(|signals| signals.equality_is_frozen)
        };
        assert_eq!(of(None, None, false), Ok(true));
        assert_eq!(of(Some(0.003), Some(0.001), false), Ok(true));
        assert_eq!(of(Some(0.003), Some(0.001), true), Ok(true));
        assert_eq!(of(None, None, true), Ok(true));
        assert_eq!(of(Some(0.001), Some(0.01), true), Ok(false));
        for noise in [None, Some(0.001), Some(0.01)] {
            let refused = of(noise, Some(0.01), false).expect_err("nothing would tell");
            assert!(
                refused.contains("frozen") && refused.contains("0.01 N"),
                "{refused}"
            );
        }
    }
}
