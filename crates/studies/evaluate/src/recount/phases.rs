//! Scores the phases of a run from the table of its samples. Each state holds the sums of the phase that its provenance names.

use std::num::NonZeroUsize;

use taceva_core::{Field, FieldSet, counted};
use taceva_metrics::{Evaluator, Metric, MetricPlan};
use taceva_results::{Samples, Skip};

use super::{EXACT, Recount, SampleRows};
use crate::accumulate::{OF_SENSOR, accumulate};
use crate::error::EvaluateError;
use crate::merge::{evaluation_of, report_of};
use crate::state_file::ReadState;

/// Fields that the table of a run stores too, for every row and without loss.
const OF_RUNS: [Field; 4] = [
    Field::PredictedSpacing,
    Field::Stamp,
    Field::Intensity,
    Field::FrameDigest,
];

/// Reason for a metric whose fields the table lacks.
const LACKING: &str = "the table of samples lacks a field that it reads";
/// Reason for the metrics of a state that does not name one phase for all of them.
const NO_PHASE: &str = "its state does not name one phase of the protocol; run the scene again";
/// Reason for the metrics of a state with other sums than its phase.
const OTHER_SUMS: &str = "the rows of its phase do not give the sums of the state";
/// Greatest number of rows that are read for all states together.
const MOST_READ: usize = 1 << 28;

/// Scores `samples` by the plans of `states`, each on the rows of the phase that its provenance names. Omits metrics of a state without a
/// phase, and metrics that read fields absent from the table. Also omits metrics of a state whose sums are not those of its phase, bit for
/// bit; [`Recount::has_equal_sums`] is then false.
///
/// # Errors
/// [`EvaluateError::State`] for a file that is not a state of its plan, for too many states, and for two states of one metric.
/// [`EvaluateError::Request`] without a state.
pub fn recount_phases(
    states: &[ReadState],
    samples: &Samples,
    jobs: NonZeroUsize,
) -> Result<Recount, EvaluateError> {
    if let (Some(problem), Some(first)) = (excess(samples, states.len()), states.first()) {
        let path = first.path.clone();
        return Err(EvaluateError::State { path, problem });
    }
    let (mut parts, mut left_out, mut has_equal_sums) = (Vec::new(), Vec::new(), true);
    for state in states {
        let plan = state.file.plan.to_plan(&state.path)?;
        let reason = match uncovered(state, &plan, samples) {
            Some(reason) => reason,
            None => match sums(state, &plan, samples, jobs)? {
                Some(evaluator) => {
                    parts.push(state.file.finish(evaluator)?);
                    continue;
                }
                None => {
                    has_equal_sums = false;
                    OTHER_SUMS
                }
            },
        };
        left_out.extend(plan.kept().iter().map(|own| skip(own, reason)));
        parts.push(evaluation_of(state)?);
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

/// Fault of a table with more rows than a run with so many states has. Each state reads the table.
fn excess(samples: &Samples, states: usize) -> Option<String> {
    let rows = samples.rows();
    (rows.saturating_mul(states) > MOST_READ).then(|| {
        format!(
            "{} and {}: expected a product of at most {MOST_READ}",
            counted(rows as u64, "sample"),
            counted(states as u64, "state")
        )
    })
}

/// Reason why `samples` cannot give the sums of `state`; `None` if they can.
fn uncovered(state: &ReadState, plan: &MetricPlan, samples: &Samples) -> Option<&'static str> {
    let held: FieldSet = EXACT.into_iter().chain(OF_RUNS).collect();
    let mut fields = plan.fields().iter();
    let digest = Field::FrameDigest;
    let lacks_digests = plan.fields().contains(digest) && !samples.has(digest.name());
    if lacks_digests || fields.any(|field| !held.contains(field)) {
        return Some(LACKING);
    }
    (phase_of(state, plan).is_none() && samples.has("protocol")).then_some(NO_PHASE)
}

/// The phase that the provenance of `state` names for every metric of `plan`.
fn phase_of<'a>(state: &'a ReadState, plan: &MetricPlan) -> Option<&'a str> {
    let phases = &state.file.provenance.phases;
    let mut of_metrics = plan.kept().iter().map(|own| phases.get(own.id));
    let first = of_metrics.next()??;
    let is_only = of_metrics.all(|phase| phase == Some(first));
    is_only.then_some(first.as_str())
}

/// Sums of the metrics of `plan` over the rows of the phase of `state`; `None` if they are not those of `state`.
fn sums(
    state: &ReadState,
    plan: &MetricPlan,
    samples: &Samples,
    jobs: NonZeroUsize,
) -> Result<Option<Evaluator>, EvaluateError> {
    let reads = |of: fn(&Metric) -> bool| plan.kept().iter().any(|own| of(own));
    let of_phase = samples.of_protocol(phase_of(state, plan).unwrap_or_default());
    let is_of_sensor = reads(|own| own.id == OF_SENSOR);
    let mut rows = SampleRows {
        samples,
        provenance: &state.file.provenance,
        is_unbounded: reads(Metric::reads_unbounded_predictions),
        rows: match is_of_sensor {
            true => (0..samples.rows()).collect(),
            false => of_phase.clone(),
        },
        timed: is_of_sensor.then_some(of_phase),
    };
    if reads(Metric::reads_predictions) {
        let channels = samples.channels();
        rows.rows.retain(|row| {
            let mut channels = channels.iter();
            channels.any(|channel| channel.prediction(*row).is_some())
        });
    }
    // An edited table may have rows that these metrics reject.
    let Some(mut evaluator) = rows
        .check(plan)
        .ok()
        .and_then(|()| accumulate(&rows, plan, jobs).ok())
    else {
        return Ok(None);
    };
    let is_same = evaluator.states()? == state.file.states;
    Ok(is_same.then_some(evaluator))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_with_too_many_rows_for_its_states_is_refused_by_their_numbers() {
        let samples = Samples::read("sample,protocol\na,calibration idle\n").expect("a table");
        assert_eq!(excess(&samples, MOST_READ), None);
        let problem = excess(&samples, MOST_READ + 1).expect("too many");
        assert!(
            problem.starts_with("1 sample and 268435457 states"),
            "{problem}"
        );
    }
}
