//! Description of a bundle as an RO-Crate 1.1 with a Process Run Crate 0.5: its files, and the run that computed its claims again.

use serde_json::{Value, json};

use crate::card::NO_LICENCE;
use crate::claim::properties;
use crate::layout::{CRATE, RESULTS};
use crate::manifest::{BundledFile, Manifest, StudyFiles, licence_address};

/// Identifier of the profile of a run of programs.
const PROFILE: &str = "https://w3id.org/ro/wfrun/process/0.5";
/// Address of the repository of the program.
const PROGRAM: &str = env!("CARGO_PKG_REPOSITORY");
/// Identifier of the run that computed the claims again.
const RUN: &str = "#recomputation";

/// Text of `ro-crate-metadata.json` of a bundle.
pub(crate) fn text(manifest: &Manifest) -> String {
    let claims = properties(&manifest.claims);
    let licences = manifest.licence.as_slice();
    let mut own = Entities::of(manifest, &manifest.description(), licences);
    own.root["conformsTo"] = reference(PROFILE);
    own.root["mainEntity"] = reference(RESULTS);
    own.root["mentions"] = reference(RUN);
    own.root["variableMeasured"] = references(&claims);
    let mut run = run(manifest);
    if !own.authors.is_empty() {
        run["agent"] = references(&own.authors);
    }
    let before = vec![
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
    let mut after = vec![run];
    after.append(&mut own.authors);
    after.append(&mut own.files);
    after.extend(claims);
    own.text(before, after)
}

/// Text of `ro-crate-metadata.json` of a folder with the files of `manifest`, this description and these licences, without a run.
pub(crate) fn of_folder(manifest: &Manifest, description: &str, licences: &[String]) -> String {
    let mut own = Entities::of(manifest, description, licences);
    let mut after = std::mem::take(&mut own.authors);
    after.append(&mut own.files);
    own.text(Vec::new(), after)
}

/// Entities that every RO-Crate of a bundle or catalogue contains.
struct Entities {
    root: Value,
    /// Licences and the organization, which the root names.
    named: Vec<Value>,
    authors: Vec<Value>,
    files: Vec<Value>,
}

impl Entities {
    fn of(manifest: &Manifest, description: &str, licences: &[String]) -> Entities {
        let authors = authors(manifest);
        let mut root = json!({
            "@id": "./",
            "@type": "Dataset",
            "name": manifest.name,
            "description": description,
            "datePublished": manifest.created,
            "hasPart": manifest.given_files().map(|file| reference(&file.path)).collect::<Vec<_>>(),
        });
        let mut named: Vec<Value> = licences.iter().map(|own| licence(own)).collect();
        root["license"] = match named.is_empty() {
            true => NO_LICENCE.into(),
            false => references(&named),
        };
        if let Some(organization) = &manifest.organization {
            named.push(json!({
                "@id": organization.url,
                "@type": "Organization",
                "name": organization.name,
                "url": organization.url,
            }));
            root["publisher"] = reference(&organization.url);
        }
        if !authors.is_empty() {
            root["author"] = references(&authors);
        }
        Entities {
            root,
            named,
            authors,
            files: manifest.given_files().map(file).collect(),
        }
    }

    /// Text of the RO-Crate, with entities before and after its root.
    fn text(self, before: Vec<Value>, after: Vec<Value>) -> String {
        let mut graph = vec![json!({
            "@id": CRATE,
            "@type": "CreativeWork",
            "about": {"@id": "./"},
            "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
        })];
        graph.extend(before);
        graph.extend(self.named);
        graph.push(self.root);
        graph.extend(after);
        let own = json!({
            "@context": [
                "https://w3id.org/ro/crate/1.1/context",
                "https://w3id.org/ro/terms/workflow-run/context",
            ],
            "@graph": graph,
        });
        format!("{own:#}\n")
    }
}

/// The licence with the SPDX identifier `own`.
fn licence(own: &str) -> Value {
    let address = licence_address(own);
    json!({
        "@id": address,
        "@type": "CreativeWork",
        "name": own,
        "description": format!("Licence of the bundle: {own}"),
        "url": address,
    })
}

/// The run of the program that made the bundle. The time of the run is the day of the manifest.
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

/// References to `entities`: a list, or a single reference for one entity.
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
