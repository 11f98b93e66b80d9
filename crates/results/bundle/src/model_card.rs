//! Front matter of the card: a model card of Hugging Face with the claims as its `model-index`.

use serde_json::{Value, json};

use crate::claim::Claim;
use crate::manifest::Manifest;
use crate::yaml;

/// Lines before the text of the card.
pub(crate) fn front_matter(manifest: &Manifest) -> String {
    let mut own = json!({"tags": ["taceva", "tactile"]});
    if let Some(licence) = &manifest.licence {
        own["license"] = licence.to_ascii_lowercase().into();
    }
    let studies = 0..manifest.studies.len();
    let results: Vec<Value> = studies
        .filter_map(|study| result(manifest, study))
        .collect();
    if !results.is_empty() {
        own["model-index"] = json!([{"name": manifest.name, "results": results}]);
    }
    format!("---\n{}---\n\n", yaml::block(&own))
}

/// Result of study `study` in the `model-index`; `None` without claims.
fn result(manifest: &Manifest, study: usize) -> Option<Value> {
    let claims = manifest.claims.iter();
    let own = claims.filter(|claim| claim.study == study);
    let metrics: Vec<Value> = own.map(metric).collect();
    (!metrics.is_empty()).then(|| {
        json!({
            "task": {"type": "tactile-measurement"},
            "dataset": {
                "type": "tactile-samples",
                "name": format!("samples of study {study}"),
                "args": {
                    "samples": manifest.samples_digest,
                    "source": manifest.source,
                    "study": study,
                },
            },
            "metrics": metrics,
        })
    })
}

fn metric(claim: &Claim) -> Value {
    json!({
        "type": claim.full_metric(),
        "name": claim.words(),
        "value": claim.value,
        "args": {
            "ci95": claim.ci95,
            "unit": claim.unit.symbol(),
            "n": claim.n,
            "definition": claim.definition,
        },
    })
}
