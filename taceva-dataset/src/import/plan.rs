//! What an import would read, convert and leave out, before anything is written.

mod channels;
mod name_order;
mod pictures;

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_video::Decoders;

use super::frame_cells::FrameName;
use super::left_out;
use super::map::{FrameMap, FrameNames, ImportMap};
use super::mapped::mapping;
use super::planned_frames::{FrameSource, PlannedFrame, PlannedFrames};
use super::references::{References, Settled};
use super::resolve::JoinMatches;
use super::rows::MappedTable;
use super::signals::{FoundSignals, PlannedSignals};
use super::source::{matching_files, unnamed_images};
use super::summary::ImportSummary;
use crate::error::{DatasetError, Place};
use crate::file::SourceFolder;
use crate::foreign::{Pictures, TableForm};
use crate::header::Mapping;
use crate::store::RecordingFacts;
use crate::table::Table;
use crate::text::shown;

/// How many images that no row names are listed.
const LISTED_IMAGES: usize = 20;

/// An import that can be made: every label is read and converted, every frame is found; frames are verified when it is run.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, SourceUnit};
/// # use taceva_dataset::{ColumnMap, ImportMap, ImportPlan, RecordingFacts, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
/// let mut map = ImportMap::new("labels.csv", facts);
/// map.channels = Channels::new([Channel::FZ])?;
/// map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
/// let plan = ImportPlan::new(folder.path(), &map)?;
///
/// assert_eq!(plan.summary().rows_kept, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ImportPlan {
    pub(super) summary: ImportSummary,
    pub(super) facts: RecordingFacts,
    pub(super) table: Table,
    pub(super) frames: Option<PlannedFrames>,
    pub(super) signals: Option<PlannedSignals>,
    /// How the map reads what it reads.
    pub(super) mapping: Mapping,
    /// Whether samples are called by the number of their row, because the map names no column for it.
    pub(super) is_numbered: bool,
}

impl ImportPlan {
    /// Reads the tables that `map` names in the folder at `source`, and finds every frame.
    ///
    /// # Errors
    /// [`DatasetError::Table`] naming line and column; [`DatasetError::Path`] if a path is missing, leaves the folder or is no
    /// regular file; [`DatasetError::Image`] if an array cannot be used; [`DatasetError::Io`].
    pub fn new(source: &Path, map: &ImportMap) -> Result<ImportPlan, DatasetError> {
        ImportPlan::with_decoders(source, map, &Decoders::default())
    }

    /// As [`new`](ImportPlan::new), with programs that decode clips which are not decoded here.
    ///
    /// # Errors
    /// As [`new`](ImportPlan::new); [`DatasetError::Image`] naming the codec and what would mend it if nothing at hand decodes a clip.
    /// ```
    /// # use taceva_core::{Channel, Channels, Clock, SourceUnit};
    /// # use taceva_dataset::{ColumnMap, ImportMap, ImportPlan, RecordingFacts, SensorFacts, Source};
    /// # let folder = tempfile::tempdir()?;
    /// # std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
    /// # let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
    /// # let mut map = ImportMap::new("labels.csv", facts);
    /// # map.channels = Channels::new([Channel::FZ])?;
    /// # map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
    /// use taceva_dataset::Decoders;
    ///
    /// let mut decoders = Decoders::default();
    /// decoders.ffmpeg = Some("/usr/bin/ffmpeg".into());
    /// let plan = ImportPlan::with_decoders(folder.path(), &map, &decoders)?;
    /// assert_eq!(plan.summary().rows_kept, 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_decoders(
        source: &Path,
        map: &ImportMap,
        decoders: &Decoders,
    ) -> Result<ImportPlan, DatasetError> {
        let folder = SourceFolder::open(source)?;
        let tables = matching_files(&folder, &map.table)?;
        let mut reading = Reading::new(&folder, map, decoders);
        reading.count = tables.len();
        let signals = map.signals.as_ref();
        let signals = signals.map(|signals| FoundSignals::new(signals, &folder));
        reading.signals = signals.transpose()?;
        for path in &tables {
            reading.read(path)?;
        }
        match map.form {
            TableForm::Files => reading.summary.files = tables.len() as u64,
            _ => reading.summary.tables = tables,
        }
        if reading.summary.rows_kept == 0 {
            return Err(reading.no_row());
        }
        reading.into_plan()
    }

    /// What the import reads, converts, keeps and leaves out.
    pub fn summary(&self) -> &ImportSummary {
        &self.summary
    }

    /// What the pictures will take on disk, in bytes: files as they are, each once. Pictures within other files are not counted here.
    ///
    /// A file that went away since counts as nothing: the import itself names it.
    pub fn frame_bytes(&self) -> u64 {
        let frames = self.frames.iter();
        let files: BTreeSet<&Path> = frames
            .clone()
            .flat_map(|frames| frames.of_rows.iter())
            .filter_map(|frame| match &frame.from {
                FrameSource::File(path) => Some(path.as_path()),
                FrameSource::Within(..) => None,
            })
            .chain(frames.filter_map(|frames| frames.reference.as_deref()))
            .collect();
        let sizes = files.into_iter().filter_map(|path| path.metadata().ok());
        sizes.map(|facts| facts.len()).sum()
    }
}

/// The rows of all tables as they are read.
struct Reading<'a> {
    folder: &'a SourceFolder,
    map: &'a ImportMap,
    decoders: &'a Decoders,
    /// How many tables there are.
    count: usize,
    /// The table that is being read.
    current: PathBuf,
    table: Table,
    /// The files with pictures in them that rows named.
    opened: BTreeMap<PathBuf, Arc<dyn Pictures>>,
    /// Those of which a row has the picture of its own number, as the map names them, each with the table of these rows.
    counted: BTreeMap<String, PathBuf>,
    frames: Vec<PlannedFrame>,
    signals: Option<FoundSignals<'a>>,
    /// That there are more or fewer pictures than rows, and nothing says which is whose.
    unequal: Option<DatasetError>,
    references: References,
    joins: Vec<JoinMatches>,
    /// Chunks that were never written, by file and array.
    absent_chunks: BTreeMap<String, u64>,
    samples: HashSet<String>,
    /// Every image that a row names, dropped ones too.
    named: BTreeSet<PathBuf>,
    /// The folders that images are relative to.
    bases: BTreeSet<PathBuf>,
    summary: ImportSummary,
}

impl<'a> Reading<'a> {
    fn new(folder: &'a SourceFolder, map: &'a ImportMap, decoders: &'a Decoders) -> Reading<'a> {
        let attributes = map.attributes.keys().chain(map.classes.keys());
        let attributes = attributes.cloned().collect();
        Reading {
            folder,
            map,
            decoders,
            count: 0,
            current: PathBuf::new(),
            opened: BTreeMap::new(),
            counted: BTreeMap::new(),
            table: Table::new(map.channels.clone(), attributes),
            frames: Vec::new(),
            signals: None,
            unequal: None,
            references: References::default(),
            joins: Vec::new(),
            absent_chunks: BTreeMap::new(),
            samples: HashSet::new(),
            named: BTreeSet::new(),
            bases: BTreeSet::new(),
            summary: ImportSummary::default(),
        }
    }

    fn read(&mut self, path: &Path) -> Result<(), DatasetError> {
        let mut rows = MappedTable::open(self.map, self.folder, path)?;
        path.clone_into(&mut self.current);
        self.summary.unmentioned_columns.extend(rows.unmentioned());
        for join in std::mem::take(&mut rows.joins) {
            let mut joins = self.joins.iter_mut();
            match joins.find(|known| known.name() == join.name()) {
                Some(known) => {
                    let are_files = self.map.form == TableForm::Files;
                    known.check_counted_once(&join, path, (self.count, are_files))?;
                    known.add(join);
                }
                None => self.joins.push(join),
            }
        }
        self.absent_chunks.append(&mut rows.absent_chunks);
        let frame = self.map.frame.as_ref();
        let base = match frame.and_then(|frame| frame.folder.as_ref()) {
            Some(folder) => self.folder.path().join(folder),
            None if self.map.form == TableForm::Files => self.folder.path().to_owned(),
            None => rows.folder(),
        };
        for row in 0..rows.rows() {
            self.read_row(&rows, row, &base)?;
        }
        if rows.rows() == 0 || rows.named_by.frame(0).is_none() {
            self.bases.insert(base);
        }
        Ok(())
    }

    fn read_row(
        &mut self,
        rows: &MappedTable<'_>,
        row: usize,
        base: &Path,
    ) -> Result<(), DatasetError> {
        let number = self.summary.rows_read;
        self.summary.rows_read += 1;
        let reasons = rows.drop_reasons(row);
        // What a table names lies beside it, unless the map says a folder.
        let says_folder = self
            .map
            .frame
            .as_ref()
            .and_then(|frame| frame.folder.as_ref());
        let beside = |named_by: Option<&'_ Path>| match says_folder {
            None => named_by.unwrap_or(base).to_owned(),
            Some(_) => base.to_owned(),
        };
        let base_of_frame = beside(rows.named_by.frame(row));
        if !reasons.is_empty() {
            if let Ok(Some((FrameName::File(name), _))) = rows.frame_name(row) {
                self.named.insert(base_of_frame.join(name));
            }
            for reason in reasons {
                *self.summary.dropped.entry(reason).or_default() += 1;
            }
            return Ok(());
        }
        let mut labels = rows.row(row, number)?;
        if !self.samples.insert(labels.sample.clone()) {
            return Err(rows.duplicate(row, &labels.sample));
        }
        if let Some((name, named_at)) = rows.frame_name(row)? {
            let from = self
                .frame_source(rows, &base_of_frame, name)
                .map_err(|error| error.named_at(named_at.clone()))?;
            if self.map.origin.is_none() && labels.source_table.is_some() {
                labels.source_frame = Some(from.origin(self.folder.path()));
            }
            self.frames.push(PlannedFrame { from, named_at });
        }
        if let Some(named) = rows.reference_name(row) {
            let base = beside(rows.named_by.reference(row));
            self.references.take(self.folder, &base, named)?;
        }
        if let Some(signals) = &mut self.signals {
            signals.take(rows, row, number)?;
        }
        self.table.push(labels);
        self.summary.rows_kept += 1;
        Ok(())
    }

    fn frame_source(
        &mut self,
        rows: &MappedTable<'_>,
        base: &Path,
        name: FrameName,
    ) -> Result<FrameSource, DatasetError> {
        let (pictures, index) = match (name, &rows.pictures) {
            (FrameName::File(name), _) => {
                let path = self.folder.file(base, &name)?;
                self.check_named_once(&path, rows)?;
                if !self.bases.contains(base) {
                    self.bases.insert(base.to_owned());
                }
                self.named.insert(path.clone());
                return Ok(FrameSource::File(path));
            }
            (FrameName::Within(Some(file), index), _) => {
                let pictures = self.pictures(&file)?;
                self.check_counted_once(&file, rows)?;
                self.note_unequal(&pictures, rows);
                (pictures, index)
            }
            (FrameName::Within(None, index), Some(pictures)) => {
                self.note_unequal(pictures, rows);
                (Arc::clone(pictures), index)
            }
            (FrameName::Within(None, index), None) => {
                return Err(DatasetError::Path {
                    place: None,
                    written: index.to_string(),
                    problem: "a position without an array".to_owned(),
                });
            }
        };
        pictures.check_index(index)?;
        Ok(FrameSource::Within(pictures, index))
    }

    /// The error that nothing is left to import, and why.
    fn no_row(&self) -> DatasetError {
        let summary = &self.summary;
        let dropped = summary.dropped.iter();
        let dropped: Vec<String> = dropped
            .map(|(reason, count)| format!("{} {count}", shown(reason)))
            .collect();
        let problem = match summary.rows_read {
            0 => "no row below the header: there is nothing to import".to_owned(),
            read => format!(
                "all {read} rows are left out ({}): there is nothing to import",
                dropped.join(", ")
            ),
        };
        DatasetError::Table {
            place: Place::file(
                summary
                    .tables
                    .first()
                    .map_or(self.folder.path(), PathBuf::as_path),
            ),
            problem,
        }
    }

    fn into_plan(mut self) -> Result<ImportPlan, DatasetError> {
        if let Some(unequal) = self.unequal.take() {
            return Err(unequal);
        }
        let frames = match &self.map.frame {
            Some(frame) => Some(self.planned_frames(frame)?),
            None => None,
        };
        self.describe_channels();
        self.summary.joins = self.joins.iter().map(JoinMatches::summary).collect();
        if let Some(signals) = &self.signals {
            signals.count_absent_chunks(self.folder, &mut self.absent_chunks)?;
        }
        left_out::count(
            self.folder,
            self.map.frame.as_ref().zip(frames.as_ref()),
            self.absent_chunks,
            &mut self.summary,
        )?;
        let rows_read = self.summary.rows_read;
        let signals = self.signals.take();
        let signals = signals.map(|signals| signals.into_plan(rows_read));
        self.summary.signals = self.map.signals.as_ref().map(|map| map.spec.info);
        Ok(ImportPlan {
            signals: signals.transpose()?,
            summary: self.summary,
            facts: self.map.facts.clone(),
            is_numbered: self.map.ids.sample.is_none(),
            mapping: mapping(self.map, self.folder)?,
            table: self.table,
            frames,
        })
    }

    fn planned_frames(&mut self, frame: &FrameMap) -> Result<PlannedFrames, DatasetError> {
        let references = std::mem::take(&mut self.references);
        let Settled {
            reference,
            different,
        } = match &frame.reference {
            Some(path) => Settled {
                reference: Some(self.folder.file(self.folder.path(), path)?),
                different: 0,
            },
            None => {
                let named = references.paths(self.folder);
                self.named.extend(named);
                references.settle(self.folder, &mut self.table)?
            }
        };
        self.summary.references = different as u64;
        self.named.extend(reference.clone());
        if matches!(frame.names, FrameNames::Column(_) | FrameNames::Pattern(_)) {
            let mut unnamed = BTreeSet::new();
            for base in &self.bases {
                let found = unnamed_images(base, &self.named);
                self.summary.has_more_files |= found.has_more;
                unnamed.extend(found.images);
            }
            self.summary.unnamed_images = unnamed.len() as u64;
            self.summary.first_unnamed_images = unnamed.into_iter().take(LISTED_IMAGES).collect();
        }
        self.summary.channel_order = Some(frame.channel_order);
        self.summary.reference.clone_from(&reference);
        Ok(PlannedFrames {
            order: frame.channel_order,
            reference,
            of_rows: std::mem::take(&mut self.frames),
        })
    }
}
