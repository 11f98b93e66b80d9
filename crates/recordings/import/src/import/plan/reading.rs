//! The rows of all tables, one after the other: their labels, and where their frames lie.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_video::Decoders;

use crate::foreign::{DepthPixels, Pictures, TableForm};
use crate::import::frame_cells::FrameName;
use crate::import::frame_plan::{FrameSource, PlannedFrame};
use crate::import::map::{GravityMap, ImportMap};
use crate::import::references::References;
use crate::import::resolve::{CoordinateFrames, JoinMatches};
use crate::import::rows::{MappedTable, SIGNAL_PLACEHOLDERS};
use crate::import::signals::FoundSignals;
use crate::import::summary::{ImportSummary, ZeroSummary};
use crate::source_folder::SourceFolder;
use taceva_dataset::{DatasetError, Table};

/// The rows of all tables as they are read.
pub(super) struct Reading<'a> {
    pub(super) folder: &'a SourceFolder,
    pub(super) map: &'a ImportMap,
    pub(super) decoders: &'a Decoders,
    /// How many tables there are.
    pub(super) count: usize,
    /// The table that is being read.
    pub(super) current: PathBuf,
    /// The pixels of a depth map that the clips of that table are.
    pub(super) depth: Option<DepthPixels>,
    pub(super) table: Table,
    /// The files with pictures in them that rows named.
    pub(super) opened: BTreeMap<PathBuf, Arc<dyn Pictures>>,
    /// Those of which a row has the picture of its own number, as the map names them, each with the table of these rows.
    pub(super) counted: BTreeMap<String, PathBuf>,
    pub(super) frames: Vec<PlannedFrame>,
    pub(super) signals: Option<FoundSignals<'a>>,
    /// That there are more or fewer pictures than rows, and nothing says which is whose.
    pub(super) unequal: Option<DatasetError>,
    pub(super) references: References,
    pub(super) joins: Vec<JoinMatches>,
    /// The frames that labels of all tables are given in.
    pub(super) coordinate_frames: CoordinateFrames,
    /// Chunks that were never written, by file and array.
    pub(super) absent_chunks: BTreeMap<String, u64>,
    pub(super) samples: HashSet<String>,
    /// Every image that a row names, dropped ones too.
    pub(super) named: BTreeSet<PathBuf>,
    /// The folders that images are relative to.
    pub(super) bases: BTreeSet<PathBuf>,
    pub(super) summary: ImportSummary,
}

impl<'a> Reading<'a> {
    pub(super) fn new(
        folder: &'a SourceFolder,
        map: &'a ImportMap,
        decoders: &'a Decoders,
    ) -> Reading<'a> {
        let attributes = map.attributes.keys().chain(map.classes.keys());
        let attributes = attributes.cloned().collect();
        Reading {
            folder,
            map,
            decoders,
            count: 0,
            current: PathBuf::new(),
            depth: None,
            opened: BTreeMap::new(),
            counted: BTreeMap::new(),
            table: Table::new(map.channels.clone(), attributes),
            frames: Vec::new(),
            signals: None,
            unequal: None,
            references: References::default(),
            joins: Vec::new(),
            coordinate_frames: CoordinateFrames::default(),
            absent_chunks: BTreeMap::new(),
            samples: HashSet::new(),
            named: BTreeSet::new(),
            bases: BTreeSet::new(),
            summary: ImportSummary::default(),
        }
    }

    pub(super) fn read(&mut self, path: &Path) -> Result<(), DatasetError> {
        let mut rows = MappedTable::open(self.map, self.folder, path)?;
        path.clone_into(&mut self.current);
        self.depth = rows.depth.take();
        self.summary.unmentioned_columns.extend(rows.unmentioned());
        for join in std::mem::take(&mut rows.joins) {
            let mut joins = self.joins.iter_mut();
            match joins.find(|known| known.name() == join.name()) {
                Some(known) => {
                    let are_files = self.map.form == TableForm::Files;
                    known.check_counted_once(&join, path, self.count, are_files)?;
                    known.add(join);
                }
                None => self.joins.push(join),
            }
        }
        self.absent_chunks.append(&mut rows.absent_chunks);
        let unread = std::mem::take(&mut rows.unread_topics);
        self.summary.unread_topics.extend(unread);
        self.summary
            .warnings
            .extend(std::mem::take(&mut rows.warnings));
        self.note_zeros(&rows);
        let frame = self.map.frame.as_ref();
        let base = match frame.and_then(|frame| frame.folder.as_ref()) {
            Some(folder) => self.folder.path().join(folder),
            None if self.map.form == TableForm::Files => self.folder.path().to_owned(),
            None => rows.folder(),
        };
        for row in 0..rows.rows() {
            self.read_row(&rows, row, &base)?;
        }
        self.coordinate_frames
            .add(std::mem::take(&mut rows.coordinate_frames))?;
        if rows.rows() == 0 || rows.named_by.frame(0).is_none() {
            self.bases.insert(base);
        }
        Ok(())
    }

    /// Notes what is taken from the forces of a table.
    fn note_zeros(&mut self, rows: &MappedTable<'_>) {
        let gravity = self.map.gravity.as_ref();
        self.summary.gravity = gravity.map(GravityMap::rule);
        let Some((map, zeros)) = self.map.zero.as_ref().zip(rows.zeros.as_ref()) else {
            return;
        };
        for (at, channel) in map.channels.iter().enumerate() {
            let channel = self.map.channels.as_slice()[*channel].name();
            let ([least, greatest], blocks) = zeros.range(at);
            let mut known = self.summary.zeros.iter_mut();
            match known.find(|known| known.channel == channel) {
                Some(known) => {
                    known.least = known.least.min(least);
                    known.greatest = known.greatest.max(greatest);
                    known.blocks += blocks;
                }
                None => self.summary.zeros.push(ZeroSummary {
                    channel: channel.to_owned(),
                    rule: map.rule(),
                    least,
                    greatest,
                    blocks,
                }),
            }
        }
    }

    fn read_row(
        &mut self,
        rows: &MappedTable<'_>,
        row: usize,
        base: &Path,
    ) -> Result<(), DatasetError> {
        let number = self.summary.rows_read;
        self.summary.rows_read += 1;
        let mut reasons = rows.drop_reasons(row);
        let signals = self.signals.as_ref();
        if signals.is_some_and(|signals| signals.is_placeholder(number)) {
            reasons.push(SIGNAL_PLACEHOLDERS.to_owned());
        }
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
        if let Some((name, named_at)) = rows.reference_name(row) {
            let base = beside(rows.named_by.reference(row));
            self.references.take(self.folder, &base, name, named_at)?;
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
}
