//! Sums and scores of a task of shapes.

use serde::{Deserialize, Serialize};

use super::distances::{BothWays, OneWay};
use super::error::ShapeError;
use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::estimate::share;
use crate::score::TaskScore;
use crate::totals::{LeaveOneOut, Totals, checked_counts, error};
use crate::undefined::Undefined;
use crate::vector::GREATEST_MM;

/// Index in `sums` of the sum of Chamfer distances, each half the sum of both mean distances, mm.
const HALF_SUM: usize = 0;
/// Index in `sums` of the sum of squared Chamfer distances, each the sum of both means of squared distances, mm².
const SQUARED: usize = 1;
/// Index in `sums` of the sum of F scores of distances below the threshold τ.
const F_STRICT: usize = 2;
/// Index in `sums` of the sum of F scores of distances up to the threshold τ.
const F_INCLUSIVE: usize = 3;
/// Index in `counts` of the number of pairs of clouds.
const CLOUDS: usize = 0;

/// Totals of the pairs of clouds in one cluster.
type ShapeTotals = Totals<4, 1>;
/// Totals of all clusters, and for each cluster the totals of all other clusters.
type Clusters<'a> = LeaveOneOut<'a, 4, 1>;
/// Function from totals to a value.
type ValueOf = fn(&ShapeTotals) -> Result<f64, Undefined>;

/// Definition of a task of shapes: the threshold τ of F scores, by default no threshold.
///
/// ```
/// use taceva_tasks::shape::ShapeTask;
/// assert!(ShapeTask::default().with_tau_mm(0.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShapeTask {
    tau_mm: Option<f64>,
}

impl ShapeTask {
    /// The same task with F scores at `tau_mm`.
    ///
    /// # Errors
    /// [`ShapeError::Tau`] unless τ is above 0 and up to 1e9 mm.
    pub fn with_tau_mm(self, tau_mm: f64) -> Result<ShapeTask, ShapeError> {
        match tau_mm > 0.0 && tau_mm <= GREATEST_MM {
            true => Ok(ShapeTask {
                tau_mm: Some(tau_mm),
            }),
            false => Err(ShapeError::Tau(tau_mm)),
        }
    }

    /// Definition in words.
    fn words(self) -> String {
        match self.tau_mm {
            Some(tau) => format!("tau {tau} mm"),
            None => "no tau".to_owned(),
        }
    }
}

/// Sums of a task of shapes by cluster. Scores have the same bits for any order of samples and merges.
///
/// ```
/// use taceva_tasks::shape::{ShapeState, ShapeTask};
/// let mut state = ShapeState::new(ShapeTask::default());
/// state.push("cup", 1, &[[0.0; 3]], &[[0.0; 3]])?;
/// assert_eq!(state.scores()[0].estimate.value, Ok(0.0));
/// # Ok::<(), taceva_tasks::shape::ShapeError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct ShapeState {
    task: ShapeTask,
    clusters: ByCluster<ShapeTotals>,
}

/// Deserialized state, not yet validated: the threshold τ and counts may be out of range.
#[derive(Deserialize)]
struct Stored {
    task: ShapeTask,
    clusters: ByCluster<ShapeTotals>,
}

impl TryFrom<Stored> for ShapeState {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<ShapeState, TaskError> {
        let Stored { task, clusters } = stored;
        let is_right = task
            .tau_mm
            .is_none_or(|tau| ShapeTask::default().with_tau_mm(tau).is_ok());
        if !is_right {
            return Err(TaskError::damaged(task.words()));
        }
        checked_counts(&clusters)?;
        Ok(ShapeState { task, clusters })
    }
}

impl ShapeState {
    /// State of `task` without a cloud.
    #[must_use]
    pub fn new(task: ShapeTask) -> ShapeState {
        ShapeState {
            task,
            clusters: ByCluster::default(),
        }
    }

    /// Adds the points x, y, z of the true and of the predicted shape of row `row`, in mm.
    ///
    /// # Errors
    /// [`ShapeError::NoPoint`] for an empty cloud; [`ShapeError::Coordinate`] unless each coordinate is from −1e9 to 1e9 mm.
    pub fn push(
        &mut self,
        cluster: &str,
        row: u64,
        truth: &[[f64; 3]],
        prediction: &[[f64; 3]],
    ) -> Result<(), ShapeError> {
        check_cloud(row, "true", truth)?;
        check_cloud(row, "predicted", prediction)?;
        let tau_mm = self.task.tau_mm;
        let ways = BothWays([
            OneWay::of(truth, prediction, tau_mm),
            OneWay::of(prediction, truth, tau_mm),
        ]);
        let totals = self.clusters.entry(cluster);
        totals.counts[CLOUDS] += 1;
        totals.sums[HALF_SUM].add(ways.half_sum());
        totals.sums[SQUARED].add(ways.squared());
        totals.sums[F_STRICT].add(ways.f_strict());
        totals.sums[F_INCLUSIVE].add(ways.f_inclusive());
        Ok(())
    }

    /// Merges both states.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if the tasks differ.
    pub fn merge(mut self, other: ShapeState) -> Result<ShapeState, TaskError> {
        if self.task != other.task {
            return Err(TaskError::OtherDefinition {
                what: "shape tasks",
                ours: self.task.words(),
                theirs: other.task.words(),
            });
        }
        self.clusters
            .merge(other.clusters, |own, other| own.merge(&other));
        Ok(self)
    }

    /// Scores of the task: means over all pairs of clouds.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let clusters = Clusters::of(&self.clusters);
        let distance = "of the distances to the nearest point, both ways";
        let squares = "of the squared distances to the nearest point, both ways";
        let chamfer = |variant, unit, words: String, value: ValueOf| {
            let estimate = clusters.estimate(CLOUDS, error, value, None);
            TaskScore {
                variant,
                unit: Some(unit),
                ..TaskScore::new("chamfer", words, estimate)
            }
        };
        let [sum, squared] = ["sum", "squared"].map(|variant| Some(variant.to_owned()));
        vec![
            chamfer(
                None,
                "mm",
                format!("1/2 (mean + mean) {distance}"),
                half_sum,
            ),
            chamfer(sum, "mm", format!("mean + mean {distance}"), |totals| {
                half_sum(totals).map(|half| 2.0 * half)
            }),
            chamfer(squared, "mm²", format!("mean + mean {squares}"), |totals| {
                totals.mean(SQUARED, CLOUDS)
            }),
            self.f_score(&clusters, "fscore_strict", "below", F_STRICT),
            self.f_score(&clusters, "fscore_inclusive", "not above", F_INCLUSIVE),
        ]
    }

    /// Mean F score over the pairs of clouds, from the sum at index `sum`.
    fn f_score(
        &self,
        clusters: &Clusters<'_>,
        variant: &'static str,
        comparison: &str,
        sum: usize,
    ) -> TaskScore {
        let has_tau = self.task.tau_mm.is_some();
        let mean = |totals: &ShapeTotals| match has_tau {
            true => totals.mean(sum, CLOUDS),
            false => Err(Undefined::NoThresholds),
        };
        let estimate = clusters.estimate(CLOUDS, share, mean, None);
        let tau = self.task.words();
        let words = format!(
            "F score of the shares of points whose nearest point is {comparison} tau, {tau}"
        );
        TaskScore::new("chamfer", words, estimate).variant(variant)
    }
}

/// Mean over the pairs of clouds of half the sum of both mean distances, mm.
fn half_sum(totals: &ShapeTotals) -> Result<f64, Undefined> {
    totals.mean(HALF_SUM, CLOUDS)
}

/// Checks the points of a cloud.
fn check_cloud(row: u64, cloud: &'static str, points: &[[f64; 3]]) -> Result<(), ShapeError> {
    if points.is_empty() {
        return Err(ShapeError::NoPoint { row, cloud });
    }
    let is_usable = |value: &f64| (-GREATEST_MM..=GREATEST_MM).contains(value);
    for (point, of) in (1..).zip(points) {
        if let Some(&value) = of.iter().find(|value| !is_usable(value)) {
            return Err(ShapeError::Coordinate {
                row,
                cloud,
                point,
                value,
            });
        }
    }
    Ok(())
}
