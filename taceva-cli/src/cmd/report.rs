//! `taceva report`.

use std::path::{Path, PathBuf};
use taceva_core::shown;
use taceva_results::EvaluationReport;
use taceva_study::RunFolder;

use anyhow::bail;

use super::results::{self, Reports};
use super::{Context, Usage};
use crate::args::{Like, ReportArgs};
use crate::report::page::{PAGE, Page};
use crate::{exit, output, report};

pub(crate) fn run(args: &ReportArgs, context: &Context) -> anyhow::Result<u8> {
    let table = super::table_scores(&args.table, args.format)?;
    let Written { page, reports } = written(args, context)?;
    output::write_as(args.format, None, |out| {
        report::profiles(&reports, args.format, table, out)
    })?;
    context.say(format_args!("look at    {}", shown(&page)));
    Ok(exit::DONE)
}

/// Page of a report, and the results on it.
pub(crate) struct Written {
    /// Path of the page.
    pub(crate) page: PathBuf,
    reports: Vec<EvaluationReport>,
}

/// Writes the page, the figures and the tables of a result.
pub(crate) fn written(args: &ReportArgs, context: &Context) -> anyhow::Result<Written> {
    if !args.result.exists() {
        return Err(Usage::error(format!(
            "{}: no such file or folder; expected the folder of a run, or the JSON of run, evaluate or score",
            shown(&args.result)
        )));
    }
    let folder = folder(args);
    let page = folder.join(PAGE);
    if page.exists() && !args.force {
        bail!(
            "{} exists already; --force replaces the reports there, --out FOLDER writes them elsewhere",
            shown(&page)
        );
    }
    let Reports { reports, missing } = results::reports(&args.result)?;
    for line in missing {
        context.say(format_args!(
            "{line}: figures of samples are left out: write the table with `taceva evaluate … --samples-out NAME.samples.csv`"
        ));
    }
    let scores = reports.iter().flat_map(|report| &report.scores);
    results::check_channels(scores, &args.channels)?;
    let reports = match args.channels.is_empty() {
        true => reports,
        false => of_channels(reports, &args.channels),
    };
    let drawn = Page::of(&title(&args.result, &reports), &reports)?;
    let drawn = drawn.with_faults(results::faults_of(&args.result, reports.len())?);
    std::fs::create_dir_all(&folder)?;
    let page = drawn.write_files(&folder, &args.figure.style(), context)?;
    if let Some(Like::Taceva) = args.like {
        drawn.write_like_taceva(&folder, &args.figure.style(), context)?;
    }
    Ok(Written { page, reports })
}

/// Limits the scores of `reports` to the named channels and planes.
fn of_channels(reports: Vec<EvaluationReport>, channels: &[String]) -> Vec<EvaluationReport> {
    let reports = reports.into_iter();
    reports.map(|report| report.of_channels(channels)).collect()
}

/// Output folder: the requested folder, or the folder of the results.
fn folder(args: &ReportArgs) -> PathBuf {
    let beside = || match args.result.is_dir() {
        true => args.result.clone(),
        false => args
            .result
            .parent()
            .map_or_else(PathBuf::new, Path::to_owned),
    };
    args.folder.clone().unwrap_or_else(beside)
}

/// Title of the page: the name of the scene of a run, of the only sensor, or of the folder or file.
fn title(result: &Path, reports: &[EvaluationReport]) -> String {
    let is_run = result
        .file_name()
        .is_some_and(|name| name == results::RESULTS);
    let folder = result.parent().filter(|_| is_run).unwrap_or(result);
    if let Some(name) = RunFolder::scene_name(folder) {
        return name;
    }
    match reports {
        [one] => format!("{}: how well it measures", one.subject.sensor),
        _ => {
            let meant = result.canonicalize().unwrap_or_else(|_| result.to_owned());
            let named = match meant.file_name() {
                Some(name) if name == results::RESULTS => meant.parent().and_then(Path::file_name),
                name => name,
            };
            named.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
        }
    }
}
