//! Tests that a correct device passes the suites, and that each check fails for a device that violates the check.

use crate::support::folder;
use crate::toy::{FULL_SCALE, Flaw, KEY, ToyFactory, open};
use taceva_conformance::{self as conformance, Outcome, Report, Trial};
use taceva_core::{Args, Descriptor, DriverError, Factory, ForceTransducer, Rig};
use taceva_drivers::{ReplayFactory, VirtualPace};
use taceva_simulation::fault::{FaultKind, FaultPlan, FaultyForce};

fn replay(more: &str) -> Report {
    let folder = folder(20);
    let arguments = format!("folder={}{more}", folder.path().display());
    let factory = ReplayFactory::new().expect("no contradiction");
    conformance::sensor(&factory, &Trial::with_arguments(arguments))
}

#[test]
fn the_replay_keeps_the_contract_in_virtual_time() {
    let report = replay(";rate=30");
    assert!(report.passed(), "{report}");
    let skipped: Vec<_> = report
        .promises
        .iter()
        .filter(|check| matches!(check.outcome, Outcome::Skipped(_)))
        .map(|check| check.name)
        .collect();
    assert_eq!(
        skipped,
        [
            "sensor/gives-the-frames-it-says",
            "sensor/interrupt-within-50-ms",
            "sensor/same-frames-of-a-simulation",
            "sensor/sets-the-light",
        ],
        "{report}"
    );
}

#[test]
fn the_replay_keeps_the_contract_in_real_time() {
    let report = replay(";rate=200;pace=real;repeat=true");
    assert!(report.passed(), "{report}");
}

#[test]
fn a_recording_that_is_too_short_to_be_tried_is_skipped_and_not_failed() {
    let folder = folder(2);
    let arguments = format!("folder={}", folder.path().display());
    let factory = ReplayFactory::new().expect("no contradiction");
    let report = conformance::sensor(&factory, &Trial::with_arguments(arguments));
    assert!(report.passed(), "{report}");
    let captured = report.outcome("sensor/stamps-in-order");
    assert_eq!(
        captured,
        Some(&Outcome::Skipped(
            "the recording ended too early".to_owned()
        ))
    );
}

#[test]
fn a_driver_that_does_not_open_fails_every_check_that_needs_it_open() {
    let factory = ReplayFactory::new().expect("no contradiction");
    let refused = conformance::sensor(&factory, &Trial::with_arguments("foldr=x"));
    assert_eq!(refused.failures(), ["driver/takes-its-arguments"]);
    let absent = conformance::sensor(&factory, &Trial::with_arguments("folder=nowhere"));
    assert!(absent.failures().len() >= 6, "{absent}");
    assert!(absent.to_string().contains("(not found)"), "{absent}");
}

#[test]
fn a_device_of_each_kind_without_a_flaw_passes_every_check() {
    let reports = [
        conformance::sensor(&ToyFactory::sensor(Flaw::Nothing), &Trial::default()),
        conformance::force(&ToyFactory::force(Flaw::Nothing), &Trial::default()),
        conformance::robot(&ToyFactory::robot(Flaw::Nothing), &Trial::default()),
        conformance::lighting(&ToyFactory::lighting(Flaw::Nothing), &Trial::default()),
        conformance::changer(&ToyFactory::changer(Flaw::Nothing), &Trial::default()),
    ];
    for report in reports {
        let all = report
            .promises
            .iter()
            .all(|check| check.outcome == Outcome::Passed);
        assert!(all, "{report}");
    }
}

/// Asserts that each flaw fails its check, and that each check has a flaw that fails it.
fn each_flaw_fails_its_check(suite: fn(Flaw) -> Report, flaws: &[(Flaw, &str)]) {
    for (flaw, check) in flaws {
        let report = suite(*flaw);
        assert!(report.failures().contains(check), "{flaw:?}: {report}");
    }
    let sound = suite(Flaw::Nothing);
    for check in sound.promises.iter().skip(1) {
        let covered = flaws.iter().any(|(_, name)| *name == check.name);
        assert!(covered, "no flaw fails `{}`", check.name);
    }
}

#[test]
fn each_check_of_a_sensor_can_fail() {
    each_flaw_fails_its_check(
        |flaw| conformance::sensor(&ToyFactory::sensor(flaw), &Trial::default()),
        &[
            (Flaw::OtherFrame, "sensor/gives-the-frames-it-says"),
            (Flaw::StampsStandStill, "sensor/stamps-in-order"),
            (Flaw::Panics, "sensor/stamps-in-order"),
            (Flaw::TakesAnyBuffer, "sensor/refuses-other-buffers"),
            (Flaw::IsSlow, "sensor/passed-deadline"),
            (Flaw::StopsForGood, "sensor/starts-and-stops-in-any-order"),
            (Flaw::StopsOnce, "sensor/dropped-in-any-state"),
            (Flaw::DiffersEachTime, "sensor/same-frames-of-a-simulation"),
            (Flaw::HidesLight, "sensor/sets-the-light"),
            (Flaw::DeclaresNoLight, "sensor/sets-the-light"),
            (Flaw::TakesAnyScene, "sensor/sets-the-light"),
            (Flaw::IgnoresDeadline, "sensor/keeps-deadlines"),
            (Flaw::IsFaultyBeforeStart, "sensor/capture-before-start"),
            (Flaw::DiesOfInterrupt, "sensor/interrupt-within-50-ms"),
        ],
    );
}

#[test]
fn each_check_of_a_force_transducer_can_fail() {
    const RANGE: &str = "force/measures-what-it-says";
    each_flaw_fails_its_check(
        |flaw| conformance::force(&ToyFactory::force(flaw), &Trial::default()),
        &[
            (Flaw::OtherAxes, "force/measures-what-it-says"),
            (Flaw::StampsStandStill, "force/stamps-in-order"),
            (Flaw::Overflows, RANGE),
            (Flaw::FillsUnmeasured, RANGE),
            (Flaw::IsSlow, "force/passed-deadline"),
            (Flaw::StopsForGood, "force/starts-and-stops-in-any-order"),
            (Flaw::StopsOnce, "force/dropped-in-any-state"),
            (Flaw::DiffersEachTime, "force/same-readings-of-a-simulation"),
            (Flaw::CannotTare, "force/tares"),
            (Flaw::RepeatsNumber, "force/numbers-its-readings"),
            (Flaw::IgnoresDeadline, "force/keeps-deadlines"),
            (Flaw::IsFaultyBeforeStart, "force/read-before-start"),
            (Flaw::DiesOfInterrupt, "force/interrupt-within-50-ms"),
            (Flaw::OpensToFail, "force/reads"),
        ],
    );
}

#[test]
fn each_check_of_a_robot_can_fail() {
    each_flaw_fails_its_check(
        |flaw| conformance::robot(&ToyFactory::robot(flaw), &Trial::default()),
        &[
            (Flaw::Creeps, "robot/says-its-pose"),
            (Flaw::Overshoots, "robot/moves-and-arrives"),
            (Flaw::TakesNaN, "robot/refuses-targets-that-are-none"),
            (Flaw::LeavesWorkspace, "robot/refuses-what-lies-outside"),
            (
                Flaw::TakesAnySpeed,
                "robot/refuses-speeds-above-its-greatest",
            ),
            (Flaw::IgnoresDeadline, "robot/timeout-stops-it"),
            (Flaw::ForgetsHalt, "robot/halts-twice-and-latches"),
            (Flaw::IgnoresHandle, "robot/halt-within-50-ms"),
            (Flaw::Panics, "robot/halt-within-50-ms"),
            (Flaw::HandleDies, "robot/halt-from-all-sides"),
            (Flaw::TakesAnyGuard, "robot/guards-that-are-none"),
            (Flaw::StopsOnce, "robot/dropped-in-any-state"),
        ],
    );
}

#[test]
fn each_check_of_a_lighting_can_fail() {
    each_flaw_fails_its_check(
        |flaw| conformance::lighting(&ToyFactory::lighting(flaw), &Trial::default()),
        &[
            (Flaw::HidesLight, "lighting/has-the-scenes-it-says"),
            (Flaw::TakesAnyScene, "lighting/refuses-other-scenes"),
            (Flaw::IsSlow, "lighting/passed-deadline"),
            (Flaw::OpensToFail, "lighting/sets-each-scene"),
        ],
    );
}

#[test]
fn each_check_of_a_changer_can_fail() {
    each_flaw_fails_its_check(
        |flaw| conformance::changer(&ToyFactory::changer(flaw), &Trial::default()),
        &[
            (Flaw::HidesLight, "changer/holds-what-it-says"),
            (Flaw::BringsAnother, "changer/brings-each-thing"),
            (Flaw::TakesAnyScene, "changer/refuses-other-names"),
            (Flaw::IsSlow, "changer/passed-deadline"),
            (Flaw::DiesOfInterrupt, "changer/interrupt-within-50-ms"),
        ],
    );
}

/// Toy device behind a failing link.
struct Failing {
    toy: ToyFactory,
    plan: FaultPlan,
}

impl Factory<dyn ForceTransducer> for Failing {
    fn descriptor(&self) -> &Descriptor {
        Factory::<dyn ForceTransducer>::descriptor(&self.toy)
    }
    fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        let toy: Box<dyn ForceTransducer> = open(&self.toy);
        let pace = Box::new(VirtualPace::starting_at(0.0));
        Ok(Box::new(FaultyForce::new(
            toy,
            KEY,
            FULL_SCALE,
            self.plan.clone(),
            pace,
        )))
    }
}

#[test]
fn a_device_that_answers_nan_or_saturates_or_stalls_is_caught() {
    let cases = [
        (FaultKind::NotANumber, "`Fz` is NaN, expected a number"),
        (
            FaultKind::Saturation,
            "the reading Fz = 10.0 N reaches the full scale of 10 N, where the driver must return an error",
        ),
        (FaultKind::Silence, "no answer within 1s (timeout)"),
        (
            FaultKind::StaleStamp,
            "a stamp of 0.1 s follows a stamp of 0.1 s, expected increasing stamps",
        ),
    ];
    for (kind, expected) in cases {
        let failing = Failing {
            toy: ToyFactory::force(Flaw::Nothing),
            plan: FaultPlan::none().during(kind, 1..9),
        };
        let report = conformance::force(&failing, &Trial::default());
        assert!(!report.passed(), "{kind}: {report}");
        assert!(report.to_string().contains(expected), "{kind}: {report}");
        assert!(failing.plan.log().count(kind) > 0, "{kind} never happened");
    }
}
