//! Page of a verification: every claim, with a tick for each level that it reached.

use taceva_bundle::{ClaimCheck, Level, LevelCheck, Outcome, Verdict, Verification};
use taceva_core::{counted, shown};
use taceva_report::{Column, PagePart, PageSection, Table, TablesPage};

/// HTML of the page.
pub(crate) fn page(found: &Verification) -> String {
    let bundle = found.bundle.as_ref();
    let name = bundle.map_or("a damaged bundle", |bundle| bundle.name.as_str());
    let outcome = match found.outcome() {
        Outcome::Verified => "Verified: every claim is equal, or within the tolerance.",
        Outcome::Damaged => "Damaged: files are not those of the manifest.",
        _ => "Not verified: a claim differs, or was not computed again.",
    };
    let mut lead = vec![format!("{outcome} Program: {}.", found.program)];
    lead.extend(bundle.map(|bundle| {
        format!(
            "Made on {} by TacEva {}. Origin of the samples: {}. Seal: {}.",
            plain(&bundle.created),
            plain(&bundle.taceva),
            plain(&bundle.source),
            plain(&bundle.seal)
        )
    }));
    let mut sections = vec![section("levels", "Levels", levels(&found.levels))];
    if !found.damage.is_empty() {
        let mut table = Table::new("Damage", ["file", "problem", "broken rule"]);
        for damage in &found.damage {
            table.push([
                plain(&damage.path),
                plain(&damage.problem),
                damage.rule.to_owned(),
            ]);
        }
        sections.push(section("damage", "Damage", table));
    }
    if !found.claims.is_empty() {
        sections.push(section("claims", "Claims", claims(found)));
    }
    if !found.others.is_empty() {
        let mut table = Table::new("Further checks", ["study", "part", "verdict", "reason"]);
        for other in &found.others {
            table.push([
                other.study.to_string(),
                plain(&other.part),
                other.verdict.to_string(),
                plain(&other.reason),
            ]);
        }
        sections.push(section("others", "Further checks", table));
    }
    let remarks = found.remarks.iter();
    let remarks = remarks.map(|remark| PagePart::Words(plain(remark)));
    sections.push(PageSection {
        id: "remarks",
        title: "Remarks",
        parts: remarks.collect(),
    });
    let page = TablesPage {
        title: format!("Verification of {}", plain(name)),
        badge: bundle.and_then(|bundle| bundle.badge.as_deref().map(plain)),
        lead,
        sections,
    };
    page.html()
}

fn section(id: &'static str, title: &'static str, table: Table) -> PageSection {
    PageSection {
        id,
        title,
        parts: vec![PagePart::Table(table)],
    }
}

fn levels(levels: &[LevelCheck]) -> Table {
    let mut table = Table::new("Levels", ["level", "reached", "reason"]);
    for level in levels {
        let reached = if level.reached { "yes" } else { "no" };
        let reason = level.reason.as_deref().unwrap_or_default();
        table.push([level.level.to_string(), reached.to_owned(), plain(reason)]);
    }
    table
}

/// Claims, with one column for each level that was requested.
fn claims(found: &Verification) -> Table {
    let levels: Vec<Level> = found.levels.iter().map(|level| level.level).collect();
    let first = ["study", "claim", "printed", "recomputed"].map(Column::new);
    let of_levels = levels.iter().map(|level| Column::new(level.to_string()));
    let last = ["verdict", "reason"].map(Column::new);
    let columns = first.into_iter().chain(of_levels).chain(last);
    let caption = counted(found.claims.len() as u64, "claim");
    let mut table = Table::new(caption, columns);
    for claim in &found.claims {
        let variant = claim.variant.as_ref();
        let variant = variant.map_or_else(String::new, |name| format!(".{name}"));
        let again = claim.recomputed;
        let first = [
            claim.study.to_string(),
            plain(&format!("{}{variant} of {}", claim.metric, claim.channel)),
            claim.stated.to_string(),
            again.map_or_else(|| "–".to_owned(), |number| number.to_string()),
        ];
        let ticks = levels.iter().map(|level| tick(claim, *level).to_owned());
        let reason = claim.reason.as_deref().unwrap_or_default();
        let last = [claim.verdict.to_string(), plain(reason)];
        table.push(first.into_iter().chain(ticks).chain(last));
    }
    table.note(
        "✓ the level gives the number; ✗ the level gives another number; – the level was not compared, or gives no answer.",
    );
    table
}

/// Mark of a claim at `level`.
fn tick(claim: &ClaimCheck, level: Level) -> &'static str {
    match claim.verdict {
        Verdict::Differs if claim.level == level => "✗",
        // If a claim differs from the recomputed scores, its comparison with the results is unknown.
        Verdict::Differs if claim.level == Level::Scores && level == Level::Form => "–",
        _ if claim.level >= level => "✓",
        _ => "–",
    }
}

/// Text without control characters.
fn plain(text: &str) -> String {
    shown(text).to_string()
}
