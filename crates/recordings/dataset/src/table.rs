//! Labels of a recording in memory, column by column.

mod cells;
mod fields;
mod row;
mod row_union;
mod tasks;
mod views;

use taceva_core::{
    Channels, Column, Field, FieldSet, Frame, GratingKind, Limit, Nanometre, Phase, Readings,
    Sample, Stamp,
};

use crate::digest::{Digest, PartsDigest};
use crate::task::is_task_column;

pub use cells::{Cells, NamedColumn, RESERVED, is_attribute_name};
pub use row::{FrameEntry, Row, RowFrame};
pub use row_union::RowNames;
pub use tasks::TaskColumn;
pub(crate) use views::digest_of;
pub use views::{ViewFrames, column_kind, column_of};

/// All labels of a recording.
///
/// ```
/// use taceva_core::{Channel, Channels};
/// use taceva_dataset::{Row, Table};
///
/// let mut table = Table::new(Channels::new([Channel::FZ])?, vec!["video".into()]);
/// let mut row = Row::new("press 1");
/// row.truth = vec![Some(0.5)];
/// row.attributes = vec![None];
/// table.push(row);
/// assert_eq!((table.rows(), table.truth(0).get(0)), (1, Some(0.5)));
/// assert_eq!(table.attribute("video"), Some(&[None][..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    channels: Channels,
    truth: Vec<Column>,
    sample: Vec<String>,
    point_id: Vec<Option<String>>,
    unit_id: Vec<Option<String>>,
    scene: Vec<Option<String>>,
    depth_step: Vec<Option<u32>>,
    repeat: Vec<Option<u32>>,
    phase: Vec<Option<Phase>>,
    limited_by: Vec<Option<Limit>>,
    zero_u_mm: Vec<Option<f64>>,
    source_table: Vec<Option<String>>,
    source_row: Vec<Option<u32>>,
    source_frame: Vec<Option<String>>,
    part: Vec<Option<String>>,
    t_s: Vec<Option<f64>>,
    kind: Vec<Option<GratingKind>>,
    spacing: Vec<Option<Nanometre>>,
    intensity: Vec<Option<f64>>,
    attribute_names: Vec<String>,
    attributes: Vec<Vec<Option<String>>>,
    frames: Vec<Option<FrameEntry>>,
    /// Pictures of each view, if rows have several pictures.
    views: Vec<ViewFrames>,
    /// Labels of each task.
    tasks: Vec<TaskColumn>,
}

impl Table {
    /// Reserved column names on disk, in order, without channels and attributes.
    ///
    /// ```
    /// use taceva_dataset::Table;
    /// assert!(Table::NAMES.contains(&"point_id") && !Table::NAMES.contains(&"Fz"));
    /// ```
    pub const NAMES: [&'static str; 19] = RESERVED;

    /// Table without rows.
    pub fn new(channels: Channels, attribute_names: Vec<String>) -> Table {
        Table {
            truth: vec![Column::default(); channels.len()],
            attributes: vec![Vec::new(); attribute_names.len()],
            channels,
            attribute_names,
            ..Table::default()
        }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// Panics if the row lacks a value for a channel, a text for an attribute or a picture for a view, or has too many. Panics also if it does
    /// not have one label of the right kind for each task.
    pub fn push(&mut self, row: Row) {
        assert_eq!(row.truth.len(), self.truth.len(), "one value per channel");
        assert_eq!(
            row.attributes.len(),
            self.attributes.len(),
            "one text per attribute"
        );
        assert_eq!(row.views.len(), self.views.len(), "one picture per view");
        assert_eq!(row.tasks.len(), self.tasks.len(), "one label per task");
        self.sample.push(row.sample);
        self.point_id.push(row.point_id);
        self.unit_id.push(row.unit_id);
        self.scene.push(row.scene);
        self.depth_step.push(row.depth_step);
        self.repeat.push(row.repeat);
        self.phase.push(row.phase);
        self.limited_by.push(row.limited_by);
        self.zero_u_mm.push(row.zero_u_mm);
        self.source_table.push(row.source_table);
        self.source_row.push(row.source_row);
        self.source_frame.push(row.source_frame);
        self.part.push(row.part);
        self.t_s.push(row.t_s);
        self.kind.push(row.kind);
        self.spacing.push(row.spacing);
        self.intensity.push(row.intensity);
        self.frames.push(row.frame);
        for (column, value) in self.truth.iter_mut().zip(row.truth) {
            column.push(value);
        }
        for (column, text) in self.attributes.iter_mut().zip(row.attributes) {
            column.push(text);
        }
        for (view, frame) in self.views.iter_mut().zip(row.views) {
            view.push(frame);
        }
        for (task, label) in self.tasks.iter_mut().zip(row.tasks) {
            task.push(label);
        }
    }

    /// Adds an attribute column.
    ///
    /// # Panics
    /// Panics if the number of texts differs from the number of rows.
    pub fn push_attribute(&mut self, name: String, texts: Vec<Option<String>>) {
        assert_eq!(texts.len(), self.rows(), "one text per row");
        self.attribute_names.push(name);
        self.attributes.push(texts);
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.sample.len()
    }

    /// Channels of the labels.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// Values of the channel at `position`, measured by the reference instruments.
    pub fn truth(&self, position: usize) -> &Column {
        &self.truth[position]
    }

    /// Name of each row.
    pub fn samples(&self) -> &[String] {
        &self.sample
    }

    /// Contact point of each row.
    pub fn point_id(&self) -> &[Option<String>] {
        &self.point_id
    }

    /// Sensor unit of each row.
    pub fn unit_id(&self) -> &[Option<String>] {
        &self.unit_id
    }

    /// Light scene of each row.
    pub fn scene(&self) -> &[Option<String>] {
        &self.scene
    }

    /// Depth step of each row within its contact point.
    pub fn depth_step(&self) -> &[Option<u32>] {
        &self.depth_step
    }

    /// Index of the repeated press of each row at its contact point.
    pub fn repeat(&self) -> &[Option<u32>] {
        &self.repeat
    }

    /// Phase of each row: load or unload.
    pub fn phase(&self) -> &[Option<Phase>] {
        &self.phase
    }

    /// For each row, the gel limit that stopped the tip before its target.
    pub fn limited_by(&self) -> &[Option<Limit>] {
        &self.limited_by
    }

    /// Standard uncertainty of the height from which the depth of each row is measured, mm.
    pub fn zero_u_mm(&self) -> &[Option<f64>] {
        &self.zero_u_mm
    }

    /// Imported table of each row, relative to the lab's folder.
    pub fn source_table(&self) -> &[Option<String>] {
        &self.source_table
    }

    /// Row number of each sample in `source_table`, from 0.
    pub fn source_row(&self) -> &[Option<u32>] {
        &self.source_row
    }

    /// Original picture of each sample in the lab's folder, such as `clip.mp4#12`.
    pub fn source_frame(&self) -> &[Option<String>] {
        &self.source_frame
    }

    /// Part of each row in a split that the recording declares.
    pub fn part(&self) -> &[Option<String>] {
        &self.part
    }

    /// Time of each row on the clock of the recording, s.
    pub fn t_s(&self) -> &[Option<f64>] {
        &self.t_s
    }

    /// Relief of the grating touched in each row.
    pub fn kind(&self) -> &[Option<GratingKind>] {
        &self.kind
    }

    /// Spacing of the grating touched in each row.
    pub fn spacing(&self) -> &[Option<Nanometre>] {
        &self.spacing
    }

    /// Mean luma of the full-size frame of each row, in 8-bit steps, from 0 to below 256.
    pub fn intensity(&self) -> &[Option<f64>] {
        &self.intensity
    }

    /// Frame of each row.
    pub fn frames(&self) -> &[Option<FrameEntry>] {
        &self.frames
    }

    /// Names of the text columns kept for splits.
    pub fn attribute_names(&self) -> &[String] {
        &self.attribute_names
    }

    /// Text column called `name`; `None` for an unknown name.
    pub fn attribute(&self, name: &str) -> Option<&[Option<String>]> {
        let position = self
            .attribute_names
            .iter()
            .position(|known| known == name)?;
        Some(&self.attributes[position])
    }

    /// Column called `name` as text, for any type: id, attribute, count, phase or number. `None` for an unknown name.
    pub fn as_text(&self, name: &str) -> Option<Vec<Option<String>>> {
        let named = self
            .columns()
            .into_iter()
            .find(|column| column.name == name)?;
        Some((0..self.rows()).map(|row| named.cells.text(row)).collect())
    }

    /// Sample of a row, with the fields in `fields` and the given frame.
    pub fn sample(&self, row: usize, fields: FieldSet, frame: Option<Frame>) -> Sample {
        let wanted = |field| fields.contains(field);
        let text = |field, column: &[Option<String>]| {
            if wanted(field) {
                column[row].clone()
            } else {
                None
            }
        };
        let truth = if wanted(Field::Truth) {
            Readings::new(self.truth.iter().map(|column| column.get(row)).collect())
        } else {
            Readings::default()
        };
        let stamp = self.t_s[row].filter(|_| wanted(Field::Stamp));
        let entry = self.frames[row].as_ref();
        let entry = entry.filter(|_| wanted(Field::FrameDigest));
        let mut sample = Sample::new(self.sample[row].as_str());
        sample.unit_id = text(Field::UnitId, &self.unit_id);
        sample.scene_id = text(Field::Scene, &self.scene);
        sample.point_id = text(Field::Point, &self.point_id);
        sample.depth_step = self.depth_step[row].filter(|_| wanted(Field::DepthStep));
        sample.repeat = self.repeat[row].filter(|_| wanted(Field::Repeat));
        sample.phase = self.phase[row].filter(|_| wanted(Field::Phase));
        sample.limited_by = self.limited_by[row];
        sample.zero_u_mm = self.zero_u_mm[row];
        sample.stamp = stamp.map(|valid_s| Stamp {
            valid_s,
            received_s: None,
        });
        sample.kind = self.kind[row].filter(|_| wanted(Field::Kind));
        sample.spacing = self.spacing[row].filter(|_| wanted(Field::Spacing));
        sample.intensity = self.intensity[row].filter(|_| wanted(Field::Intensity));
        sample.frame_digest = entry.map(|entry| entry.digest.to_string());
        sample.frame = frame;
        sample.truth = truth;
        sample
    }

    /// Digest of the table content without tasks, independent of storage and of the location of frames.
    pub fn digest(&self) -> Digest {
        let mut digest = PartsDigest::default();
        digest.part(b"taceva.table/1");
        digest.fixed(&(self.rows() as u64).to_le_bytes());
        for channel in &self.channels {
            digest.part(channel.name().as_bytes());
            digest.part(channel.unit().symbol().as_bytes());
        }
        for column in self.columns() {
            if views::column_kind(column.name) == "frame" || is_task_column(column.name) {
                continue;
            }
            digest.part(column.name.as_bytes());
            for row in 0..self.rows() {
                column.cells.digest(row, &mut digest);
            }
        }
        digest.finish()
    }

    /// Sets the file and the brightness of the frame of a row.
    pub fn set_frame(&mut self, row: usize, entry: FrameEntry, intensity: f64) {
        self.frames[row] = Some(entry);
        self.intensity[row] = Some(intensity);
    }

    /// All columns with at least one value, in the order for digests, storage and export.
    pub fn columns(&self) -> Vec<NamedColumn<'_>> {
        let named = |name, cells| NamedColumn { name, cells };
        let mut columns = vec![
            named("sample", Cells::Name(&self.sample)),
            named("point_id", Cells::Text(&self.point_id)),
            named("unit_id", Cells::Text(&self.unit_id)),
            named("scene", Cells::Text(&self.scene)),
            named("depth_step", Cells::Count(&self.depth_step)),
            named("repeat", Cells::Count(&self.repeat)),
            named("phase", Cells::Phase(&self.phase)),
            named("limited_by", Cells::Limit(&self.limited_by)),
            named("zero_u_mm", Cells::Measured(&self.zero_u_mm)),
            named("source_table", Cells::Text(&self.source_table)),
            named("source_row", Cells::Count(&self.source_row)),
            named("source_frame", Cells::Text(&self.source_frame)),
            named("part", Cells::Text(&self.part)),
            named("t_s", Cells::Measured(&self.t_s)),
            named("kind", Cells::Kind(&self.kind)),
            named("spacing_mm", Cells::Spacing(&self.spacing)),
            named("intensity", Cells::Measured(&self.intensity)),
        ];
        columns.extend(
            self.attribute_names
                .iter()
                .zip(&self.attributes)
                .map(|(name, cells)| named(name, Cells::Text(cells))),
        );
        columns.extend(self.tasks.iter().flat_map(TaskColumn::named_columns));
        columns.push(named("frame", Cells::FramePath(&self.frames)));
        columns.push(named("frame_sha256", Cells::FrameDigest(&self.frames)));
        columns.extend(self.views.iter().flat_map(ViewFrames::named_columns));
        columns.retain(|column| (0..self.rows()).any(|row| column.cells.is_present(row)));
        columns.extend(
            self.channels
                .iter()
                .zip(&self.truth)
                .map(|(channel, cells)| named(channel.name(), Cells::Number(cells))),
        );
        columns
    }
}

#[cfg(test)]
mod tests;
