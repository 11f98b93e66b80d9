//! Making of a bundle: written beside its place, compared with what was computed again, then renamed.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::Path;

use taceva_core::{SilentProgress, counted};
use taceva_files::seal::digest_of_bytes;
use taceva_files::{Staged, TemporaryFolder, parent_of, replace, sync_folder};

use crate::archive;
use crate::card;
use crate::claim::{claims, words};
use crate::environment::Environment;
use crate::error::BundleError;
use crate::inputs::{Inputs, StudyInputs, ending};
use crate::layout::{
    ENVIRONMENT, HEADER_ROLE, MANIFEST, MODEL_ROLE, MOST_CLAIMS, MOST_MANIFEST, MOST_MODEL,
    MOST_TABLE, MOST_TEXT, RESULTS, SAMPLES, is_own,
};
use crate::manifest::{
    BUNDLE_SCHEMA, BundledFile, Manifest, StudyFiles, TableFiles, Withheld, badge_of, source_of,
};
use crate::redaction::{Redaction, redacted};
use crate::request::BundleRequest;
use crate::sample_digest::{SampleDigest, StudySamples};
use crate::source::{Source, digest_of};
use crate::verification::{ClaimCheck, Verdict};
use crate::verify::{VerifyRequest, check};

/// Prefix of the folder in which a packed bundle is made.
const STAGED: &str = ".taceva-bundle-";
/// Remedy where a bundle would not verify.
const REMEDY: &str =
    "name the state and the tables of this result, or leave tables out by --without predictions";

/// Bundle that was made.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MadeBundle {
    /// Manifest of the bundle.
    pub manifest: Manifest,
    /// Remarks for the maker of the bundle.
    pub notes: Vec<String>,
}

/// Makes a bundle at `out`: one file if the name ends in `.tar.gz`, else a folder. The place is as it was before if this fails.
///
/// # Errors
/// [`BundleError::Input`] if results, states and tables do not belong together; others if a file cannot be read or written.
pub fn make(request: &BundleRequest, out: &Path) -> Result<MadeBundle, BundleError> {
    let inputs = Inputs::find(request)?;
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    if name.ends_with(".tar.gz") {
        let parent = parent_of(out);
        let folder = TemporaryFolder::create(parent, STAGED).map_err(BundleError::file(parent))?;
        let content = folder.path().join("content");
        fs::create_dir(&content).map_err(BundleError::file(&content))?;
        let made = write(&inputs, request, &content)?;
        let mut names: Vec<String> = vec![MANIFEST.to_owned()];
        names.extend(made.manifest.files.iter().map(|file| file.path.clone()));
        names.sort_unstable();
        replace(out, |staged| archive::pack(&content, &names, staged))
            .map_err(BundleError::file(out))?;
        return Ok(made);
    }
    if out.is_dir() {
        check_replaceable(out)?;
    }
    let staged = Staged::beside(out).map_err(BundleError::file(out))?;
    fs::create_dir(staged.path()).map_err(BundleError::file(out))?;
    let made = write(&inputs, request, staged.path())?;
    staged.put_in_place().map_err(BundleError::file(out))?;
    Ok(made)
}

/// Rejects a folder with anything but files of a bundle.
fn check_replaceable(out: &Path) -> Result<(), BundleError> {
    let refused = |what: &str| {
        let problem = format!("{what}, which is not replaced; name another place");
        Err(BundleError::input(out, problem))
    };
    if !out.join(MANIFEST).is_file() {
        return refused("a folder that is no bundle");
    }
    let Ok(source) = Source::open(out, u64::MAX) else {
        return refused("a folder with links, or with names that no bundle writes");
    };
    match source.files().keys().find(|name| !is_own(name)) {
        Some(name) => refused(&format!("a folder with `{name}`, which no bundle writes")),
        None => Ok(()),
    }
}

/// Writes the bundle into the empty folder `root`, the manifest last.
fn write(inputs: &Inputs, request: &BundleRequest, root: &Path) -> Result<MadeBundle, BundleError> {
    let mut writer = Writer {
        root,
        files: Vec::new(),
    };
    writer.add(RESULTS, "results", inputs.text.as_bytes())?;
    let (mut studies, mut withheld, mut samples) = (Vec::new(), Vec::new(), Vec::new());
    for (number, (study, report)) in inputs.studies.iter().zip(&inputs.reports).enumerate() {
        let table = study.tables.as_ref().map(|tables| &tables.truth);
        samples.push(match table.or(study.samples.as_ref()) {
            Some(table) => StudySamples::of_table(table, request.jobs)?,
            None => StudySamples::of_provenance(report),
        });
        let files = writer.study(number, study, request.withholds_predictions, &mut withheld)?;
        studies.push(files);
    }
    let samples = SampleDigest::of(samples);
    writer.json(SAMPLES, "samples digest", &samples)?;
    let environment = Environment::here(&inputs.reports, request.jobs);
    writer.json(ENVIRONMENT, "environment", &environment)?;
    let mut counts = BTreeMap::new();
    for (name, text) in &inputs.texts {
        let (text, count) = redacted(text, &request.redactions);
        writer.add(name, "text", text.as_bytes())?;
        if count > 0 {
            counts.insert(name.clone(), count);
        }
    }
    for (text, number) in inputs.headers.iter().zip(1_usize..) {
        let name = match number {
            1 => "dataset.toml".to_owned(),
            number => format!("dataset-{number}.toml"),
        };
        writer.add(&name, HEADER_ROLE, text.as_bytes())?;
    }
    let mut all_claims = Vec::new();
    for (number, (report, files)) in inputs.reports.iter().zip(&studies).enumerate() {
        let from: Vec<String> = files.names().cloned().collect();
        all_claims.extend(claims(number, report, &from));
    }
    let mut manifest = Manifest {
        schema: BUNDLE_SCHEMA.to_owned(),
        name: request.name.clone().unwrap_or_else(|| sensors(inputs)),
        created: request.created.clone(),
        taceva: env!("CARGO_PKG_VERSION").to_owned(),
        licence: request.licence.clone(),
        authors: request.authors.clone(),
        is_unfinished: request.authors.is_empty() || request.licence.is_none(),
        source: source_of(&inputs.reports),
        badge: badge_of(&inputs.reports),
        files: Vec::new(),
        studies,
        claims: all_claims,
        withheld,
        redacted: counts,
        samples_digest: samples.digest,
    };
    set_levels(&mut manifest, inputs, request, root)?;
    for (name, text) in card::texts(&manifest) {
        writer.add(name, "card", text.as_bytes())?;
    }
    manifest.files = writer.files.clone();
    manifest
        .files
        .sort_by(|one, other| one.path.cmp(&other.path));
    let text = manifest.sealed()?;
    let scores = inputs.reports.iter().map(|report| report.scores.len());
    let numbers = scores.sum::<usize>().max(manifest.claims.len());
    if numbers > MOST_CLAIMS || text.len() as u64 > MOST_MANIFEST {
        let problem = format!(
            "{} in a manifest of {} bytes, expected at most {MOST_CLAIMS} in {MOST_MANIFEST}; bundle the result of one study",
            counted(numbers as u64, "number"),
            text.len()
        );
        return Err(BundleError::input(&inputs.path, problem));
    }
    writer.add(MANIFEST, "manifest", text.as_bytes())?;
    writer.sync()?;
    Ok(MadeBundle {
        notes: notes(inputs, request, &writer),
        manifest,
    })
}

/// Computes all claims again and sets the level that each reached. Rejects claims that differ.
fn set_levels(
    manifest: &mut Manifest,
    inputs: &Inputs,
    request: &BundleRequest,
    root: &Path,
) -> Result<(), BundleError> {
    let source = Source::open(root, u64::MAX)?;
    let mut asked = VerifyRequest::new(root);
    asked.jobs = request.jobs;
    let checked = check(&source, manifest, &inputs.reports, &asked, &SilentProgress);
    if let Some(damage) = checked.damage.first() {
        let problem = format!("{damage}; {REMEDY}");
        return Err(BundleError::input(&inputs.path, problem));
    }
    let is_wrong = |claim: &&ClaimCheck| match claim.verdict {
        Verdict::Differs => true,
        Verdict::NotRecomputable => !claim.is_absent,
        _ => false,
    };
    if let Some(claim) = checked.claims.iter().find(is_wrong) {
        let claim_words = words(&claim.metric, claim.variant.as_deref(), &claim.channel);
        let reason = claim.reason.as_deref().unwrap_or("it differs");
        let problem = format!("{claim_words}: {reason}; {REMEDY}");
        return Err(BundleError::input(&inputs.path, problem));
    }
    let mut others = checked.others.iter();
    if let Some(other) = others.find(|other| other.verdict == Verdict::Differs) {
        let problem = format!("{}: {}; {REMEDY}", other.part, other.reason);
        return Err(BundleError::input(&inputs.path, problem));
    }
    for (claim, check) in manifest.claims.iter_mut().zip(&checked.claims) {
        claim.level = check.level;
    }
    Ok(())
}

/// Names of the sensors of the results.
fn sensors(inputs: &Inputs) -> String {
    let mut names: Vec<&str> = Vec::new();
    for report in &inputs.reports {
        let sensor = report.subject.sensor.as_str();
        if !names.contains(&sensor) {
            names.push(sensor);
        }
    }
    names.join(", ")
}

/// Remarks for the maker: what the bundle says that redaction cannot change.
fn notes(inputs: &Inputs, request: &BundleRequest, written: &Writer<'_>) -> Vec<String> {
    let mut notes: Vec<String> = badge_of(&inputs.reports).into_iter().collect();
    if request.redactions.contains(&Redaction::Serials) {
        let serials = inputs
            .reports
            .iter()
            .map(|report| report.subject.serial.as_str());
        let serials: Vec<&str> = serials.filter(|serial| *serial != "unknown").collect();
        if !serials.is_empty() {
            notes.push(format!(
                "results, states and headers of datasets are sealed and stay as they are: they name the unit {}",
                serials.join(", ")
            ));
        }
    }
    let kept = [
        "results",
        "state",
        HEADER_ROLE,
        "truth",
        "prediction",
        "samples",
    ];
    for file in &written.files {
        if !kept.contains(&file.role.as_str()) || file.size > MOST_TEXT {
            continue;
        }
        // A table of Parquet is no text.
        let text = fs::read_to_string(written.root.join(&file.path)).unwrap_or_default();
        let (_, count) = redacted(&text, &request.redactions);
        if count > 0 {
            notes.push(format!(
                "{} stays as it was sealed or scored, with {} that --redact replaces in texts",
                file.path,
                counted(count, "word")
            ));
        }
    }
    notes
}

/// Files of a bundle while it is written.
struct Writer<'a> {
    root: &'a Path,
    files: Vec<BundledFile>,
}

impl Writer<'_> {
    /// Writes a new file.
    fn add(&mut self, name: &str, role: &str, bytes: &[u8]) -> Result<(), BundleError> {
        let path = self.root.join(name);
        let folder = parent_of(&path);
        fs::create_dir_all(folder).map_err(BundleError::file(folder))?;
        let written = File::create_new(&path).and_then(|mut file| {
            file.write_all(bytes)?;
            file.sync_all()
        });
        written.map_err(BundleError::file(&path))?;
        self.files.push(BundledFile {
            path: name.to_owned(),
            size: bytes.len() as u64,
            sha256: digest_of_bytes(bytes),
            role: role.to_owned(),
        });
        Ok(())
    }

    /// Writes a value as JSON.
    fn json(
        &mut self,
        name: &str,
        role: &str,
        value: &impl serde::Serialize,
    ) -> Result<(), BundleError> {
        let text = serde_json::to_string_pretty(value)
            .map_err(|error| BundleError::input(Path::new(name), error.to_string()))?;
        self.add(name, role, format!("{text}\n").as_bytes())
    }

    /// Copies the file at `from`, of at most `most` bytes.
    fn copy(&mut self, name: &str, role: &str, from: &Path, most: u64) -> Result<(), BundleError> {
        let about = fs::metadata(from).map_err(BundleError::file(from))?;
        if !about.is_file() || about.len() > most {
            let remedy = match role {
                "state" => "score fewer metrics by --metrics",
                MODEL_ROLE => "leave the model out",
                _ => "leave tables out by --without predictions",
            };
            let problem = format!(
                "{} bytes, expected a regular file of at most {most}; {remedy}",
                about.len()
            );
            return Err(BundleError::input(from, problem));
        }
        let bytes = fs::read(from).map_err(BundleError::file(from))?;
        self.add(name, role, &bytes)
    }

    /// Copies the files of study `number`, or states the digests of its tables.
    fn study(
        &mut self,
        number: usize,
        study: &StudyInputs,
        is_without_tables: bool,
        withheld: &mut Vec<Withheld>,
    ) -> Result<StudyFiles, BundleError> {
        let mut files = StudyFiles::default();
        for (position, from) in study.states.iter().enumerate() {
            let name = match position {
                0 => format!("states/{number}.json"),
                position => format!("states/{number}-{position}.json"),
            };
            self.copy(&name, "state", from, MOST_TEXT)?;
            files.states.push(name);
        }
        if let Some(from) = &study.model {
            let name = format!("model/{number}.taceva");
            self.copy(&name, MODEL_ROLE, from, MOST_MODEL)?;
            files.model = Some(name);
        }
        withheld.extend(study.withheld_model());
        if is_without_tables {
            let tables = study.tables.iter();
            let tables = tables
                .flat_map(|tables| [("truth", &tables.truth), ("prediction", &tables.prediction)]);
            let samples = study.samples.iter().map(|samples| ("samples", samples));
            for (role, from) in tables.chain(samples) {
                withheld.push(Withheld {
                    role: role.to_owned(),
                    reason: "left out by --without predictions".to_owned(),
                    digest: digest_of(from)?,
                });
            }
            return Ok(files);
        }
        if let Some(tables) = &study.tables {
            let [truth, prediction] =
                [("truth", &tables.truth), ("prediction", &tables.prediction)]
                    .map(|(role, from)| format!("tables/{role}.{}", ending(from)));
            self.copy(&truth, "truth", &tables.truth, MOST_TABLE)?;
            self.copy(&prediction, "prediction", &tables.prediction, MOST_TABLE)?;
            files.tables = Some(TableFiles {
                truth,
                prediction,
                key: tables.key.clone(),
            });
        }
        if let Some(from) = &study.samples {
            let name = format!("tables/samples-{number}.csv");
            self.copy(&name, "samples", from, MOST_TABLE)?;
            files.samples = Some(name);
        }
        Ok(files)
    }

    /// Syncs the names of all files to disk.
    fn sync(&self) -> Result<(), BundleError> {
        for name in ["states", "tables", "model", ""] {
            let folder = self.root.join(name);
            if folder.is_dir() {
                sync_folder(&folder).map_err(BundleError::file(&folder))?;
            }
        }
        Ok(())
    }
}
