//! Checks the form of a bundle: files against the manifest, schemas, seals, and generated files.

use std::collections::BTreeSet;
use std::num::NonZeroUsize;

use taceva_results::EvaluationReport;

use crate::author::{Author, MOST_NAME};
use crate::claim_list;
use crate::environment::{ENVIRONMENT_SCHEMA, Environment};
use crate::error::{BundleError, Damage};
use crate::header;
use crate::layout::{
    ENVIRONMENT, HEADER, HEADER_ROLE, MANIFEST, MOST_AUTHORS, MOST_CLAIMS, MOST_TEXT, RESULTS,
    SAMPLES, is_header,
};
use crate::licence::has_form;
use crate::manifest::{Manifest, badge_of, model_digest, source_of};
use crate::name;
use crate::sample_digest::{SAMPLES_SCHEMA, SampleDigest, StudySamples};
use crate::source::Source;
use crate::table_facts::TableFacts;
use crate::texts;

/// Rule for tables of samples.
const TABLE_RULE: &str = "the table of samples is that of the results";
/// Rule for model files.
const MODEL_RULE: &str = "the model is that of the results";
/// Maximum number of findings of damage that are listed.
const MOST_DAMAGE: usize = 50;

/// Differences of the files from the manifest, byte for byte.
///
/// # Errors
/// [`BundleError::File`] for a file that cannot be read.
pub(crate) fn files(source: &Source, manifest: &Manifest) -> Result<Vec<Damage>, BundleError> {
    let mut damage = Vec::new();
    let mut listed: BTreeSet<&str> = BTreeSet::from([MANIFEST]);
    for file in &manifest.files {
        if damage.len() >= MOST_DAMAGE {
            return Ok(damage);
        }
        let mut add = |rule, problem: String| damage.push(Damage::new(&file.path, rule, problem));
        if let Some(fault) = name::fault(&file.path) {
            add(name::RULE, fault);
            continue;
        }
        if !listed.insert(&file.path) {
            add(
                "the manifest lists each file once",
                "it is listed twice".to_owned(),
            );
            continue;
        }
        let Some(size) = source.files().get(&file.path) else {
            add("every listed file is there", "it is missing".to_owned());
            continue;
        };
        if *size != file.size {
            let problem = format!("{size} bytes, expected {}", file.size);
            add("sizes are those of the manifest", problem);
            continue;
        }
        let found = source.digest(&file.path)?;
        if found != file.sha256 {
            let problem = format!("SHA-256 {found}, expected {}", file.sha256);
            add("digests are those of the manifest", problem);
        }
    }
    let extra = source
        .files()
        .keys()
        .filter(|name| !listed.contains(name.as_str()));
    for name in extra.take(MOST_DAMAGE) {
        let problem =
            "bundle.json does not list this file; remove the file, or make the bundle again";
        damage.push(Damage::new(name, "no file is added", problem));
    }
    Ok(damage)
}

/// Results of the bundle.
///
/// # Errors
/// [`Damage`] if the results cannot be read.
pub(crate) fn results(source: &Source) -> Result<Vec<EvaluationReport>, Damage> {
    let text = source.text(RESULTS, MOST_TEXT)?;
    taceva_results::read(&text).map_err(|error| {
        Damage::new(
            RESULTS,
            "results have their schema and seal",
            error.to_string(),
        )
    })
}

/// Faults of the form of a bundle whose files match its manifest. Does not check states.
pub(crate) fn form(
    source: &Source,
    manifest: &Manifest,
    reports: &[EvaluationReport],
    jobs: NonZeroUsize,
) -> Vec<Damage> {
    let mut damage = Vec::new();
    damage.extend(studies(source, manifest, reports));
    damage.extend(origin(manifest, reports));
    damage.extend(owners(manifest));
    if damage.is_empty() {
        damage.extend(claim_list::fault(manifest, reports));
    }
    if !damage.is_empty() {
        return damage;
    }
    damage.extend(environment(source).err());
    let tables = TableFacts::of(source, manifest, jobs);
    damage.extend(samples(source, manifest, reports, &tables));
    let known = header::known(reports);
    // Finds headers by role and by name, so that another role hides no header.
    let headers = manifest
        .files
        .iter()
        .filter(|file| file.role == HEADER_ROLE || is_header(&file.path));
    damage.extend(headers.filter_map(|file| dataset_header(source, &file.path, &known).err()));
    // Only for undamaged bundles of this version: other versions may generate other texts, and unchecked digests may have any length.
    if damage.is_empty() && manifest.taceva == env!("CARGO_PKG_VERSION") {
        let mut restored = manifest.clone();
        for claim in &mut restored.claims {
            // Restores numbers from the results, so that an edited claim is reported as a number and not as a text.
            *claim = claim.as_in(&reports[claim.study]);
        }
        for (name, expected) in texts::all(&restored, &tables.columns) {
            let rule = "generated files are what bundle.json and results.json give";
            match source.text(name, MOST_TEXT) {
                Ok(found) if found == expected => {}
                Ok(_) => damage.push(Damage::new(name, rule, "the text of the file differs")),
                Err(own) => damage.push(own),
            }
        }
    }
    damage
}

/// Faults of the files behind studies.
fn studies(source: &Source, manifest: &Manifest, reports: &[EvaluationReport]) -> Vec<Damage> {
    let rule = "each study of the results has its files";
    if manifest.studies.len() != reports.len() {
        let problem = format!(
            "{} in bundle.json, {} in results.json",
            manifest.studies.len(),
            reports.len()
        );
        return vec![Damage::new(MANIFEST, rule, problem)];
    }
    let scores: usize = reports.iter().map(|report| report.scores.len()).sum();
    if scores.max(manifest.claims.len()) > MOST_CLAIMS {
        let problem = format!(
            "{scores} scores and {} claims, expected at most {MOST_CLAIMS}",
            manifest.claims.len()
        );
        return vec![Damage::new(MANIFEST, rule, problem)];
    }
    let mut damage = Vec::new();
    let mut behind = BTreeSet::new();
    for (files, report) in manifest.studies.iter().zip(reports) {
        // A state named twice would narrow intervals, and a file of many studies would be read many times.
        let mut named = files.names().chain(&files.frames);
        if let Some(name) = named.find(|name| !behind.insert(name.as_str())) {
            let rule = "a file belongs to one study, once";
            damage.push(Damage::new(name, rule, "it is named twice in `studies`"));
            continue;
        }
        let headers = files
            .frames
            .iter()
            .map(|folder| format!("{folder}/{HEADER}"));
        let unlisted = files
            .names()
            .cloned()
            .chain(headers)
            .find(|name| !source.files().contains_key(name));
        if let Some(name) = unlisted {
            damage.push(Damage::new(&name, rule, "it is missing"));
            continue;
        }
        let table = report.provenance.samples_table.as_deref();
        let model = model_digest(report);
        for (name, stated, rule, key) in [
            (&files.samples, table, TABLE_RULE, "samples_table"),
            (&files.model, model, MODEL_RULE, "model.digest"),
        ] {
            if let Some(name) = name
                && manifest.digest(name) != stated
            {
                let stated = stated.unwrap_or("none");
                let problem = format!("another digest than `{key}` of results.json: {stated}");
                damage.push(Damage::new(name, rule, problem));
            }
        }
    }
    if manifest
        .claims
        .iter()
        .any(|claim| claim.study >= reports.len())
    {
        damage.push(Damage::new(
            MANIFEST,
            rule,
            "a claim names a study that is missing",
        ));
    }
    damage
}

/// Fault if an origin in the manifest, of the bundle or of a study, differs from the origin in the results.
fn origin(manifest: &Manifest, reports: &[EvaluationReport]) -> Option<Damage> {
    let rule = "the origin of samples is that of the results";
    let (source, badge) = (source_of(reports), badge_of(reports));
    for (number, (files, report)) in manifest.studies.iter().zip(reports).enumerate() {
        let expected = &report.subject.source;
        // The first bundles of this schema state one origin for all studies.
        if !files.source.is_empty() && files.source != *expected {
            let problem = format!(
                "study {number} has the origin `{}`, expected `{expected}`",
                files.source
            );
            return Some(Damage::new(MANIFEST, rule, problem));
        }
    }
    let is_same = manifest.source == source && manifest.badge == badge;
    (!is_same).then(|| {
        let problem = format!(
            "origin `{}` with the badge `{}`, expected `{source}` and `{}`",
            manifest.source,
            manifest.badge.as_deref().unwrap_or("none"),
            badge.as_deref().unwrap_or("none"),
        );
        Damage::new(MANIFEST, rule, problem)
    })
}

/// Fault of authors, organization or licence, which generated files repeat; `None` without a fault.
pub(crate) fn owners(manifest: &Manifest) -> Option<Damage> {
    let authors = &manifest.authors;
    let organization = manifest.organization.as_ref();
    let licence = manifest.licence.as_deref();
    let problem = if authors.len() > MOST_AUTHORS {
        format!("{} authors, expected at most {MOST_AUTHORS}", authors.len())
    } else if let Some(position) = authors.iter().position(|author| !author.is_right()) {
        let number = position + 1;
        format!(
            "author {number}: expected a printable name of 1 to {MOST_NAME} bytes, and an ORCID, if any, with a valid check digit"
        )
    } else if let Some(position) = repeated(authors) {
        let number = position + 1;
        format!("author {number} has the ORCID of an earlier author, expected each author once")
    } else if organization.is_some_and(|own| !own.is_right()) {
        format!(
            "organization: expected a printable name of 1 to {MOST_NAME} bytes, and the address of its page"
        )
    } else if licence.is_some_and(|own| !has_form(own)) {
        "licence: expected an SPDX identifier, such as CC-BY-4.0".to_owned()
    } else {
        return None;
    };
    let rule = "authors, organization and licence are those that `taceva bundle` takes";
    Some(Damage::new(MANIFEST, rule, problem))
}

/// Position of the first author with the ORCID of an earlier author. Generated files identify authors by ORCID.
fn repeated(authors: &[Author]) -> Option<usize> {
    let mut known = BTreeSet::new();
    let mut orcids = authors.iter().map(|author| author.orcid.as_ref());
    orcids.position(|orcid| orcid.is_some_and(|own| !known.insert(own)))
}

/// Rejects a header without its seal, and a header of a dataset that is not in `known`.
fn dataset_header(source: &Source, name: &str, known: &[&str]) -> Result<(), Damage> {
    let text = source.text(name, MOST_TEXT)?;
    let rule = "headers of datasets have their seal";
    taceva_files::seal::toml_text::check(&text)
        .map_err(|error| Damage::new(name, rule, error.to_string()))?;
    let rule = "headers are those of the datasets of results.json";
    let digest = header::digest(&text).map_err(|problem| Damage::new(name, rule, problem))?;
    match header::fault(&digest, known) {
        None => Ok(()),
        Some(problem) => Err(Damage::new(name, rule, problem)),
    }
}

/// The machine that made the bundle.
///
/// # Errors
/// [`Damage`] if `environment.json` has another schema.
pub(crate) fn environment(source: &Source) -> Result<Environment, Damage> {
    let rule = "environment.json has its schema";
    let text = source.text(ENVIRONMENT, MOST_TEXT)?;
    let found: Environment = serde_json::from_str(&text)
        .map_err(|error| Damage::new(ENVIRONMENT, rule, error.to_string()))?;
    match found.schema == ENVIRONMENT_SCHEMA {
        true => Ok(found),
        false => {
            let problem = format!("schema `{}`, expected `{ENVIRONMENT_SCHEMA}`", found.schema);
            Err(Damage::new(ENVIRONMENT, rule, problem))
        }
    }
}

/// First fault of the digest of samples; `None` without a fault.
fn samples(
    source: &Source,
    manifest: &Manifest,
    reports: &[EvaluationReport],
    tables: &TableFacts<'_>,
) -> Option<Damage> {
    let rule = "samples.json is the digest of the samples";
    let refused = |problem: String| Some(Damage::new(SAMPLES, rule, problem));
    let text = match source.text(SAMPLES, MOST_TEXT) {
        Ok(text) => text,
        Err(damage) => return Some(damage),
    };
    let found: SampleDigest = match serde_json::from_str(&text) {
        Ok(found) => found,
        Err(error) => return refused(error.to_string()),
    };
    if found.schema != SAMPLES_SCHEMA || found.digest != manifest.samples_digest {
        return refused(format!(
            "schema `{}` and digest {}, expected `{SAMPLES_SCHEMA}` and {}",
            found.schema, found.digest, manifest.samples_digest
        ));
    }
    if found.studies.len() != reports.len() || SampleDigest::of(found.studies.clone()) != found {
        return refused("its digest does not match its studies".to_owned());
    }
    for ((files, report), stated) in manifest.studies.iter().zip(reports).zip(&found.studies) {
        let Some(table) = files.sample_table() else {
            let is_withheld = stated.by == "samples" && manifest.withholds_tables();
            if !is_withheld && *stated != StudySamples::of_provenance(report) {
                return refused(
                    "a study without a table: expected the digest of its provenance".to_owned(),
                );
            }
            continue;
        };
        let again = match tables.samples(table) {
            Ok(again) => again,
            Err(reason) => return refused(reason.to_owned()),
        };
        if again != stated {
            return refused(format!(
                "digest {} of {table}, expected {}",
                again.digest, stated.digest
            ));
        }
    }
    None
}
