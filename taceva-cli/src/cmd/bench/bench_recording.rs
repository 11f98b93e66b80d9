//! A recording of the simulated bench for a benchmark, removed afterwards.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_acquire::{PlannedScene, SceneText, Workshop};
use taceva_dataset::Dataset;
use taceva_models::Models;
use taceva_study::{Existing, RunFolder, RunSetup, run_scene};

use super::super::Context;
use super::super::run::bench::surroundings;

/// The scene: one sensor, its whole surface. Its study fits only the baseline.
const SCENE: &str = r#"scene_version = 1
name = "ViTacTip"
seed = 0

[sensor]
driver = "sim/vitactip"

[robot]
driver = "sim/robot"

[force]
driver = "sim/force-transducer"

[model]
name = "baseline"

[metrics]
want = ["mae"]

[protocol.calibration]
points = POINTS
indentations = 4
"#;

/// Contact points of a benchmark, and of a quick one.
const POINTS: [usize; 2] = [400, 60];

/// A recording that is removed on drop.
pub(super) struct Pressed {
    pub(super) dataset: Dataset,
    /// Removed with it.
    _folder: Folder,
}

/// A temporary folder of this process.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that cannot be removed is left in the temporary folder.
        drop(fs::remove_dir_all(&self.0));
    }
}

impl Pressed {
    /// Presses the simulated bench; the same seed gives the same recording.
    pub(super) fn new(
        is_quick: bool,
        seed: u64,
        context: &Context,
        models: &Models,
    ) -> anyhow::Result<Pressed> {
        let points = POINTS[usize::from(is_quick)];
        let text = SceneText {
            name: "bench".to_owned(),
            text: SCENE.replace("POINTS", &points.to_string()),
            folder: PathBuf::from("."),
        };
        let drivers = context.drivers(None::<&Path>)?;
        let planned = PlannedScene::new(text, &drivers, Some(seed))?;
        let name = format!("taceva-bench-{}", std::process::id());
        let folder = Folder(std::env::temp_dir().join(name));
        let run = RunFolder::open(&folder.0, &planned, Existing::Refuse)?;
        let workshop = Workshop {
            drivers: &drivers,
            surroundings: &surroundings,
            progress: &context.progress,
            operator: None,
            viewer: None,
        };
        let setup = RunSetup {
            workshop,
            models,
            cache: None,
            jobs: context.jobs,
        };
        run_scene(&planned, &run, setup)?;
        let study = &planned.studies[0].plan.name;
        Ok(Pressed {
            dataset: Dataset::open(&run.recording(0, study))?,
            _folder: folder,
        })
    }
}
