//! `taceva accept`.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use taceva_core::shown;
use taceva_dataset::Dataset;
use taceva_report::{
    Acceptance, LimitsFile, Study, Triple, accept, add_process_risks, limits_template,
};

use super::{Context, Usage, results};
use crate::args::{Accept, Conditional, Format};
use crate::report::triple::triple;
use crate::{date, exit, output};

pub(crate) fn run(args: &Accept, context: &Context) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.html);
    output::check_all_free(files, args.output.force)?;
    if let Some(result) = &args.template {
        if results::tasks::read(result)?.is_some() {
            return Err(Usage::error(
                "--template writes limits of channels; for a task write by hand: [[limit]], metric = \"f1\", channel = \"slip\" (the task), unit = \"1\", least = 0.8",
            ));
        }
        let text = limits_template(&study_of(result)?);
        output::write(args.output.path.as_deref(), |out| {
            out.write_all(text.as_bytes())
        })?;
        return Ok(exit::DONE);
    }
    let (Some(result), Some(limits)) = (&args.result, &args.limits) else {
        return Err(Usage::error(
            "expected RESULT.json and --limits LIMITS.toml; `taceva accept --template RESULT.json` writes limits",
        ));
    };
    let date = match &args.date {
        Some(text) => date::read(text).ok_or_else(|| {
            Usage::error(format!(
                "--date `{}`: expected a day such as 2026-11-22",
                taceva_report::escape_terminal(text)
            ))
        })?,
        None => date::today(),
    };
    let text =
        fs::read_to_string(limits).with_context(|| format!("cannot read {}", shown(&limits)))?;
    let limits = LimitsFile::read(&text).with_context(|| shown(&limits).to_string())?;
    let limits = match args.conditional {
        Some(Conditional::Pass) => limits.counting_conditional_passes(),
        None => limits,
    };
    let study = study_of(result)?;
    let mut findings = accept(&study, &limits).with_context(|| shown(&result).to_string())?;
    if !args.process.is_empty() {
        let units = units_of(&args.process)?;
        add_process_risks(&mut findings, &study, &units, target_risk(args)?);
    }
    let pictures = args.html.as_ref().and_then(|_| pictures(result, context));
    let acceptance = Acceptance {
        limits: &limits,
        study: &study,
        findings: &findings,
        date: Some(&date),
        pictures: pictures.as_ref(),
    };
    let written = match args.output.format {
        Format::Csv => acceptance.numbers(),
        _ => acceptance.table(),
    };
    results::write(&written, &args.output, || acceptance.json())?;
    if let Some(path) = &args.html {
        let page = acceptance.page();
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(match acceptance.is_passed() {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}

/// Results of units of one process. Rejects a second result with the same sensor and serial number, because it is the same unit.
fn units_of(named: &[PathBuf]) -> anyhow::Result<Vec<Study>> {
    results::check_distinct(named)?;
    let mut units: Vec<Study> = Vec::new();
    let mut files: Vec<&Path> = Vec::new();
    for path in named {
        for unit in results::read(path)? {
            let is_known = !["", "unknown", "several"].contains(&unit.serial.as_str());
            let is_same =
                |other: &Study| other.sensor == unit.sensor && other.serial == unit.serial;
            let first = units.iter().zip(&files).find(|(other, _)| is_same(other));
            if let Some((_, first)) = first.filter(|_| is_known) {
                return Err(Usage::error(format!(
                    "--process {}: serial {} of {} also occurs in {}; expected one result of each unit: name only one of these files",
                    shown(path),
                    shown(&unit.serial),
                    shown(&unit.sensor),
                    shown(first)
                )));
            }
            units.push(unit);
            files.push(path);
        }
    }
    Ok(units)
}

/// Target consumer's risk from `--target-risk`, the allowed share of wrongly accepted units; `None` without this option.
fn target_risk(args: &Accept) -> anyhow::Result<Option<f64>> {
    match args.target_risk {
        Some(share) if !(share > 0.0 && share < 1.0) => Err(Usage::error(format!(
            "--target-risk {share}: expected a share above 0 and below 1, such as 0.005"
        ))),
        share => Ok(share),
    }
}

/// Reads a result with a single sensor.
fn study_of(result: &Path) -> anyhow::Result<Study> {
    if let Some(of_tasks) = results::tasks::read(result)? {
        return Ok(of_tasks.study());
    }
    results::of_one_sensor(result, results::read(result)?)
}

/// Pictures of the sensor, if `result` is a report of a run with its recording. A read failure is only printed, because limits do not need pictures.
fn pictures(result: &Path, context: &Context) -> Option<Triple> {
    let recording = recording_of(result)?;
    let found = Dataset::open(&recording)
        .map_err(anyhow::Error::from)
        .and_then(|dataset| triple(&dataset, 0));
    found.unwrap_or_else(|error| {
        context.say(format_args!("no pictures: {error:#}"));
        None
    })
}

/// Path of the recording of a run: `recordings/1-gelsight` for the result `reports/1-gelsight.json`. `None` for other results.
fn recording_of(result: &Path) -> Option<PathBuf> {
    let reports = result.parent()?;
    let name = result.file_stem()?;
    let recording = reports.parent()?.join("recordings").join(name);
    (reports.file_name()? == "reports" && recording.is_dir()).then_some(recording)
}
