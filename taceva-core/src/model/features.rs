//! The features of samples: the numbers that a model takes.

use super::ModelError;
use crate::error::ErrorKind;

/// The shape of one sample's features: a small picture, or a flat list. A plain value, which gets no further fields.
///
/// ```
/// use taceva_core::FeatureShape;
/// let picture = FeatureShape { height: 32, width: 32, depth: 3 };
/// assert_eq!((picture.len(), FeatureShape::flat(20).len()), (3072, 20));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FeatureShape {
    /// Rows; 1 for a flat list.
    pub height: usize,
    /// Columns; the length of a flat list.
    pub width: usize,
    /// Numbers per place: 1 for gray and for a flat list, 3 for RGB.
    pub depth: usize,
}

impl FeatureShape {
    /// A flat list of `length` numbers.
    pub const fn flat(length: usize) -> FeatureShape {
        FeatureShape {
            height: 1,
            width: length,
            depth: 1,
        }
    }

    /// Numbers per sample.
    pub const fn len(&self) -> usize {
        self.height * self.width * self.depth
    }

    /// Whether a sample has no number.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The features of some samples, sample by sample.
///
/// # Shapes
/// `[samples, height, width, depth]`, contiguous.
///
/// ```
/// use taceva_core::{FeatureShape, Features};
/// let features = Features::new(FeatureShape::flat(2), vec![0.1, 0.2, 0.3, 0.4])?;
/// assert_eq!((features.samples(), features.sample(1)), (2, &[0.3, 0.4][..]));
/// # Ok::<(), taceva_core::ModelError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Features {
    shape: FeatureShape,
    values: Vec<f32>,
}

impl Features {
    /// Features of `shape`; the number of samples follows from the number of values.
    ///
    /// # Errors
    /// [`ModelError`] if the values are no whole number of samples.
    pub fn new(shape: FeatureShape, values: Vec<f32>) -> Result<Features, ModelError> {
        let whole = match shape.len() {
            0 => values.is_empty(),
            length => values.len() % length == 0,
        };
        if !whole {
            let message = format!(
                "{} values are no whole number of samples of {}",
                values.len(),
                shape.len()
            );
            return Err(ModelError::new(ErrorKind::InvalidArgument, message));
        }
        Ok(Features { shape, values })
    }

    /// The shape of one sample.
    pub fn shape(&self) -> FeatureShape {
        self.shape
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        match self.shape.len() {
            0 => 0,
            length => self.values.len() / length,
        }
    }

    /// All values.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The values of one sample.
    pub fn sample(&self, position: usize) -> &[f32] {
        let length = self.shape.len();
        &self.values[position * length..(position + 1) * length]
    }

    /// The samples at `positions`, in that order.
    pub fn select(&self, positions: &[usize]) -> Features {
        let values = positions
            .iter()
            .flat_map(|&position| self.sample(position))
            .copied()
            .collect();
        Features {
            shape: self.shape,
            values,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selected_samples_come_in_the_order_asked_for() {
        let features = Features::new(FeatureShape::flat(2), vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0])
            .expect("three samples");
        assert_eq!(features.select(&[2, 0]).values(), [4.0, 5.0, 0.0, 1.0]);
    }

    #[test]
    fn a_broken_sample_is_refused() {
        let error =
            Features::new(FeatureShape::flat(2), vec![0.0; 3]).expect_err("one and a half samples");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    }
}
