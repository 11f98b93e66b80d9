//! Finds the samples of results that `evaluate`, `score` and `run` wrote.

use std::fs;
use std::path::{Path, PathBuf};
use taceva_core::shown;

use anyhow::{Context as _, bail};
use taceva_report::{Study, escape_terminal};
use taceva_results::Samples;

use super::{Found, RESULTS};

/// Extension of a table of samples, in place of `json`.
const SAMPLES: &str = "samples.csv";
/// Folder of recordings in a run. Names begin with the number of the study.
const RECORDINGS: &str = "recordings";
/// Folder of reports in a run. Names begin with the number of the study.
const REPORTS: &str = "reports";

/// Adds samples to the studies of `file`: from `reports/<number>-*.samples.csv` of a run, or from `<name>.samples.csv` next to a single evaluation.
pub(super) fn beside(file: &Path, mut studies: Vec<Study>) -> anyhow::Result<Found> {
    let is_run = file.file_name().is_some_and(|name| name == RESULTS);
    let own = file.with_extension(SAMPLES);
    let reports = file.with_file_name(REPORTS);
    let is_alone = studies.len() == 1;
    let mut missing = Vec::new();
    for (study, number) in studies.iter_mut().zip(1_u32..) {
        let (wanted, found) = match is_run {
            true => (
                reports.join(format!("{number}-*.{SAMPLES}")),
                of_run(&reports, number)?,
            ),
            false => (own.clone(), of_evaluation(&own, study, is_alone)?),
        };
        match found {
            Some(path) => study.samples = Some(read(&path, study)?),
            None => missing.push(format!(
                "{}: no samples of {} in {}",
                shown(file),
                escape_terminal(&study.sensor),
                shown(&wanted)
            )),
        }
    }
    Ok(Found { studies, missing })
}

/// Table of samples of one evaluation, if any: `own`, named like the result, or another table in the folder with the digest in the result.
fn of_evaluation(own: &Path, study: &Study, is_alone: bool) -> anyhow::Result<Option<PathBuf>> {
    if !is_alone || own.is_file() {
        return Ok(Some(own.to_owned()).filter(|_| is_alone));
    }
    let Some(expected) = digest(study) else {
        return Ok(None);
    };
    let folder = taceva_files::parent_of(own);
    let entries = fs::read_dir(folder).with_context(|| format!("cannot read {}", shown(folder)))?;
    for entry in entries {
        let path = entry?.path();
        let is_table = path.extension().is_some_and(|extension| extension == "csv");
        if !is_table || !path.is_file() {
            continue;
        }
        let table = fs::read(&path).with_context(|| format!("cannot read {}", shown(&path)))?;
        if taceva_files::seal::digest_of_bytes(&table) == expected {
            return Ok(Some(path));
        }
    }
    Ok(None)
}

/// Digest of the table of samples, if the results of `study` state it.
fn digest(study: &Study) -> Option<&str> {
    let mut provenance = study.provenance.iter();
    provenance.find_map(|(name, text)| (name == "samples_table").then_some(text.as_str()))
}

/// Path of the recording of study `number` of a run, counted from 1, the first by name if there are several; empty if the run has none.
pub(super) fn recordings_of_run(file: &Path, number: u32) -> anyhow::Result<Vec<PathBuf>> {
    let recordings = file.with_file_name(RECORDINGS);
    let is_run = file.file_name().is_some_and(|name| name == RESULTS);
    if !is_run || !recordings.is_dir() {
        return Ok(Vec::new());
    }
    let start = format!("{number}-");
    let entries =
        fs::read_dir(&recordings).with_context(|| format!("cannot read {}", shown(&recordings)))?;
    let mut found = Vec::new();
    for entry in entries {
        let entry = entry?;
        if entry.file_name().to_string_lossy().starts_with(&start) {
            found.push(entry.path());
        }
    }
    found.sort_unstable();
    found.truncate(1);
    Ok(found)
}

/// Table of samples of study `number` of a run, counted from 1; the first by name if there are several.
fn of_run(reports: &Path, number: u32) -> anyhow::Result<Option<PathBuf>> {
    if !reports.is_dir() {
        return Ok(None);
    }
    let start = format!("{number}-");
    let of_study = |name: &str| name.starts_with(&start) && name.ends_with(&format!(".{SAMPLES}"));
    let mut names = Vec::new();
    let entries =
        fs::read_dir(reports).with_context(|| format!("cannot read {}", shown(reports)))?;
    for entry in entries {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if of_study(&name) {
            names.push(name);
        }
    }
    names.sort_unstable();
    Ok(names.first().map(|name| reports.join(name)))
}

/// Reads the table of samples at `path`, which must have the digest in the results of `study`.
fn read(path: &Path, study: &Study) -> anyhow::Result<Samples> {
    let table = fs::read_to_string(path).with_context(|| format!("cannot read {}", shown(path)))?;
    check(path, table.as_bytes(), study)?;
    Samples::read(&table).with_context(|| shown(path).to_string())
}

/// Fails if the bytes of the table at `path` do not have the digest in the results of `study`.
fn check(path: &Path, table: &[u8], study: &Study) -> anyhow::Result<()> {
    let found = taceva_files::seal::digest_of_bytes(table);
    if let Some(expected) = digest(study).filter(|expected| *expected != found) {
        bail!(
            "{}: damaged, or written for another result: expected digest {expected}, found {found}",
            shown(path)
        );
    }
    Ok(())
}

/// Origin of the samples in the table `<name>.samples.csv`, by the result `<name>.json` next to it; `None` without a result of one sensor.
pub(in crate::cmd) fn source_of(table: &Path) -> anyhow::Result<Option<String>> {
    let name = table.file_name().and_then(|name| name.to_str());
    let Some(name) = name.and_then(|name| name.strip_suffix(SAMPLES)) else {
        return Ok(None);
    };
    let result = table.with_file_name(format!("{name}json"));
    if !result.is_file() {
        return Ok(None);
    }
    let text =
        fs::read_to_string(&result).with_context(|| format!("cannot read {}", shown(&result)))?;
    let studies = Study::read(&text).with_context(|| shown(&result).to_string())?;
    let [study] = studies.as_slice() else {
        return Ok(None);
    };
    let bytes = fs::read(table).with_context(|| format!("cannot read {}", shown(table)))?;
    check(table, &bytes, study)?;
    Ok(Some(study.source.clone()))
}
