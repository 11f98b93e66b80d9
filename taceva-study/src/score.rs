//! Someone else's predictions against the truth: two tables, no pictures, no model.

use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{Channel, Channels, Column, Field, FieldSet, Progress, Unit};
use taceva_dataset::{CsvTable, Digest};
use taceva_metrics::{MetricPlan, catalogue};

use crate::error::StudyError;
use crate::plan::Plan;
use crate::provenance::Provenance;
use crate::report::EvaluationReport;
use crate::subject::Subject;
use crate::tally::Columns;

/// Columns of a table that are no channels.
const NOT_CHANNELS: [&str; 13] = [
    "id",
    "sample",
    "point_id",
    "scene",
    "unit_id",
    "repeat",
    "depth_step",
    "phase",
    "part",
    "kind",
    "spacing_mm",
    "intensity",
    "t_s",
];

/// What to score.
#[derive(Clone, Debug)]
pub struct ScoreRequest {
    /// The table of what is true.
    pub truth: PathBuf,
    /// The table of what was predicted.
    pub prediction: PathBuf,
    /// Units of channels beside the six; those not named have the unit 1.
    pub units: Vec<(String, Unit)>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// Whether cells that are no finite number are counted instead of refused.
    pub allow_invalid: bool,
    /// Threads.
    pub jobs: NonZeroUsize,
}

/// The two tables with what was understood of them.
#[derive(Debug)]
pub struct Scoring {
    request: ScoreRequest,
    truth: CsvTable,
    prediction: CsvTable,
    digests: BTreeMap<String, String>,
    metrics: MetricPlan,
    pairing: Pairing,
}

/// How rows find each other.
#[derive(Debug)]
enum Pairing {
    /// The first with the first.
    ByOrder,
    /// For each row of the truth, its row of the prediction.
    ById(Vec<usize>),
}

impl Scoring {
    /// Reads both tables and pairs their rows.
    ///
    /// # Errors
    /// [`StudyError`] if a table cannot be read, a channel is in one of them only, ids differ or repeat, or numbers of rows differ.
    pub fn read(request: ScoreRequest) -> Result<Scoring, StudyError> {
        let wanted = catalogue::select(request.metrics.iter().map(String::as_str))?;
        let [(truth, of_truth), (prediction, of_prediction)] = read_both(&request)?;
        let digests = [("truth", of_truth), ("prediction", of_prediction)];
        let channels = channels(&truth, &prediction, &request.units)?;
        let pairing = pair(&truth, &prediction)?;
        let has_points = truth.has("point_id") || prediction.has("point_id");
        let available = if has_points {
            FieldSet::PAIRS
        } else {
            FieldSet::PAIRS.without(Field::Point)
        };
        let metrics = MetricPlan::new(&wanted, channels, available);
        Ok(Scoring {
            request,
            truth,
            prediction,
            digests: digests
                .map(|(role, digest)| (role.to_owned(), digest.to_string()))
                .into(),
            metrics,
            pairing,
        })
    }

    /// What [`run`](Scoring::run) would do.
    pub fn plan(&self) -> Plan {
        let mut plan = Plan {
            skipped: self.metrics.skipped().to_vec(),
            ..Plan::default()
        };
        let names = |names: Vec<&str>| names.join(", ");
        plan.step(
            "read",
            format!(
                "{} rows of {}",
                self.truth.rows(),
                self.request.truth.display()
            ),
        );
        plan.step(
            "read",
            format!(
                "{} rows of {}",
                self.prediction.rows(),
                self.request.prediction.display()
            ),
        );
        plan.step(
            "pair",
            match self.pairing {
                Pairing::ByOrder => "rows by order",
                Pairing::ById(_) => "rows by id",
            },
        );
        let channels = names(self.metrics.channels().iter().map(Channel::name).collect());
        let metrics = names(self.metrics.kept().iter().map(|metric| metric.id).collect());
        plan.step("score", format!("{metrics} of {channels}"));
        plan
    }

    /// Scores.
    ///
    /// # Errors
    /// [`StudyError`] at the first cell that is no finite number, unless they are allowed.
    pub fn run(&self, progress: &dyn Progress) -> Result<EvaluationReport, StudyError> {
        progress.begin("score", Some(self.truth.rows() as u64));
        let report = self.evaluate();
        progress.end();
        report
    }

    fn evaluate(&self) -> Result<EvaluationReport, StudyError> {
        let [truth, mut prediction] = side_by_side(
            self.request.jobs,
            || self.columns(&self.truth),
            || self.columns(&self.prediction),
        )?;
        let points = match (self.truth.has("point_id"), self.prediction.has("point_id")) {
            (true, _) => Some(self.truth.text("point_id")?),
            (false, true) => Some(self.in_order(&self.prediction.text("point_id")?)),
            (false, false) => None,
        };
        if let Pairing::ById(rows) = &self.pairing {
            for column in &mut prediction {
                *column = gather(column, rows);
            }
        }
        let columns = Columns {
            truth: &truth,
            prediction: &prediction,
            points: points.as_deref(),
        };
        let evaluation = columns.score(&self.metrics, self.request.jobs)?;
        let provenance = Provenance {
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            tables: self.digests.clone(),
            ..Provenance::default()
        };
        Ok(EvaluationReport::new(
            Subject::unknown(),
            evaluation,
            provenance,
        ))
    }

    fn columns(&self, table: &CsvTable) -> Result<Vec<Column>, StudyError> {
        let channels = self.metrics.channels().iter();
        let read = |channel: &Channel| match self.request.allow_invalid {
            true => table.numbers_with_invalid(channel.name()),
            false => table.numbers(channel.name()),
        };
        channels.map(|channel| Ok(read(channel)?)).collect()
    }

    /// Cells of the prediction in the order of the truth.
    fn in_order<'a>(&self, cells: &[&'a str]) -> Vec<&'a str> {
        match &self.pairing {
            Pairing::ByOrder => cells.to_vec(),
            Pairing::ById(rows) => rows.iter().map(|&row| cells[row]).collect(),
        }
    }
}

/// Both tables with their digests.
fn read_both(request: &ScoreRequest) -> Result<[(CsvTable, Digest); 2], StudyError> {
    let share = NonZeroUsize::new(request.jobs.get() / 2).unwrap_or(NonZeroUsize::MIN);
    let read = |path: &Path| -> Result<(CsvTable, Digest), StudyError> {
        let table = CsvTable::read_with(path, share)?;
        let digest = table.digest();
        Ok((table, digest))
    };
    side_by_side(
        request.jobs,
        || read(&request.truth),
        || read(&request.prediction),
    )
}

/// Does the same for the truth and for the prediction, at the same time where two threads are allowed.
///
/// The two tables take about as long as each other, so this shares work better than threads within each of them.
fn side_by_side<T: Send>(
    jobs: NonZeroUsize,
    truth: impl FnOnce() -> Result<T, StudyError> + Send,
    prediction: impl FnOnce() -> Result<T, StudyError>,
) -> Result<[T; 2], StudyError> {
    if jobs == NonZeroUsize::MIN {
        return Ok([truth()?, prediction()?]);
    }
    std::thread::scope(|scope| {
        let truth = scope.spawn(truth);
        let prediction = prediction();
        let truth = truth
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok([truth?, prediction?])
    })
}

fn gather(column: &Column, rows: &[usize]) -> Column {
    let mut gathered = Column::default();
    rows.iter().for_each(|&row| gathered.push(column.get(row)));
    gathered
}

/// The channels of the prediction; the truth must have each, and no channel of the six that the prediction lacks.
fn channels(
    truth: &CsvTable,
    prediction: &CsvTable,
    units: &[(String, Unit)],
) -> Result<Channels, StudyError> {
    let is_channel = |name: &&String| !NOT_CHANNELS.contains(&name.as_str());
    let six = |name: &str| {
        Channel::SIX
            .into_iter()
            .find(|channel| channel.name() == name)
    };
    let wrong = |table: &CsvTable, problem: String| StudyError::Tables {
        path: table.path().to_owned(),
        problem,
    };
    let mut found = Vec::new();
    for name in prediction.names().iter().filter(is_channel) {
        truth.position(name)?;
        let declared = units
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, unit)| *unit);
        let unit = declared
            .or_else(|| six(name).map(|channel| channel.unit()))
            .unwrap_or(Unit::One);
        found.push(
            Channel::named(name, unit).map_err(|error| wrong(prediction, error.to_string()))?,
        );
    }
    let absent = truth
        .names()
        .iter()
        .find(|name| six(name).is_some() && !prediction.has(name));
    if let Some(name) = absent {
        let problem = format!(
            "no column `{name}`, which {} has: both must have the same channels",
            truth.path().display()
        );
        return Err(wrong(prediction, problem));
    }
    if let Some((name, _)) = units.iter().find(|(name, _)| !prediction.has(name)) {
        return Err(StudyError::Request(format!(
            "a unit is given for `{name}`, which is no column of the predictions"
        )));
    }
    if found.is_empty() {
        let problem =
            "no column is a channel: expected Px, Py, Pz, Fx, Fy, Fz or named others".to_owned();
        return Err(wrong(prediction, problem));
    }
    Channels::new(found).map_err(|error| wrong(prediction, error.to_string()))
}

fn pair(truth: &CsvTable, prediction: &CsvTable) -> Result<Pairing, StudyError> {
    let wrong = |table: &CsvTable, problem: String| StudyError::Tables {
        path: table.path().to_owned(),
        problem,
    };
    if !truth.has("id") || !prediction.has("id") {
        if truth.rows() != prediction.rows() {
            let problem = format!(
                "{} rows, but {} has {}; without a column `id` in both, rows are matched by order",
                prediction.rows(),
                truth.path().display(),
                truth.rows()
            );
            return Err(wrong(prediction, problem));
        }
        return Ok(Pairing::ByOrder);
    }
    let ids = prediction.text("id")?;
    let mut rows: HashMap<&str, usize> = HashMap::with_capacity(ids.len());
    for (row, id) in ids.iter().enumerate() {
        if rows.insert(id, row).is_some() {
            return Err(wrong(prediction, format!("id `{id}` comes twice")));
        }
    }
    let wanted = truth.text("id")?;
    let mut paired = Vec::with_capacity(wanted.len());
    for id in &wanted {
        // Taken out, so that an id of the truth that comes twice finds nothing the second time.
        match rows.remove(id) {
            Some(row) => paired.push(row),
            None if ids.contains(id) => return Err(wrong(truth, format!("id `{id}` comes twice"))),
            None => {
                let problem = format!(
                    "no row with id `{id}`, which {} has",
                    truth.path().display()
                );
                return Err(wrong(prediction, problem));
            }
        }
    }
    if let Some(id) = ids.iter().find(|id| rows.contains_key(**id)) {
        let problem = format!(
            "no row with id `{id}`, which {} has",
            prediction.path().display()
        );
        return Err(wrong(truth, problem));
    }
    Ok(Pairing::ById(paired))
}
