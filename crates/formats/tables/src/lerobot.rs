//! LeRobot datasets, each a folder.

mod depth;
mod episodes;
mod feature;
mod files;
mod info;
mod metadata;
mod pattern;
mod stats;
mod takes;
mod video;
mod writer;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use self::files::{inside, json_file};
use self::info::{Info, Layout};
use self::pattern::Value as Filled;
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::limits;
use crate::parquet::{ColumnKind, ParquetTable};
use crate::rows::check_sorted;
use crate::source::Source;

pub use self::depth::DepthCodes;
pub use self::feature::WrittenFeature;
pub use self::info::Feature;
pub use self::stats::FeatureStats;
pub use self::video::VideoFrames;
pub use self::writer::LeRobotWriter;

/// LeRobot dataset, version 2.1 or 3.0, as one table with the rows of all its data files in sequence.
///
/// Columns have the names in the data files; `task` is the text of `task_index`. Videos are not decoded. [`video`](LeRobot::video) returns the file and frame
/// of each row.
///
/// ```
/// use taceva_tables::{Cell, LeRobot};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses-lerobot");
/// let dataset = LeRobot::open(path.as_ref())?;
/// assert_eq!(dataset.rows(), 4);
/// assert_eq!(dataset.column("observation.state[1]")?[3], Cell::Number(1.25));
/// assert_eq!(dataset.column("task")?[2], Cell::Text("press the ball".into()));
/// let frames = dataset.video("observation.images.gel")?;
/// assert_eq!(frames.at(2), Some(("videos/chunk-000/observation.images.gel/episode_000001.mp4".as_ref(), 0)));
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Debug)]
pub struct LeRobot {
    folder: PathBuf,
    source: Source,
    info: Info,
    files: Vec<DataFile>,
    names: Vec<String>,
    tasks: BTreeMap<i128, String>,
    rows: u64,
}

#[derive(Clone, Debug)]
struct DataFile {
    path: PathBuf,
    rows: u64,
}

impl LeRobot {
    /// Opens the dataset in `folder`. Reads its metadata, and the footers of all data files.
    ///
    /// # Errors
    /// [`TableError::Unsupported`] for another version, or files outside the folder. [`TableError::Damaged`] if an episode was recorded twice, or its
    /// number of rows contradicts its description. Otherwise errors of [`ParquetTable::open`].
    pub fn open(folder: &Path) -> Result<LeRobot, TableError> {
        let (source, json) = json_file(folder, "meta/info.json")?;
        let info = info::parse(&source, &json)?;
        let paths = match info.layout {
            Layout::V30 => info.data.files(folder).map_err(|error| source.io(error))?,
            Layout::V21 => {
                let fill = |episode: u64| {
                    let values = [
                        ("episode_chunk", Filled::Number(episode / info.chunks_size)),
                        ("episode_index", Filled::Number(episode)),
                    ];
                    let path = info.data.fill(&values);
                    path.map_err(|problem| source.damaged(Place::of("data_path"), problem))
                };
                let episodes = episodes::of_lines(folder)?;
                let mut paths: Vec<PathBuf> =
                    episodes.into_iter().map(fill).collect::<Result<_, _>>()?;
                // A path without an episode field names one file.
                paths.dedup();
                paths
            }
        };
        let mut files = Vec::with_capacity(paths.len());
        let mut names: Vec<String> = Vec::new();
        let mut rows = 0_u64;
        for path in paths {
            let path = inside(folder, &path)?;
            let table = ParquetTable::open(&path)?;
            match files.is_empty() {
                true => names = table.names(),
                false if names == table.names() => {}
                false => {
                    let problem = "its columns differ from the columns of the first data file";
                    return Err(Source::new(&path)?.damaged(Place::default(), problem));
                }
            }
            rows = rows.saturating_add(table.rows());
            files.push(DataFile {
                path,
                rows: table.rows(),
            });
        }
        if files.is_empty() {
            return Err(source.damaged(Place::of("data_path"), "no data file exists at this path"));
        }
        if rows > limits::ROWS {
            let problem = format!("{rows} rows, at most {} are accepted", limits::ROWS);
            return Err(source.too_large(Place::default(), problem));
        }
        let mut tasks = BTreeMap::new();
        if names.iter().any(|name| name == "task_index") && !names.iter().any(|name| name == "task")
        {
            tasks = episodes::tasks(folder, info.layout == Layout::V21)?;
            names.push("task".to_owned());
        }
        let dataset = LeRobot {
            folder: folder.to_owned(),
            source,
            info,
            files,
            names,
            tasks,
            rows,
        };
        takes::check(&dataset)?;
        Ok(dataset)
    }

    /// Folder of the dataset.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Columns of the data files, and `task`.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Features in `meta/info.json`: columns and videos, by name.
    pub fn features(&self) -> &[Feature] {
        &self.info.features
    }

    /// Cells of the column `name`, row by row, converted as by [`ParquetTable::column`].
    ///
    /// # Errors
    /// Errors of [`ParquetTable::column`]; the limit applies to all files together.
    pub fn column(&self, name: &str) -> Result<Vec<Cell>, TableError> {
        if name == "task" && !self.tasks.is_empty() {
            let indices = self.column("task_index")?;
            let text = |index: Cell| match index {
                Cell::Integer(index) => {
                    let task = self.tasks.get(&index).cloned().map(Cell::Text);
                    task.ok_or_else(|| {
                        self.source
                            .mismatch("task_index", format!("task {index} has no description"))
                    })
                }
                _ => Ok(Cell::Null),
            };
            return indices.into_iter().map(text).collect();
        }
        let mut cells = Vec::new();
        let mut bytes = 0;
        for file in &self.files {
            let table = file.open()?;
            if !self.has(name) {
                return Err(self.source.missing(name, self.names.clone()));
            }
            table.read_column(name, &mut bytes, &mut cells)?;
        }
        Ok(cells)
    }

    /// Kind of the cells of the column `name`, according to the first data file.
    ///
    /// # Errors
    /// Errors of [`ParquetTable::kind`].
    ///
    /// ```
    /// use taceva_tables::{ColumnKind, LeRobot};
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses-lerobot");
    /// let dataset = LeRobot::open(path.as_ref())?;
    /// assert_eq!(dataset.kind("timestamp")?, ColumnKind::Number);
    /// assert_eq!(dataset.kind("task")?, ColumnKind::Text);
    /// # Ok::<(), taceva_tables::TableError>(())
    /// ```
    pub fn kind(&self, name: &str) -> Result<ColumnKind, TableError> {
        if name == "task" && !self.tasks.is_empty() {
            return Ok(ColumnKind::Text);
        }
        let first = self.files.first().filter(|_| self.has(name));
        let first = first.ok_or_else(|| self.source.missing(name, self.names.clone()))?;
        first.open()?.kind(name)
    }

    /// Calls `each` with each row of `sorted` and its picture in a feature with dtype `image`, or its bytes in another column. See
    /// [`ParquetTable::visit_bytes`].
    ///
    /// # Errors
    /// Errors of [`ParquetTable::visit_bytes`].
    pub fn visit_bytes<E: From<TableError>>(
        &self,
        name: &str,
        sorted: &[u64],
        each: &mut dyn FnMut(u64, Option<Vec<u8>>) -> Result<(), E>,
    ) -> Result<(), E> {
        let of_image = format!("{name}.bytes");
        let name = match self.names.contains(&of_image) {
            true => &of_image,
            false => name,
        };
        if !self.has(name) {
            return Err(self.source.missing(name, self.names.clone()).into());
        }
        check_sorted(&self.source, name, sorted, self.rows)?;
        let mut wanted = sorted;
        let mut begin = 0;
        for file in &self.files {
            let end = begin + file.rows;
            let (here, later) = wanted.split_at(wanted.partition_point(|row| *row < end));
            wanted = later;
            if !here.is_empty() {
                let rows: Vec<u64> = here.iter().map(|row| row - begin).collect();
                file.open()?
                    .visit_bytes(name, &rows, &mut |row, bytes| each(begin + row, bytes))?;
            }
            begin = end;
        }
        Ok(())
    }

    /// Frame of each row in the video `key`, a feature with dtype `video`. The time stamp of the row, counted from the start of its episode in the
    /// file, determines the frame.
    ///
    /// # Errors
    /// [`TableError::Missing`] if no video has this name. [`TableError::Damaged`] if no file contains an episode, or a time stamp is more than a quarter of a
    /// frame from the nearest frame.
    pub fn video(&self, key: &str) -> Result<VideoFrames, TableError> {
        video::frames(self, key)
    }

    fn has(&self, name: &str) -> bool {
        crate::path::longest(name, self.names.iter().map(String::as_str)).is_some()
            || self.names.iter().any(|known| {
                known
                    .strip_prefix(name)
                    .is_some_and(|rest| rest.starts_with('.'))
            })
    }
}

impl DataFile {
    fn open(&self) -> Result<ParquetTable, TableError> {
        let table = ParquetTable::open(&self.path)?;
        match table.rows() == self.rows {
            true => Ok(table),
            false => {
                let problem = format!(
                    "{} rows, but the file had {} when it was first opened",
                    table.rows(),
                    self.rows
                );
                Err(Source::new(&self.path)?.damaged(Place::default(), problem))
            }
        }
    }
}
