//! Search for names of operators in the files that a bundle copies.

use std::fs;

use taceva_core::distinct;
use toml::{Table, Value};

use crate::inputs::Inputs;
use crate::layout::MOST_TEXT;
use crate::writer::Writer;

/// Roles of files that are generated from the request, which names authors. An author may be the operator.
const OF_AUTHORS: [&str; 2] = ["card", "manifest"];

/// Sentence on the operators that the copied files name; `None` without such names.
pub(crate) fn note(inputs: &Inputs, written: &Writer<'_>) -> Option<String> {
    let names = names(inputs);
    let forms: Vec<String> = names.iter().flat_map(|name| forms(name)).collect();
    let has_name = |text: &str| forms.iter().any(|form| has_word(text, form));
    let mut files = Vec::new();
    for file in &written.files {
        if OF_AUTHORS.contains(&file.role.as_str()) || file.size > MOST_TEXT {
            continue;
        }
        // A Parquet table and a packed picture are not text.
        let text = fs::read_to_string(written.root.join(&file.path)).unwrap_or_default();
        if has_name(&text) {
            files.push(file.path.as_str());
        }
    }
    (!files.is_empty()).then(|| {
        format!(
            "the bundle publishes the name of the operator, {}, in {}, where a seal forbids changes. To omit the name, record again without `name` under [operator] of the rig file and without --operator of `taceva capture`",
            names.join(", "),
            files.join(", ")
        )
    })
}

/// Operators in results, headers of datasets and rig file.
fn names(inputs: &Inputs) -> Vec<String> {
    let devices = inputs.reports.iter();
    let devices = devices.filter_map(|report| report.provenance.devices.get("operator").cloned());
    let headers = inputs.headers.iter();
    let headers = headers.filter_map(|text| name(text, ["settings", "operator"]));
    let rig = inputs.texts.get("rig.toml");
    let rig = rig.and_then(|text| name(text, ["operator", "name"]));
    distinct(
        devices
            .chain(headers)
            .chain(rig)
            .filter(|name| !name.is_empty()),
    )
}

/// Forms of a name in texts: plain, and with the escapes of JSON and TOML, of CSV, and of HTML.
fn forms(name: &str) -> Vec<String> {
    let json = serde_json::Value::from(name).to_string();
    let json = json
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'));
    let html = [
        ('&', "&amp;"),
        ('<', "&lt;"),
        ('>', "&gt;"),
        ('"', "&quot;"),
    ];
    let html = (html.iter()).fold(name.to_owned(), |text, (own, escaped)| {
        text.replace(*own, escaped)
    });
    let escaped = [
        json.unwrap_or(name).to_owned(),
        name.replace('"', "\"\""),
        html,
    ];
    distinct(std::iter::once(name.to_owned()).chain(escaped))
}

/// True if `word` is in `text` without letters or digits next to it.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |letter: Option<char>| letter.is_some_and(char::is_alphanumeric);
    let mut found = text.match_indices(word);
    found.any(|(at, word)| {
        let after = &text[at + word.len()..];
        !is_part(text[..at].chars().next_back()) && !is_part(after.chars().next())
    })
}

/// Text at `key` of `table` in a TOML text; `None` without this key.
fn name(text: &str, [table, key]: [&str; 2]) -> Option<String> {
    let all: Table = toml::from_str(text).ok()?;
    all.get(table)?
        .get(key)
        .and_then(Value::as_str)
        .map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_with_quotation_marks_and_backslashes_is_found_in_every_text() {
        for name in ["Ann \"Al\" Lee", "lab\\ann", "O'Neil \"\\\"", "Lee & Lee"] {
            let forms = forms(name);
            let finds = |text: &str| forms.iter().any(|form| has_word(text, form));
            let json = serde_json::json!({ "operator": name }).to_string();
            let mut table = Table::new();
            table.insert("operator".to_owned(), Value::String(name.to_owned()));
            let toml = toml::to_string(&table).expect("a text");
            let csv = format!("1,\"{}\",2", name.replace('"', "\"\""));
            let html = format!(
                "<td>{}</td>",
                name.replace('&', "&amp;").replace('"', "&quot;")
            );
            for text in [name, &json, &toml, &csv, &html] {
                assert!(finds(text), "{name}: {text}");
            }
            assert!(!finds("operator = \"Ann\""), "{name}");
        }
        assert_eq!(forms("Ann Lee"), ["Ann Lee"]);
    }

    #[test]
    fn a_short_name_is_found_as_a_word_and_not_inside_another_word() {
        for text in ["operator = \"AL\"", "1,AL,2", "AL"] {
            assert!(has_word(text, "AL"), "{text}");
        }
        for text in ["DIGITAL", "ALL", "al", ""] {
            assert!(!has_word(text, "AL"), "{text}");
        }
    }
}
