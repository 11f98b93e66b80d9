//! Rows of an entry, compared with the claims of the manifest that each row names.

use taceva_report::catalogue::{DEPTHS, Measured};

use super::submission::protocol;
use crate::author::Author;
use crate::claim::Claim;
use crate::manifest::Manifest;

/// Fault of a row of the bundle with `manifest`; `None` if the manifest contains the number.
pub(super) fn fault(row: &Measured, manifest: &Manifest) -> Option<String> {
    let is_named = |claim: &&Claim| {
        claim.study == row.study
            && claim.metric == row.metric
            && claim.channel == row.channel
            && claim.variant == row.variant
    };
    let Some(claim) = manifest.claims.iter().find(is_named) else {
        return Some(format!(
            "{} of study {} is not in the manifest; remove the row, or add the bundle again",
            row.words(),
            row.study
        ));
    };
    let bits = |ends: [f64; 2]| ends.map(f64::to_bits);
    let by: Vec<String> = manifest.authors.iter().map(Author::to_string).collect();
    let protocol = protocol(manifest);
    let depth = claim.level.to_string();
    let of_study = manifest.studies.get(row.study);
    let source = of_study.map_or("", |files| files.source.as_str());
    // The first bundles of this schema state one origin for all studies: `several` if the origins differ.
    let source = match (source, manifest.source.as_str()) {
        ("", "several") => row.source.as_str(),
        ("", whole) => whole,
        (own, _) => own,
    };
    let deepest = DEPTHS.iter().position(|word| *word == depth);
    let differing = [
        (
            "value",
            row.value.to_bits() != claim.value.to_bits(),
            claim.value.to_string(),
        ),
        (
            "ci95",
            row.ci95.map(bits) != claim.ci95.map(bits),
            match claim.ci95 {
                Some([low, high]) => format!("{low}, {high}"),
                None => "none".to_owned(),
            },
        ),
        (
            "unit",
            row.unit != claim.unit.symbol(),
            claim.unit.symbol().to_owned(),
        ),
        ("n", row.n != claim.n, claim.n.to_string()),
        (
            "definition",
            row.definition != claim.definition,
            claim.definition.clone(),
        ),
        (
            "samples",
            row.samples != manifest.samples_digest,
            manifest.samples_digest.clone(),
        ),
        (
            "date",
            row.date.to_string() != manifest.created,
            manifest.created.clone(),
        ),
        ("by", row.by != by, by.join(", ")),
        (
            "licence",
            row.licence != manifest.licence,
            manifest.licence.clone().unwrap_or_default(),
        ),
        (
            "protocol",
            row.protocol != protocol,
            protocol.clone().unwrap_or_else(|| "none".to_owned()),
        ),
        ("source", row.source != source, source.to_owned()),
        (
            "verified",
            deepest.is_some_and(|deepest| row.depth() > deepest),
            format!("at most {depth}"),
        ),
    ];
    let mut differing = differing.into_iter();
    let (key, _, expected) = differing.find(|(_, differs, _)| *differs)?;
    Some(format!(
        "`{key}` of {} is not that of the manifest: expected {expected}",
        row.words()
    ))
}

#[cfg(test)]
mod tests {
    use taceva_report::catalogue::DEPTHS;

    use crate::level::Level;

    #[test]
    fn the_depths_of_rows_are_the_levels_of_a_verification() {
        assert_eq!(Level::ALL.map(|level| level.to_string()), DEPTHS);
    }
}
