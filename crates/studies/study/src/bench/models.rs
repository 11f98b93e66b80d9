//! Race of models on one recording: times of the fit, of predictions and of a single prediction, and the errors.

use std::num::NonZeroUsize;
use std::time::Instant;

use taceva_core::{ErrorKind, Features, Input, Progress, Unit};
use taceva_dataset::{Dataset, Pass};
use taceva_metrics::ClusterSums;
use taceva_models::Model;
use taceva_results::Interval;

use super::front;
use super::paired_errors::absolute_errors;
use super::stopwatch::process_time;
use taceva_evaluate::EvaluateError;
use taceva_evaluate::Work;
use taceva_evaluate::{Behind, EvaluateRequest, ModelChoice, score};
use taceva_evaluate::{DataPart, Divided};
use taceva_evaluate::{FitRequest, fit};
use taceva_evaluate::{Predicted, Target, model_extractor, predict_target};

/// Metric by which models are compared.
const METRIC: &str = "mae";
/// Number of frames that are predicted one by one, to measure latency.
const SINGLES: usize = 50;

/// Cost and error of one model.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelTrial {
    /// Name of the model in the registry of models.
    pub model: String,
    /// Settings of the model as `key=value`; for `auto`, also the chosen model.
    pub settings: Vec<String>,
    /// Wall time of the first fit, including the computation of features, in s.
    pub fit_s: f64,
    /// Least processor time of a fit over all rounds, with the computation of features, in s. `None` if the system does not report it.
    pub fit_cpu_s: Option<f64>,
    /// Wall time to predict the whole test part, including the computation of features, in s.
    pub predict_s: f64,
    /// Median time from a decoded frame to its prediction, in s, over frames that are predicted one by one.
    pub latency_s: f64,
    /// Error of each channel on the test part; empty if the model could not be fitted.
    pub errors: Vec<TrialError>,
    /// Reason why the model could not be fitted or scored; `None` if it was scored.
    pub failed: Option<String>,
}

/// Mean absolute error of a model on one channel, over the test part.
#[derive(Clone, Debug, PartialEq)]
pub struct TrialError {
    /// Name of the channel.
    pub channel: String,
    /// Unit of the mean absolute error and its interval.
    pub unit: Unit,
    /// The mean absolute error.
    pub mae: f64,
    /// 95 % interval of the mean absolute error, with contact points as clusters; `None` if there are too few points.
    pub ci95: Option<[f64; 2]>,
    /// Number of scored samples.
    pub n: u64,
    /// Names of models that beat this model on the channel; empty on the Pareto front. A model beats this one if its fit takes less processor time,
    /// unless this model is shown to be more accurate. That is shown if the 95 % interval of the difference of errors, this minus the other, is below
    /// 0. Errors are paired by contact point.
    pub beaten_by: Vec<String>,
}

impl ModelTrial {
    /// Name of the model with its settings.
    pub(super) fn words(&self) -> String {
        let words = [std::slice::from_ref(&self.model), &self.settings].concat();
        words.join(" ")
    }
}

/// A race of models on one recording.
#[derive(Clone, Copy, Debug)]
pub struct ModelRace<'a> {
    /// Requests, one for each model, all with the same split and seed.
    pub requests: &'a [FitRequest],
    /// Number of fits of each model. Each round fits every model once.
    pub rounds: NonZeroUsize,
}

/// Split of the recording into parts, and the results of all models.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelTrials {
    /// Split, such as `by-point 70/20/10, seed 0`.
    pub split: String,
    /// Number of samples in the training part.
    pub train: usize,
    /// Number of samples in the test part.
    pub test: usize,
    /// One row for each model, in the requested order.
    pub rows: Vec<ModelTrial>,
}

/// Fits and scores every model of `race` on the same split of `dataset`. Further rounds repeat only the fits. The least processor time over all
/// rounds is kept.
///
/// A model that cannot be fitted on this recording becomes a row with the reason.
///
/// # Errors
/// [`EvaluateError`] if a request is invalid, requests differ in split or seed, the dataset cannot be read, or `work` cancels.
pub fn models(
    dataset: &Dataset,
    race: ModelRace<'_>,
    work: Work<'_>,
) -> Result<ModelTrials, EvaluateError> {
    let requests = race.requests;
    let Some(first) = requests.first() else {
        return Err(EvaluateError::Request(
            "no model to compare: name at least one".to_owned(),
        ));
    };
    let same = |request: &FitRequest| (&request.split, request.seed) == (&first.split, first.seed);
    if !requests.iter().all(same) {
        return Err(EvaluateError::Request(
            "all models of a benchmark need the same split and seed".to_owned(),
        ));
    }
    for request in requests {
        // Checked first, so that an unknown setting does not cost the earlier fits.
        request.check()?;
    }
    let divided = Divided::new(dataset, first.split.as_deref(), first.seed)?;
    // No cache, because it would favour later models.
    let work = Work {
        cache: None,
        ..work
    };
    let fits = requests.len() * race.rounds.get();
    work.progress.begin("models raced", Some(fits as u64));
    let mut raced = Vec::with_capacity(requests.len());
    for request in requests {
        raced.push(trial(dataset, request, work)?);
        work.progress.advance(1);
    }
    for _ in 1..race.rounds.get() {
        for (request, (row, _)) in requests.iter().zip(&mut raced) {
            if row.failed.is_none() {
                let (outcome, again) = cpu_s(|| fit(dataset, request, None, work));
                outcome?;
                row.fit_cpu_s = row.fit_cpu_s.zip(again).map(|(one, other)| one.min(other));
            }
            work.progress.advance(1);
        }
    }
    work.progress.end();
    front::mark(&mut raced);
    Ok(ModelTrials {
        split: format!("{}, seed {}", divided.spec, divided.seed),
        train: divided.rows(DataPart::Train).len(),
        test: divided.rows(DataPart::Test).len(),
        rows: raced.into_iter().map(|(row, _)| row).collect(),
    })
}

fn trial(
    dataset: &Dataset,
    request: &FitRequest,
    work: Work<'_>,
) -> Result<front::Raced, EvaluateError> {
    let mut row = ModelTrial {
        model: request.model.name().to_owned(),
        settings: request.settings.words().collect(),
        fit_s: 0.0,
        fit_cpu_s: None,
        predict_s: 0.0,
        latency_s: 0.0,
        errors: Vec::new(),
        failed: None,
    };
    let mut sums = Vec::new();
    let measured = measure(dataset, request, work, &mut row).map(|own| sums = own);
    row.failed = unfitted(measured)?;
    Ok((row, sums))
}

/// Reason why a model could not be fitted or scored; `None` if it was. An error for which the whole race must end is returned as an error.
pub(super) fn unfitted(
    outcome: Result<(), EvaluateError>,
) -> Result<Option<String>, EvaluateError> {
    match outcome {
        Ok(()) => Ok(None),
        Err(EvaluateError::Model(error)) if error.kind() != ErrorKind::Interrupted => {
            Ok(Some(error.to_string()))
        }
        Err(EvaluateError::Features(error)) => Ok(Some(error.to_string())),
        Err(error) => Err(error),
    }
}

fn measure(
    dataset: &Dataset,
    request: &FitRequest,
    work: Work<'_>,
    row: &mut ModelTrial,
) -> Result<Vec<Option<ClusterSums>>, EvaluateError> {
    let raced = Raced::new(dataset, request, work)?;
    (row.fit_s, row.fit_cpu_s) = (raced.fit_s, raced.fit_cpu_s);
    row.predict_s = raced.predict_s;
    let model = &raced.model;
    if model.card().auto.is_some() {
        row.settings.push(format!("took={}", model.card().model));
    }
    row.latency_s = latency(dataset, model, &raced.target, work.progress)?;
    let by_channel = absolute_errors(&raced.predicted);
    row.errors = raced.errors;
    // A channel may have no score.
    let positions = row.errors.iter().map(|error| {
        let channels = raced.predicted.channels();
        channels.position(&error.channel)
    });
    let sums = positions.map(|position| by_channel.get(position?)?.clone());
    Ok(sums.collect())
}

/// Calls `run`, and returns its result and its processor time in s; `None` if the system does not report processor time.
pub(super) fn cpu_s<T>(run: impl FnOnce() -> T) -> (T, Option<f64>) {
    let start = process_time();
    let outcome = run();
    let took = process_time().zip(start);
    (
        outcome,
        took.map(|(end, start)| (end - start).as_secs_f64()),
    )
}

/// A model fitted on the training part and scored on the test part.
pub(super) struct Raced {
    pub(super) model: Model,
    pub(super) target: Target,
    pub(super) predicted: Predicted,
    pub(super) errors: Vec<TrialError>,
    fit_s: f64,
    fit_cpu_s: Option<f64>,
    predict_s: f64,
}

impl Raced {
    pub(super) fn new(
        dataset: &Dataset,
        request: &FitRequest,
        work: Work<'_>,
    ) -> Result<Raced, EvaluateError> {
        let start = Instant::now();
        let (fitted, fit_cpu_s) = cpu_s(|| fit(dataset, request, None, work));
        let fitted = fitted?;
        let fit_s = start.elapsed().as_secs_f64();
        let model = fitted.model;
        let target = Target::of(dataset, Some(fitted.divided), None, model.reads_features())?;
        let start = Instant::now();
        let predicted = predict_target(dataset, &model, &target, work)?;
        let predict_s = start.elapsed().as_secs_f64();
        let asked = EvaluateRequest {
            model: ModelChoice::Fit(request.clone()),
            metrics: vec![METRIC.to_owned()],
            part: None,
            is_independent: false,
            sensor: None,
        };
        let behind = Behind::of(&model)?;
        let scored = score(
            dataset,
            asked.asked(),
            behind,
            &target,
            &predicted,
            work.jobs,
        )?;
        let report = &scored.report;
        let errors = model.channels().iter().filter_map(|channel| {
            let score = report.score(METRIC, channel.name())?;
            Some(TrialError {
                channel: channel.name().to_owned(),
                unit: score.unit,
                mae: score.value.number()?,
                ci95: score.interval.as_ref().and_then(Interval::ends),
                n: score.n,
                beaten_by: Vec::new(),
            })
        });
        Ok(Raced {
            errors: errors.collect(),
            model,
            target,
            predicted,
            fit_s,
            fit_cpu_s,
            predict_s,
        })
    }
}

/// Median time from a decoded frame, or from the signals of a sample, to the prediction, in s.
fn latency(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    progress: &dyn Progress,
) -> Result<f64, EvaluateError> {
    let shape = model.card().features.shape();
    let mut times = Vec::new();
    let rows = &target.rows[..target.rows.len().min(SINGLES)];
    if model.reads_features() {
        let extractor = model_extractor(dataset, model)?;
        let predict = |input: Input<'_>| -> Result<f64, EvaluateError> {
            let start = Instant::now();
            let mut sample = vec![0.0; shape.len()];
            extractor.extract(input, &mut sample)?;
            model.predict(&Features::new(shape, sample)?)?;
            Ok(start.elapsed().as_secs_f64())
        };
        if !model.reads_frames() {
            for &row in rows {
                let signals = dataset.signals(row)?;
                let time = signals.map(|signals| predict((&signals).into()));
                times.extend(time.transpose()?);
            }
        } else {
            let pass = Pass::new(rows, NonZeroUsize::MIN, progress);
            dataset.map_frames(
                pass,
                |_, frame| predict((&frame).into()),
                |_, time| {
                    times.push(time?);
                    Ok(())
                },
            )?;
        }
    } else {
        let blank = Features::new(shape, vec![0.0; shape.len()])?;
        for _ in rows {
            let start = Instant::now();
            model.predict(&blank)?;
            times.push(start.elapsed().as_secs_f64());
        }
    }
    times.sort_by(f64::total_cmp);
    Ok(times.get(times.len() / 2).copied().unwrap_or(0.0))
}
