//! Texts for readers of a bundle, generated from its manifest: the card, how to cite it, the licence.

use taceva_core::{counted, shown};

use crate::layout::{CARD, CITATION, LICENCE};
use crate::manifest::Manifest;

/// Sentence on what a seal shows.
pub(crate) const SEAL_REMARK: &str = "A seal is a digest and no signature: it shows damage and careless edits, not fraud. A bundle whose predictions, states and \
     results were all changed alike cannot be distinguished from an honest one without the model or the truth from elsewhere.";

/// Generated texts by file name, in order.
pub(crate) fn texts(manifest: &Manifest) -> [(&'static str, String); 3] {
    [
        (CITATION, citation(manifest)),
        (LICENCE, licence(manifest)),
        (CARD, card(manifest)),
    ]
}

fn card(manifest: &Manifest) -> String {
    let mut text = format!("# {}\n\n", cell(&manifest.name));
    if let Some(badge) = &manifest.badge {
        text += &format!("> **{badge}**\n\n");
    }
    if manifest.is_unfinished {
        text += "> **Draft**: author or licence is missing.\n\n";
    }
    text += "Results of TacEva with what is needed to compute them again. `taceva bundle verify` on this folder or file does so.\n\n";
    text += "| fact | value |\n|---|---|\n";
    let authors: Vec<String> = manifest.authors.iter().map(ToString::to_string).collect();
    for (fact, value) in [
        ("authors", authors.join(", ")),
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
    text += &format!("\n{SEAL_REMARK}\n");
    text
}

fn citation(manifest: &Manifest) -> String {
    let mut text =
        "cff-version: 1.2.0\nmessage: \"Cite this bundle as below.\"\ntype: dataset\n".to_owned();
    text += &format!("title: {}\n", quoted(&manifest.name));
    text += "authors:\n";
    for author in &manifest.authors {
        text += &format!("  - name: {}\n", quoted(&author.name));
        if let Some(orcid) = &author.orcid {
            text += &format!("    orcid: \"https://orcid.org/{orcid}\"\n");
        }
    }
    if manifest.authors.is_empty() {
        text += "  - name: \"not stated\"\n";
    }
    text += &format!("date-released: {}\n", quoted(&manifest.created));
    if let Some(licence) = &manifest.licence {
        text += &format!("license: {}\n", quoted(licence));
    }
    text
}

fn licence(manifest: &Manifest) -> String {
    match &manifest.licence {
        Some(licence) => format!(
            "SPDX-License-Identifier: {licence}\n\nThe text of this licence: https://spdx.org/licenses/{licence}.html\n"
        ),
        None => "No licence is stated, so nobody may copy these files.\n".to_owned(),
    }
}

/// Text in a cell of Markdown.
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

/// Text as a scalar of YAML, which takes the strings of JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
