//! Tests that every emulated G-code machine must pass.

use taceva_core::ErrorKind;
use taceva_wire::{Arm, Device, FaultKind};

use crate::waiting::setup::Setup;
use crate::waiting::support::{PATIENCE, inject, lower, moved, speed};

impl<E: Arm> Setup<E> {
    /// Tests that a press reaches the gel, and that a rotation is rejected, because the machine has three axes.
    pub(crate) fn presses_and_does_not_turn(&self) {
        let mut machine = self.open();
        let (home, _) = machine.pose(PATIENCE).expect("a pose");
        machine
            .move_to(lower(home, 20.6), speed(20.0), PATIENCE)
            .expect("it arrives");
        let truth = self.bench.truth();
        assert!((truth.tip_mm[2] - 0.6).abs() < 1e-4, "{truth:?}");
        assert!(truth.force_n[2] > 0.1, "{truth:?}");
        let mut turned = home;
        turned.rotation.z.0 = 10.0;
        let refused = machine.move_to(turned, speed(5.0), PATIENCE);
        assert_eq!(refused.expect_err("a turn").kind(), ErrorKind::OutOfRange);
    }

    /// Tests that the driver stops a machine that is silent for `lasts_ms`, ms, during a motion.
    pub(crate) fn is_held_once_silent_for(&self, lasts_ms: u64) {
        let (error, _) = moved(&self.bench, &mut *self.open(), || {
            inject(&self.bench, Device::Robot, FaultKind::Silent, lasts_ms);
        });
        assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
        let truth = self.bench.truth();
        // The path ends 5 mm above the gel.
        assert!(!truth.is_moving && truth.tip_mm[2] < -5.5, "{truth:?}");
    }

    /// Tests that a serial line in use, by another program or by this one, is rejected as busy. The line is free again afterwards.
    pub(crate) fn is_busy_while_another_has_it(&self) {
        let first = self.open();
        let second = self.try_open().map(drop).expect_err("it is taken");
        assert_eq!(second.kind(), ErrorKind::Busy, "{second}");
        drop(first);
        self.open();
    }

    /// Tests that the driver warns if another program has the line open without a lock. The warning contains the program's name.
    #[cfg(target_os = "linux")]
    pub(crate) fn warns_of_another_that_has_it_open(&self) {
        let (_, path) = self.arguments().split_once("port=").expect("a line");
        let line = std::fs::File::options().read(true).write(true).open(path);
        let mut other = std::process::Command::new("sleep")
            .arg("60")
            .stdin(line.expect("open"))
            .spawn()
            .expect("there is sleep");
        let warnings = self.open().warnings();
        other.kill().expect("it runs");
        other.wait().expect("it ends");
        let expected = format!("process {} (sleep)", other.id());
        assert!(
            warnings.len() == 1 && warnings[0].contains(&expected),
            "{warnings:?}"
        );
        assert!(self.open().warnings().is_empty());
    }

    /// Tests that a path that is not a serial line is rejected with the matching error.
    pub(crate) fn refuses_what_is_no_line(&self) {
        let file = tempfile::NamedTempFile::new().expect("a file");
        let path = file.path().display();
        let kind = |arguments: &str| match self.opened(arguments) {
            Ok(_) => panic!("opened {arguments}"),
            Err(error) => error.kind(),
        };
        assert_eq!(kind(&format!("port={path}")), ErrorKind::InvalidArgument);
        assert_eq!(kind("port=/dev/no-such-line"), ErrorKind::NotFound);
        assert_eq!(kind("port=/dev/null"), ErrorKind::InvalidArgument);
    }
}
