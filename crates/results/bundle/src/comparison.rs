//! Comparison of two bundles: claims and definitions that differ, and a check that both use the same samples.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use crate::claim::Claim;
use crate::error::BundleError;
use crate::verification::BundleFacts;
use crate::verify::open_manifest;

/// Schema of a comparison of bundles.
pub const COMPARISON_SCHEMA: &str = "taceva.bundle-comparison/1";

/// Differences of two bundles.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BundleComparison {
    /// Schema of the comparison, [`COMPARISON_SCHEMA`].
    pub schema: &'static str,
    /// Facts about both bundles.
    pub bundles: [BundleFacts; 2],
    /// True if both bundles were scored on the same samples, by the digests of their samples.
    pub has_same_samples: bool,
    /// Number of equal claims.
    pub equal: u64,
    /// Claims that differ, or that only one bundle contains.
    pub claims: Vec<ClaimDifference>,
    /// Claims whose definitions differ, so that their numbers are not comparable.
    pub definitions: Vec<DefinitionDifference>,
}

/// Claim that differs between two bundles.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ClaimDifference {
    /// Index of the study in the results, from 0.
    pub study: usize,
    /// Metric, variant and channel: `mae of Fz`.
    pub claim: String,
    /// Value of each bundle; `None` for a bundle without this claim.
    pub values: [Option<f64>; 2],
    /// Interval of 95 % of the claim in each bundle; `None` without an interval.
    pub ci95: [Option<[f64; 2]>; 2],
    /// Number of samples behind the claim in each bundle; `None` for a bundle without this claim.
    pub n: [Option<u64>; 2],
}

/// Claim whose definitions differ between two bundles.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct DefinitionDifference {
    /// Index of the study in the results, from 0.
    pub study: usize,
    /// Metric, variant and channel: `mae of Fz`.
    pub claim: String,
    /// Definition and unit of the claim in each bundle.
    pub definitions: [String; 2],
}

/// Compares the manifests of two bundles without verifying the bundles.
///
/// # Errors
/// [`BundleError::Damaged`] for a bundle whose manifest cannot be read; [`BundleError::File`] for a bundle that cannot be opened.
pub fn compare(one: &Path, other: &Path) -> Result<BundleComparison, BundleError> {
    let (first, of_first) = open_manifest(one)?;
    let (second, of_second) = open_manifest(other)?;
    let mut found = BundleComparison {
        schema: COMPARISON_SCHEMA,
        has_same_samples: first.samples_digest == second.samples_digest,
        bundles: [first, second],
        equal: 0,
        claims: Vec::new(),
        definitions: Vec::new(),
    };
    let mut pairs: BTreeMap<(usize, String), [Option<&Claim>; 2]> = BTreeMap::new();
    for (side, claims) in [&of_first.claims, &of_second.claims]
        .into_iter()
        .enumerate()
    {
        for claim in claims {
            let pair = pairs.entry((claim.study, claim.words())).or_default();
            pair[side] = Some(claim);
        }
    }
    for ((study, claim), pair) in pairs {
        if let [Some(one), Some(other)] = pair {
            let definitions = [one, other].map(|own| format!("{}, {}", own.definition, own.unit));
            let is_other = definitions[0] != definitions[1];
            if one.number().is_same(other.number()) && !is_other && one.n == other.n {
                found.equal += 1;
                continue;
            }
            if is_other {
                found.definitions.push(DefinitionDifference {
                    study,
                    claim: claim.clone(),
                    definitions,
                });
            }
        }
        found.claims.push(ClaimDifference {
            study,
            claim,
            values: pair.map(|own| own.map(|own| own.value)),
            ci95: pair.map(|own| own.and_then(|own| own.ci95)),
            n: pair.map(|own| own.map(|own| own.n)),
        });
    }
    Ok(found)
}
