//! Paired sign-flip permutation test of two models on the same samples.

use super::cluster_sums::ClusterSums;
use super::difference::{Difference, DifferenceTest, Flips, Inverse, Tested};
use super::error::ComparisonError;
use super::paired_clusters::PairedClusters;
use super::random::bits;
use super::sides::Sides;
use super::signed_sums::SignedSums;
use crate::exact::Dyadic;

/// Test of equal errors of two models on the same samples.
///
/// Let D_c = Σ|d_A| − Σ|d_B| over the samples of cluster c, and T = Σ_c D_c. The errors of models A and B are d_A and d_B. If the models are equal,
/// each D_c could have the opposite sign with equal probability. |T| then has the distribution of |T*| = |Σ_c ± D_c|. For N random patterns of signs,
/// p = (1 + #{|T*| ≥ |T|}) / (1 + N). If G clusters have at most N patterns in all, 2^G, then p is the share of these patterns with |T*| ≥ |T|. Sums
/// and comparisons are exact, so ties are exact.
///
/// Random pattern i negates the c-th cluster, in the order of names, by one bit: bit c mod 64 of the hash of (seed, i, ⌊c / 64⌋). The result depends
/// only on the samples, the seed and the number of flips. Exchanging A and B does not change p.
///
/// For a success rate, a cluster is a board, and the sums over its samples are numbers of correct predictions.
///
/// ```
/// use taceva_metrics::{ClusterSums, Sides, SignFlip};
/// let (mut a, mut b) = (ClusterSums::default(), ClusterSums::default());
/// for (point, error_a, error_b) in [("p1", 0.1, 0.2), ("p2", 0.2, 0.4), ("p3", 0.1, 0.3), ("p4", 0.3, 0.35), ("p5", 0.2, 0.3)] {
///     a.try_add(point, error_a)?;
///     b.try_add(point, error_b)?;
/// }
/// let difference = SignFlip::default().test(Sides { a: &a, b: &b })?;
/// // Only the observed signs and all reversed signs give so large a sum: 2 of 2⁵ patterns.
/// assert_eq!(difference.p, 2.0 / 32.0);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
///
/// # Reference
/// Ernst, Permutation methods: a basis for exact inference, Statistical Science 19 (2004); Phipson and Smyth,
/// Permutation p-values should never be zero, Statistical Applications in Genetics and Molecular Biology 9 (2010).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SignFlip {
    /// Greatest number of patterns of signs.
    pub flips: u32,
    /// Seed of the patterns.
    pub seed: u64,
}

impl Default for SignFlip {
    /// Test with at most 10,000 patterns of signs and seed 0.
    fn default() -> SignFlip {
        SignFlip {
            flips: 10_000,
            seed: 0,
        }
    }
}

impl SignFlip {
    /// The same test with another greatest number of [`flips`](SignFlip::flips).
    #[must_use]
    pub const fn with_flips(self, flips: u32) -> SignFlip {
        SignFlip { flips, ..self }
    }

    /// The same test with another [`seed`](SignFlip::seed).
    #[must_use]
    pub const fn with_seed(self, seed: u64) -> SignFlip {
        SignFlip { seed, ..self }
    }

    /// Difference of the means over all samples. The standard error comes from the jackknife over clusters, the interval from the sign-flip test.
    ///
    /// The interval contains the differences δ whose p value is above the level. For each δ, the test flips the signs of D_c − δ n_c, with n_c
    /// samples in cluster c. A pattern of signs has two mean differences: of the negated clusters and of the other clusters. The pattern counts for p
    /// exactly if δ is between both means. Each end is therefore one of these means, found by counting.
    ///
    /// # Errors
    /// - [`ComparisonError::Unpaired`] or [`ComparisonError::Counts`] if the clusters of both sides differ in name or number of samples.
    /// - [`ComparisonError::TooFewClusters`] for fewer than five clusters with samples.
    /// - [`ComparisonError::NoInterval`] if a number exceeds the range of binary64.
    pub fn test(&self, sums: Sides<&ClusterSums>) -> Result<Difference, ComparisonError> {
        let pairs = PairedClusters::of(sums)?;
        let mean = pairs.mean_difference()?;
        let Tried { test, p, flips } = self.tried(&pairs, mean.freedom);
        let tested = Tested {
            value: mean.value,
            scores: mean.scores,
            standard_error: mean.standard_error,
            p,
            test,
        };
        Ok(tested.with(Inverse::Flips(flips)))
    }

    fn tried(&self, pairs: &PairedClusters, freedom: f64) -> Tried {
        let sums = SignedSums::new(pairs.differences());
        let observed = sums.magnitude(|_| false);
        let halves = Halves::of(pairs);
        let clusters = pairs.differences().len();
        let mut as_large = 0.0;
        let mut flips = Flips {
            from_below: Vec::new(),
            from_above: Vec::new(),
            freedom,
        };
        let mut try_pattern = |is_negated: &dyn Fn(usize) -> bool| {
            if sums.magnitude(is_negated) >= observed {
                as_large += 1.0;
            }
            let [below, above] = halves.means(is_negated);
            flips.from_below.push(below);
            flips.from_above.push(above);
        };
        let tried = |flips: u32, exhaustive| DifferenceTest::SignFlip {
            clusters,
            flips,
            exhaustive,
        };
        let test = if let Some(patterns) = self.all_patterns(clusters) {
            for pattern in 0..patterns {
                try_pattern(&|cluster| pattern >> cluster & 1 == 1);
            }
            tried(patterns, true)
        } else {
            // The observed signs are one pattern in addition to the drawn patterns.
            try_pattern(&|_| false);
            let mut signs = vec![0; clusters.div_ceil(64)];
            for flip in 0..self.flips {
                for (word, signs) in (0..).zip(&mut signs) {
                    *signs = bits(self.seed, flip.into(), word);
                }
                try_pattern(&|cluster| signs[cluster / 64] >> (cluster % 64) & 1 == 1);
            }
            tried(self.flips, false)
        };
        flips.from_below.sort_unstable_by(f64::total_cmp);
        flips.from_above.sort_unstable_by(f64::total_cmp);
        flips.from_above.reverse();
        let patterns = flips.from_below.iter().fold(0.0, |count, _| count + 1.0);
        Tried {
            test,
            p: as_large / patterns,
            flips,
        }
    }

    /// Number of all patterns, 2^clusters; `None` if above the number of flips.
    fn all_patterns(&self, clusters: usize) -> Option<u32> {
        let patterns = 2_u32.checked_pow(u32::try_from(clusters).ok()?)?;
        (patterns <= self.flips).then_some(patterns)
    }
}

/// Result of the sign-flip test over all tried patterns.
struct Tried {
    test: DifferenceTest,
    p: f64,
    flips: Flips,
}

/// Clusters, which each pattern of signs divides into two halves.
struct Halves {
    /// Number of samples, and sum of the terms of A minus sum of the terms of B, for each cluster.
    clusters: Vec<[f64; 2]>,
}

impl Halves {
    fn of(pairs: &PairedClusters) -> Halves {
        let clusters = pairs.counts().iter().zip(pairs.differences());
        let clusters = clusters.map(|(&count, difference)| {
            let count = Dyadic::from(count).over(&Dyadic::from(1));
            [count, difference.to_f64()]
        });
        Halves {
            clusters: clusters.collect(),
        }
    }

    /// Mean differences of both halves, the negated clusters and the others, smaller mean first. The means are infinite if one half is empty.
    fn means(&self, is_negated: &dyn Fn(usize) -> bool) -> [f64; 2] {
        let mut halves = [[0.0; 2]; 2];
        for (at, [count, difference]) in self.clusters.iter().enumerate() {
            let [samples, sum] = &mut halves[usize::from(is_negated(at))];
            *samples += count;
            *sum += difference;
        }
        let [[kept, kept_sum], [negated, negated_sum]] = halves;
        if kept > 0.0 && negated > 0.0 {
            let [one, other] = [kept_sum / kept, negated_sum / negated];
            [one.min(other), one.max(other)]
        } else {
            [f64::NEG_INFINITY, f64::INFINITY]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One sample per cluster, with an error of `errors_a` on side A and the error 1 on side B.
    fn sides(errors_a: &[f64]) -> Sides<ClusterSums> {
        let mut sums: Sides<ClusterSums> = Sides::default();
        for (at, &error_a) in errors_a.iter().enumerate() {
            let name = format!("p{at:03}");
            sums.a.try_add(&name, error_a).expect("finite");
            sums.b.try_add(&name, 1.0).expect("finite");
        }
        sums
    }

    fn test(sign_flip: SignFlip, sums: &Sides<ClusterSums>) -> Result<Difference, ComparisonError> {
        sign_flip.test(Sides {
            a: &sums.a,
            b: &sums.b,
        })
    }

    #[test]
    fn few_clusters_are_enumerated() {
        // Differences 1, 2, 3, 4, 5, −6, sum 9. If numbers of sum S among the magnitudes are negated, the sum is 21 − 2 S: at least 9 for S
        // ≤ 6, at most −9 for S ≥ 15. Subsets of {1…6} with sum 0…6: 1, 1, 1, 2, 2, 3, 4 = 14. As many have sum 15…21, by symmetry: p =
        // 28/64.
        let sums = sides(&[2.0, 3.0, 4.0, 5.0, 6.0, -5.0]);
        let difference = test(SignFlip::default(), &sums).expect("six clusters");
        assert_eq!(difference.p.to_bits(), (28.0_f64 / 64.0).to_bits());
        assert_eq!(difference.value.to_bits(), 1.5_f64.to_bits());
        let expected = DifferenceTest::SignFlip {
            clusters: 6,
            flips: 64,
            exhaustive: true,
        };
        assert_eq!(difference.test, expected);
        // A twentieth of 64 patterns is 3.2, so the fourth mean from below and from above counts. Two patterns have an empty half. The next
        // means are −6, of the last cluster alone, and 5, of the fifth, each twice.
        assert_eq!(
            difference.interval.map(f64::to_bits),
            [-6.0, 5.0].map(f64::to_bits)
        );
    }

    #[test]
    fn random_flips_come_near_to_the_enumeration() {
        let errors: Vec<f64> = (0..12).map(|at| 1.3 - f64::from(at % 5) * 0.2).collect();
        let sums = sides(&errors);
        let all = test(SignFlip::default(), &sums).expect("twelve clusters");
        let drawn = SignFlip {
            flips: 4095,
            seed: 3,
        };
        let drawn = test(drawn, &sums).expect("twelve clusters");
        assert!(matches!(
            drawn.test,
            DifferenceTest::SignFlip {
                exhaustive: false,
                ..
            }
        ));
        // Four standard errors of a share of 4095.
        let error = 4.0 * (all.p * (1.0 - all.p) / 4095.0).sqrt();
        assert!((drawn.p - all.p).abs() < error, "{} {}", drawn.p, all.p);
    }

    #[test]
    fn a_difference_everywhere_has_the_least_p_there_is() {
        let sums = sides(&[0.5; 100]);
        let difference = test(SignFlip::default(), &sums).expect("a hundred clusters");
        assert_eq!(difference.p.to_bits(), (1.0_f64 / 10_001.0).to_bits());
    }

    #[test]
    fn models_that_agree_everywhere_have_p_one() {
        let difference = test(SignFlip::default(), &sides(&[1.0; 20])).expect("twenty clusters");
        assert_eq!(difference.p.to_bits(), 1.0_f64.to_bits());
        assert_eq!(difference.interval.map(f64::abs).map(f64::to_bits), [0, 0]);
    }

    #[test]
    fn what_is_not_the_same_samples_is_refused_by_name() {
        let mut more = sides(&[1.0; 6]);
        more.a.try_add("p003", 1.0).expect("finite");
        let error = test(SignFlip::default(), &more).expect_err("two samples beside one");
        let expected = "cluster `p003` has 2 samples in A and 1 in B, expected the same samples";
        assert_eq!(error.to_string(), expected);
        let mut another = sides(&[1.0; 6]);
        another.b.try_add("p9", 1.0).expect("finite");
        let error = test(SignFlip::default(), &another).expect_err("a cluster of B alone");
        assert_eq!(
            error.to_string(),
            "cluster `p9` is in B only, expected the same samples"
        );
        let error = test(SignFlip::default(), &sides(&[1.0; 4])).expect_err("four clusters");
        assert_eq!(error, ComparisonError::TooFewClusters { have: 4 });
    }
}
