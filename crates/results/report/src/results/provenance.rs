//! Provenance entries for a page, each with a name and a text.

use std::collections::BTreeMap;
use std::fmt::Display;

use super::traceability::traceability_line;
use taceva_results::{ModelProvenance, Provenance};

/// Nonempty entries of `provenance` except the notes, in file order.
pub(super) fn entries(provenance: &Provenance) -> Vec<(String, String)> {
    let text = |text: &Option<String>| text.clone().unwrap_or_default();
    let recordings = provenance.recordings.iter().map(|own| {
        let (name, digest, samples) = (&own.name, &own.digest, own.samples);
        format!("name {name}, digest {digest}, samples {samples}")
    });
    let presses = provenance.presses.iter();
    let presses = presses.map(|(digest, counts)| format!("{digest} {}", pairs(counts)));
    // In a cross-validation, each fold has its own parts, so a single part is omitted.
    let predicted_once = provenance.predicted_once();
    let part = provenance.part.as_ref();
    let part = part.filter(|_| predicted_once.is_none()).cloned();
    // Results of the built-in bench and of tables have no instruments.
    let traceability = match provenance.traceability.is_empty() {
        true => String::new(),
        false => traceability_line(provenance),
    };
    let setting = |name: &str| provenance.devices.get(name).cloned().unwrap_or_default();
    let all = [
        ("taceva", provenance.taceva.clone()),
        ("dataset", text(&provenance.dataset)),
        ("recordings", joined(recordings)),
        ("tables", pairs(&provenance.tables)),
        (
            "model",
            provenance.model.as_ref().map_or_else(String::new, model),
        ),
        ("split", text(&provenance.split)),
        (
            "seed",
            provenance
                .seed
                .map_or_else(String::new, |seed| seed.to_string()),
        ),
        ("part", text(&part)),
        (
            "samples",
            predicted_once.unwrap_or_else(|| pairs(&provenance.samples)),
        ),
        ("presses", joined(presses)),
        ("traceability", traceability),
        ("laboratory", setting("laboratory")),
        ("operator", setting("operator")),
        ("devices", equations(&provenance.devices)),
        (
            "recorded_on",
            provenance
                .recorded_on
                .map_or_else(String::new, |day| day.to_string()),
        ),
        ("frames_decoded", provenance.frames_decoded.to_string()),
        ("plugins", provenance.plugins.join(", ")),
        ("samples_table", text(&provenance.samples_table)),
        ("edits", provenance.edits.join(", ")),
    ];
    let known = all.into_iter().filter(|(_, text)| !text.is_empty());
    known.map(|(name, text)| (name.to_owned(), text)).collect()
}

fn model(model: &ModelProvenance) -> String {
    let origin = model
        .origin
        .iter()
        .map(|origin| format!(", origin {origin}"));
    format!(
        "name {}, settings {}, digest {}, fitted_on {}{}",
        model.name,
        pairs(&model.settings),
        model.digest,
        model.fitted_on,
        origin.collect::<String>()
    )
}

/// Pairs as text: `train 40, test 10`.
fn pairs<'a, K: Display + 'a, V: Display + 'a>(
    pairs: impl IntoIterator<Item = (&'a K, &'a V)>,
) -> String {
    let pairs = pairs.into_iter();
    joined(pairs.map(|(name, value)| format!("{name} {value}")))
}

/// Settings of devices as text: `force_filter = 8; force_rate_hz = 500`.
fn equations(settings: &BTreeMap<String, String>) -> String {
    let settings = settings.iter();
    let settings =
        settings.filter(|(name, _)| !["laboratory", "operator"].contains(&name.as_str()));
    let texts = settings.map(|(name, value)| format!("{name} = {value}"));
    texts.collect::<Vec<_>>().join("; ")
}

fn joined(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(", ")
}
