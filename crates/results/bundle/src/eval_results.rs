//! Claims as evaluation results for the hub of Hugging Face.

use serde_json::{Value, json};

use crate::claim::Claim;
use crate::manifest::Manifest;
use crate::yaml;

/// Text of `.eval_results/taceva.yaml`. Its entries have no places for interval, unit and definition, so notes hold them.
pub(crate) fn text(manifest: &Manifest) -> String {
    let entries = manifest.claims.iter().map(|claim| entry(manifest, claim));
    yaml::block(&Value::Array(entries.collect()))
}

fn entry(manifest: &Manifest, claim: &Claim) -> Value {
    let mut notes = vec![format!("{}: {}.", claim.words(), claim.facts())];
    notes.extend(manifest.remarks());
    let task = format!("{}_{}", claim.full_metric(), claim.channel);
    json!({
        "dataset": {
            // The samples are on no hub; equal digests are equal samples.
            "id": manifest.samples_digest,
            "task_id": match manifest.studies.len() {
                0 | 1 => task,
                _ => format!("study{}_{task}", claim.study),
            },
        },
        "value": claim.value,
        // Every entry repeats it, so it is no longer than a day.
        "date": manifest.created.chars().take(10).collect::<String>(),
        "notes": notes.join(" "),
    })
}
