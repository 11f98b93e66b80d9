//! Studies on emulated devices: the program on one side of the sockets, a simulated gel with known truth on the other.

mod compared;
pub mod faults;
mod late_counts;

pub use compared::{Compared, compare};
pub use late_counts::{HaltTimes, LateCounts};

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use taceva_dataset::Dataset;
use taceva_wire::{ServeOptions, Served};

use crate::binary::taceva;
use crate::drawn::scratch;
use crate::workspace::read;

/// Emulated devices, and a folder with a scene and a rig file for them.
pub struct OnTheWire {
    /// Emulated devices.
    pub served: Served,
    folder: tempfile::TempDir,
}

/// The name of the rig file in the folder.
const RIG: &str = "rig.toml";
/// The name of the scene.
const SCENE: &str = "wire.toml";
/// Name of the folder in which a study with the emulated devices runs.
pub const RUN: &str = "wire";

/// Scene `examples/scenes/wire.toml` with `presses` presses to one depth each, and a model that fits quickly.
///
/// # Panics
/// If the scene cannot be read, which ends the test.
pub fn scene_of(presses: usize) -> String {
    let text = read("examples/scenes/wire.toml");
    let points = format!("points = {presses}");
    let changes = [
        ("points = 100", points.as_str()),
        ("indentations = 4", "indentations = 1"),
        ("name = \"fast\"", "name = \"ridge\""),
    ];
    changes.into_iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "the scene has `{from}`");
        text.replace(from, to)
    })
}

impl OnTheWire {
    /// Serves devices and writes the rig file beside `scene`.
    ///
    /// # Panics
    /// If a device cannot be served, which ends the test.
    pub fn new(options: &ServeOptions, scene: &str) -> OnTheWire {
        let served = Served::start(options).expect("devices on loopback");
        let folder = scratch();
        let rig = folder.path().join(RIG);
        served.write_rig_file(&rig).expect("room for a rig file");
        std::fs::write(folder.path().join(SCENE), scene).expect("room for a scene");
        OnTheWire { served, folder }
    }

    /// Folder of the scene.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Command that starts or resumes the study on the emulated devices.
    pub fn study(&self) -> Command {
        let mut command = self.command(RUN);
        command.args(["--rig", RIG]);
        command
    }

    /// Command that taps the gel with the emulated devices, as the rig file describes them.
    pub fn taps(&self) -> Command {
        let mut command = Command::new(taceva());
        command
            .current_dir(self.folder())
            .args(["rig", "tap", RIG])
            .stdin(Stdio::null());
        command
    }

    /// Command that runs the same study on the simulated bench of the program, in the folder `simulated`.
    pub fn simulated(&self) -> Command {
        self.command("simulated")
    }

    fn command(&self, run: &str) -> Command {
        let mut command = Command::new(taceva());
        command
            .current_dir(self.folder())
            .args(["run", SCENE, "--out", run, "--no-cache", "--quiet"])
            .stdin(Stdio::null())
            .stdout(Stdio::null());
        if self.folder().join(run).exists() {
            command.arg("--resume");
        }
        command
    }

    /// Recording in the folder `run`.
    ///
    /// # Panics
    /// If there is no closed recording, which ends the test.
    pub fn recording(&self, run: &str) -> Dataset {
        let path = self.folder().join(run).join("recordings/1-wire");
        Dataset::open(&path).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Results file in the folder `run`.
    pub fn results(&self, run: &str) -> PathBuf {
        self.folder().join(run).join("results.json")
    }
}

/// Runs a study to its end and returns its duration.
///
/// # Errors
/// Output of the study.
pub fn finished(mut study: Command) -> Result<Duration, String> {
    let began = Instant::now();
    let output = study.stderr(Stdio::piped()).output();
    let output = output.map_err(|error| error.to_string())?;
    match output.status.success() {
        true => Ok(began.elapsed()),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
    }
}

/// Running study, killed on drop.
#[derive(Debug)]
pub struct UnderWay(Child);

impl UnderWay {
    /// Starts a study.
    ///
    /// # Panics
    /// If the program does not start, which ends the test.
    pub fn begin(mut study: Command) -> UnderWay {
        let child = study.stderr(Stdio::piped()).spawn();
        UnderWay(child.expect("the program was built"))
    }

    /// True if the study ended successfully, false if it failed; `None` while it runs.
    ///
    /// # Panics
    /// If the system returns an error, which ends the test.
    pub fn ended(&mut self) -> Option<bool> {
        let status = self.0.try_wait().expect("a child that was started here");
        status.map(|status| status.success())
    }

    /// Kills the study, like `kill -9`.
    ///
    /// # Panics
    /// If the system does not confirm the end, which ends the test.
    pub fn kill(&mut self) {
        // The study may have ended by itself.
        let _ = self.0.kill();
        self.0.wait().expect("a child that was started here");
    }

    /// Waits for the study to end. Returns true if it succeeded, and its output.
    ///
    /// # Panics
    /// If the output cannot be read, which ends the test.
    pub fn end(&mut self) -> (bool, String) {
        let mut said = String::new();
        if let Some(mut errors) = self.0.stderr.take() {
            std::io::Read::read_to_string(&mut errors, &mut said).expect("text");
        }
        let status = self.0.wait().expect("a child that was started here");
        (status.success(), said)
    }
}

impl Drop for UnderWay {
    fn drop(&mut self) {
        self.kill();
    }
}
