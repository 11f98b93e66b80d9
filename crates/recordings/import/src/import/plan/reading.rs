//! Reads the rows of all tables: labels and frame locations.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::{Path, PathBuf};

use taceva_video::Decoders;

use super::view::ViewReading;
use crate::error::ImportError;
use crate::foreign::TableForm;
use crate::import::depth_maps::PlannedMaps;
use crate::import::frame_cells::FrameName;
use crate::import::map::{GravityMap, ImportMap};
use crate::import::resolve::{CoordinateFrames, JoinMatches};
use crate::import::rows::{MappedTable, SIGNAL_PLACEHOLDERS};
use crate::import::signals::FoundSignals;
use crate::import::summary::{ImportSummary, ZeroSummary};
use crate::source_folder::SourceFolder;
use taceva_dataset::Table;

/// State of reading the rows of all tables.
pub(super) struct Reading<'a> {
    pub(super) folder: &'a SourceFolder,
    pub(super) map: &'a ImportMap,
    pub(super) decoders: &'a Decoders,
    /// Number of tables.
    pub(super) count: usize,
    /// Path of the table being read.
    pub(super) current: PathBuf,
    pub(super) table: Table,
    /// Pictures of each view.
    pub(super) views: Vec<ViewReading<'a>>,
    pub(super) signals: Option<FoundSignals<'a>>,
    /// Depth maps of each task with depth maps.
    pub(super) maps: Vec<PlannedMaps>,
    /// Error if the numbers of pictures and rows differ and the map states no `index`; `None` if the numbers agree.
    pub(super) unequal: Option<ImportError>,
    pub(super) joins: Vec<JoinMatches>,
    /// Coordinate frames of the labels of all tables.
    pub(super) coordinate_frames: CoordinateFrames,
    /// Number of unwritten chunks, by file and array.
    pub(super) absent_chunks: BTreeMap<String, u64>,
    pub(super) samples: HashSet<String>,
    /// Images that rows name, including dropped rows.
    pub(super) named: BTreeSet<PathBuf>,
    /// Folders in which named images were searched.
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
            table: Table::new(map.channels.clone(), attributes)
                .with_views(map.frames.iter().filter_map(|frame| frame.view.as_deref()))
                .with_tasks(map.tasks.iter().map(|own| own.task.clone())),
            views: map.frames.iter().map(ViewReading::new).collect(),
            signals: None,
            maps: Vec::new(),
            unequal: None,
            joins: Vec::new(),
            coordinate_frames: CoordinateFrames::default(),
            absent_chunks: BTreeMap::new(),
            samples: HashSet::new(),
            named: BTreeSet::new(),
            bases: BTreeSet::new(),
            summary: ImportSummary::default(),
        }
    }

    pub(super) fn read(&mut self, path: &Path) -> Result<(), ImportError> {
        let mut rows = MappedTable::open(self.map, self.folder, path, self.decoders)?;
        path.clone_into(&mut self.current);
        self.check_dropped_rows(&rows)?;
        let rows_folder = rows.folder();
        for (own, of_table) in self.views.iter_mut().zip(&mut rows.views) {
            own.depth = of_table.depth.take();
            own.base = match &own.map.folder {
                Some(folder) => self.folder.path().join(folder),
                None if self.map.form == TableForm::Files => self.folder.path().to_owned(),
                None => rows_folder.clone(),
            };
        }
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
        for row in 0..rows.rows() {
            self.read_row(&rows, row)?;
        }
        self.coordinate_frames
            .add(std::mem::take(&mut rows.coordinate_frames))?;
        for (view, own) in self.views.iter().enumerate() {
            if rows.rows() == 0 || rows.named_by.frame(view, 0).is_none() {
                self.bases.insert(own.base.clone());
            }
        }
        Ok(())
    }

    /// Adds the zero and the weight, subtracted from the forces of a table, to the summary.
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

    fn read_row(&mut self, rows: &MappedTable<'_>, row: usize) -> Result<(), ImportError> {
        let number = self.summary.rows_read;
        self.summary.rows_read += 1;
        let mut reasons = rows.drop_reasons(row);
        let signals = self.signals.as_ref();
        if signals.is_some_and(|signals| signals.is_placeholder(number)) {
            reasons.push(SIGNAL_PLACEHOLDERS.to_owned());
        }
        if !reasons.is_empty() {
            for view in 0..self.views.len() {
                if let Ok((FrameName::File(name), _)) = rows.frame_name(view, row) {
                    let base = self.views[view].beside(rows.named_by.frame(view, row));
                    self.named.insert(base.join(name));
                }
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
        for view in 0..self.views.len() {
            self.read_frame(rows, view, row, &mut labels)?;
        }
        if let Some(signals) = &mut self.signals {
            signals.take(rows, row, number)?;
        }
        for maps in &mut self.maps {
            let file = maps.take(rows, row, number, self.folder)?;
            self.named.extend(file);
        }
        self.table.push(labels);
        self.summary.rows_kept += 1;
        Ok(())
    }
}
