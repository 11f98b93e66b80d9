//! Tests of a camera that fails during presses.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, Ordering};

use taceva_core::{ErrorKind, Progress, SilentProgress};
use taceva_dataset::frozen_frames;
use taceva_protocol::{Left, StopCause};

use crate::waiting::guard::{depth_mm, stopped};
use crate::waiting::record_by_hand;
use crate::waiting::world::World;

/// Scene that captures frames of presses at six contact points.
const SEEN: &str = r#"
scene_version = 1
name = "wall"
sensor = { driver = "wall/gel" }
robot = { driver = "wall/robot" }
force = { driver = "wall/force" }
model = { name = "baseline" }
[metrics]
want = ["accuracy"]
[protocol]
contact = { clearance_mm = 0.3, search_mm = 0.5, speed_mm_s = 5.0, travel_mm_s = 50.0, settle_s = 0.01 }
calibration = { points = 6, indentations = 2, shear_mm = 0.0 }
"#;

/// Number of frames that the test camera takes before it freezes. By then, equal frames count as a fault.
const LIVE_PICTURES: u32 = 10;

/// Progress receiver that freezes the camera while the tip is in the gel, after the camera has taken [`LIVE_PICTURES`] frames.
struct Freezes<'a>(&'a World);

impl Progress for Freezes<'_> {
    fn is_cancelled(&self) -> bool {
        let is_deep = depth_mm(self.0) > 0.1;
        let mut state = self.0.state();
        state.is_frozen |= is_deep && state.pictures >= LIVE_PICTURES;
        false
    }
}

/// Progress receiver that makes the camera fail when the tip is in the gel for the first time.
struct Spoils<'a>(&'a World, ErrorKind, AtomicBool);

impl Progress for Spoils<'_> {
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
        let error = stopped(record_by_hand(&world, &folder, &spoils, (SEEN, None)));
        match &error.cause {
            StopCause::Device(device) => {
                assert_eq!((device.kind(), kind), (kind, ErrorKind::Disconnected));
            }
            // A frame of another size counts as lost. Only such frames end the run.
            StopCause::Frames { .. } => assert_eq!(kind, ErrorKind::Protocol),
            other => panic!("{other}"),
        }
        assert!(error.to_string().contains("4 × 4, expected 2 × 2"));
        assert_eq!(error.left, Left::Clear, "{error}");
        assert!(depth_mm(&world) < -0.29);
        world.state().camera = None;
        let pictures = world.state().pictures;
        let dataset = record_by_hand(&world, &folder, &SilentProgress, (SEEN, None));
        let dataset = dataset.expect("it goes on");
        let samples: BTreeSet<&String> = dataset.table().samples().iter().collect();
        assert_eq!((samples.len(), dataset.table().samples().len()), (12, 12));
        assert!(world.state().pictures > pictures);
    }
}

#[test]
fn a_camera_that_freezes_after_its_first_presses_breaks_them_off_and_ends_the_run_by_its_name() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let folder = folder.path().join("run");
    let scene = SEEN.replace("points = 6", "points = 14");
    let ended = record_by_hand(&world, &folder, &Freezes(&world), (scene.as_str(), None));
    let error = stopped(ended);
    assert!(matches!(error.cause, StopCause::FrozenFrame), "{error}");
    assert!(
        error.to_string().contains("the camera is frozen"),
        "{error}"
    );
    assert_eq!(error.left, Left::Clear, "{error}");
    world.state().is_frozen = false;
    let dataset = record_by_hand(&world, &folder, &SilentProgress, (scene.as_str(), None));
    let dataset = dataset.expect("it goes on");
    let samples: BTreeSet<&String> = dataset.table().samples().iter().collect();
    assert_eq!((samples.len(), dataset.table().samples().len()), (28, 28));
    // Each attempt at the last press was broken off, and is counted.
    assert!(frozen_frames(dataset.path()) >= 3);
}
