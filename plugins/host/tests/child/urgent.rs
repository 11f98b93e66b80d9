//! Urgent messages bypass the queue: a halt and an interrupt end a blocking call within 50 ms.

use std::time::{Duration, Instant};

use taceva_core::{Args, ErrorKind, Pose, Speed};
use taceva_host::{Patience, Session};

use crate::runner::Test;
use crate::{LONG, child, odd};

pub(crate) const TESTS: &[Test] = &[
    (
        "a_halt_ends_a_move_that_blocks_within_50_ms",
        a_halt_ends_a_move_that_blocks_within_50_ms,
    ),
    (
        "a_halt_of_a_robot_that_is_closed_succeeds_and_of_one_that_is_gone_does_not",
        a_halt_of_a_robot_that_is_closed_succeeds_and_of_one_that_is_gone_does_not,
    ),
];

fn a_halt_ends_a_move_that_blocks_within_50_ms() {
    let session = child(Patience::default());
    let mut robot = session
        .robot(&odd::ROBOT, &Args::default())
        .expect("a robot");
    let halt = robot.halt_handle();
    let speed = Speed::try_new(1.0).expect("positive");
    for _ in 0..20 {
        let (began, ended) = std::thread::scope(|scope| {
            let mover = scope.spawn(|| {
                let ended = robot.move_to(Pose::default(), speed, LONG);
                (Instant::now(), ended.expect_err("it never arrives").kind())
            });
            std::thread::sleep(Duration::from_millis(10));
            let began = Instant::now();
            halt.halt().expect("halted");
            (began, mover.join().expect("whole"))
        });
        assert_eq!(ended.1, ErrorKind::Interrupted);
        let took = ended.0 - began;
        assert!(took < Duration::from_millis(50), "{took:?}");
        robot.clear_halt(LONG).expect("cleared");
    }
}

fn a_halt_of_a_robot_that_is_closed_succeeds_and_of_one_that_is_gone_does_not() {
    let session = child(Patience::default());
    let robot = session
        .robot(&odd::ROBOT, &Args::default())
        .expect("a robot");
    let halt = robot.halt_handle();
    drop(robot);
    halt.halt().expect("nothing is left to stop");

    let robot = session
        .robot(&odd::ROBOT, &Args::default())
        .expect("a robot");
    let halt = robot.halt_handle();
    let process = i32::try_from(session.child().process()).expect("a number");
    let process = rustix::process::Pid::from_raw(process).expect("a process");
    rustix::process::kill_process(process, rustix::process::Signal::KILL).expect("killed");
    let error = halt.halt().expect_err("it cannot be sent");
    assert_eq!(error.kind(), ErrorKind::Disconnected);
}
