//! Scores the phases of a run from the table of its samples. Each state holds the sums of one phase, and does not name it.

use std::collections::BTreeSet;
use std::num::NonZeroUsize;

use taceva_core::{Field, FieldSet, counted};
use taceva_metrics::{Evaluator, Metric, MetricPlan};
use taceva_results::{Samples, Skip};

use super::{EXACT, Recount, SampleRows};
use crate::accumulate::{accumulate, restricted};
use crate::error::EvaluateError;
use crate::merge::{evaluation_of, report_of};
use crate::state_file::ReadState;

/// Fields that the table of a run stores too, for every row and without loss.
const OF_RUNS: [Field; 3] = [Field::PredictedSpacing, Field::Stamp, Field::Intensity];

/// Reason for a metric whose fields the table lacks.
const LACKING: &str =
    "it reads frames, or rows of every phase, and states are compared with one phase";
/// Reason for the metrics of a state that no phase gives.
const OTHER_SUMS: &str = "no phase of the table gives the sums of the state";
/// Greatest number of rows that are read for all states and phases together.
const MOST_READ: usize = 1 << 28;

/// Scores `samples` by the plans of `states`, one for each phase of a run. Omits metrics that read fields absent from the table. Also
/// omits metrics of a state whose sums no phase of the table gives bit for bit; [`Recount::has_equal_sums`] is then false.
///
/// # Errors
/// [`EvaluateError::State`] for a file that is not a state of its plan, and for too many states and phases. [`EvaluateError::Request`]
/// without a state.
pub fn recount_phases(
    states: &[ReadState],
    samples: &Samples,
    jobs: NonZeroUsize,
) -> Result<Recount, EvaluateError> {
    let table = PhaseTable::of(samples);
    if let (Some(problem), Some(first)) = (table.excess(states.len()), states.first()) {
        let path = first.path.clone();
        return Err(EvaluateError::State { path, problem });
    }
    let (mut parts, mut left_out, mut has_equal_sums) = (Vec::new(), Vec::new(), true);
    for state in states {
        let plan = state.file.plan.to_plan(&state.path)?;
        let kept = plan.kept().iter().copied();
        let (held, others): (Vec<&'static Metric>, Vec<_>) = kept.partition(|own| is_held(own));
        left_out.extend(others.into_iter().map(|own| skip(own, LACKING)));
        let again = table.sums(state, &plan, &held, jobs)?;
        if again.is_none() && !held.is_empty() {
            has_equal_sums = false;
            left_out.extend(held.into_iter().map(|own| skip(own, OTHER_SUMS)));
        }
        parts.push(match again {
            Some(evaluator) => state.file.finish(evaluator)?,
            None => evaluation_of(state)?,
        });
    }
    Ok(Recount {
        report: report_of(states, parts)?,
        has_equal_sums,
        left_out,
    })
}

fn skip(metric: &Metric, reason: &str) -> Skip {
    Skip {
        what: metric.id.to_owned(),
        reason: reason.to_owned(),
    }
}

/// True if `metric` reads only fields of the table of a run, and rows of one phase. A metric without needs, such as `intrinsic`, reads what there
/// is: digests of frames too, and rows of every phase.
fn is_held(metric: &Metric) -> bool {
    let needs = metric.needs.fields;
    let held: FieldSet = EXACT.into_iter().chain(OF_RUNS).collect();
    needs != FieldSet::EMPTY && needs.iter().all(|field| held.contains(field))
}

/// Table of the samples of a run, with the phases of its protocol.
struct PhaseTable<'a> {
    samples: &'a Samples,
    /// Names of the phases; one empty name for a table without phases, whose rows are those of every phase.
    phases: BTreeSet<&'a str>,
}

impl<'a> PhaseTable<'a> {
    fn of(samples: &'a Samples) -> PhaseTable<'a> {
        let words = (0..samples.rows()).filter_map(|row| samples.word("protocol", row));
        let mut phases: BTreeSet<&str> = words.flat_map(|words| words.split(' ')).collect();
        if phases.is_empty() {
            phases.insert("");
        }
        PhaseTable { samples, phases }
    }

    /// Fault of a table with more names of phases than a run with so many states has. Each pair reads the table.
    fn excess(&self, states: usize) -> Option<String> {
        let (phases, rows) = (self.phases.len(), self.samples.rows());
        let read = phases.saturating_mul(states).saturating_mul(rows);
        (read > MOST_READ).then(|| {
            format!(
                "{} in the column `protocol` of {} for {}: expected a product of at most {MOST_READ}",
                counted(phases as u64, "phase"),
                counted(rows as u64, "sample"),
                counted(states as u64, "state")
            )
        })
    }

    /// Sums of `metrics` over the first phase that gives those of `state`; `None` if no phase does.
    fn sums(
        &self,
        state: &ReadState,
        plan: &MetricPlan,
        metrics: &[&'static Metric],
        jobs: NonZeroUsize,
    ) -> Result<Option<Evaluator>, EvaluateError> {
        if metrics.is_empty() {
            return Ok(None);
        }
        let of_table = restricted(plan, metrics)?;
        let reading = |reads: fn(&Metric) -> bool| metrics.iter().filter(|own| reads(own)).count();
        let counts = [
            reading(Metric::reads_predictions),
            reading(Metric::reads_unbounded_predictions),
        ];
        // A run sums metrics apart that read other rows, or predictions before clipping.
        if counts
            .iter()
            .any(|count| ![0, metrics.len()].contains(count))
        {
            return Ok(None);
        }
        let [are_predicted, is_unbounded] = counts.map(|count| count > 0);
        let rows_of = |rows: Vec<usize>| SampleRows {
            samples: self.samples,
            provenance: &state.file.provenance,
            is_unbounded,
            rows,
        };
        if rows_of(Vec::new()).check(plan).is_err() {
            return Ok(None);
        }
        for phase in &self.phases {
            let rows = rows_of(self.rows(phase, are_predicted));
            // Rows of another phase may be none that these metrics accept.
            let Ok(mut evaluator) = accumulate(&rows, &of_table, jobs) else {
                continue;
            };
            let sums = evaluator.states()?;
            if sums.iter().all(|own| state.file.states.contains(own)) {
                let mut total = Evaluator::new(plan);
                total.merge(evaluator)?;
                return Ok(Some(total));
            }
        }
        Ok(None)
    }

    /// Rows of `phase`, only those with a prediction if `are_predicted`.
    fn rows(&self, phase: &str, are_predicted: bool) -> Vec<usize> {
        let channels = self.samples.channels();
        let mut rows = self.samples.of_protocol(phase);
        if are_predicted {
            rows.retain(|row| {
                let mut channels = channels.iter();
                channels.any(|channel| channel.prediction(*row).is_some())
            });
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_with_a_phase_for_each_of_many_rows_is_refused_by_their_number() {
        let rows: String = (0..40_000).map(|row| format!("{row},p{row}\n")).collect();
        let samples = Samples::read(&format!("sample,protocol\n{rows}")).expect("a table");
        let table = PhaseTable::of(&samples);
        let problem = table.excess(1).expect("too many");
        assert!(
            problem.starts_with("40000 phases in the column"),
            "{problem}"
        );
        let samples = Samples::read("sample,protocol\na,calibration idle\n").expect("a table");
        let table = PhaseTable::of(&samples);
        assert_eq!((table.phases.len(), table.excess(9)), (2, None));
    }

    #[test]
    fn metrics_of_frames_and_of_every_phase_are_not_held() {
        let held = |id: &str| is_held(taceva_metrics::catalogue::find(id).expect("a metric"));
        assert!(
            ["mae", "drift", "hysteresis", "r_light", "sr"]
                .into_iter()
                .all(held)
        );
        assert!(!held("intrinsic"));
    }
}
