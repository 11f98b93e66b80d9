//! Linear discriminant analysis, for classes with different means and equal covariance.

use std::ops::Range;

use faer::Mat;
use taceva_core::{ErrorKind, ModelError, Progress, SilentProgress};

use super::scatter::{Blocks, Scatter, means, whitening};

/// Predicts the class with the nearest mean, in features whitened by the covariance within classes.
///
/// A sample with features x gets the class c of least (x − μ_c)ᵀ S*⁻¹ (x − μ_c). μ_c is the mean of class c, and all classes have equal prior
/// probabilities. S is the covariance within classes. For p features, S* = ρ m I + (1 − ρ) S with m = tr S / p and the identity matrix I. The share ρ
/// minimises the expected squared error of S* as an estimate of the covariance. S* can therefore be inverted even for few samples of many features.
///
/// # Reference
/// Fisher (1936) for the discriminant. Ledoit and Wolf (2004), A well-conditioned estimator for large-dimensional covariance matrices,
/// equations 9 to 14, for ρ.
#[derive(Clone, Debug)]
pub struct Discriminant {
    /// Whitening matrix, shape `[features, features]`.
    whitening: Mat<f64>,
    /// Mean of the whitened features of each class; `None` for a class without samples.
    centres: Vec<Option<Vec<f64>>>,
}

impl Discriminant {
    /// Fits the classifier to the samples `features`. `classes` contains the class number of each sample.
    ///
    /// # Shapes
    /// `features`: `[samples][features]`; `classes`: `[samples]`.
    /// # Errors
    /// [`ModelError`] of kind `InvalidArgument` without samples, or if lengths differ.
    pub fn fit(features: &[Vec<f64>], classes: &[usize]) -> Result<Discriminant, ModelError> {
        let length = features.first().map_or(0, Vec::len);
        let is_whole = features.iter().all(|sample| sample.len() == length);
        if length == 0 || !is_whole || features.len() != classes.len() {
            let message = format!(
                "{} samples of features and {} classes, expected one class for each sample, at least one sample, and samples of one length",
                features.len(),
                classes.len()
            );
            return Err(ModelError::new(ErrorKind::InvalidArgument, message));
        }
        let blocks = |samples: Range<usize>| {
            Mat::from_fn(length, samples.len(), |row, column| {
                features[samples.start + column][row]
            })
        };
        Discriminant::of_blocks(&blocks, classes, &SilentProgress)
    }

    /// Fits the classifier to samples that are read in blocks.
    pub(super) fn of_blocks(
        blocks: &Blocks<'_>,
        classes: &[usize],
        progress: &dyn Progress,
    ) -> Result<Discriminant, ModelError> {
        let means = means(blocks, classes);
        let scatter = Scatter::of(blocks, classes, &means, progress)?;
        let whitening = whitening(&scatter.shrunk())?;
        let centres = means
            .into_iter()
            .map(|mean| mean.map(|mean| applied(&whitening, &mean)))
            .collect();
        Ok(Discriminant { whitening, centres })
    }

    /// Weights w and offset b for each class with samples. For features x, the predicted class has the greatest wᵀx + b.
    pub(super) fn planes(&self) -> Vec<(Vec<f64>, f64)> {
        let turned = self.whitening.transpose().to_owned();
        let plane = |centre: &Vec<f64>| {
            let square: f64 = centre.iter().map(|value| value * value).sum();
            (applied(&turned, centre), -0.5 * square)
        };
        self.centres.iter().flatten().map(plane).collect()
    }

    /// Predicts the class of `features`. Of equally near classes, returns the first.
    pub fn class(&self, features: &[f64]) -> usize {
        let round = applied(&self.whitening, features);
        let distance = |centre: &Vec<f64>| -> f64 {
            let sides = centre.iter().zip(&round);
            sides.map(|(centre, value)| (centre - value).powi(2)).sum()
        };
        let classes = self.centres.iter().enumerate();
        let distances =
            classes.filter_map(|(class, centre)| Some((class, distance(centre.as_ref()?))));
        let nearest = distances.min_by(|(_, one), (_, other)| one.total_cmp(other));
        nearest.map_or(0, |(class, _)| class)
    }
}

fn applied(matrix: &Mat<f64>, vector: &[f64]) -> Vec<f64> {
    let row = |row: usize| -> f64 {
        let places = vector.iter().enumerate();
        places
            .map(|(column, value)| matrix[(row, column)] * value)
            .sum()
    };
    (0..matrix.nrows()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::random::SplitMix64;

    /// Samples of two classes with two features. The class means are close, and both classes vary far more along the diagonal.
    fn tilted(samples: usize, seed: u64) -> (Vec<Vec<f64>>, Vec<usize>) {
        let mut random = SplitMix64::new(seed);
        let mut uniform = || {
            let draw = u32::try_from(random.next_u64() >> 32).expect("32 bits");
            f64::from(draw) / f64::from(u32::MAX) - 0.5
        };
        let mut sample = |number: usize| {
            let class = number % 2;
            let along = 40.0 * uniform();
            let shift = if class == 0 { -0.5 } else { 0.5 };
            (
                vec![
                    along + shift + 0.2 * uniform(),
                    along - shift + 0.2 * uniform(),
                ],
                class,
            )
        };
        (0..samples).map(&mut sample).unzip()
    }

    #[test]
    fn classes_are_separated_across_a_scatter_wider_than_their_distance() {
        let (features, classes) = tilted(200, 1);
        let discriminant = Discriminant::fit(&features, &classes).expect("fits");
        let (unseen, expected) = tilted(200, 2);
        let found: Vec<usize> = unseen
            .iter()
            .map(|sample| discriminant.class(sample))
            .collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn of_one_sample_a_class_the_nearest_is_predicted() {
        let features = vec![vec![0.0, 1.0], vec![4.0, 1.0], vec![9.0, 1.0]];
        let discriminant = Discriminant::fit(&features, &[0, 2, 5]).expect("fits");
        let found = [1.0, 3.0, 8.0].map(|x| discriminant.class(&[x, 5.0]));
        assert_eq!(found, [0, 2, 5]);
    }

    #[test]
    fn the_shrinkage_is_that_of_its_authors() {
        // By hand: S = diag(2, ½), m = 5/4, ‖S − mI‖² = 9/8; of each sample ‖xxᵀ − S‖² = 17/4, of which the sum over n² is 17/16.
        let deviations = [[2.0, 0.0], [-2.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(Vec::from);
        let blocks = |samples: Range<usize>| {
            Mat::from_fn(2, samples.len(), |row, column| {
                deviations[samples.start + column][row]
            })
        };
        let still = [Some(vec![0.0, 0.0])];
        let scatter =
            Scatter::of(&blocks, &[0; 4], &still, &SilentProgress).expect("nobody cancels");
        let scatter = scatter.shrunk();
        let share = (17.0 / 16.0) / (9.0 / 8.0);
        assert!((scatter[(0, 0)] - (share * 1.25 + (1.0 - share) * 2.0)).abs() < 1e-12);
        assert!((scatter[(1, 1)] - (share * 1.25 + (1.0 - share) * 0.5)).abs() < 1e-12);
    }

    #[test]
    fn the_greatest_plane_is_that_of_the_nearest_centre() {
        let (features, classes) = tilted(200, 3);
        let discriminant = Discriminant::fit(&features, &classes).expect("fits");
        let planes = discriminant.planes();
        for sample in tilted(50, 4).0 {
            let heights = planes.iter().map(|(weights, offset)| {
                let products = weights.iter().zip(&sample).map(|(w, x)| w * x);
                products.sum::<f64>() + offset
            });
            let heights: Vec<f64> = heights.collect();
            assert_eq!(
                usize::from(heights[1] > heights[0]),
                discriminant.class(&sample)
            );
        }
    }

    #[test]
    fn what_does_not_fit_together_is_refused() {
        assert!(Discriminant::fit(&[], &[]).is_err());
        assert!(Discriminant::fit(&[vec![1.0]], &[0, 1]).is_err());
        assert!(Discriminant::fit(&[vec![1.0], vec![1.0, 2.0]], &[0, 1]).is_err());
    }
}
