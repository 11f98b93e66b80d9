//! Tests of the memory of a stress test, compared with that of an evaluation. Each runs in a separate process, which has its own peak.

use std::fs;
use std::path::Path;
use std::process::Command;

use taceva_core::{Frame, PixelFormat};
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateRequest, ModelChoice, evaluate};
use taceva_models::Model;
use taceva_stress::{By, StressRequest, stress};

use crate::drawing::{WORK, fitted, picture, record_with};

/// Maximum additional memory of a stress test, compared with an evaluation, kB.
const MOST_KB: u64 = 64_000;

/// Draws a press in a picture of 160 × 120 pixels, the default size of studies. `number` selects the noise.
fn press(force: f64, place: f64, number: u32) -> Frame {
    picture([160, 120], PixelFormat::Gray8, |x, y| {
        let (across, down) = (f64::from(x) - 6.0 * place, f64::from(y) - 60.0);
        let noise = (x * 7919 + y * 104_729 + number * 1_299_709) % 5;
        let light = force * (-(across * across + down * down) / 500.0).exp();
        0.3 + 0.2 * light + f64::from(noise) / 500.0
    })
}

/// Recording that the returned model has not seen, and the model.
fn unseen(folder: &Path) -> (Dataset, Model) {
    let record = |name: &str, noise: u32| {
        let rest = press(0.0, 0.0, 900 + noise);
        record_with(&folder.join(name), Some(rest), |force, place, number| {
            press(force, place, number * 10 + noise)
        })
    };
    let seen = record("seen", 1);
    let model = fitted(&seen, "ridge", &["size=16x16", "difference=true"]);
    (record("unseen", 2), model)
}

/// Line of `/proc/self/status` with the peak memory of this process.
fn peak() -> String {
    let status = fs::read_to_string("/proc/self/status").expect("a status");
    let mut lines = status.lines();
    let peak = lines.find(|line| line.starts_with("VmHWM:"));
    peak.expect("a peak").to_owned()
}

#[test]
#[ignore = "runs in a process of its own, started by the last test"]
#[expect(clippy::print_stdout, reason = "read by the last test")]
fn an_evaluation() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = EvaluateRequest {
        model: ModelChoice::Fitted(Box::new(model)),
        metrics: vec!["mae".to_owned()],
        part: None,
        sensor: None,
        is_independent: false,
    };
    evaluate(&dataset, &request, WORK).expect("evaluated");
    println!("{}", peak());
}

#[test]
#[ignore = "runs in a process of its own, started by the last test"]
#[expect(clippy::print_stdout, reason = "read by the last test")]
fn sixty_cells() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        by: By::Parameter,
        ..StressRequest::default()
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    let cells = report.faults.iter().map(|fault| fault.severities.len());
    assert_eq!(cells.sum::<usize>(), 60);
    println!("{}", peak());
}

#[test]
fn sixty_cells_take_at_most_64_megabytes_beyond_an_evaluation() {
    let program = std::env::current_exe().expect("this program");
    let [evaluation, stress] = ["an_evaluation", "sixty_cells"].map(|test| {
        let name = format!("memory::{test}");
        let mut command = Command::new(&program);
        command.args(["--exact", &name, "--ignored", "--nocapture"]);
        let output = command.output().expect("this program runs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{text}");
        let line = text.split_once("VmHWM:").expect(&text).1;
        let number = line.split_whitespace().next().expect("a number");
        number.parse::<u64>().expect("kB")
    });
    assert!(
        stress <= evaluation + MOST_KB,
        "{stress} kB, an evaluation takes {evaluation} kB"
    );
}
