//! Parser of the sweep file, with checks of each key.

use std::fs;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_dataset::{Digest, read_toml};
use taceva_models::{SplitKind, SplitSpec};

use super::place::FilePlace;
use super::vary::vary;
use super::{ALL_METRICS, ModelEntry, SweepFile, folder_of, tables};
use crate::condition::Condition;
use crate::error::SweepError;
use crate::seeds::seeds;
use crate::syntax::WrittenSweep;

/// Version of the format that this program reads.
const VERSION: u32 = 1;

impl SweepFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`SweepError`] for invalid content, with the line, and with the most similar key if a key is unknown.
    pub fn read(path: &Path) -> Result<SweepFile, SweepError> {
        let written: WrittenSweep = read_toml(path)?;
        let text = fs::read_to_string(path).map_err(SweepError::io("read", path))?;
        let place = FilePlace { path, text: &text };
        if written.sweep_version != VERSION {
            return Err(place.wrong(
                "sweep_version",
                format!(
                    "`sweep_version` is {}, expected {VERSION}",
                    written.sweep_version
                ),
            ));
        }
        if written.score.is_some() {
            tables::check_alone(&written, place)?;
        }
        let folder = folder_of(path);
        let tables = written.score.as_ref();
        let tables = tables.map(|score| tables::TablesEntry::of(score, folder, place));
        let models = written.models.iter();
        let models: Vec<ModelEntry> = models
            .map(|value| ModelEntry::of(value, place))
            .collect::<Result<_, _>>()?;
        let vary = vary(written.vary, &models, place)?;
        let seeds = match &written.seeds {
            None => vec![0],
            Some(written) => seeds(written).map_err(|problem| place.wrong("seeds", problem))?,
        };
        place.check_distinct("seeds", &seeds)?;
        place.check_distinct("splits", &written.splits)?;
        for split in &written.splits {
            let known = split.parse::<SplitSpec>();
            let known = known.map_err(|error| place.wrong("splits", error.to_string()))?;
            // A task is predicted by folds of clusters unless the file names another split.
            if written.task.is_empty() && matches!(known.kind, SplitKind::Folds(_)) {
                let problem = format!(
                    "`{}`: a sweep needs one split with validation and test parts, such as by-point or by-block",
                    shown(split)
                );
                return Err(place.wrong("splits", problem));
            }
        }
        if !written.task.is_empty() && written.sensor.is_some() {
            let problem = "`sensor` applies to channels only and cannot be combined with `task`: omit `sensor`";
            return Err(place.wrong("sensor", problem.to_owned()));
        }
        let (datasets, scenes) = (written.datasets.list(), written.scenes.list());
        let labels = written.task.list();
        place.check_distinct("task", &labels)?;
        place.check_distinct("datasets", &datasets)?;
        place.check_distinct("scenes", &scenes)?;
        if tables.is_none() && datasets.is_empty() && scenes.is_empty() {
            return Err(place.wrong(
                if place.line_of("scenes").is_some() { "scenes" } else { "datasets" },
                "an empty grid: neither `datasets` nor `scenes` has an entry; name at least one recording or scene".to_owned(),
            ));
        }
        let splits = match written.splits.is_empty() {
            true => vec![None],
            false => written.splits.into_iter().map(Some).collect(),
        };
        let metrics = match written.metrics.is_empty() {
            true => vec![ALL_METRICS.to_owned()],
            false => written.metrics,
        };
        let skip = written.skip.r#where.list();
        let skip = skip.iter().map(|text| {
            Condition::parse(text).map_err(|error| place.wrong("where", error.to_string()))
        });
        let beside = |file: PathBuf| folder.join(file);
        Ok(SweepFile {
            path: path.to_owned(),
            digest: Digest::of(text.as_bytes()),
            name: written.name,
            datasets,
            view: written.view,
            scenes,
            labels,
            models,
            seeds,
            splits,
            metrics,
            sensor: written.sensor.map(beside),
            limits: written.limits.map(beside),
            vary,
            skip: skip.collect::<Result<_, _>>()?,
            tables: tables.transpose()?,
            slurm: written.slurm.unwrap_or_default(),
        })
    }
}
