//! Sums of a task of poses.

use serde::{Deserialize, Serialize};
use taceva_core::counted;
use taceva_metrics::ExactSum;

use super::cloud::PointDistances;
use super::error::PoseError;
use super::rigid::{Pose, check_point};
use super::thresholds::Thresholds;
use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::totals::{Totals, checked_counts};
use crate::vector::minus;

/// Index of the sum of distances between both translations, mm.
pub(super) const TRANSLATION: usize = 0;
/// Index of the sum of absolute differences along x, mm; the sums along y and z follow.
pub(super) const AXES: usize = 1;
/// Index of the sum of angles between both rotations, degrees.
pub(super) const ROTATION: usize = 4;
/// Index of the sum of distances between the positions of each object point in both poses, mm.
pub(super) const ADD: usize = 5;
/// Index of the sum of distances from each true object point to the nearest predicted point, mm.
pub(super) const ADD_S: usize = 6;
/// Index of the number of poses.
pub(super) const POSES: usize = 0;
/// Index of the number of poses with the right bin along x; the numbers for y and for yaw follow.
pub(super) const RIGHT: usize = 1;

/// Totals of a cluster of poses.
pub(super) type PoseTotals = Totals<7, 4>;

/// Definition of a task of poses: thresholds for bins, and points of the object. Both may be missing.
///
/// ```
/// use taceva_tasks::pose::{PoseTask, Thresholds};
/// let task = PoseTask::default()
///     .with_thresholds(Thresholds::new(&["1"], &["0.5"])?)
///     .with_points(vec![[0.0, 0.0, 10.0]])?;
/// assert_ne!(task, PoseTask::default());
/// # Ok::<(), taceva_tasks::pose::PoseError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "StoredTask")]
pub struct PoseTask {
    pub(super) thresholds: Option<Thresholds>,
    pub(super) points: Vec<[f64; 3]>,
}

/// Deserialized task, not yet validated: points may be NaN or infinite.
#[derive(Deserialize)]
struct StoredTask {
    thresholds: Option<Thresholds>,
    points: Vec<[f64; 3]>,
}

impl TryFrom<StoredTask> for PoseTask {
    type Error = PoseError;
    fn try_from(stored: StoredTask) -> Result<PoseTask, PoseError> {
        let task = PoseTask {
            thresholds: stored.thresholds,
            points: Vec::new(),
        };
        task.with_points(stored.points)
    }
}

impl PoseTask {
    /// The same task with bins between `thresholds`.
    #[must_use]
    pub fn with_thresholds(self, thresholds: Thresholds) -> PoseTask {
        PoseTask {
            thresholds: Some(thresholds),
            ..self
        }
    }

    /// The same task with the points x, y, z of the object, in mm.
    ///
    /// # Errors
    /// [`PoseError::Coordinate`] with the number of the point, from 1.
    pub fn with_points(self, points: Vec<[f64; 3]>) -> Result<PoseTask, PoseError> {
        for (row, point) in (1..).zip(&points) {
            check_point(row, *point)?;
        }
        Ok(PoseTask { points, ..self })
    }
}

/// Sums of a task of poses by cluster. Scores have the same bits for any order of samples and merges.
///
/// ```
/// use taceva_tasks::pose::{Pose, PoseState, PoseTask};
/// let mut one = PoseState::new(PoseTask::default());
/// one.push("stroke 1", &Pose::ZERO, &Pose::ZERO);
/// let both = one.clone().merge(one)?;
/// assert_eq!(both.scores()[0].estimate.n, 2);
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct PoseState {
    pub(super) task: PoseTask,
    pub(super) clusters: ByCluster<PoseTotals>,
    /// Totals of the errors of a prediction of no motion.
    pub(super) still: PoseTotals,
    /// Number of true poses by bin along x, along y and of yaw.
    pub(super) bins: [Vec<u64>; 3],
}

/// Deserialized state, not yet validated: counts may contradict each other.
#[derive(Deserialize)]
struct Stored {
    task: PoseTask,
    clusters: ByCluster<PoseTotals>,
    still: PoseTotals,
    bins: [Vec<u64>; 3],
}

impl TryFrom<Stored> for PoseState {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<PoseState, TaskError> {
        let Stored {
            task,
            clusters,
            still,
            bins,
        } = stored;
        let n = checked_counts(&clusters)?[POSES];
        let mut expected = [0; 4];
        expected[POSES] = n;
        if still.counts != expected {
            return Err(TaskError::damaged("another number of poses without motion"));
        }
        let empty = PoseState::new(task);
        for (bins, known) in bins.iter().zip(&empty.bins) {
            let mut sum = 0;
            for count in bins {
                sum = TaskError::checked_count(sum, *count)?;
            }
            if bins.len() != known.len() || !bins.is_empty() && sum != n {
                return Err(TaskError::damaged(
                    "the bins of the state differ from those of the task",
                ));
            }
        }
        let is_right = |totals: &PoseTotals| {
            let [poses, right @ ..] = totals.counts;
            right.iter().all(|right| *right <= poses)
        };
        if !clusters.values().all(is_right) {
            return Err(TaskError::damaged("more right bins than poses"));
        }
        Ok(PoseState {
            clusters,
            still,
            bins,
            ..empty
        })
    }
}

impl PoseState {
    /// State of `task` without a pose.
    #[must_use]
    pub fn new(task: PoseTask) -> PoseState {
        let bins = task.thresholds.as_ref().map(Thresholds::bins);
        let [translation, rotation] = bins.unwrap_or_default();
        PoseState {
            task,
            clusters: ByCluster::default(),
            still: PoseTotals::default(),
            bins: [translation, translation, rotation].map(|bins| vec![0; bins]),
        }
    }

    /// Adds a true and a predicted pose of `cluster`.
    pub fn push(&mut self, cluster: &str, truth: &Pose, prediction: &Pose) {
        let totals = self.clusters.entry(cluster);
        add_errors(totals, truth, prediction);
        if let Some(thresholds) = &self.task.thresholds {
            let bins = |pose: &Pose| {
                let [x, y, _] = pose.translation_mm();
                [
                    thresholds.bin_of_mm(x),
                    thresholds.bin_of_mm(y),
                    thresholds.bin_of_degrees(pose.rotation().yaw_degrees()),
                ]
            };
            for (axis, [truth, prediction]) in pairs(bins(truth), bins(prediction)) {
                self.bins[axis][truth] += 1;
                totals.counts[RIGHT + axis] += u64::from(truth == prediction);
            }
        }
        if !self.task.points.is_empty() {
            let distances = PointDistances::of(&self.task.points, truth, prediction);
            totals.sums[ADD].merge(&distances.same);
            totals.sums[ADD_S].merge(&distances.nearest);
        }
        add_errors(&mut self.still, truth, &Pose::ZERO);
    }

    /// Names of the clusters with poses, in order.
    pub fn clusters(&self) -> impl Iterator<Item = &str> {
        self.clusters.names()
    }

    /// Mean over the clusters of the mean translation error of each cluster, mm; `None` without a pose.
    pub(crate) fn mean_of_cluster_means(&self) -> Option<f64> {
        let means = self.clusters.values();
        let means = means.filter_map(|totals| totals.mean(TRANSLATION, POSES).ok());
        let means: Vec<f64> = means.collect();
        let count = u32::try_from(means.len()).ok().filter(|count| *count > 0)?;
        Some(means.into_iter().collect::<ExactSum>().to_f64() / f64::from(count))
    }

    /// Merges both states.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if thresholds or points differ.
    pub fn merge(mut self, other: PoseState) -> Result<PoseState, TaskError> {
        self.task.check_same(&other.task)?;
        self.clusters
            .merge(other.clusters, |own, other| own.merge(&other));
        self.still.merge(&other.still);
        for (own, other) in self.bins.iter_mut().zip(other.bins) {
            for (own, other) in own.iter_mut().zip(other) {
                *own += other;
            }
        }
        Ok(self)
    }
}

impl PoseTask {
    /// Checks that `other` is the same task.
    fn check_same(&self, other: &PoseTask) -> Result<(), TaskError> {
        let [ours, theirs] = [self, other].map(|task| {
            let thresholds = task.thresholds.as_ref();
            thresholds.map_or_else(|| "none".to_owned(), Thresholds::words)
        });
        let other_definition =
            |what, ours, theirs| TaskError::OtherDefinition { what, ours, theirs };
        if ours != theirs {
            return Err(other_definition("thresholds", ours, theirs));
        }
        if self.points != other.points {
            let [ours, theirs] = [self, other].map(|task| counted(task.points.len(), "point"));
            return Err(other_definition("points", ours, theirs));
        }
        Ok(())
    }
}

/// Pairs of true and predicted bin of x, y and yaw, each with the index of the axis.
fn pairs(truth: [usize; 3], prediction: [usize; 3]) -> impl Iterator<Item = (usize, [usize; 2])> {
    let both = truth.into_iter().zip(prediction);
    both.map(|(truth, prediction)| [truth, prediction])
        .enumerate()
}

/// Adds the errors of translation and rotation of one pose.
fn add_errors(totals: &mut PoseTotals, truth: &Pose, prediction: &Pose) {
    let apart = minus(prediction.translation_mm(), truth.translation_mm());
    totals.sums[TRANSLATION].add(truth.distance_mm(prediction));
    for (axis, off) in apart.into_iter().enumerate() {
        totals.sums[AXES + axis].add(off.abs());
    }
    let angle = truth.rotation().degrees_to(prediction.rotation());
    totals.sums[ROTATION].add(angle);
    totals.counts[POSES] += 1;
}
