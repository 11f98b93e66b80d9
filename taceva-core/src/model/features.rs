//! Numbers that a model takes as input, computed from samples.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use super::ModelError;
use crate::error::ErrorKind;

/// Shape of the features of one sample: a small picture or a flat list. This struct gets no further fields: a picture has three dimensions.
///
/// ```
/// use taceva_core::FeatureShape;
/// let picture = FeatureShape { height: 32, width: 32, depth: 3 };
/// assert_eq!((picture.len(), FeatureShape::flat(20).len()), (3072, 20));
/// assert_eq!(picture.to_string(), "32×32×3");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FeatureShape {
    /// Rows of the picture; 1 for a flat list.
    pub height: usize,
    /// Columns of the picture; the length of a flat list.
    pub width: usize,
    /// Values per pixel: 1 for gray and for a flat list, 3 for RGB.
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

    /// Number of feature values per sample.
    pub const fn len(&self) -> usize {
        self.height * self.width * self.depth
    }

    /// True if the shape has no feature values.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Features of a list of samples. Clones, and selections of consecutive samples, share one buffer.
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
    /// Range of the values of these samples in the shared buffer.
    place: Range<usize>,
}

impl PartialEq for Features {
    fn eq(&self, other: &Features) -> bool {
        self.shape == other.shape && self.values() == other.values()
    }
}

impl Features {
    /// Creates features of `shape` from `values`, sample by sample. The number of values determines the number of samples.
    ///
    /// # Errors
    /// [`ModelError`] if the number of values is not a multiple of the feature values per sample.
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

    /// Shape of the features of one sample.
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

    /// Feature values of all samples, sample by sample.
    pub fn values(&self) -> &[f32] {
        &self.memory[self.place.clone()]
    }

    /// Feature values of the sample at `position`, counted from 0.
    pub fn sample(&self, position: usize) -> &[f32] {
        let length = self.shape.len();
        &self.values()[position * length..(position + 1) * length]
    }

    /// Features of the samples at `positions`, in the order of `positions`. Consecutive positions are selected without a copy.
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

    /// Appends the samples of `other`. Two neighbouring parts of one buffer are joined without a copy.
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
