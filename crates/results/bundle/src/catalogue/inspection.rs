//! Check of a catalogue: entries, names, manifests, and each number against its manifest. No network is needed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use taceva_core::{counted, shown};
use taceva_files::seal::digest_of_bytes;
use taceva_report::catalogue::{self, Origin, Sensor};

use super::entry_place::{NAME_RULE, is_name};
use super::error::CatalogueFolderError;
use super::finding::CatalogueFinding;
use super::folder::{
    EntryFile, check_catalogue_folder, entry_files, entry_path, entry_texts, manifest_path,
    manifest_texts, write,
};
use super::index::Index;
use super::row_check;
use super::submission::{results_digest, unfinished};
use crate::manifest::Manifest;

/// File of the index.
const INDEX: &str = "index.json";

/// Outcome of a check.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct CatalogueCheck {
    /// Faults of the files of the catalogue.
    pub findings: Vec<CatalogueFinding>,
    /// Number of entries.
    pub entries: u64,
    /// Number of bundles.
    pub bundles: u64,
    /// Number of rows from bundles.
    pub numbers: u64,
    /// Text of the index.
    index: String,
}

/// Checks the catalogue at `root`.
///
/// # Errors
/// [`CatalogueFolderError`] if the folder cannot be read or is not a catalogue. Faults of files are listed instead.
pub fn check_catalogue(root: &Path) -> Result<CatalogueCheck, CatalogueFolderError> {
    check_catalogue_folder(root)?;
    let built_in = catalogue::all();
    let mut findings = Vec::new();
    let mut index = Index::default();
    let manifests = manifests(root, &mut findings, &mut index)?;
    let mut entries: Vec<EntryFile> = Vec::new();
    let mut rows: BTreeMap<String, u64> = BTreeMap::new();
    let (mut numbers, mut is_unreadable) = (0, false);
    for file in entry_texts(root)? {
        let text = match file.text {
            Ok(text) => text,
            Err(problem) => {
                is_unreadable = true;
                findings.push(CatalogueFinding::new(&file.path, problem));
                continue;
            }
        };
        let sensor = match Sensor::read(&file.path, &text) {
            Ok(sensor) => sensor,
            Err(error) => {
                is_unreadable = true;
                findings.push(CatalogueFinding::of_entry(&file.path, &error));
                continue;
            }
        };
        index.add_entry(&file.path, &sensor);
        findings.extend(name_faults(&file.path, &sensor, &built_in));
        findings.extend(row_faults(&file.path, &text, &sensor, &manifests));
        for row in sensor.all_rows() {
            numbers += 1;
            *rows.entry(manifest_path(&row.bundle)).or_default() += 1;
        }
        entries.push(EntryFile {
            path: file.path,
            text,
            sensor,
        });
    }
    findings.extend(alike(&entries, &built_in));
    // An unreadable entry may contain rows of any manifest.
    let known = manifests.iter().filter(|_| !is_unreadable);
    findings.extend(known.filter_map(|(path, manifest)| {
        let rows = rows.get(path).copied().unwrap_or_default();
        let problem = rows_fault(rows, manifest.claims.len() as u64)?;
        Some(CatalogueFinding::new(path, problem))
    }));
    findings.sort_by(|one, other| (&one.path, one.line).cmp(&(&other.path, other.line)));
    Ok(CatalogueCheck {
        findings,
        entries: entries.len() as u64,
        bundles: manifests.len() as u64,
        numbers,
        index: index.text(),
    })
}

/// Sensors of all entries of the catalogue at `root`, by file name. Each number of a bundle equals the number in its manifest.
///
/// # Errors
/// [`CatalogueFolderError`] with file and line for an invalid entry or a number that its manifest lacks, and for a folder that is not a catalogue.
pub fn entries(root: &Path) -> Result<Vec<Sensor>, CatalogueFolderError> {
    check_catalogue_folder(root)?;
    let manifests = manifests(root, &mut Vec::new(), &mut Index::default())?;
    let mut sensors = Vec::new();
    for EntryFile { path, text, sensor } in entry_files(root)? {
        let faults = row_faults(&path, &text, &sensor, &manifests);
        if let Some(fault) = faults.into_iter().next() {
            let place = match fault.line {
                Some(line) => format!("{path}:{line}"),
                None => path,
            };
            let problem = format!(
                "{}; run `taceva catalogue check {}`",
                fault.problem,
                shown(root)
            );
            return Err(CatalogueFolderError::refused(&root.join(place), problem));
        }
        sensors.push(sensor);
    }
    Ok(sensors)
}

/// Writes the index of a catalogue without a finding.
///
/// # Errors
/// [`CatalogueFolderError`] if the index cannot be written.
pub fn write_index(root: &Path, check: &CatalogueCheck) -> Result<(), CatalogueFolderError> {
    write(root, INDEX, &check.index)
}

/// Manifests by path, with the findings in them.
fn manifests(
    root: &Path,
    findings: &mut Vec<CatalogueFinding>,
    index: &mut Index,
) -> Result<BTreeMap<String, Manifest>, CatalogueFolderError> {
    let mut known = BTreeMap::new();
    let mut results: BTreeMap<String, String> = BTreeMap::new();
    for file in manifest_texts(root)? {
        let mut add = |problem: String| findings.push(CatalogueFinding::new(&file.path, problem));
        let text = match file.text {
            Ok(text) => text,
            Err(problem) => {
                add(problem);
                continue;
            }
        };
        let digest = digest_of_bytes(text.as_bytes());
        if digest != format!("sha256:{}", file.stem) {
            add(format!(
                "the digest of the file is {digest}, expected the digest in its name; restore the file"
            ));
            continue;
        }
        let manifest = match Manifest::parse(&text) {
            Ok(sealed) => sealed.manifest,
            Err(damage) => {
                add(damage.problem);
                continue;
            }
        };
        if let Some(problem) = unfinished(&manifest) {
            add(problem);
        }
        let own = results_digest(&manifest).unwrap_or_default().to_owned();
        if let Some(other) = results.insert(own, file.path.clone()) {
            add(format!(
                "the same results as {other}: expected each bundle once; remove one with its rows"
            ));
        }
        index.add_bundle(&file.path, &manifest);
        known.insert(file.path, manifest);
    }
    Ok(known)
}

/// Fault of a manifest with `claims` numbers, of which entries contain `rows`; `None` if entries contain all numbers.
fn rows_fault(rows: u64, claims: u64) -> Option<String> {
    match rows {
        0 => {
            let problem = "no entry has the numbers of this manifest; add the bundle again, or remove the file";
            Some(problem.to_owned())
        }
        rows if rows < claims => Some(format!(
            "entries hold {rows} of {} in this manifest: expected all; restore the other rows, or remove every row of the bundle and add it again",
            counted(claims, "number")
        )),
        _ => None,
    }
}

/// Faults of the name of an entry, and of its published numbers.
fn name_faults(path: &str, sensor: &Sensor, built_in: &[Sensor]) -> Vec<CatalogueFinding> {
    let mut faults = Vec::new();
    let file = entry_path(&sensor.slug());
    let is_built_in = built_in.iter().any(|known| known.name == sensor.name);
    if !is_built_in && !is_name(&sensor.name) {
        let problem = format!("the sensor `{}`: {NAME_RULE}", sensor.name);
        faults.push(CatalogueFinding::new(path, problem));
    } else if path != file {
        let problem = format!("the file of `{}`: expected the name {file}", sensor.name);
        faults.push(CatalogueFinding::new(path, problem));
    }
    if is_built_in && sensor.has_published() {
        let problem = format!(
            "published facts of `{}`, which the built-in catalogue has: expected only [[measured]], [[unknown]] and [[simulated]]",
            sensor.name
        );
        faults.push(CatalogueFinding::new(path, problem));
    }
    faults
}

/// Faults of rows: missing manifests, rows whose number is not in their manifest, and duplicate rows.
fn row_faults(
    path: &str,
    text: &str,
    sensor: &Sensor,
    manifests: &BTreeMap<String, Manifest>,
) -> Vec<CatalogueFinding> {
    let mut faults = Vec::new();
    let mut known = BTreeSet::new();
    let mut orphans: BTreeMap<String, (Option<usize>, u64)> = BTreeMap::new();
    for origin in Origin::ALL {
        let lines = catalogue::row_lines(text, origin);
        for (at, row) in sensor.rows(origin).iter().enumerate() {
            let manifest = manifest_path(&row.bundle);
            let is_new = known.insert((&row.bundle, row.study, row.words()));
            let fault = match manifests.get(&manifest) {
                _ if !is_new => Some(format!(
                    "{} of the bundle {} is listed twice: expected once",
                    row.words(),
                    row.short_bundle()
                )),
                None => {
                    let line = lines.get(at).copied();
                    orphans.entry(manifest).or_insert((line, 0)).1 += 1;
                    None
                }
                Some(manifest) => row_check::fault(row, manifest),
            };
            faults.extend(fault.map(|problem| CatalogueFinding {
                line: lines.get(at).copied(),
                ..CatalogueFinding::new(path, problem)
            }));
        }
    }
    faults.extend(orphans.into_iter().map(|(manifest, (line, count))| {
        let problem = format!(
            "{manifest} is missing or damaged, and {} of this entry from here on depend on the manifest: restore the manifest, or remove its rows and add the bundle again",
            counted(count, "number")
        );
        CatalogueFinding {
            line,
            ..CatalogueFinding::new(path, problem)
        }
    }));
    faults
}

/// Faults of entries that share a name or alias with another entry or a built-in sensor, apart from case and punctuation.
fn alike(entries: &[EntryFile], built_in: &[Sensor]) -> Vec<CatalogueFinding> {
    let mut findings = Vec::new();
    for (at, EntryFile { path, sensor, .. }) in entries.iter().enumerate() {
        let before = entries[..at].iter().map(|other| &other.sensor);
        let of_program = built_in.iter().filter(|known| known.name != sensor.name);
        let names: Vec<&String> = std::iter::once(&sensor.name)
            .chain(&sensor.aliases)
            .collect();
        for other in before.chain(of_program) {
            if let Some(name) = names.iter().find(|name| other.is_called_like(name)) {
                let problem = format!(
                    "the name `{name}` resembles a name of `{}`: expected one entry for one sensor, with its other names as `aliases`",
                    other.name
                );
                findings.push(CatalogueFinding::new(path, problem));
            }
        }
    }
    findings
}
