//! Tests of the durations of halts, their causes and their ends.

use std::time::Duration;

use taceva_core::{Millimetre, Point};

use super::*;

/// Call of 100 s that took `took_ms`, of which the thread waited for a processor for `queued_ms` and ran for `ran_ms`.
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

fn at(height_mm: f64, since_ms: u64) -> Option<(Pose, Stamp)> {
    let pose = Pose {
        position: Point {
            z: Millimetre(height_mm),
            ..Point::default()
        },
        ..Pose::default()
    };
    let stamp = Stamp::at(Duration::from_millis(100_000 + since_ms));
    Some((pose, stamp))
}

fn late(call: HaltCall, rest_s: Option<f64>) -> Option<Cause> {
    Halted { call, rest_s }.late()
}

#[test]
fn a_halt_in_time_has_no_cause_and_a_late_one_that_of_its_longest_part() {
    assert_eq!(late(call(19.0, 19.0, 0.0), Some(0.049)), None);
    assert_eq!(late(call(40.0, 25.0, 1.0), None), Some(Cause::Kernel));
    assert_eq!(late(call(40.0, 1.0, 25.0), None), Some(Cause::Program));
    // The thread waited for the answer.
    assert_eq!(late(call(40.0, 1.0, 1.0), None), Some(Cause::Device));
    let unknown = HaltCall {
        spent: None,
        ..call(40.0, 0.0, 0.0)
    };
    assert_eq!(late(unknown, None), Some(Cause::Unknown));
    // The call was in time, and the robot moved on.
    assert_eq!(late(call(3.0, 0.0, 0.0), Some(0.08)), Some(Cause::Device));
}

#[test]
fn a_tip_rests_from_the_first_of_two_reports_at_one_place() {
    let mut follower = HaltFollower::default();
    let first = call(3.0, 0.0, 0.0);
    // The pose is older than the decision.
    let before = follower.turn(Some(first), true, at(1.00, 0), 0.0, 100.005);
    assert!(before.is_none());
    for (height_mm, since_ms) in [(1.02, 10), (1.02, 10), (1.04, 20), (1.05, 30)] {
        let now_s = 100.0 + since_ms as f64 / 1e3;
        let moving = follower.turn(None, true, at(height_mm, since_ms), 0.0, now_s);
        assert!(moving.is_none(), "{since_ms}");
    }
    let rests = follower.turn(None, false, at(1.05, 40), 0.0, 100.045);
    let rest_s = rests.expect("it rests").rest_s.expect("a report");
    assert!((rest_s - 0.03).abs() < 1e-9, "{rest_s}");
    let again = follower.turn(None, false, at(1.05, 50), 0.0, 100.05);
    assert!(again.is_none(), "it is counted once");
}

#[test]
fn a_motion_has_one_halt_and_a_halt_at_rest_is_none() {
    let mut follower = HaltFollower::default();
    let halt = Some(call(3.0, 0.0, 0.0));
    assert!(follower.turn(halt, false, None, 0.0, 100.1).is_none());
    assert!(follower.turn(None, false, None, 0.0, 101.0).is_none());
    assert!(follower.turn(halt, true, None, 0.0, 100.1).is_none());
    let ended = follower.turn(halt, true, None, 0.0, 100.3);
    assert_eq!(ended.expect("a halt").rest_s, None);
    // Each later reading halts again until the motion ends.
    assert!(follower.turn(halt, true, None, 0.0, 101.0).is_none());
    assert!(follower.turn(None, false, None, 0.0, 101.0).is_none());
    assert!(follower.turn(halt, true, None, 0.0, 100.1).is_none());
    assert!(follower.release().is_some(), "the next motion");
    assert!(follower.release().is_none());
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
    let before_s = MonotonicClock.now_s();
    for _ in 0..2 {
        halt.halt().expect("no link");
    }
    let call = calls.take().expect("two");
    assert!(call.took_s() >= 0.01, "{call:?}");
    assert!(
        call.decided_s >= before_s && call.decided_s < before_s + 10.0,
        "{call:?}"
    );
    assert!(calls.take().is_none());
}
