//! One file a command: resolve what was typed, call, render.

pub(crate) mod accept;
pub(crate) mod bench;
pub(crate) mod cache;
pub(crate) mod catalogue;
pub(crate) mod check;
pub(crate) mod choose;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod devices;
pub(crate) mod doctor;
mod effort;
pub(crate) mod evaluate;
pub(crate) mod fit;
pub(crate) mod import;
pub(crate) mod merge;
pub(crate) mod plan;
pub(crate) mod plugin;
mod plugins;
pub(crate) mod predict;
pub(crate) mod reseal;
mod results;
pub(crate) mod run;
mod scene;
pub(crate) mod score;

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_dataset::Dataset;
use taceva_models::{Models, Settings};
use taceva_study::{Cache, DataPart, EvaluationReport, FitRequest, Plan, StudyError, Work};

use crate::args::{Everywhere, PartArg, PluginArgs, SettingArgs, SplitArgs};
use crate::exit;
use crate::progress::Terminal;
use crate::{output, report, stderr};

/// What every command works with.
pub(crate) struct Context {
    pub(crate) progress: Terminal,
    pub(crate) jobs: NonZeroUsize,
    verbose: bool,
    quiet: bool,
    plugins: PluginArgs,
}

impl Context {
    pub(crate) fn new(everywhere: &Everywhere) -> Context {
        let all_cores = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let asked = everywhere
            .jobs
            .and_then(|jobs| NonZeroUsize::new(usize::from(jobs)));
        Context {
            progress: Terminal::new(everywhere.quiet),
            jobs: asked.unwrap_or_else(all_cores),
            verbose: everywhere.verbose > 0,
            quiet: everywhere.quiet,
            plugins: everywhere.plugins.clone(),
        }
    }

    /// With what a stage is carried out.
    pub(crate) fn work<'a>(&'a self, cache: Option<&'a Cache>) -> Work<'a> {
        Work {
            jobs: self.jobs,
            progress: &self.progress,
            cache,
        }
    }

    /// Says where results will be, unless nothing is to be said.
    pub(crate) fn say(&self, words: std::fmt::Arguments<'_>) {
        if !self.quiet {
            stderr::say(words);
        }
    }

    /// With `-v`, says what was done.
    pub(crate) fn say_more(&self, words: std::fmt::Arguments<'_>) {
        if self.verbose {
            self.say(words);
        }
    }

    /// With `-v`, says what is going to be done.
    pub(crate) fn tell(
        &self,
        plan: impl FnOnce() -> Result<Plan, StudyError>,
    ) -> anyhow::Result<()> {
        if self.verbose {
            stderr::write(&plan()?.to_string());
        }
        Ok(())
    }
}

/// Arguments that parse and cannot be meant.
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

/// Refuses an instruction set that TACEVA_ISA asks for and that is not there: its figures would be another one's.
pub(crate) fn check_isa() -> anyhow::Result<()> {
    match taceva_metrics::Isa::requested() {
        Ok(_) => Ok(()),
        Err(error) => Err(Usage::error(format!("TACEVA_ISA: {error}"))),
    }
}

pub(crate) fn open(path: &Path) -> anyhow::Result<Dataset> {
    Ok(Dataset::open(path)?)
}

/// What is written beside the scores of an evaluation, where it is asked for.
struct Beside<'a> {
    html: Option<&'a Path>,
    figures: Option<&'a Path>,
    samples: Option<&'a Path>,
}

impl Beside<'_> {
    fn is_wanted(&self) -> bool {
        self.html.is_some() || self.figures.is_some() || self.samples.is_some()
    }

    fn write(&self, written: &EvaluationReport, context: &Context) -> anyhow::Result<()> {
        if self.html.is_some() || self.figures.is_some() {
            let title = format!("{}: how well it measures", written.subject.sensor);
            let page = report::page::Page::of(&title, std::slice::from_ref(written))?;
            if let Some(path) = self.html {
                output::write(Some(path), |out| page.write(out))?;
            }
            if let Some(folder) = self.figures {
                page.write_figures(folder, context)?;
            }
        }
        if let (Some(path), Some(samples)) = (self.samples, &written.samples) {
            output::write(Some(path), |out| {
                samples.write(out, taceva_report::escape_csv)
            })?;
        }
        Ok(())
    }
}

/// Notes in a result the digest of the table of its samples, so that whoever reads both knows that they belong together.
fn note_samples(written: &mut EvaluationReport) -> anyhow::Result<()> {
    if let Some(samples) = &written.samples {
        let mut table = Vec::new();
        samples.write(&mut table, taceva_report::escape_csv)?;
        written.provenance.samples_table = Some(taceva_seal::digest_of_bytes(&table));
    }
    Ok(())
}

/// The fit that was asked for.
pub(crate) fn fit_request(
    name: &str,
    settings: &SettingArgs,
    split: &SplitArgs,
    models: &Models,
) -> anyhow::Result<FitRequest> {
    let words = settings.set.iter().map(String::as_str);
    Ok(FitRequest {
        model: models.find(name).map_err(StudyError::from)?,
        settings: Settings::parse(words).map_err(StudyError::from)?,
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
