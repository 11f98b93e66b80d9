//! Two models on the same samples: the paired sign-flip permutation test.

use super::cluster_sums::ClusterSums;
use super::difference::{Difference, DifferenceTest};
use super::error::ComparisonError;
use super::paired_clusters::PairedClusters;
use super::random::bits;
use super::sides::Sides;
use super::signed_sums::SignedSums;
use crate::exact::ExactSum;

/// A test of whether two models are equally far from the truth, on the same samples.
///
/// With D_c = Σ|d_A| − Σ|d_B| of cluster c and T = Σ_c D_c: if the models were alike, each D_c might as well have the other
/// sign, so that |T| would be among the |T*| = |Σ_c ± D_c|. Over N patterns of signs drawn at random
/// p = (1 + #{|T*| ≥ |T|}) / (1 + N); where all 2^G patterns are no more than that, p is the share of all of them with
/// |T*| ≥ |T|. Sums and comparisons are exact, so that ties are ties.
///
/// Flip i negates the c-th cluster, in the order of names, if bit c mod 64 of the hash of (seed, i, ⌊c / 64⌋) is set: the
/// result depends on the samples, the seed and the number of flips alone, and exchanging A and B keeps p.
///
/// Hits of a success rate are compared the same way, board by board: Σ is then the number of hits.
///
/// ```
/// use taceva_metrics::{ClusterSums, Sides, SignFlip};
/// let (mut a, mut b) = (ClusterSums::default(), ClusterSums::default());
/// for (point, error_a, error_b) in [("p1", 0.1, 0.2), ("p2", 0.2, 0.4), ("p3", 0.1, 0.3), ("p4", 0.3, 0.35), ("p5", 0.2, 0.3)] {
///     a.try_add(point, error_a)?;
///     b.try_add(point, error_b)?;
/// }
/// let difference = SignFlip::default().test(Sides { a: &a, b: &b })?;
/// // Only all signs as they are and all reversed give so large a sum: 2 of 2⁵ patterns.
/// assert_eq!(difference.p, 2.0 / 32.0);
/// # Ok::<(), taceva_metrics::ComparisonError>(())
/// ```
///
/// # Reference
/// Ernst, Permutation methods: a basis for exact inference, Statistical Science 19 (2004); Phipson and Smyth,
/// Permutation p-values should never be zero, Statistical Applications in Genetics and Molecular Biology 9 (2010).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SignFlip {
    /// How many patterns of signs are drawn at most.
    pub flips: u32,
    /// The seed they are drawn with.
    pub seed: u64,
}

impl Default for SignFlip {
    /// 10,000 flips, seed 0.
    fn default() -> SignFlip {
        SignFlip {
            flips: 10_000,
            seed: 0,
        }
    }
}

impl SignFlip {
    /// The difference of the means over all samples; its standard error by leaving out one cluster after the other.
    ///
    /// # Errors
    /// [`ComparisonError::Unpaired`] or [`ComparisonError::Counts`] if the two do not have the same clusters with as many
    /// samples, [`ComparisonError::TooFewClusters`] if there are fewer than five with samples,
    /// [`ComparisonError::NoInterval`] if a number is beyond the range of binary64.
    pub fn test(&self, sums: Sides<&ClusterSums>) -> Result<Difference, ComparisonError> {
        let pairs = PairedClusters::of(sums)?;
        let spread = pairs.spread()?;
        let (test, p) = self.p(pairs.differences());
        spread.tested(test, p)
    }

    fn p(&self, differences: &[ExactSum]) -> (DifferenceTest, f64) {
        let sums = SignedSums::new(differences);
        let observed = sums.magnitude(|_| false);
        let clusters = differences.len();
        let tried = |flips: u32, exhaustive| DifferenceTest::SignFlip {
            clusters,
            flips,
            exhaustive,
        };
        if let Some(patterns) = self.all_patterns(clusters) {
            let as_large = (0..patterns).filter(|pattern| {
                sums.magnitude(|cluster| pattern >> cluster & 1 == 1) >= observed
            });
            let share = count(as_large) / f64::from(patterns);
            return (tried(patterns, true), share);
        }
        let mut signs = vec![0; clusters.div_ceil(64)];
        let as_large = (0..self.flips).filter(|&flip| {
            for (word, signs) in (0..).zip(&mut signs) {
                *signs = bits(self.seed, flip.into(), word);
            }
            sums.magnitude(|cluster| signs[cluster / 64] >> (cluster % 64) & 1 == 1) >= observed
        });
        let share = (1.0 + count(as_large)) / (1.0 + f64::from(self.flips));
        (tried(self.flips, false), share)
    }

    /// 2^clusters, if that is not more than the flips to draw.
    fn all_patterns(&self, clusters: usize) -> Option<u32> {
        let patterns = 2_u32.checked_pow(u32::try_from(clusters).ok()?)?;
        (patterns <= self.flips).then_some(patterns)
    }
}

fn count(flips: impl Iterator<Item = u32>) -> f64 {
    flips.fold(0.0, |count, _| count + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One sample a cluster, whose errors are `error_a` and 1.
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
        // Differences 1, 2, 3, 4, 5, −6, sum 9. A sum of 21 − 2 S of the same magnitudes, where S is what is negated, is at
        // least 9 for S ≤ 6 and at most −9 for S ≥ 15. Subsets of {1…6} with sum 0…6: 1, 1, 1, 2, 2, 3, 4 = 14, as many by
        // symmetry with sum 15…21: p = 28/64.
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
        // The textbook interval of a mean: variance of the differences 1, …, 5, −6 is (91 − 81/6) / 5 = 15.5.
        let half = 2.570_581_836 * (15.5_f64 / 6.0).sqrt();
        assert!((difference.interval[1] - (1.5 + half)).abs() < 1e-8);
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
