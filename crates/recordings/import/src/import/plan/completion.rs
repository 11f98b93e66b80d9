//! What the rows come to, once all were read.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::ImportPlan;
use super::reading::Reading;
use crate::import::frame_plan::PlannedFrames;
use crate::import::map::{FrameMap, FrameNames};
use crate::import::mapping::mapping;
use crate::import::omissions;
use crate::import::references::Settled;
use crate::import::resolve::JoinMatches;
use crate::import::source::unnamed_images;
use taceva_dataset::internal::shown;
use taceva_dataset::{DatasetError, Place};

/// How many images that no row names are listed.
const LISTED_IMAGES: usize = 20;

impl Reading<'_> {
    /// The error that nothing is left to import, and why.
    pub(super) fn no_row(&self) -> DatasetError {
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

    /// The plan of all that was read.
    pub(super) fn into_plan(mut self) -> Result<ImportPlan, DatasetError> {
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
        omissions::count(
            self.folder,
            self.map.frame.as_ref().zip(frames.as_ref()),
            self.absent_chunks,
            self.map.is_filled,
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
