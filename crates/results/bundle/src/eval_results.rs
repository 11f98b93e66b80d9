//! Claims as evaluation results for the Hugging Face Hub.

use serde_json::{Value, json};

use crate::claim::Claim;
use crate::manifest::Manifest;
use crate::yaml;

/// Text of `.eval_results/taceva.yaml`. Entries have no fields for interval, unit and definition, which are therefore in notes.
pub(crate) fn text(manifest: &Manifest) -> String {
    let entries = manifest.claims.iter().map(|claim| entry(manifest, claim));
    yaml::block(&Value::Array(entries.collect()))
}

/// Entry of one number for the Hugging Face Hub.
pub(crate) struct HubEntry<'a> {
    /// Digest of the samples, in place of a dataset on the hub. Equal digests mean equal samples.
    pub(crate) samples: &'a str,
    pub(crate) task: String,
    pub(crate) value: f64,
    pub(crate) day: String,
    pub(crate) notes: String,
    /// URL of the bundle; `None` if not given.
    pub(crate) address: Option<&'a str>,
}

impl HubEntry<'_> {
    pub(crate) fn value(self) -> Value {
        let mut own = json!({
            "dataset": {"id": self.samples, "task_id": self.task},
            "value": self.value,
            "date": self.day,
            "notes": self.notes,
        });
        if let Some(address) = self.address {
            own["source"] = json!({"url": address, "name": "TacEva bundle"});
        }
        own
    }
}

fn entry(manifest: &Manifest, claim: &Claim) -> Value {
    let mut notes = vec![format!("{}: {}.", claim.words(), claim.facts())];
    notes.extend(manifest.remarks());
    let task = format!("{}_{}", claim.full_metric(), claim.channel);
    let own = HubEntry {
        samples: &manifest.samples_digest,
        task: match manifest.studies.len() {
            0 | 1 => task,
            _ => format!("study{}_{task}", claim.study),
        },
        value: claim.value,
        // Cuts the date to a day, because every entry repeats the date.
        day: manifest.created.chars().take(10).collect(),
        notes: notes.join(" "),
        address: None,
    };
    own.value()
}
