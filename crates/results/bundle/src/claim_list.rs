//! Compares the claims of a manifest with the numbers of the results. Finds missing and duplicate claims, and wrong files behind a claim.

use std::collections::BTreeSet;

use taceva_results::EvaluationReport;

use crate::claim::{Claim, claims};
use crate::error::Damage;
use crate::layout::MANIFEST;
use crate::manifest::Manifest;

/// First fault of the claims of `manifest`. `reports` contains one report for each study.
///
/// A claim without a number in the results is a difference, not damage.
pub(crate) fn fault(manifest: &Manifest, reports: &[EvaluationReport]) -> Option<Damage> {
    let damage = |problem: String| {
        let rule = "bundle.json claims each number of results.json once, with its files";
        Some(Damage::new(MANIFEST, rule, problem))
    };
    let named = |claim: &Claim| format!("study {}, {}", claim.study, claim.words());
    let mut known = BTreeSet::new();
    for claim in &manifest.claims {
        if !known.insert(key(claim)) {
            return damage(format!("{} is claimed twice", named(claim)));
        }
        let files = manifest.studies.get(claim.study);
        if !files.is_some_and(|files| files.names().eq(&claim.from)) {
            return damage(format!(
                "{} does not name the files of its study in `from`",
                named(claim)
            ));
        }
    }
    for (study, report) in reports.iter().enumerate() {
        let expected = claims(study, report, &[]);
        if let Some(missing) = expected.iter().find(|claim| !known.contains(&key(claim))) {
            return damage(format!("{} is not claimed", named(missing)));
        }
    }
    None
}

/// Identity of a claim: study, metric, channel and variant.
pub(crate) fn key(claim: &Claim) -> (usize, &str, &str, Option<&str>) {
    let (metric, channel) = (claim.metric.as_str(), claim.channel.as_str());
    (claim.study, metric, channel, claim.variant.as_deref())
}
