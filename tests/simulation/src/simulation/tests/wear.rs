//! Tests of load cycles that wear the gel. Each cycle is supervised like a press.

use taceva_core::Millimetre;

use super::bench::{Bench, HARD, Memory, SOFT};
use crate::simulation::gel::Gel;
use crate::simulation::scenario::planned_scene;
use taceva_protocol::{Mode, PlannedPress};

/// Bench for a scene with one wear stage of [`CYCLES`] load cycles. `load` states their kind, force and travel.
fn worn(gel: Gel, load: &str) -> Bench {
    let scene = format!(
        r#"
scene_version = 1
name = "worn"
sensor = {{ driver = "faults/sensor" }}
robot = {{ driver = "faults/robot" }}
force = {{ driver = "faults/force" }}
model = {{ name = "ridge" }}
[protocol]
contact = {{ clearance_mm = 0.5, search_mm = 1.0 }}
calibration = {{ points = 3, indentations = 1 }}
hysteresis = {{ points = 2, depth_step_mm = 0.4 }}
idle = {{ frames = 3 }}
[protocol.wear]
cycles = [{CYCLES}]
{load}
"#
    );
    Bench::with(gel, planned_scene(&scene, 1, &gel).expect("a plan"))
}

const CYCLES: usize = 12;
const COMPRESSION: &str = "load = \"compression\"\nforce_N = 0.3";
const SHEAR: &str = "load = \"shear\"\nforce_N = 0.3\ntravel_mm = 0.25";
const ABRASION: &str = "load = \"abrasion\"\nforce_N = 0.3\ntravel_mm = 1.0";

fn is_load(press: &&PlannedPress) -> bool {
    press.press.load().is_some()
}

#[test]
fn every_cycle_is_counted_before_the_measured_presses_and_gives_no_sample() {
    for load in [COMPRESSION, SHEAR, ABRASION] {
        let mut bench = worn(SOFT, load);
        assert_eq!(bench.plan.presses.iter().filter(is_load).count(), CYCLES);
        let mut log = Memory::default();
        let report = bench.run(Mode::Acquire, &mut log).expect("no faults");
        let presses = bench.plan.presses.len();
        assert_eq!((report.made, report.limited), (presses, 0), "{load}");
        assert_eq!(report.without_contact, 0, "{load}");
        let (loads, measured) = log.records.split_at(CYCLES);
        assert!(loads.iter().all(|record| record.samples.is_empty()));
        assert!(measured.iter().all(|record| !record.samples.is_empty()));
        assert!(bench.height() <= -bench.plan.contact.clearance_mm.value);
        assert_eq!(bench.shared.world().oracle.violations, []);
    }
}

#[test]
fn a_stopped_run_goes_on_at_the_cycle_where_it_stopped() {
    let mut bench = worn(SOFT, SHEAR);
    let mut log = Memory {
        full_after: Some(7),
        ..Memory::default()
    };
    let error = bench.run(Mode::Acquire, &mut log).expect_err("full");
    assert_eq!(error.press, Some(bench.plan.presses[7].id));
    log.full_after = None;
    let report = bench.run(Mode::Acquire, &mut log).expect("space again");
    let presses = bench.plan.presses.len();
    assert_eq!((report.resumed, report.made), (7, presses - 7));
    let made: Vec<_> = log.records.iter().map(|record| record.press).collect();
    let planned: Vec<_> = bench.plan.presses.iter().map(|press| press.id).collect();
    assert_eq!(made, planned);
}

#[test]
fn on_a_hard_gel_the_limits_hold_during_loads_near_the_greatest_force() {
    for load in ["compression\"", "shear\"\ntravel_mm = 0.25"] {
        let mut bench = worn(HARD, &format!("force_N = 1.45\nload = \"{load}"));
        // The measured presses reach the limit, too.
        bench.plan.presses.retain(|press| is_load(&press));
        let mut log = Memory::default();
        let report = bench
            .run(Mode::Acquire, &mut log)
            .expect("limits are no faults");
        assert_eq!(report.made, CYCLES);
        assert_eq!(bench.shared.world().oracle.violations, []);
        let checks = bench.shared.world().oracle.checks;
        // The loads did come close to the limit.
        assert!(checks.greatest_force > 0.9, "{checks:?}");
    }
}

#[test]
fn a_rehearsal_visits_the_loads_once_in_the_air() {
    let mut bench = worn(SOFT, ABRASION);
    let mut log = Memory::default();
    let height = Millimetre(20.0);
    let report = bench.run(Mode::Rehearse { height }, &mut log).expect("air");
    assert_eq!(report.made, bench.plan.presses.len() - CYCLES + 1);
    assert!(log.records.is_empty() && bench.height() < -19.0);
}
