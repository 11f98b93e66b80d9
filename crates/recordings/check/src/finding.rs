//! What a check looks for, and what it found.

use std::fmt;

use serde::Serialize;
use taceva_core::{Field, Skipped};

use crate::evidence::Evidence;

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// Numbers computed from this may mislead.
    Warning,
    /// Numbers computed from this are wrong.
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

/// One thing to look for. The code never changes its meaning.
#[derive(Debug)]
pub struct Check {
    /// Stable, for scripts: `TAC001`.
    pub code: &'static str,
    /// The same in words: `units-by-magnitude`.
    pub name: &'static str,
    /// What is looked for, in one line.
    pub looks_for: &'static str,
    /// What to do about a finding.
    pub hint: &'static str,
    /// What must be read of every sample for it beside its labels: frames, signals, or nothing.
    pub reads: Option<Field>,
    /// Looks.
    pub(crate) find: fn(&Evidence<'_>) -> Vec<Found>,
}

/// What one check found, before the code of the check is added.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Found {
    pub(crate) severity: Severity,
    pub(crate) message: String,
    pub(crate) samples: Vec<String>,
    pub(crate) count: usize,
}

impl Found {
    /// Samples named in a finding; the rest are counted.
    const NAMED: usize = 5;

    /// A finding about the recording as a whole.
    pub(crate) fn overall(severity: Severity, message: String) -> Found {
        Found {
            severity,
            message,
            samples: Vec::new(),
            count: 0,
        }
    }

    /// A finding about single samples.
    pub(crate) fn about<'a>(
        severity: Severity,
        message: String,
        samples: impl IntoIterator<Item = &'a str>,
    ) -> Found {
        let mut named = Vec::new();
        let mut count = 0;
        for sample in samples {
            if count < Found::NAMED {
                named.push(sample.to_owned());
            }
            count += 1;
        }
        Found {
            severity,
            message,
            samples: named,
            count,
        }
    }
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The code of the check.
    pub code: &'static str,
    /// The name of the check.
    pub name: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// What was found, with the numbers that decided.
    pub message: String,
    /// The first few samples concerned.
    pub samples: Vec<String>,
    /// How many samples are concerned; 0 if it is about the recording as a whole.
    pub count: usize,
    /// What to do about it.
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
            hint: check.hint,
        }
    }
}

/// Everything that was found in one recording.
#[derive(Clone, Debug, Serialize)]
pub struct CheckReport {
    /// The schema of this report.
    pub schema: &'static str,
    /// The digest of the dataset.
    pub dataset: String,
    /// Its number of samples.
    pub samples: usize,
    /// Frames decoded to look at them.
    pub frames_decoded: u64,
    /// The codes that were looked for.
    pub looked_for: Vec<&'static str>,
    /// What was found, worst first.
    pub findings: Vec<Finding>,
    /// What could not be looked for, and why.
    #[serde(serialize_with = "taceva_evaluate::skipped")]
    pub skipped: Vec<Skipped>,
}

impl CheckReport {
    /// The worst severity found.
    pub fn worst(&self) -> Option<Severity> {
        self.findings.iter().map(|finding| finding.severity).max()
    }
}
