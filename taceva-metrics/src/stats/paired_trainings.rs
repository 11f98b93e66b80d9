//! Comparison of two models on the same samples, with variation between trainings.

use super::by_intervals::LEAST_P;
use super::cluster_sums::ClusterSums;
use super::difference::{Difference, DifferenceTest, Inverse, Tested};
use super::error::ComparisonError;
use super::paired_clusters::PairedClusters;
use super::parts::Part;
use super::sides::Sides;
use super::student::upper;
use super::trainings::TrainingSpread;

/// Compares two models on the same samples, with the variation between trainings.
///
/// Let D be the difference of the means over all samples. Let s be its jackknife standard error over G clusters, with G − 1 degrees of freedom. Let
/// sᵢ be the standard errors between trainings, from `spreads`. Then t = D / √(s² + Σ sᵢ²) follows Student's distribution, with degrees of freedom by
/// Welch and Satterthwaite. A sign-flip test is not used, because signs of clusters cannot show the effect of another training.
///
/// ```
/// use taceva_metrics::{ClusterSums, Sides, TrainingSpread, paired_over_trainings};
/// let (mut a, mut b) = (ClusterSums::default(), ClusterSums::default());
/// for (point, error_a, error_b) in [("p1", 0.1, 0.2), ("p2", 0.2, 0.4), ("p3", 0.1, 0.3), ("p4", 0.3, 0.35), ("p5", 0.2, 0.3)] {
///     a.try_add(point, error_a)?;
///     b.try_add(point, error_b)?;
/// }
/// let both = Sides { a: &a, b: &b };
/// let alike = paired_over_trainings(both, &[])?;
/// let spread = TrainingSpread::of_one(&[0.1, 0.2, 0.3]).ok_or("three trainings")?;
/// let apart = paired_over_trainings(both, &[spread])?;
/// assert!(alike.is_shown && !apart.is_shown && apart.p > alike.p);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The errors of [`SignFlip::test`](crate::SignFlip::test); [`ComparisonError::NoSpread`] if neither clusters nor trainings vary.
pub fn paired_over_trainings(
    sums: Sides<&ClusterSums>,
    spreads: &[TrainingSpread],
) -> Result<Difference, ComparisonError> {
    let pairs = PairedClusters::of(sums)?;
    let mean = pairs.mean_difference()?;
    let clusters = Part {
        standard_error: mean.standard_error,
        freedom: mean.freedom,
    };
    let all = spreads.iter().fold(clusters, |all, spread| {
        all.with(Part {
            standard_error: spread.standard_error,
            freedom: spread.freedom,
        })
    });
    if all.standard_error <= 0.0 {
        return Err(ComparisonError::NoSpread);
    }
    if !all.standard_error.is_finite() {
        return Err(ComparisonError::StandardError(all.standard_error));
    }
    let apart = mean.value.abs() / all.standard_error;
    let tested = Tested {
        value: mean.value,
        scores: mean.scores,
        standard_error: all.standard_error,
        p: (2.0 * upper(apart, all.freedom)).clamp(LEAST_P, 1.0),
        test: DifferenceTest::PairedTrainings {
            clusters: pairs.counts().len(),
            freedom: all.freedom,
        },
    };
    Ok(tested.with(Inverse::Student {
        freedom: all.freedom,
    }))
}
