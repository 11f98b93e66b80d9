//! Every combination of what varies, as tasks.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::shown;
use taceva_dataset::{Digest, SensorFile};
use taceva_metrics::catalogue;
use taceva_models::Models;
use taceva_study::StudyError;

use crate::error::SweepError;
use crate::file::{ModelEntry, SweepFile};
use crate::glob;
use crate::key::{KeyParts, TaskKey};
use crate::limits::MOST_TASKS;
use crate::recording::opened;
use crate::task::Task;

/// The tasks of a sweep, in the order of its file: recordings, splits, seeds, settings, models.
#[derive(Clone, Debug)]
pub struct Grid {
    /// The tasks.
    pub tasks: Vec<Task>,
    /// Combinations that `[skip]` leaves out.
    pub skipped: usize,
}

/// A recording that tasks are of.
struct Recording {
    name: String,
    path: std::path::PathBuf,
    digest: Digest,
}

impl Grid {
    /// The tasks that `file` asks for. Opens each recording once, for its digest; reads no frame.
    ///
    /// # Errors
    /// [`SweepError`] for a grid that is empty or larger than [`MOST_TASKS`], a model, a setting or a metric that does not exist, and a
    /// recording that cannot be opened.
    pub fn of(file: &SweepFile, models: &Models) -> Result<Grid, SweepError> {
        let named = named(file)?;
        check_size(file, named.len())?;
        let metrics = file.metrics.iter().map(String::as_str);
        catalogue::select(metrics).map_err(StudyError::from)?;
        if file.vary.contains_key("seed") {
            let problem =
                "`seed` varies by `seeds`, which divide the samples and are what models draw by";
            return Err(file.wrong("seed", problem.to_owned()));
        }
        let sensor = sensor_digest(file)?;
        let settings: BTreeSet<String> = setting_names(file);
        for condition in &file.skip {
            let known = condition.check_names(&settings);
            known.map_err(|error| file.wrong("where", error.to_string()))?;
        }
        let mut recordings = Vec::with_capacity(named.len());
        for name in named {
            let path = file.folder().join(&name);
            // Absolute, since a job of a scheduler begins elsewhere.
            let path = std::path::absolute(&path).map_err(SweepError::io("find", &path))?;
            let (_, digest) = opened(&path)?;
            recordings.push(Recording { name, path, digest });
        }
        refuse_twice(file, &recordings)?;
        let grid = combined(file, &recordings, sensor);
        if grid.tasks.is_empty() {
            return Err(file.wrong(
                "where",
                format!(
                    "an empty grid: `[skip]` leaves out all {} combinations",
                    grid.skipped
                ),
            ));
        }
        check_settings(file, &grid, models)?;
        Ok(grid)
    }
}

/// The recordings that the file names, patterns resolved.
fn named(file: &SweepFile) -> Result<Vec<String>, SweepError> {
    let mut names: Vec<String> = Vec::new();
    for text in &file.datasets {
        if !glob::is_pattern(text) {
            names.push(text.clone());
            continue;
        }
        let found = glob::folders(file.folder(), text);
        let found = found.map_err(SweepError::io("list", file.folder()))?;
        if found.is_empty() {
            return Err(file.wrong(
                "datasets",
                format!(
                    "`{}`: no folder matches in {}",
                    shown(text),
                    shown(file.folder())
                ),
            ));
        }
        names.extend(found);
    }
    let mut known = BTreeSet::new();
    names.retain(|name| known.insert(name.clone()));
    Ok(names)
}

/// Refuses two names of one recording, and a model that is named twice with the same settings: of both there would be one result.
fn refuse_twice(file: &SweepFile, recordings: &[Recording]) -> Result<(), SweepError> {
    for (at, one) in recordings.iter().enumerate() {
        let alike = recordings[..at]
            .iter()
            .find(|other| other.digest == one.digest);
        if let Some(other) = alike {
            let problem = format!(
                "`{}` and `{}` are one recording, the same to the last byte of its header; name it once, or give the copy of another unit its serial number",
                shown(&other.name),
                shown(&one.name)
            );
            return Err(file.wrong("datasets", problem));
        }
    }
    for (at, one) in file.models.iter().enumerate() {
        let is_alike = |other: &ModelEntry| other.name == one.name && other.set == one.set;
        if file.models[..at].iter().any(is_alike) {
            let problem = format!(
                "the model {} is named twice with the same settings",
                one.name
            );
            return Err(file.wrong("models", problem));
        }
    }
    Ok(())
}

/// Refuses a grid without a task, or with too many.
fn check_size(file: &SweepFile, recordings: usize) -> Result<(), SweepError> {
    let counts = [
        ("datasets", recordings),
        ("models", file.models.len()),
        ("seeds", file.seeds.len()),
        ("splits", file.splits.len()),
    ];
    let vary = file
        .vary
        .iter()
        .map(|(key, values)| (key.as_str(), values.len()));
    let counts: Vec<(&str, usize)> = counts.into_iter().chain(vary).collect();
    if let Some((key, _)) = counts.iter().find(|(_, count)| *count == 0) {
        return Err(file.wrong(
            key,
            format!("an empty grid: `{key}` has no entry; name at least one"),
        ));
    }
    let count = counts.iter().fold(1_u128, |product, (_, count)| {
        product.saturating_mul(*count as u128)
    });
    if count > u128::from(MOST_TASKS) {
        let parts: Vec<String> = counts
            .iter()
            .map(|(key, count)| format!("{count} {key}"))
            .collect();
        return Err(SweepError::Meaning {
            path: file.path.clone(),
            line: None,
            problem: format!(
                "a grid of {count} tasks ({}), {MOST_TASKS} are the most: vary less, or make several sweeps",
                parts.join(" × ")
            ),
        });
    }
    Ok(())
}

/// Every setting that some task has.
fn setting_names(file: &SweepFile) -> BTreeSet<String> {
    let own = file.models.iter().flat_map(|model| model.set.keys());
    file.vary.keys().chain(own).cloned().collect()
}

/// The digest of the file that says what is known of the sensor, if there is one.
pub(crate) fn sensor_digest(file: &SweepFile) -> Result<Option<Digest>, SweepError> {
    let Some(path) = &file.sensor else {
        return Ok(None);
    };
    SensorFile::read(path)?;
    let bytes = std::fs::read(path).map_err(SweepError::io("read", path))?;
    Ok(Some(Digest::of(&bytes)))
}

fn combined(file: &SweepFile, recordings: &[Recording], sensor: Option<Digest>) -> Grid {
    let varied = varied(file);
    let mut grid = Grid {
        tasks: Vec::new(),
        skipped: 0,
    };
    for recording in recordings {
        for split in &file.splits {
            for &seed in &file.seeds {
                for settings in &varied {
                    for model in &file.models {
                        let task = task(
                            file,
                            (recording, sensor),
                            (model, settings),
                            (split.as_deref(), seed),
                        );
                        match file.skip.iter().any(|condition| condition.holds(&task)) {
                            true => grid.skipped += 1,
                            false => grid.tasks.push(task),
                        }
                    }
                }
            }
        }
    }
    // A model whose own setting stands in the place of one that varies comes once for each value; a result is made once.
    let mut known = BTreeSet::new();
    grid.tasks.retain(|task| known.insert(task.key.clone()));
    grid
}

/// Every combination of the settings that vary.
fn varied(file: &SweepFile) -> Vec<BTreeMap<String, String>> {
    let mut all = vec![BTreeMap::new()];
    for (key, values) in &file.vary {
        let with = |settings: &BTreeMap<String, String>| {
            let settings = settings.clone();
            values.iter().map(move |value| {
                let mut settings = settings.clone();
                settings.insert(key.clone(), value.clone());
                settings
            })
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

fn task(
    file: &SweepFile,
    (recording, sensor): (&Recording, Option<Digest>),
    (model, varied): (&ModelEntry, &BTreeMap<String, String>),
    (split, seed): (Option<&str>, u64),
) -> Task {
    let mut settings = varied.clone();
    settings.extend(model.set.clone());
    let key = TaskKey::of(KeyParts {
        dataset: recording.digest,
        model: &model.name,
        settings: &settings,
        split,
        seed,
        metrics: &file.metrics,
        sensor,
    });
    Task {
        key,
        dataset: recording.name.clone(),
        path: recording.path.clone(),
        digest: recording.digest.to_string(),
        model: model.name.clone(),
        settings,
        split: split.map(str::to_owned),
        seed,
    }
}

/// Refuses a model or a setting that does not exist, before any work: each configuration once.
fn check_settings(file: &SweepFile, grid: &Grid, models: &Models) -> Result<(), SweepError> {
    let mut checked = BTreeSet::new();
    for task in &grid.tasks {
        if !checked.insert(task.configuration()) {
            continue;
        }
        let valid = task.request(models).and_then(|request| request.check());
        valid.map_err(|error| {
            let named = task.settings.keys();
            let named = named.filter(|key| error.to_string().contains(key.as_str()));
            let key = named.max_by_key(|key| key.len()).unwrap_or(&task.model);
            file.wrong(
                key,
                format!(
                    "the model {} with {}: {error}; `[skip] where = [\"model = {}\"]` leaves combinations out",
                    task.model,
                    task.configuration(),
                    task.model
                ),
            )
        })?;
    }
    Ok(())
}
