//! TAC004: pixels saturated at full scale.

use taceva_core::Field;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC004",
    name: "saturated-pixels",
    looks_for: "frames with more than 2 % of their values at full scale",
    hint: "lower the exposure or the gain; a saturated pixel does not change with a deeper press",
    reads: Some(Field::Frame),
    find,
};

/// Fraction of full-scale values above which a frame is reported.
const SHARE: f64 = 0.02;
/// Fraction of zero or full-scale values above which a frame is taken as binarised on purpose.
const BINARISED: f64 = 0.98;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let frames: Vec<_> = evidence.frames.iter().enumerate().collect();
    let rows_where = |test: &dyn Fn(f64, f64) -> bool| -> Vec<usize> {
        let facts = frames
            .iter()
            .filter_map(|(row, facts)| Some((*row, facts.as_ref()?)));
        facts
            .filter(|(_, facts)| test(facts.zero, facts.full))
            .map(|(row, _)| row)
            .collect()
    };
    let binarised = rows_where(&|zero, full| zero + full >= BINARISED && full > 0.0);
    let saturated = rows_where(&|zero, full| zero + full < BINARISED && full > SHARE);
    let total = evidence.frames.iter().flatten().count();
    let mut found = Vec::new();
    let mut report = |severity, rows: &[usize], what: &str| {
        if !rows.is_empty() {
            let message = format!("{} of {total} frames {what}", rows.len());
            found.push(evidence.found(severity, message, rows));
        }
    };
    let what = "have more than 2 % of their values at full scale";
    report(Severity::Warning, &saturated, what);
    let what = "are black and white: processed, not the camera's original";
    report(Severity::Note, &binarised, what);
    found
}
