//! Files behind results, as `run`, `evaluate` or `score` wrote them.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use taceva_core::counted;
use taceva_evaluate::{MODELS, PredictionFiles, RECORDINGS, STATES, prediction_files};
use taceva_files::parent_of;
use taceva_results::{EvaluationReport, Samples};

use crate::error::BundleError;
use crate::header;
use crate::layout::{
    FRAMES_ROLE, HEADER, MODEL_ROLE, MOST_BYTES, MOST_FRAMES, MOST_TABLE, MOST_TEXT, RESULTS, TEXTS,
};
use crate::manifest::{Withheld, model_digest};
use crate::request::{BundleRequest, ScoredTables};
use crate::source::digest_of;

/// Folder of the reports of a run, with the tables of samples.
const REPORTS: &str = "reports";

/// Results with the files behind them.
pub(crate) struct Inputs {
    /// Path of the results.
    pub(crate) path: PathBuf,
    /// Text of the results.
    pub(crate) text: String,
    pub(crate) reports: Vec<EvaluationReport>,
    /// Files of each study.
    pub(crate) studies: Vec<StudyInputs>,
    /// Text files, by their names in the bundle.
    pub(crate) texts: BTreeMap<String, String>,
    /// Headers of datasets.
    pub(crate) headers: Vec<String>,
}

/// Files of one study.
#[derive(Default)]
pub(crate) struct StudyInputs {
    pub(crate) states: Vec<PathBuf>,
    pub(crate) tables: Option<ScoredTables>,
    pub(crate) samples: Option<PathBuf>,
    /// Digest of the model file, if the results name a model file.
    pub(crate) model_digest: Option<String>,
    pub(crate) model: Option<PathBuf>,
    /// Digest of the recording behind predictions, if the results name a recording.
    pub(crate) dataset_digest: Option<String>,
    /// Recordings with the pictures behind the predictions, if they are added.
    pub(crate) frames: Vec<PredictionFiles>,
}

impl StudyInputs {
    /// The recording that the results name, if its pictures are not added.
    pub(crate) fn withheld_frames(&self) -> Option<Withheld> {
        let digest = self.dataset_digest.as_ref();
        let digest = digest.filter(|_| self.frames.is_empty());
        digest.map(|digest| withheld(FRAMES_ROLE, "added only by --with frames", digest))
    }

    /// The model file that the results name, if it is not added.
    pub(crate) fn withheld_model(&self) -> Option<Withheld> {
        let digest = self.model_digest.as_ref();
        let digest = digest.filter(|_| self.model.is_none());
        digest.map(|digest| withheld(MODEL_ROLE, "added only by --with model", digest))
    }
}

fn withheld(role: &str, reason: &str, digest: &str) -> Withheld {
    Withheld {
        role: role.to_owned(),
        reason: reason.to_owned(),
        digest: digest.to_owned(),
    }
}

impl Inputs {
    /// Files behind the results of `request`.
    ///
    /// # Errors
    /// [`BundleError`] if a file cannot be read, or does not belong to the results.
    pub(crate) fn find(request: &BundleRequest) -> Result<Inputs, BundleError> {
        let run = request.result.is_dir().then_some(request.result.as_path());
        let path = run.map_or_else(|| request.result.clone(), |run| run.join(RESULTS));
        let text = text(&path)?;
        let reports = taceva_results::read(&text).map_err(|source| BundleError::Results {
            path: path.clone(),
            source,
        })?;
        let studies = studies(request, run, &path, &reports)?;
        check_frames(&path, &studies)?;
        let mut texts = BTreeMap::new();
        let of_run = run
            .map(|run| run.join(TEXTS[0]))
            .filter(|scene| scene.is_file());
        for from in of_run.iter().chain(&request.texts) {
            let name = from
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if !TEXTS.contains(&name.as_str()) {
                let problem = format!("expected a file with one of the names {}", TEXTS.join(", "));
                return Err(BundleError::input(from, problem));
            }
            texts.insert(name, self::text(from)?);
        }
        Ok(Inputs {
            headers: headers(request, run, &reports)?,
            path,
            text,
            reports,
            studies,
            texts,
        })
    }
}

/// Files of each study.
fn studies(
    request: &BundleRequest,
    run: Option<&Path>,
    path: &Path,
    reports: &[EvaluationReport],
) -> Result<Vec<StudyInputs>, BundleError> {
    if request.adds_frames && request.withholds_predictions {
        let problem = "--with frames adds the labels of the recording, but --without predictions leaves labels out; give only one of the two options";
        return Err(BundleError::input(path, problem));
    }
    let are_given = !request.states.is_empty() || request.tables.is_some();
    if are_given && reports.len() != 1 {
        let problem = format!(
            "the results have {} studies, but states and tables belong to one study: name the result of one study",
            reports.len()
        );
        return Err(BundleError::input(path, problem));
    }
    if let (Some(tables), [report]) = (&request.tables, reports) {
        check_not_swapped(tables, report)?;
    }
    let folder = run.map_or_else(|| parent_of(path).to_owned(), |run| run.join(REPORTS));
    let wanted = reports
        .iter()
        .filter_map(|report| report.provenance.samples_table.as_ref());
    let wanted: Vec<&String> = wanted.collect();
    let known = match wanted.is_empty() {
        true => BTreeMap::new(),
        false => tables_in(&folder, &wanted)?,
    };
    let of_run = entries_of_run(run, STATES)?;
    let models = models(request, run, path, reports)?;
    let recordings = entries_of_run(run, RECORDINGS)?;
    let recordings = recordings
        .into_iter()
        .filter(|path| path.join(HEADER).is_file());
    let recordings: Vec<PathBuf> = request.datasets.iter().cloned().chain(recordings).collect();
    let mut studies = Vec::new();
    for (report, number) in reports.iter().zip(1_usize..) {
        let is_own = |path: &&PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with(&format!("{number}-")) && name.ends_with(".json")
        };
        let states = request.states.iter();
        let states = states.chain(of_run.iter().filter(is_own)).cloned();
        let digest = report.provenance.samples_table.as_ref();
        let samples = digest.and_then(|digest| known.get(digest).cloned());
        let frames = match request.adds_frames {
            true => frames(&recordings, path, report, samples.as_deref())?,
            false => Vec::new(),
        };
        studies.push(StudyInputs {
            states: states.collect(),
            tables: request.tables.clone(),
            samples,
            dataset_digest: report.provenance.dataset.clone(),
            frames,
            model_digest: model_digest(report).map(str::to_owned),
            model: model_digest(report).and_then(|digest| models.get(digest).cloned()),
        });
    }
    let is_bare = |study: &StudyInputs| {
        let has_tables = study.tables.is_some() || study.samples.is_some();
        study.states.is_empty() && (request.withholds_predictions || !has_tables)
    };
    if studies.iter().all(is_bare) {
        let problem = "no state and no table to compute the numbers again: write a state by --state-out or samples by --samples-out, and name the state by --state";
        return Err(BundleError::input(path, problem));
    }
    Ok(studies)
}

/// Files of the `recordings` whose pictures were predicted in `table`, the table of samples of `report`.
fn frames(
    recordings: &[PathBuf],
    path: &Path,
    report: &EvaluationReport,
    table: Option<&Path>,
) -> Result<Vec<PredictionFiles>, BundleError> {
    let refused = |problem: &str| Err(BundleError::input(path, problem));
    let Some(table) = table else {
        return refused(
            "no table of samples, which names the predicted pictures: write it with --samples-out, or leave --with frames out",
        );
    };
    if recordings.is_empty() {
        return refused("no recording with pictures: name it by --dataset");
    }
    let text = fs::read_to_string(table).map_err(BundleError::file(table))?;
    let samples =
        Samples::read(&text).map_err(|error| BundleError::input(table, error.to_string()))?;
    Ok(prediction_files(recordings, &report.provenance, &samples)?)
}

/// Rejects recordings with more files or bytes than a bundle may contain.
fn check_frames(path: &Path, studies: &[StudyInputs]) -> Result<(), BundleError> {
    let (mut count, mut bytes) = (0_usize, 0_u64);
    for recording in studies.iter().flat_map(|study| &study.frames) {
        for file in &recording.files {
            let file = recording.folder.join(file);
            let about = fs::metadata(&file).map_err(BundleError::file(&file))?;
            // Opening a pipe would block until it has a writer.
            if !about.is_file() {
                return Err(BundleError::input(&file, "expected a regular file"));
            }
            count += 1;
            bytes = bytes.saturating_add(about.len());
        }
    }
    if count <= MOST_FRAMES && bytes <= MOST_BYTES {
        return Ok(());
    }
    let problem = format!(
        "{} of {bytes} bytes, expected at most {MOST_FRAMES} pictures of {MOST_BYTES} bytes; leave --with frames out, and verify with --dataset",
        counted(count as u64, "file")
    );
    Err(BundleError::input(path, problem))
}

/// Rejects swapped tables of truth and prediction.
fn check_not_swapped(tables: &ScoredTables, report: &EvaluationReport) -> Result<(), BundleError> {
    let paths = [&tables.truth, &tables.prediction];
    // Opening a pipe would block until it has a writer.
    if !paths.iter().all(|path| path.is_file()) {
        return Ok(());
    }
    let [truth, prediction] = [digest_of(&tables.truth)?, digest_of(&tables.prediction)?];
    let stated = |role: &str| report.provenance.tables.get(role);
    let is_swapped = stated("truth") == Some(&prediction) && stated("prediction") == Some(&truth);
    match is_swapped && truth != prediction {
        true => {
            let problem = "this table holds the predictions of the results, so --truth and --pred are swapped; name the other table by --truth";
            Err(BundleError::input(&tables.truth, problem))
        }
        false => Ok(()),
    }
}

/// Model files of `reports`, by digest: the given files and the files of a run.
fn models(
    request: &BundleRequest,
    run: Option<&Path>,
    path: &Path,
    reports: &[EvaluationReport],
) -> Result<BTreeMap<String, PathBuf>, BundleError> {
    let mut models = BTreeMap::new();
    if !request.adds_models && request.models.is_empty() {
        return Ok(models);
    }
    let wanted: Vec<&str> = reports.iter().filter_map(model_digest).collect();
    let of_run = entries_of_run(run, MODELS)?;
    let of_run = of_run.iter().map(|model| (model, false));
    for (model, is_given) in request
        .models
        .iter()
        .map(|model| (model, true))
        .chain(of_run)
    {
        match (model.is_file(), is_given) {
            (true, _) => {}
            (false, false) => continue,
            (false, true) => return Err(BundleError::input(model, "expected a model file")),
        }
        let digest = digest_of(model)?;
        if wanted.contains(&digest.as_str()) {
            models.entry(digest).or_insert_with(|| model.clone());
        } else if is_given {
            let problem = format!(
                "the digest of this model is {digest}, but the results name {}; give the file that `taceva evaluate --with` read, or evaluate with this file",
                match wanted.is_empty() {
                    true => "no model file".to_owned(),
                    false => wanted.join(", "),
                }
            );
            return Err(BundleError::input(model, problem));
        }
    }
    if models.is_empty() {
        let problem = "no model file of these results is given: give it by --model FILE; `taceva fit` writes one, and `run` keeps its own if the \
                       scene has `keep = [\"models\"]` under [report]";
        return Err(BundleError::input(path, problem));
    }
    Ok(models)
}

/// Tables in `folder` with the digests `wanted`, by digest.
fn tables_in(folder: &Path, wanted: &[&String]) -> Result<BTreeMap<String, PathBuf>, BundleError> {
    let mut known = BTreeMap::new();
    for path in entries(folder)? {
        let is_table = path.extension().is_some_and(|extension| extension == "csv");
        let length = fs::metadata(&path).map_or(u64::MAX, |about| about.len());
        if !is_table || !path.is_file() || length > MOST_TABLE {
            continue;
        }
        let digest = digest_of(&path)?;
        if wanted.contains(&&digest) {
            known.entry(digest).or_insert(path);
        }
    }
    Ok(known)
}

/// Headers of the datasets of `request` and of the recordings of a run. Rejects a dataset that the results do not name, and skips such a recording.
fn headers(
    request: &BundleRequest,
    run: Option<&Path>,
    reports: &[EvaluationReport],
) -> Result<Vec<String>, BundleError> {
    let known = header::known(reports);
    let of_run = entries_of_run(run, RECORDINGS)?;
    let mut headers = Vec::new();
    for (path, is_given) in request
        .datasets
        .iter()
        .map(|path| (path, true))
        .chain(of_run.iter().map(|path| (path, false)))
    {
        let path = path.join(HEADER);
        if !is_given && !path.is_file() {
            continue;
        }
        let text = text(&path)?;
        let digest = header::digest(&text).map_err(|problem| BundleError::input(&path, problem))?;
        match header::fault(&digest, &known) {
            None => headers.push(text),
            Some(problem) if is_given => return Err(BundleError::input(&path, problem)),
            Some(_) => {}
        }
    }
    Ok(headers)
}

/// Paths in the folder `name` of a run, in order; none without a run or without this folder.
fn entries_of_run(run: Option<&Path>, name: &str) -> Result<Vec<PathBuf>, BundleError> {
    let folder = run.map(|run| run.join(name));
    match folder.filter(|folder| folder.is_dir()) {
        Some(folder) => entries(&folder),
        None => Ok(Vec::new()),
    }
}

/// Paths in `folder`, in order.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, BundleError> {
    let read = || -> io::Result<Vec<PathBuf>> {
        let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
        entries.collect()
    };
    let mut paths = read().map_err(BundleError::file(folder))?;
    paths.sort_unstable();
    Ok(paths)
}

/// Text of the file at `path`.
fn text(path: &Path) -> Result<String, BundleError> {
    let about = fs::metadata(path).map_err(BundleError::file(path))?;
    if !about.is_file() || about.len() > MOST_TEXT {
        let problem = format!("expected a file of at most {MOST_TEXT} bytes");
        return Err(BundleError::input(path, problem));
    }
    fs::read_to_string(path).map_err(BundleError::file(path))
}

#[cfg(test)]
mod tests;
