use super::*;
use crate::run::rig::{Rig, SEGMENT_MM, nothing, with_tip};
use crate::run::supervisor::Observation;

#[test]
fn a_robot_that_does_not_move_is_stuck_after_twice_the_segments_of_its_way_and_eight() {
    let rig = Rig::new(1.0, nothing);
    rig.state().stuck = true;
    let cause = with_tip(&rig, |tip| {
        tip.release()?;
        tip.find_pose()?;
        tip.approach([0.0, 0.0, 0.0])
    });
    let cause = cause.expect_err("it stands where it stood");
    let stuck = StopCause::Tripped(Trip::Diverged { distance_mm: 1.0 });
    assert_eq!(cause.to_string(), stuck.to_string());
    // 16 for the way, 8 to spare, and the one that exceeds the allowance.
    assert_eq!(rig.motions().len(), 16 + 8 + 1);
    for motion in rig.motions() {
        assert_eq!((motion.from_mm, motion.to_mm), (1.0, 1.0 - SEGMENT_MM));
    }
    assert!(rig.state().halted);
}

#[test]
fn what_a_thread_halts_for_before_another_stage_is_watched_stands_until_the_halt_is_ended() {
    let rig = Rig::new(-2.0, nothing);
    let cause = with_tip(&rig, |tip| {
        tip.release()?;
        tip.find_pose()?;
        tip.look()?;
        // A guard thread reads nothing for 60 ms, just before the next stage is set.
        let late_s = tip.clock.now_s() + 0.06;
        let seen = tip.supervisor.lock().observe(&Observation::Silence, late_s);
        assert!(seen.is_err());
        tip.watch(ANY_FORCE);
        tip.approach([0.0, 0.0, -1.5])
    });
    let cause = cause.expect_err("it is halted");
    assert!(cause.is_silence(), "{cause}");
    assert_eq!(rig.motions(), []);
    assert!(rig.state().halted);
}

#[test]
fn a_robot_that_does_not_answer_when_its_halt_is_to_end_is_silent_and_stays_halted() {
    let rig = Rig::new(-2.0, nothing);
    rig.state().unheard = 1;
    let (first, second) = with_tip(&rig, |tip| {
        let first = tip.release();
        assert!(!tip.robot_failed);
        (first, tip.release())
    });
    let cause = first.expect_err("it says nothing");
    assert!(cause.is_silence(), "{cause}");
    second.expect("it answers again");
}

#[test]
fn a_waypoint_is_beside_its_place_by_its_shear_and_below_the_contact_by_its_depth() {
    let [place, shear] = [[4_000_000, -3_000_000], [500_000, 250_000]];
    let [place, shear] = [place, shear].map(|pair| pair.map(Nanometre));
    let waypoint = Tip::waypoint(place, shear, 0.25, Nanometre(750_000));
    assert!(waypoint.iter().eq(&[4.5, -2.75, 1.0]), "{waypoint:?}");
}
