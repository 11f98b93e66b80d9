//! Reports on bundles: levels to which claims were recomputed, and differences.

use std::collections::BTreeMap;
use std::io::{self, Write};

use taceva_bundle::{BundleComparison, Claim, Level, Verdict, Verification};
use taceva_core::{counted, shown};

use super::json;
use crate::args::ListFormat;

/// Writes the number of claims at each level.
pub(crate) fn levels(claims: &[Claim], out: &mut dyn Write) -> io::Result<()> {
    let mut counts: BTreeMap<Level, u64> = BTreeMap::new();
    for claim in claims {
        *counts.entry(claim.level).or_default() += 1;
    }
    for (level, count) in counts {
        writeln!(out, "level    {level}: {}", counted(count, "claim"))?;
    }
    Ok(())
}

/// Writes a verification: levels, unequal claims, and a summary.
pub(crate) fn verification(
    found: &Verification,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == ListFormat::Json {
        return json::write(found, out);
    }
    if let Some(bundle) = &found.bundle {
        writeln!(
            out,
            "{}: made on {} by TacEva {}; origin of the samples: {}",
            shown(&bundle.name),
            shown(&bundle.created),
            shown(&bundle.taceva),
            shown(&bundle.source)
        )?;
        for edit in &bundle.edits {
            writeln!(out, "edited   bundle.json, {}", shown(edit))?;
        }
    }
    for damage in &found.damage {
        writeln!(out, "damage   {damage} (broken rule: {})", damage.rule)?;
    }
    for level in &found.levels {
        match &level.reason {
            None => writeln!(out, "level    {}: reached", level.level)?,
            Some(reason) => {
                writeln!(
                    out,
                    "level    {}: not reached: {}",
                    level.level,
                    shown(reason)
                )?;
            }
        }
    }
    for claim in &found.claims {
        let reason = claim.reason.as_deref().unwrap_or_default();
        // Other claims are only counted, by the level that they reach.
        if matches!(claim.verdict, Verdict::Differs | Verdict::Within) {
            writeln!(
                out,
                "{}  study {}, {}{} of {}: {}",
                claim.verdict,
                claim.study,
                shown(&claim.metric),
                claim
                    .variant
                    .as_ref()
                    .map_or_else(String::new, |own| format!(".{}", shown(own))),
                shown(&claim.channel),
                shown(reason)
            )?;
        }
    }
    for (reason, count) in reasons(found) {
        writeln!(out, "{}: {}", counted(count, "claim"), shown(&reason))?;
    }
    for other in &found.others {
        writeln!(
            out,
            "{}  study {}, {}: {}",
            other.verdict,
            other.study,
            shown(&other.part),
            shown(&other.reason)
        )?;
    }
    let mut deepest: BTreeMap<Level, u64> = BTreeMap::new();
    for claim in &found.claims {
        *deepest.entry(claim.level).or_default() += 1;
    }
    let deepest: Vec<String> = deepest
        .iter()
        .map(|(level, count)| format!("{count} to the level {level}"))
        .collect();
    let sum = &found.summary;
    if !found.claims.is_empty() {
        writeln!(
            out,
            "{}: {} equal, {} within the tolerance, {} different, {} not recomputable; {}",
            counted(found.claims.len() as u64, "claim"),
            sum.equal,
            sum.within,
            sum.differs,
            sum.not_recomputable,
            deepest.join(", ")
        )?;
    }
    for remark in &found.remarks {
        writeln!(out, "{}", shown(remark))?;
    }
    Ok(())
}

/// Reasons why equal claims were not verified to the last level, with the number of claims for each reason.
fn reasons(found: &Verification) -> BTreeMap<String, u64> {
    let mut counts = BTreeMap::new();
    for claim in &found.claims {
        let is_listed = matches!(claim.verdict, Verdict::Differs | Verdict::Within);
        if let (false, Some(reason)) = (is_listed, &claim.reason) {
            let words = format!("{}: {reason}", claim.verdict);
            *counts.entry(words).or_default() += 1;
        }
    }
    counts
}

/// Writes the differences between two bundles.
pub(crate) fn comparison(
    found: &BundleComparison,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    if format == ListFormat::Json {
        return json::write(found, out);
    }
    for bundle in &found.bundles {
        writeln!(
            out,
            "{}: {}, made on {} by TacEva {}",
            shown(&bundle.name),
            shown(&bundle.seal),
            shown(&bundle.created),
            shown(&bundle.taceva)
        )?;
    }
    match found.has_same_samples {
        true => writeln!(out, "samples  the same")?,
        false => writeln!(
            out,
            "samples  not known to be the same: their digests differ, so one bundle cannot confirm the numbers of the other"
        )?,
    }
    for own in &found.definitions {
        let [one, other] = &own.definitions;
        writeln!(
            out,
            "definition  study {}, {}: {} and {}",
            own.study,
            shown(&own.claim),
            shown(one),
            shown(other)
        )?;
    }
    for own in &found.claims {
        let words = |at: usize| match (own.values[at], own.n[at]) {
            (Some(value), Some(n)) => format!("{value} (n = {n})"),
            _ => "none".to_owned(),
        };
        let [one, other] = [0, 1].map(words);
        writeln!(
            out,
            "claim  study {}, {}: {one} and {other}",
            own.study,
            shown(&own.claim)
        )?;
    }
    writeln!(
        out,
        "{} equal, {} different; neither bundle was verified",
        counted(found.equal, "claim"),
        found.claims.len()
    )
}
