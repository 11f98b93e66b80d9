//! Tests that the checks of a recording find faults in pictures.

use taceva_core::PixelFormat;
use taceva_stress::{By, SeverityReport, StressReport, StressRequest, stress};

use crate::drawing::{WORK, fitted, picture, record, record_with, unseen};

fn by_parameter(faults: &[&str]) -> StressRequest {
    StressRequest {
        faults: faults.iter().map(|name| (*name).to_owned()).collect(),
        by: By::Parameter,
        ..StressRequest::default()
    }
}

/// Result of the fault with the index `fault` at its last severity.
fn last(report: &StressReport, fault: usize) -> &SeverityReport {
    report.faults[fault].severities.last().expect("tested")
}

#[test]
fn saturated_and_repeated_pictures_are_found_by_their_checks() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let wanted = by_parameter(&["exposure_high", "stale_frames", "defocus"]);
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    // In the order of the list: blur, light, repeated pictures.
    assert!(last(&report, 1).check.contains(&"TAC004"), "{report:?}");
    let least = &report.faults[1].severities[0];
    assert!(!least.check.contains(&"TAC004"), "{least:?}");
    assert!(last(&report, 2).check.contains(&"TAC002"), "{report:?}");
    let blurred = &last(&report, 0).check;
    assert!(!blurred.contains(&"TAC002") && !blurred.contains(&"TAC004"));
    // An error that a check finds does not pass unnoticed.
    let unnoticed = report.unnoticed.as_ref().expect("there is a reference");
    assert!(
        !unnoticed
            .iter()
            .any(|of| of.fault == "exposure_high" && of.severity == 5)
    );
}

#[test]
fn what_checks_find_without_a_fault_is_not_new() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), 1);
    let model = fitted(&seen, "ridge", &["size=8x8"]);
    let flat = || picture([24, 16], PixelFormat::Gray8, |_, _| 1.0);
    let dataset = record_with(&folder.path().join("flat"), Some(flat()), |_, _, _| flat());
    let report = stress(&dataset, &model, &by_parameter(&["exposure_high"]), WORK).expect("tested");
    for of in &report.faults[0].severities {
        assert!(of.check.is_empty(), "{of:?}");
    }
}
