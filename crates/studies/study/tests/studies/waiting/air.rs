//! Tests of a rehearsal above the gel.

use taceva_acquire::{AIR_MM, rehearse_scene};
use taceva_core::SilentProgress;

use crate::waiting::guard::depth_mm;
use crate::waiting::world::World;
use crate::waiting::{SCENE, with_workshop};

#[test]
fn a_run_in_the_air_visits_every_place_far_above_the_gel_and_presses_nothing() {
    let world = World::new();
    let visited = with_workshop(
        &world,
        &SilentProgress,
        (SCENE, None, None),
        |planned, workshop| Ok(rehearse_scene(planned, workshop)?),
    );
    assert_eq!(visited.expect("nothing is in the way"), 3);
    // The rehearsal also visits the depths of the presses, at most 1 mm.
    assert!(depth_mm(&world) < 1.0 - AIR_MM, "{} mm", depth_mm(&world));
    let state = world.state();
    assert!(state.motions >= 3 && state.deepest_mm <= 0.0);
    assert_eq!(state.pictures, 0);
}

#[test]
fn a_run_in_the_air_that_is_halted_names_the_threshold_and_no_press_to_repeat() {
    let world = World::new();
    world.state().obstacle_x_mm = 0.05;
    let visited = with_workshop(
        &world,
        &SilentProgress,
        (SCENE, None, None),
        |planned, workshop| Ok(rehearse_scene(planned, workshop)?),
    );
    let said = visited.expect_err("something is in the way").to_string();
    assert!(
        said.contains("`threshold_N` under [protocol.contact]"),
        "{said}"
    );
    assert!(!said.contains("is repeated"), "{said}");
}
