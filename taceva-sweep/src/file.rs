//! The file of a sweep: what varies, and what stays.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use taceva_dataset::read_toml;
use taceva_models::Suggestion;

use crate::condition::Condition;
use crate::error::SweepError;
use crate::slurm_spec::SlurmSpec;
use crate::written::WrittenSweep;

/// The version of the form that this program reads.
const VERSION: u32 = 1;

/// The file of a sweep, read and checked; nothing of the recordings was looked at.
#[derive(Clone, Debug)]
pub struct SweepFile {
    /// Where it is.
    pub path: PathBuf,
    /// What it is called.
    pub name: String,
    /// Folders of recordings, and patterns of such, relative to the folder of the file.
    pub datasets: Vec<String>,
    /// The models, each with settings of its own.
    pub models: Vec<ModelEntry>,
    /// The seeds.
    pub seeds: Vec<u64>,
    /// The splits; that of each recording where the file names none.
    pub splits: Vec<Option<String>>,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The file that says what is known of the sensor.
    pub sensor: Option<PathBuf>,
    /// The file of limits that each unit is held to.
    pub limits: Option<PathBuf>,
    /// Settings, each with the values that it takes in turn.
    pub vary: BTreeMap<String, Vec<String>>,
    /// Combinations that make no sense.
    pub skip: Vec<Condition>,
    /// How jobs are asked for.
    pub slurm: SlurmSpec,
}

/// A model with settings of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelEntry {
    /// Its name.
    pub name: String,
    /// Its settings.
    pub set: BTreeMap<String, String>,
}

impl SweepFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`SweepError`] with the line and the nearest key where one is unknown, and for what cannot be meant.
    pub fn read(path: &Path) -> Result<SweepFile, SweepError> {
        let written: WrittenSweep = read_toml(path)?;
        let text = fs::read_to_string(path).map_err(SweepError::io("read", path))?;
        let place = FilePlace { path, text: &text };
        if written.sweep_version != VERSION {
            return Err(place.wrong(
                "sweep_version",
                format!(
                    "version {} of the form; this program reads version {VERSION}",
                    written.sweep_version
                ),
            ));
        }
        let models = written.models.iter();
        let models: Vec<ModelEntry> = models
            .map(|value| model(value, place))
            .collect::<Result<_, _>>()?;
        let mut vary = BTreeMap::new();
        for (key, values) in written.vary {
            if let Some(model) = models.iter().find(|model| model.set.contains_key(&key)) {
                return Err(place.wrong(
                    &key,
                    format!(
                        "`{key}` varies and is set by the model {}; keep one of both",
                        model.name
                    ),
                ));
            }
            let texts = values.iter().map(|value| {
                word(value).ok_or_else(|| {
                    place.wrong(
                        &key,
                        format!("`{key}`: expected texts, numbers, true or false"),
                    )
                })
            });
            let texts: Vec<String> = texts.collect::<Result<_, _>>()?;
            place.check_distinct(&key, &texts)?;
            vary.insert(key, texts);
        }
        let seeds = match written.seeds {
            None => vec![0],
            Some(seeds) => seeds
                .list()
                .map_err(|problem| place.wrong("seeds", problem))?,
        };
        place.check_distinct("seeds", &seeds)?;
        place.check_distinct("splits", &written.splits)?;
        let datasets = written.datasets.list();
        place.check_distinct("datasets", &datasets)?;
        let splits = match written.splits.is_empty() {
            true => vec![None],
            false => written.splits.into_iter().map(Some).collect(),
        };
        let metrics = match written.metrics.is_empty() {
            true => vec!["all".to_owned()],
            false => written.metrics,
        };
        let skip = written.skip.r#where.list();
        let skip = skip.iter().map(|text| {
            Condition::parse(text).map_err(|error| place.wrong("where", error.to_string()))
        });
        let beside = |file: PathBuf| folder_of(path).join(file);
        Ok(SweepFile {
            path: path.to_owned(),
            name: written.name,
            datasets,
            models,
            seeds,
            splits,
            metrics,
            sensor: written.sensor.map(beside),
            limits: written.limits.map(beside),
            vary,
            skip: skip.collect::<Result<_, _>>()?,
            slurm: written.slurm.unwrap_or_default(),
        })
    }

    /// The folder that paths of the file are relative to.
    pub fn folder(&self) -> &Path {
        folder_of(&self.path)
    }

    /// What is wrong with what stands below `key`, with its line.
    pub(crate) fn wrong(&self, key: &str, problem: String) -> SweepError {
        let text = fs::read_to_string(&self.path).unwrap_or_default();
        FilePlace {
            path: &self.path,
            text: &text,
        }
        .wrong(key, problem)
    }
}

fn folder_of(path: &Path) -> &Path {
    taceva_durable::parent_of(path)
}

/// The file, where errors are named.
#[derive(Clone, Copy)]
struct FilePlace<'a> {
    path: &'a Path,
    text: &'a str,
}

impl FilePlace<'_> {
    fn wrong(&self, key: &str, problem: String) -> SweepError {
        let line = self.text.lines().position(|line| {
            let code = line.split('#').next().unwrap_or_default();
            code.split(|letter: char| !(letter.is_alphanumeric() || "_-".contains(letter)))
                .any(|word| word == key)
        });
        SweepError::Meaning {
            path: self.path.to_owned(),
            line: line.map(|line| line + 1),
            problem,
        }
    }

    fn check_distinct<T: PartialEq + std::fmt::Display>(
        &self,
        key: &str,
        values: &[T],
    ) -> Result<(), SweepError> {
        for (at, value) in values.iter().enumerate() {
            if values[..at].contains(value) {
                return Err(self.wrong(key, format!("`{key}`: {value} comes twice")));
            }
        }
        Ok(())
    }
}

/// A name, or `{ name = …, set = { … } }`.
fn model(value: &toml::Value, place: FilePlace<'_>) -> Result<ModelEntry, SweepError> {
    const KEYS: [&str; 2] = ["name", "set"];
    let table = match value {
        toml::Value::String(name) => {
            return Ok(ModelEntry {
                name: name.clone(),
                set: BTreeMap::new(),
            });
        }
        toml::Value::Table(table) => table,
        _ => {
            let problem = "`models`: expected names, or { name = \"…\", set = { … } }";
            return Err(place.wrong("models", problem.to_owned()));
        }
    };
    if let Some(key) = table.keys().find(|key| !KEYS.contains(&key.as_str())) {
        let suggestion = Suggestion::of(key, KEYS);
        return Err(place.wrong(
            key,
            format!("`{key}`: unknown key of a model, {suggestion}"),
        ));
    }
    let name = table.get("name").and_then(toml::Value::as_str);
    let name = name.ok_or_else(|| {
        place.wrong(
            "models",
            "`models`: the key `name` of a model is missing".to_owned(),
        )
    })?;
    let own = match table.get("set") {
        None => None,
        Some(toml::Value::Table(own)) => Some(own),
        Some(_) => {
            let problem = format!("`set` of the model {name}: expected {{ KEY = VALUE, … }}");
            return Err(place.wrong("set", problem));
        }
    };
    let mut set = BTreeMap::new();
    for (key, value) in own.into_iter().flatten() {
        let text = word(value).ok_or_else(|| {
            place.wrong(
                key,
                format!("`{key}` of the model {name}: expected a text, a number, true or false"),
            )
        })?;
        set.insert(key.clone(), text);
    }
    Ok(ModelEntry {
        name: name.to_owned(),
        set,
    })
}

/// A setting as people type it.
fn word(value: &toml::Value) -> Option<String> {
    match value {
        toml::Value::String(text) => Some(text.clone()),
        toml::Value::Integer(number) => Some(number.to_string()),
        toml::Value::Float(number) => Some(number.to_string()),
        toml::Value::Boolean(value) => Some(value.to_string()),
        _ => None,
    }
}
