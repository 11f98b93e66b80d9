//! Description of a bundle as an RO-Crate 1.1 with a Process Run Crate 0.5: its files, and the run that computed its claims again.

use serde_json::{Value, json};

use crate::card::NO_LICENCE;
use crate::claim::properties;
use crate::layout::{CRATE, RESULTS};
use crate::manifest::{BundledFile, Manifest, StudyFiles};

/// Profile of a run of programs.
const PROFILE: &str = "https://w3id.org/ro/wfrun/process/0.5";
/// The program, by the address of its repository.
const PROGRAM: &str = env!("CARGO_PKG_REPOSITORY");
/// The run that computed the claims again.
const RUN: &str = "#recomputation";

/// Text of `ro-crate-metadata.json`.
pub(crate) fn text(manifest: &Manifest) -> String {
    let claims = properties(&manifest.claims);
    let authors = authors(manifest);
    let mut root = json!({
        "@id": "./",
        "@type": "Dataset",
        "conformsTo": {"@id": PROFILE},
        "name": manifest.name,
        "description": manifest.description(),
        "datePublished": manifest.created,
        "hasPart": manifest.given_files().map(|file| reference(&file.path)).collect::<Vec<_>>(),
        "mainEntity": reference(RESULTS),
        "mentions": reference(RUN),
        "variableMeasured": references(&claims),
    });
    let mut graph = vec![
        json!({
            "@id": CRATE,
            "@type": "CreativeWork",
            "about": {"@id": "./"},
            "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
        }),
        json!({
            "@id": PROFILE,
            "@type": ["CreativeWork", "Profile"],
            "name": "Process Run Crate",
            "version": "0.5",
        }),
        json!({
            "@id": PROGRAM,
            "@type": "SoftwareApplication",
            "name": "taceva",
            "description": "Evaluates tactile sensors.",
            "softwareVersion": manifest.taceva,
            "url": PROGRAM,
            "license": "MIT OR Apache-2.0",
        }),
    ];
    root["license"] = match (&manifest.licence, manifest.licence_address()) {
        (Some(licence), Some(address)) => {
            graph.push(json!({
                "@id": address,
                "@type": "CreativeWork",
                "name": licence,
                "description": format!("Licence of the bundle: {licence}"),
                "url": address,
            }));
            reference(&address)
        }
        _ => NO_LICENCE.into(),
    };
    if let Some(organization) = &manifest.organization {
        graph.push(json!({
            "@id": organization.url,
            "@type": "Organization",
            "name": organization.name,
            "url": organization.url,
        }));
        root["publisher"] = reference(&organization.url);
    }
    let mut run = run(manifest);
    if !authors.is_empty() {
        root["author"] = references(&authors);
        run["agent"] = references(&authors);
    }
    graph.extend([root, run]);
    graph.extend(authors);
    graph.extend(manifest.given_files().map(file));
    graph.extend(claims);
    let own = json!({
        "@context": [
            "https://w3id.org/ro/crate/1.1/context",
            "https://w3id.org/ro/terms/workflow-run/context",
        ],
        "@graph": graph,
    });
    format!("{own:#}\n")
}

/// The run of the program that made the bundle. Its time is the day of the manifest.
fn run(manifest: &Manifest) -> Value {
    let from = manifest.studies.iter().flat_map(StudyFiles::names);
    let from: Vec<Value> = from.map(|name| reference(name)).collect();
    json!({
        "@id": RUN,
        "@type": "CreateAction",
        "name": "taceva bundle",
        "description": "Computes the claims of the results again from states and tables, as deep as these allow.",
        "instrument": reference(PROGRAM),
        "object": from,
        "result": reference(RESULTS),
        "startTime": manifest.created,
        "endTime": manifest.created,
    })
}

fn authors(manifest: &Manifest) -> Vec<Value> {
    let authors = manifest.authors.iter().zip(1_usize..);
    let authors = authors.map(|(author, number)| {
        let mut own = json!({
            "@id": author.address().unwrap_or_else(|| format!("#author-{number}")),
            "@type": "Person",
            "name": author.name,
        });
        if let Some(organization) = &manifest.organization {
            own["affiliation"] = reference(&organization.url);
        }
        own
    });
    authors.collect()
}

fn file(file: &BundledFile) -> Value {
    json!({
        "@id": file.path,
        "@type": "File",
        "name": file.path,
        "description": file.role,
        "contentSize": file.size.to_string(),
        "encodingFormat": file.media_type(),
        "sha256": file.digits(),
    })
}

/// References to `entities`: a list, and the reference alone if there is one.
fn references(entities: &[Value]) -> Value {
    let references = entities.iter().map(|entity| json!({"@id": entity["@id"]}));
    let mut references: Vec<Value> = references.collect();
    match references.len() {
        1 => references.remove(0),
        _ => references.into(),
    }
}

fn reference(id: &str) -> Value {
    json!({"@id": id})
}
