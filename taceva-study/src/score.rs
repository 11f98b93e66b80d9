//! Someone else's predictions against the truth: two tables, no pictures, no model.

use std::collections::{BTreeMap, HashMap};
use std::num::NonZeroUsize;
use std::ops::Range;
use std::path::{Path, PathBuf};

use taceva_core::{Batch, Channel, Channels, Column, Field, FieldSet, Progress, Unit};
use taceva_dataset::{CsvTable, Digest};
use taceva_metrics::{MetricPlan, catalogue};

use crate::error::StudyError;
use crate::plan::Plan;
use crate::provenance::Provenance;
use crate::report::EvaluationReport;
use crate::subject::Subject;
use crate::tally::{self, Rows};

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
        let rows = PairedRows::of(self)?;
        let evaluation = tally::score(&rows, &self.metrics, self.request.jobs)?;
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
}

/// The rows of both tables, parsed where they are scored: no column ever lies in memory as a whole.
struct PairedRows<'a> {
    truth: &'a CsvTable,
    prediction: &'a CsvTable,
    pairing: &'a Pairing,
    /// For each channel, where it stands in the truth and in the prediction.
    channels: Vec<[usize; 2]>,
    /// Where the contact locations are named, in the truth if it names them.
    points: Option<Points>,
    allow_invalid: bool,
}

/// The column of the contact locations.
enum Points {
    OfTruth(usize),
    OfPrediction(usize),
}

impl PairedRows<'_> {
    fn of(scoring: &Scoring) -> Result<PairedRows<'_>, StudyError> {
        let (truth, prediction) = (&scoring.truth, &scoring.prediction);
        let stand = |channel: &Channel| {
            let name = channel.name();
            Ok([truth.position(name)?, prediction.position(name)?])
        };
        let channels: Result<_, StudyError> =
            scoring.metrics.channels().iter().map(stand).collect();
        let points = match (truth.has("point_id"), prediction.has("point_id")) {
            (true, _) => Some(Points::OfTruth(truth.position("point_id")?)),
            (false, true) => Some(Points::OfPrediction(prediction.position("point_id")?)),
            (false, false) => None,
        };
        Ok(PairedRows {
            truth,
            prediction,
            pairing: &scoring.pairing,
            channels: channels?,
            points,
            allow_invalid: scoring.request.allow_invalid,
        })
    }

    fn numbers(
        &self,
        table: &CsvTable,
        column: usize,
        rows: impl ExactSizeIterator<Item = usize>,
    ) -> Result<Column, StudyError> {
        Ok(match self.allow_invalid {
            true => table.numbers_in_with_invalid(column, rows),
            false => table.numbers_in(column, rows),
        }?)
    }

    /// The rows of the truth, each with what is read of its row of the prediction.
    fn side_by_side(
        &self,
        plan: &MetricPlan,
        rows: Range<usize>,
        paired: impl ExactSizeIterator<Item = usize> + Clone,
    ) -> Result<Batch, StudyError> {
        let truth: Result<_, StudyError> = self
            .channels
            .iter()
            .map(|[column, _]| self.numbers(self.truth, *column, rows.clone()))
            .collect();
        let prediction: Result<_, StudyError> = self
            .channels
            .iter()
            .map(|[_, column]| self.numbers(self.prediction, *column, paired.clone()))
            .collect();
        let points = self.points.as_ref().map(|points| match points {
            Points::OfTruth(column) => tally::labels(self.truth.text_in(*column, rows.clone())),
            Points::OfPrediction(column) => {
                tally::labels(self.prediction.text_in(*column, paired.clone()))
            }
        });
        Ok(Batch::from_columns(
            plan.channels().clone(),
            truth?,
            prediction?,
            points,
        ))
    }
}

impl Rows for PairedRows<'_> {
    fn rows(&self) -> usize {
        self.truth.rows()
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, StudyError> {
        match self.pairing {
            Pairing::ByOrder => self.side_by_side(plan, rows.clone(), rows),
            Pairing::ById(paired) => {
                let paired = paired[rows.clone()].iter().copied();
                self.side_by_side(plan, rows, paired)
            }
        }
    }
}

/// Both tables with their digests, read at the same time where two threads are allowed.
///
/// The two take about as long as each other, so this shares work better than threads within each of them.
fn read_both(request: &ScoreRequest) -> Result<[(CsvTable, Digest); 2], StudyError> {
    let share = NonZeroUsize::new(request.jobs.get() / 2).unwrap_or(NonZeroUsize::MIN);
    let read = |path: &Path| -> Result<(CsvTable, Digest), StudyError> {
        let table = CsvTable::read_with(path, share)?;
        let digest = table.digest();
        Ok((table, digest))
    };
    if request.jobs == NonZeroUsize::MIN {
        return Ok([read(&request.truth)?, read(&request.prediction)?]);
    }
    std::thread::scope(|scope| {
        let truth = scope.spawn(|| read(&request.truth));
        let prediction = read(&request.prediction);
        let truth = truth
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok([truth?, prediction?])
    })
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
