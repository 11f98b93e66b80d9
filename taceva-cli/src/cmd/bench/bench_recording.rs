//! Temporary recording of the simulated bench for a benchmark.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_acquire::{PlannedScene, SceneText, Workshop};
use taceva_dataset::Dataset;
use taceva_models::Models;
use taceva_study::{Existing, RunFolder, RunSetup, run_scene};

use super::super::Context;
use super::super::run::bench::surroundings;

/// Scene with one sensor, pressed on its whole surface. The study fits only the baseline.
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

/// Numbers of contact points of a full and of a quick benchmark.
const POINTS: [usize; 2] = [400, 60];

/// Recording of the simulated bench, removed on drop.
pub(super) struct Pressed {
    pub(super) dataset: Dataset,
    /// Temporary folder of the recording, removed on drop.
    _folder: Folder,
}

/// Temporary folder of this process, removed on drop.
pub(super) struct Folder(pub(super) PathBuf);

impl Folder {
    /// Name of a new folder for this process; the folder is not created.
    pub(super) fn new() -> Folder {
        let name = format!("taceva-bench-{}", std::process::id());
        Folder(std::env::temp_dir().join(name))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that cannot be removed is left in the temporary folder.
        drop(fs::remove_dir_all(&self.0));
    }
}

impl Pressed {
    /// Records presses on the simulated bench. Equal seeds give equal recordings.
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
        let folder = Folder::new();
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
