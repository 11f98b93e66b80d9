//! Comparison of two scores of the same labels, cluster by cluster.

use taceva_metrics::{ClusterSum, ClusterSums, Difference, Sides, SignFlip};

use super::Subject;

/// Tests equal scores by the signs of the clusters, or returns the reason why the results do not pair.
///
/// Each cluster has its part of a score: the score of all samples, with the samples of all clusters as weights, minus the score without the cluster,
/// with the samples of the others as weights. For a mean over samples, the part is the sum over the cluster. For other scores it is the sum to first
/// order. The parts are shifted to have the score as their mean, so that the difference is that of the scores.
pub(super) fn difference(subjects: Sides<Subject<'_>>, seed: u64) -> Result<Difference, String> {
    let Sides { a, b } = subjects;
    let between = format!("{} and {}", a.result.name, b.result.name);
    let labels = a.result.labels();
    if labels.is_empty() || labels != b.result.labels() {
        return Err(format!(
            "{between} have other labels: compared by the intervals of both"
        ));
    }
    let parts = |side: Subject<'_>| {
        parts(side).map_err(|reason| {
            format!(
                "{between} have the same labels, but {} is compared by the intervals of both: {} {reason}",
                side.score.named(),
                side.result.name
            )
        })
    };
    let sums = Sides {
        a: parts(a)?,
        b: parts(b)?,
    };
    let both = Sides {
        a: &sums.a,
        b: &sums.b,
    };
    let tested = SignFlip::default().with_seed(seed).test(both);
    tested.map_err(|error| {
        format!(
            "{between} are compared by the intervals of {}: {error}",
            a.score.named()
        )
    })
}

/// Part of the score for each cluster, or the reason why it has none.
fn parts(side: Subject<'_>) -> Result<ClusterSums, &'static str> {
    const SOME_CLUSTERS: &str = "has clusters without a part in it";
    let left_out = &side.score.left_out;
    let value = side.score.estimate.value.ok_or(SOME_CLUSTERS)?;
    if side.task.clusters.is_empty() {
        return Err(
            "has no state: name states, or write NAME.state beside NAME.json with --state-out",
        );
    }
    if left_out.len() != side.task.clusters.len() {
        return Err(SOME_CLUSTERS);
    }
    let all: f64 = left_out.iter().map(|part| part.count as f64).sum();
    let parts = left_out.iter().map(|part| {
        let without = part.value.ok()?;
        Some(all * value - (all - part.count as f64) * without)
    });
    let parts: Option<Vec<f64>> = parts.collect();
    let parts = parts.ok_or(SOME_CLUSTERS)?;
    let shift = value - parts.iter().sum::<f64>() / all;
    let clusters = side.task.clusters.iter().zip(left_out).zip(parts);
    let sums = clusters.map(|((name, of), part)| {
        let mut sum = ClusterSum::default();
        sum.sum.add(part + of.count as f64 * shift);
        sum.n += of.count;
        (name.clone(), sum)
    });
    Ok(sums.collect())
}
