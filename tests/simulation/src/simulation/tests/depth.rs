//! Tests of the true depth of presses to the depth limit, on a tilted gel with noisy force readings.

use taceva_core::{Nanometre, Phase};

use super::bench::{Bench, Memory, SOFT};
use crate::simulation::gel::Gel;
use crate::simulation::scenario::planned_scene;
use taceva_protocol::{DepthOrigin, Mode, Motion, PhaseKind, PlannedPress, Waypoint};

/// A gel that is tilted by about a degree. Each search for contact therefore meets the gel after another fraction of a search step.
const TILTED: Gel = Gel {
    slope: 0.02,
    ..SOFT
};

/// The gel [`TILTED`] with a stiffness of 2 N/mm. Its force readings have a standard deviation of 4 mN.
const STIFF: Gel = Gel {
    stiffness_n_mm: 2.0,
    noise_n: 0.007,
    normal_max_n: 3.0,
    ..TILTED
};

const SCENE: &str = r#"
scene_version = 1
name = "tilted"
sensor = { driver = "faults/sensor" }
robot = { driver = "faults/robot" }
force = { driver = "faults/force" }
model = { name = "ridge" }
[protocol]
contact = { clearance_mm = 0.5, search_mm = 1.0 }
calibration = { points = 120, indentations = 4 }
hysteresis = { points = 2, depth_step_mm = 0.4 }
"#;

/// Number of places, each pressed once.
const PLACES: usize = 100;

/// Greatest true depth of presses to the depth limit, minus this limit, mm.
fn excess_mm(gel: Gel, depth_from: DepthOrigin) -> f64 {
    let mut plan = planned_scene(SCENE, 1, &gel).expect("a plan");
    plan.contact.depth_from.value = depth_from;
    let limit_mm = plan.limits.as_ref().expect("it moves").depth_max.0;
    let to_limit = Waypoint {
        depth: Nanometre::from_millimetres(limit_mm).expect("a length"),
        shear: [Nanometre(0); 2],
        phase: Phase::Load,
    };
    // Each of them has a place of its own.
    let is_calibration = |press: &PlannedPress| press.phases.contains(&PhaseKind::Calibration);
    plan.presses.retain(is_calibration);
    plan.presses.truncate(PLACES);
    for press in &mut plan.presses {
        press.frames = false;
        press.press.motion = Motion::Indent(vec![to_limit]);
    }
    let mut bench = Bench::with(gel, plan);
    let mut log = Memory::default();
    let report = bench.run(Mode::Acquire, &mut log).expect("no faults");
    assert_eq!(
        (report.made, report.limited, report.without_contact),
        (PLACES, 0, 0)
    );
    let world = bench.shared.world();
    assert_eq!(world.oracle.violations, []);
    world.oracle.checks.greatest_depth_mm - limit_mm
}

#[test]
fn the_true_depth_exceeds_its_limit_by_at_most_0_02_mm_over_a_noisy_tilted_gel() {
    for gel in [TILTED, STIFF] {
        let excess_mm = excess_mm(gel, DepthOrigin::Surface);
        // It is not far less either: the presses reach the limit.
        assert!((-0.02..=0.02).contains(&excess_mm), "{gel:?}: {excess_mm}");
    }
}

#[test]
fn depths_that_count_from_the_first_contact_exceed_the_limit_by_up_to_a_step() {
    for gel in [TILTED, STIFF] {
        let excess_mm = excess_mm(gel, DepthOrigin::Contact);
        assert!((0.05..0.16).contains(&excess_mm), "{gel:?}: {excess_mm}");
    }
}
