//! Size and text of figures for print.

use super::Figure;
use super::canvas::{Mark, Print};

/// Size of most letters, in canvas units.
const LETTERS: f64 = 11.0;
/// Font size in points if only a width is set.
const USUAL_PT: f64 = 8.0;
/// Points per millimetre.
pub(super) const PT_PER_MM: f64 = 72.0 / 25.4;
/// Greatest factor by which letters grow in a drawing that is wider than its space.
const MOST_GROWN: f64 = 1.3;

/// Size and text of figures for print. Fields that are `None` keep the screen layout.
///
/// ```
/// use taceva_report::{FigureStyle, figures_for};
/// let style = FigureStyle { width_mm: Some(88.0), letters_pt: Some(7.0), font: Some("Times New Roman".to_owned()) };
/// assert!(figures_for(&[], &style).is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FigureStyle {
    /// Width of each figure, in mm.
    pub width_mm: Option<f64>,
    /// Size of most letters, in points (1/72 in); 8 if only a width is set. If a drawing is enlarged to `width_mm`, its letters become larger. If it
    /// is reduced by more than a factor of 1.3, they become smaller.
    pub letters_pt: Option<f64>,
    /// Preferred font family of SVG. PDF embeds Arimo, which has the widths of Arial and Helvetica.
    pub font: Option<String>,
}

impl FigureStyle {
    /// Canvas width at which printed letters have the requested size; `None` if the style sets no width.
    pub(crate) fn room(&self) -> Option<f64> {
        let letters = self.letters_pt.unwrap_or(USUAL_PT);
        self.width_mm
            .map(|width| width * PT_PER_MM * LETTERS / letters)
    }

    /// Applies this style to `figure`. Letters grow by at most [`MOST_GROWN`] to reach the requested size.
    pub(crate) fn apply(&self, mut figure: Figure) -> Figure {
        let grown = match self.room() {
            Some(room) => (figure.canvas.width / room).clamp(1.0, MOST_GROWN),
            // If only a font size is set, a canvas unit is a point.
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
