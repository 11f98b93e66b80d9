//! Copies rows between tables, and identifies equal rows.

use taceva_core::Channel;

use super::views::{ViewFrames, column_kind};
use super::{Cells, FrameEntry, Row, Table, TaskColumn};
use crate::digest::{Digest, PartsDigest};

/// New names of a row that is copied from another table, and the new location of its frame.
#[doc(hidden)]
pub struct RowNames {
    /// Name of the sample.
    pub sample: String,
    /// Contact point; `None` if the row has none.
    pub point_id: Option<String>,
    /// Location of the frame; `None` if the row has none.
    pub frame: Option<FrameEntry>,
}

impl Table {
    /// Adds row `row` of `other`, a table with the same channels in any order. An attribute, view or task that `other` lacks is empty in the new row.
    /// An attribute, view or task that only `other` has is ignored.
    ///
    /// # Panics
    /// Panics if `other` lacks a channel, or if the row does not exist.
    pub fn push_of(&mut self, other: &Table, row: usize, names: RowNames) {
        let truth = |channel: &Channel| {
            let position = other.channels.position(channel.name());
            other.truth[position.expect("a table of the same channels")].get(row)
        };
        let attribute = |name: &String| other.attribute(name).and_then(|cells| cells[row].clone());
        let view = |view: &ViewFrames| {
            let own = other.view(view.name());
            own.map(|own| own.row(row)).unwrap_or_default()
        };
        let label = |own: &TaskColumn| other.task(&own.task().name)?.label(row);
        let row = Row {
            sample: names.sample,
            point_id: names.point_id,
            unit_id: other.unit_id[row].clone(),
            scene: other.scene[row].clone(),
            depth_step: other.depth_step[row],
            repeat: other.repeat[row],
            phase: other.phase[row],
            limited_by: other.limited_by[row],
            zero_u_mm: other.zero_u_mm[row],
            source_table: other.source_table[row].clone(),
            source_row: other.source_row[row],
            source_frame: other.source_frame[row].clone(),
            part: other.part[row].clone(),
            t_s: other.t_s[row],
            kind: other.kind[row],
            spacing: other.spacing[row],
            intensity: other.intensity[row],
            truth: self.channels.iter().map(truth).collect(),
            attributes: self.attribute_names.iter().map(attribute).collect(),
            frame: names.frame,
            views: self.views.iter().map(view).collect(),
            tasks: self.tasks.iter().map(label).collect(),
        };
        self.push(row);
    }

    /// Digest of the content of each row, independent of names and origin: labels, time, and digest of the frame.
    pub fn row_digests(&self) -> Vec<Digest> {
        const NAMES: [&str; 6] = [
            "sample",
            "source_table",
            "source_row",
            "source_frame",
            "part",
            "frame",
        ];
        let mut digests = vec![PartsDigest::default(); self.rows()];
        for column in self.columns() {
            // Equal depth maps have different places and one digest.
            let is_place = matches!(column.cells, Cells::MapPlace(_));
            if is_place || NAMES.contains(&column_kind(column.name)) {
                continue;
            }
            for (row, digest) in digests.iter_mut().enumerate() {
                if column.cells.is_present(row) {
                    digest.part(column.name.as_bytes());
                    column.cells.digest(row, digest);
                }
            }
        }
        digests.into_iter().map(PartsDigest::finish).collect()
    }
}
