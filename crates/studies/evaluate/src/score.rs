//! Scores predictions of other programs from two tables, without frames or a model.

mod agreement;
mod fields;
mod key_order;
mod key_parts;
mod likely_key;
mod likely_radians;
mod one_pass;
mod origins;
mod parquet_parts;
mod period;
mod recount;
mod request;
mod row_key;
mod row_pairs;
mod shard;
mod shard_scores;
mod table_parts;
mod tables;
mod task;
mod whole_columns;

use std::collections::BTreeMap;

use taceva_core::{Channel, Column, Progress, counted, shown};
use taceva_dataset::SensorFile;
use taceva_import::CsvTable;
use taceva_metrics::{Evaluator, MetricPlan, SensorFacts, catalogue};

use crate::accumulate::{self, Rows};
use crate::assess::{Assessed, Context, FitFacts, ScoredRows, assess};
use crate::bounded_share::Bounded;
use crate::error::EvaluateError;
use crate::note::{Independence, Note, PairedBy};
use crate::plan::Plan;
use crate::row_ledger::Taken;
use crate::samples;
use crate::sensor_facts;
use crate::skill::with_skill;
use crate::state_file::StateFile;
use crate::subject;
use taceva_results::{EvaluationReport, Provenance, Samples};

use agreement::Matching;
use fields::Place;
use row_key::{KEY_NAMES, RowKeys};
use row_pairs::PairedRows;
use tables::Pairing;

pub use one_pass::score_in_one_pass;
pub use origins::{UNKNOWN_ORIGIN, stated_origins};
pub use period::Period;
pub use recount::recount_tables;
pub use request::ScoreRequest;
pub use row_key::RowKey;
pub use shard::{Shard, ShardError};
pub use shard_scores::ScoreTables;
pub use tables::read_table;
pub use task::{TaskRequest, TaskRule, TaskSpec, task_states};

/// Finished scores of two tables.
#[derive(Debug)]
pub struct Scored {
    /// Scores and their provenance.
    pub report: EvaluationReport,
    /// Sums behind the scores, which can be merged with those of other tables.
    pub state: StateFile,
}

/// The two tables, parsed.
#[derive(Debug)]
pub struct Scoring {
    request: ScoreRequest,
    truth: CsvTable,
    prediction: CsvTable,
    digests: BTreeMap<String, String>,
    plan: ScorePlan,
    pairing: Pairing,
    matching: Matching,
    /// Notes on angles that are probably in radians.
    angles: Vec<Note>,
}

/// Metrics, fields and keys of both tables.
#[derive(Debug)]
struct ScorePlan {
    metrics: MetricPlan,
    /// Locations of the fields in the tables.
    places: Vec<Place>,
    /// Facts of the sensor.
    sensor: SensorFile,
    /// Columns that identify rows.
    keys: RowKeys,
}

impl Scoring {
    /// Reads both tables and pairs their rows.
    ///
    /// # Errors
    /// [`EvaluateError`] if a table cannot be read, only one table has a channel, ids differ or repeat, or numbers of rows differ.
    pub fn read(request: ScoreRequest) -> Result<Scoring, EvaluateError> {
        catalogue::select(request.metrics.iter().map(String::as_str))?;
        tables::check_distinct(&request)?;
        let [(truth, of_truth), (prediction, of_prediction)] = tables::read_both(&request)?;
        tables::check_rows(&truth)?;
        tables::check_rows(&prediction)?;
        let digests = [("truth", of_truth), ("prediction", of_prediction)];
        let plan = planned(&request, &truth, &prediction)?;
        likely_key::check(&request, &plan, [&truth, &prediction])?;
        let angles = likely_radians::notes(&request, &plan, [&truth, &prediction])?;
        let (pairing, key) = tables::pair(&truth, &prediction, &plan.keys)?;
        let matching = Matching::of([&truth, &prediction], &plan.keys, key)?;
        Ok(Scoring {
            request,
            truth,
            prediction,
            digests: digests
                .map(|(role, digest)| (role.to_owned(), digest.to_string()))
                .into(),
            plan,
            pairing,
            matching,
            angles,
        })
    }

    /// Steps that [`run`](Scoring::run) will execute.
    pub fn plan(&self) -> Plan {
        let mut plan = Plan {
            skipped: self.plan.metrics.skipped().to_vec(),
            ..Plan::default()
        };
        let names = |names: Vec<&str>| names.join(", ");
        plan.step(
            "read",
            format!(
                "{} of {}",
                counted(self.truth.rows(), "row"),
                shown(&self.request.truth)
            ),
        );
        plan.step(
            "read",
            format!(
                "{} of {}",
                counted(self.prediction.rows(), "row"),
                shown(&self.request.prediction)
            ),
        );
        plan.step("pair", format!("rows {}", self.matching.by));
        let kept = &self.plan.metrics;
        let channels = names(kept.channels().iter().map(Channel::name).collect());
        let metrics = names(kept.kept().iter().map(|metric| metric.id).collect());
        plan.step("score", format!("{metrics} of {channels}"));
        plan
    }

    /// Computes the scores.
    ///
    /// # Errors
    /// [`EvaluateError`] at the first cell that is not a finite number, unless such cells are allowed.
    pub fn run(&self, progress: &dyn Progress) -> Result<Scored, EvaluateError> {
        progress.begin("score", Some(self.truth.rows() as u64));
        let scored = self.evaluate();
        progress.end();
        scored
    }

    /// Pairs of truth and prediction, named by the key of the truth or by row number. Only this method stores all pairs in memory.
    ///
    /// # Errors
    /// Errors of [`run`](Scoring::run).
    pub fn samples(&self) -> Result<Samples, EvaluateError> {
        let rows = self.truth.rows();
        let batch = self.paired()?.batch(&self.plan.metrics, 0..rows)?;
        let key = match &self.matching.by {
            PairedBy::Key { truth, .. } => Some(truth.as_str()),
            PairedBy::Order | PairedBy::ChosenOrder | PairedBy::Index => {
                KEY_NAMES.into_iter().find(|name| self.truth.has(name))
            }
        };
        let ids = match key {
            Some(key) => {
                let column = self.truth.position(key)?;
                let id = |row| Some(self.truth.cell(row, column).to_owned());
                (0..rows).map(id).collect()
            }
            None => (1..=rows).map(|number| Some(number.to_string())).collect(),
        };
        let points = batch.points().map(|points| {
            let point = |row| points.get(row).map(str::to_owned);
            (0..rows).map(point).collect()
        });
        let channels = self.plan.metrics.channels().iter().enumerate();
        let channels = channels.map(|(at, channel)| {
            let columns = [batch.truth(at), batch.prediction(at)].map(Column::clone);
            let [truth, prediction] = columns;
            (*channel, truth, prediction)
        });
        Ok(samples::of_pairs(ids, points, channels))
    }

    fn paired(&self) -> Result<PairedRows<'_>, EvaluateError> {
        PairedRows::new(
            [&self.truth, &self.prediction],
            &self.pairing,
            &self.matching,
            &self.plan,
            self.request.allow_invalid,
        )
    }

    fn evaluate(&self) -> Result<Scored, EvaluateError> {
        let rows = self.paired()?;
        let evaluator = accumulate::accumulate(&rows, &self.plan.metrics, self.request.jobs)?;
        let input = tables::input_of(&self.digests);
        let taken = Taken::all_of(input, self.truth.rows());
        finished(
            evaluator,
            &self.plan.sensor,
            self.digests.clone(),
            taken,
            Said {
                is_independent: self.request.is_independent,
                paired: self.matching.by.clone(),
                unit_of_one: tables::unit_of_one(&self.request, self.plan.metrics.channels()),
                angles: self.angles.clone(),
                shard: None,
            },
        )
    }
}

/// Metrics, fields and keys of both tables.
fn planned(
    request: &ScoreRequest,
    truth: &CsvTable,
    prediction: &CsvTable,
) -> Result<ScorePlan, EvaluateError> {
    let wanted = catalogue::select(request.metrics.iter().map(String::as_str))?;
    let is_declared = |name: &str| tables::is_declared(request, name);
    let keys = RowKeys::of(truth, prediction, request.key.as_ref(), is_declared)?;
    let channels = tables::channels(truth, prediction, request, &keys)?;
    let places = fields::places(truth, prediction)?;
    let sensor = request
        .sensor
        .as_deref()
        .map(SensorFile::read)
        .transpose()?;
    let sensor = sensor.unwrap_or_default();
    let metrics = MetricPlan::new(&with_skill(wanted), channels, fields::stated(&places))
        .with_facts(sensor_facts::of_file(&sensor, SensorFacts::default()));
    let metrics = match request.is_independent {
        true => metrics.independent_samples(),
        false => metrics,
    };
    Ok(ScorePlan {
        metrics,
        places,
        sensor,
        keys,
    })
}

/// Notes on tables that were scored.
struct Said {
    /// True if the caller treats samples as independent.
    is_independent: bool,
    /// Pairing of rows, which the state also records.
    paired: PairedBy,
    /// Note on columns that are read as channels of unit 1, if any.
    unit_of_one: Option<Note>,
    /// Angles that are probably in radians.
    angles: Vec<Note>,
    /// Note on the shard, if any. It is only in the report.
    shard: Option<Note>,
}

/// Scores and state of `evaluator`, which has read the tables with the given digests.
fn finished(
    evaluator: Evaluator,
    sensor: &SensorFile,
    digests: BTreeMap<String, String>,
    taken: Taken,
    said: Said,
) -> Result<Scored, EvaluateError> {
    let same_bytes =
        digests.contains_key("truth") && digests.get("truth") == digests.get("prediction");
    let provenance = Provenance {
        taceva: env!("CARGO_PKG_VERSION").to_owned(),
        tables: digests,
        ..Provenance::default()
    };
    let rows = ScoredRows::Accumulated {
        evaluator: Box::new(evaluator),
        taken: vec![taken],
    };
    let independence = said
        .is_independent
        .then_some(Note::Independent(Independence::Stated));
    let context = Context {
        notes: std::iter::once(Note::Paired(said.paired))
            .chain(independence)
            .chain(said.unit_of_one)
            .chain(said.angles)
            .chain(same_bytes.then_some(Note::SameBytes))
            .collect(),
        fit: FitFacts {
            frames_decoded: 0,
            notes: said.shard.into_iter().collect(),
        },
        ..Context::new(subject::of_file(sensor), provenance)
    };
    let Assessed { report, state } = assess(rows, Bounded::default(), context)?;
    Ok(Scored {
        report,
        state: state.expect("accumulators have a state"),
    })
}
