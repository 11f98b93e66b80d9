//! Studies with a Net F/T box that rotates the frame of its forces, filters and drifts. Its settings page states this or hides it, or the drift is
//! too great.

use std::collections::BTreeMap;
use std::fs;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use taceva_dataset::press_zeros;
use taceva_tests::wire::{OnTheWire, RUN, finished, scene_of};
use taceva_wire::netft::Setup;
use taceva_wire::{BenchOptions, ForceKind, ServeOptions, WallBench};

use crate::wire_faults::alone;

const SEED: u64 = 7;
const PRESSES: usize = 6;
/// Maximum number of restarts of a run that ended because a busy machine delayed readings.
const PATIENCE: usize = 6;
/// Drift of the force zero, N a minute.
const DRIFT_N_MIN: f64 = 0.02;
/// Maximum difference between the force components of two studies, relative to the greatest force.
const FORCE_PART: f64 = 0.02;
/// Maximum difference between a recorded depth and the true depth, mm.
const DEPTH_ERROR_MM: f64 = 0.02;
/// Height above which the tip is between two presses, mm. The tip is observed every [`LOOK`], and a sample belongs to a press within [`NEAR_MM`], mm.
const IN_AIR_MM: f64 = -0.5;
const LOOK: Duration = Duration::from_millis(5);
const NEAR_MM: f64 = 1.0;
/// Axes of a transducer in the base frame. [`TURNED`] states them after a quarter turn about the x axis.
const OWN: &str = "axes = [\"x\", \"-y\", \"-z\"]";
const TURNED: &str = "axes = [\"x\", \"z\", \"-y\"]";
/// Remark with the command for these tests. A filtered reading is 32 ms old when it arrives, and is rejected at 50 ms.
const HOW: &str = "readings may come 15 ms late at most: TACEVA_REQUIRE=quiet-machine cargo test -p taceva-tests --test tests wire_box::";

/// Settings of a box that rotates its frame by a quarter turn about x, and has a low pass of 5 Hz. This filter delays readings by 32 ms.
const BENT: Setup = Setup {
    tool: [0.0, 0.0, 0.0, 90.0, 0.0, 0.0],
    filter: 8,
    drift_n_min: DRIFT_N_MIN,
    ..Setup::PLAIN
};

/// Emulated devices with a Net F/T box with the settings `setup`. `force` is added to the transducer's table in the rig file, and `arguments` to its
/// driver.
fn served(setup: Setup, axes: &str, arguments: &str, force: &str) -> OnTheWire {
    let options = ServeOptions {
        force: ForceKind::Netft,
        netft: setup,
        ..ServeOptions::over(BenchOptions::quiet(SEED))
    };
    // Depths from a fitted surface do not depend on the step at which a late force shows the contact.
    let threshold = "threshold_N = 0.021";
    let scene = scene_of(PRESSES);
    assert!(scene.contains(threshold), "{scene}");
    let surface = format!("{threshold}\ndepth_from = \"surface\"");
    let on = OnTheWire::new(&options, &scene.replace(threshold, &surface));
    let path = on.folder().join("rig.toml");
    let text = fs::read_to_string(&path).expect("written");
    let (robot, rest) = text.split_once("[force]\n").expect("a transducer");
    let (driver, rest) = rest.split_once("\"\n").expect("a driver");
    let rest = rest.replacen(OWN, axes, 1);
    let (before, after) = rest.split_once("latency_ms = 0.0\n").expect("a latency");
    let text = format!("{robot}[force]\n{driver}{arguments}\"\n{before}{force}\n{after}");
    fs::write(&path, text).expect("written");
    on
}

/// Runs the study to its end, and resumes it if the machine was too busy. Returns the error if the study ends for any other reason.
fn ended(on: &OnTheWire) -> Result<(), String> {
    for _ in 0..PATIENCE {
        match finished(on.study()) {
            Ok(_) => return Ok(()),
            Err(said) if said.contains("ms old") || said.contains("ms late") => {}
            Err(said) => return Err(said),
        }
    }
    Err("the machine is too busy".to_owned())
}

/// Deepest point of a press, as the simulated gel records it.
#[derive(Clone, Copy, Debug)]
struct Touch {
    at_mm: [f64; 2],
    depth_mm: f64,
}

/// Runs the study to its end, and observes the simulated gel meanwhile. Returns the result and the presses.
fn watched(on: &OnTheWire) -> (Result<(), String>, Vec<Touch>) {
    let bench = on.served.bench();
    std::thread::scope(|scope| {
        // Dropped even if the study panics, which ends the looks.
        let (over, is_over) = channel();
        let looks = scope.spawn(move || touches(bench, &is_over));
        let ended = ended(on);
        drop(over);
        (ended, looks.join().expect("looks do not panic"))
    })
}

/// Deepest point of the tip for each press, between two motions above the gel. Ends when the sender of `is_over` is dropped.
fn touches(bench: &WallBench, is_over: &Receiver<()>) -> Vec<Touch> {
    let mut found = Vec::new();
    let mut deepest: Option<Touch> = None;
    while is_over.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
        let truth = bench.truth();
        let [x, y, z] = truth.tip_mm;
        if z < IN_AIR_MM {
            found.extend(deepest.take());
        } else if truth.depth_mm > deepest.map_or(0.0, |touch| touch.depth_mm) {
            deepest = Some(Touch {
                at_mm: [x, y],
                depth_mm: truth.depth_mm,
            });
        }
    }
    found.extend(deepest);
    found
}

/// Maximum difference between a recorded depth and the true depth at the same place, mm. Infinite if the gel was not pressed there.
fn depth_error_mm(on: &OnTheWire, touches: &[Touch]) -> f64 {
    let errors = labels(on, ["Px", "Py", "Pz"])
        .into_values()
        .map(|[x, y, z]| {
            let near = touches.iter().filter(|touch| {
                let [touch_x, touch_y] = touch.at_mm;
                (touch_x - x).hypot(touch_y - y) < NEAR_MM
            });
            let apart = near.map(|touch| (touch.depth_mm - z).abs());
            apart.fold(f64::INFINITY, f64::min)
        });
    errors.fold(0.0, f64::max)
}

/// Values of the three channels `names` in each sample, by sample name.
fn labels(on: &OnTheWire, names: [&str; 3]) -> BTreeMap<String, [f64; 3]> {
    let recording = on.recording(RUN);
    let table = recording.table();
    let columns = names.map(|name| {
        let position = table.channels().position(name);
        table.truth(position.expect("it is measured"))
    });
    let samples = table.samples().iter().cloned().enumerate();
    let rows = samples.map(|(row, name)| {
        let label = columns.map(|column| column.get(row).expect("a label"));
        (name, label)
    });
    rows.collect()
}

#[test]
#[expect(clippy::print_stderr, reason = "the differences are the result")]
fn a_study_with_a_turned_frame_a_low_pass_and_drift_ends_within_2_percent_of_one_without() {
    let Some(_alone) = alone(HOW) else {
        return;
    };
    let plain = served(Setup::PLAIN, OWN, "", "latency_ms = 0.0");
    let (ended, touches) = watched(&plain);
    ended.expect("a plain box");
    let plain_error_mm = depth_error_mm(&plain, &touches);
    let bent = served(BENT, TURNED, ";frame=tool", "latency_ms = 31.8");
    let (ended, touches) = watched(&bent);
    ended.expect("a box that states what it does");
    let depth_mm = plain_error_mm.max(depth_error_mm(&bent, &touches));
    let [expected, found] = [&plain, &bent].map(|on| labels(on, ["Fx", "Fy", "Fz"]));
    assert!(expected.keys().eq(found.keys()), "they are of one plan");
    assert_eq!(found.len(), 2 * PRESSES);
    let forces = expected.values().flatten();
    let greatest_n = forces.fold(0.0, |most: f64, force_n| most.max(force_n.abs()));
    let apart = expected.iter().flat_map(|(name, expected)| {
        let pairs = found[name].into_iter().zip(expected);
        pairs.map(|(found, expected)| (found - expected).abs())
    });
    let force_n = apart.fold(0.0, f64::max);
    eprintln!(
        "depths by {depth_mm:.4} mm from those of the gel, forces by {force_n:.4} N of {greatest_n:.3} N"
    );
    assert!(depth_mm <= DEPTH_ERROR_MM, "{depth_mm} mm");
    assert!(
        force_n <= FORCE_PART * greatest_n,
        "{force_n} of {greatest_n} N"
    );
    let recording = bent.recording(RUN);
    let settings = &recording.header().settings;
    assert_eq!(settings["force_frame"], "tool 0;0;0;90;0;0 (mm, degrees)");
    assert_eq!(settings["force_filter"], "8");
    assert_eq!(settings["force_latency_ms"], "31.8");
    assert_eq!(settings["force_axes"], "[\"x\", \"z\", \"-y\"]");
    // The drift is recorded as a signal: each press has its own zero, which rises.
    let zeros = press_zeros(recording.path());
    let kept: Vec<f64> = zeros
        .iter()
        .filter(|zero| zero.is_kept)
        .map(|zero| zero.before_fz_n)
        .collect();
    assert_eq!(kept.len(), PRESSES);
    assert!(
        (kept[PRESSES - 1] - kept[0]).abs() > DRIFT_N_MIN / 12.0,
        "{kept:?}"
    );
    let results = fs::read_to_string(bent.results(RUN)).expect("results");
    assert!(results.contains("the zero of the transducer changed by at most"));
}

#[test]
fn a_box_that_hides_its_frame_and_its_low_pass_ends_in_warnings_in_recording_and_report() {
    let Some(_alone) = alone(HOW) else {
        return;
    };
    let hidden = Setup {
        is_hidden: true,
        ..BENT
    };
    let on = served(hidden, TURNED, "", "latency_ms = 31.8");
    ended(&on).expect("nothing contradicts the rig file");
    let recording = on.recording(RUN);
    let warnings = &recording.header().warnings;
    let results = fs::read_to_string(on.results(RUN)).expect("results");
    for entry in ["cfgtfx", "setuserfilter"] {
        let names = |warning: &&String| warning.contains(entry);
        assert_eq!(warnings.iter().filter(names).count(), 1, "{warnings:?}");
        assert!(results.contains(entry), "no note names {entry}");
    }
    assert!(results.contains("warning of a device: "));
    assert_eq!(recording.header().settings["force_frame"], "unknown");
}

#[test]
fn a_zero_that_drifts_beyond_its_limit_stops_the_study_above_the_gel() {
    let fast = Setup {
        drift_n_min: 0.06,
        ..Setup::PLAIN
    };
    let limit = "latency_ms = 0.0\nzero_step_max_N = 0.001";
    let on = served(fast, OWN, "", limit);
    let said = ended(&on).expect_err("it drifts by more in each press");
    assert!(
        said.contains("the zero of Fz changed from") && said.contains("`zero_step_max_N`"),
        "{said}"
    );
    let truth = on.served.bench().truth();
    assert!(!truth.is_moving && truth.tip_mm[2] < -0.9, "{truth:?}");
}
