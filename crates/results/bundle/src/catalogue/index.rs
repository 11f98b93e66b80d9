//! Index of a catalogue for programs: its entries and bundles.

use serde_json::{Value, json};
use taceva_report::catalogue::Sensor;

use crate::manifest::Manifest;

/// Schema of `index.json`.
pub const INDEX_SCHEMA: &str = "taceva.catalogue-index/1";

/// Index under construction: the entries and bundles read so far.
#[derive(Default)]
pub(super) struct Index {
    entries: Vec<Value>,
    bundles: Vec<Value>,
}

impl Index {
    pub(super) fn add_entry(&mut self, path: &str, sensor: &Sensor) {
        self.entries.push(json!({
            "path": path,
            "name": sensor.name,
            "published": sensor.results.len(),
            "measured": sensor.measured.len(),
            "unknown": sensor.unknown.len(),
            "simulated": sensor.simulated.len(),
        }));
    }

    pub(super) fn add_bundle(&mut self, path: &str, manifest: &Manifest) {
        let authors: Vec<String> = manifest.authors.iter().map(ToString::to_string).collect();
        self.bundles.push(json!({
            "path": path,
            "name": manifest.name,
            "authors": authors,
            "licence": manifest.licence,
            "created": manifest.created,
            "source": manifest.source,
            "samples": manifest.samples_digest,
            "claims": manifest.claims.len(),
        }));
    }

    pub(super) fn text(self) -> String {
        let whole =
            json!({"schema": INDEX_SCHEMA, "entries": self.entries, "bundles": self.bundles});
        format!("{whole:#}\n")
    }
}
