//! Tests of faults of pictures that plugins make.

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_dataset::Dataset;
use taceva_evaluate::Target;
use taceva_models::Model;
use taceva_stress::{
    By, NEVER, OtherFaults, PictureFault, StressReport, StressRequest, stress_unseen,
};

use crate::drawing::{WORK, fitted, picture, record_with, unseen};

/// Result that a test fault returns for each picture.
enum Answer {
    /// Picture whose pixel values are reduced by ten times the severity.
    Darker,
    /// Unchanged picture.
    Same,
    /// Picture of one colour.
    Flat(u8),
    /// Picture of one pixel.
    Small,
    /// Error instead of a picture.
    Failure,
}

struct Drawn(&'static str, Answer);

impl PictureFault for Drawn {
    fn name(&self) -> &str {
        self.0
    }

    fn key(&self) -> &str {
        "org.example/drawn"
    }

    fn apply(&self, frame: &Frame, severity: u8, _sample: &str) -> Result<Frame, String> {
        let info = frame.info();
        let made = match self.1 {
            Answer::Darker => {
                let bytes = frame.bytes().iter();
                let bytes = bytes.map(|byte| byte.saturating_sub(10 * severity));
                Frame::new(info, bytes.collect())
            }
            Answer::Same => Ok(frame.clone()),
            Answer::Flat(light) => Frame::new(info, vec![light; frame.bytes().len()]),
            Answer::Small => {
                let info = FrameInfo {
                    width: 1,
                    height: 1,
                    ..info
                };
                let bytes = vec![0; info.byte_len().expect("small")];
                Frame::new(info, bytes)
            }
            Answer::Failure => return Err("NaN at sample 3".to_owned()),
        };
        made.map_err(|error| error.to_string())
    }
}

fn tested(faults: &[&dyn PictureFault], pictures: &[&str]) -> StressReport {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    tested_with(&dataset, &model, faults, pictures)
}

fn tested_with(
    dataset: &Dataset,
    model: &Model,
    faults: &[&dyn PictureFault],
    pictures: &[&str],
) -> StressReport {
    let target = Target::of(dataset, None, None, true).expect("samples");
    let request = StressRequest {
        faults: pictures.iter().map(|name| (*name).to_owned()).collect(),
        severities: vec![1, 5],
        by: By::Parameter,
        ..StressRequest::default()
    };
    let others = OtherFaults {
        foreign: faults,
        ..OtherFaults::default()
    };
    stress_unseen(dataset, model, target, &request, others, WORK).expect("tested")
}

#[test]
fn a_fault_of_a_plugin_stands_beside_those_of_the_list() {
    let darker = Drawn("darker", Answer::Darker);
    let report = tested(&[&darker], &["exposure_low"]);
    assert_eq!(report.list.name, "exposure_low,darker");
    assert!(report.failed.is_empty());
    let own = &report.faults[1];
    assert_eq!(own.id, "darker");
    let stimuli: Vec<f64> = own.severities.iter().filter_map(|of| of.stimulus).collect();
    assert!(stimuli.len() == 2 && stimuli[0] < stimuli[1], "{stimuli:?}");
    assert!(
        own.mean.values().all(|mean| mean.value.is_some()),
        "{own:?}"
    );
    let alone = tested(&[&darker], &[]);
    assert_eq!(alone.list.name, "darker");
    assert_ne!(alone.list.digest, report.list.digest);
    // A fault of a plugin is another one than a fault of the list with its name.
    let named = tested(&[&Drawn("dust", Answer::Darker)], &[]);
    let listed = tested(&[], &["dust"]);
    assert_eq!(named.list.name, listed.list.name);
    assert_ne!(named.list.digest, listed.list.digest);
}

#[test]
fn a_fault_that_returns_each_picture_has_a_degradation_of_exactly_one() {
    let report = tested(&[&Drawn("same", Answer::Same)], &[]);
    let same = &report.faults[0];
    assert_eq!(same.severities.len(), 2);
    for of in &same.severities {
        assert_eq!(of.stimulus, Some(0.0));
        let fresh = of.fresh.as_ref().expect("the model reads differences");
        for score in of.stale.values().chain(fresh.values()) {
            assert_eq!(score.degradation.value, Some(1.0));
            assert_eq!(score.degradation.ci95, Some([1.0, 1.0]));
        }
    }
    let means = same.mean.values().chain(report.mean.values());
    assert!(means.clone().count() > 0 && means.clone().all(|of| of.value == Some(1.0)));
    assert_eq!(same.breaks_at["Fz"], Some(NEVER));
}

#[test]
fn a_fault_that_fails_is_named_and_the_others_go_on() {
    let small = Drawn("small", Answer::Small);
    let failure = Drawn("failure", Answer::Failure);
    let darker = Drawn("darker", Answer::Darker);
    let report = tested(&[&small, &failure, &darker], &[]);
    let tested: Vec<&str> = report
        .faults
        .iter()
        .map(|fault| fault.id.as_str())
        .collect();
    assert_eq!(tested, ["darker"]);
    let failed: Vec<&str> = report.failed.iter().map(|of| of.fault.as_str()).collect();
    assert_eq!(failed, ["small", "failure"]);
    assert!(
        report.failed[0].reason.contains("expected the same size"),
        "{:?}",
        report.failed
    );
    assert_eq!(report.failed[1].reason, "NaN at sample 3");
}

/// Picture of a gel with 24 bright markers, which `force` shifts to the right. `number` selects the noise.
fn marked(force: f64, number: u32) -> Frame {
    let is_dot = |at: f64, dots: f64| {
        let cell = (at / 16.0).floor();
        (6.0..11.0).contains(&(at - 16.0 * cell)) && (1.0..=dots).contains(&cell)
    };
    picture([128, 96], PixelFormat::Gray8, |x, y| {
        let is_lit = is_dot(f64::from(x) - 2.0 * force, 6.0) && is_dot(f64::from(y), 4.0);
        let noise = (x * 7919 + y * 104_729 + number * 1_299_709) % 5;
        f64::from(noise) / 500.0 + if is_lit { 0.7 } else { 0.1 }
    })
}

#[test]
fn a_model_of_markers_has_finite_errors_where_a_fault_leaves_no_marker() {
    let folder = tempfile::tempdir().expect("a folder");
    let record = |name: &str, noise: u32| {
        let rest = marked(0.0, 900 + noise);
        record_with(&folder.path().join(name), Some(rest), |force, _, number| {
            marked(force, 10 * number + noise)
        })
    };
    let (seen, dataset) = (record("seen", 1), record("unseen", 2));
    let model = fitted(&seen, "ridge", &["features=markers", "size=8x8"]);
    let black = Drawn("black", Answer::Flat(0));
    let white = Drawn("white", Answer::Flat(255));
    let report = tested_with(&dataset, &model, &[&black, &white], &["gel-12"]);
    assert!(report.failed.is_empty(), "{:?}", report.failed);
    assert_eq!(report.faults.len(), 14);
    for fault in &report.faults {
        for of in &fault.severities {
            let errors = of.stale.values().filter_map(|score| score.mae.value);
            let errors: Vec<f64> = errors.collect();
            assert!(!errors.is_empty(), "{}", fault.id);
            assert!(errors.iter().all(|error| error.is_finite()), "{}", fault.id);
        }
    }
    // An untouched picture without markers is no reference.
    for fault in &report.faults[12..] {
        assert!(
            fault.severities.iter().all(|of| of.fresh.is_none()),
            "{}",
            fault.id
        );
    }
}
