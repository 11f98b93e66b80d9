//! Verification of a bundle: files, form, scores, predictions and models, as deep as its files allow.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{Progress, SilentProgress, counted};
use taceva_evaluate::{PredictionCheck, Work};
use taceva_results::EvaluationReport;

use crate::error::{BundleError, Damage};
use crate::form;
use crate::layout::{MANIFEST, MOST_BYTES, MOST_MANIFEST, MOST_TABLE};
use crate::level::Level;
use crate::manifest::{Manifest, SealedManifest, StudyFiles};
use crate::recomputation::{self, Recomputation, RecomputationSettings};
use crate::source::Source;
use crate::study_check::{NO_SUCH_NUMBER, StudyCheck};
use crate::verification::{BundleFacts, ClaimCheck, OtherCheck, Verdict, Verification};

/// Request for a verification.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct VerifyRequest {
    /// The bundle: a folder, or a `.tar.gz`.
    pub path: PathBuf,
    /// Level to reach; `None` for the deepest level that the files allow.
    pub level: Option<Level>,
    /// Greatest difference between a claim and its recomputed number for the verdict `within`, in the unit of each score.
    pub tolerance: f64,
    /// Maximum size of all files together, bytes.
    pub most: u64,
    /// Recordings behind the results. The models of the bundle predict them again, as [`Level::Model`] and [`Level::Fit`] require. If empty,
    /// [`Level::Model`] reads the pictures in the bundle.
    pub datasets: Vec<PathBuf>,
    /// Number of threads.
    pub jobs: NonZeroUsize,
}

impl VerifyRequest {
    /// Verification of the bundle at `path`, as deep as its files allow, with tolerance 0.
    pub fn new(path: &Path) -> VerifyRequest {
        VerifyRequest {
            path: path.to_owned(),
            level: None,
            tolerance: 0.0,
            most: MOST_BYTES,
            datasets: Vec::new(),
            jobs: NonZeroUsize::MIN,
        }
    }

    /// Requested level. The default is [`Level::Model`] with recordings, otherwise [`Level::Predictions`].
    fn deepest(&self) -> Level {
        let default = match self.datasets.is_empty() {
            true => Level::Predictions,
            false => Level::Model,
        };
        self.level.unwrap_or(default)
    }
}

/// Verifies a bundle. Executes no content of the bundle.
///
/// # Errors
/// [`BundleError::File`] if the bundle cannot be read. Damage is listed in the result instead.
pub fn verify(request: &VerifyRequest) -> Result<Verification, BundleError> {
    verify_with(request, &SilentProgress)
}

/// Verifies a bundle as [`verify`], and shows the progress of predictions.
///
/// # Errors
/// As [`verify`].
pub fn verify_with(
    request: &VerifyRequest,
    progress: &dyn Progress,
) -> Result<Verification, BundleError> {
    let mut found = Verification::new(request.level);
    let most = request.deepest();
    let source = match Source::open(&request.path, request.most) {
        Ok(source) => source,
        Err(BundleError::Damaged(damage)) => {
            return Ok(found.damaged_at(Level::Files, vec![damage]));
        }
        Err(error) => return Err(error),
    };
    let read = source
        .text(MANIFEST, MOST_MANIFEST)
        .and_then(|text| Manifest::parse(&text));
    let sealed = match read {
        Ok(sealed) => sealed,
        Err(damage) => return Ok(found.damaged_at(Level::Files, vec![damage])),
    };
    let manifest = &sealed.manifest;
    found.bundle = Some(facts(&sealed));
    found.remarks.extend(manifest.remarks());
    found.remarks.extend(unchecked(manifest));
    let damage = form::files(&source, manifest)?;
    if !damage.is_empty() {
        return Ok(found.damaged_at(Level::Files, damage));
    }
    found.add_level(Level::Files, None);
    if most < Level::Form {
        return Ok(found);
    }
    let reports = match form::results(&source) {
        Ok(reports) => reports,
        Err(damage) => return Ok(found.damaged_at(Level::Form, vec![damage])),
    };
    for report in &reports {
        let edits = report.provenance.edits.iter();
        found
            .remarks
            .extend(edits.map(|edit| format!("Edited: {edit}.")));
    }
    let damage = match too_long(&source, manifest) {
        Some(damage) => vec![damage],
        None => form::form(&source, manifest, &reports, request.jobs),
    };
    if !damage.is_empty() {
        return Ok(found.damaged_at(Level::Form, damage));
    }
    let checked = check(&source, manifest, &reports, request, progress);
    if !checked.damage.is_empty() {
        return Ok(found.damaged_at(Level::Form, checked.damage));
    }
    add_levels(&mut found, &checked, most);
    found.remarks.extend(checked.remarks);
    found.claims = checked.claims;
    found.others = checked.others;
    Ok(found.summed())
}

/// Claims and other numbers, compared with recomputed numbers.
pub(crate) struct Checked {
    pub(crate) claims: Vec<ClaimCheck>,
    pub(crate) others: Vec<OtherCheck>,
    /// States that cannot be read.
    pub(crate) damage: Vec<Damage>,
    /// Reasons why a study has no scores computed from states.
    states: Vec<String>,
    /// Reasons why a study has no scores computed from tables.
    tables: Vec<String>,
    /// Reasons why a study was not compared with its model.
    models: Vec<String>,
    /// Reasons why the model of a study was not fitted again.
    fits: Vec<String>,
    /// Remarks on models that were compared.
    remarks: Vec<String>,
}

/// Compares the claims of `manifest` and all of `reports` with numbers computed from the files in `source`.
pub(crate) fn check(
    source: &Source,
    manifest: &Manifest,
    reports: &[EvaluationReport],
    request: &VerifyRequest,
    progress: &dyn Progress,
) -> Checked {
    let most = request.deepest();
    let is_of_model = most >= Level::Model;
    let settings = RecomputationSettings {
        reads_tables: most >= Level::Predictions,
        are_tables_withheld: manifest.withholds_tables(),
        datasets: is_of_model.then_some(request.datasets.as_slice()),
        fits: most >= Level::Fit,
        has_same_sets: is_of_model
            && form::environment(source).is_ok_and(|own| own.has_same_sets()),
        work: Work {
            jobs: request.jobs,
            progress,
            cache: None,
        },
    };
    let mut checked = Checked {
        claims: Vec::new(),
        others: Vec::new(),
        damage: Vec::new(),
        states: Vec::new(),
        tables: Vec::new(),
        models: Vec::new(),
        fits: Vec::new(),
        remarks: Vec::new(),
    };
    for (study, (report, files)) in reports.iter().zip(&manifest.studies).enumerate() {
        let states = match recomputation::states(source, files) {
            Ok(states) => states,
            Err(damage) => {
                checked.damage.push(damage);
                continue;
            }
        };
        let again = match most < Level::Scores {
            true => Recomputation::none(),
            false => Recomputation::of(source, files, report, &states, settings),
        };
        drop(states);
        let named = |reason: &str| format!("study {study}: {reason}");
        let stop = again.states.as_ref().err();
        checked.states.extend(stop.map(|stop| named(&stop.reason)));
        let stop = again.tables.as_ref().err();
        checked.tables.extend(stop.map(|stop| named(&stop.reason)));
        let stop = again.model.as_ref().err();
        checked.models.extend(stop.map(|stop| named(&stop.reason)));
        let stop = again.fit.as_ref().err();
        checked.fits.extend(stop.map(|stop| named(&stop.reason)));
        checked.remarks.extend(match &again.model {
            Ok(PredictionCheck::Equal { samples }) => Some(format!(
                "Study {study}: the model reproduces the predictions of {} bit for bit.",
                counted(*samples, "sample")
            )),
            Ok(PredictionCheck::Near { share, .. }) => Some(format!(
                "Study {study}: the model reproduces the predictions to within {share:.1e} of the range of the labels on other instruction sets."
            )),
            _ => None,
        });
        let own = StudyCheck {
            study,
            report,
            again,
            most,
            tolerance: request.tolerance,
        };
        let claims = manifest.claims.iter().filter(|claim| claim.study == study);
        let claims: Vec<ClaimCheck> = claims.map(|claim| own.claim(claim)).collect();
        checked.others.extend(own.others(&claims));
        checked.claims.extend(claims);
    }
    checked
}

fn add_levels(found: &mut Verification, checked: &Checked, most: Level) {
    let absent = |claim: &&ClaimCheck| claim.reason.as_deref() == Some(NO_SUCH_NUMBER);
    let lacking = checked.claims.iter().filter(absent).count();
    let reason =
        (lacking > 0).then(|| format!("{} not in results.json", counted(lacking as u64, "claim")));
    found.add_level(Level::Form, reason);
    for (level, stops) in [
        (Level::Scores, &checked.states),
        (Level::Predictions, &checked.tables),
        (Level::Model, &checked.models),
        (Level::Fit, &checked.fits),
    ] {
        if level > most {
            return;
        }
        let below = |claim: &&ClaimCheck| claim.level < level;
        let differs =
            |claim: &&ClaimCheck| claim.level == level && claim.verdict == Verdict::Differs;
        let behind = checked.claims.iter().filter(below).count();
        let other = checked.claims.iter().filter(differs).count();
        let reason = if let Some(stop) = stops.first() {
            Some(stop.clone())
        } else if other > 0 {
            Some(format!(
                "{} with another number",
                counted(other as u64, "claim")
            ))
        } else if behind > 0 {
            Some(format!(
                "{} not computed again",
                counted(behind as u64, "claim")
            ))
        } else {
            None
        };
        found.add_level(level, reason);
    }
}

/// Remarks on texts and digests that nothing in the bundle can check.
fn unchecked(manifest: &Manifest) -> Vec<String> {
    let mut remarks = Vec::new();
    let own = env!("CARGO_PKG_VERSION");
    if manifest.taceva != own {
        remarks.push(format!(
            "The generated files were not compared: the manifest states that TacEva {} wrote them, and this is {own}.",
            manifest.taceva
        ));
    }
    let mut studies = manifest.studies.iter();
    if manifest.withholds_tables() && studies.any(|files| files.sample_table().is_none()) {
        remarks.push(
            "The digest of the samples was not computed again: their tables are withheld."
                .to_owned(),
        );
    }
    remarks
}

/// Damage of the first file behind a study that is too long to read; `None` if there is no such file.
fn too_long(source: &Source, manifest: &Manifest) -> Option<Damage> {
    let names = manifest.studies.iter().flat_map(StudyFiles::names);
    names
        .filter(|name| source.files().contains_key(*name))
        .find_map(|name| source.size(name, MOST_TABLE).err())
}

fn facts(sealed: &SealedManifest) -> BundleFacts {
    let manifest = &sealed.manifest;
    BundleFacts {
        name: manifest.name.clone(),
        created: manifest.created.clone(),
        taceva: manifest.taceva.clone(),
        source: manifest.source.clone(),
        badge: manifest.badge.clone(),
        seal: sealed.digest.clone(),
        samples_digest: manifest.samples_digest.clone(),
        edits: sealed.edits.clone(),
    }
}

/// Facts of the bundle at `path`, and its manifest. The other files are not read.
///
/// # Errors
/// [`BundleError::Damaged`] for a path that is not a bundle of this version; [`BundleError::File`] for an unreadable manifest.
pub(crate) fn open_manifest(path: &Path) -> Result<(BundleFacts, Manifest), BundleError> {
    let source = Source::open(path, MOST_BYTES)?;
    let text = source
        .text(MANIFEST, MOST_MANIFEST)
        .map_err(BundleError::Damaged)?;
    let sealed = Manifest::parse(&text).map_err(BundleError::Damaged)?;
    Ok((facts(&sealed), sealed.manifest))
}
