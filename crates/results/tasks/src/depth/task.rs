//! Definition of a task of depth maps.

use serde::{Deserialize, Serialize};

use super::error::DepthError;
use super::map::DepthMap;
use crate::error::TaskError;
use crate::vector::GREATEST_MM;

/// Definition of a task of depth maps: contact threshold (gate), pixel size, constant map to beat.
///
/// By default the gate is 0.02 mm, and no pixel size and no constant is given.
///
/// ```
/// use taceva_tasks::depth::{DepthMap, DepthTask};
/// let mean_of_training = DepthMap::new(1, 2, vec![0.1, 0.2])?;
/// let task = DepthTask::default().with_gate_mm(0.05)?.with_pixel_mm([0.0634; 2])?;
/// let task = task.with_constant(mean_of_training);
/// assert_eq!(task.gate_mm(), 0.05);
/// # Ok::<(), taceva_tasks::depth::DepthError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct DepthTask {
    gate_mm: f64,
    pixel_mm: Option<[f64; 2]>,
    constant: Option<DepthMap>,
}

/// Deserialized task, not yet validated: numbers may be out of range.
#[derive(Deserialize)]
struct Stored {
    gate_mm: f64,
    pixel_mm: Option<[f64; 2]>,
    constant: Option<DepthMap>,
}

impl TryFrom<Stored> for DepthTask {
    type Error = DepthError;
    fn try_from(stored: Stored) -> Result<DepthTask, DepthError> {
        let mut task = DepthTask::default().with_gate_mm(stored.gate_mm)?;
        if let Some(pixel_mm) = stored.pixel_mm {
            task = task.with_pixel_mm(pixel_mm)?;
        }
        Ok(DepthTask {
            constant: stored.constant,
            ..task
        })
    }
}

impl Default for DepthTask {
    fn default() -> DepthTask {
        DepthTask {
            gate_mm: 0.02,
            pixel_mm: None,
            constant: None,
        }
    }
}

impl DepthTask {
    /// The same task with contact above `gate_mm`.
    ///
    /// # Errors
    /// [`DepthError::Gate`] unless the gate is from 0 to 1e9 mm.
    pub fn with_gate_mm(self, gate_mm: f64) -> Result<DepthTask, DepthError> {
        match (0.0..=GREATEST_MM).contains(&gate_mm) {
            true => Ok(DepthTask { gate_mm, ..self }),
            false => Err(DepthError::Gate(gate_mm)),
        }
    }

    /// The same task with the distance of neighbouring columns and of neighbouring rows of pixels, in mm.
    ///
    /// # Errors
    /// [`DepthError::PixelSize`] unless both are from 1e-9 to 1e9 mm.
    pub fn with_pixel_mm(self, pixel_mm: [f64; 2]) -> Result<DepthTask, DepthError> {
        let is_size = |mm: f64| (1.0 / GREATEST_MM..=GREATEST_MM).contains(&mm);
        match pixel_mm.into_iter().find(|mm| !is_size(*mm)) {
            Some(mm) => Err(DepthError::PixelSize(mm)),
            None => Ok(DepthTask {
                pixel_mm: Some(pixel_mm),
                ..self
            }),
        }
    }

    /// The same task with the mean map of training as the constant to beat.
    #[must_use]
    pub fn with_constant(self, constant: DepthMap) -> DepthTask {
        DepthTask {
            constant: Some(constant),
            ..self
        }
    }

    /// Gate: the depth above which a pixel is in contact, mm.
    #[must_use]
    pub fn gate_mm(&self) -> f64 {
        self.gate_mm
    }

    /// Distance of neighbouring columns and rows, mm; `None` if not given.
    pub(super) fn pixel_mm(&self) -> Option<[f64; 2]> {
        self.pixel_mm
    }

    /// Constant depth map to beat; `None` if not given.
    pub(super) fn constant(&self) -> Option<&DepthMap> {
        self.constant.as_ref()
    }

    /// Checks that `other` is the same task.
    pub(super) fn check_same(&self, other: &DepthTask) -> Result<(), TaskError> {
        if self == other {
            return Ok(());
        }
        let [ours, theirs] = [self, other].map(DepthTask::words);
        Err(TaskError::OtherDefinition {
            what: "depth tasks",
            ours,
            theirs,
        })
    }

    /// Definition in words.
    fn words(&self) -> String {
        let pixel = match self.pixel_mm {
            Some([x, y]) => format!("pixels of {x} x {y} mm"),
            None => "no size of a pixel".to_owned(),
        };
        let constant = match &self.constant {
            Some(constant) => format!("a mean map of {} pixels", constant.size_text()),
            None => "no mean map".to_owned(),
        };
        format!("gate {} mm, {pixel}, {constant}", self.gate_mm)
    }
}
