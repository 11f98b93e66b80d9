//! A camera that goes wrong amid presses.

use std::sync::atomic::{AtomicBool, Ordering};

use taceva_core::{ErrorKind, Progress, SilentProgress};
use taceva_protocol::{Left, StopCause};

use crate::guard::{assert_whole, depth_mm, stopped};
use crate::record;
use crate::world::World;

/// Spoils the camera once the tip is in the gel.
struct Spoils<'a>(&'a World, ErrorKind, AtomicBool);

impl Progress for Spoils<'_> {
    fn begin(&self, _: &str, _: Option<u64>) {}
    fn advance(&self, _: u64) {}
    fn end(&self) {}
    fn is_cancelled(&self) -> bool {
        if depth_mm(self.0) > 0.1 && !self.2.swap(true, Ordering::SeqCst) {
            self.0.state().camera = Some(self.1);
        }
        false
    }
}

#[test]
fn a_camera_that_is_unplugged_or_changes_its_size_ends_a_run_above_the_gel_which_goes_on_later() {
    for kind in [ErrorKind::Disconnected, ErrorKind::Protocol] {
        let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
        let folder = folder.path().join("run");
        let spoils = Spoils(&world, kind, AtomicBool::new(false));
        let error = stopped(record(&world, &folder, &spoils));
        match &error.cause {
            StopCause::Device(device) => {
                assert_eq!((device.kind(), kind), (kind, ErrorKind::Disconnected));
            }
            // One frame of another size is a frame that is lost; nothing but such frames end the run.
            StopCause::Frames { .. } => assert_eq!(kind, ErrorKind::Protocol),
            other => panic!("{other}"),
        }
        assert!(error.to_string().contains("4 × 4, expected 2 × 2"));
        assert_eq!(error.left, Left::Clear, "{error}");
        assert!(depth_mm(&world) < -0.29);
        world.state().camera = None;
        let pictures = world.state().pictures;
        let dataset = record(&world, &folder, &SilentProgress);
        assert_whole(&dataset.expect("it goes on"));
        assert!(world.state().pictures > pictures);
    }
}
