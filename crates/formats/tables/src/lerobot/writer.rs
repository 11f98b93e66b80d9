//! Writer of LeRobot folders, version 3.0, episode by episode. Pictures are stored in the tables, so no video encoder is needed.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use super::feature::WrittenFeature;
use super::metadata::{describe_episodes, describe_tasks};
use super::stats::FeatureStats;
use crate::cell::Cell;
use crate::error::TableError;
use crate::parquet::{ParquetWriter, WrittenColumn, WrittenKind, huggingface_features};

/// Size of a data file at which the next episode begins a new file, MiB.
const FILE_MB: u64 = 100;
/// Maximum number of data files in one folder.
pub(super) const FILES_A_CHUNK: u64 = 1000;
/// Columns that LeRobot defines, written after the features.
const OWN: [(&str, WrittenKind, &str); 5] = [
    ("timestamp", WrittenKind::Single, "float32"),
    ("frame_index", WrittenKind::Integer, "int64"),
    ("episode_index", WrittenKind::Integer, "int64"),
    ("index", WrittenKind::Integer, "int64"),
    ("task_index", WrittenKind::Integer, "int64"),
];

/// Position of a written episode in the dataset.
#[derive(Clone, Copy, Debug)]
pub(super) struct Episode {
    pub(super) task: usize,
    pub(super) first: u64,
    pub(super) end: u64,
    /// Index of the data file of the episode, counted over all chunks (folders).
    pub(super) file: u64,
}

/// Data file that is being written.
#[derive(Debug)]
struct DataFile {
    writer: ParquetWriter,
    /// Index of the file, counted over all chunks (folders).
    number: u64,
}

/// LeRobot folder that is being written: `data`, then `meta`.
///
/// ```
/// use taceva_tables::{Cell, LeRobot, LeRobotWriter, WrittenColumn, WrittenFeature, WrittenKind};
///
/// # let folder = std::env::temp_dir().join(format!("taceva-lerobot-{}", std::process::id()));
/// # std::fs::create_dir(&folder).ok();
/// let force = WrittenColumn::new("observation.state", WrittenKind::Numbers(Some(2)));
/// let features = vec![WrittenFeature::new(force, [2]).with_names(["Fx", "Fz"]).with_unit("N N")];
/// let mut writer = LeRobotWriter::create(&folder, "bench", 30.0, features)?;
/// writer.begin_episode("press the ball")?;
/// for (shear, force) in [(0.0, 0.5), (0.1, 1.0)] {
///     writer.push(vec![Cell::List(vec![Cell::Number(shear), Cell::Number(force)])])?;
/// }
/// writer.finish(&Default::default())?;
///
/// let dataset = LeRobot::open(&folder)?;
/// assert_eq!(dataset.column("observation.state[1]")?, [Cell::Number(0.5), Cell::Number(1.0)]);
/// assert_eq!(dataset.column("task")?[1], Cell::Text("press the ball".into()));
/// # std::fs::remove_dir_all(&folder).ok();
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Debug)]
pub struct LeRobotWriter {
    folder: PathBuf,
    robot: String,
    rate_hz: f64,
    features: Vec<WrittenFeature>,
    stats: BTreeMap<String, FeatureStats>,
    tasks: Vec<String>,
    episodes: Vec<Episode>,
    rows: u64,
    data: Option<DataFile>,
    /// Folders that the writer created.
    folders: Vec<String>,
}

impl LeRobotWriter {
    /// Creates a dataset in the empty folder `folder`, for the robot `robot`, with `rate_hz` frames per second.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] if a feature has a name that LeRobot defines or that contains `/`, or if the rate is not above 0. [`TableError::Write`] if a
    /// file cannot be written.
    pub fn create(
        folder: &Path,
        robot: &str,
        rate_hz: f64,
        mut features: Vec<WrittenFeature>,
    ) -> Result<LeRobotWriter, TableError> {
        for feature in &mut features {
            let kind = &mut feature.column.kind;
            match kind {
                WrittenKind::Numbers(Some(1)) => *kind = WrittenKind::Number,
                WrittenKind::Singles(Some(1)) => *kind = WrittenKind::Single,
                _ => {}
            }
        }
        let refused = |name: &str, problem: &str| TableError::Mismatch {
            path: folder.to_owned(),
            name: name.to_owned(),
            problem: problem.to_owned(),
        };
        if !(rate_hz > 0.0 && rate_hz.is_finite()) {
            return Err(refused(
                "fps",
                &format!("{rate_hz}, expected a finite number above 0"),
            ));
        }
        let names = features.iter().map(|feature| feature.column.name.as_str());
        for name in names {
            if name == "task" || OWN.iter().any(|(own, ..)| *own == name) {
                return Err(refused(
                    name,
                    "a reserved column of LeRobot; use another name",
                ));
            }
            if name.contains('/') {
                return Err(refused(
                    name,
                    "a feature name contains `/`, which LeRobot reads as a level; use `.`",
                ));
            }
        }
        let length = |kind: &WrittenKind| match kind {
            WrittenKind::Integer | WrittenKind::Number | WrittenKind::Single => Some(1),
            WrittenKind::Numbers(length) | WrittenKind::Singles(length) => *length,
            _ => None,
        };
        let numbers = features
            .iter()
            .map(|feature| (feature.column.name.as_str(), &feature.column.kind));
        let numbers = numbers.chain(OWN.iter().map(|(name, kind, _)| (*name, kind)));
        let stats = numbers
            .filter_map(|(name, kind)| Some((name.to_owned(), FeatureStats::new(length(kind)?))));
        let stats = stats.collect();
        Ok(LeRobotWriter {
            folder: folder.to_owned(),
            robot: robot.to_owned(),
            rate_hz,
            features,
            stats,
            tasks: Vec::new(),
            episodes: Vec::new(),
            rows: 0,
            data: None,
            folders: Vec::new(),
        })
    }

    /// Begins an episode with the task `task`, after ending the previous episode.
    ///
    /// # Errors
    /// Errors of [`ParquetWriter::create`], and of [`ParquetWriter::finish`] if a data file is full. [`TableError::Write`] if a folder cannot be created.
    pub fn begin_episode(&mut self, task: &str) -> Result<(), TableError> {
        let task = match self.tasks.iter().position(|known| known == task) {
            Some(known) => known,
            None => {
                self.tasks.push(task.to_owned());
                self.tasks.len() - 1
            }
        };
        let is_full = |data: &DataFile| data.writer.size_bytes() >= FILE_MB << 20;
        if let Some(full) = self.data.take_if(|data| is_full(data)) {
            full.writer.finish()?;
            self.begin_file(full.number + 1)?;
        } else if self.data.is_none() {
            self.begin_file(0)?;
        }
        self.episodes.push(Episode {
            task,
            first: self.rows,
            end: self.rows,
            file: self.data.as_ref().map_or(0, |data| data.number),
        });
        Ok(())
    }

    /// Adds a row to the episode: one cell per feature, without the columns that LeRobot defines.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] if no episode was begun. Otherwise errors of [`ParquetWriter::push`].
    pub fn push(&mut self, mut row: Vec<Cell>) -> Result<(), TableError> {
        let number = self.episodes.len();
        let (Some(data), Some(episode)) = (&mut self.data, self.episodes.last_mut()) else {
            return Err(TableError::Mismatch {
                path: self.folder.clone(),
                name: "episode_index".to_owned(),
                problem: "a row was added before the first episode".to_owned(),
            });
        };
        for (feature, cell) in self.features.iter().zip(&mut row) {
            let is_one = matches!(
                feature.column.kind,
                WrittenKind::Number | WrittenKind::Single
            );
            if let (true, Cell::List(cells)) = (is_one, &mut *cell)
                && cells.len() == 1
            {
                *cell = cells.remove(0);
            }
        }
        if row.len() == self.features.len() {
            let frame = self.rows - episode.first;
            let own = [frame, number as u64 - 1, self.rows, episode.task as u64];
            row.push(Cell::Number(seconds(frame, self.rate_hz)));
            row.extend(own.map(|number| Cell::Integer(number.into())));
        }
        let names = self
            .features
            .iter()
            .map(|feature| feature.column.name.as_str());
        let names = names.chain(OWN.iter().map(|(name, ..)| *name));
        for (name, cell) in names.zip(&row) {
            match (self.stats.get_mut(name), cell) {
                (Some(stats), Cell::List(cells)) => stats.add(cells.iter().map(self::number)),
                (Some(stats), cell) => stats.add([self::number(cell)]),
                (None, _) => {}
            }
        }
        data.writer.push(row)?;
        self.rows += 1;
        episode.end = self.rows;
        Ok(())
    }

    /// Ends the dataset and writes its metadata. `pictures` contains the statistics of pictures by feature, for values from 0 to 1. Returns the subfolders with
    /// files, so that the caller can sync them.
    ///
    /// # Errors
    /// [`TableError::Write`] if a file cannot be written.
    pub fn finish(
        mut self,
        pictures: &BTreeMap<String, FeatureStats>,
    ) -> Result<Vec<String>, TableError> {
        if let Some(data) = self.data.take() {
            data.writer.finish()?;
        }
        self.make_folder("meta")?;
        self.make_folder("meta/episodes")?;
        self.make_folder("meta/episodes/chunk-000")?;
        describe_tasks(&self.folder.join("meta/tasks.parquet"), &self.tasks)?;
        let episodes = self.folder.join("meta/episodes/chunk-000/file-000.parquet");
        describe_episodes(&episodes, &self.episodes, &self.tasks)?;
        let mut stats = Map::new();
        let numbers = self.stats.iter().map(|(name, of)| (name, of.json(false)));
        let pictures = pictures.iter().map(|(name, of)| (name, of.json(true)));
        for (name, of) in numbers.chain(pictures) {
            stats.extend(of.map(|of| (name.clone(), of)));
        }
        self.write_json("meta/stats.json", &Value::Object(stats))?;
        self.write_json("meta/info.json", &self.info())?;
        Ok(self.folders)
    }

    /// Begins a data file.
    fn begin_file(&mut self, number: u64) -> Result<(), TableError> {
        let (chunk, file) = (number / FILES_A_CHUNK, number % FILES_A_CHUNK);
        if number == 0 {
            self.make_folder("data")?;
        }
        if file == 0 {
            self.make_folder(&format!("data/chunk-{chunk:03}"))?;
        }
        let mut columns: Vec<WrittenColumn> = self
            .features
            .iter()
            .map(|feature| feature.column.clone())
            .collect();
        columns.extend(
            OWN.iter()
                .map(|(name, kind, _)| WrittenColumn::new(*name, kind.clone())),
        );
        let path = format!("data/chunk-{chunk:03}/file-{file:03}.parquet");
        let features = huggingface_features(&columns);
        let metadata = [("huggingface", features.as_str())];
        let writer = ParquetWriter::create(&self.folder.join(path), &columns, &metadata)?;
        self.data = Some(DataFile { writer, number });
        Ok(())
    }

    /// Content of `meta/info.json`.
    fn info(&self) -> Value {
        let mut features: Map<String, Value> = self
            .features
            .iter()
            .map(|feature| (feature.column.name.clone(), feature.json()))
            .collect();
        for (name, _, dtype) in OWN {
            let own = json!({ "dtype": dtype, "shape": [1], "names": null });
            features.insert(name.to_owned(), own);
        }
        json!({
            "codebase_version": "v3.0",
            "robot_type": self.robot,
            "total_episodes": self.episodes.len(),
            "total_frames": self.rows,
            "total_tasks": self.tasks.len(),
            "chunks_size": FILES_A_CHUNK,
            "data_files_size_in_mb": FILE_MB,
            "video_files_size_in_mb": 200,
            "fps": rate(self.rate_hz),
            "splits": { "train": format!("0:{}", self.episodes.len()) },
            "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
            "video_path": null,
            "features": features,
        })
    }

    fn make_folder(&mut self, name: &str) -> Result<(), TableError> {
        let path = self.folder.join(name);
        fs::create_dir(&path).map_err(|source| TableError::Write { path, source })?;
        self.folders.push(name.to_owned());
        Ok(())
    }

    fn write_json(&self, name: &str, value: &Value) -> Result<(), TableError> {
        let path = self.folder.join(name);
        let text = format!("{value:#}\n");
        let written = File::create_new(&path).and_then(|mut file| {
            file.write_all(text.as_bytes())?;
            file.sync_all()
        });
        written.map_err(|source| TableError::Write { path, source })
    }
}

/// Time of a frame in its episode, s, computed as in LeRobot.
fn seconds(frame: u64, rate_hz: f64) -> f64 {
    frame as f64 / rate_hz
}

/// Rate as LeRobot writes it: whole rates as integers.
#[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
fn rate(rate_hz: f64) -> Value {
    match rate_hz.fract() == 0.0 && rate_hz < 9e15 {
        true => Value::from(rate_hz as i64),
        false => Value::from(rate_hz),
    }
}

/// Number in a cell; NaN if the cell contains no number.
fn number(cell: &Cell) -> f64 {
    match cell {
        Cell::Number(number) => *number,
        Cell::Integer(number) => *number as f64,
        _ => f64::NAN,
    }
}
