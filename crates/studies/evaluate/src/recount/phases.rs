//! Scores the phases of a run from the table of its samples. Each state holds the sums of one phase, and does not name it.

use std::collections::BTreeSet;
use std::num::NonZeroUsize;

use taceva_core::{Field, FieldSet};
use taceva_metrics::{Evaluator, Metric, MetricPlan};
use taceva_results::{Samples, Skip};

use super::{EXACT, Recount, SampleRows};
use crate::accumulate::{accumulate, restricted};
use crate::error::EvaluateError;
use crate::merge::{evaluation_of, report_of};
use crate::state_file::ReadState;

/// Fields that only the table of a run stores for every row.
const OF_RUNS: [Field; 3] = [Field::PredictedSpacing, Field::Stamp, Field::Intensity];

/// Reason for a metric whose fields the table lacks.
const LACKING: &str = "it reads frames, or times of other phases, which the table does not hold";
/// Reason for the metrics of a state that no phase gives.
const OTHER_SUMS: &str = "no phase of the table gives the sums of the state";

/// Scores `samples` by the plans of `states`, one for each phase of a run. Omits metrics that read fields absent from the table. Also
/// omits metrics of a state whose sums no phase of the table gives bit for bit.
///
/// # Errors
/// [`EvaluateError::State`] for a file that is not a state of its plan. [`EvaluateError::Request`] without a state.
pub fn recount_phases(
    states: &[ReadState],
    samples: &Samples,
    jobs: NonZeroUsize,
) -> Result<Recount, EvaluateError> {
    let table = PhaseTable::of(samples);
    let (mut parts, mut left_out, mut has_equal_sums) = (Vec::new(), Vec::new(), true);
    for state in states {
        let plan = state.file.plan.to_plan(&state.path)?;
        // All metrics first, then without those of times and brightness, which may read rows of other phases.
        let (mut summed, mut again) = (Vec::new(), None);
        for further in [&OF_RUNS[..], &OF_RUNS[..1]] {
            let kept = plan.kept().iter().copied();
            let metrics: Vec<&'static Metric> =
                kept.filter(|metric| is_held(metric, further)).collect();
            if let Some(evaluator) = table.sums(state, &plan, &metrics, jobs)? {
                (summed, again) = (metrics, Some(evaluator));
                break;
            }
        }
        for metric in plan.kept() {
            let is_held = is_held(metric, &OF_RUNS[..1]);
            if !summed.iter().any(|own| own.id == metric.id) {
                has_equal_sums &= !is_held;
                left_out.push(skip(metric, if is_held { OTHER_SUMS } else { LACKING }));
            }
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

/// True if `metric` reads only fields of every table of samples, and those in `further`.
fn is_held(metric: &Metric, further: &[Field]) -> bool {
    let held: FieldSet = EXACT.into_iter().chain(further.iter().copied()).collect();
    metric.needs.fields.iter().all(|field| held.contains(field))
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
        let are_predicted = metrics.iter().any(|metric| metric.reads_predictions());
        for phase in &self.phases {
            let rows = SampleRows {
                samples: self.samples,
                provenance: &state.file.provenance,
                is_unbounded: (metrics.iter()).any(|metric| metric.reads_unbounded_predictions()),
                rows: self.rows(phase, are_predicted),
            };
            if rows.check(plan).is_err() {
                return Ok(None);
            }
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
