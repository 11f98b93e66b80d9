//! Features of samples: the numeric input of a model.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use super::ModelError;
use crate::error::ErrorKind;

/// Shape of one sample's features: a small picture, or a flat list. A plain value, which gets no further fields.
///
/// ```
/// use taceva_core::FeatureShape;
/// let picture = FeatureShape { height: 32, width: 32, depth: 3 };
/// assert_eq!((picture.len(), FeatureShape::flat(20).len()), (3072, 20));
/// assert_eq!(picture.to_string(), "32×32×3");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FeatureShape {
    /// Number of rows; 1 for a flat list.
    pub height: usize,
    /// Number of columns; the length of a flat list.
    pub width: usize,
    /// Numbers per pixel: 1 for gray and for a flat list, 3 for RGB.
    pub depth: usize,
}

impl fmt::Display for FeatureShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{}×{}", self.height, self.width, self.depth)
    }
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

    /// True if a sample has no numbers.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Features of a set of samples, sample by sample. Copies and consecutive selections share the memory.
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
#[derive(Clone, Debug)]
pub struct Features {
    shape: FeatureShape,
    memory: Arc<Vec<f32>>,
    /// Range of these values within the shared memory.
    place: Range<usize>,
}

impl PartialEq for Features {
    fn eq(&self, other: &Features) -> bool {
        self.shape == other.shape && self.values() == other.values()
    }
}

impl Features {
    /// Features of `shape`. The number of samples follows from the number of values.
    ///
    /// # Errors
    /// [`ModelError`] if the number of values is not a multiple of the numbers per sample.
    pub fn new(shape: FeatureShape, values: Vec<f32>) -> Result<Features, ModelError> {
        let whole = match shape.len() {
            0 => values.is_empty(),
            length => values.len() % length == 0,
        };
        if !whole {
            let message = format!(
                "{} values, expected a multiple of the {} values of a sample",
                values.len(),
                shape.len()
            );
            return Err(ModelError::new(ErrorKind::InvalidArgument, message));
        }
        Ok(Features::of(shape, values))
    }

    fn of(shape: FeatureShape, values: Vec<f32>) -> Features {
        Features {
            shape,
            place: 0..values.len(),
            memory: Arc::new(values),
        }
    }

    /// The shape of one sample.
    pub fn shape(&self) -> FeatureShape {
        self.shape
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        match self.shape.len() {
            0 => 0,
            length => self.place.len() / length,
        }
    }

    /// All values.
    pub fn values(&self) -> &[f32] {
        &self.memory[self.place.clone()]
    }

    /// The values of one sample.
    pub fn sample(&self, position: usize) -> &[f32] {
        let length = self.shape.len();
        &self.values()[position * length..(position + 1) * length]
    }

    /// Samples at `positions`, in that order. Consecutive positions need no copy.
    ///
    /// # Panics
    /// If a position is out of range.
    pub fn select(&self, positions: &[usize]) -> Features {
        let follow = |pair: &[usize]| pair[1] == pair[0] + 1;
        if let (Some(first), Some(last)) = (positions.first(), positions.last())
            && positions.windows(2).all(follow)
        {
            assert!(*last < self.samples(), "a sample out of range");
            let length = self.shape.len();
            let begin = self.place.start;
            return Features {
                shape: self.shape,
                memory: Arc::clone(&self.memory),
                place: begin + first * length..begin + (last + 1) * length,
            };
        }
        let values = positions
            .iter()
            .flat_map(|&position| self.sample(position))
            .copied();
        Features::of(self.shape, values.collect())
    }

    /// Concatenates these samples and the samples of `other`. Ranges adjacent in the same memory need no copy.
    ///
    /// ```
    /// use taceva_core::{FeatureShape, Features};
    /// let all = Features::new(FeatureShape::flat(1), vec![0.1, 0.2, 0.3])?;
    /// let (train, validation) = (all.select(&[0, 1]), all.select(&[2]));
    /// assert_eq!(train.followed_by(&validation)?, all);
    /// # Ok::<(), taceva_core::ModelError>(())
    /// ```
    ///
    /// # Errors
    /// [`ModelError`] if the samples of `other` have another shape.
    pub fn followed_by(&self, other: &Features) -> Result<Features, ModelError> {
        if self.shape != other.shape {
            let message = format!(
                "samples of {} features, expected {} as in the samples before",
                other.shape.len(),
                self.shape.len()
            );
            return Err(ModelError::new(ErrorKind::InvalidArgument, message));
        }
        let is_next =
            Arc::ptr_eq(&self.memory, &other.memory) && self.place.end == other.place.start;
        Ok(match is_next {
            true => Features {
                shape: self.shape,
                memory: Arc::clone(&self.memory),
                place: self.place.start..other.place.end,
            },
            false => Features::of(self.shape, [self.values(), other.values()].concat()),
        })
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

    #[test]
    fn samples_that_follow_each_other_are_shared_and_others_copied() {
        let values: Vec<f32> = (0..12).map(|value: u8| value.into()).collect();
        let all = Features::new(FeatureShape::flat(2), values).expect("six samples");
        let (first, second) = (all.select(&[1, 2]), all.select(&[3, 4]));
        assert_eq!(first.values().as_ptr(), all.sample(1).as_ptr());
        assert_eq!(second.select(&[1]).values(), [8.0, 9.0]);
        let both = first.followed_by(&second).expect("one shape");
        assert_eq!((both.samples(), both.values()), (4, &all.values()[2..10]));
        assert_eq!(both.values().as_ptr(), first.values().as_ptr());
        let turned = second.followed_by(&first).expect("one shape");
        assert_eq!(turned, all.select(&[3, 4, 1, 2]));
        assert_eq!(all.select(&[]).samples(), 0);
        let other = Features::new(FeatureShape::flat(3), vec![0.0; 3]).expect("one sample");
        assert!(first.followed_by(&other).is_err());
    }
}
