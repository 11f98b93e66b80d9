//! Benchmark of whole studies on the simulated bench: processor time, and the widths and coverage of the intervals of errors.

use std::path::Path;

use serde::Serialize;
use taceva_acquire::{AcquireError, PlannedScene, Workshop};
use taceva_core::{Progress, Unit};
use taceva_results::{EvaluationReport, Interval};

use super::models::{cpu_s, unfitted};
use super::study_coverage::StudyCoverage;
use super::study_grid::{StudyEntry, StudyVariant};
use super::{BENCH_SCHEMA, Machine};
use crate::error::StudyError;
use crate::run::{Existing, RunFolder, RunSetup, acquire_scene, run_scene};

/// Metric by which studies are compared.
const METRIC: &str = "mae";
/// Channels, and planes of two channels, that a benchmark of studies scores.
pub const STUDY_CHANNELS: [&str; 4] = ["Pz", "Fz", "Pxy", "Fxy"];

/// Whole studies with their times and errors, with the schema [`BENCH_SCHEMA`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudyBench {
    /// Always [`BENCH_SCHEMA`].
    pub schema: &'static str,
    /// Always `study`.
    pub subject: &'static str,
    /// Machine that ran the benchmark.
    pub machine: Machine,
    /// Name of the benchmarked scene.
    pub scene: String,
    /// Name of the benchmarked study.
    pub study: String,
    /// Seed of all random draws of the first repetition; each further repetition has the next seed.
    pub seed: u64,
    /// Number of repetitions of each combination, with one seed each.
    pub seeds: u32,
    /// Rows, one for each combination of points, folds and model, in the order of the entries.
    pub rows: Vec<StudyTrial>,
}

/// Times and errors of one combination, over its repetitions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudyTrial {
    /// Number of points, number of folds, and model.
    #[serde(flatten)]
    pub variant: StudyVariant,
    /// Processor time of this process for the presses, in s, as a mean over repetitions. `None` if the system does not report processor time.
    pub press_cpu_s: Option<f64>,
    /// Processor time of this process for fits, predictions and scores, in s, as a mean over repetitions. `None` if the system does not report it.
    pub assess_cpu_s: Option<f64>,
    /// Greatest number of clusters behind an interval of the first repetition, at most 64; `None` without intervals.
    pub clusters: Option<usize>,
    /// Mean absolute error of each channel or plane in the first repetition; empty if the model could not be fitted.
    pub errors: Vec<StudyChannel>,
    /// Mean of [`StudyChannel::width`] over all channels and repetitions; `None` if a width is missing.
    pub mean_width: Option<f64>,
    /// True if no other row has both less processor time and a lower mean width. False without time or width.
    pub pareto: bool,
    /// Reason why the model could not be fitted or scored; `None` if it was scored.
    pub failed: Option<String>,
}

/// Mean absolute error of a study on one channel or plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudyChannel {
    /// Name of the channel or plane.
    pub channel: String,
    /// Unit of the mean absolute error and its interval.
    pub unit: Unit,
    /// Mean absolute error.
    pub mae: f64,
    /// 95 % interval of the mean absolute error, with contact points as clusters; `None` if there are too few points.
    pub ci95: Option<[f64; 2]>,
    /// Logarithmic width of the interval: ln(upper end / lower end). `None` without an interval, or if the lower end is 0.
    pub width: Option<f64>,
    /// Number of scored samples.
    pub n: u64,
    /// Coverage of the intervals of all repetitions; `None` for a single repetition, or without intervals.
    pub coverage: Option<StudyCoverage>,
}

impl StudyBench {
    /// Formats the benchmark as JSON with the schema [`BENCH_SCHEMA`].
    pub fn json(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("texts and finite numbers are JSON");
        text + "\n"
    }
}

impl StudyTrial {
    /// Processor time of the whole study, in s, as a mean over repetitions; `None` if the system does not report it.
    pub fn cpu_s(&self) -> Option<f64> {
        Some(self.press_cpu_s? + self.assess_cpu_s?)
    }

    /// Error of the channel or plane `channel`; `None` if it is not scored.
    pub fn error(&self, channel: &str) -> Option<&StudyChannel> {
        self.errors.iter().find(|error| error.channel == channel)
    }

    /// True if `other` has both less processor time and a lower mean width.
    fn is_beaten_by(&self, other: &StudyTrial) -> bool {
        let less = |own: Option<f64>, other: Option<f64>| {
            own.zip(other).is_some_and(|(own, other)| other < own)
        };
        less(self.cpu_s(), other.cpu_s()) && less(self.mean_width, other.mean_width)
    }
}

/// Runs the study of each of `entries` with each of its seeds, without a cache. The scene of a seed is planned immediately before its presses. Each
/// run replaces the previous run in the folder `folder`.
///
/// A model that cannot be fitted becomes a row with the reason.
///
/// # Errors
/// [`StudyError`] as [`run_scene`], and if there are no entries.
pub fn studies(
    entries: &[StudyEntry],
    folder: &Path,
    machine: Machine,
    setup: RunSetup<'_>,
) -> Result<StudyBench, StudyError> {
    let Some(first) = entries.first() else {
        let empty = "no study to compare: name points, folds and models".to_owned();
        return Err(AcquireError::Request(empty).into());
    };
    let progress = setup.workshop.progress;
    let whole = WholeStudies(progress);
    let setup = RunSetup {
        workshop: Workshop {
            progress: &whole,
            ..setup.workshop
        },
        cache: None,
        ..setup
    };
    let steps = entries
        .iter()
        .map(|entry| entry.variant.steps() * u64::from(entry.seeds.get()));
    progress.begin("points fitted", Some(steps.sum()));
    let mut rows = Vec::with_capacity(entries.len());
    for entry in entries {
        let mut repetitions = Vec::new();
        for further in 0..entry.seeds.get() {
            let scene = entry.repeated(further, setup)?;
            repetitions.push(repetition(&scene, folder, setup)?);
            progress.advance(entry.variant.steps());
        }
        rows.push(trial(entry.variant.clone(), repetitions));
    }
    progress.end();
    mark(&mut rows);
    let scene = &first.scene;
    Ok(StudyBench {
        schema: BENCH_SCHEMA,
        subject: "study",
        machine,
        scene: scene.scene.name.clone(),
        study: scene.studies[0].plan.name.clone(),
        seed: scene.scene.seed,
        seeds: first.seeds.get(),
        rows,
    })
}

/// Progress display that hides the stages of a study, so that only the steps of the benchmark are shown.
struct WholeStudies<'a>(&'a dyn Progress);

impl Progress for WholeStudies<'_> {
    fn is_cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

/// Times and errors of one repetition of a study.
struct Repetition {
    press_cpu_s: Option<f64>,
    assess_cpu_s: Option<f64>,
    clusters: Option<usize>,
    errors: Vec<StudyChannel>,
    failed: Option<String>,
}

fn repetition(
    scene: &PlannedScene,
    folder: &Path,
    setup: RunSetup<'_>,
) -> Result<Repetition, StudyError> {
    let run = RunFolder::open(folder, scene, Existing::Replace)?;
    let (acquired, press_cpu_s) = cpu_s(|| acquire_scene(scene, &run, setup));
    drop(acquired?);
    // Finds the finished recording.
    let (finished, assess_cpu_s) = cpu_s(|| run_scene(scene, &run, setup));
    let (report, failed) = match finished {
        Ok(studies) => (studies.into_iter().next().map(|study| study.report), None),
        Err(StudyError::Evaluate(error)) => (None, unfitted(Err(error))?),
        Err(error) => return Err(error),
    };
    Ok(Repetition {
        press_cpu_s,
        assess_cpu_s,
        clusters: report.as_ref().and_then(clusters),
        errors: report.as_ref().map_or_else(Vec::new, errors_of),
        failed,
    })
}

/// Row for the `repetitions` of one study, of which there must be at least one.
fn trial(variant: StudyVariant, mut repetitions: Vec<Repetition>) -> StudyTrial {
    let mut failures = repetitions.iter_mut();
    let failed = failures.find_map(|one| one.failed.take());
    let press_cpu_s = mean(repetitions.iter().map(|one| one.press_cpu_s));
    let assess_cpu_s = mean(repetitions.iter().map(|one| one.assess_cpu_s));
    let errors = repetitions.iter().flat_map(|one| &one.errors);
    let mean_width = mean(errors.map(|error| error.width));
    let coverages = STUDY_CHANNELS.map(|channel| coverage(&repetitions, channel));
    let first = repetitions.swap_remove(0);
    let mut errors = first.errors;
    for error in &mut errors {
        let at = STUDY_CHANNELS
            .iter()
            .position(|name| *name == error.channel);
        error.coverage = at.and_then(|at| coverages[at]);
    }
    StudyTrial {
        variant,
        press_cpu_s,
        assess_cpu_s,
        clusters: first.clusters,
        errors,
        mean_width,
        pareto: false,
        failed,
    }
}

/// Mean of `values`; `None` if there are no values, or if a value is `None`.
fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let values: Option<Vec<f64>> = values.collect();
    let values = values.filter(|values| !values.is_empty())?;
    Some(values.iter().sum::<f64>() / values.len() as f64)
}

/// Coverage of the intervals of `channel` in all repetitions; `None` if it is unknown.
fn coverage(repetitions: &[Repetition], channel: &str) -> Option<StudyCoverage> {
    let errors = repetitions.iter().flat_map(|one| &one.errors);
    let errors = errors.filter(|error| error.channel == channel);
    let errors: Vec<_> = errors.map(|error| (error.mae, error.ci95)).collect();
    StudyCoverage::of(&errors)
}

/// Mean absolute errors of the channels and planes that `report` scores.
fn errors_of(report: &EvaluationReport) -> Vec<StudyChannel> {
    let error = |channel: &str| {
        let score = report.score(METRIC, channel)?;
        let ci95 = score.interval.as_ref().and_then(Interval::ends);
        Some(StudyChannel {
            channel: channel.to_owned(),
            unit: score.unit,
            mae: score.value.number()?,
            ci95,
            width: ci95.and_then(width),
            n: score.n,
            coverage: None,
        })
    };
    STUDY_CHANNELS.into_iter().filter_map(error).collect()
}

/// Greatest number of clusters behind an interval of `report`; `None` without intervals.
fn clusters(report: &EvaluationReport) -> Option<usize> {
    let clusters = |channel: &str| {
        let score = report.score(METRIC, channel)?;
        score.interval.as_ref()?.clusters()
    };
    STUDY_CHANNELS.into_iter().filter_map(clusters).max()
}

/// Logarithmic width of the interval from `low` to `high`; `None` if `low` is 0 or `high` infinite.
fn width([low, high]: [f64; 2]) -> Option<f64> {
    (low > 0.0 && high.is_finite()).then(|| (high / low).ln())
}

/// Marks the rows on the Pareto front: no other row has both less processor time and a lower mean width.
fn mark(rows: &mut [StudyTrial]) {
    let is_on_front = |own: &StudyTrial| {
        let is_known = own.cpu_s().is_some() && own.mean_width.is_some();
        is_known && !rows.iter().any(|other| own.is_beaten_by(other))
    };
    let marks: Vec<bool> = rows.iter().map(is_on_front).collect();
    for (row, mark) in rows.iter_mut().zip(marks) {
        row.pareto = mark;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cpu_s: Option<f64>, mean_width: Option<f64>) -> StudyTrial {
        StudyTrial {
            variant: StudyVariant {
                points: 80,
                folds: None,
                model: "ridge".to_owned(),
            },
            press_cpu_s: Some(0.0),
            assess_cpu_s: cpu_s,
            clusters: None,
            errors: Vec::new(),
            mean_width,
            pareto: false,
            failed: None,
        }
    }

    #[test]
    fn a_study_is_on_the_front_unless_another_is_faster_and_narrower() {
        let mut rows = [
            row(Some(1.0), Some(0.5)),
            row(Some(2.0), Some(0.3)),
            row(Some(3.0), Some(0.4)),
            // As wide as a faster study, which is therefore not narrower.
            row(Some(4.0), Some(0.3)),
            row(None, Some(0.1)),
            row(Some(0.5), None),
        ];
        mark(&mut rows);
        let marks = rows.map(|row| row.pareto);
        assert_eq!(marks, [true, true, false, true, false, false]);
    }

    #[test]
    fn an_interval_that_reaches_zero_has_no_width() {
        assert_eq!(width([0.0, 1.0]), None);
        assert_eq!(width([2.0, 2.0]), Some(0.0));
    }
}
