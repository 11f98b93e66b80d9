//! Sessions of the program on emulated controllers, through sockets: wrong axes, a second run, an arm that is killed off in the middle.

use std::fs;
use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

use taceva_dataset::Dataset;
use taceva_tests::{Random, scratch, taceva};
use taceva_wire::control::Control;
use taceva_wire::{Arm, BenchOptions, RigFile, WallBench, mjpeg, sri, xarm};

const SEED: u64 = 20_261_123;
const KILLS: usize = 5;
const PRESSES: usize = 6;
/// Times that a run is started again on a busy machine.
const PATIENCE: usize = 5;

const SCENE: &str = r#"scene_version = 1
name = "wire"
seed = 7
limits = { Pz_max_mm = 1.0, Fz_max_N = 1.8 }
[sensor]
driver = "sim/gelsight"
opaque = true
markers = true
footprint = { shape = "rect", half_x_mm = 3.0, half_y_mm = 3.0 }
[robot]
driver = "sim/robot"
[force]
driver = "sim/force-transducer"
[metrics]
want = ["sensitivity"]
[protocol]
contact = { clearance_mm = 1.0, speed_mm_s = 2.0, search_mm = 2.0 }
calibration = { points = 6, indentations = 1 }
"#;

/// An arm, a transducer and a camera over one gel, while this is held.
struct Wire {
    bench: WallBench,
    _arm: Arc<xarm::Emulator>,
    _force: sri::Emulator,
    _camera: mjpeg::Emulator,
    _control: Control,
    folder: tempfile::TempDir,
}

impl Wire {
    fn start() -> Wire {
        let host = Ipv4Addr::LOCALHOST;
        let bench = WallBench::start(&BenchOptions::quiet(7)).expect("a gel");
        let arm = xarm::Emulator::start(&bench, xarm::Ports::ANY).expect("an arm");
        let arm = Arc::new(arm);
        let force = sri::Emulator::start(&bench, host, 0).expect("a box");
        let style = mjpeg::Style::Usual;
        let camera = mjpeg::Emulator::start(&bench, host, 0, style).expect("a camera");
        let shared = Arc::clone(&arm) as Arc<dyn Arm>;
        let control = Control::start(&bench, Some(shared), host, 0).expect("a port");
        let folder = scratch();
        let rig = RigFile {
            bench: &bench,
            robot: Some(arm.selector()),
            force: Some(force.selector()),
            sensor: Some(format!("camera/mjpeg:url={}", camera.png_url())),
            control: &control,
        };
        rig.write(&folder.path().join("rig.toml")).expect("written");
        fs::write(folder.path().join("scene.toml"), SCENE).expect("written");
        Wire {
            bench,
            _arm: arm,
            _force: force,
            _camera: camera,
            _control: control,
            folder,
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `taceva run` in the folder, with `more` arguments.
    fn run(&self, more: &[&str]) -> Command {
        let mut command = Command::new(taceva());
        command
            .args(["run", "scene.toml", "--no-cache", "-q"])
            .args(more)
            .current_dir(self.folder.path())
            .stdin(Stdio::null());
        command
    }
}

impl Wire {
    /// The same to its end; again where the machine was so busy that readings came late, which a run does not bear.
    fn finished(&self, more: &[&str]) -> Output {
        let mut output = self.run(more).output().expect("it starts");
        for _ in 0..PATIENCE {
            if !said(&output).contains("ms old") {
                break;
            }
            output = self.run(more).output().expect("it starts");
        }
        output
    }
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn rows(folder: &Path) -> usize {
    let table = folder.join("recordings/1-wire.sessions.csv");
    fs::read_to_string(table).map_or(0, |text| text.lines().count().saturating_sub(1))
}

#[test]
fn wrong_axes_of_the_transducer_end_a_session_with_their_line_before_anything_is_pressed() {
    let wire = Wire::start();
    let text = fs::read_to_string(wire.path("rig.toml")).expect("written");
    let (robot, force) = text.split_once("[force]").expect("a transducer");
    let right = r#"axes = ["x", "-y", "-z"]"#;
    assert!(force.contains(right), "{text}");
    for wrong in [r#"["x", "y", "z"]"#, r#"["-x", "y", "-z"]"#] {
        let wrong = format!("axes = {wrong}");
        let turned = force.replacen(right, &wrong, 1);
        fs::write(wire.path("wrong.toml"), format!("{robot}[force]{turned}")).expect("written");
        let output = wire.finished(&["--rig", "wrong.toml"]);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(3), "{said}");
        let line = 1 + robot.lines().count();
        let place = format!("wrong.toml, line {}: `axes` of [force]: ", line + 2);
        assert!(said.contains(&place), "{said}");
        assert!(said.contains(&format!("write {right}")), "{said}");
        // Half of what is allowed, and out again.
        let truth = wire.bench.truth();
        assert!(
            truth.deepest_mm < 0.75 && truth.tip_mm[2] < -0.9,
            "{truth:?}"
        );
    }
}

#[test]
fn a_second_run_on_the_same_rig_is_refused_while_the_first_goes_on() {
    let wire = Wire::start();
    let mut first = wire.run(&["--rig", "rig.toml", "--out", "first"]);
    let mut first = first.stdout(Stdio::null()).spawn().expect("it starts");
    let patience = Instant::now() + Duration::from_secs(60);
    while !wire.path("first").exists() {
        assert!(Instant::now() < patience, "it never began");
        std::thread::sleep(Duration::from_millis(20));
    }
    let second = wire
        .run(&["--rig", "rig.toml", "--out", "second"])
        .output()
        .expect("it starts");
    let said = said(&second);
    first.kill().expect("it was started here");
    first.wait().expect("it was started here");
    assert!(said.contains("is in use by another run"), "{said}");
    assert!(!second.status.success() && !wire.path("second").exists());
}

#[test]
fn a_run_that_is_killed_again_and_again_loses_no_press_and_doubles_none() {
    let wire = Wire::start();
    let mut random = Random::new(SEED);
    for kill in 0..KILLS {
        let resume: &[&str] = match wire.path("run/plans.json").exists() {
            true => &["--rig", "rig.toml", "--out", "run", "--resume"],
            false => &["--rig", "rig.toml", "--out", "run"],
        };
        let mut child = wire.run(resume);
        let mut child = child
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        let after = Duration::from_millis(2_000 + random.below(9_000) as u64);
        std::thread::sleep(after);
        // It may have ended by itself.
        let _ = child.kill();
        child
            .wait()
            .unwrap_or_else(|error| panic!("kill {kill}: {error}"));
    }
    let whole = wire.finished(&["--rig", "rig.toml", "--out", "run", "--resume"]);
    assert!(whole.status.success(), "{}", said(&whole));
    let dataset = Dataset::open(wire.path("run/recordings/1-wire")).expect("whole");
    let mut presses: Vec<String> = dataset
        .table()
        .samples()
        .iter()
        .filter_map(|name| name.split('/').next().map(str::to_owned))
        .collect();
    let samples = presses.len();
    presses.dedup();
    // Samples of a press are neighbours, so that one that was made twice would show.
    assert_eq!(presses.len(), PRESSES, "of {samples} samples");
    assert!(rows(&wire.path("run")) >= 1);
}
