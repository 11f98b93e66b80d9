//! `rig check --weight`: the operator hangs a known mass on the transducer. The program compares the change of force with the weight of the mass.

use std::time::Duration;

use taceva_core::{Deadline, ErrorKind, ForceTransducer};
use taceva_drivers::{Drivers, MonotonicClock};
use taceva_protocol::{Answer, Cancel, Operator, Question, RigFile, SceneProblem, Weighing};

use super::listen::LISTENED;
use super::stream::Listener;
use crate::error::AcquireError;
use crate::instruments::today;
use crate::presses::FileOpener;

const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));
const READ_DEADLINE: Deadline = Deadline::after(Duration::from_millis(100));
/// Standard acceleration of free fall, in m/s².
const FREE_FALL_M_S2: f64 = 9.80665;
/// Allowed difference between the measured change and the weight, relative to the weight. Causes are the tolerance of the mass, a tilt of 10 degrees,
/// and the calibration.
const DIFFERENCE: f64 = 0.03;
/// Maximum effect of noise and resolution on the measured change, relative to the weight or the change, whichever is greater.
const HIDDEN: f64 = 0.1;
/// Maximum relative difference from a factor in [`UNITS`] at which a wrong unit is reported.
const NEAR: f64 = 0.05;
/// Units that are often mistaken for newtons, each with its value in N.
static UNITS: [(f64, &str); 4] = [
    (4.448_222, "pounds-force (lbf)"),
    (FREE_FALL_M_S2, "kilograms-force (kgf)"),
    (1e-3 * FREE_FALL_M_S2, "grams-force (gf)"),
    (1e-3, "millinewtons (mN)"),
];

/// Result of hanging a known weight on the transducer of a rig.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct RigWeight {
    /// True if the devices are emulated, as the rig file states.
    pub simulated: bool,
    /// Comparison of the force with the weight, to store in the rig file.
    pub weighing: Weighing,
    /// Change of the force along x, y and z of the sensor, in N.
    pub change_n: [f64; 3],
    /// Ratio of the change of Fz to the weight, as absolute values.
    pub factor: f64,
    /// Description of the contradiction and its remedy; `None` if the change agrees with the weight.
    pub problem: Option<String>,
    /// Text of the rig file with the comparison; `None` if there is a problem, or if the user must edit the file.
    #[serde(skip)]
    pub text: Option<String>,
}

/// Asks `operator` to remove every load from the transducer of `rig`, and to hang `mass_g` on it. Compares the change of Fz with the weight. Nothing moves, and
/// the file is not written.
///
/// # Errors
/// [`AcquireError::Scene`] with the line of a rig file that is invalid or has no transducer. [`AcquireError::OpenOfRig`] and [`AcquireError::Device`] if the
/// transducer fails. [`AcquireError::Request`] if the operator stopped.
pub fn weigh_rig(
    rig: &RigFile,
    drivers: &Drivers,
    operator: &mut dyn Operator,
    mass_g: f64,
) -> Result<RigWeight, AcquireError> {
    let missing =
        || AcquireError::from(rig.error(None, SceneProblem::MissingKey("force".to_owned())));
    let (mut force, _) = FileOpener::new(rig, drivers).force()?.ok_or_else(missing)?;
    force.start(DEADLINE)?;
    let weighed = weigh(&mut *force, operator, mass_g, LISTENED);
    let stopped = force.stop();
    let (weighing, change_n) = weighed?;
    stopped?;
    let factor = weighing.measured_n / weighing.expected_n;
    let problem = problem(&weighing, change_n);
    let text = rig.with_weighing(&weighing);
    Ok(RigWeight {
        simulated: rig.simulated,
        weighing,
        change_n,
        factor,
        text: text.filter(|_| problem.is_none()),
        problem,
    })
}

/// Compares the weight of a mass with the change of force. Readings last for the time `lasts`, before and after the weight is hung. Returns the
/// comparison and the change along each axis.
fn weigh(
    force: &mut dyn ForceTransducer,
    operator: &mut dyn Operator,
    mass_g: f64,
    lasts: Duration,
) -> Result<(Weighing, [f64; 3]), AcquireError> {
    let mut rest = |question: Question| match operator.ask(&question, &Cancel::new()) {
        Answer::Done => resting(force, lasts),
        Answer::Skip | Answer::Stop => Err(AcquireError::Request(
            "stopped: the rig file is unchanged".to_owned(),
        )),
    };
    let (before_n, error_before_n) = rest(Question::Unload)?;
    let (after_n, error_after_n) = rest(Question::Hang { mass_g })?;
    let change_n = [0, 1, 2].map(|axis| after_n[axis] - before_n[axis]);
    let expected_n = 1e-3 * mass_g * FREE_FALL_M_S2;
    let step_n = force.resolution().map_or(0.0, |step| step.0);
    let noise_n = 2.0 * error_before_n.hypot(error_after_n) + step_n;
    let rounded = |force_n: f64| (1e4 * force_n).round() / 1e4;
    let weighing = Weighing {
        mass_g,
        expected_n: rounded(expected_n),
        measured_n: rounded(change_n[2].abs()),
        tolerance_n: rounded(DIFFERENCE * expected_n + noise_n).max(1e-4),
        on: today().unwrap_or_else(|| taceva_core::Date::of_unix_s(0)),
    };
    Ok((weighing, change_n))
}

/// Mean force along each axis, and the standard error of its z component, N. Waits for `lasts`, and then averages for `lasts`.
fn resting(
    force: &mut dyn ForceTransducer,
    lasts: Duration,
) -> Result<([f64; 3], f64), AcquireError> {
    // A hung weight still swings.
    std::thread::sleep(lasts);
    let mut listener = Listener::default();
    let begun_s = MonotonicClock.now_s();
    while MonotonicClock.now_s() < begun_s + lasts.as_secs_f64() {
        match force.read(READ_DEADLINE) {
            // A reading from before the pause may be waiting.
            Ok((wrench, stamp)) if stamp.valid_s >= begun_s => {
                listener.measure(wrench.force.map(|force| force.0));
            }
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::Timeout => {}
            Err(error) => return Err(error.into()),
        }
    }
    listener.mean().ok_or_else(|| {
        AcquireError::Request("the force transducer sent no reading with a stamp after the question: check its cable; `taceva rig check` without --weight shows stamps of another clock".to_owned())
    })
}

/// Description of a contradiction in the comparison, with its remedy; `None` without a contradiction.
fn problem(weighing: &Weighing, [x_n, y_n, z_n]: [f64; 3]) -> Option<String> {
    let Weighing {
        mass_g,
        expected_n,
        measured_n,
        tolerance_n,
        ..
    } = *weighing;
    let of_noise_n = tolerance_n - DIFFERENCE * expected_n;
    // A wrong unit scales noise and measured force alike, so the greater force is the reference.
    if of_noise_n > HIDDEN * expected_n.max(measured_n) {
        return Some(format!(
            "{mass_g} g weigh {expected_n:.3} N, expected at least {of_noise_n:.3} N, 10 times the noise and step of the readings: hang a heavier weight"
        ));
    }
    if z_n.abs() < x_n.hypot(y_n) {
        return Some(format!(
            "the force changed by ({x_n:.3}, {y_n:.3}, {z_n:.3}) N along x, y and z, expected along z: turn the transducer so that z is upright, or correct `axes` of [force]"
        ));
    }
    if weighing.is_right() {
        return None;
    }
    let factor = measured_n / expected_n;
    let is_near = |of_unit: f64| (factor / of_unit - 1.0).abs() < NEAR;
    let mistake = UNITS.iter().find_map(|(n_per_unit, unit)| {
        match (is_near(1.0 / n_per_unit), is_near(*n_per_unit)) {
            (true, _) => Some(format!("readings in {unit} are taken for newtons")),
            (_, true) => Some(format!("readings in newtons are converted from {unit}")),
            _ => None,
        }
    });
    let cause = match mistake {
        Some(mistake) => format!(
            "{mistake}: set the unit of the device to N, or correct the arguments of its driver"
        ),
        None => "check the mass, the calibration, and contacts with the transducer".to_owned(),
    };
    Some(format!(
        "Fz changed by {measured_n:.4} N under {mass_g} g, expected {expected_n:.4} ± {tolerance_n:.4} N; the factor is {factor:.4}: {cause}"
    ))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use taceva_core::{Axes, DriverError, Newton, Stamp, Wrench};

    use super::*;

    /// Test transducer. Its readings are the mass in grams that hangs on it, multiplied by `n_per_g`.
    struct Scale<'a> {
        hung_g: &'a AtomicU32,
        n_per_g: [f64; 3],
    }

    impl ForceTransducer for Scale<'_> {
        fn axes(&self) -> Axes {
            Axes::SIX
        }

        fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            std::thread::sleep(Duration::from_millis(1));
            let hung_g = f64::from(self.hung_g.load(Ordering::Relaxed));
            let wrench = Wrench {
                force: self.n_per_g.map(|n_per_g| Newton(0.5 + n_per_g * hung_g)),
                ..Wrench::default()
            };
            let stamp = Stamp {
                valid_s: MonotonicClock.now_s(),
                received_s: None,
            };
            Ok((wrench, stamp))
        }
    }

    /// Test operator who hangs the weight that a question names.
    struct Person<'a>(&'a AtomicU32);

    impl Operator for Person<'_> {
        fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
            let hung_g = match question {
                Question::Unload => 0,
                Question::Hang { .. } => 100,
                _ => return Answer::Stop,
            };
            self.0.store(hung_g, Ordering::Relaxed);
            Answer::Done
        }
    }

    /// Result of hanging 100 g on a transducer whose force along each axis is `n_per_g`, N per g.
    fn weighed(n_per_g: [f64; 3]) -> (Weighing, Option<String>) {
        let hung_g = AtomicU32::new(0);
        let mut scale = Scale {
            hung_g: &hung_g,
            n_per_g,
        };
        let lasts = Duration::from_millis(20);
        let (weighing, change_n) =
            weigh(&mut scale, &mut Person(&hung_g), 100.0, lasts).expect("weighed");
        let problem = problem(&weighing, change_n);
        (weighing, problem)
    }

    const N_PER_G: f64 = 0.009_806_65;

    #[test]
    fn a_weight_that_hangs_or_presses_agrees_with_its_mass_times_free_fall() {
        for sign in [1.0, -1.0] {
            let (weighing, problem) = weighed([0.0, 0.0, 0.98 * sign * N_PER_G]);
            assert_eq!(problem, None);
            assert!(weighing.is_right(), "{weighing:?}");
            assert!((weighing.expected_n - 0.9807).abs() < 1e-9, "{weighing:?}");
            assert!((weighing.measured_n - 0.9611).abs() < 1e-9, "{weighing:?}");
        }
    }

    #[test]
    fn a_mistaken_unit_of_force_is_named_by_its_factor() {
        for (factor, unit) in [
            (1.0 / 4.448, "pounds-force (lbf) are taken for newtons"),
            (4.448, "converted from pounds-force (lbf)"),
            (1.0 / 9.80665, "kilograms-force (kgf) are taken for newtons"),
            (9.80665, "converted from kilograms-force (kgf)"),
            (101.97, "grams-force (gf) are taken for newtons"),
            (1.0 / 101.97, "converted from grams-force (gf)"),
            (1000.0, "millinewtons (mN) are taken for newtons"),
            (1.3, "check the mass"),
        ] {
            let (weighing, problem) = weighed([0.0, 0.0, factor * N_PER_G]);
            let problem = problem.expect("another unit");
            assert!(problem.contains(unit), "{factor}: {problem}");
            assert!(
                problem.contains("under 100 g, expected 0.9807 ±"),
                "{problem}"
            );
            assert!(!weighing.is_right());
        }
    }

    #[test]
    fn a_weight_along_another_axis_and_a_stopped_weighing_say_what_to_do() {
        let (_, problem) = weighed([N_PER_G, 0.0, 0.1 * N_PER_G]);
        let problem = problem.expect("another axis");
        assert!(
            problem.contains("or correct `axes` of [force]"),
            "{problem}"
        );
        let hung_g = AtomicU32::new(0);
        let mut scale = Scale {
            hung_g: &hung_g,
            n_per_g: [0.0; 3],
        };
        struct Nobody;
        impl Operator for Nobody {
            fn ask(&mut self, _: &Question, _: &Cancel) -> Answer {
                Answer::Stop
            }
        }
        let stopped = weigh(&mut scale, &mut Nobody, 100.0, Duration::from_millis(1));
        let message = stopped.expect_err("stopped").to_string();
        assert_eq!(message, "stopped: the rig file is unchanged");
    }
}
