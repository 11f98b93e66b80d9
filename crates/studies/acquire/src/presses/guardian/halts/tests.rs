//! Tests of the durations of halts, their causes and their ends.

use std::time::Duration;

use taceva_core::{Millimetre, Point};

use super::*;

/// Halt call that began at 100 s and took `took_ms`. Its thread waited for a processor for `queued_ms` and ran for `ran_ms`.
fn call(took_ms: f64, queued_ms: f64, ran_ms: f64) -> HaltCall {
    HaltCall {
        decided_s: 100.0,
        returned_s: 100.0 + took_ms / 1e3,
        spent: Some(ThreadTimes {
            ran_s: ran_ms / 1e3,
            queued_s: queued_ms / 1e3,
        }),
    }
}

fn at(height_mm: f64, since_ms: u32) -> Held {
    let pose = Pose {
        position: Point {
            z: Millimetre(height_mm),
            ..Point::default()
        },
        ..Pose::default()
    };
    let since = Duration::from_millis(u64::from(since_ms));
    Held::At(pose, Stamp::at(Duration::from_secs(100) + since))
}

fn late(call: HaltCall, moved_s: f64) -> Option<Cause> {
    let halted = Halted {
        call,
        rest_s: Some(0.08),
        moved_s,
    };
    halted.late()
}

#[test]
fn a_halt_in_time_has_no_cause_and_a_late_one_that_of_its_longest_part() {
    assert_eq!(late(call(19.0, 19.0, 0.0), 0.049), None);
    assert_eq!(late(call(40.0, 25.0, 1.0), 0.0), Some(Cause::Kernel));
    assert_eq!(late(call(40.0, 1.0, 25.0), 0.0), Some(Cause::Program));
    // The thread waited for the answer.
    assert_eq!(late(call(40.0, 1.0, 1.0), 0.0), Some(Cause::Device));
    let unknown = HaltCall {
        spent: None,
        ..call(40.0, 0.0, 0.0)
    };
    assert_eq!(late(unknown, 0.0), Some(Cause::Unknown));
    // The call was in time, and the robot moved on.
    assert_eq!(late(call(3.0, 0.0, 0.0), 0.07), Some(Cause::Device));
}

/// Follows a halt until its end is known. Each of `reports` is the height of the tip, in mm, and the time after the halt, in ms.
fn followed(reports: &[(f64, u32)]) -> Halted {
    let mut follower = HaltFollower::new(0.0);
    let mut call = Some(call(3.0, 0.0, 0.0));
    for &(height_mm, since_ms) in reports {
        let now_s = 100.0 + f64::from(since_ms) / 1e3;
        let ended = follower.turn(call.take(), true, at(height_mm, since_ms), now_s);
        if let Some(halted) = ended {
            let again = follower.turn(None, false, at(height_mm, since_ms + 10), now_s + 0.01);
            assert!(again.is_none(), "it is counted once");
            return halted;
        }
    }
    panic!("its end is not known");
}

#[test]
fn a_tip_rests_from_the_first_of_two_reports_at_one_place() {
    // The first pose is older than the decision, another one is repeated.
    let reports = [
        (1.05, 0),
        (1.02, 10),
        (1.02, 10),
        (1.04, 20),
        (1.05, 30),
        (1.05, 40),
    ];
    let halted = followed(&reports);
    let rest_s = halted.rest_s.expect("a report");
    assert!((rest_s - 0.03).abs() < 1e-9, "{rest_s}");
    assert!((halted.moved_s - 0.02).abs() < 1e-9, "{halted:?}");
    assert_eq!(halted.late(), None);
}

#[test]
fn a_tip_that_reports_show_in_motion_for_too_long_is_late_by_the_robot() {
    let falling: Vec<(f64, u32)> = (1..30).map(|at| (f64::from(at), 10 * at)).collect();
    // It came to rest, and it did not.
    let rests = [&falling[..7], &[(7.0, 80)]].concat();
    for (reports, is_at_rest) in [(&rests, true), (&falling, false)] {
        let halted = followed(reports);
        assert_eq!(halted.late(), Some(Cause::Device), "{halted:?}");
        assert_eq!(halted.rest_s.is_some(), is_at_rest, "{halted:?}");
    }
}

#[test]
fn a_tip_whose_first_reports_are_read_late_is_not_late_by_the_robot() {
    // Nothing was read for 90 ms, because the thread that reads had no processor.
    let halted = followed(&[(1.05, 90), (1.05, 100)]);
    assert_eq!(halted.late(), None, "{halted:?}");
}

#[test]
fn a_motion_has_one_halt_and_a_halt_at_rest_is_none() {
    let mut follower = HaltFollower::default();
    let halt = Some(call(3.0, 0.0, 0.0));
    assert!(follower.turn(halt, false, Held::No, 100.1).is_none());
    assert!(follower.turn(None, false, Held::No, 101.0).is_none());
    assert!(follower.turn(halt, true, Held::Unseen, 100.1).is_none());
    let ended = follower.turn(halt, true, Held::Unseen, 100.3);
    assert!(ended.expect("a halt").rest_s.is_none());
    // Each later reading halts again, until the motion has ended and the robot may move.
    assert!(follower.turn(halt, true, Held::Unseen, 101.0).is_none());
    assert!(follower.turn(halt, false, Held::Unseen, 101.0).is_none());
    // The next motion began in the turn that ended the halt.
    assert!(follower.turn(halt, true, Held::No, 101.0).is_none());
    assert!(follower.turn(halt, true, Held::Unseen, 100.1).is_none());
    let freed = follower.turn(None, true, Held::No, 100.1);
    assert!(freed.is_some(), "the next motion");
}

#[test]
fn the_rest_is_unknown_once_the_robot_may_move_again() {
    // The halt and its end lie between two looks at the robot.
    let mut follower = HaltFollower::default();
    let halt = Some(call(3.0, 0.0, 0.0));
    let halted = follower.turn(halt, true, Held::No, 100.005);
    let halted = halted.expect("a halt");
    assert!(halted.rest_s.is_none() && halted.late().is_none());
    assert!(follower.turn(None, true, at(1.0, 60), 100.06).is_none());
    // A cancellation halts again at each look until the motion ends.
    assert!(follower.turn(None, false, Held::No, 100.1).is_none());
    assert!(follower.turn(halt, true, Held::No, 100.1).is_some());
    assert!(follower.turn(halt, true, Held::No, 100.1).is_none());
}

#[test]
fn a_halt_is_timed_and_the_first_of_several_is_kept() {
    struct Slow;
    impl Halt for Slow {
        fn halt(&self) -> Result<(), DriverError> {
            std::thread::sleep(Duration::from_millis(10));
            Ok(())
        }
    }
    let calls = Arc::new(HaltCalls::default());
    let halt = TimedHalt::new(Arc::new(Slow), Arc::clone(&calls));
    prepare_this_thread();
    let before_s = MonotonicClock.now_s();
    halt.halt().expect("no link");
    let between_s = MonotonicClock.now_s();
    halt.halt().expect("no link");
    let call = calls.take().expect("two");
    assert!(call.took_s() >= 0.01, "{call:?}");
    assert!(
        call.decided_s >= before_s && call.returned_s <= between_s,
        "{call:?}"
    );
    let states_times = std::path::Path::new("/proc/thread-self/schedstat").exists();
    assert_eq!(call.spent.is_some(), states_times);
    assert!(calls.take().is_none());
}
