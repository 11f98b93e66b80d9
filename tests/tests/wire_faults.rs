//! Tests of faults of the links: the robot stops in time, and every press is recorded once. The example `wire_faults` injects each fault 100 times.

use std::sync::{Mutex, MutexGuard, PoisonError};

use taceva_needs::{Need, required, skip};
use taceva_tests::wire::faults::{CASES, Case, play, play_kills};

const SEED: u64 = 20_261_123;
/// Number of repetitions of each fault in these tests.
const FEW: usize = 3;

/// Lock under which only one study runs at a time, because each study needs the whole machine.
static ALONE: Mutex<()> = Mutex::new(());

/// Command that tests how soon the arm stands.
const HOW: &str = "the arm must stand within milliseconds: TACEVA_REQUIRE=quiet-machine chrt -f 10 cargo test -p taceva-tests --test tests wire_faults::";

/// Locks the whole machine for a test with limits of milliseconds. If the machine is not stated to be quiet, skips the test with the message `how`.
pub(crate) fn alone(how: &str) -> Option<MutexGuard<'static, ()>> {
    let named = required(std::env::var_os("TACEVA_REQUIRE").as_deref());
    let is_quiet = named.is_ok_and(|named| named.contains(&Need::QuietMachine));
    if !is_quiet {
        skip(Need::QuietMachine, how);
    }
    is_quiet.then(|| ALONE.lock().unwrap_or_else(PoisonError::into_inner))
}

fn played(of: impl Fn(&Case) -> bool) {
    let Some(_alone) = alone(HOW) else {
        return;
    };
    for case in CASES.iter().filter(|case| of(case)) {
        let result = play(case, FEW, SEED);
        assert_eq!(result.broken, Vec::<String>::new(), "{result:?}");
        assert_eq!(result.times, FEW, "{}", case.name);
    }
}

#[test]
fn faults_of_the_force_stop_the_arm_in_time_and_no_press_is_lost_or_doubled() {
    played(|case| case.name.starts_with("force"));
}

#[test]
fn faults_of_the_robots_reports_stop_the_arm_in_time_and_no_press_is_lost_or_doubled() {
    played(|case| case.name.starts_with("robot"));
}

#[test]
fn halts_that_the_emulated_arm_answers_late_are_attributed_to_the_robot_or_its_link() {
    let Some(_alone) = alone(HOW) else {
        return;
    };
    // Messages of the link wait for 150 ms: so do answers to the halts after 50 ms without a pose.
    let case = CASES.iter().find(|case| case.name == "robot late");
    let halts = play(case.expect("it is a case"), FEW, SEED).halts;
    assert!(halts.late.device > 0, "{halts:?}");
    assert!(halts.call_ms > 20.0, "{halts:?}");
}

#[test]
fn faults_of_the_camera_cost_time_and_no_press() {
    played(|case| case.name.starts_with("camera"));
}

#[test]
fn a_study_that_is_killed_and_gone_on_with_loses_and_doubles_no_press() {
    let Some(_alone) = alone(HOW) else {
        return;
    };
    let presses = play_kills(FEW, SEED);
    assert!(presses.is_ok(), "{presses:?}");
}

#[test]
fn after_an_emergency_stop_or_a_collision_nothing_moves() {
    played(|case| ["emergency stop", "collision"].contains(&case.name));
}
