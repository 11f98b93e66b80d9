//! Tests of expiring motions of every robot that supports them. Such a motion ends by itself if the host is silent.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use taceva_core::{EXPIRES, ErrorKind, Factory, Rig, Robot};
use taceva_wire::{Device, FaultKind, WallBench};

use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, inject, lower, speed};

/// Time that a busy machine may add to a motion. A test fails if the arm moves for longer.
const SLACK: Duration = Duration::from_millis(200);
/// Environment variable with the driver arguments of the arm that a killed process moves. [`IS_EXPIRING`] states its kind of motion.
const ARM: &str = "TACEVA_WIRE_DYING_HOST_ARM";
const IS_EXPIRING: &str = "TACEVA_WIRE_DYING_HOST_EXPIRES";

/// Waits until the arm has moved for a while.
fn wait_for_motion(bench: &WallBench) {
    let until = Instant::now() + Duration::from_secs(10);
    let before = bench.truth().in_motion;
    while bench.truth().in_motion - before < Duration::from_millis(200) {
        assert!(Instant::now() < until, "it never moved");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Moves the arm that the environment names, until another process kills this one. Does nothing if the environment names no arm.
pub(crate) fn die_moving(factory: &dyn Factory<dyn Robot>) {
    let Ok(arguments) = std::env::var(ARM) else {
        return;
    };
    let args = factory.descriptor().args(&arguments).expect("good");
    let mut arm = factory.open(&args, &mut Rig::new()).expect("an arm");
    let (home, _) = arm.pose(PATIENCE).expect("a pose");
    let down = lower(home, 15.0);
    let is_expiring = std::env::var(IS_EXPIRING).is_ok_and(|is| is == "true");
    let moved = match arm.expiring_motion().filter(|_| is_expiring) {
        Some(expiring) => expiring.move_expiring(down, speed(5.0), PATIENCE),
        None => arm.move_to(down, speed(5.0), PATIENCE),
    };
    panic!("it was to be killed before: {moved:?}");
}

impl<E> Setup<E> {
    /// Tests that an expiring motion ends at its target, and that straight lines can follow.
    pub(crate) fn ends_where_it_was_sent(&self) {
        let mut arm = self.open();
        let (home, _) = arm.pose(PATIENCE).expect("a pose");
        let down = lower(home, 10.0);
        let expiring = arm.expiring_motion().expect("it has it");
        expiring
            .move_expiring(down, speed(20.0), PATIENCE)
            .expect("it arrives");
        let (seen, _) = arm.pose(PATIENCE).expect("a pose");
        assert!(
            (seen.position.z.0 - down.position.z.0).abs() < 1e-4,
            "{seen:?}"
        );
        let truth = self.bench.truth();
        assert!((truth.way_mm - 10.0).abs() < 0.01, "straight: {truth:?}");
        arm.move_to(home, speed(50.0), PATIENCE).expect("a line");
        // A short path is a straight line; so is one of zero length.
        for _ in 0..2 {
            let expiring = arm.expiring_motion().expect("it has it");
            expiring
                .move_expiring(lower(home, 1.0), speed(20.0), PATIENCE)
                .expect("it arrives");
        }
    }

    /// Tests that a halt stops an expiring motion, and that motions are accepted only once the halt is cleared.
    pub(crate) fn is_halted_while_it_expires(&self) {
        let mut arm = self.open();
        let (home, _) = arm.pose(PATIENCE).expect("a pose");
        let (handle, bench) = (arm.halt_handle(), &self.bench);
        std::thread::scope(|scope| {
            let halting = scope.spawn(|| {
                wait_for_motion(bench);
                handle.halt().expect("it is sent");
                bench.truth().way_mm
            });
            let expiring = arm.expiring_motion().expect("it has it");
            let moved = expiring.move_expiring(lower(home, 15.0), speed(5.0), PATIENCE);
            assert_eq!(moved.expect_err("halted").kind(), ErrorKind::Interrupted);
            let halted_mm = halting.join().expect("halted");
            std::thread::sleep(Duration::from_millis(300));
            let way_mm = self.bench.truth().way_mm - halted_mm;
            // Without the halt the arm would move on by 1.5 mm.
            assert!(way_mm < 0.5, "it went on by {way_mm} mm");
        });
        let refused = arm.move_to(home, speed(5.0), PATIENCE);
        assert_eq!(refused.expect_err("halted").kind(), ErrorKind::Interrupted);
        arm.clear_halt(PATIENCE).expect("nothing else is wrong");
        arm.move_to(home, speed(50.0), PATIENCE)
            .expect("it takes positions again");
    }

    /// Tests that a silent link stops the arm, even if no stop was confirmed.
    pub(crate) fn stands_where_its_link_falls_silent(&self) {
        let mut arm = self.open();
        let (home, _) = arm.pose(PATIENCE).expect("a pose");
        let bench = &self.bench;
        std::thread::scope(|scope| {
            let silence = scope.spawn(|| {
                wait_for_motion(bench);
                inject(bench, Device::Robot, FaultKind::Silent, 1_000);
                let before = bench.truth().in_motion;
                std::thread::sleep(Duration::from_millis(500));
                bench.truth().in_motion - before
            });
            let expiring = arm.expiring_motion().expect("it has it");
            let moved = expiring.move_expiring(lower(home, 15.0), speed(5.0), PATIENCE);
            assert!(moved.is_err());
            let went_on = silence.join().expect("it was silent");
            assert!(went_on <= EXPIRES + SLACK, "{went_on:?}");
        });
    }

    /// Tests that an expiring motion stops in time if its process is killed in the test `host`, and that an ordinary motion continues.
    pub(crate) fn stands_where_its_host_dies(&self, host: &str) {
        let expiring = self.goes_on_without_host(host, true);
        assert!(expiring <= EXPIRES + SLACK, "{expiring:?}");
        let mut arm = self.open();
        let (at, _) = arm.pose(PATIENCE).expect("a pose");
        // The next host clears the state that a dead host left: an xArm accepts velocities until then.
        arm.clear_halt(PATIENCE).expect("nothing is wrong with it");
        arm.move_to(lower(at, -5.0), speed(50.0), PATIENCE)
            .expect("up again");
        drop(arm);
        let line = self.goes_on_without_host(host, false);
        assert!(line > Duration::from_millis(500), "{line:?}");
    }

    /// Time for which the arm moves on within 0.6 s after its host was killed.
    fn goes_on_without_host(&self, host: &str, is_expiring: bool) -> Duration {
        let mut dying = Command::new(std::env::current_exe().expect("a test knows where it is"));
        dying
            .args(["--exact", host])
            .env(ARM, self.arguments())
            .env(IS_EXPIRING, is_expiring.to_string())
            .stdout(Stdio::null());
        let mut dying = dying.spawn().expect("it runs itself again");
        wait_for_motion(&self.bench);
        dying.kill().expect("it was running");
        dying.wait().expect("it ends");
        let before = self.bench.truth().in_motion;
        std::thread::sleep(Duration::from_millis(600));
        self.bench.truth().in_motion - before
    }
}
