//! Entry point of the checks, for recordings with one or several pictures per sample.

use taceva_core::Progress;
use taceva_dataset::Dataset;
use taceva_evaluate::EvaluateError;

use crate::finding::CheckReport;
use crate::run::{CheckRequest, check_seen};
use crate::views::check_views;

/// Checks `dataset` for defects. If samples have several pictures, checks the pictures of each view.
///
/// # Errors
/// [`EvaluateError`] if a code does not exist, the split cannot be made, or a frame is damaged.
pub fn check(
    dataset: &Dataset,
    request: &CheckRequest,
    progress: &dyn Progress,
) -> Result<CheckReport, EvaluateError> {
    match dataset.require_view() {
        Ok(()) => check_seen(dataset, request, progress),
        Err(_) => check_views(dataset, request, progress),
    }
}
