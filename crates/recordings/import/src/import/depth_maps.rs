//! Depth maps of an import, planned with the kept rows and written when the import runs.

use std::path::{Path, PathBuf};

use taceva_core::Progress;

use super::map::{ImportMap, TaskMap};
use super::rows::MappedTable;
use crate::error::{ImportError, table_error};
use crate::maps_file::MapsFile;
use crate::source_folder::SourceFolder;
use taceva_dataset::internal::{
    MapPack, layout, limits, map_of_numbers, map_of_png, parts_of_map, read_capped,
    staging::StagedFolder,
};
use taceva_dataset::{Dataset, DatasetError, MapFacts, Place, Table};

/// Depth maps of one task that an import will write.
#[derive(Debug)]
pub(super) struct PlannedMaps {
    /// Position of the task in the map.
    task: usize,
    name: String,
    facts: MapFacts,
    array: Option<MapsFile>,
    /// Source of the map of each kept row; `None` for a row without a map.
    of_rows: Vec<Option<MapSource>>,
}

#[derive(Debug)]
enum MapSource {
    File(PathBuf, Place),
    /// Depth map at this position in the array, from 0.
    Row(u64),
}

impl PlannedMaps {
    /// One entry, still without rows, for each task with depth maps.
    pub(super) fn of_tasks(
        map: &ImportMap,
        folder: &SourceFolder,
    ) -> Result<Vec<PlannedMaps>, ImportError> {
        let tasks = map.tasks.iter().enumerate();
        let tasks = tasks.filter_map(|(task, own)| Some((task, own, own.task.maps.clone()?)));
        let opened = tasks.map(|(task, own, facts)| {
            Ok(PlannedMaps {
                task,
                name: own.task.name.clone(),
                facts,
                array: opened(own, folder)?,
                of_rows: Vec::new(),
            })
        });
        opened.collect()
    }

    /// Adds a kept row. `number` counts rows over all tables. Returns the file of the map, if the row has a separate file.
    pub(super) fn take(
        &mut self,
        rows: &MappedTable<'_>,
        row: usize,
        number: u64,
        folder: &SourceFolder,
    ) -> Result<Option<PathBuf>, ImportError> {
        let (source, file) = match &self.array {
            Some(array) => {
                if number >= array.count() {
                    return Err(table_error!(
                        rows.place(row),
                        "[task.{}] has {} depth maps in its array, but the table has more rows",
                        self.name,
                        array.count()
                    ));
                }
                (Some(MapSource::Row(number)), None)
            }
            None => match rows.map_file(self.task, row) {
                Some((name, place)) => {
                    let file = folder.file(folder.path(), name);
                    let file = file.map_err(|error| error.named_at(place.clone()))?;
                    (Some(MapSource::File(file.clone(), place)), Some(file))
                }
                None => (None, None),
            },
        };
        self.of_rows.push(source);
        Ok(file)
    }

    /// Checks that the array of depth maps, if any, has one map for each of the `rows` table rows.
    pub(super) fn check_rows(&self, rows: u64) -> Result<(), ImportError> {
        match &self.array {
            Some(array) if array.count() != rows => Err(ImportError::table(
                array.path(),
                format!(
                    "{} depth maps for {rows} rows of the table: [task.{}] needs one for each row",
                    array.count(),
                    self.name
                ),
            )),
            _ => Ok(()),
        }
    }

    /// Number of rows with a map.
    pub(super) fn count(&self) -> usize {
        self.of_rows.iter().flatten().count()
    }

    /// Name of the task.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// Appends the maps to those of `before`, in the staged folder. Stores the position of each map in `table`, which has the planned rows.
    fn write(
        &self,
        staged: &StagedFolder,
        before: Option<&Dataset>,
        table: &mut Table,
        progress: &dyn Progress,
    ) -> Result<(), ImportError> {
        let relative = layout::map_pack_path(&self.name);
        let former = before.map(|before| before.path().join(&relative));
        let former = former.filter(|path| path.is_file());
        let mut pack = MapPack::create(&staged.path().join(&relative), former.as_deref())?;
        let mut size = before.map_or(Ok(None), |before| size_of_first(before, &self.name))?;
        // Maps of the array that were read and not yet written, with the position of the first.
        let mut held: (u64, Vec<Vec<f64>>) = (0, Vec::new());
        for (row, source) in self.of_rows.iter().enumerate() {
            if progress.is_cancelled() {
                return Err(DatasetError::Cancelled.into());
            }
            let Some(source) = source else { continue };
            let (bytes, place) = match source {
                MapSource::File(path, place) => (self.of_file(path, place)?, place.clone()),
                MapSource::Row(number) => {
                    let Some(array) = &self.array else { continue };
                    let place = Place::file(array.path()).in_row(*number);
                    let first = *number - *number % array.step();
                    if held.1.is_empty() || held.0 != first {
                        let end = (first + array.step()).min(array.count());
                        held = (first, array.maps(first..end)?);
                    }
                    let at = usize::try_from(*number - first).unwrap_or(usize::MAX);
                    let numbers = held.1.get(at).map_or(&[][..], Vec::as_slice);
                    let bytes = map_of_numbers(array.size(), numbers, self.facts.invalid);
                    let bytes = bytes.map_err(|problem| self.wrong(place.clone(), &problem))?;
                    (bytes, place)
                }
            };
            let found = size_of(&bytes);
            match *size.get_or_insert(found) {
                expected if expected == found => {}
                [rows, columns] => {
                    let problem = format!(
                        "a map of {} x {} pixels, expected {rows} x {columns} as in the first map",
                        found[0], found[1]
                    );
                    return Err(self.wrong(place, &problem));
                }
            }
            table.set_map(&self.name, row, pack.append(&bytes)?);
        }
        Ok(pack.finish()?)
    }

    /// Stored bytes of a depth map that has a separate file.
    fn of_file(&self, path: &Path, place: &Place) -> Result<Vec<u8>, ImportError> {
        let is_png = path
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
        let bytes = match is_png {
            true => map_of_png(&read_capped(path, limits::IMAGE_BYTES)?, self.facts.invalid),
            false => {
                let file = MapsFile::open(path, None);
                let file = file.map_err(|error| error.named_at(place.clone()))?;
                match file.count() {
                    1 => map_of_numbers(file.size(), &file.map(0)?, self.facts.invalid),
                    count => Err(format!(
                        "{count} maps in the file of one row: write `array` in the place of `from` for a file with all maps"
                    )),
                }
            }
        };
        bytes
            .map_err(|problem| self.wrong(place.clone(), &format!("{}: {problem}", path.display())))
    }

    fn wrong(&self, place: Place, problem: &str) -> ImportError {
        table_error!(place, "[task.{}]: {problem}", self.name)
    }
}

/// Writes the depth maps of all tasks, and stores their positions in `table`. Returns the folder of the maps; `None` without depth maps.
pub(super) fn write_maps(
    maps: &[PlannedMaps],
    staged: &StagedFolder,
    before: Option<&Dataset>,
    table: &mut Table,
    progress: &dyn Progress,
) -> Result<Option<String>, ImportError> {
    if maps.is_empty() {
        return Ok(None);
    }
    staged.ensure_folder(layout::MAPS)?;
    for own in maps {
        own.write(staged, before, table, progress)?;
    }
    Ok(Some(layout::MAPS.to_owned()))
}

/// Opened array of the depth maps of the task `own`, if the maps are in an array.
fn opened(own: &TaskMap, folder: &SourceFolder) -> Result<Option<MapsFile>, ImportError> {
    let Some(array) = &own.array else {
        return Ok(None);
    };
    let path = folder.file(folder.path(), &array.file)?;
    MapsFile::open(&path, array.path.as_deref()).map(Some)
}

/// Number of rows and columns of the depth map stored as `bytes`.
fn size_of(bytes: &[u8]) -> [usize; 2] {
    parts_of_map(bytes).map_or([0; 2], |parts| [parts.rows, parts.columns])
}

/// Number of rows and columns of the first depth map of `before` for the task called `name`.
fn size_of_first(before: &Dataset, name: &str) -> Result<Option<[usize; 2]>, ImportError> {
    for row in 0..before.table().rows() {
        if let Some(bytes) = before.depth_map_bytes(name, row)? {
            return Ok(Some(size_of(&bytes)));
        }
    }
    Ok(None)
}
