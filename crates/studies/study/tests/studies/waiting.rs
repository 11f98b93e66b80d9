//! Tests of studies on emulated devices that run in real time.

mod air;
mod camera;
mod changer;
mod devices;
mod guard;
mod operator;
mod rig;
mod session;
mod switch;
mod world;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use taceva_acquire::{Overrides, PlannedScene, SceneText, Surroundings, Workshop};
use taceva_core::{Progress, SilentProgress};
use taceva_dataset::{Dataset, Source};
use taceva_evaluate::EvaluateError;
use taceva_models::Models;
use taceva_protocol::Operator;
use taceva_study::{Existing, RunFolder, RunSetup, StudyError, run_scene};

use devices::drivers;
use world::World;

const SCENE: &str = r#"
scene_version = 1
name = "wall"
sensor = { driver = "wall/gel" }
robot = { driver = "wall/robot" }
force = { driver = "wall/force" }
[metrics]
want = ["sensitivity"]
[protocol]
contact = { clearance_mm = 0.3, search_mm = 0.5, speed_mm_s = 5.0, travel_mm_s = 50.0, settle_s = 0.01 }
calibration = { points = 3, indentations = 2, shear_mm = 0.0 }
"#;

/// Records [`SCENE`] on the emulated rig `world`, into `folder`.
fn record(world: &World, folder: &Path, progress: &dyn Progress) -> Result<Dataset, StudyError> {
    record_by_hand(world, folder, progress, (SCENE, None))
}

/// Records `scene` on `world`. An `operator` may do the manual steps.
fn record_by_hand(
    world: &World,
    folder: &Path,
    progress: &dyn Progress,
    (scene, operator): (&str, Option<&Mutex<dyn Operator + Send>>),
) -> Result<Dataset, StudyError> {
    record_on(world, folder, progress, (scene, None, operator))
}

/// Records a scene on `world`. `on` has the text of the scene, the path of a rig file if any, and the operator if any.
fn record_on(
    world: &World,
    folder: &Path,
    progress: &dyn Progress,
    on: (&str, Option<&Path>, Option<&Mutex<dyn Operator + Send>>),
) -> Result<Dataset, StudyError> {
    with_workshop(world, progress, on, |planned, workshop| {
        let existing = match folder.join("plans.json").exists() {
            true => Existing::Resume,
            false => Existing::Refuse,
        };
        let run = RunFolder::open(folder, planned, existing)?;
        let setup = RunSetup {
            workshop,
            models: &Models::builtin(),
            cache: None,
            jobs: NonZeroUsize::MIN,
        };
        run_scene(planned, &run, setup)?;
        Ok(Dataset::open(&run.recording(0, "wall")).map_err(EvaluateError::from)?)
    })
}

/// Plans `scene` on `world`, calls `act` with the plan and the devices, and returns its result.
fn with_workshop<T>(
    world: &World,
    progress: &dyn Progress,
    (scene, rig, operator): (&str, Option<&Path>, Option<&Mutex<dyn Operator + Send>>),
    act: impl FnOnce(&PlannedScene, Workshop<'_>) -> Result<T, StudyError>,
) -> Result<T, StudyError> {
    let drivers = drivers(world);
    let text = SceneText {
        name: "wall".to_owned(),
        text: scene.to_owned(),
        folder: PathBuf::from("."),
    };
    let instead = Overrides {
        rig: rig.map(Path::to_owned),
        ..Overrides::default()
    };
    let planned = PlannedScene::with(text, &drivers, &instead)?;
    let workshop = Workshop {
        drivers: &drivers,
        surroundings: &|_, _| -> Option<Surroundings> {
            panic!("a real robot has the clock of the machine")
        },
        progress,
        operator,
        viewer: None,
    };
    act(&planned, workshop)
}

#[test]
fn a_study_on_real_devices_runs_in_the_time_of_the_machine_and_finds_its_zero_by_itself() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let dataset = record(&world, &folder.path().join("run"), &SilentProgress);
    let dataset = dataset.expect("a recording");
    assert_eq!(dataset.header().source, Source::Recorded);
    let table = dataset.table();
    let channel = |name| {
        let mut channels = table.channels().iter();
        let place = channels.position(|channel| channel.name() == name);
        table.truth(place.expect("measured"))
    };
    let (depth, force) = (channel("Pz"), channel("Fz"));
    assert_eq!(table.samples().len(), 6);
    for row in 0..6 {
        let (depth_mm, force_n) = (
            depth.get(row).expect("a depth"),
            force.get(row).expect("a force"),
        );
        // Contact is detected at most one step late. The resting load of 0.3 N does not count as force.
        let pressed_mm = force_n / 0.5;
        assert!(
            (depth_mm - 0.01..depth_mm + 0.16).contains(&pressed_mm),
            "{depth_mm} mm, {force_n} N"
        );
    }
    let state = world.state();
    // Each of 6 presses consists of several motions.
    assert!(
        state.motions > 30 && state.deepest_mm < 1.2,
        "{} motions, {} mm",
        state.motions,
        state.deepest_mm
    );
}
