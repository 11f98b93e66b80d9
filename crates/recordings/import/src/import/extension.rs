//! Adds rows to an imported dataset. Writes a successor that shares the files of the dataset, then replaces the dataset atomically.

mod certificates;
mod duplicates;
mod successor;

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::Progress;

use super::copy::{CopiedFrames, ImportReport, copy_frames};
use super::depth_maps::write_maps;
use super::frame_plan::PlannedFrames;
use super::plan::ImportPlan;
use crate::error::ImportError;
use crate::source_sums::list_of;
use certificates::check_certificates;
use duplicates::refuse_twice;
use successor::{Written, share_files, write_header, write_signals};
use taceva_dataset::internal::{
    Difference, Misread, RowNames, differences_of_added, layout, staging::Place,
    staging::StagedFolder, write_durable,
};
use taceva_dataset::{Dataset, Digest, Header, SourcesInfo, Table};

/// Date and source of added rows, as recorded in the header of the dataset.
///
/// ```
/// let added = taceva_import::Addition::new("2026-11-23", "lab/tuesday");
/// assert_eq!(added.from, "lab/tuesday");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Addition {
    /// Date in UTC: `2026-11-23`.
    pub date: String,
    /// Source folder as named by the caller.
    pub from: String,
    /// True if the rows may have a different certificate than the dataset.
    pub new_certificate: bool,
}

impl Addition {
    /// Rows added on `date` from the folder called `from`.
    pub fn new(date: impl Into<String>, from: impl Into<String>) -> Addition {
        Addition {
            date: date.into(),
            from: from.into(),
            new_certificate: false,
        }
    }

    /// The same addition, for rows that may have a different certificate than the dataset.
    #[must_use]
    pub fn with_new_certificate(self, new_certificate: bool) -> Addition {
        Addition {
            new_certificate,
            ..self
        }
    }
}

impl ImportPlan {
    /// Appends the rows to the dataset at `target`. Readers see the old dataset until the new one is durable, and files that they have open remain valid.
    /// Existing frames are shared, not copied. The header records the former number of rows, the former digest, and `added`.
    ///
    /// If the map names no column for sample names, numbers continue after the greatest number among the existing names. Existing rows keep their part of each
    /// split.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] if `target` is not an imported dataset; naming the key if the map contradicts the header; naming the row if the
    /// dataset already has it. Errors of [`run`](ImportPlan::run). After an error `target` is unchanged.
    ///
    /// ```
    /// # use taceva_core::{Channel, Channels, Clock, SilentProgress, SourceUnit};
    /// # use taceva_dataset::{Dataset, RecordingFacts, SensorFacts, Source};
    /// # use taceva_import::{Addition, ColumnMap, ImportMap, ImportPlan};
    /// # let folder = tempfile::tempdir()?;
    /// # let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
    /// # let mut map = ImportMap::new("labels.csv", facts);
    /// # map.channels = Channels::new([Channel::FZ])?;
    /// # map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
    /// # let (target, jobs) = (folder.path().join("dataset"), std::num::NonZeroUsize::MIN);
    /// std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
    /// let before = ImportPlan::new(folder.path(), &map)?.run(&target, jobs, &SilentProgress)?;
    /// std::fs::write(folder.path().join("labels.csv"), "force\n2500\n")?;
    /// let plan = ImportPlan::new(folder.path(), &map)?;
    /// plan.extend(&target, &Addition::new("2026-11-23", "tuesday"), jobs, &SilentProgress)?;
    ///
    /// let dataset = Dataset::open(&target)?;
    /// assert_eq!(dataset.table().samples(), ["0", "1", "2"]);
    /// assert_eq!(dataset.header().extended[0].digest, before.digest);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn extend(
        mut self,
        target: &Path,
        added: &Addition,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, ImportError> {
        // Staged first, so that no other process replaces the dataset while it is read.
        let staged = StagedFolder::create(target, Place::OfDataset)?;
        let before = Dataset::open(target)?;
        self.check_alike(&before, None)?;
        check_certificates(&before, &self.facts, added)?;
        let mut folders = share_files(&before, &staged)?;
        let first = before.table().rows();
        for frames in &mut self.frames {
            check_reference(&before, frames)?;
        }
        let frames = copy_frames(
            &staged,
            &self.frames,
            first,
            &mut self.table,
            jobs,
            progress,
        )?;
        folders.extend(frames.folders.iter().cloned());
        let maps = write_maps(
            &self.maps,
            &staged,
            Some(&before),
            &mut self.table,
            progress,
        )?;
        folders.extend(maps);
        self.check_alike(&before, Some(&frames))?;
        let table = self.joined_table(&before);
        let signals = self.signals.as_ref();
        let signals = signals.map(|new| write_signals(&before, new, &staged, progress));
        let signals = signals.transpose()?;
        refuse_twice(&before, &table, signals.as_ref(), staged.path())?;
        let sources = self.sources(&before, added, jobs, progress)?;
        write_durable(&staged.path().join(layout::SOURCES), sources.as_bytes())?;
        let written = Written {
            frames,
            signals,
            sources: SourcesInfo::of(&sources),
        };
        let header = write_header(&staged, &before, &table, written, &self, added)?;
        // The old version is closed, so it is removed at once.
        drop(before);
        staged.put_in_place(&folders.into_iter().collect::<Vec<_>>())?;
        Ok(ImportReport {
            summary: self.summary,
            frames: header.frames.as_ref().map(|frames| frames.info),
            views: header.views,
            digest: header.digest,
            path: target.to_owned(),
        })
    }

    /// Text that lists the source files of the dataset, then those of the added folder with their digests.
    fn sources(
        &self,
        before: &Dataset,
        added: &Addition,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<String, ImportError> {
        let mut list = before.source_sums()?.unwrap_or_default();
        let from = added.from.replace(char::is_control, " ");
        list += &format!("# {} {from}\n", added.date);
        list += &list_of(&self.folder, jobs, progress)?;
        Ok(list)
    }

    /// Rejects rows whose header would contradict the header of `before`. `frames` are the frames of the rows, if any.
    fn check_alike(
        &self,
        before: &Dataset,
        frames: Option<&CopiedFrames>,
    ) -> Result<(), ImportError> {
        let header = before.header();
        let refused = |problem: String| ImportError::request(before.path(), problem);
        if !header.presses.is_empty() || header.stream.is_some() {
            return Err(refused(
                "recorded by a run or a capture, so no import can extend it: import these rows as a separate dataset, and name both when you evaluate"
                    .to_owned(),
            ));
        }
        let mut planned: Header = header.clone();
        planned.source = self.facts.source;
        planned.clock = self.facts.clock;
        planned.sensor = self.facts.sensor.clone();
        planned.footprint = self.facts.footprint;
        planned.channels = self.table.channels().clone();
        planned.attributes = self.table.attribute_names().to_vec();
        let tasks = self.table.tasks().iter();
        planned.tasks = tasks.map(|own| own.task().clone()).collect();
        let views = |names: &mut dyn Iterator<Item = &str>| {
            let mut names: Vec<&str> = names.collect();
            names.sort_unstable();
            match names.is_empty() {
                true => "one picture".to_owned(),
                false => names.join(" and "),
            }
        };
        let own = views(&mut header.views.iter().map(|view| view.name.as_str()));
        let new = views(&mut self.frames.iter().filter_map(|plan| plan.view.as_deref()));
        if !self.frames.is_empty() && own != new {
            return Err(refused(differs("frame", &own, &new)));
        }
        if self.frames.is_empty() {
            planned.frames = None;
            planned.views.clear();
        }
        for plan in &self.frames {
            let (known, info) = match &plan.view {
                None => (
                    planned.frames.as_mut(),
                    frames.and_then(|copied| copied.frames.as_ref()),
                ),
                Some(name) => {
                    let mut known = planned.views.iter_mut();
                    let known = known.find(|view| view.name == *name);
                    let mut copied = frames.iter().flat_map(|copied| &copied.views);
                    let info = copied.find(|view| view.name == *name);
                    (
                        known.map(|view| &mut view.frames),
                        info.map(|view| &view.frames),
                    )
                }
            };
            let Some(known) = known else {
                return Err(refused(differs("frames", "absent", "there")));
            };
            known.channel_order = plan.order;
            known.info = info.map_or(known.info, |info| info.info);
        }
        match (&mut planned.signals, &self.signals) {
            (Some(own), Some(plan)) => own.spec = plan.spec().clone(),
            (None, Some(_)) => return Err(refused(differs("signals", "absent", "there"))),
            (own, None) => *own = None,
        }
        if let Some(Difference { key, own, other }) = differences_of_added(header, &planned).next()
        {
            return Err(refused(differs(key, &own, &other)));
        }
        let known = header.mapping();
        if known.is_empty() && !self.mapping.is_empty() {
            return Err(refused(
                "recorded, not imported, so it has no map to compare with; import these rows as a separate dataset"
                    .to_owned(),
            ));
        }
        match known.misread(&self.mapping) {
            None => Ok(()),
            Some(Misread {
                key,
                own,
                other,
                mend,
            }) => Err(refused(format!("{}; {mend}", differs(&key, &own, &other)))),
        }
    }

    /// Rows of `before`, followed by the new rows.
    fn joined_table(&self, before: &Dataset) -> Table {
        let mut table = before.table().clone();
        let names = before.table().samples().iter();
        let numbers = names.filter_map(|name| name.parse::<u64>().ok());
        let next = numbers.max().map_or(0, |last| last + 1);
        let new = &self.table;
        for row in 0..new.rows() {
            let sample = match self.is_numbered {
                true => (next + row as u64).to_string(),
                false => new.samples()[row].clone(),
            };
            let names = RowNames {
                sample,
                point_id: new.point_id()[row].clone(),
                frame: new.frames()[row].clone(),
            };
            table.push_of(new, row, names);
        }
        table
    }
}

fn differs(key: &str, own: &str, other: &str) -> String {
    format!(
        "`{key}` is {own} in the dataset and {other} in the map, and rows are added only if both agree; import these rows as a separate \
         dataset"
    )
}

/// Removes the picture without contact from `frames`. Rejects rows whose picture without contact differs from that of the dataset.
fn check_reference(before: &Dataset, frames: &mut PlannedFrames) -> Result<(), ImportError> {
    let header = before.header();
    let known = match &frames.view {
        None => header.frames.as_ref(),
        Some(name) => {
            let mut views = header.views.iter();
            let known = views.find(|view| view.name == *name);
            known.map(|view| &view.frames)
        }
    };
    let known = known.and_then(|frames| Some(frames.reference.as_ref()?.sha256));
    let key = frames.view.as_ref();
    let key = key.map_or("frames.reference".to_owned(), |view| {
        format!("views.{view}.reference")
    });
    let new = frames.reference.take();
    let new = new.map(|reference| reference.file_bytes(frames.order));
    let new = new.transpose()?.map(|bytes| Digest::of(&bytes));
    if known == new {
        return Ok(());
    }
    let word =
        |digest: Option<Digest>| digest.map_or("unknown".to_owned(), |digest| digest.to_string());
    Err(ImportError::request(
        before.path(),
        differs(&key, &word(known), &word(new)),
    ))
}
