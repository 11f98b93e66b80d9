//! Reads existing results.

mod faults;
mod samples;
pub(super) mod tasks;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use taceva_core::shown;
use taceva_dataset::internal::quoted;

use anyhow::Context as _;
use taceva_report::catalogue::Sensor;
use taceva_report::{Layout, Study, Table, catalogue, escape_markdown, escape_terminal};
use taceva_results::{EvaluationReport, Score};

use super::Usage;
use crate::args::{Format, Output};
use crate::output;

pub(super) use faults::{faults_of, read_all_with_faults};
pub(super) use samples::source_of;

/// Name of the file with all results in the folder of a run.
pub(super) const RESULTS: &str = "results.json";
/// Header of a dataset.
const HEADER: &str = "dataset.toml";

/// Results with the samples from which they were computed.
#[derive(Default)]
pub(super) struct Found {
    /// The studies, each with its samples if they were found.
    pub(super) studies: Vec<Study>,
    /// Message for each study whose samples were not found.
    pub(super) missing: Vec<String>,
}

/// The only element of `all`, which has an element for each sensor of the result `path`. Fails for several sensors or none.
pub(super) fn of_one_sensor<T>(path: &Path, mut all: Vec<T>) -> anyhow::Result<T> {
    match (all.pop(), all.len()) {
        (Some(one), 0) => Ok(one),
        (found, others) => Err(Usage::error(format!(
            "{}: {} sensors, expected the result of one sensor; the folder `reports` of a run has a result for each sensor",
            shown(path),
            others + usize::from(found.is_some())
        ))),
    }
}

/// Rejects a result that is named twice, such as a run by folder and file, or a sensor of the catalogue by two names.
pub(super) fn check_distinct(named: &[PathBuf]) -> anyhow::Result<()> {
    for (position, path) in named.iter().enumerate() {
        let mut before = named[..position].iter();
        if let Some(first) = before.find(|before| meant(before) == meant(path)) {
            let first = match first == path {
                true => String::new(),
                false => format!(", first as {}", shown(first)),
            };
            return Err(Usage::error(format!(
                "{} is named twice{first}, expected different results",
                shown(path)
            )));
        }
    }
    Ok(())
}

/// Rejects a channel that none of `scores` has.
pub(super) fn check_channels<'a>(
    scores: impl Iterator<Item = &'a Score>,
    wanted: &[String],
) -> anyhow::Result<()> {
    let known: BTreeSet<&str> = scores.map(|score| score.channel.as_str()).collect();
    match wanted.iter().find(|name| !known.contains(name.as_str())) {
        Some(name) => Err(Usage::error(format!(
            "--channels {}: no result has this channel, expected one of {}",
            escape_terminal(name),
            Vec::from_iter(known).join(", ")
        ))),
        None => Ok(()),
    }
}

/// Canonical path of the file `path`, or main name of the sensor called `path` in the catalogue.
fn meant(path: &Path) -> PathBuf {
    let of_run = path.join(RESULTS);
    let file = if of_run.is_file() {
        of_run.as_path()
    } else {
        path
    };
    file.canonicalize().unwrap_or_else(|_| {
        let sensor = catalogue::named(&path.to_string_lossy());
        sensor.map_or_else(|_| path.to_owned(), |sensor| PathBuf::from(sensor.name))
    })
}

/// Studies of all results in `named`: files, folders of runs, or otherwise sensors of the catalogue.
pub(super) fn find_all(named: &[PathBuf]) -> anyhow::Result<Found> {
    find_among(named, None)
}

/// Same as [`find_all`], with the names of `sensors` instead of the catalogue.
pub(super) fn find_among(named: &[PathBuf], sensors: Option<&[Sensor]>) -> anyhow::Result<Found> {
    let mut all = Found::default();
    for path in named {
        let found = find(path, sensors)?;
        all.studies.extend(found.studies);
        all.missing.extend(found.missing);
    }
    Ok(all)
}

/// Studies of all results, without messages about samples.
pub(super) fn read_all(named: &[PathBuf]) -> anyhow::Result<Vec<Study>> {
    find_all(named).map(|found| found.studies)
}

/// Studies of one result.
pub(super) fn read(path: &Path) -> anyhow::Result<Vec<Study>> {
    find(path, None).map(|found| found.studies)
}

/// Line for each sensor of the catalogue that is named by an alias.
pub(super) fn aliases(named: &[PathBuf]) -> Vec<String> {
    let names = named.iter().filter(|path| !path.exists());
    let lines = names.filter_map(|path| {
        let name = path.to_string_lossy();
        let sensor = catalogue::find(&name)?;
        catalogue::listed_as(&name, &sensor)
    });
    lines.collect()
}

fn find(path: &Path, sensors: Option<&[Sensor]>) -> anyhow::Result<Found> {
    if !path.exists() {
        let name = path.to_string_lossy();
        let sensor = match sensors {
            None => catalogue::named(&name),
            Some(sensors) => catalogue::named_among(sensors, &name),
        };
        let sensor = sensor.map_err(|error| {
            let name = escape_terminal(&name);
            Usage::error(format!("`{name}`: no such file, and {error}"))
        })?;
        return Ok(Found {
            studies: sensor.studies(),
            missing: Vec::new(),
        });
    }
    let file = file_of(path)?;
    let text =
        fs::read_to_string(&file).with_context(|| format!("cannot read {}", shown(&file)))?;
    let studies = Study::read(&text).with_context(|| shown(&file).to_string())?;
    samples::beside(&file, studies)
}

/// Evaluation reports with the samples from which they were computed.
pub(super) struct Reports {
    pub(super) reports: Vec<EvaluationReport>,
    /// Remark for each report whose samples were not found.
    pub(super) missing: Vec<String>,
}

/// Reports of a run or of a file, with samples and recordings if these are in the expected places.
pub(super) fn reports(path: &Path) -> anyhow::Result<Reports> {
    let file = file_of(path)?;
    let text =
        fs::read_to_string(&file).with_context(|| format!("cannot read {}", shown(&file)))?;
    let mut reports = taceva_results::read(&text).with_context(|| shown(&file).to_string())?;
    let studies = reports.iter().cloned().map(Study::from).collect();
    let found = samples::beside(&file, studies)?;
    for ((report, study), number) in reports.iter_mut().zip(found.studies).zip(1_u32..) {
        let recordings = samples::recordings_of_run(&file, number)?;
        let samples = study.samples;
        report.samples = samples.map(|samples| samples.with_recordings(recordings));
    }
    Ok(Reports {
        reports,
        missing: found.missing,
    })
}

/// Path of the file of results for `path`, which is the folder of a run or the file itself.
fn file_of(path: &Path) -> anyhow::Result<PathBuf> {
    let is_page = path
        .extension()
        .is_some_and(|extension| extension == "html");
    let file = path.join(RESULTS);
    let named = shown(path);
    let problem = match (path.is_dir(), runs_in(path).as_slice()) {
        (true, _) if file.is_file() => return Ok(file),
        (false, _) if is_page => format!(
            "{named} is a page; name the run folder or the JSON of `evaluate --format json --out`"
        ),
        (false, _) => return Ok(path.to_owned()),
        (true, _) if path.join(HEADER).is_file() => {
            format!(
                "{named} is a dataset: `taceva evaluate {}` computes a result",
                quoted(path)
            )
        }
        (true, [first, others @ ..]) => {
            let more = match others.len() {
                0 => String::new(),
                count => format!(" (and {count} more)"),
            };
            format!(
                "{named}: a folder of runs; did you mean {}{more}?",
                shown(first)
            )
        }
        (true, []) => format!(
            "{named}: a folder without {RESULTS}; expected the folder of a run, or the JSON of evaluate, score or run"
        ),
    };
    Err(Usage::error(problem))
}

/// Runs in the folder at `path`, by name.
fn runs_in(path: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(path).into_iter().flatten().flatten();
    let folders = entries.map(|entry| entry.path());
    let mut runs: Vec<PathBuf> = folders.filter(|run| run.join(RESULTS).is_file()).collect();
    runs.sort();
    runs
}

/// Width of the terminal for output, in characters; `None` for a file or a pipe.
pub(super) fn width(to: &Output) -> Option<usize> {
    to.path.is_none().then(output::terminal_width).flatten()
}

/// Writes `values` for readers, as text or Markdown, followed by `rest`.
pub(super) fn write_values(
    values: &Table,
    rest: impl FnOnce(Option<usize>) -> String,
    to: &Output,
) -> anyhow::Result<()> {
    let width = width(to);
    let text = match (to.format, width) {
        (Format::Md, _) => format!(
            "{}\n\n{}",
            escape_markdown(&values.caption),
            values.markdown()
        ),
        (_, Some(width)) => values.text_within(width),
        (_, None) => values.text(),
    };
    output::write_as(to.format, to.path.as_deref(), |out| {
        write!(out, "{text}\n{}", rest(width))
    })
}

/// Writes a table to the path and in the format of `to`. `json` creates the JSON.
pub(super) fn write(
    table: &Table,
    to: &Output,
    json: impl FnOnce() -> String,
) -> anyhow::Result<()> {
    let text = match to.format {
        Format::Text => match width(to) {
            Some(width) => table.text_within(width),
            None => table.text(),
        },
        Format::Json => json(),
        Format::Csv => table.csv(),
        Format::Md => table.markdown(),
        Format::Tex => table.latex(Layout::Float),
    };
    output::write_as(to.format, to.path.as_deref(), |out| {
        out.write_all(text.as_bytes())
    })
}
