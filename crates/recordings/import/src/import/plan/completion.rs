//! Completes the plan after all rows are read.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::ImportPlan;
use super::reading::Reading;
use crate::error::ImportError;
use crate::import::frame_plan::{FrameSource, PlannedFrames};
use crate::import::map::{FrameMap, FrameNames};
use crate::import::mapping::mapping;
use crate::import::omissions;
use crate::import::resolve::JoinMatches;
use crate::import::source::unnamed_images;
use crate::import::summary::FrameSummary;
use crate::import::warning::ImportWarning;
use taceva_dataset::internal::shown;

/// Maximum number of listed images that no row names.
const LISTED_IMAGES: usize = 20;

impl Reading<'_> {
    /// Error for an import that keeps no row, with the reasons.
    pub(super) fn no_row(&self) -> ImportError {
        let summary = &self.summary;
        let dropped = summary.dropped.iter();
        let dropped: Vec<String> = dropped
            .map(|(reason, count)| format!("{} {count}", shown(reason)))
            .collect();
        let apart = self.joins.iter().filter_map(JoinMatches::apart);
        let apart: String = apart.map(|spans| format!("; {spans}")).collect();
        let problem = match summary.rows_read {
            0 => "no row below the header: there is nothing to import".to_owned(),
            read => format!(
                "all {read} rows are left out ({}): there is nothing to import{apart}",
                dropped.join(", ")
            ),
        };
        ImportError::table(
            summary
                .tables
                .first()
                .map_or(self.folder.path(), PathBuf::as_path),
            problem,
        )
    }

    /// Completes the plan after all tables are read.
    pub(super) fn into_plan(mut self) -> Result<ImportPlan, ImportError> {
        if let Some(unequal) = self.unequal.take() {
            return Err(unequal);
        }
        let frames = self.planned_frames()?;
        self.warn_of_pictures();
        self.describe_channels();
        self.describe_tasks();
        self.warn_of_unused_names();
        self.summary.joins = self.joins.iter().map(JoinMatches::summary).collect();
        let warnings = self.joins.iter().flat_map(JoinMatches::warnings);
        self.summary.warnings.extend(warnings);
        if let Some(signals) = &self.signals {
            signals.count_absent_chunks(self.folder, &mut self.absent_chunks)?;
        }
        omissions::count(
            self.folder,
            &self.map.frames,
            &frames,
            self.absent_chunks,
            self.map.is_filled,
            &mut self.summary,
        )?;
        let rows_read = self.summary.rows_read;
        for maps in &self.maps {
            maps.check_rows(rows_read)?;
        }
        let signals = self.signals.take();
        let signals = signals.map(|signals| signals.into_plan(rows_read));
        self.summary.signals = self.map.signals.as_ref().map(|map| map.spec.info);
        Ok(ImportPlan {
            signals: signals.transpose()?,
            maps: self.maps,
            summary: self.summary,
            facts: self.map.facts.clone(),
            is_numbered: self.map.ids.sample.is_none(),
            mapping: mapping(self.map, self.folder)?,
            table: self.table,
            frames,
            folder: self.folder.clone(),
        })
    }

    /// Sources of the frames of each view.
    fn planned_frames(&mut self) -> Result<Vec<PlannedFrames>, ImportError> {
        let mut planned = Vec::new();
        for view in std::mem::take(&mut self.views) {
            let map = view.map;
            let mut different = 0;
            let reference = match (&map.reference, map.reference_frame) {
                (Some(path), _) => {
                    let path = self.folder.file(self.folder.path(), path)?;
                    Some(FrameSource::File(path))
                }
                (None, Some(index)) => Some(view.frame_within(index)?),
                (None, None) => {
                    let named = view.references.paths(self.folder);
                    self.named.extend(named);
                    let name = map.view.as_deref();
                    let settled = view.references.settle(self.folder, name, &mut self.table)?;
                    different = settled.different;
                    settled.reference.map(FrameSource::File)
                }
            };
            if let Some(FrameSource::File(path)) = &reference {
                self.named.insert(path.clone());
            }
            self.summary.frames.push(FrameSummary {
                view: map.view.clone(),
                channel_order: map.channel_order,
                reference: reference.as_ref().map(FrameSource::named),
                references: different as u64,
            });
            planned.push(PlannedFrames {
                view: map.view.clone(),
                order: map.channel_order,
                reference,
                of_rows: view.frames,
            });
        }
        self.find_unnamed();
        Ok(planned)
    }

    /// Warns if the folder has several pictures, and the map names neither pictures nor signals.
    fn warn_of_pictures(&mut self) {
        if !self.map.frames.is_empty() || self.map.signals.is_some() {
            return;
        }
        // Pictures that are depth maps are named.
        let images = unnamed_images(self.folder.path(), &self.named).images;
        if let (Some(first), true) = (images.iter().min(), images.len() > 1) {
            self.summary.warnings.insert(ImportWarning::NoPictures {
                pictures: images.len() as u64,
                first: self.folder.inside(first, ""),
            });
        }
    }

    /// Searches for images that no row names.
    fn find_unnamed(&mut self) {
        let mut frames = self.map.frames.iter();
        let are_files = |frame: &FrameMap| {
            matches!(frame.names, FrameNames::Column(_) | FrameNames::Pattern(_))
        };
        if !frames.any(are_files) {
            return;
        }
        let mut unnamed = BTreeSet::new();
        for base in &self.bases {
            let found = unnamed_images(base, &self.named);
            self.summary.has_more_files |= found.has_more;
            unnamed.extend(found.images);
        }
        self.summary.unnamed_images = unnamed.len() as u64;
        self.summary.first_unnamed_images = unnamed.into_iter().take(LISTED_IMAGES).collect();
    }
}
