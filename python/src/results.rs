//! Results files: sealed text, tables of them, comparisons.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use serde::Serialize;
use taceva_files::seal::Version;
use taceva_report::{CompareRequest, Layout, ScoreTable, Study, Table, compare};

use crate::errors::value_error;

/// `report` as the text of a results file: what the program writes with `--format json`.
pub(crate) fn sealed(report: &impl Serialize) -> PyResult<String> {
    let text = serde_json::to_string_pretty(report).map_err(value_error)?;
    let sealed = taceva_files::seal::json::seal(&text).map_err(value_error)?;
    Ok(sealed + "\n")
}

/// Refuses a results file that was changed after it was written.
#[pyfunction]
pub(crate) fn check_seal(text: &str) -> PyResult<()> {
    let checked = taceva_files::seal::json::check(text, Version::BeforeSeals);
    checked.map(drop).map_err(value_error)
}

/// A table of the scores of some results, `texts` of results files: `text`, `csv`, `md`, `tex` or `html`.
#[pyfunction]
pub(crate) fn score_table(texts: Vec<String>, form: &str) -> PyResult<String> {
    let scores = ScoreTable::of(&studies(&texts)?);
    match form {
        "csv" => Ok(scores.every_number().csv()),
        "tex" => Ok(scores.headlines().for_papers("Scores").latex(Layout::Float)),
        form => rendered(&scores.headlines().for_pages(), form),
    }
}

/// A figure as a file of SVG, with what a reader must know.
#[derive(IntoPyObject)]
pub(crate) struct Drawn {
    name: String,
    title: String,
    caption: String,
    description: String,
    svg: String,
}

/// Every figure that `texts` of results files have something to draw of, in the order of reports.
#[pyfunction]
pub(crate) fn figures(texts: Vec<String>) -> PyResult<Vec<Drawn>> {
    let figures = taceva_report::figures(&studies(&texts)?).into_iter();
    let drawn = figures.map(|figure| Drawn {
        svg: figure.svg(),
        name: figure.id,
        title: figure.title,
        caption: figure.caption,
        description: figure.description,
    });
    Ok(drawn.collect())
}

/// The figure called `name` as a file of PDF.
#[pyfunction]
pub(crate) fn figure_pdf(texts: Vec<String>, name: &str) -> PyResult<Vec<u8>> {
    let figures = taceva_report::figures(&studies(&texts)?);
    let figure = figures.iter().find(|figure| figure.id == name);
    let figure = figure.ok_or_else(|| value_error(format_args!("no figure {name:?}")))?;
    Ok(figure.pdf())
}

/// The comparison of two or more results: `json` besides the forms of `score_table`.
#[pyfunction]
pub(crate) fn comparison(
    texts: Vec<String>,
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
    let compared = compare(&studies(&texts)?, &request);
    match form {
        "json" => Ok(compared.json()),
        "text" => Ok(compared.text()),
        form => rendered(&compared.table(), form),
    }
}

fn studies(texts: &[String]) -> PyResult<Vec<Study>> {
    let mut all = Vec::new();
    for text in texts {
        all.extend(Study::read(text).map_err(value_error)?);
    }
    Ok(all)
}

fn rendered(table: &Table, form: &str) -> PyResult<String> {
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
