//! Results files: sealed text, score tables, comparisons.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use serde::Serialize;
use taceva_report::{CompareRequest, Figure, Layout, ScoreTable, Study, Table, compare};
use taceva_results::{EvaluationReport, Interval, Samples, Score, Value};

use crate::errors::value_error;

/// Text of `report` as a results file, as written with `--format json`.
pub(crate) fn sealed(report: &impl Serialize) -> PyResult<String> {
    let sealed = taceva_results::sealed(report).map_err(value_error)?;
    Ok(sealed + "\n")
}

/// Greatest number of samples that a result keeps for comparisons in pairs.
const MOST_SAMPLES: usize = 200_000;

/// Results file of `report`, and the table of its samples if they are kept.
pub(crate) fn sealed_with_samples(report: &EvaluationReport) -> PyResult<(String, Option<String>)> {
    let samples = report.samples.as_ref();
    let samples = samples.filter(|samples| samples.rows() <= MOST_SAMPLES);
    let table = samples.map(table_of).transpose()?;
    Ok((sealed(report)?, table))
}

/// True if a result keeps the samples of `rows` rows.
#[pyfunction]
pub(crate) fn keeps_samples(rows: usize) -> bool {
    rows <= MOST_SAMPLES
}

fn table_of(samples: &Samples) -> PyResult<String> {
    let mut table = Vec::new();
    samples.write(&mut table).map_err(value_error)?;
    String::from_utf8(table).map_err(value_error)
}

/// Results of one evaluation for Python.
#[derive(IntoPyObject)]
pub(crate) struct ReadResult {
    source: String,
    notes: Vec<String>,
    skipped: Vec<(String, String)>,
    scores: Vec<ReadScore>,
}

/// One score, as Python receives it.
#[derive(IntoPyObject)]
pub(crate) struct ReadScore {
    metric: String,
    channel: String,
    value: Option<f64>,
    unit: &'static str,
    interval: Option<(f64, f64, String)>,
    n: u64,
    n_invalid: u64,
    reason: Option<String>,
    standing: Option<&'static str>,
    interval_reason: Option<String>,
}

impl From<Score> for ReadScore {
    fn from(score: Score) -> ReadScore {
        let (interval, interval_reason) = match score.interval {
            Some(Interval::Ends { ends, method, .. }) => (Some((ends[0], ends[1], method)), None),
            Some(Interval::Absent(reason)) => (None, Some(reason)),
            None => (None, None),
        };
        ReadScore {
            value: score.value.number(),
            reason: match score.value {
                Value::Undefined(reason) => Some(reason),
                _ => None,
            },
            metric: score.metric,
            channel: score.channel,
            unit: score.unit.symbol(),
            interval,
            n: score.n,
            n_invalid: score.n_invalid,
            standing: score.standing.words(),
            interval_reason,
        }
    }
}

/// Reads the results file of one evaluation; rejects a file that was edited after it was sealed.
#[pyfunction]
pub(crate) fn read_result(text: &str) -> PyResult<ReadResult> {
    let mut reports = taceva_results::read(text).map_err(value_error)?;
    let (Some(report), true) = (reports.pop(), reports.is_empty()) else {
        return Err(value_error("expected the results of one evaluation"));
    };
    let skipped = report.skipped.into_iter();
    Ok(ReadResult {
        source: report.subject.source,
        notes: report.provenance.notes,
        skipped: skipped.map(|skip| (skip.what, skip.reason)).collect(),
        scores: report.scores.into_iter().map(ReadScore::from).collect(),
    })
}

/// Table of the scores in `texts` of results files; `form` is `text`, `csv`, `md`, `tex` or `html`. A note names omitted channels.
#[pyfunction]
pub(crate) fn score_table(texts: Vec<String>, form: &str) -> PyResult<String> {
    let scores = ScoreTable::of(&studies(&texts)?);
    let shown = scores.headlines();
    match form {
        "csv" => Ok(scores.every_number().csv()),
        "tex" => Ok(shown.for_papers(&shown.title()).latex(Layout::Float)),
        form => {
            let mut table = shown.for_pages();
            table.caption = shown.title();
            if let Some(note) = left_out(&scores, &shown) {
                table.note(note);
            }
            rendered(&table, form)
        }
    }
}

/// Sentence that names the channels of `scores` without a row in `shown`, which has scores of planes instead; `None` if there are none.
fn left_out(scores: &ScoreTable, shown: &ScoreTable) -> Option<String> {
    let mut channels: Vec<&str> = Vec::new();
    for row in scores.rows.iter().filter(|row| row.is_headline) {
        let is_shown = shown
            .rows
            .iter()
            .any(|kept| kept.metric == row.metric && kept.channel == row.channel);
        if !is_shown && !channels.contains(&row.channel.as_str()) {
            channels.push(&row.channel);
        }
    }
    (!channels.is_empty()).then(|| {
        format!(
            "Left out, since scores of their planes are shown: {}. All scores: scores(), to_frame().",
            channels.join(", ")
        )
    })
}

/// A figure as an SVG file, with notes for the reader.
#[derive(IntoPyObject)]
pub(crate) struct Drawn {
    name: String,
    title: String,
    caption: String,
    description: String,
    svg: String,
}

/// All figures with data in `texts` of results files, in the order of reports. With `metrics`, figures of a comparison of these metrics come first.
#[pyfunction]
#[pyo3(signature = (texts, metrics=None))]
pub(crate) fn figures(texts: Vec<String>, metrics: Option<Vec<String>>) -> PyResult<Vec<Drawn>> {
    let figures = figures_of(&texts, metrics)?.into_iter();
    let drawn = figures.map(|figure| Drawn {
        svg: figure.svg(),
        name: figure.id,
        title: figure.title,
        caption: figure.caption,
        description: figure.description,
    });
    Ok(drawn.collect())
}

fn figures_of(texts: &[String], metrics: Option<Vec<String>>) -> PyResult<Vec<Figure>> {
    let studies = studies(texts)?;
    let Some(metrics) = metrics else {
        return Ok(taceva_report::figures(&studies));
    };
    let request = CompareRequest {
        metrics,
        ..CompareRequest::default()
    };
    let request = request.resolved(&studies).map_err(value_error)?;
    Ok(compare(&studies, &request).figures(&studies))
}

/// The figure called `name`, among those of [`figures`], as a PDF file.
#[pyfunction]
#[pyo3(signature = (texts, name, metrics=None))]
pub(crate) fn figure_pdf(
    texts: Vec<String>,
    name: &str,
    metrics: Option<Vec<String>>,
) -> PyResult<Vec<u8>> {
    let figures = figures_of(&texts, metrics)?;
    let figure = figures.iter().find(|figure| figure.id == name);
    let figure = figure.ok_or_else(|| value_error(format_args!("no figure {name:?}")))?;
    Ok(figure.pdf())
}

/// Sentence that every output repeats if some samples of these origins were not measured; `None` if all were measured.
#[pyfunction]
pub(crate) fn not_measured(sources: Vec<String>) -> Option<String> {
    taceva_results::not_measured(sources.iter().map(String::as_str))
}

/// Compares two or more results. `samples` has the table of each result's samples, or `None`. `form` is a form of `score_table`, `json`, or `main`
/// for the LaTeX table of the main scores.
#[pyfunction]
pub(crate) fn comparison(
    texts: Vec<String>,
    samples: Vec<Option<String>>,
    metrics: Vec<String>,
    margins: BTreeMap<String, f64>,
    seed: u64,
    form: &str,
) -> PyResult<String> {
    let request = CompareRequest {
        metrics,
        margins,
        seed,
    };
    let mut studies = studies(&texts)?;
    for (study, table) in studies.iter_mut().zip(samples) {
        study.samples = table
            .map(|table| Samples::read(&table).map_err(value_error))
            .transpose()?;
    }
    let request = request.resolved(&studies).map_err(value_error)?;
    let mut compared = compare(&studies, &request);
    compared
        .notes
        .extend(without_samples(&compared.names, &studies));
    match form {
        "main" => {
            let scores = ScoreTable::compared(&studies, &request);
            let tables = scores.for_column(&scores.caption());
            let tables: Vec<String> = tables
                .iter()
                .map(|table| table.latex(Layout::Column))
                .collect();
            Ok(tables.join("\n"))
        }
        "json" => Ok(compared.json()),
        "text" => Ok(compared.text()),
        form => rendered(&compared.table(), form),
    }
}

/// Note on the results whose samples are not known; `None` if the samples of all are known.
fn without_samples(names: &[String], studies: &[Study]) -> Option<String> {
    let absent = names.iter().zip(studies);
    let absent = absent.filter(|(_, study)| study.samples.is_none());
    let absent: Vec<&str> = absent.map(|(name, _)| name.as_str()).collect();
    (!absent.is_empty()).then(|| {
        format!(
            "no samples are kept with {}: compared by the intervals of both, not sample by sample. `score` and `evaluate` keep up to {MOST_SAMPLES} samples. Sums keep none, and files need the table that `save_samples` writes beside them",
            absent.join(", ")
        )
    })
}

fn studies(texts: &[String]) -> PyResult<Vec<Study>> {
    let mut all = Vec::new();
    for text in texts {
        all.extend(Study::read(text).map_err(value_error)?);
    }
    Ok(all)
}

/// Table in `form`: `text`, `csv`, `md`, `tex` or `html`.
pub(crate) fn rendered(table: &Table, form: &str) -> PyResult<String> {
    Ok(match form {
        "text" => table.text(),
        "csv" => table.csv(),
        "md" => table.markdown(),
        "tex" => table.latex(Layout::Float),
        "html" => table.html_fragment(),
        other => {
            return Err(value_error(format_args!(
                "form {other:?}: expected text, csv, md, tex or html"
            )));
        }
    })
}
