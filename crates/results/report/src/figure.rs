//! A figure: marks on a canvas, with a title, what it shows in words, and what a reader must know.

mod canvas;
mod grid;
mod names;
mod palette;
mod panel;
mod pdf;
mod scale;
mod svg;
mod words;

use std::collections::BTreeSet;

pub(crate) use canvas::{Anchor, Canvas, Ink, Label, Points, Stroke};
pub(crate) use grid::Grid;
pub(crate) use names::beside;
pub use palette::{DARK, LIGHT, SERIES};
pub(crate) use palette::{diverging, sequential};
pub(crate) use panel::{Area, Axes, Panel};
pub(crate) use scale::{Scale, extent};
pub use svg::STYLE;
pub(crate) use words::{axis_label, directed, middle_cut, short};

/// A finished figure.
#[derive(Clone, Debug)]
pub struct Figure {
    /// A name for files and links: `sensitivity`.
    pub id: String,
    /// What it is.
    pub title: String,
    /// What a reader must know: what is drawn, of how many samples, what was left out.
    pub caption: String,
    /// What the figure shows, in words, for screen readers.
    pub description: String,
    pub(crate) canvas: Canvas,
}

impl Figure {
    /// As SVG for a page whose style holds [`STYLE`].
    pub fn inline(&self) -> String {
        svg::write(self, false)
    }

    /// As SVG that stands alone, on white.
    pub fn svg(&self) -> String {
        svg::write(self, true)
    }

    /// As PDF of one page: vectors, on white, with the glyphs that it uses embedded.
    ///
    /// A letter that no font built in has is drawn as a box with its code point; [`Figure::letters_without_glyph`] names them.
    pub fn pdf(&self) -> Vec<u8> {
        pdf::write(self)
    }

    /// The letters of its labels that no font built in has, in order of their code points.
    pub fn letters_without_glyph(&self) -> BTreeSet<char> {
        pdf::letters_without_glyph(self)
    }

    /// How many marks it consists of: lines, areas, boxes, groups of points and labels.
    pub fn marks(&self) -> usize {
        self.canvas.marks.len()
    }
}
