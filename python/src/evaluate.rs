//! Evaluations by the pipeline of the program, for tables of predictions and for models by name or file.

use std::path::PathBuf;

use pyo3::prelude::*;
use taceva_evaluate::{
    DataPart, EvaluateError, EvaluateRequest, FitRequest, ModelChoice, RowKey, ScoreRequest,
    Scoring, Work,
};
use taceva_models::{ModelSettings, Models};

use crate::dataset::{Recording, jobs_of, models};
use crate::errors::{ModelError, study_error, value_error};
use crate::inventory::host;
use crate::{results, worker};

/// Scores a table of predictions against a table of truth. Returns the results file of `taceva score`, and the table of samples if they are kept.
#[pyfunction]
#[pyo3(signature = (truth, prediction, metrics, sensor, key, allow_invalid, jobs, bar = None))]
#[expect(clippy::too_many_arguments, reason = "the Python side names them")]
pub(crate) fn score_tables(
    py: Python<'_>,
    truth: PathBuf,
    prediction: PathBuf,
    metrics: Vec<String>,
    sensor: Option<PathBuf>,
    key: Option<&str>,
    allow_invalid: bool,
    jobs: usize,
    bar: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Option<String>)> {
    let request = ScoreRequest {
        truth,
        prediction,
        units: Vec::new(),
        periods: Vec::new(),
        key: key.map(RowKey::from),
        is_independent: false,
        sensor,
        metrics,
        allow_invalid,
        jobs: jobs_of(jobs),
    };
    let scored = worker::run(py, bar, |progress| -> Result<_, EvaluateError> {
        let scoring = Scoring::read(request)?;
        let mut report = scoring.run(progress)?.report;
        let rows = report.scores.iter().map(|score| score.n + score.n_invalid);
        let rows = rows.max().and_then(|rows| usize::try_from(rows).ok());
        if rows.is_some_and(results::keeps_samples) {
            report.samples = Some(scoring.samples()?);
        }
        Ok(report)
    })?;
    results::sealed_with_samples(&scored.map_err(|error| study_error(&error))?)
}

/// Results file of a model on a recording, with the content that `taceva evaluate` writes, and the table of its samples if they are kept. `model`
/// is a name, or the file of a fitted model.
#[pyfunction]
#[pyo3(signature = (recording, model, settings, channels, split, seed, part, metrics, jobs, bar = None))]
#[expect(clippy::too_many_arguments, reason = "the Python side names them")]
pub(crate) fn evaluate_named(
    py: Python<'_>,
    recording: &Recording,
    model: String,
    settings: Vec<String>,
    channels: Vec<String>,
    split: Option<String>,
    seed: u64,
    part: Option<&str>,
    metrics: Vec<String>,
    jobs: usize,
    bar: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Option<String>)> {
    let part = part.map(part_of).transpose()?;
    let mut known = models();
    let path = PathBuf::from(&model);
    let open = |known: &Models| {
        let opened = py.detach(|| known.open(&path));
        opened.map_err(|error| ModelError::new_err(error.to_string()))
    };
    // The name of an existing file is a path; any other is a model name. Only a model name or a foreign file needs the plugins.
    let fitted = match path.is_file() {
        true => match open(&known) {
            Ok(fitted) => Some(fitted),
            Err(_) => {
                known = known.with(host(py)?.models());
                Some(open(&known)?)
            }
        },
        false => {
            if model.contains('/') && known.find(&model).is_err() {
                known = known.with(host(py)?.models());
            }
            None
        }
    };
    let work = move |progress: &dyn taceva_core::Progress| {
        let model = match fitted {
            Some(fitted) => ModelChoice::Fitted(Box::new(fitted)),
            None => {
                let given = ModelSettings::parse(settings.iter().map(String::as_str))?;
                let (model, settings) = known.asked(&model, given)?;
                ModelChoice::Fit(FitRequest {
                    model,
                    settings,
                    channels,
                    split,
                    seed,
                })
            }
        };
        let request = EvaluateRequest {
            model,
            metrics,
            part,
            sensor: None,
            is_independent: false,
        };
        let work = Work {
            jobs: jobs_of(jobs),
            progress,
            cache: None,
        };
        taceva_evaluate::evaluate(&recording.dataset, &request, work)
    };
    let evaluated: Result<_, EvaluateError> = worker::run(py, bar, work)?;
    results::sealed_with_samples(&evaluated.map_err(|error| study_error(&error))?.report)
}

/// Part of a dataset called `name`, such as `test`.
pub(crate) fn part_of(name: &str) -> PyResult<DataPart> {
    let all = [
        DataPart::Train,
        DataPart::Validation,
        DataPart::Test,
        DataPart::All,
    ];
    let named = all.into_iter().find(|part| part.name() == name);
    named.ok_or_else(|| {
        value_error(format_args!(
            "part {name:?}: expected train, validation, test or all"
        ))
    })
}
