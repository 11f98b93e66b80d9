//! Tests of a released enabling switch: halted motions, and motions that do not begin.

use super::*;

#[test]
fn a_switch_that_is_let_go_halts_a_motion_and_lets_none_begin_until_it_is_held_again() {
    for (enabling, trip) in [
        (Enabling::Released, Trip::Released),
        (Enabling::Lost, Trip::SwitchLost),
    ] {
        let (mut supervisor, halts) = watching(PRESS);
        let halted = || halts.0.load(Ordering::SeqCst);
        supervisor.enabling(Enabling::Held);
        let way = [at_height(-1.0), at_height(0.3)];
        assert_eq!(supervisor.sent(way[0], way[1]), Ok(()));
        supervisor.enabling(enabling);
        assert_eq!((supervisor.tripped(), halted()), (Some(trip), 1));
        // The robot rests and the halt is ended. Neither needs the switch to be held.
        supervisor.rests();
        supervisor.release(PRESS, 11.0);
        assert_eq!(supervisor.withheld(), Some(trip));
        assert_eq!(supervisor.sent(way[0], way[1]), Err(trip));
        assert!(!supervisor.is_under_way());
        supervisor.release(PRESS, 12.0);
        supervisor.enabling(Enabling::Held);
        assert_eq!(supervisor.sent(way[0], way[1]), Ok(()));
    }
}

#[test]
fn a_switch_that_is_let_go_while_the_tip_rests_halts_nothing() {
    let (mut supervisor, halts) = watching(PRESS);
    supervisor.enabling(Enabling::Released);
    assert_eq!(
        (supervisor.tripped(), halts.0.load(Ordering::SeqCst)),
        (None, 0)
    );
}
