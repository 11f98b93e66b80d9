//! Whatever goes wrong on the links, the arm stands in time and every press is recorded once. `wire_faults`, an example, plays each fault 100
//! times.

use taceva_tests::wire::faults::{CASES, Case, play, play_kills};

const SEED: u64 = 20_261_123;
/// How often each is played here.
const FEW: usize = 3;

fn played(of: impl Fn(&Case) -> bool) {
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
fn faults_of_the_camera_cost_time_and_no_press() {
    played(|case| case.name.starts_with("camera"));
}

#[test]
fn a_study_that_is_killed_and_gone_on_with_loses_and_doubles_no_press() {
    let presses = play_kills(FEW, SEED);
    assert!(presses.is_ok(), "{presses:?}");
}

#[test]
fn after_an_emergency_stop_or_a_collision_nothing_moves() {
    played(|case| ["emergency stop", "collision"].contains(&case.name));
}
