//! Scores tables of any length, shard by shard. Memory contains only a part of the rows at a time.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::Path;

use serde::{Deserialize, Serialize};
use taceva_core::{Channel, ErrorKind, ModelError, Progress, counted, shown};
use taceva_dataset::Digest;
use taceva_dataset::internal::each_part;
use taceva_import::{CsvParts, CsvTable};
use taceva_metrics::Evaluator;

use super::agreement::Matching;
use super::fields::NOT_CHANNELS;
use super::key_parts::{ByKey, Found, parts_of};
use super::row_key::{KEY_NAMES, KeyPair, RowKey};
use super::row_pairs::PairedRows;
use super::shard::Shard;
use super::table_parts::{Reader, TableParts};
use super::tables::Pairing;
use super::whole_columns::Parts;
use super::{
    Said, ScorePlan, ScoreRequest, Scored, finished, likely_key, likely_radians, parquet_parts,
    planned, tables,
};
use crate::accumulate::{BATCH_ROWS, Rows};
use crate::error::EvaluateError;
use crate::note::Note;
use crate::plan::Plan;
use crate::row_ledger::Taken;

/// Two tables of any length, scanned once for the positions of their rows. The scan can be stored for other processes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScoreTables {
    truth: TableParts,
    prediction: TableParts,
}

/// Readers and plan of both tables, known before any row is read.
struct Understood<'a> {
    truth: Reader<'a>,
    prediction: Reader<'a>,
    plan: ScorePlan,
    /// Notes on angles that are probably in radians.
    angles: Vec<Note>,
}

/// Rows of a shard with their predictions.
struct PairedShard {
    found: Found,
    matching: Matching,
}

impl ScoreTables {
    /// Scans both tables of `request`.
    ///
    /// # Errors
    /// [`EvaluateError`] if a table cannot be read or has no row, or if the numbers of rows differ.
    pub fn scan(request: &ScoreRequest) -> Result<ScoreTables, EvaluateError> {
        tables::check_distinct(request)?;
        let tables = both(request)?;
        for table in [&tables.truth, &tables.prediction] {
            tables::check_some(table.path(), table.rows())?;
        }
        match tables.truth.rows() == tables.prediction.rows() {
            true => Ok(tables),
            false => Err(EvaluateError::Tables {
                path: tables.prediction.path().to_owned(),
                problem: format!(
                    "{}, but {} has {}: each row of the truth needs one prediction",
                    counted(tables.prediction.rows(), "row"),
                    shown(tables.truth.path()),
                    tables.truth.rows()
                ),
            }),
        }
    }

    /// Returns the tables; scans them again if a file has changed.
    ///
    /// # Errors
    /// [`EvaluateError::Tables`] if the content of a file has changed.
    pub fn again(self) -> Result<ScoreTables, EvaluateError> {
        Ok(ScoreTables {
            truth: self.truth.again()?,
            prediction: self.prediction.again()?,
        })
    }

    /// True if the tables of `request` are read in parts, because a table is Parquet or exceeds the text limit.
    pub fn are_in_parts(request: &ScoreRequest) -> bool {
        let is_long = |path: &Path| {
            let facts = fs::metadata(path);
            facts.is_ok_and(|facts| facts.len() > CsvTable::MOST_BYTES)
        };
        [&request.truth, &request.prediction]
            .into_iter()
            .any(|path| parquet_parts::is_parquet(path) || is_long(path))
    }

    /// Number of rows of each table.
    pub fn rows(&self) -> u64 {
        self.truth.rows()
    }

    /// Digests of the truth and of the predictions.
    pub fn digests(&self) -> [Digest; 2] {
        [self.truth.digest(), self.prediction.digest()]
    }

    /// Checks channels, units, metrics and the sensor without reading cells.
    ///
    /// # Errors
    /// [`EvaluateError`] for the first failed check.
    pub fn check(&self, request: &ScoreRequest) -> Result<(), EvaluateError> {
        self.understood(request).map(drop)
    }

    /// Steps that [`score`](ScoreTables::score) will execute.
    ///
    /// # Errors
    /// Errors of [`check`](ScoreTables::check).
    pub fn plan(&self, request: &ScoreRequest, shard: Shard) -> Result<Plan, EvaluateError> {
        let understood = self.understood(request)?;
        let mut plan = Plan {
            skipped: understood.plan.metrics.skipped().to_vec(),
            ..Plan::default()
        };
        let own = shard.rows(self.rows());
        for path in [&request.truth, &request.prediction] {
            plan.step(
                "read",
                format!(
                    "rows {} up to but excluding {}, of {} of {}",
                    own.start,
                    own.end,
                    self.rows(),
                    shown(path)
                ),
            );
        }
        let keys = &understood.plan.keys;
        let by = keys.paired_by(keys.pairs.first());
        plan.step("pair", format!("rows {by}"));
        let channels = understood.plan.metrics.channels().iter().map(Channel::name);
        let channels: Vec<&str> = channels.collect();
        let metrics = understood
            .plan
            .metrics
            .kept()
            .iter()
            .map(|metric| metric.id);
        let metrics: Vec<&str> = metrics.collect();
        plan.step(
            "score",
            format!("{} of {}", metrics.join(", "), channels.join(", ")),
        );
        Ok(plan)
    }

    /// Scores the rows of `shard`. The states of all shards merge to the same scores and state as one run over all rows.
    ///
    /// # Errors
    /// [`EvaluateError`] at the first non-finite cell, unless such cells are allowed, and for a key that repeats or is missing in one table.
    pub fn score(
        &self,
        request: &ScoreRequest,
        shard: Shard,
        progress: &dyn Progress,
    ) -> Result<Scored, EvaluateError> {
        let understood = self.understood(request)?;
        let own = shard.rows(self.rows());
        progress.begin("score", Some(own.end - own.start));
        let paired = self.paired(&understood, &own);
        let evaluator = paired.and_then(|paired| {
            let evaluator = self.accumulated(&understood, request, &own, &paired, progress)?;
            Ok((evaluator, paired.matching.by))
        });
        progress.end();
        let (evaluator, paired) = evaluator?;
        let digests: BTreeMap<String, String> = [
            ("truth", self.truth.digest()),
            ("prediction", self.prediction.digest()),
        ]
        .map(|(role, digest)| (role.to_owned(), digest.to_string()))
        .into();
        let whole = usize::try_from(self.rows()).unwrap_or(usize::MAX);
        let [first, end] =
            [own.start, own.end].map(|row| usize::try_from(row).unwrap_or(usize::MAX));
        let taken = Taken::part_of(tables::input_of(&digests), first..end, whole);
        let note = (!shard.is_whole()).then(|| Note::Shard {
            shard: shard.to_string(),
            rows: [own.start, own.end],
            of: self.rows(),
        });
        let said = Said {
            is_independent: request.is_independent,
            paired,
            unit_of_one: tables::unit_of_one(request, understood.plan.metrics.channels()),
            angles: understood.angles.clone(),
            shard: note,
        };
        finished(evaluator, &understood.plan.sensor, digests, taken, said)
    }

    fn understood(&self, request: &ScoreRequest) -> Result<Understood<'_>, EvaluateError> {
        let [truth, prediction] = [self.truth.reader()?, self.prediction.reader()?];
        let predicted = prediction.header()?;
        let is_six = |name: &str| Channel::SIX.iter().any(|channel| channel.name() == name);
        // Columns that are neither channels nor known fields, such as frames, are not read.
        let is_key = |name: &str| {
            let chosen = matches!(&request.key, Some(RowKey::Column(key)) if key == name);
            chosen || KEY_NAMES.contains(&name)
        };
        let truth = truth.with_columns(|name| {
            predicted.has(name) || NOT_CHANNELS.contains(&name) || is_key(name) || is_six(name)
        });
        let plan = planned(request, &truth.header()?, &predicted)?;
        let parts = [
            Parts::new(&truth, self.truth.rows()),
            Parts::new(&prediction, self.prediction.rows()),
        ];
        likely_key::check(request, &plan, [&parts[0], &parts[1]])?;
        let angles = likely_radians::notes(request, &plan, [&parts[0], &parts[1]])?;
        Ok(Understood {
            truth,
            prediction,
            plan,
            angles,
        })
    }

    /// Predictions of the rows in `own`, found by the first key that pairs the rows.
    fn paired(
        &self,
        understood: &Understood<'_>,
        own: &Range<u64>,
    ) -> Result<PairedShard, EvaluateError> {
        let keys = &understood.plan.keys;
        let headers = [understood.truth.header()?, understood.prediction.header()?];
        let matching = |key: Option<&KeyPair>| Matching::of([&headers[0], &headers[1]], keys, key);
        if own.is_empty() || !keys.are_there() {
            return Ok(PairedShard {
                found: Found::InOrder,
                matching: matching(keys.pairs.first())?,
            });
        }
        let mut first_error = None;
        for key in &keys.pairs {
            let by_key = ByKey {
                key,
                truth: &self.truth,
                prediction: &self.prediction,
                reader: &understood.prediction,
            };
            match by_key.pair(own) {
                Ok(found) => {
                    return Ok(PairedShard {
                        found,
                        matching: matching(Some(key))?,
                    });
                }
                Err(error) => {
                    first_error.get_or_insert(error);
                }
            }
        }
        Err(first_error.expect("BUG: no key paired the rows, and none failed"))
    }

    fn accumulated(
        &self,
        understood: &Understood<'_>,
        request: &ScoreRequest,
        own: &Range<u64>,
        paired: &PairedShard,
        progress: &dyn Progress,
    ) -> Result<Evaluator, EvaluateError> {
        let parts: Vec<u64> = parts_of(own).collect();
        // Each thread reads consecutive parts. Sums are exact, so the number of threads does not matter.
        let work = Work {
            understood,
            own,
            paired,
            allow_invalid: request.allow_invalid,
            progress,
        };
        let share = parts.len().div_ceil(request.jobs.get()).max(1);
        let evaluators = each_part(parts.chunks(share).collect(), |parts| work.parts(parts));
        let mut total = Evaluator::new(&understood.plan.metrics);
        for evaluator in evaluators {
            total.merge(evaluator?)?;
        }
        Ok(total)
    }
}

/// Scans both tables, in parallel if two threads are allowed.
fn both(request: &ScoreRequest) -> Result<ScoreTables, EvaluateError> {
    let [truth, prediction] = tables::both_at_once(request, TableParts::scan)?;
    Ok(ScoreTables { truth, prediction })
}

/// State that the threads of a shard share.
struct Work<'a> {
    understood: &'a Understood<'a>,
    own: &'a Range<u64>,
    paired: &'a PairedShard,
    allow_invalid: bool,
    progress: &'a dyn Progress,
}

impl Work<'_> {
    fn parts(&self, parts: &[u64]) -> Result<Evaluator, EvaluateError> {
        let mut evaluator = Evaluator::new(&self.understood.plan.metrics);
        for &part in parts {
            if self.progress.is_cancelled() {
                let stopped = ModelError::new(ErrorKind::Interrupted, "stopped while scoring");
                return Err(stopped.into());
            }
            let scored = self.part(part, &mut evaluator);
            scored.map_err(|error| self.understood.truth.placed(error, part))?;
        }
        Ok(evaluator)
    }

    fn part(&self, part: u64, evaluator: &mut Evaluator) -> Result<(), EvaluateError> {
        let truth = self.understood.truth.read(part)?;
        let begin = part * CsvParts::ROWS;
        let here = self.own.start.max(begin)..self.own.end.min(begin + truth.rows() as u64);
        let inside = |row: u64, first: u64| usize::try_from(row - first).unwrap_or(usize::MAX);
        let rows = inside(here.start, begin)..inside(here.end, begin);
        match &self.paired.found {
            Found::InOrder => {
                let prediction = self.understood.prediction.read(part)?;
                self.update(evaluator, [&truth, &prediction], &Pairing::ByOrder, rows)
            }
            Found::Gathered(prediction) => {
                // Rows before the shard have no prediction here and are skipped.
                let paired = (0..truth.rows() as u64)
                    .map(|at| inside((begin + at).max(self.own.start), self.own.start));
                let pairing = Pairing::ByKey(paired.collect());
                self.update(evaluator, [&truth, prediction], &pairing, rows)
            }
        }
    }

    fn update(
        &self,
        evaluator: &mut Evaluator,
        [truth, prediction]: [&CsvTable; 2],
        pairing: &Pairing,
        rows: Range<usize>,
    ) -> Result<(), EvaluateError> {
        let plan = &self.understood.plan;
        let metrics = &plan.metrics;
        let paired = PairedRows::new(
            [truth, prediction],
            pairing,
            &self.paired.matching,
            plan,
            self.allow_invalid,
        )?;
        for start in rows.clone().step_by(BATCH_ROWS) {
            let end = rows.end.min(start + BATCH_ROWS);
            evaluator.update(&paired.batch(metrics, start..end)?)?;
            self.progress.advance((end - start) as u64);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
