//! Scores the phases of a run from the table of its samples. Each state contains the sums of the phase that its provenance names.

use std::num::NonZeroUsize;

use taceva_core::{Field, FieldSet, counted};
use taceva_metrics::{Evaluator, Metric, MetricPlan};
use taceva_results::{Samples, Skip};

use super::{EXACT, Recount, SampleRows};
use crate::accumulate::{OF_SENSOR, accumulate};
use crate::error::EvaluateError;
use crate::merge::{evaluation_of, report_of};
use crate::state_file::ReadState;

/// Fields, in addition to [`EXACT`], that the table of a run stores without loss for every row.
const OF_RUNS: [Field; 4] = [
    Field::PredictedSpacing,
    Field::Stamp,
    Field::Intensity,
    Field::FrameDigest,
];

/// Reason to skip a metric: the table lacks its fields.
const LACKING: &str = "the table of samples lacks a field of this metric";
/// Reason to skip the metrics of a state that does not name a single phase of the table.
const NO_PHASE: &str =
    "the state and the table of samples share no single phase of the protocol; run the scene again";
/// Reason to skip the metrics of a state whose sums differ from those of its phase.
const OTHER_SUMS: &str = "the rows of this phase do not give the sums of the state";
/// Greatest number of rows that are read for all states together.
const MOST_READ: usize = 1 << 28;

/// Scores `samples` by the plans of `states`, each on the rows of the phase that its provenance names. A state without a phase, or with a metric that
/// reads fields absent from the table, is left out. So is a state whose sums differ from the sums of its phase in any bit;
/// [`Recount::has_equal_sums`] is then false. The report has the stored scores of the states that are left out.
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

/// Error message if `states` readings of the table exceed [`MOST_READ`] rows; `None` otherwise.
fn excess(samples: &Samples, states: usize) -> Option<String> {
    let rows = samples.rows();
    (rows.saturating_mul(states) > MOST_READ).then(|| {
        format!(
            "{} and {}: expected samples times states of at most {MOST_READ}",
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
    let is_named = match samples.has("protocol") {
        true => phase_of(state, plan).is_some(),
        false => state.file.provenance.phases.is_empty(),
    };
    (!is_named).then_some(NO_PHASE)
}

/// Phase that the provenance of `state` names for every metric of `plan`; `None` if it names several phases or none.
fn phase_of<'a>(state: &'a ReadState, plan: &MetricPlan) -> Option<&'a str> {
    let phases = &state.file.provenance.phases;
    let mut of_metrics = plan.kept().iter().map(|own| phases.get(own.id));
    let first = of_metrics.next()??;
    let is_only = of_metrics.all(|phase| phase == Some(first));
    is_only.then_some(first.as_str())
}

/// True if a run never sums the metrics of `plan` together: they read different rows, or predictions before and after clipping.
fn is_mixed(plan: &MetricPlan) -> bool {
    let mut kinds = plan.kept().iter().map(|own| {
        [
            own.reads_predictions(),
            own.reads_unbounded_predictions(),
            own.id == OF_SENSOR,
        ]
    });
    let first = kinds.next();
    kinds.any(|kind| Some(kind) != first)
}

/// Sums of the metrics of `plan` over the rows of the phase of `state`; `None` if they differ from the sums in `state`.
fn sums(
    state: &ReadState,
    plan: &MetricPlan,
    samples: &Samples,
    jobs: NonZeroUsize,
) -> Result<Option<Evaluator>, EvaluateError> {
    if is_mixed(plan) {
        return Ok(None);
    }
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
    use taceva_core::{Channel, Channels};
    use taceva_metrics::catalogue;

    use super::*;

    #[test]
    fn metrics_that_a_run_sums_apart_are_mixed() {
        let are_mixed = |ids: [&str; 2]| {
            let metrics = ids.map(|id| catalogue::find(id).expect("a metric"));
            let channels = Channels::new([Channel::PX, Channel::PY, Channel::FZ]);
            let fields = Field::ALL.into_iter().collect();
            let plan = MetricPlan::new(&metrics, channels.expect("three channels"), fields);
            assert_eq!(plan.kept().len(), 2, "{ids:?}");
            is_mixed(&plan)
        };
        assert!(!are_mixed(["mae", "bias"]));
        assert!(are_mixed(["mae", "r_light"]));
        assert!(are_mixed(["mae", "intrinsic"]));
    }

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
