//! Forms of a catalogue for other programs: its numbers for the Hugging Face Hub, and its folder as a Croissant and as an RO-Crate.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::{Value, json};
use taceva_core::counted;
use taceva_files::seal::digest_of_bytes;
use taceva_report::catalogue::{Measured, Sensor};
use taceva_results::not_measured;

use super::error::CatalogueFolderError;
use super::folder::{TextFile, entry_texts, manifest_texts};
use super::inspection::entries;
use crate::author::Author;
use crate::eval_results::HubEntry;
use crate::layout::{CRATE, CROISSANT};
use crate::manifest::{BUNDLE_SCHEMA, BundledFile, Manifest};
use crate::organization::Organization;
use crate::{croissant, ro_crate, yaml};

/// Name of a catalogue in its files for other programs, the same for all catalogues.
const NAME: &str = "Catalogue of tactile sensors";

/// Form of a catalogue for other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CatalogueForm {
    /// `eval.yaml`, and `.eval_results/SENSOR.yaml` with the numbers of each sensor, for the Hugging Face Hub.
    Hub,
    /// `croissant.json`: the folder as a Croissant 1.0.
    Croissant,
    /// `ro-crate-metadata.json`: the folder as an RO-Crate 1.1.
    Crate,
}

/// File of a form.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FormFile {
    /// Path in the folder of the form: `eval.yaml`.
    pub path: String,
    /// Text of the file.
    pub text: String,
}

impl FormFile {
    fn new(path: impl Into<String>, text: String) -> FormFile {
        FormFile {
            path: path.into(),
            text,
        }
    }
}

/// Files of the form `form` of the catalogue at `root`. The same catalogue gives the same bytes. Published numbers are not part of a form.
///
/// ```no_run
/// use std::path::Path;
/// use taceva_bundle::{CatalogueForm, catalogue_form};
///
/// for file in catalogue_form(Path::new("tactile-results"), CatalogueForm::Hub, None)? {
///     println!("{}: {} bytes", file.path, file.text.len());
/// }
/// # Ok::<(), taceva_bundle::CatalogueFolderError>(())
/// ```
///
/// # Errors
/// [`CatalogueFolderError`] for an invalid file, for a number that its manifest lacks, and for a catalogue without bundles.
pub fn catalogue_form(
    root: &Path,
    form: CatalogueForm,
    organization: Option<&Organization>,
) -> Result<Vec<FormFile>, CatalogueFolderError> {
    let mut sensors = entries(root)?;
    sensors.retain(Sensor::has_bundles);
    if sensors.is_empty() {
        let problem = "the catalogue has no numbers of bundles; `taceva catalogue add BUNDLE --to DIR` adds numbers";
        return Err(CatalogueFolderError::refused(root, problem));
    }
    if form == CatalogueForm::Hub {
        return Ok(hub(&sensors));
    }
    let folder = Folder::read(root, &sensors, organization)?;
    let (manifest, description) = (&folder.manifest, folder.description.as_str());
    Ok(vec![match form {
        CatalogueForm::Croissant => {
            let own = croissant::dataset(manifest, description, &folder.licences, &[]);
            FormFile::new(CROISSANT, format!("{own:#}\n"))
        }
        _ => FormFile::new(
            CRATE,
            ro_crate::of_folder(manifest, description, &folder.licences),
        ),
    }])
}

/// Numbers of `sensors` for the Hugging Face Hub: the tasks, and one file for each sensor.
fn hub(sensors: &[Sensor]) -> Vec<FormFile> {
    let rows = sensors.iter().flat_map(Sensor::all_rows);
    let tasks: BTreeSet<String> = rows.map(task).collect();
    let tasks: Vec<Value> = tasks.iter().map(|task| json!({"id": task})).collect();
    let own = json!({
        "name": NAME,
        "description": description(sensors),
        "evaluation_framework": "taceva",
        "tasks": tasks,
    });
    let mut files = vec![FormFile::new("eval.yaml", yaml::block(&own))];
    for sensor in sensors {
        let entries = sensor.all_rows().map(|row| hub_entry(row).value());
        let text = yaml::block(&Value::Array(entries.collect()));
        let path = format!(".eval_results/{}.yaml", sensor.slug());
        files.push(FormFile::new(path, text));
    }
    files
}

fn hub_entry(row: &Measured) -> HubEntry<'_> {
    let interval = match row.ci95 {
        Some([low, high]) => format!("ci95 [{low}, {high}]"),
        None => "no ci95".to_owned(),
    };
    let mut notes = vec![format!(
        "{}: {interval}, unit {}, n = {}, definition {}, study {}, level {}, origin {}, bundle {}.",
        row.words(),
        row.unit,
        row.n,
        row.definition,
        row.study,
        row.verified,
        row.source,
        row.bundle
    )];
    notes.extend(not_measured([row.source.as_str()]));
    HubEntry {
        samples: &row.samples,
        task: task(row),
        value: row.value,
        day: row.date.to_string(),
        notes: notes.join(" "),
        address: row.url.as_deref(),
    }
}

/// Task of a number: metric, variant and channel.
fn task(row: &Measured) -> String {
    format!("{}_{}", row.full_name(), row.channel)
}

/// Content of a catalogue in words, with the sentence on samples that were not measured.
fn description(sensors: &[Sensor]) -> String {
    let rows = || sensors.iter().flat_map(Sensor::all_rows);
    let bundles: BTreeSet<&str> = rows().map(|row| row.bundle.as_str()).collect();
    let mut sentences = vec![format!(
        "{} of {} from {} of TacEva, each with its samples and the level of its verification.",
        counted(rows().count() as u64, "number"),
        counted(sensors.len() as u64, "sensor"),
        counted(bundles.len() as u64, "bundle"),
    )];
    sentences.extend(not_measured(rows().map(|row| row.source.as_str())));
    sentences.join(" ")
}

/// Folder of a catalogue, described like a bundle.
struct Folder {
    /// Manifest with name, day, authors and files, but without claims.
    manifest: Manifest,
    description: String,
    /// Licences of the bundles, each once.
    licences: Vec<String>,
}

impl Folder {
    fn read(
        root: &Path,
        sensors: &[Sensor],
        organization: Option<&Organization>,
    ) -> Result<Folder, CatalogueFolderError> {
        let mut own = Manifest {
            schema: BUNDLE_SCHEMA.to_owned(),
            name: NAME.to_owned(),
            created: String::new(),
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            licence: None,
            authors: Vec::new(),
            organization: organization.cloned(),
            is_unfinished: false,
            source: String::new(),
            badge: None,
            files: Vec::new(),
            studies: Vec::new(),
            claims: Vec::new(),
            withheld: Vec::new(),
            redacted: BTreeMap::new(),
            samples_digest: String::new(),
        };
        let mut licences = BTreeSet::new();
        for TextFile { path, text, .. } in entry_texts(root)? {
            let text = text.map_err(|problem| refused(root, &path, problem))?;
            own.files.push(listed(path, "entry", &text));
        }
        for TextFile { path, text, .. } in manifest_texts(root)? {
            let text = text.map_err(|problem| refused(root, &path, problem))?;
            let manifest = Manifest::parse(&text)
                .map_err(|damage| refused(root, &path, damage.problem))?
                .manifest;
            own.created = own.created.max(manifest.created);
            licences.extend(manifest.licence);
            for author in manifest.authors {
                let is_same = |known: &Author| match &author.orcid {
                    Some(orcid) => known.orcid.as_ref() == Some(orcid),
                    None => known.name == author.name,
                };
                if !own.authors.iter().any(is_same) {
                    own.authors.push(author);
                }
            }
            own.files.push(listed(path, "manifest", &text));
        }
        Ok(Folder {
            manifest: own,
            description: description(sensors),
            licences: licences.into_iter().collect(),
        })
    }
}

fn refused(root: &Path, path: &str, problem: String) -> CatalogueFolderError {
    CatalogueFolderError::refused(&root.join(path), problem)
}

fn listed(path: String, role: &str, text: &str) -> BundledFile {
    BundledFile {
        path,
        size: text.len() as u64,
        sha256: digest_of_bytes(text.as_bytes()),
        role: role.to_owned(),
    }
}
