//! Sums of a task of events.

use serde::{Deserialize, Serialize};

use super::error::EventError;
use super::frame::{Frame, checked_times};
use super::onsets::{match_onsets, onset_times};
use super::rule::EventRule;
use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::totals::{Totals, checked_counts};

/// Index in `sums` of the sum of delays of matched onsets, s.
pub(super) const DELAYS: usize = 0;
/// Index in `sums` of the sum of durations of sequences, s.
pub(super) const DURATIONS: usize = 1;
/// Index in `counts` of the number of matched onsets.
pub(super) const MATCHED: usize = 0;
/// Index in `counts` of the number of onsets, true and predicted onsets together.
pub(super) const ONSETS: usize = 1;
/// Index in `counts` of the number of predicted onsets.
pub(super) const PREDICTED: usize = 2;
/// Index in `counts` of the number of frames.
pub(super) const FRAMES: usize = 3;
/// Index in `counts` of the number of frames whose score is outside 0 to 1.
pub(super) const OUTSIDE: usize = 4;
/// Index in `counts` of the number of sequences without times.
pub(super) const UNTIMED: usize = 5;

/// Totals of a cluster of sequences.
pub(super) type EventTotals = Totals<2, 6>;

/// Sums of a task of events by cluster. Scores have the same bits for any order of sequences and merges.
///
/// ```
/// use taceva_tasks::events::{EventRule, EventState, Frame};
/// let mut state = EventState::new(EventRule::default());
/// state.push("stroke 1", &[Frame::new(1, None, false, 0.0), Frame::new(2, None, true, 1.0)])?;
/// let delay = state.scores().into_iter().find(|score| score.metric == "onset_delay").ok_or("a score")?;
/// assert_eq!(delay.estimate.value.map_err(|reason| reason.to_string()), Err("frames without times".to_owned()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct EventState {
    pub(super) rule: EventRule,
    pub(super) clusters: ByCluster<EventTotals>,
    /// Delays of all matched onsets in ascending order, s.
    pub(super) delays: Vec<f64>,
}

/// Deserialized state, not yet validated: counts and delays may contradict each other.
#[derive(Deserialize)]
struct Stored {
    rule: EventRule,
    clusters: ByCluster<EventTotals>,
    delays: Vec<f64>,
}

impl TryFrom<Stored> for EventState {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<EventState, TaskError> {
        let Stored {
            rule,
            clusters,
            delays,
        } = stored;
        let matched = checked_counts(&clusters)?[MATCHED];
        if delays.len() as u64 != matched || !delays.is_sorted() {
            return Err(TaskError::damaged(
                "another number of delays than of matched onsets",
            ));
        }
        let is_right = |totals: &EventTotals| totals.counts[MATCHED] <= totals.counts[PREDICTED];
        if !clusters.values().all(is_right) {
            return Err(TaskError::damaged(
                "more matched onsets than predicted ones",
            ));
        }
        Ok(EventState {
            rule,
            clusters,
            delays,
        })
    }
}

impl EventState {
    /// State of `rule` without a frame.
    #[must_use]
    pub fn new(rule: EventRule) -> EventState {
        EventState {
            rule,
            clusters: ByCluster::default(),
            delays: Vec::new(),
        }
    }

    /// Adds one sequence of frames of `cluster`, in the order of their times. Debounce and onsets do not reach beyond the sequence.
    ///
    /// # Errors
    /// [`EventError::Score`], [`EventError::Time`], [`EventError::NoTime`] by row; [`EventError::TimeGoesBack`] with both rows.
    pub fn push(&mut self, cluster: &str, frames: &[Frame]) -> Result<(), EventError> {
        let times = checked_times(frames)?;
        let totals = self.clusters.entry(cluster);
        totals.counts[FRAMES] += frames.len() as u64;
        let outside = frames
            .iter()
            .filter(|frame| !(0.0..=1.0).contains(&frame.score));
        totals.counts[OUTSIDE] += outside.count() as u64;
        let Some(times) = times else {
            totals.counts[UNTIMED] += u64::from(!frames.is_empty());
            return Ok(());
        };
        let truth: Vec<bool> = frames.iter().map(|frame| frame.truth).collect();
        let scores: Vec<f64> = frames.iter().map(|frame| frame.score).collect();
        let [truth, predicted] =
            [truth, self.rule.labels(&scores)].map(|labels| onset_times(&labels, &times));
        let pairs = match_onsets(&truth, &predicted, self.rule.tolerance_s());
        for pair in &pairs {
            let delay = predicted[pair.prediction] - truth[pair.truth];
            totals.sums[DELAYS].add(delay);
            let after = self.delays.partition_point(|known| *known < delay);
            self.delays.insert(after, delay);
        }
        totals.counts[MATCHED] += pairs.len() as u64;
        totals.counts[ONSETS] += (truth.len() + predicted.len()) as u64;
        totals.counts[PREDICTED] += predicted.len() as u64;
        if let [first, .., last] = times[..] {
            totals.sums[DURATIONS].add(last - first);
        }
        Ok(())
    }

    /// Delays of all matched onsets in s, in ascending order.
    #[must_use]
    pub fn delays_s(&self) -> &[f64] {
        &self.delays
    }

    /// Merges both states.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if the rules differ.
    pub fn merge(mut self, other: EventState) -> Result<EventState, TaskError> {
        self.rule.check_same(other.rule)?;
        self.clusters
            .merge(other.clusters, |own, other| own.merge(&other));
        self.delays.extend(other.delays);
        self.delays.sort_by(f64::total_cmp);
        Ok(self)
    }
}
