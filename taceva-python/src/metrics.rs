//! Exact sums over arrays.

use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use taceva_core::{Batch, Channel, Channels, Column, Field, FieldSet, Unit};
use taceva_metrics::{Evaluator, MetricPlan, State, catalogue};
use taceva_study::{EvaluationReport, with_skill};

use crate::arrays::{Points, Table};
use crate::errors::value_error;

/// Rows that are taken in at once: their columns stay in the fastest cache, and are used again.
const BLOCK_ROWS: usize = 4096;

/// The unit of one of the six channels, or `None` of another.
#[pyfunction]
pub(crate) fn unit_of(channel: &str) -> Option<&'static str> {
    let known = Channel::SIX
        .into_iter()
        .find(|known| known.name() == channel);
    known.map(|channel| channel.unit().symbol())
}

/// Streams pairs of truth and prediction into sums that do not depend on their order.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct Sums {
    evaluator: Mutex<Evaluator>,
    plan: MetricPlan,
}

impl Sums {
    fn evaluator(&self) -> MutexGuard<'_, Evaluator> {
        self.evaluator
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    fn states(&self) -> PyResult<Vec<State>> {
        self.evaluator().states().map_err(value_error)
    }
}

#[pymethods]
impl Sums {
    /// Sums of `channels` with their units, for metrics and groups, and for the skill, without which no score claims anything; `is_independent` makes every sample a cluster of its own.
    #[new]
    fn new(
        channels: Vec<(String, String)>,
        metrics: Vec<String>,
        is_independent: bool,
    ) -> PyResult<Sums> {
        let channels = channels_of(&channels)?;
        let wanted = catalogue::select(metrics.iter().map(String::as_str)).map_err(value_error)?;
        let plan = MetricPlan::new(
            &with_skill(wanted),
            channels,
            FieldSet::PAIRS.with(Field::Point),
        );
        let plan = match is_independent {
            true => plan.independent_samples(),
            false => plan,
        };
        Ok(Sums {
            evaluator: Mutex::new(Evaluator::new(&plan)),
            plan,
        })
    }

    /// Takes in rows; nothing is taken in where any of them is refused.
    fn update(
        &self,
        py: Python<'_>,
        truth: &Bound<'_, PyAny>,
        prediction: &Bound<'_, PyAny>,
        points: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<usize> {
        let width = self.plan.channels().len();
        let truth = Table::of(truth, "truth", width)?;
        let prediction = Table::of(prediction, "prediction", width)?;
        let points = points.map(Points::of).transpose()?;
        let rows = truth.rows();
        for (name, found) in [
            ("prediction", Some(prediction.rows())),
            ("points", points.as_ref().map(Points::rows)),
        ] {
            if let Some(found) = found.filter(|found| *found != rows) {
                return Err(value_error(format_args!(
                    "{name} has {found} rows, truth has {rows}"
                )));
            }
        }
        let column = || Vec::with_capacity(BLOCK_ROWS.min(rows));
        let columns = || (0..width).map(|_| column()).collect::<Vec<_>>();
        for first in (0..rows).step_by(BLOCK_ROWS) {
            let block = first..rows.min(first + BLOCK_ROWS);
            let (mut truths, mut predictions) = (columns(), columns());
            truth.read(py, block.clone(), &mut truths);
            prediction.read(py, block.clone(), &mut predictions);
            let labels = points.as_ref().map(|points| points.read(py, block));
            let full = |columns: Vec<Vec<f64>>| columns.into_iter().map(Column::full).collect();
            let channels = self.plan.channels().clone();
            let done = py.detach(|| {
                let batch = Batch::from_columns(channels, full(truths), full(predictions), labels);
                self.evaluator().update(&batch)
            });
            done.map_err(value_error)?;
        }
        Ok(rows)
    }

    /// Takes over what another has seen.
    fn merge(&self, py: Python<'_>, other: &Sums) -> PyResult<()> {
        let states = other.states()?;
        py.detach(|| self.evaluator().merge_states(&states))
            .map_err(value_error)
    }

    /// All that was seen, as bytes.
    fn states_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = serde_json::to_vec(&self.states()?).map_err(value_error)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Takes over what `states_bytes` gave.
    fn merge_bytes(&self, bytes: &[u8]) -> PyResult<()> {
        let states: Vec<State> = serde_json::from_slice(bytes)
            .map_err(|error| value_error(format_args!("no state of taceva's metrics: {error}")))?;
        self.evaluator().merge_states(&states).map_err(value_error)
    }

    /// Forgets all that was seen.
    fn reset(&self) {
        *self.evaluator() = Evaluator::new(&self.plan);
    }

    /// The scores so far, as the text of a results file.
    fn compute(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| {
            let evaluation = self.evaluator().score().map_err(value_error)?;
            crate::results::sealed(&EvaluationReport::of_arrays(evaluation))
        })
    }
}

/// Channels by name and unit.
pub(crate) fn channels_of(channels: &[(String, String)]) -> PyResult<Channels> {
    let channels = channels.iter().map(|(name, unit)| channel(name, unit));
    Channels::new(channels.collect::<PyResult<Vec<_>>>()?).map_err(value_error)
}

/// The channel `name` in `unit`, which for the six is theirs.
fn channel(name: &str, unit: &str) -> PyResult<Channel> {
    let unit = Unit::from_symbol(unit).ok_or_else(|| {
        let known: Vec<&str> = Unit::ALL.iter().map(|unit| unit.symbol()).collect();
        value_error(format_args!(
            "channel {name}: unit {unit:?}, expected one of {}",
            known.join(", ")
        ))
    })?;
    match Channel::SIX.iter().find(|known| known.name() == name) {
        Some(known) if known.unit() == unit => Ok(known.clone()),
        Some(known) => Err(value_error(format_args!(
            "channel {name} is in {}, found {unit}: convert it first",
            known.unit()
        ))),
        None => Channel::named(name, unit).map_err(value_error),
    }
}
