//! Facts of an unfinished recording that its journal lacks: the day of the last session, warnings of devices, and settings that were measured during
//! the recording.
//!
//! These facts become known only after the journal was begun. A file beside the recording stores them until the recording is closed.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::Date;

use crate::header::RecordingFacts;
use crate::toml_file::read_toml;

/// Facts of an unfinished recording that its journal lacks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct LaterFacts {
    /// UTC day of the last session, if different from the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) recorded_until: Option<Date>,
    /// Warnings of the devices about their readings.
    pub(crate) warnings: Vec<String>,
    /// Settings that are known only after a session, such as the drift of a clock. A later session replaces the values that it measures again.
    pub(crate) measured: BTreeMap<String, String>,
}

impl LaterFacts {
    /// Facts beside the recording at `recording`; none without a file, or if it is unreadable.
    pub(crate) fn of(recording: &Path) -> LaterFacts {
        read_toml(&place(recording)).unwrap_or_default()
    }

    /// Removes the facts of a closed recording, whose header contains them.
    pub(crate) fn remove(recording: &Path) {
        // Without its recording, the file has no effect.
        let _ = fs::remove_file(place(recording));
    }

    fn write(&self, recording: &Path) -> io::Result<()> {
        let text = toml::to_string(self).map_err(io::Error::other)?;
        taceva_files::replace(&place(recording), |staged| fs::write(staged, text))
    }
}

/// Sets the last day of `facts` to `today`, the day of a session that resumes the recording at `recording`, and stores it.
pub(crate) fn resume_on(
    today: Option<Date>,
    facts: &mut RecordingFacts,
    recording: &Path,
) -> io::Result<()> {
    let later = today.filter(|_| today > facts.recorded_on.max(facts.recorded_until));
    if later.is_none() {
        return Ok(());
    }
    facts.recorded_until = later;
    let kept = LaterFacts {
        recorded_until: later,
        ..LaterFacts::of(recording)
    };
    kept.write(recording)
}

/// Adds warnings of the devices that make the unfinished recording at `recording`. The header will contain each warning once.
///
/// # Errors
/// Errors of the file system.
#[doc(hidden)]
pub fn add_device_warnings(recording: &Path, warnings: &[String]) -> io::Result<()> {
    let mut facts = LaterFacts::of(recording);
    let known = facts.warnings.len();
    for warning in warnings {
        if !facts.warnings.contains(warning) {
            facts.warnings.push(warning.clone());
        }
    }
    match facts.warnings.len() == known {
        true => Ok(()),
        false => facts.write(recording),
    }
}

/// Adds settings that were measured during a session of the unfinished recording at `recording`. Replaces earlier values of these settings.
///
/// # Errors
/// Errors of the file system.
#[doc(hidden)]
pub fn add_measured_settings(
    recording: &Path,
    measured: &BTreeMap<String, String>,
) -> io::Result<()> {
    if measured.is_empty() {
        return Ok(());
    }
    let mut facts = LaterFacts::of(recording);
    facts.measured.extend(measured.clone());
    facts.write(recording)
}

fn place(recording: &Path) -> PathBuf {
    let mut name = recording.file_name().unwrap_or_default().to_owned();
    name.push(".later.toml");
    recording.with_file_name(name)
}
