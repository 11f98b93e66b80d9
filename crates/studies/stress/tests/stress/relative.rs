//! Tests of the errors that faults add, relative to those of a reference model.

use taceva_dataset::Dataset;
use taceva_evaluate::DataPart;
use taceva_models::Model;
use taceva_stress::{
    By, OtherFaults, StressReport, StressRequest, Undefined, add_reference, stress,
};

use crate::drawing::{WORK, fitted, record, unseen};

fn request(severities: &[u8]) -> StressRequest {
    StressRequest {
        faults: vec!["exposure_low".to_owned(), "dust".to_owned()],
        severities: severities.to_vec(),
        by: By::Parameter,
        ..StressRequest::default()
    }
}

/// Stress test of `model`, with its added errors relative to those of `reference`.
fn relative(dataset: &Dataset, model: &Model, reference: &Model) -> StressReport {
    let request = request(&[3, 4, 5]);
    let mut report = stress(dataset, model, &request, WORK).expect("tested");
    let others = OtherFaults::default();
    add_reference(&mut report, dataset, reference, &request, others, WORK).expect("tested");
    report
}

#[test]
fn a_model_has_the_relative_error_one_to_itself_and_the_inverse_to_another() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let same = relative(&dataset, &model, &model);
    let own = same.faults[0].relative_error.as_ref().expect("stated");
    assert!((own["Fz"].value.expect("a ratio") - 1.0).abs() < 1e-12);
    let [low, high] = own["Fz"].ci95.expect("twelve points");
    assert!(high - low < 1e-9, "{own:?}");

    let seen = record(&folder.path().join("other"), 3);
    let other = fitted(&seen, "ridge", &["size=4x4"]);
    let there = relative(&dataset, &model, &other);
    let back = relative(&dataset, &other, &model);
    let value = |report: &StressReport| {
        let ratios = report.faults[0].relative_error.as_ref().expect("stated");
        ratios["Fz"].value.expect("a ratio")
    };
    assert!((value(&there) * value(&back) - 1.0).abs() < 1e-9);
    assert!(there.reference.is_some() && there.provenance.frames_decoded > 120);
}

#[test]
fn a_fault_is_shown_to_add_more_error_to_one_model_than_to_another() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let seen = record(&folder.path().join("other"), 3);
    let settings = ["size=8x8", "difference=true", "strength=20"];
    let weak = fitted(&seen, "ridge", &settings);
    let there = relative(&dataset, &model, &weak);
    let back = relative(&dataset, &weak, &model);
    let of = |report: &StressReport| {
        let all = report.faults[0].difference.as_ref().expect("stated");
        all["Fz"].clone()
    };
    let (less, more) = (of(&there), of(&back));
    assert!(more.is_shown && more.value > Some(0.0), "{more:?}");
    assert_eq!(less.value, more.value.map(|value| -value));
    assert_eq!((less.p, less.is_shown), (more.p, true));
    // Twelve points have 4096 patterns of signs.
    let p = more.p.expect("tested");
    assert!((2.0 / 4096.0..=0.05).contains(&p), "{p}");

    let same = relative(&dataset, &model, &model);
    for (_, own) in same.faults[0].difference.iter().flatten() {
        assert_eq!((own.value, own.p), (Some(0.0), Some(1.0)));
        assert!(!own.is_shown);
    }
}

#[test]
fn a_constant_reference_is_not_moved_by_a_fault() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let seen = record(&folder.path().join("other"), 3);
    let constant = fitted(&seen, "baseline", &["size=8x8"]);
    let report = relative(&dataset, &model, &constant);
    for fault in &report.faults {
        let own = fault.relative_error.as_ref().expect("stated");
        for ratio in own.values() {
            assert_eq!(ratio.value, None);
            assert_eq!(ratio.reason, Some(Undefined::ReferenceUnmoved));
        }
        for difference in fault.difference.as_ref().expect("stated").values() {
            assert!(!difference.is_shown && difference.p.is_none());
            let reason = "the reference model has no skill even without a fault";
            assert_eq!(difference.reason.as_deref(), Some(reason));
        }
    }
}

#[test]
fn a_reference_of_other_samples_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let own = fitted(&dataset, "ridge", &["size=8x8"]);
    let wanted = StressRequest {
        part: Some(DataPart::All),
        ..request(&[3])
    };
    let mut report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let wanted = StressRequest {
        part: None,
        ..wanted
    };
    let others = OtherFaults::default();
    let refused = add_reference(&mut report, &dataset, &own, &wanted, others, WORK);
    let said = refused.expect_err("other samples").to_string();
    assert!(said.contains("the reference model scores"), "{said}");
    assert!(report.reference.is_none());
}
