//! Reads two tables once, side by side. Memory contains only a few thousand rows of each table. These rows remain in the cache of a core while they are
//! digested, split, parsed and scored.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use taceva_core::{ErrorKind, ModelError, Progress};
use taceva_dataset::internal::each_part;
use taceva_import::{CsvStream, CsvTable};
use taceva_metrics::Evaluator;

use super::agreement::Matching;
use super::key_order::KeyOrder;
use super::row_pairs::PairedRows;
use super::tables::Pairing;
use super::whole_columns::WholeColumns;
use super::{
    Said, ScorePlan, ScoreRequest, Scored, finished, likely_key, likely_radians, parquet_parts,
    planned, tables,
};
use crate::accumulate::{BATCH_ROWS, Rows};
use crate::error::EvaluateError;
use crate::row_ledger::Taken;

/// Scores the tables of `request` in one pass. The result has the same bytes as the result of [`Scoring`](super::Scoring). Returns `None` if a single
/// pass is impossible: for unequal or unsorted keys, quoted cells, Parquet, possible key columns, angles that may be in radians, and any error.
/// [`Scoring`](super::Scoring) then reads the tables again and reports the error.
///
/// # Errors
/// [`EvaluateError`] if `progress` was cancelled.
pub fn score_in_one_pass(
    request: &ScoreRequest,
    progress: &dyn Progress,
) -> Result<Option<Scored>, EvaluateError> {
    let paths = [&request.truth, &request.prediction];
    if paths.iter().any(|path| parquet_parts::is_parquet(path)) {
        return Ok(None);
    }
    let streams = paths.map(|path| CsvStream::open(path));
    let (Ok(()), [Ok(truth), Ok(prediction)]) = (tables::check_distinct(request), streams) else {
        return Ok(None);
    };
    let headers = [truth.header(), prediction.header()];
    let Ok(plan) = planned(request, headers[0], headers[1]) else {
        return Ok(None);
    };
    let key = plan.keys.pairs.first();
    let Ok(matching) = Matching::of(headers, &plan.keys, key) else {
        return Ok(None);
    };
    let pass = Pass {
        order: key.and_then(|key| KeyOrder::of(headers, key)),
        truth: Mutex::new(truth),
        prediction: Mutex::new(prediction),
        plan: &plan,
        matching: &matching,
        request,
        allow_invalid: request.allow_invalid,
        blocks: AtomicU64::new(0),
        rows: AtomicU64::new(0),
        is_over: AtomicBool::new(false),
        progress,
    };
    progress.begin("score", None);
    let evaluator = pass.evaluate(request.jobs.get());
    progress.end();
    let is_in_order = pass.order.is_none_or(KeyOrder::ascends);
    let Some(evaluator) = evaluator?.filter(|_| is_in_order) else {
        return Ok(None);
    };
    let rows = usize::try_from(pass.rows.into_inner()).unwrap_or(usize::MAX);
    let digest = |stream: Mutex<CsvStream>| {
        let stream = stream.into_inner().unwrap_or_else(PoisonError::into_inner);
        stream.digest().to_string()
    };
    let digests: BTreeMap<String, String> = [
        ("truth".to_owned(), digest(pass.truth)),
        ("prediction".to_owned(), digest(pass.prediction)),
    ]
    .into();
    let taken = Taken::all_of(tables::input_of(&digests), rows);
    let said = Said {
        is_independent: request.is_independent,
        paired: matching.by,
        unit_of_one: tables::unit_of_one(request, plan.metrics.channels()),
        angles: Vec::new(),
        shard: None,
    };
    finished(evaluator, &plan.sensor, digests, taken, said).map(Some)
}

/// State that the threads of a pass share.
struct Pass<'a> {
    truth: Mutex<CsvStream>,
    prediction: Mutex<CsvStream>,
    plan: &'a ScorePlan,
    matching: &'a Matching,
    request: &'a ScoreRequest,
    allow_invalid: bool,
    /// Order of keys, if both tables have a key.
    order: Option<KeyOrder>,
    /// Number of blocks whose reading has begun.
    blocks: AtomicU64,
    /// Number of scored rows.
    rows: AtomicU64,
    /// True if a thread has found a reason to end the pass.
    is_over: AtomicBool,
    progress: &'a dyn Progress,
}

impl Pass<'_> {
    /// Sums of all rows; `None` without rows, or if a single pass is impossible. Sums are exact, so the number of threads has no effect.
    fn evaluate(&self, threads: usize) -> Result<Option<Evaluator>, EvaluateError> {
        let evaluators = each_part((0..threads).collect(), |_| {
            let found = self.batches();
            if !matches!(found, Ok(Some(_))) {
                self.is_over.store(true, Ordering::Relaxed);
            }
            found
        });
        let mut total = Evaluator::new(&self.plan.metrics);
        for evaluator in evaluators {
            match evaluator? {
                Some(evaluator) => total.merge(evaluator)?,
                None => return Ok(None),
            }
        }
        let has_rows = self.rows.load(Ordering::Relaxed) > 0;
        Ok(has_rows.then_some(total))
    }

    /// Scores batches until the tables end; `None` if a batch needs the whole tables.
    fn batches(&self) -> Result<Option<Evaluator>, EvaluateError> {
        let block = |stream: &Mutex<CsvStream>| lock(stream).block();
        let mut pair = [block(&self.truth), block(&self.prediction)];
        let mut evaluator = Evaluator::new(&self.plan.metrics);
        while !self.is_over.load(Ordering::Relaxed) {
            if self.progress.is_cancelled() {
                let stopped = ModelError::new(ErrorKind::Interrupted, "stopped while scoring");
                return Err(stopped.into());
            }
            let Some(number) = self.next(&mut pair) else {
                return Ok(None);
            };
            let rows = pair[0].rows();
            if rows == 0 {
                break;
            }
            if !self.take(number, [&pair[0], &pair[1]], &mut evaluator) {
                return Ok(None);
            }
            self.rows.fetch_add(rows as u64, Ordering::Relaxed);
            self.progress.advance(rows as u64);
        }
        Ok(Some(evaluator))
    }

    /// Reads the next block of both tables and returns its number. `None` if the block cannot be read, or has unequal numbers of rows in the two
    /// tables.
    fn next(&self, [of_truth, of_prediction]: &mut [CsvTable; 2]) -> Option<u64> {
        let mut truth = lock(&self.truth);
        let number = self.blocks.fetch_add(1, Ordering::Relaxed);
        truth.read(BATCH_ROWS, of_truth).ok()?;
        // Locked before the first lock is released, so that both tables are read in the same order.
        let mut prediction = lock(&self.prediction);
        drop(truth);
        prediction.read(BATCH_ROWS, of_prediction).ok()?;
        (of_truth.rows() == of_prediction.rows()).then_some(number)
    }

    /// Scores a block. Returns false if only [`Scoring`](super::Scoring) can score it, or report its error.
    fn take(&self, number: u64, tables: [&CsvTable; 2], evaluator: &mut Evaluator) -> bool {
        // The first block shows possible key columns and radians; the whole tables decide.
        if number == 0 && !self.is_plain([tables[0], tables[1]]) {
            return false;
        }
        let mut order = self.order.iter();
        order.all(|order| order.is_kept_in(number, tables))
            && self.update(tables, evaluator).is_ok()
    }

    /// True if the columns of these tables are neither possible keys nor angles that may be in radians.
    fn is_plain(&self, tables: [&dyn WholeColumns; 2]) -> bool {
        let has_no_key = likely_key::check(self.request, self.plan, tables).is_ok();
        let angles = likely_radians::notes(self.request, self.plan, tables);
        has_no_key && angles.is_ok_and(|notes| notes.is_empty())
    }

    fn update(
        &self,
        tables: [&CsvTable; 2],
        evaluator: &mut Evaluator,
    ) -> Result<(), EvaluateError> {
        let rows = 0..tables[0].rows();
        let paired = PairedRows::new(
            tables,
            &Pairing::ByOrder,
            self.matching,
            self.plan,
            self.allow_invalid,
        )?;
        Ok(evaluator.update(&paired.batch(&self.plan.metrics, rows)?)?)
    }
}

fn lock(stream: &Mutex<CsvStream>) -> std::sync::MutexGuard<'_, CsvStream> {
    stream.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;
    use std::path::Path;

    use taceva_core::SilentProgress;

    use super::super::Scoring;
    use super::*;

    const ROWS: usize = 2 * BATCH_ROWS + 100;

    /// Test table of two channels after the columns `front`, with the `cells` of each row. `off` scales the errors of the table.
    fn table(front: &str, cells: impl Fn(usize) -> String, off: f64) -> String {
        let mut text = format!("{front}Px,Fz\n");
        for row in 0..ROWS {
            let error = off * f64::from(u8::try_from(row * 7919 % 13).expect("below 13"));
            let x = f64::from(u8::try_from(row % 90).expect("below 90")) / 7.0 + error;
            text += &format!("{}{x},{}\n", cells(row), x / 3.0 - error);
        }
        text
    }

    fn request(folder: &Path, [truth, prediction]: [&str; 2], jobs: usize) -> ScoreRequest {
        let write = |name: &str, text: &str| {
            let path = folder.join(name);
            std::fs::write(&path, text).expect("written");
            path
        };
        ScoreRequest {
            truth: write("truth.csv", truth),
            prediction: write("prediction.csv", prediction),
            units: Vec::new(),
            periods: Vec::new(),
            key: None,
            is_independent: false,
            sensor: None,
            metrics: Vec::new(),
            allow_invalid: false,
            jobs: NonZeroUsize::new(jobs).expect("at least one"),
        }
    }

    /// All output files of scores.
    fn written(scored: &Scored) -> (String, Vec<u8>) {
        let mut state = Vec::new();
        scored.state.write(&mut state).expect("in memory");
        (format!("{:?}", scored.report), state)
    }

    fn in_one_pass(request: &ScoreRequest) -> Option<Scored> {
        score_in_one_pass(request, &SilentProgress).expect("not cancelled")
    }

    #[test]
    fn one_pass_on_any_number_of_threads_gives_the_bytes_of_both_tables_in_memory() {
        let folder = tempfile::tempdir().expect("a folder");
        let point = |row: usize| format!("p{},", row / 4);
        let both = |row: usize| format!("{row},p{},", row % 1000);
        let id = |row: usize| format!("{row},");
        for tables in [
            [
                table("point_id,", point, 0.0),
                table("", |_| String::new(), 0.01),
            ],
            [table("id,point_id,", both, 0.0), table("id,", id, 0.01)],
            [
                table("point_id,", point, 0.0).trim_end().to_owned(),
                table("", |_| String::new(), 0.01).replace('\n', "\r\n\n"),
            ],
        ] {
            let tables = [tables[0].as_str(), tables[1].as_str()];
            let scoring = Scoring::read(request(folder.path(), tables, 2)).expect("two tables");
            let expected = written(&scoring.run(&SilentProgress).expect("scored"));
            for jobs in [1, 2, 5] {
                let found = in_one_pass(&request(folder.path(), tables, jobs)).expect("plain");
                assert!(written(&found) == expected, "{jobs} threads");
            }
        }
    }

    #[test]
    fn what_needs_the_whole_tables_or_is_refused_is_left_to_them() {
        let folder = tempfile::tempdir().expect("a folder");
        let plain = |off| table("", |_| String::new(), off);
        let with_id = |id: fn(usize) -> usize| table("id,", |row| format!("{},", id(row)), 0.01);
        let (truth, prediction) = (plain(0.0), plain(0.01));
        let last = prediction.trim_end().rfind('\n').expect("rows") + 1;
        for (other, [truth, prediction]) in [
            ("a row less", [&truth, &prediction[..last].to_owned()]),
            (
                "no number",
                [&truth, &(prediction[..last].to_owned() + "x,1\n")],
            ),
            (
                "three cells",
                [&truth, &(prediction[..last].to_owned() + "1,1,1\n")],
            ),
            (
                "a quote",
                [&truth, &(prediction[..last].to_owned() + "\"1\",1\n")],
            ),
            ("no row", [&"Px,Fz\n".to_owned(), &"Px,Fz\n".to_owned()]),
            (
                "other channels",
                [&truth, &prediction.replacen("Px", "Py", 1)],
            ),
            ("an empty file", [&truth, &String::new()]),
            (
                "ids that do not ascend",
                [&with_id(|row| ROWS - row), &with_id(|row| ROWS - row)],
            ),
            ("other ids", [&with_id(|row| row), &with_id(|row| row + 1)]),
        ] {
            let request = request(folder.path(), [truth, prediction], 2);
            assert!(in_one_pass(&request).is_none(), "{other}");
        }
        let none = ScoreRequest {
            truth: folder.path().join("nowhere.csv"),
            ..request(folder.path(), [&truth, &prediction], 2)
        };
        assert!(in_one_pass(&none).is_none());
    }
}
