//! Tests of the retreat, motion by motion: speed, distance, and refused motions.

use crate::run::rig::{
    CONTACT_MM, CONTACT_MM_S, Motion, Rig, SEGMENT_MM, TRAVEL_MM_S, nothing, with_tip,
};

#[test]
fn the_tip_leaves_the_gel_and_half_a_millimetre_above_it_slowly_and_only_then_fast() {
    let rig = Rig::new(1.0, nothing);
    with_tip(&rig, |tip| tip.retreat()).expect("nothing in the way");
    let motions = rig.motions();
    let (last, slow) = motions.split_last().expect("it moved");
    let fast = Motion {
        from_mm: CONTACT_MM - 0.5,
        to_mm: -2.0,
        speed_mm_s: TRAVEL_MM_S,
    };
    assert_eq!(*last, fast);
    assert_eq!(slow.len(), 10, "1.25 mm in eighths");
    for motion in slow {
        let way_mm = motion.from_mm - motion.to_mm;
        assert_eq!((way_mm, motion.speed_mm_s), (SEGMENT_MM, CONTACT_MM_S));
    }
}

#[test]
fn a_tip_in_the_air_already_goes_up_at_once() {
    for from_mm in [CONTACT_MM - 0.5, -0.5] {
        let rig = Rig::new(from_mm, nothing);
        with_tip(&rig, |tip| tip.retreat()).expect("nothing in the way");
        let up = Motion {
            from_mm,
            to_mm: -2.0,
            speed_mm_s: TRAVEL_MM_S,
        };
        assert_eq!(rig.motions(), [up]);
    }
}

#[test]
fn from_a_limit_of_depth_the_tip_draws_back_to_the_first_segment_at_which_it_may_rest() {
    // 0.5 mm too deep; 0.25 mm is allowed.
    let rig = Rig::new(CONTACT_MM + 1.5, nothing);
    with_tip(&rig, |tip| tip.draw_back(CONTACT_MM)).expect("nothing in the way");
    let ends: Vec<f64> = rig.motions().iter().map(|motion| motion.to_mm).collect();
    assert_eq!(ends, [CONTACT_MM + 1.375, CONTACT_MM + 1.25]);
}

#[test]
fn under_a_force_that_does_not_fall_the_tip_draws_back_to_the_first_contact_and_no_farther() {
    let rig = Rig::new(CONTACT_MM + 0.3125, |question, _| {
        Some(2.0 + f64::from(question) * 1e-6)
    });
    with_tip(&rig, |tip| tip.draw_back(CONTACT_MM)).expect("no more than it was");
    let ends: Vec<f64> = rig.motions().iter().map(|motion| motion.to_mm).collect();
    assert_eq!(ends, [CONTACT_MM + 0.1875, CONTACT_MM + 0.0625, CONTACT_MM]);
}

#[test]
fn from_a_waypoint_above_the_first_contact_the_tip_draws_back_to_the_zero_of_depths() {
    let rig = Rig::new(CONTACT_MM - 0.0625, |question, _| {
        Some(2.0 + f64::from(question) * 1e-6)
    });
    let zero_mm = CONTACT_MM - 0.25;
    with_tip(&rig, |tip| tip.draw_back(zero_mm)).expect("no more than it was");
    let ends: Vec<f64> = rig.motions().iter().map(|motion| motion.to_mm).collect();
    assert_eq!(ends, [CONTACT_MM - 0.1875, zero_mm]);
}

#[test]
fn after_a_fault_nothing_moves_while_the_force_is_the_same_to_the_last_bit() {
    let rig = Rig::new(1.0, |_, _| Some(0.5));
    assert!(!with_tip(&rig, |tip| tip.abandon()));
    assert_eq!(rig.motions(), []);
    assert!(rig.state().halted);
}

#[test]
fn after_a_fault_nothing_moves_while_the_transducer_is_silent() {
    let rig = Rig::new(1.0, |_, _| None);
    assert!(!with_tip(&rig, |tip| tip.abandon()));
    assert_eq!(rig.motions(), []);
    assert!(rig.state().halted);
}

#[test]
fn after_a_fault_the_tip_leaves_the_gel_as_soon_as_the_force_is_alive_again() {
    // Silence counts after three readings, so this is the third look.
    let rig = Rig::new(1.0, |question, height_mm| {
        nothing(question, height_mm).filter(|_| question > 6)
    });
    assert!(with_tip(&rig, |tip| tip.abandon()));
    let motions = rig.motions();
    let (first, last) = (motions[0], motions[motions.len() - 1]);
    assert_eq!((first.from_mm, first.speed_mm_s), (1.0, CONTACT_MM_S));
    assert_eq!((last.to_mm, last.speed_mm_s), (-2.0, TRAVEL_MM_S));
}
