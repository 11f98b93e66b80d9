//! State of one task. The scores of the task are computed from the state, which can be merged with states of other tables.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use taceva_core::counted;

use crate::classes::Classes;
use crate::depth::DepthState;
use crate::error::TaskError;
use crate::events::EventState;
use crate::evidence::TaskEvidence;
use crate::names::same;
use crate::pose::{EulerErrors, PoseState};
use crate::probabilities::Probabilities;
use crate::ranking::Ranking;
use crate::report::TaskScores;
use crate::top_k::TopK;
use crate::undefined::Undefined;

/// Values of k of `top_k`.
const PLACES: [u64; 2] = [2, 3];

/// Kind of a task of places, whose states are poses without rotation.
const PLACE: &str = "place";

/// Pose scores that apply to places.
const OF_PLACES: [&str; 2] = ["pose_translation", "pose_axis"];

/// Sums of one task by cluster, with the definition of the task. Absent sums are `None`.
///
/// The scores depend only on the samples: states of parts of a table, merged in any order, have the scores of the whole table.
///
/// ```
/// use taceva_tasks::{Classes, TaskState};
/// let part = |clip: &str, predicted: &str| {
///     let mut classes = Classes::new(["lost", "held"], Some("held"))?;
///     classes.push(clip, "held", predicted)?;
///     let mut state = TaskState::new("grasp", "outcome", "clip");
///     state.classes = Some(classes);
///     Ok::<TaskState, taceva_tasks::TaskError>(state)
/// };
/// let both = part("a", "held")?.merge(part("b", "lost")?)?;
/// let scores = both.scores();
/// assert_eq!((scores.scores[0].metric, scores.scores[0].estimate.value), ("class_accuracy", Ok(0.5)));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct TaskState {
    /// Name of the task.
    pub name: String,
    /// Kind of the task: `class`, `event`, `outcome`, `pose`, `place` or `depth`.
    pub kind: String,
    /// Table column that names the cluster of each row.
    pub cluster: String,
    /// Remarks on labels and predictions.
    pub notes: Vec<String>,
    /// Number of rows without a label, which are left out.
    pub unlabelled: u64,
    /// Number of rows with a number that is not finite, which are left out.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub invalid: u64,
    /// True if the rows of a cluster are one sequence, because of onsets or a debounce.
    pub is_sequence: bool,
    /// Counts of true and predicted classes.
    pub classes: Option<Classes>,
    /// Scores of the positive class.
    pub ranking: Option<Ranking>,
    /// Scores of all classes, as probabilities.
    pub probabilities: Option<Probabilities>,
    /// Ranks of the true class among the scores of all classes.
    pub places: Option<TopK>,
    /// Sums over the true and predicted onsets of an event.
    pub events: Option<EventState>,
    /// Errors of poses.
    pub pose: Option<PoseState>,
    /// Differences of Euler angles, for public programs.
    pub euler: Option<EulerErrors>,
    /// Errors of depth maps.
    pub depth: Option<DepthState>,
    /// Samples with the greatest errors, for pages. Files of states omit these samples.
    #[serde(skip)]
    pub evidence: TaskEvidence,
}

impl TaskState {
    /// State without samples. `cluster` is the column with the clusters.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        kind: impl Into<String>,
        cluster: impl Into<String>,
    ) -> TaskState {
        TaskState {
            name: name.into(),
            kind: kind.into(),
            cluster: cluster.into(),
            notes: Vec::new(),
            unlabelled: 0,
            invalid: 0,
            is_sequence: false,
            classes: None,
            ranking: None,
            probabilities: None,
            places: None,
            events: None,
            pose: None,
            euler: None,
            depth: None,
            evidence: TaskEvidence::default(),
        }
    }

    /// Names of the clusters with samples, in order.
    #[must_use]
    pub fn clusters(&self) -> Vec<&str> {
        match (&self.classes, &self.pose, &self.depth) {
            (Some(classes), _, _) => classes.clusters().collect(),
            (None, Some(pose), _) => pose.clusters().collect(),
            (None, None, Some(depth)) => depth.clusters().collect(),
            (None, None, None) => Vec::new(),
        }
    }

    /// Adds all samples of `other`.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if kind, cluster column, names, rule, thresholds or kinds of scores differ.
    /// [`TaskError::DividedSequence`] if both states have rows of one sequence.
    pub fn merge(mut self, other: TaskState) -> Result<TaskState, TaskError> {
        same("kind", self.kind.clone(), other.kind.clone())?;
        same(
            "cluster column",
            self.cluster.clone(),
            other.cluster.clone(),
        )?;
        self.check_sequences(&other)?;
        self.notes = joined(self.notes, other.notes);
        self.unlabelled = self.unlabelled.saturating_add(other.unlabelled);
        self.invalid = self.invalid.saturating_add(other.invalid);
        self.is_sequence |= other.is_sequence;
        self.classes = both("classes", self.classes, other.classes, Classes::merge)?;
        let rankings = |ours: Ranking, theirs| Ok(ours.merge(theirs));
        self.ranking = both(
            "scores of the positive class",
            self.ranking,
            other.ranking,
            rankings,
        )?;
        self.probabilities = both(
            "scores of all classes",
            self.probabilities,
            other.probabilities,
            Probabilities::merge,
        )?;
        self.places = both(
            "scores of all classes",
            self.places,
            other.places,
            TopK::merge,
        )?;
        self.events = both(
            "times of events",
            self.events,
            other.events,
            EventState::merge,
        )?;
        self.pose = both("poses", self.pose, other.pose, PoseState::merge)?;
        let eulers = |ours: EulerErrors, theirs| Ok(ours.merge(&theirs));
        self.euler = both("Euler angles", self.euler, other.euler, eulers)?;
        self.depth = both("depth maps", self.depth, other.depth, DepthState::merge)?;
        for sample in other.evidence.worst {
            self.evidence.add_worst(sample);
        }
        Ok(self)
    }

    /// Refuses a sequence whose rows are in both states.
    fn check_sequences(&self, other: &TaskState) -> Result<(), TaskError> {
        if !(self.is_sequence || other.is_sequence) {
            return Ok(());
        }
        let known: BTreeSet<&str> = self.clusters().into_iter().collect();
        match other.clusters().into_iter().find(|own| known.contains(own)) {
            Some(cluster) => Err(TaskError::DividedSequence {
                cluster: cluster.to_owned(),
            }),
            None => Ok(()),
        }
    }

    /// Scores of all samples, with the counts of the classes.
    #[must_use]
    pub fn scores(&self) -> TaskScores {
        let mut scores = TaskScores::new(
            self.name.as_str(),
            self.kind.as_str(),
            self.cluster.as_str(),
        );
        if let Some(classes) = &self.classes {
            scores = scores.of_classes(classes);
        }
        scores.clusters = self.clusters().into_iter().map(str::to_owned).collect();
        scores.notes.clone_from(&self.notes);
        if self.unlabelled > 0 {
            let rows = counted(self.unlabelled, "row");
            scores
                .notes
                .push(format!("{rows} without a label, left out"));
        }
        if self.invalid > 0 {
            let rows = counted(self.invalid, "row");
            let words = "with a number that is not finite, left out";
            scores.notes.push(format!("{rows} {words}"));
        }
        scores
            .notes
            .extend(self.depth.iter().flat_map(remarks_on_maps));
        scores.evidence = self.evidence.clone();
        if let Some(ranking) = &self.ranking {
            scores.evidence.curve = ranking.curve();
            scores.evidence.prevalence = ranking.prevalence();
        }
        if let Some(events) = &self.events {
            scores.evidence.delays_s = events.delays_s().to_vec();
        }
        let all = &mut scores.scores;
        all.extend(self.ranking.iter().flat_map(Ranking::scores));
        all.extend(self.probabilities.iter().flat_map(Probabilities::scores));
        let classes = scores.names.len() as u64;
        let places = PLACES.into_iter().filter(|k| *k < classes);
        for k in places {
            all.extend(self.places.iter().flat_map(|places| places.scores(k)));
        }
        all.extend(self.events.iter().flat_map(EventState::scores));
        let of_poses = self.pose.iter().flat_map(PoseState::scores);
        // A task without points of an object has no distances of points, and a place has no rotation.
        let is_place = self.kind == PLACE;
        all.extend(of_poses.filter(|score| match is_place {
            true => OF_PLACES.contains(&score.metric),
            false => score.estimate.value.err() != Some(Undefined::NoPoints),
        }));
        all.extend(self.depth.iter().flat_map(DepthState::scores));
        scores
    }
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

/// Remarks on depth maps that limit the scores.
fn remarks_on_maps(state: &DepthState) -> Vec<String> {
    let pixel = "without a pixel that is valid in truth and prediction, left out";
    let contact = "without contact in truth and prediction, left out of contact_iou";
    let remark = |count: u64, noun: &str, words: &str| {
        (count > 0).then(|| format!("{} {words}", counted(count, noun)))
    };
    let remarks = [
        remark(state.maps_without_pixel(), "map", pixel),
        remark(state.maps_without_contact(), "map", contact),
        remark(
            state.negative_pixels(),
            "valid pixel",
            "with a negative depth, kept",
        ),
    ];
    remarks.into_iter().flatten().collect()
}

/// Merges a part of both states. Refuses a part that only one state has.
fn both<T>(
    what: &'static str,
    ours: Option<T>,
    theirs: Option<T>,
    merge: impl FnOnce(T, T) -> Result<T, TaskError>,
) -> Result<Option<T>, TaskError> {
    match (ours, theirs) {
        (Some(ours), Some(theirs)) => merge(ours, theirs).map(Some),
        (None, None) => Ok(None),
        (ours, theirs) => {
            let words = |has: bool| if has { "some" } else { "none" }.to_owned();
            Err(TaskError::OtherDefinition {
                what,
                ours: words(ours.is_some()),
                theirs: words(theirs.is_some()),
            })
        }
    }
}

/// Remarks of two states: unchanged if equal, otherwise sorted, so that the order of merges has no effect.
fn joined(ours: Vec<String>, theirs: Vec<String>) -> Vec<String> {
    if ours == theirs {
        return ours;
    }
    let all: BTreeSet<String> = ours.into_iter().chain(theirs).collect();
    all.into_iter().collect()
}
