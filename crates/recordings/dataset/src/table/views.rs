//! Pictures of a table with several views, in one column per view.

use super::{Cells, FrameEntry, NamedColumn, RowFrame, Table};
use crate::digest::{Digest, PartsDigest};

/// Separator between a column name on disk and its view. No name of an attribute or channel contains this character.
const SEPARATOR: char = ':';

/// Pictures of one view, one per row.
///
/// ```
/// use taceva_core::Channels;
/// use taceva_dataset::Table;
///
/// let table = Table::new(Channels::default(), Vec::new()).with_views(["left", "right"]);
/// assert_eq!(table.views()[1].name(), "right");
/// assert!(table.views()[1].frames().is_empty());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ViewFrames {
    name: String,
    /// Column names on disk: source, intensity, frame and digest.
    columns: [String; 4],
    source_frame: Vec<Option<String>>,
    intensity: Vec<Option<f64>>,
    frames: Vec<Option<FrameEntry>>,
}

/// Name on disk of the column `column` for the view `view`.
pub fn column_of(column: &str, view: &str) -> String {
    format!("{column}{SEPARATOR}{view}")
}

/// Column name on disk without its view.
pub fn column_kind(column: &str) -> &str {
    column.split(SEPARATOR).next().unwrap_or(column)
}

impl ViewFrames {
    fn new(name: &str) -> ViewFrames {
        ViewFrames {
            name: name.to_owned(),
            columns: ["source_frame", "intensity", "frame", "frame_sha256"]
                .map(|column| column_of(column, name)),
            source_frame: Vec::new(),
            intensity: Vec::new(),
            frames: Vec::new(),
        }
    }

    /// Name of the view.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Picture of each row.
    pub fn frames(&self) -> &[Option<FrameEntry>] {
        &self.frames
    }

    /// Mean luma of each picture, in 8-bit steps, from 0 to below 256.
    pub fn intensity(&self) -> &[Option<f64>] {
        &self.intensity
    }

    /// Path of the original picture of each row, relative to the lab's folder.
    pub fn source_frame(&self) -> &[Option<String>] {
        &self.source_frame
    }

    /// Picture of a row.
    ///
    /// # Panics
    /// Panics if the row does not exist.
    pub fn row(&self, row: usize) -> RowFrame {
        RowFrame {
            source_frame: self.source_frame[row].clone(),
            intensity: self.intensity[row],
            frame: self.frames[row].clone(),
        }
    }

    pub(super) fn push(&mut self, row: RowFrame) {
        self.source_frame.push(row.source_frame);
        self.intensity.push(row.intensity);
        self.frames.push(row.frame);
    }

    pub(super) fn named_columns(&self) -> [NamedColumn<'_>; 4] {
        let [source, intensity, frame, digest] = &self.columns;
        [
            (source, Cells::Text(&self.source_frame)),
            (intensity, Cells::Measured(&self.intensity)),
            (frame, Cells::FramePath(&self.frames)),
            (digest, Cells::FrameDigest(&self.frames)),
        ]
        .map(|(name, cells)| NamedColumn { name, cells })
    }
}

impl Table {
    /// The same table, for rows with a picture in each of the views `names`. The table must be empty.
    ///
    /// # Panics
    /// Panics if the table has rows.
    #[must_use]
    pub fn with_views<'n>(mut self, names: impl IntoIterator<Item = &'n str>) -> Table {
        assert_eq!(self.rows(), 0, "no row has pictures of other views");
        self.views = names.into_iter().map(ViewFrames::new).collect();
        self
    }

    /// Views in the order of the dataset; empty if rows have at most one picture.
    pub fn views(&self) -> &[ViewFrames] {
        &self.views
    }

    /// View called `name`; `None` for an unknown name.
    pub fn view(&self, name: &str) -> Option<&ViewFrames> {
        self.views.iter().find(|view| view.name == name)
    }

    /// Sets the file and the brightness of the frame of a row in the view at index `view`.
    ///
    /// # Panics
    /// Panics if the view or the row does not exist.
    pub fn set_frame_of(&mut self, view: usize, row: usize, entry: FrameEntry, intensity: f64) {
        let view = &mut self.views[view];
        view.frames[row] = Some(entry);
        view.intensity[row] = Some(intensity);
    }

    /// The same table with the frames of the views at `positions`. For several views, an entry has the location of the first picture, a digest of all pictures,
    /// and the mean intensity weighted by `widths`.
    pub(crate) fn seen_by(&self, positions: &[usize], widths: &[u32]) -> Table {
        let mut seen = self.clone();
        let views: Vec<&ViewFrames> = positions.iter().map(|at| &self.views[*at]).collect();
        for row in 0..self.rows() {
            let rows: Vec<RowFrame> = views.iter().map(|view| view.row(row)).collect();
            let whole = beside(&rows, widths);
            seen.source_frame[row] = whole.source_frame;
            seen.intensity[row] = whole.intensity;
            seen.frames[row] = whole.frame;
        }
        seen
    }
}

/// Combines the pictures of one row, placed side by side, to one entry.
fn beside(rows: &[RowFrame], widths: &[u32]) -> RowFrame {
    if let [only] = rows {
        return only.clone();
    }
    let frames: Option<Vec<&FrameEntry>> = rows.iter().map(|row| row.frame.as_ref()).collect();
    let sources: Option<Vec<&str>> = rows.iter().map(|row| row.source_frame.as_deref()).collect();
    let lights: Option<Vec<f64>> = rows.iter().map(|row| row.intensity).collect();
    let width: f64 = widths.iter().map(|width| f64::from(*width)).sum();
    let light = |lights: Vec<f64>| {
        let parts = lights.iter().zip(widths);
        parts
            .map(|(light, own)| light * f64::from(*own))
            .sum::<f64>()
            / width
    };
    RowFrame {
        source_frame: sources.map(|sources| sources.join("+")),
        intensity: lights.map(light),
        frame: frames.and_then(|frames| {
            let first = frames.first()?;
            Some(FrameEntry {
                digest: digest_of(frames.iter().map(|entry| entry.digest)),
                ..(*first).clone()
            })
        }),
    }
}

/// Combined digest of pictures side by side.
pub(crate) fn digest_of(pictures: impl Iterator<Item = Digest>) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.frames/1 side by side");
    pictures.for_each(|picture| digest.fixed(picture.as_bytes()));
    digest.finish()
}
