//! Sums of a task of depth maps.

use serde::{Deserialize, Serialize};

use super::error::DepthError;
use super::map::DepthMap;
use super::normals::NormalAngles;
use super::pixels::{
    ALL_MAPS, ANGLES, BOTH, DepthTotals, EITHER, EMPTY_MAPS, MAPS, MapSums, NEGATIVE, NORMALS,
};
use super::task::DepthTask;
use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::totals::checked_counts;

/// Sums of a task of depth maps by cluster. Scores have the same bits for any order of samples and merges.
///
/// ```
/// use taceva_tasks::depth::{DepthMap, DepthState, DepthTask};
/// let mut state = DepthState::new(DepthTask::default());
/// let flat = DepthMap::new(1, 2, vec![0.0, -0.01])?;
/// state.push("press 1", 1, &flat, &flat)?;
/// assert_eq!((state.maps(), state.maps_without_contact(), state.negative_pixels()), (1, 1, 1));
/// # Ok::<(), taceva_tasks::depth::DepthError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct DepthState {
    pub(super) task: DepthTask,
    pub(super) clusters: ByCluster<DepthTotals>,
    /// Greatest errors over all valid pixels and over pixels in contact, mm.
    pub(super) greatest: [f64; 2],
    /// Totals of the constant prediction; for normals, of a flat surface.
    pub(super) constant: DepthTotals,
    /// Greatest errors of the constant prediction over all valid pixels and over pixels in contact, mm.
    pub(super) greatest_of_constant: [f64; 2],
}

/// Deserialized state, not yet validated: counts may contradict each other.
#[derive(Deserialize)]
struct Stored {
    task: DepthTask,
    clusters: ByCluster<DepthTotals>,
    greatest: [f64; 2],
    constant: DepthTotals,
    greatest_of_constant: [f64; 2],
}

impl TryFrom<Stored> for DepthState {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<DepthState, TaskError> {
        let counts = checked_counts(&stored.clusters)?;
        for count in stored.constant.counts {
            TaskError::checked_count(0, count)?;
        }
        if counts[BOTH] > counts[EITHER] {
            return Err(TaskError::damaged(
                "more contact in both maps than in either",
            ));
        }
        if counts[MAPS] > counts[ALL_MAPS] {
            return Err(TaskError::damaged("more maps with valid pixels than maps"));
        }
        Ok(DepthState {
            task: stored.task,
            clusters: stored.clusters,
            greatest: stored.greatest,
            constant: stored.constant,
            greatest_of_constant: stored.greatest_of_constant,
        })
    }
}

impl DepthState {
    /// State of `task` without a map.
    #[must_use]
    pub fn new(task: DepthTask) -> DepthState {
        DepthState {
            task,
            clusters: ByCluster::default(),
            greatest: [0.0; 2],
            constant: DepthTotals::default(),
            greatest_of_constant: [0.0; 2],
        }
    }

    /// Adds the true and the predicted map of row `row` to `cluster`.
    ///
    /// # Errors
    /// [`DepthError::OtherSize`] if the maps or the constant differ in size.
    pub fn push(
        &mut self,
        cluster: &str,
        row: u64,
        truth: &DepthMap,
        prediction: &DepthMap,
    ) -> Result<(), DepthError> {
        let other_size = |which, of, found: &DepthMap, expected: &DepthMap| {
            let is_other = found.size() != expected.size();
            is_other.then(|| DepthError::OtherSize {
                row,
                which,
                have: found.size_text(),
                expected: expected.size_text(),
                of,
            })
        };
        let constant = self.task.constant();
        let refused = other_size("prediction", "in the truth", prediction, truth);
        let of_constant = constant.and_then(|constant| {
            other_size("truth", "in the mean map of training", truth, constant)
        });
        if let Some(error) = refused.or(of_constant) {
            return Err(error);
        }
        let gate_mm = self.task.gate_mm();
        if let Some(constant) = constant {
            let compared = truth.where_valid(prediction);
            let sums = MapSums::of(&compared, constant, gate_mm);
            self.constant.merge(&sums.totals);
            raise(&mut self.greatest_of_constant, sums.greatest);
        }
        let sums = MapSums::of(truth, prediction, gate_mm);
        let totals = self.clusters.entry(cluster);
        totals.merge(&sums.totals);
        raise(&mut self.greatest, sums.greatest);
        if let Some(pixel_mm) = self.task.pixel_mm() {
            let angles = NormalAngles::of(truth, prediction, pixel_mm);
            totals.sums[ANGLES].merge(&angles.prediction);
            totals.counts[NORMALS] += angles.count;
            self.constant.sums[ANGLES].merge(&angles.flat);
            self.constant.counts[NORMALS] += angles.count;
        }
        Ok(())
    }

    /// Merges both states.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if the tasks differ.
    pub fn merge(mut self, other: DepthState) -> Result<DepthState, TaskError> {
        self.task.check_same(&other.task)?;
        self.clusters
            .merge(other.clusters, |own, other| own.merge(&other));
        raise(&mut self.greatest, other.greatest);
        self.constant.merge(&other.constant);
        raise(&mut self.greatest_of_constant, other.greatest_of_constant);
        Ok(self)
    }

    /// Names of the clusters with maps, in order.
    pub fn clusters(&self) -> impl Iterator<Item = &str> {
        self.clusters.names()
    }

    /// Number of pairs of maps.
    #[must_use]
    pub fn maps(&self) -> u64 {
        self.count(ALL_MAPS)
    }

    /// Number of pairs of maps without a pixel that is valid in both maps. No score includes these pairs.
    #[must_use]
    pub fn maps_without_pixel(&self) -> u64 {
        self.count(ALL_MAPS) - self.count(MAPS)
    }

    /// Number of pairs of maps with valid pixels and no contact in either map. `contact_iou` omits these pairs.
    #[must_use]
    pub fn maps_without_contact(&self) -> u64 {
        self.count(EMPTY_MAPS)
    }

    /// Number of valid pixels with a negative depth in truth or prediction. Scores include these pixels.
    #[must_use]
    pub fn negative_pixels(&self) -> u64 {
        self.count(NEGATIVE)
    }

    /// Sum over all clusters of the count at index `index`.
    fn count(&self, index: usize) -> u64 {
        let clusters = self.clusters.values();
        clusters.map(|cluster| cluster.counts[index]).sum()
    }
}

/// Replaces values of `greatest` by greater values of `others`.
fn raise(greatest: &mut [f64; 2], others: [f64; 2]) {
    for (own, other) in greatest.iter_mut().zip(others) {
        *own = own.max(other);
    }
}
