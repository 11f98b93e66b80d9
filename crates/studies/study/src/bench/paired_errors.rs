//! Absolute errors of two models on the same samples, paired by contact point.

use taceva_metrics::{ClusterSums, Difference, Sides, SignFlip};

use taceva_evaluate::Predicted;

/// Sums of the absolute errors in `predicted` by contact point, for each channel; `None` if the samples have no contact points.
pub(super) fn absolute_errors(predicted: &Predicted) -> Vec<Option<ClusterSums>> {
    let of = |position: usize| {
        let points = predicted.points()?;
        let mut sums = ClusterSums::default();
        for (row, point) in points.iter().enumerate() {
            let estimate = predicted.prediction()[position].get(row);
            let pair = estimate.zip(predicted.truth()[position].get(row));
            if let Some((estimate, truth)) = pair {
                sums.try_add(point, (estimate - truth).abs()).ok()?;
            }
        }
        Some(sums)
    };
    (0..predicted.channels().len()).map(of).collect()
}

/// Mean absolute error of `a` minus that of `b`, tested by contact point; `None` without contact points, or with too few of them.
pub(super) fn difference([a, b]: [Option<&ClusterSums>; 2]) -> Option<Difference> {
    SignFlip::default().test(Sides { a: a?, b: b? }).ok()
}
