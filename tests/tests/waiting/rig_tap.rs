//! Tests that `taceva rig tap` measures known latencies of links over sockets, and writes them to the rig file.

use std::fs;
use std::process::Output;
use std::time::Duration;

use serde_json::Value;
use taceva_tests::wire::{OnTheWire, scene_of};
use taceva_wire::{BenchOptions, Device, RobotKind, ServeOptions};

const SEED: u64 = 7;
/// Emulated latency of force readings, ms. [`CAMERA_MS`] is the latency of frames, ms.
const FORCE_MS: f64 = 20.0;
const CAMERA_MS: f64 = 60.0;
/// Tolerance of the measured force latency, ms; [`CAMERA_OFF_MS`] is for the camera. The machine may be busy, frames come at 25 Hz, and force
/// readings every 5 ms.
const FORCE_OFF_MS: f64 = 4.0;
const CAMERA_OFF_MS: f64 = 15.0;
/// Maximum number of repetitions of taps that failed because the machine was busy.
const PATIENCE: usize = 5;

/// Emulated devices whose messages have the known latencies.
fn lagging(robot: RobotKind) -> OnTheWire {
    let options = ServeOptions {
        robot,
        ..ServeOptions::over(BenchOptions::quiet(SEED))
    };
    let on = OnTheWire::new(&options, &scene_of(6));
    let lag = |ms: f64| Duration::from_secs_f64(ms / 1e3);
    on.served.bench().set_lag(Device::Force, lag(FORCE_MS));
    on.served.bench().set_lag(Device::Camera, lag(CAMERA_MS));
    on
}

fn tap(on: &OnTheWire, options: &[&str]) -> Output {
    let mut taps = on.taps();
    taps.args(options).output().expect("the program was built")
}

/// Output of the taps, repeated if the machine was too busy.
fn tapped(on: &OnTheWire, options: &[&str]) -> Value {
    let mut said = String::new();
    for _ in 0..PATIENCE {
        let output = tap(on, &[&["--format", "json"], options].concat());
        if output.status.success() {
            return serde_json::from_slice(&output.stdout).expect("JSON");
        }
        said = String::from_utf8_lossy(&output.stderr).into_owned();
        let is_busy = ["varies by", "ms late", "ms old", "arrived"];
        assert!(is_busy.iter().any(|words| said.contains(words)), "{said}");
    }
    panic!("{said}");
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
#[expect(clippy::print_stderr, reason = "what is found is the result")]
fn links_that_lag_by_known_amounts_are_found_to_and_the_rig_file_says_so() {
    let on = lagging(RobotKind::Xarm);
    let path = on.folder().join("rig.toml");
    let before = fs::read_to_string(&path).expect("written");
    let shown = tapped(&on, &["--dry-run"]);
    assert_eq!(shown["schema"], "taceva.rig-tap/1");
    assert_eq!(fs::read_to_string(&path).expect("there"), before);
    let shown = tapped(&on, &[]);
    eprintln!("{shown}");
    let robot_ms = shown["latencies"]["robot_ms"].as_f64().unwrap_or(0.0);
    let force_ms = number(&shown["latencies"]["force_ms"]) - robot_ms;
    let camera_ms = number(&shown["latencies"]["sensor_ms"]) - robot_ms;
    assert!((force_ms - FORCE_MS).abs() < FORCE_OFF_MS, "{shown}");
    assert!((camera_ms - CAMERA_MS).abs() < CAMERA_OFF_MS, "{shown}");
    let after = fs::read_to_string(&path).expect("there");
    let (_, force) = after.split_once("[force]").expect("a transducer");
    let line = force
        .lines()
        .find_map(|line| line.strip_prefix("latency_ms = "));
    let written_ms: f64 = line.expect("it is written").parse().expect("a number");
    assert!((written_ms - robot_ms - force_ms).abs() < 1e-9, "{after}");
    // All lines but the two latencies and their uncertainties are as before, including the comment of the first line.
    let is_of_latency = |line: &&str| line.starts_with("latency_");
    let others = |text: &str| -> Vec<String> {
        let others = text.lines().filter(|line| !is_of_latency(line));
        others.map(str::to_owned).collect()
    };
    assert_eq!(others(&after), others(&before));
    assert_eq!(after.lines().filter(is_of_latency).count(), 4, "{after}");
    let uncertain = after.matches("latency_u_ms = ").count();
    assert_eq!(uncertain, 2, "{after}");
    // Repeated taps find no remaining latency: the rig file corrects the stamps.
    let again = tapped(&on, &["--dry-run"]);
    let left_ms = number(&again["force"]["after_robot_ms"]);
    assert!(left_ms.abs() < FORCE_OFF_MS, "{again}");
    // The arm is above the gel, which was pressed by less than half of the allowed depth.
    let truth = on.served.bench().truth();
    assert!(
        truth.tip_mm[2] < -0.9 && truth.deepest_mm < 0.5,
        "{truth:?}"
    );
}

#[test]
fn a_rig_without_limits_is_not_tapped_and_says_which_are_missing() {
    let on = lagging(RobotKind::Xarm);
    let path = on.folder().join("rig.toml");
    let text = fs::read_to_string(&path).expect("written");
    let without: String = text
        .lines()
        .filter(|line| !line.contains("_max_mm =") && !line.starts_with("Fz_max"))
        .map(|line| format!("{line}\n"))
        .collect();
    fs::write(&path, &without).expect("written");
    let output = tap(&on, &[]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("Pz_max_mm"), "{said}");
    assert_eq!(fs::read_to_string(&path).expect("there"), without);
    assert!(on.served.bench().truth().way_mm < 1e-9, "nothing moved");
}
