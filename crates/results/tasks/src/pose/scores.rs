//! Scores of a task of poses.

use super::state::{ADD, ADD_S, AXES, POSES, PoseState, PoseTotals, RIGHT, ROTATION, TRANSLATION};
use crate::estimate::share;
use crate::quotient::{exact, ratio};
use crate::score::TaskScore;
use crate::totals::{LeaveOneOut, error};
use crate::undefined::Undefined;

/// Totals of all clusters of poses, and for each cluster the totals of all other clusters.
type Clusters<'a> = LeaveOneOut<'a, 7, 4>;

/// Axes along which the errors of translation are scored.
const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];
/// Coordinates of a pose that are classified into bins.
const BIN_NAMES: [&str; 3] = ["x", "y", "yaw"];

impl PoseState {
    /// Scores of all poses. Errors are compared with those of a prediction of no motion, shares of right bins with the most frequent bin.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let clusters = Clusters::of(&self.clusters);
        let mut scores = vec![self.error(
            &clusters,
            "pose_translation",
            "mean length of the difference of both translations",
            TRANSLATION,
        )];
        scores.extend(AXIS_NAMES.into_iter().zip(AXES..).map(|(name, sum)| {
            let definition = format!("mean absolute difference of both translations along {name}");
            self.error(&clusters, "pose_axis", definition, sum)
                .variant(name)
        }));
        let rotation = "mean angle 2 atan2(|v|, |w|) of the rotation from truth to prediction";
        scores.push(TaskScore {
            unit: Some("deg"),
            ..self.error(&clusters, "pose_rotation", rotation, ROTATION)
        });
        scores.extend(self.bin_scores(&clusters));
        let same = "mean distance of an object's points between both poses";
        let nearest =
            "mean distance of an object's points in the true pose to the nearest in the other";
        scores.push(self.points(&clusters, "add", same, ADD));
        scores.push(self.points(&clusters, "add_s", nearest, ADD_S));
        scores
    }

    /// Mean error over the poses, from the sum at index `sum`. The constant to beat predicts no motion.
    fn error(
        &self,
        clusters: &Clusters<'_>,
        metric: &'static str,
        definition: impl Into<String>,
        sum: usize,
    ) -> TaskScore {
        let mean = |totals: &PoseTotals| totals.mean(sum, POSES);
        let estimate = clusters.estimate(POSES, error, mean, mean(&self.still).ok());
        TaskScore {
            unit: Some("mm"),
            ..TaskScore::new(metric, definition, estimate)
        }
    }

    /// Share of poses with the right bin: the mean over x, y and yaw, then each of them.
    fn bin_scores(&self, clusters: &Clusters<'_>) -> Vec<TaskScore> {
        let Some(thresholds) = &self.task.thresholds else {
            let none = |_: &PoseTotals| Err(Undefined::NoThresholds);
            let estimate = clusters.estimate(POSES, share, none, None);
            let definition = "mean share of right bins of x, y and yaw";
            return vec![TaskScore::new("pose_class", definition, estimate)];
        };
        let rule = format!("thresholds {}, lower end included", thresholds.words());
        let greatest: Vec<u64> = self.bins.iter().map(|bins| most(bins)).collect();
        let n = self.still.counts[POSES];
        let right = |axes: &'static [usize]| {
            move |totals: &PoseTotals| {
                let right = axes.iter().map(|axis| totals.counts[RIGHT + axis]).sum();
                of_all(right, totals.counts[POSES], axes.len())
            }
        };
        let constant = |axes: &[usize]| {
            let right = axes.iter().map(|axis| greatest[*axis]).sum();
            of_all(right, n, axes.len()).ok()
        };
        let score = |axes: &'static [usize], definition: String| {
            let estimate = clusters.estimate(POSES, share, right(axes), constant(axes));
            TaskScore::new("pose_class", definition, estimate)
        };
        let mean = format!("mean share of right bins of x, y and yaw, {rule}");
        let mut scores = vec![score(&[0, 1, 2], mean)];
        for (axis, name) in BIN_NAMES.into_iter().enumerate() {
            const ALONE: [&[usize]; 3] = [&[0], &[1], &[2]];
            let right = clusters.total().counts[RIGHT + axis];
            let definition = format!("share of right bins of {name}, {rule}");
            let of_axis = score(ALONE[axis], definition).variant(name);
            scores.push(of_axis.beside(right, n));
        }
        scores
    }

    /// Mean distance over the points of all poses, from the sum at index `sum`.
    fn points(
        &self,
        clusters: &Clusters<'_>,
        metric: &'static str,
        definition: &'static str,
        sum: usize,
    ) -> TaskScore {
        let points = self.task.points.len() as u64;
        let mean = |totals: &PoseTotals| match (points, totals.counts[POSES]) {
            (0, _) => Err(Undefined::NoPoints),
            (_, 0) => Err(Undefined::Empty),
            (points, poses) => {
                let all = exact(u128::from(points) * u128::from(poses));
                Ok(totals.sums[sum].to_dyadic().over(&all))
            }
        };
        let estimate = clusters.estimate(POSES, error, mean, None);
        TaskScore {
            unit: Some("mm"),
            ..TaskScore::new(metric, definition, estimate)
        }
    }
}

/// Count of the most frequent bin.
fn most(bins: &[u64]) -> u64 {
    bins.iter().copied().max().unwrap_or_default()
}

/// Number of right bins divided by the number of all bins: `n` poses times `axes`.
fn of_all(right: u64, n: u64, axes: usize) -> Result<f64, Undefined> {
    match n {
        0 => Err(Undefined::Empty),
        n => Ok(ratio(u128::from(right), u128::from(n) * axes as u128)),
    }
}
