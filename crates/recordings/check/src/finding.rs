//! Checks and their findings.

use std::fmt;

use serde::Serialize;
use taceva_core::{Field, Skipped};

use crate::evidence::Evidence;

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Useful information.
    Note,
    /// Numbers computed from the data may mislead.
    Warning,
    /// Numbers computed from the data are wrong.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        })
    }
}

/// Check for one kind of defect. The code never changes its meaning.
#[derive(Debug)]
pub struct Check {
    /// Stable code for scripts, such as `TAC001`.
    pub code: &'static str,
    /// Name of the check, such as `units-by-magnitude`.
    pub name: &'static str,
    /// Defect that the check detects, in one line.
    pub looks_for: &'static str,
    /// Remedy for a finding.
    pub hint: &'static str,
    /// Field that the check reads besides labels: frames, signals, or none.
    pub reads: Option<Field>,
    /// Function that runs the check.
    pub(crate) find: fn(&Evidence<'_>) -> Vec<Found>,
}

/// Finding of a check, to which the code of the check is added later.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Found {
    pub(crate) severity: Severity,
    pub(crate) message: String,
    pub(crate) samples: Vec<String>,
    pub(crate) count: usize,
    /// Remedy in place of the remedy of the check; empty if nothing needs a fix. `None` keeps the remedy of the check.
    pub(crate) hint: Option<&'static str>,
}

impl Found {
    /// Maximum number of samples named in a finding; the others are counted.
    const NAMED: usize = 5;

    /// Finding about the recording as a whole.
    pub(crate) fn overall(severity: Severity, message: String) -> Found {
        Found {
            severity,
            message,
            samples: Vec::new(),
            count: 0,
            hint: None,
        }
    }

    /// The same finding without the remedy of its check.
    pub(crate) fn without_hint(self) -> Found {
        self.with_hint("")
    }

    /// The same finding with the remedy `hint` in place of the remedy of its check.
    pub(crate) fn with_hint(self, hint: &'static str) -> Found {
        Found {
            hint: Some(hint),
            ..self
        }
    }
}

impl Evidence<'_> {
    /// Finding about the samples in `rows`.
    pub(crate) fn found(&self, severity: Severity, message: String, rows: &[usize]) -> Found {
        let named = rows.iter().take(Found::NAMED);
        Found {
            severity,
            message,
            samples: named
                .map(|&row| self.table.samples()[row].clone())
                .collect(),
            count: rows.len(),
            hint: None,
        }
    }
}

/// Finding of a check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Code of the check.
    pub code: &'static str,
    /// Name of the check.
    pub name: &'static str,
    /// Severity of the finding.
    pub severity: Severity,
    /// Text of the finding, with the numbers on which it is based.
    pub message: String,
    /// Names of the first few affected samples.
    pub samples: Vec<String>,
    /// Number of affected samples; 0 for a finding about the recording as a whole.
    pub count: usize,
    /// Remedy; empty if nothing needs to be fixed.
    pub hint: &'static str,
}

impl Finding {
    pub(crate) fn new(check: &Check, found: Found) -> Finding {
        Finding {
            code: check.code,
            name: check.name,
            severity: found.severity,
            message: found.message,
            samples: found.samples,
            count: found.count,
            hint: found.hint.unwrap_or(check.hint),
        }
    }
}

/// All findings in one recording.
#[derive(Clone, Debug, Serialize)]
pub struct CheckReport {
    /// Identifier of the schema of this report.
    pub schema: &'static str,
    /// Digest of the dataset.
    pub dataset: String,
    /// Number of samples of the dataset.
    pub samples: usize,
    /// Number of frames decoded.
    pub frames_decoded: u64,
    /// Codes of the checks that ran.
    pub looked_for: Vec<&'static str>,
    /// Findings, the worst first.
    pub findings: Vec<Finding>,
    /// Checks that could not run, each with the reason.
    #[serde(serialize_with = "taceva_evaluate::skipped")]
    pub skipped: Vec<Skipped>,
}

impl CheckReport {
    /// Worst severity of all findings; `None` without findings.
    pub fn worst(&self) -> Option<Severity> {
        self.findings.iter().map(|finding| finding.severity).max()
    }
}
