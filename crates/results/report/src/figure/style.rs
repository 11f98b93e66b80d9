//! Size and lettering of figures for print.

use super::Figure;
use super::canvas::{Mark, Print};

/// Letters of most labels, in units of a canvas.
const LETTERS: f64 = 11.0;
/// Letter size if only a width is set, points.
const USUAL_PT: f64 = 8.0;
/// Points in a millimetre.
pub(super) const PT_PER_MM: f64 = 72.0 / 25.4;
/// Largest factor by which letters grow if a drawing is wider than its place.
const MOST_GROWN: f64 = 1.3;

/// Size and lettering of figures for print. Unset fields keep the form for a screen.
///
/// ```
/// use taceva_report::{FigureStyle, figures_for};
/// let style = FigureStyle { width_mm: Some(88.0), letters_pt: Some(7.0), font: Some("Times New Roman".to_owned()) };
/// assert!(figures_for(&[], &style).is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FigureStyle {
    /// The width of each figure, mm.
    pub width_mm: Option<f64>,
    /// Size of most letters, points (1/72 in); 8 if only a width is set. Larger in drawings narrower than the page, smaller in drawings more than 1.3
    /// times too wide.
    pub letters_pt: Option<f64>,
    /// Preferred font family of SVG. PDF embeds Arimo, which has the widths of Arial and Helvetica.
    pub font: Option<String>,
}

impl FigureStyle {
    /// Canvas width at which letters have the requested size in print; `None` if no width is set.
    pub(crate) fn room(&self) -> Option<f64> {
        let letters = self.letters_pt.unwrap_or(USUAL_PT);
        self.width_mm
            .map(|width| width * PT_PER_MM * LETTERS / letters)
    }

    /// Applies this style to `figure`. Letters grow by at most [`MOST_GROWN`] to reach the requested size.
    pub(crate) fn apply(&self, mut figure: Figure) -> Figure {
        let grown = match self.room() {
            Some(room) => (figure.canvas.width / room).clamp(1.0, MOST_GROWN),
            // Only a letter size is set: a unit of the canvas is a point.
            None => self.letters_pt.map_or(1.0, |letters| letters / LETTERS),
        };
        for mark in &mut figure.canvas.marks {
            if let Mark::Label(label) = mark {
                label.size = (label.size * grown * 10.0).round() / 10.0;
            }
        }
        figure.canvas.print = Print {
            width_pt: self.width_mm.map(|width| width * PT_PER_MM),
            font: self.font.clone(),
        };
        figure
    }
}
