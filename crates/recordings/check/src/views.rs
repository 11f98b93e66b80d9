//! Checks of recordings with several pictures per sample, view by view.

use taceva_core::Progress;
use taceva_dataset::Dataset;
use taceva_evaluate::EvaluateError;

use crate::finding::{CheckReport, Finding};
use crate::run::{CheckRequest, check_seen};

/// Checks the labels of `dataset`, and the pictures of each of its views.
///
/// A finding that occurs without pictures and in every view concerns labels, and is reported once. Any other finding names its views.
pub(crate) fn check_views(
    dataset: &Dataset,
    request: &CheckRequest,
    progress: &dyn Progress,
) -> Result<CheckReport, EvaluateError> {
    let labels = check_seen(dataset, request, progress)?;
    let mut reports: Vec<(&str, CheckReport)> = Vec::new();
    for view in dataset.views() {
        let seen = dataset.seen(view)?;
        reports.push((view, check_seen(&seen, request, progress)?));
    }
    let mut findings: Vec<Finding> = Vec::new();
    let mut views_of: Vec<Vec<&str>> = Vec::new();
    for (view, report) in &reports {
        for finding in &report.findings {
            match findings.iter().position(|known| known == finding) {
                Some(at) => views_of[at].push(view),
                None => {
                    findings.push(finding.clone());
                    views_of.push(vec![view]);
                }
            }
        }
    }
    for (finding, views) in findings.iter_mut().zip(&views_of) {
        let is_of_labels = labels.findings.contains(finding) && views.len() == reports.len();
        if !is_of_labels {
            let views: Vec<String> = views.iter().map(|view| format!("`{view}`")).collect();
            let plural = if views.len() > 1 { "views" } else { "view" };
            finding.message = format!("{plural} {}: {}", views.join(", "), finding.message);
        }
    }
    findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
    let frames_decoded = reports.iter().map(|(_, report)| report.frames_decoded);
    let frames_decoded = frames_decoded.sum();
    let (looked_for, skipped) = match reports.into_iter().next() {
        Some((_, first)) => (first.looked_for, first.skipped),
        None => (labels.looked_for, labels.skipped),
    };
    Ok(CheckReport {
        frames_decoded,
        looked_for,
        findings,
        skipped,
        ..labels
    })
}
