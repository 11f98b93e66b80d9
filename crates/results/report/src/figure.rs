//! Figure: marks on a canvas, with title, caption and description.

mod canvas;
mod grid;
mod names;
mod palette;
mod panel;
mod pdf;
mod scale;
mod style;
mod svg;
mod words;

use std::collections::BTreeSet;

pub(crate) use canvas::{Anchor, Canvas, Ink, Label, Points, Stroke, width_of};
pub(crate) use grid::Grid;
pub(crate) use names::beside;
pub use palette::{DARK, LIGHT, SERIES};
pub(crate) use palette::{diverging, sequential};
pub(crate) use panel::{Area, Axes, Panel};
pub(crate) use scale::{Scale, extent};
pub use style::FigureStyle;
pub use svg::STYLE;
pub(crate) use words::{axis_label, directed, middle_cut, short};

/// Figure with marks on a canvas, title, caption and description.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name for files and links: `sensitivity`.
    pub id: String,
    /// Title above the drawing.
    pub title: String,
    /// Caption: drawn quantity, number of samples, omissions.
    pub caption: String,
    /// Text that describes the drawing to screen readers.
    pub description: String,
    pub(crate) canvas: Canvas,
}

impl Figure {
    /// SVG for a page whose style contains [`STYLE`].
    pub fn inline(&self) -> String {
        svg::write(self, false)
    }

    /// Standalone SVG on white.
    pub fn svg(&self) -> String {
        svg::write(self, true)
    }

    /// PDF of one page with vectors on white and embedded glyphs.
    ///
    /// A letter without a glyph in the built-in fonts becomes a box with its code point; [`Figure::letters_without_glyph`] lists these
    /// letters.
    pub fn pdf(&self) -> Vec<u8> {
        pdf::write(self)
    }

    /// Letters in the labels of the figure without a glyph in the built-in fonts, ordered by code point.
    pub fn letters_without_glyph(&self) -> BTreeSet<char> {
        pdf::letters_without_glyph(self)
    }

    /// True if the figure shows a value or a remark. Axes and names do not count.
    pub(crate) fn has_values(&self) -> bool {
        let is_coloured = |ink: &Ink| matches!(ink, Ink::Series(_) | Ink::Rgb(_));
        let mut marks = self.canvas.marks.iter();
        self.canvas.is_remarked
            || marks.any(|mark| match mark {
                canvas::Mark::Path { stroke, .. } => is_coloured(&stroke.ink),
                canvas::Mark::Area { ink, .. } | canvas::Mark::Points { ink, .. } => {
                    is_coloured(ink)
                }
                canvas::Mark::Box { ink, .. } => is_coloured(ink),
                canvas::Mark::Label(_) => false,
            })
    }

    /// Number of marks: lines, areas, boxes, groups of points and labels.
    pub fn marks(&self) -> usize {
        self.canvas.marks.len()
    }
}
