//! Commands, one file each: a command resolves its arguments, calls a library, and renders the result.

pub(crate) mod accept;
mod attachments;
mod attendance;
pub(crate) mod bench;
pub(crate) mod budget;
pub(crate) mod bundle;
pub(crate) mod cache;
pub(crate) mod capture;
pub(crate) mod catalogue;
pub(crate) mod check;
pub(crate) mod choose;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod curve;
mod device_page;
pub(crate) mod devices;
pub(crate) mod doctor;
mod effort;
pub(crate) mod evaluate;
pub(crate) mod export;
pub(crate) mod fit;
pub(crate) mod gauge;
pub(crate) mod import;
pub(crate) mod init;
mod kept_frames;
mod live_predictions;
pub(crate) mod man;
pub(crate) mod merge;
mod operator;
mod origin;
pub(crate) mod plan;
pub(crate) mod plugin;
mod plugin_fault;
mod plugins;
pub(crate) mod predict;
pub(crate) mod preview;
mod quantity;
pub(crate) mod report;
pub(crate) mod reseal;
mod results;
pub(crate) mod rig;
pub(crate) mod run;
mod scene;
pub(crate) mod score;
pub(crate) mod show;
pub(crate) mod stress;
pub(crate) mod sweep;
mod task_scores;
pub(crate) mod watch;
pub(crate) mod wear;
mod widths;

use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::Dataset;
use taceva_evaluate::{DataPart, EvaluateError, FitRequest};
use taceva_models::{Model, ModelSettings, Models};
use taceva_report::{ScoreTable, Study};
use taceva_results::EvaluationReport;

use crate::args::{
    Format, Output, PartArg, START, ScoringArgs, SettingArgs, SplitArgs, TableArgs, TableScores,
    ViewArgs,
};
use crate::{exit, output};

pub(crate) use crate::context::Context;
use attachments::Attachments;

/// Error for arguments that parse but contradict each other.
#[derive(Debug)]
pub(crate) struct Usage(String);

impl Usage {
    pub(crate) fn error(message: impl Into<String>) -> anyhow::Error {
        anyhow::Error::new(Usage(message.into()))
    }

    pub(crate) fn code(&self) -> u8 {
        exit::USAGE
    }
}

impl std::fmt::Display for Usage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// Rejects an instruction set in TACEVA_ISA that this processor lacks, because a measurement would use another set.
pub(crate) fn check_isa() -> anyhow::Result<()> {
    match taceva_metrics::Isa::requested() {
        Ok(_) => Ok(()),
        Err(error) => Err(Usage::error(format!("TACEVA_ISA: {error}"))),
    }
}

/// Executes `taceva` without a command: prints the first commands for a new user.
pub(crate) fn start() -> anyhow::Result<u8> {
    output::write(None, |out| {
        writeln!(
            out,
            "taceva: how well does a vision-based tactile sensor measure?\n\n{START}\n"
        )?;
        writeln!(
            out,
            "taceva --help lists every command; taceva COMMAND --help explains one, with examples."
        )
    })?;
    Ok(exit::DONE)
}

pub(crate) fn open(path: &Path) -> anyhow::Result<Dataset> {
    Ok(Dataset::open(path)?)
}

/// Opens the recordings at `paths` as one joined dataset.
pub(crate) fn open_all(paths: &[PathBuf]) -> anyhow::Result<Dataset> {
    let recordings = paths.iter().map(|path| open(path));
    let recordings = recordings.collect::<anyhow::Result<Vec<_>>>()?;
    Ok(Dataset::joined(recordings)?)
}

/// Opens the recordings with the view of the arguments, otherwise with the view of the model.
pub(crate) fn open_seen(
    paths: &[PathBuf],
    view: &ViewArgs,
    model: Option<&Model>,
) -> anyhow::Result<Dataset> {
    let dataset = open_all(paths)?;
    let of_model = model.and_then(|model| model.card().provenance.view.as_deref());
    // A model of one view may be used on a recording with one picture.
    let of_model = of_model.filter(|_| !dataset.views().is_empty());
    Ok(match view.name.as_deref().or(of_model) {
        Some(view) => dataset.seen(view)?,
        None => dataset,
    })
}

/// Fails before any work if a file of `scoring` or `output` already exists and must not be replaced. Also rejects figure options without `--figures`.
fn check_free(scoring: &ScoringArgs, output: &Output) -> anyhow::Result<()> {
    let files = output.path.iter().chain(&scoring.state_out);
    let files = files.chain(&scoring.page.path).chain(&scoring.samples_out);
    output::check_all_free(files, output.force)?;
    if scoring.figure.is_set() && scoring.figures.is_none() {
        return Err(Usage::error(
            "--figure-width, --figure-font and --figure-size apply to figure files: add --figures FOLDER",
        ));
    }
    Ok(())
}

/// Scores that a table of `format` contains. Fails if `--table` is combined with JSON, which contains every number.
pub(crate) fn table_scores(args: &TableArgs, format: Format) -> anyhow::Result<TableScores> {
    match (args.scores, format) {
        (Some(_), Format::Json) => Err(Usage::error(
            "--table and --format json: JSON has no tables and always contains every number; use --format text, csv, md or tex, or omit --table",
        )),
        (Some(scores), _) => Ok(scores),
        (None, format) => Ok(TableScores::usual(format)),
    }
}

/// Model file and recordings as text: `model m.taceva on monday, tuesday`.
fn applied(model: &Path, datasets: &[PathBuf]) -> String {
    let datasets: Vec<String> = datasets
        .iter()
        .map(|path| shown(path).to_string())
        .collect();
    format!("model {} on {}", shown(&model), datasets.join(", "))
}

/// Prints the requested metrics that the main table omits.
fn say_left_out(
    asked: &[String],
    report: &EvaluationReport,
    format: Format,
    table: TableScores,
    context: &Context,
) {
    if table != TableScores::Main || format == Format::Json {
        return;
    }
    let scores = ScoreTable::of(&[Study::from(report.clone())]);
    let beside = scores.beside_main();
    let left_out = asked.iter().map(String::as_str);
    let left_out: Vec<&str> = left_out.filter(|metric| beside.contains(metric)).collect();
    if !left_out.is_empty() {
        context.say(format_args!(
            "the main table leaves out {}: --table all prints every score",
            left_out.join(", ")
        ));
    }
}

/// Request for the fit that the arguments describe.
pub(crate) fn fit_request(
    name: &str,
    settings: &SettingArgs,
    split: &SplitArgs,
    models: &Models,
) -> anyhow::Result<FitRequest> {
    let words = settings.set.iter().map(String::as_str);
    let given = ModelSettings::parse(words).map_err(EvaluateError::from)?;
    let (model, own) = models.asked(name, given).map_err(EvaluateError::from)?;
    Ok(FitRequest {
        model,
        settings: own,
        channels: settings.channels.clone(),
        split: split.split.clone(),
        seed: split.seed.value,
    })
}

impl From<PartArg> for DataPart {
    fn from(part: PartArg) -> DataPart {
        match part {
            PartArg::Train => DataPart::Train,
            PartArg::Validation => DataPart::Validation,
            PartArg::Test => DataPart::Test,
            PartArg::All => DataPart::All,
        }
    }
}
