//! Names of operators that readers of a bundle see.

use std::fs;

use taceva_core::{distinct, shown};
use toml::{Table, Value};

use crate::inputs::Inputs;
use crate::layout::MOST_TEXT;
use crate::writer::Writer;

/// Sentence on the operators that the written files name; `None` without such names.
pub(crate) fn note(inputs: &Inputs, written: &Writer<'_>) -> Option<String> {
    let names = names(inputs);
    let has_name = |text: &str| names.iter().any(|name| text.contains(name.as_str()));
    let mut files = Vec::new();
    for file in written.files.iter().filter(|file| file.size <= MOST_TEXT) {
        // A Parquet table and a packed picture are not text.
        let text = fs::read_to_string(written.root.join(&file.path)).unwrap_or_default();
        if has_name(&text) {
            files.push(file.path.as_str());
        }
    }
    (!files.is_empty()).then(|| {
        format!(
            "the bundle publishes the name of the operator, {}, in {}: sealed files keep it, so a bundle without the name needs a recording without it (no `name` under [operator] of the rig file, no --operator of `taceva capture`)",
            shown(&names.join(", ")),
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

/// Text at `key` of `table` in a TOML text; `None` without this key.
fn name(text: &str, [table, key]: [&str; 2]) -> Option<String> {
    let all: Table = toml::from_str(text).ok()?;
    all.get(table)?
        .get(key)
        .and_then(Value::as_str)
        .map(str::to_owned)
}
