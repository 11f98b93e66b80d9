//! Texts for readers of a bundle, generated from its manifest: card, citation and licence.

use serde_json::{Value, json};
use taceva_core::{counted, shown};

use crate::manifest::{ABOUT, Manifest};
use crate::model_card::front_matter;
use crate::yaml;

/// Sentence on a bundle without a licence.
pub(crate) const NO_LICENCE: &str = "No licence is stated, so nobody may copy these files.";
/// Sentence on the meaning of a seal.
pub(crate) const SEAL_REMARK: &str = "A seal is a digest, not a signature: it shows damage and careless edits, not fraud. If predictions, states and results were changed consistently, only the model, or a copy of the truth from another source, shows the change.";

/// Sentences on the columns of the table of claims.
const COLUMNS: &str = "`bias` is the mean of truth − prediction. The last column names the files from which `taceva bundle` computed the number \
                       again: `scores` are the states, `predictions` the tables of truth and prediction, and `form` means no file.";

/// Text of `README.md`.
pub(crate) fn card(manifest: &Manifest) -> String {
    let mut text = front_matter(manifest);
    text += &format!("# {}\n\n", cell(&manifest.name));
    for remark in manifest.remarks() {
        text += &format!("> **{remark}**\n\n");
    }
    text += &format!("{ABOUT} `taceva bundle verify` on this folder or file does so.\n\n");
    text += "| fact | value |\n|---|---|\n";
    let authors: Vec<String> = manifest.authors.iter().map(ToString::to_string).collect();
    let organization = manifest.organization.as_ref().map(ToString::to_string);
    for (fact, value) in [
        ("authors", authors.join(", ")),
        ("organization", organization.unwrap_or_default()),
        ("made on", manifest.created.clone()),
        ("made by", format!("TacEva {}", manifest.taceva)),
        ("licence", manifest.licence.clone().unwrap_or_default()),
        ("origin of the samples", manifest.source.clone()),
        ("digest of the samples", manifest.samples_digest.clone()),
    ] {
        if !value.is_empty() {
            text += &format!("| {fact} | {} |\n", cell(&value));
        }
    }
    for withheld in &manifest.withheld {
        text += &format!(
            "| withheld | {} ({}) |\n",
            cell(&withheld.role),
            cell(&withheld.reason)
        );
    }
    text += &format!(
        "\n## {}\n\n",
        counted(manifest.claims.len() as u64, "claim")
    );
    text += "| study | claim | value | 95 % interval | unit | n | definition | computed again from |\n|---|---|---|---|---|---|---|---|\n";
    for claim in &manifest.claims {
        let interval = claim.ci95.map(|[low, high]| format!("{low} to {high}"));
        text += &format!(
            "| {} | {} | {} | {} | {} | {} | {} | {} |\n",
            claim.study,
            cell(&claim.words()),
            claim.value,
            interval.unwrap_or_default(),
            claim.unit,
            claim.n,
            cell(&claim.definition),
            claim.level
        );
    }
    text += &format!("\n{COLUMNS}\n\n{SEAL_REMARK}\n");
    text
}

/// Text of `CITATION.cff`.
pub(crate) fn citation(manifest: &Manifest) -> String {
    let authors = manifest.authors.iter().map(|author| {
        let mut own = json!({"name": author.name});
        if let Some(address) = author.address() {
            own["orcid"] = address.into();
        }
        own
    });
    let mut authors: Vec<Value> = authors.collect();
    if authors.is_empty() {
        // An alias, because a name would state an author.
        authors.push(json!({"alias": "not stated"}));
    }
    let mut own = json!({
        "cff-version": "1.2.0",
        "message": "Cite this bundle as below.",
        "type": "dataset",
        "title": manifest.name,
        "authors": authors,
        "date-released": manifest.created,
    });
    if let Some(licence) = &manifest.licence {
        own["license"] = licence.as_str().into();
    }
    yaml::block(&own)
}

/// Text of `LICENSE`.
pub(crate) fn licence(manifest: &Manifest) -> String {
    match &manifest.licence {
        Some(licence) => format!(
            "SPDX-License-Identifier: {licence}\n\nThe text of this licence: https://spdx.org/licenses/{licence}.html\n"
        ),
        None => format!("{NO_LICENCE}\n"),
    }
}

/// Escapes `text` for a cell of a Markdown table.
fn cell(text: &str) -> String {
    let mut written = String::with_capacity(text.len());
    for letter in shown(text).to_string().chars() {
        match letter {
            '<' => written.push_str("&lt;"),
            '&' => written.push_str("&amp;"),
            '|' | '`' | '*' | '_' | '[' | ']' | '\\' => {
                written.push('\\');
                written.push(letter);
            }
            letter => written.push(letter),
        }
    }
    written
}
