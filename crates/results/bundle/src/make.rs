//! Makes a bundle: writes a temporary copy, compares its numbers with recomputed numbers, then renames the copy.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use taceva_core::{SilentProgress, counted, distinct, shown};
use taceva_files::{Staged, TemporaryFolder, parent_of, replace};

use crate::archive;
use crate::claim::{claims, words};
use crate::environment::Environment;
use crate::error::BundleError;
use crate::form::owners;
use crate::inputs::Inputs;
use crate::layout::{
    ENVIRONMENT, FRAMES, FRAMES_ROLE, HEADER_ROLE, MANIFEST, MOST_CLAIMS, MOST_MANIFEST, MOST_TEXT,
    RESULTS, SAMPLES, is_own,
};
use crate::manifest::{BUNDLE_SCHEMA, Manifest, StudyFiles, badge_of, source_of};
use crate::operators;
use crate::redaction::{Redaction, redacted};
use crate::request::BundleRequest;
use crate::sample_digest::{SampleDigest, StudySamples};
use crate::source::Source;
use crate::table_facts::TableFacts;
use crate::texts;
use crate::verification::{ClaimCheck, Verdict};
use crate::verify::{VerifyRequest, check};
use crate::writer::Writer;

/// Prefix of the folder in which a packed bundle is made.
const STAGED: &str = ".taceva-bundle-";
/// Remedy for a bundle that would not pass its verification.
const REMEDY: &str =
    "name the state and the tables of this result, or leave tables out by --without predictions";

/// Result of making a bundle.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MadeBundle {
    /// Manifest of the bundle.
    pub manifest: Manifest,
    /// Remarks for the maker of the bundle.
    pub notes: Vec<String>,
}

/// Makes a bundle at `out`: one file if the name ends in `.tar.gz`, else a folder. On failure, `out` is unchanged.
///
/// # Errors
/// [`BundleError::Input`] if results, states and tables do not belong together; other errors if a file cannot be read or written.
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

/// Rejects a folder with files that do not belong to a bundle.
fn check_replaceable(out: &Path) -> Result<(), BundleError> {
    let refused = |what: &str| {
        let problem = format!("{what}, but only a bundle is replaced; name another path");
        Err(BundleError::input(out, problem))
    };
    if !out.join(MANIFEST).is_file() {
        return refused("a folder that is not a bundle");
    }
    let Ok(source) = Source::open(out, u64::MAX) else {
        return refused("a folder with links, or with names that no bundle contains");
    };
    match source.files().keys().find(|name| !is_own(name)) {
        Some(name) => refused(&format!("a folder with `{name}`, which no bundle contains")),
        None => Ok(()),
    }
}

/// Writes the bundle into the empty folder `root`, the manifest last.
fn write(inputs: &Inputs, request: &BundleRequest, root: &Path) -> Result<MadeBundle, BundleError> {
    let mut writer = Writer::new(root);
    writer.add(RESULTS, "results", inputs.text.as_bytes())?;
    let (mut studies, mut withheld, mut samples) = (Vec::new(), Vec::new(), Vec::new());
    for (number, (study, report)) in inputs.studies.iter().zip(&inputs.reports).enumerate() {
        let table = study.tables.as_ref().map(|tables| &tables.truth);
        samples.push(match table.or(study.samples.as_ref()) {
            Some(table) => StudySamples::of_table(table, request.jobs)?,
            None => StudySamples::of_provenance(report),
        });
        let files = writer.study(number, study, request.withholds_predictions, &mut withheld)?;
        studies.push(StudyFiles {
            source: report.subject.source.clone(),
            ..files
        });
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
        organization: request.organization.clone(),
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
    if let Some(fault) = owners(&manifest) {
        return Err(BundleError::Damaged(fault));
    }
    set_levels(&mut manifest, inputs, request, root)?;
    manifest.files = writer.sorted();
    let source = Source::open(root, u64::MAX)?;
    let tables = TableFacts::of(&source, &manifest, request.jobs).columns;
    for (name, text) in texts::all(&manifest, &tables) {
        writer.add(name, "card", text.as_bytes())?;
    }
    manifest.files = writer.sorted();
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
    let refused = |problem: &str| {
        let problem = as_given(problem, manifest, inputs, root);
        BundleError::input(&inputs.path, format!("{problem}; {REMEDY}"))
    };
    if let Some(damage) = checked.damage.first() {
        return Err(refused(&damage.to_string()));
    }
    let is_wrong = |claim: &&ClaimCheck| match claim.verdict {
        Verdict::Differs => true,
        Verdict::NotRecomputable => !claim.is_absent,
        _ => false,
    };
    if let Some(claim) = checked.claims.iter().find(is_wrong) {
        let claim_words = words(&claim.metric, claim.variant.as_deref(), &claim.channel);
        let reason = claim.reason.as_deref().unwrap_or("it differs");
        return Err(refused(&format!("{claim_words}: {reason}")));
    }
    let mut others = checked.others.iter();
    if let Some(other) = others.find(|other| other.verdict == Verdict::Differs) {
        return Err(refused(&format!("{}: {}", other.part, other.reason)));
    }
    for (claim, check) in manifest.claims.iter_mut().zip(&checked.claims) {
        claim.level = check.level;
    }
    Ok(())
}

/// `problem` with the caller's paths in place of the paths of the copies below `root`.
fn as_given(problem: &str, manifest: &Manifest, inputs: &Inputs, root: &Path) -> String {
    let mut problem = problem.to_owned();
    for (files, study) in manifest.studies.iter().zip(&inputs.studies) {
        let mut tables = Vec::new();
        if let (Some(copies), Some(given)) = (&files.tables, &study.tables) {
            tables.push((&copies.truth, &given.truth));
            tables.push((&copies.prediction, &given.prediction));
        }
        let states = files.states.iter().zip(&study.states);
        let samples = files.samples.iter().zip(&study.samples);
        for (copy, given) in states.chain(samples).chain(tables) {
            let copy = shown(&root.join(copy)).to_string();
            problem = problem.replace(&copy, &shown(given).to_string());
        }
    }
    problem
}

/// Names of the sensors of the results.
fn sensors(inputs: &Inputs) -> String {
    let names = inputs.reports.iter();
    distinct(names.map(|report| report.subject.sensor.as_str())).join(", ")
}

/// Remarks for the author of the bundle: its badge, its operators, its pictures, and words that redaction cannot change.
fn notes(inputs: &Inputs, request: &BundleRequest, written: &Writer<'_>) -> Vec<String> {
    let mut notes: Vec<String> = badge_of(&inputs.reports).into_iter().collect();
    notes.extend(operators::note(inputs, written));
    let frames = written.files.iter().filter(|file| file.role == FRAMES_ROLE);
    let sizes: Vec<u64> = frames.map(|file| file.size).collect();
    if !sizes.is_empty() {
        notes.push(format!(
            "{FRAMES}/ has {} ({} bytes): the pictures of all predicted samples, and all labels of their recordings",
            counted(sizes.len() as u64, "file"),
            sizes.iter().sum::<u64>()
        ));
    }
    if request.redactions.contains(&Redaction::Serials) {
        let serials = inputs
            .reports
            .iter()
            .map(|report| report.subject.serial.as_str());
        let serials: Vec<&str> = serials.filter(|serial| *serial != "unknown").collect();
        if !serials.is_empty() {
            notes.push(format!(
                "--redact does not change results, states and dataset headers, which are sealed: they contain the serial numbers {}",
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
        // A Parquet table is not text.
        let text = fs::read_to_string(written.root.join(&file.path)).unwrap_or_default();
        let (_, count) = redacted(&text, &request.redactions);
        if count > 0 {
            notes.push(format!(
                "--redact does not change {}, which is sealed or was scored: it contains {} to redact",
                file.path,
                counted(count, "word")
            ));
        }
    }
    notes
}
