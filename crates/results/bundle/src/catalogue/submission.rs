//! Submitted bundle, verified as deeply as its files allow, with a row for each number.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_files::seal::digest_of_bytes;
use taceva_report::catalogue::{Measured, Origin};
use taceva_results::{EvaluationReport, Interval};
use toml::value::Datetime;

use super::error::CatalogueFolderError;
use super::request::AddRequest;
use crate::author::Author;
use crate::claim::{Claim, words};
use crate::claim_list;
use crate::error::BundleError;
use crate::form;
use crate::layout::{MANIFEST, MOST_MANIFEST, RESULTS};
use crate::level::Level;
use crate::licence::{expected_licence, is_licence};
use crate::manifest::{Manifest, SealedManifest};
use crate::source::Source;
use crate::verification::{ClaimCheck, Outcome, Verdict, Verification};
use crate::verify::{VerifyRequest, verify};

/// File of a bundle that states the protocol.
const SCENE: &str = "scene.toml";
/// Maximum size of authors and certificates together, bytes.
const MOST_REPEATED: usize = 4096;
/// Sensor name in results that state no sensor.
const UNKNOWN: &str = "unknown";

/// Verified bundle with the rows of its numbers.
pub(super) struct Submission {
    pub(super) manifest: Manifest,
    /// Text of the manifest, byte for byte.
    pub(super) text: String,
    /// Digest of the text of the manifest, as `sha256:` and digits.
    pub(super) digest: String,
    /// Rows by the name of the sensor in the results.
    pub(super) sensors: BTreeMap<String, Vec<Measured>>,
}

impl Submission {
    /// Verifies the bundle of `request` and reads its numbers.
    ///
    /// # Errors
    /// [`CatalogueFolderError::Unverified`] for a bundle with a number that differs from the number computed from its files.
    /// [`CatalogueFolderError::Refused`] for a damaged bundle, a draft, or a bundle without a sensor name.
    pub(super) fn read(request: &AddRequest) -> Result<Submission, CatalogueFolderError> {
        let path = request.bundle.as_path();
        let refused = |problem: String| CatalogueFolderError::refused(path, problem);
        let mut asked = VerifyRequest::new(path);
        asked.most = request.most;
        asked.jobs = request.jobs;
        let found = verify(&asked)?;
        check_outcome(&found, path)?;
        let source = Source::open(path, request.most)?;
        let text = source.text(MANIFEST, MOST_MANIFEST);
        let text = text.map_err(BundleError::Damaged)?;
        let SealedManifest {
            manifest, digest, ..
        } = Manifest::parse(&text).map_err(BundleError::Damaged)?;
        let is_verified = found.bundle.as_ref().is_some_and(|own| own.seal == digest)
            && results_digest(&manifest) == Some(source.digest(RESULTS)?.as_str());
        if !is_verified {
            let problem = "the bundle changed while it was read; run the command again when no program writes to the bundle";
            return Err(refused(problem.to_owned()));
        }
        if let Some(problem) = unfinished(&manifest) {
            return Err(refused(problem));
        }
        let reports = form::results(&source).map_err(BundleError::Damaged)?;
        let mut submission = Submission {
            digest: digest_of_bytes(text.as_bytes()),
            manifest,
            text,
            sensors: BTreeMap::new(),
        };
        submission.add_rows(&found, &reports, request, path)?;
        Ok(submission)
    }

    /// Adds the row of every claim.
    fn add_rows(
        &mut self,
        found: &Verification,
        reports: &[EvaluationReport],
        request: &AddRequest,
        path: &Path,
    ) -> Result<(), CatalogueFolderError> {
        let refused = |problem: String| CatalogueFolderError::refused(path, problem);
        let manifest = &self.manifest;
        let date: Datetime = manifest.created.parse().map_err(|_| {
            refused(format!(
                "`created` is `{}`: expected a day such as 2026-11-28",
                manifest.created
            ))
        })?;
        let protocol = protocol(manifest);
        let by: Vec<String> = manifest.authors.iter().map(Author::to_string).collect();
        let certificates: Vec<Vec<String>> = reports.iter().map(certificates).collect();
        for numbers in &certificates {
            let repeated: usize = by.iter().chain(numbers).map(String::len).sum();
            if repeated > MOST_REPEATED {
                return Err(refused(format!(
                    "names and certificates of {repeated} bytes: expected at most {MOST_REPEATED}, because every row repeats them"
                )));
            }
        }
        let mut levels: BTreeMap<(usize, &str, &str, Option<&str>), Level> = BTreeMap::new();
        for check in &found.claims {
            let (metric, channel) = (check.metric.as_str(), check.channel.as_str());
            let key = (check.study, metric, channel, check.variant.as_deref());
            levels.insert(key, check.level);
        }
        for claim in &manifest.claims {
            let of_study = reports.get(claim.study).zip(certificates.get(claim.study));
            let Some((report, certificates)) = of_study else {
                return Err(refused(format!(
                    "study {} is not in {RESULTS}",
                    claim.study
                )));
            };
            let subject = &report.subject;
            if subject.sensor.trim().is_empty() || subject.sensor == UNKNOWN {
                return Err(refused(format!(
                    "{RESULTS} names no sensor: expected its model, which `--sensor SENSOR.toml` of `taceva score` states as `model`"
                )));
            }
            if Origin::of_source(&subject.source).is_none() {
                return Err(refused(format!(
                    "the samples of study {} have the origin `{}`: expected recorded, simulated, synthetic or unknown; evaluate samples of different \
                     origins separately",
                    claim.study, subject.source
                )));
            }
            let reached = levels.get(&claim_list::key(claim));
            let level = reached.copied().unwrap_or(Level::Form).min(claim.level);
            let interval = interval_of(claim, report);
            let row = Measured {
                study: claim.study,
                metric: claim.metric.clone(),
                channel: claim.channel.clone(),
                variant: claim.variant.clone(),
                value: claim.value,
                ci95: claim.ci95,
                method: interval.and_then(Interval::method).map(str::to_owned),
                unit: claim.unit.symbol().to_owned(),
                n: claim.n,
                clusters: interval
                    .and_then(Interval::clusters)
                    .map(|clusters| clusters as u64),
                definition: claim.definition.clone(),
                protocol: protocol.clone(),
                samples: manifest.samples_digest.clone(),
                bundle: self.digest.clone(),
                url: request.url.clone(),
                verified: level.to_string(),
                source: subject.source.clone(),
                date,
                by: by.clone(),
                licence: manifest.licence.clone(),
                traceability: certificates.clone(),
            };
            let rows = self.sensors.entry(subject.sensor.clone());
            rows.or_default().push(row);
        }
        match self.sensors.is_empty() {
            true => Err(refused(
                "the bundle has no number of a sensor, expected one or more".to_owned(),
            )),
            false => Ok(()),
        }
    }
}

/// Protocol of the presses: the scene that `manifest` lists; `None` without a scene.
pub(super) fn protocol(manifest: &Manifest) -> Option<String> {
    let mut files = manifest.files.iter();
    let scene = files.find(|file| file.path == SCENE)?;
    Some(format!("scene {}", scene.sha256))
}

/// Digest of the results that `manifest` lists; `None` without results.
pub(super) fn results_digest(manifest: &Manifest) -> Option<&str> {
    let mut files = manifest.files.iter();
    let results = files.find(|file| file.path == RESULTS);
    results.map(|file| file.sha256.as_str())
}

/// Reason why a manifest is unfinished: a draft, an invalid author, or an unknown licence; `None` if finished.
pub(super) fn unfinished(manifest: &Manifest) -> Option<String> {
    let licence = manifest.licence.as_deref().unwrap_or_default();
    if manifest.is_unfinished || manifest.authors.is_empty() || licence.is_empty() {
        let problem = "a draft, expected a bundle with author and licence; make the bundle again by `taceva bundle … --author \"NAME <ORCID>\" --licence SPDX`";
        return Some(problem.to_owned());
    }
    if manifest.authors.iter().any(|author| !author.is_right()) {
        let problem = "an author whose name or ORCID is invalid: expected `NAME <ORCID>`, as `taceva bundle --author` takes it";
        return Some(problem.to_owned());
    }
    (!is_licence(licence))
        .then(|| format!("the licence `{licence}`: {}", expected_licence(licence)))
}

/// Rejects a bundle that is damaged or not verified.
pub(super) fn check_outcome(found: &Verification, path: &Path) -> Result<(), CatalogueFolderError> {
    match found.outcome() {
        Outcome::Verified => return Ok(()),
        Outcome::Damaged => {
            let damage = found.damage.first().map(ToString::to_string);
            let problem = format!("damaged: {}", damage.unwrap_or_default());
            return Err(CatalogueFolderError::refused(path, problem));
        }
        Outcome::Unverified => {}
    }
    let is_wrong = |claim: &&ClaimCheck| match claim.verdict {
        Verdict::Differs => true,
        Verdict::NotRecomputable => !claim.is_absent,
        _ => false,
    };
    let claim = found.claims.iter().find(is_wrong).map(|claim| {
        let named = words(&claim.metric, claim.variant.as_deref(), &claim.channel);
        let reason = claim.reason.as_deref().unwrap_or("it differs");
        format!("{named}: {} ({reason})", claim.verdict)
    });
    let mut others = found.others.iter();
    let other = others.find(|other| other.verdict == Verdict::Differs);
    let other = other.map(|other| format!("{}: {}", other.part, other.reason));
    let problem = claim.or(other).unwrap_or_default();
    Err(CatalogueFolderError::Unverified {
        path: path.to_owned(),
        problem: format!("{problem}; `taceva bundle verify` lists every claim"),
    })
}

/// Interval of the number of a claim in the results; `None` without an interval.
fn interval_of<'a>(claim: &Claim, report: &'a EvaluationReport) -> Option<&'a Interval> {
    let score = claim.score_in(&report.scores)?;
    let interval = match claim.variant.as_deref() {
        None => score.interval.as_ref(),
        Some(name) => score.variant(name)?.interval.as_ref(),
    };
    interval.filter(|interval| interval.ends().is_some())
}

/// Numbers of the certificates behind the labels, each once.
fn certificates(report: &EvaluationReport) -> Vec<String> {
    let traced = report.provenance.traceability.iter();
    let certificates = traced.filter_map(|traced| traced.certificate.as_ref());
    let mut numbers: Vec<String> = certificates.map(|own| own.number.clone()).collect();
    numbers.sort();
    numbers.dedup();
    numbers
}
