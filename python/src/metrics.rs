//! Exact sums over arrays.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use taceva_core::{Batch, Channel, Channels, Column, Field, FieldSet, Unit};
use taceva_evaluate::{Note, PairedBy, with_skill};
use taceva_metrics::{Evaluator, MetricPlan, State, catalogue, plane_axes};
use taceva_results::{EvaluationReport, Score};

use crate::arrays::{Points, Table};
use crate::errors::value_error;

/// Number of rows in a block, whose columns stay in the L1 and L2 caches. Each block looks up the names of points, so smaller blocks cost more.
const BLOCK_ROWS: usize = 4096;

/// Unit of `channel` if it is one of the six contact channels; `None` for any other channel.
#[pyfunction]
pub(crate) fn unit_of(channel: &str) -> Option<&'static str> {
    let known = Channel::SIX
        .into_iter()
        .find(|known| known.name() == channel);
    known.map(|channel| channel.unit().symbol())
}

/// Order of `channels`, given with their units, in sums and recordings: the six contact channels first, then other channels by name.
#[pyfunction]
pub(crate) fn channel_order(channels: Vec<(String, String)>) -> PyResult<Vec<usize>> {
    let ordered = channels_of(&channels)?;
    let position = |channel: &Channel| channels.iter().position(|(name, _)| name == channel.name());
    Ok(ordered.iter().filter_map(position).collect())
}

/// Fields that a row may have in addition to its numbers and its contact point.
const FIELDS: [Field; 7] = [
    Field::Scene,
    Field::UnitId,
    Field::Phase,
    Field::DepthStep,
    Field::Repeat,
    Field::Stamp,
    Field::Intensity,
];

/// Values of one field, one for each row.
enum Said {
    Texts(Points),
    Numbers(Table),
}

impl Said {
    fn of(field: Field, column: &Bound<'_, PyAny>) -> PyResult<Said> {
        Ok(match field {
            Field::Scene | Field::UnitId | Field::Phase => Said::Texts(Points::of(column)?),
            _ => Said::Numbers(Table::of(column, field.name(), 1)?),
        })
    }

    fn rows(&self) -> usize {
        match self {
            Said::Texts(names) => names.rows(),
            Said::Numbers(table) => table.rows(),
        }
    }

    fn put_into(&self, py: Python<'_>, batch: Batch, field: Field, rows: Range<usize>) -> Batch {
        match self {
            Said::Texts(names) => batch.with_labels(field, names.read(py, rows)),
            Said::Numbers(table) => {
                let mut column = [Vec::with_capacity(rows.len())];
                table.read(py, rows, &mut column);
                let [column] = column;
                batch.with_numbers(field, Column::full(column))
            }
        }
    }
}

/// Field called `name`, if arrays may have it.
fn field_of(name: &str) -> PyResult<Field> {
    FIELDS
        .into_iter()
        .find(|field| field.name() == name)
        .ok_or_else(|| {
            let known = FIELDS.map(Field::name).join(", ");
            value_error(format_args!("no field {name:?}: expected one of {known}"))
        })
}

/// Streams pairs of truth and prediction into order-independent sums.
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
    /// Creates empty sums of `channels`, each with its unit, for the given metrics and groups. The skill, which verdicts require, is always included.
    /// `fields` are fields of every row. `periods` gives the period of angles in degrees. With `is_independent`, each sample is its own cluster.
    #[new]
    fn new(
        channels: Vec<(String, String)>,
        metrics: Vec<String>,
        is_independent: bool,
        fields: Vec<String>,
        periods: BTreeMap<String, u16>,
    ) -> PyResult<Sums> {
        let channels = channels_of(&channels)?;
        let with_period = |channel: &Channel| match periods.get(channel.name()) {
            Some(period) => channel.with_period(*period).map_err(value_error),
            None => Ok(*channel),
        };
        let channels: Vec<Channel> = channels.iter().map(with_period).collect::<PyResult<_>>()?;
        let channels = Channels::new(channels).map_err(value_error)?;
        let wanted = catalogue::select(metrics.iter().map(String::as_str)).map_err(value_error)?;
        let mut available = FieldSet::PAIRS.with(Field::Point);
        for name in &fields {
            available = available.with(field_of(name)?);
        }
        let plan = MetricPlan::new(&with_skill(wanted), channels, available);
        let plan = match is_independent {
            true => plan.independent_samples(),
            false => plan,
        };
        Ok(Sums {
            evaluator: Mutex::new(Evaluator::new(&plan)),
            plan,
        })
    }

    /// Adds rows. Without `allows_invalid`, it returns false if a number is not finite. No row is then added, except with `apart`: the sums may then
    /// contain some rows, and the caller must discard the sums.
    #[expect(clippy::too_many_arguments, reason = "what one row carries")]
    fn update(
        &self,
        py: Python<'_>,
        truth: &Bound<'_, PyAny>,
        prediction: &Bound<'_, PyAny>,
        points: Option<&Bound<'_, PyAny>>,
        fields: Vec<(String, Bound<'_, PyAny>)>,
        allows_invalid: bool,
        apart: bool,
    ) -> PyResult<bool> {
        let width = self.plan.channels().len();
        let truth = Table::of(truth, "truth", width)?;
        let prediction = Table::of(prediction, "prediction", width)?;
        let points = points.map(Points::of).transpose()?;
        let said = fields.iter().map(|(name, column)| {
            let field = field_of(name)?;
            Ok((field, Said::of(field, column)?))
        });
        let said: Vec<(Field, Said)> = said.collect::<PyResult<_>>()?;
        let rows = truth.rows();
        let lengths = [
            ("prediction", Some(prediction.rows())),
            ("points", points.as_ref().map(Points::rows)),
        ];
        let lengths = lengths.into_iter().chain(
            said.iter()
                .map(|(field, said)| (field.name(), Some(said.rows()))),
        );
        for (name, found) in lengths {
            if let Some(found) = found.filter(|found| *found != rows) {
                return Err(value_error(format_args!(
                    "{name} has {}, truth has {rows}",
                    taceva_core::counted(found, "row")
                )));
            }
        }
        // Several blocks are checked before any of them is added.
        if !allows_invalid && !apart && rows > BLOCK_ROWS {
            for table in [&truth, &prediction] {
                if !table.is_finite(py) {
                    return Ok(false);
                }
            }
        }
        let column = || Vec::with_capacity(BLOCK_ROWS.min(rows));
        let columns = || (0..width).map(|_| column()).collect::<Vec<_>>();
        for first in (0..rows).step_by(BLOCK_ROWS) {
            let block = first..rows.min(first + BLOCK_ROWS);
            let (mut truths, mut predictions) = (columns(), columns());
            let is_finite = truth.read(py, block.clone(), &mut truths)
                & prediction.read(py, block.clone(), &mut predictions);
            if !is_finite && !allows_invalid {
                return Ok(false);
            }
            let labels = points.as_ref().map(|points| points.read(py, block.clone()));
            let full = |columns: Vec<Vec<f64>>| columns.into_iter().map(Column::full).collect();
            let channels = self.plan.channels().clone();
            let mut batch = Batch::from_columns(channels, full(truths), full(predictions), labels);
            for (field, said) in &said {
                batch = said.put_into(py, batch, *field, block.clone());
            }
            let done = py.detach(|| self.evaluator().update(&batch));
            done.map_err(value_error)?;
        }
        Ok(true)
    }

    /// Merges the sums of another object into these sums.
    fn merge(&self, py: Python<'_>, other: &Sums) -> PyResult<()> {
        let states = other.states()?;
        py.detach(|| self.evaluator().merge_states(&states))
            .map_err(value_error)
    }

    /// Sums as bytes, for `merge_bytes`.
    fn states_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = serde_json::to_vec(&self.states()?).map_err(value_error)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Merges a result of `states_bytes`.
    fn merge_bytes(&self, bytes: &[u8]) -> PyResult<()> {
        let states: Vec<State> = serde_json::from_slice(bytes).map_err(|error| {
            value_error(format_args!("not a state of taceva's metrics: {error}"))
        })?;
        self.evaluator().merge_states(&states).map_err(value_error)
    }

    /// Clears the sums.
    fn reset(&self) {
        *self.evaluator() = Evaluator::new(&self.plan);
    }

    /// Scores of all added rows, as the text of a results file. `paired_by` has the key by which the caller paired each pair of tables; `""` means by
    /// order. `name` is the scored sensor or model, and `notes` are further notes.
    fn compute(
        &self,
        py: Python<'_>,
        paired_by: Vec<String>,
        name: Option<String>,
        notes: Vec<String>,
    ) -> PyResult<String> {
        py.detach(|| {
            let evaluation = self.evaluator().score().map_err(value_error)?;
            let mut report = EvaluationReport::of_arrays(&evaluation);
            if let Some(name) = name {
                report.subject.sensor = name;
            }
            let paired = paired_by.into_iter().map(|key| Note::Paired(paired(key)));
            let paired = paired.map(|note| note.to_string());
            let left_out = left_out(&report.scores);
            let all = &mut report.provenance.notes;
            all.extend(paired.chain(notes).chain(left_out));
            crate::results::sealed(&report)
        })
    }
}

/// Note on rows that were left out because a number was not finite; `None` if there are none.
fn left_out(scores: &[Score]) -> Option<String> {
    let mut channels: Vec<&str> = Vec::new();
    let mut counts = Vec::new();
    for score in scores.iter().filter(|score| score.n_invalid > 0) {
        let channel = score.channel.as_str();
        if plane_axes(channel).is_none() && !channels.contains(&channel) {
            channels.push(channel);
            let rows = score.n + score.n_invalid;
            counts.push(format!("{} of {rows} of {channel}", score.n_invalid));
        }
    }
    (!counts.is_empty()).then(|| {
        format!(
            "rows with NaN or an infinite number were left out: {}",
            counts.join(", ")
        )
    })
}

/// Pairing of rows that Python states: by an order, by an index, or by the key column of this name.
fn paired(key: String) -> PairedBy {
    match key.as_str() {
        "" => PairedBy::Order,
        "the index" => PairedBy::Index,
        "the order" => PairedBy::ChosenOrder,
        _ => PairedBy::Key {
            truth: key.clone(),
            prediction: key,
        },
    }
}

/// Converts pairs of a channel name and its unit to channels.
pub(crate) fn channels_of(channels: &[(String, String)]) -> PyResult<Channels> {
    let channels = channels.iter().map(|(name, unit)| channel(name, unit));
    Channels::new(channels.collect::<PyResult<Vec<_>>>()?).map_err(value_error)
}

/// Channel `name` in `unit`; the six contact channels have a fixed unit.
fn channel(name: &str, unit: &str) -> PyResult<Channel> {
    let unit = Unit::from_symbol(unit).ok_or_else(|| {
        let known: Vec<&str> = Unit::ALL.iter().map(|unit| unit.symbol()).collect();
        value_error(format_args!(
            "channel {name}: unit {unit:?}, expected one of {}",
            known.join(", ")
        ))
    })?;
    match Channel::SIX.iter().find(|known| known.name() == name) {
        Some(known) if known.unit() == unit => Ok(*known),
        Some(known) => Err(value_error(format_args!(
            "channel {name} is in {}, found {unit}: convert it first",
            known.unit()
        ))),
        None => Channel::named(name, unit).map_err(value_error),
    }
}
