//! Comparison of two scores of the same labels, cluster by cluster.

use taceva_metrics::{ClusterSum, ClusterSums, Difference, Sides, SignFlip};

use super::Subject;

/// Divisor 2⁴⁰. The part of each cluster in a score is rounded to a multiple of about 1/2⁴⁰ of [`Parts::greatest`].
const FINE: f64 = 1_099_511_627_776.0;

/// Tests the difference of two scores by the signs of the clusters, or returns the reason why this is impossible.
///
/// The part of a cluster in a score is n s − n′ s′: score s of all n samples, score s′ of the n′ samples of other clusters. For a mean over samples,
/// the part is the sum over the cluster. For other scores the part is the sum to first order. The parts are shifted so that their mean is the score.
pub(super) fn difference(subjects: Sides<Subject<'_>>, seed: u64) -> Result<Difference, String> {
    let Sides { a, b } = subjects;
    let between = format!("{} and {}", a.result.name, b.result.name);
    let labels = a.result.labels();
    if labels.is_empty() || labels != b.result.labels() {
        return Err(format!(
            "{between} have different labels: compared by the intervals of both"
        ));
    }
    let parts = |side: Subject<'_>| {
        Parts::of(side).map_err(|reason| {
            format!(
                "{between} have the same labels, but {} is compared by the intervals of both: {} {reason}",
                side.score.named(),
                side.result.name
            )
        })
    };
    let [of_a, of_b] = [parts(a)?, parts(b)?];
    let grain = grain(of_a.greatest.max(of_b.greatest));
    let sums = [of_a, of_b].map(|parts| parts.on_grid(grain));
    let both = Sides {
        a: &sums[0],
        b: &sums[1],
    };
    let tested = SignFlip::default().with_seed(seed).test(both);
    tested.map_err(|error| {
        format!(
            "{between} are compared by the intervals of {}: {error}",
            a.score.named()
        )
    })
}

/// Parts of the clusters in a score.
struct Parts {
    clusters: Vec<Part>,
    /// Greatest magnitude of the number of samples times a score: the score of all samples, and the score without each cluster.
    greatest: f64,
}

/// Part of one cluster in a score.
struct Part {
    name: String,
    count: u64,
    sum: f64,
}

impl Parts {
    /// Part of the score for each cluster, or the reason why a cluster has no part.
    fn of(side: Subject<'_>) -> Result<Parts, &'static str> {
        const SOME_CLUSTERS: &str = "has clusters without a part in the score";
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
        let mut greatest = all * value.abs();
        let mut clusters = Vec::with_capacity(left_out.len());
        for (name, part) in side.task.clusters.iter().zip(left_out) {
            let without = part.value.map_err(|_| SOME_CLUSTERS)?;
            greatest = greatest.max(all * without.abs());
            clusters.push(Part {
                name: name.clone(),
                count: part.count,
                sum: all * value - (all - part.count as f64) * without,
            });
        }
        let mean = clusters.iter().map(|part| part.sum).sum::<f64>() / all;
        for part in &mut clusters {
            part.sum += part.count as f64 * (value - mean);
        }
        Ok(Parts { clusters, greatest })
    }

    /// The parts as multiples of `grain`. Sums of counts become integers, so equal clusters of two models have equal bits.
    fn on_grid(self, grain: f64) -> ClusterSums {
        let sums = self.clusters.into_iter().map(|part| {
            let mut sum = ClusterSum::default();
            sum.sum.add((part.sum / grain).round() * grain);
            sum.n += part.count;
            (part.name, sum)
        });
        sums.collect()
    }
}

/// Power of two near `greatest` / 2⁴⁰.
fn grain(greatest: f64) -> f64 {
    let mut grain = 1.0;
    while grain * FINE < greatest {
        grain *= 2.0;
    }
    while grain * FINE > 2.0 * greatest && grain > f64::MIN_POSITIVE {
        grain /= 2.0;
    }
    grain
}
