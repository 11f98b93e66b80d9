//! Tests of velocities of the tip that expire.

use taceva_drivers::ufactory::xarm::XarmFactory;
use taceva_wire::xarm::Ports;

use super::setup::setup;
use crate::waiting::expiring::die_moving;

#[test]
fn it_ends_where_it_was_sent_and_lines_follow_it() {
    setup(Ports::ANY).ends_where_it_was_sent();
}

#[test]
fn a_controller_that_does_not_know_how_long_a_velocity_holds_gets_none() {
    let setup = setup(Ports {
        firmware: [1, 9, 9],
        ..Ports::ANY
    });
    assert!(setup.open().expiring_motion().is_none());
}

#[test]
fn a_halt_stops_it_and_stays() {
    setup(Ports::ANY).is_halted_while_it_expires();
}

#[test]
fn a_link_that_falls_silent_lets_the_arm_stand_though_no_stop_is_confirmed() {
    setup(Ports::ANY).stands_where_its_link_falls_silent();
}

/// Moves the arm that the environment names, until another process kills this one. Does nothing if the environment names no arm.
#[test]
fn the_host_that_dies() {
    die_moving(&XarmFactory::new().expect("a factory"));
}

#[test]
fn an_arm_whose_host_dies_stands_within_a_fifth_of_a_second_and_one_on_a_line_goes_on() {
    setup(Ports::ANY).stands_where_its_host_dies("waiting::xarm::expiring::the_host_that_dies");
}
