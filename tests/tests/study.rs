//! Tests that a study resumes to the same bytes as an uninterrupted study after a kill or a power cut at any moment.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use taceva_needs::{Need, skip};
use taceva_tests::power_cut::{Counted, Disk, Trace, TraceError, Tree, read_tree};
use taceva_tests::{Random, scratch, taceva};

const SEED: u64 = 20_261_121;
/// Default number of kills; `TACEVA_STUDY_KILLS` overrides it.
const KILLS: usize = 60;
/// Maximum number of moments at which a power cut is tried; `TACEVA_STUDY_CUTS` overrides it. At most [`STATES`] states after each cut are resumed,
/// each in one study.
const CUTS: usize = 40;
const STATES: usize = 8;
/// One kill among this number hits a run that resumes after an earlier kill.
const RESUMED: usize = 5;

/// Short scene with pictures, forces, two units, another light and a board.
const SCENE: &str = r#"scene_version = 1
name = "study"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16", units = ["1", "2"] }
protocol = { calibration = { points = 10, indentations = 2 }, spatial = { points = 3 }, gratings = { step_mm = 0.75, presses = 2 }, lighting = { points = 1 }, repeatability = { points = 1, trials = 2, depth_step_mm = 0.5 }, hysteresis = { points = 1, depth_step_mm = 0.5 }, surface = { points = 3 }, idle = { frames = 4 } }
"#;

/// Smaller scene, because the states of a power cut grow with the number of files.
const FEW: &str = r#"scene_version = 1
name = "study"
seed = 7
metrics = { want = ["mae", "sensitivity", "hysteresis"] }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16" }
protocol = { calibration = { points = 4, indentations = 2 }, hysteresis = { points = 1, depth_step_mm = 1.0 } }
"#;

/// Command that starts or resumes the study in the folder `run` of `folder`.
fn study(folder: &Path) -> Command {
    let mut command = Command::new(taceva());
    command
        .current_dir(folder)
        .args(["run", "study.toml", "--out", "run", "--no-cache", "--quiet"])
        .stdout(Stdio::null());
    if folder.join("run").exists() {
        command.arg("--resume");
    }
    command
}

/// Runs the study to its end. Returns its files, or its error message.
fn finished(folder: &Path) -> Result<Tree, String> {
    let output = study(folder)
        .stdin(Stdio::null())
        .output()
        .map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    read_tree(&folder.join("run")).map_err(|error| error.to_string())
}

/// Creates a folder that contains `scene`.
fn with(scene: &str) -> tempfile::TempDir {
    let folder = scratch();
    std::fs::write(folder.path().join("study.toml"), scene).expect("room for a scene");
    folder
}

fn same(found: &Tree, expected: &Tree) -> Result<(), String> {
    let mut paths = expected.keys().chain(found.keys());
    match paths.find(|path| expected.get(*path) != found.get(*path)) {
        None => Ok(()),
        Some(path) => Err(format!("`{path}` is not what an uninterrupted run leaves")),
    }
}

/// Kills the study after `time`; true if it was still running.
fn killed(folder: &Path, time: Duration) -> bool {
    let mut child: Child = study(folder)
        .stderr(Stdio::null())
        .spawn()
        .expect("the program was built");
    let start = Instant::now();
    while start.elapsed() < time {
        std::thread::sleep(Duration::from_micros(200));
    }
    // The study may have ended by itself.
    let _ = child.kill();
    let status = child.wait().expect("a child that was started here");
    !status.success()
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn a_study_killed_at_any_moment_goes_on_to_the_same_bytes() {
    let whole = with(SCENE);
    let expected = finished(whole.path()).expect("nobody interrupts it");
    // The first run may have built the program.
    let whole = with(SCENE);
    let start = Instant::now();
    assert_eq!(finished(whole.path()).as_ref(), Ok(&expected));
    let whole_time = start.elapsed();
    let mut random = Random::new(SEED);
    let mut moment = || whole_time.mul_f64(random.below(1_000) as f64 / 1_000.0);
    let asked = std::env::var("TACEVA_STUDY_KILLS");
    let most = asked.map_or(KILLS, |asked| asked.parse().expect("a number"));
    let (mut kills, mut again) = (0, 0);
    while kills < most {
        let folder = with(SCENE);
        let was_killed = killed(folder.path(), moment());
        kills += usize::from(was_killed);
        if was_killed && again < most / RESUMED {
            let once_more = killed(folder.path(), moment());
            kills += usize::from(once_more);
            again += usize::from(once_more);
        }
        let found = finished(folder.path()).and_then(|found| same(&found, &expected));
        assert_eq!(found, Ok(()), "seed {SEED}, kill {kills}");
    }
    assert_eq!(again, most / RESUMED);
    eprintln!(
        "{kills} kills of a study of {whole_time:?}, {again} of them after it had gone on: nothing differs"
    );
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn a_study_whose_power_is_cut_goes_on_to_the_same_bytes() {
    let whole = with(FEW);
    let expected = finished(whole.path()).expect("nobody interrupts it");
    let folder = with(FEW);
    let initial = Disk::load(folder.path()).expect("a scene");
    let trace = match Trace::run(&study(folder.path()), folder.path(), initial) {
        Err(TraceError::NoStrace(why)) => {
            skip(Need::Strace, why);
            return;
        }
        trace => trace.expect("every call can be followed"),
    };
    assert!(trace.status.success(), "{}", trace.complaint);
    let asked = std::env::var("TACEVA_STUDY_CUTS");
    let is_asked = asked.is_ok();
    let most: usize = asked.map_or(CUTS, |asked| asked.parse().expect("a number"));
    let mut continued = 0;
    let mut counted = Counted::default();
    let cuts = trace.operations.len() + 1;
    for cut in (0..cuts).step_by(cuts.div_ceil(most.max(1))) {
        let states = trace.each_state(cut..cut + 1, |_| Ok(())).states;
        let (mut number, step) = (0, states.div_ceil(STATES).max(1));
        counted = counted.and(trace.each_state(cut..cut + 1, |state| {
            number += 1;
            if number % step != 0 {
                return Ok(());
            }
            continued += 1;
            let restarted = scratch();
            state
                .write_to(restarted.path())
                .expect("room for a small folder");
            same(&finished(restarted.path())?, &expected)
        }));
    }
    eprintln!("power cut during a study: {counted}; {continued} of them were continued");
    assert_eq!(counted.violations, 0, "{counted}");
    assert!(
        is_asked || counted.states > 300 && continued > 150,
        "{continued}: {counted}"
    );
}
