//! Draws marks as page operators of PDF.

use std::collections::BTreeSet;

use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Name};
use taceva_core::single;

use super::face::Face;
use super::text::{self, Used};
use crate::figure::canvas::{Ink, Mark, Points, Stroke};
use crate::figure::palette::LIGHT;

/// Length of the Bézier handles for a circle of four curves, as a share of the radius.
const HANDLE: f64 = 0.552_284_75;

/// Draws marks in sequence.
pub(super) struct Painter {
    height: f64,
    content: Content,
    opacities: BTreeSet<u8>,
    fonts: [Used; 3],
}

/// Drawn content and its resources.
pub(super) struct Drawn {
    pub(super) operators: Vec<u8>,
    /// Used opacities in percent; the page needs a graphics state for each.
    pub(super) opacities: BTreeSet<u8>,
    /// Fonts with at least one used glyph.
    pub(super) fonts: Vec<Used>,
}

impl Painter {
    /// Creates an empty page of `height` canvas units, each `scale` points long.
    pub(super) fn new(height: f64, scale: f64) -> Painter {
        let mut content = Content::new();
        if (scale - 1.0).abs() > 1e-9 {
            let scale = factor(scale);
            content.transform([scale, 0.0, 0.0, scale, 0.0, 0.0]);
        }
        Painter {
            height,
            content,
            opacities: BTreeSet::new(),
            fonts: Face::ALL.map(Used::none_of),
        }
    }

    /// Returns the drawn content.
    pub(super) fn finish(self) -> Drawn {
        let used = self.fonts.into_iter();
        Drawn {
            operators: self.content.finish().into_vec(),
            opacities: self.opacities,
            fonts: used.filter(|used| !used.letters.is_empty()).collect(),
        }
    }

    /// Draws `mark` above the previous marks.
    pub(super) fn mark(&mut self, mark: &Mark) {
        self.content.save_state();
        match mark {
            Mark::Path { points, stroke } => self.path(points, *stroke),
            Mark::Area {
                points,
                ink,
                opacity,
            } => {
                self.fill_with(*ink, *opacity);
                self.outline(points);
                self.content.close_path().fill_nonzero();
            }
            Mark::Box { place, ink, .. } => {
                self.fill_with(*ink, 1.0);
                let [x, y, width, height] = *place;
                let [left, low] = self.at([x, y + height]);
                let content = &mut self.content;
                content.rect(left, low, number(width), number(height));
                content.fill_nonzero();
            }
            // Invisible hover targets are skipped.
            Mark::Points { opacity, .. } if *opacity <= 0.0 => {}
            Mark::Points {
                points,
                ink,
                radius,
                opacity,
            } => {
                self.fill_with(*ink, *opacity);
                self.dots(points, *radius);
            }
            Mark::Label(label) => {
                let [red, green, blue] = colour(label.ink);
                self.content.set_fill_rgb(red, green, blue);
                self.content.set_stroke_rgb(red, green, blue);
                let at = [label.at[0], self.height - label.at[1]];
                text::draw(label, at, &mut self.fonts, &mut self.content);
            }
        }
        self.content.restore_state();
    }

    fn path(&mut self, points: &[[f64; 2]], stroke: Stroke) {
        let [red, green, blue] = colour(stroke.ink);
        let dashes = stroke.dash.split_whitespace();
        let dashes = dashes.filter_map(|dash| dash.parse::<f32>().ok());
        let content = &mut self.content;
        content.set_stroke_rgb(red, green, blue);
        content.set_line_width(number(stroke.width));
        content.set_dash_pattern(dashes, 0.0);
        content.set_line_cap(LineCapStyle::RoundCap);
        content.set_line_join(LineJoinStyle::RoundJoin);
        self.outline(points);
        self.content.stroke();
    }

    fn dots(&mut self, points: &Points, radius: f64) {
        let reach = radius * HANDLE;
        for [x, y] in &points.at {
            let (left, right, high, low) = (x - radius, x + radius, y - radius, y + radius);
            let [to_x, to_y] = self.at([right, *y]);
            self.content.move_to(to_x, to_y);
            for curve in [
                [[right, y - reach], [x + reach, high], [*x, high]],
                [[x - reach, high], [left, y - reach], [left, *y]],
                [[left, y + reach], [x - reach, low], [*x, low]],
                [[x + reach, low], [right, y + reach], [right, *y]],
            ] {
                let [[ax, ay], [bx, by], [to_x, to_y]] = curve.map(|place| self.at(place));
                self.content.cubic_to(ax, ay, bx, by, to_x, to_y);
            }
            self.content.fill_nonzero();
        }
    }

    /// Sets the fill colour and the opacity of the following marks.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "hundredths of a share"
    )]
    fn fill_with(&mut self, ink: Ink, opacity: f64) {
        let hundredths = (opacity.clamp(0.0, 1.0) * 100.0).round() as u8;
        self.opacities.insert(hundredths);
        let [red, green, blue] = colour(ink);
        let state = state_name(hundredths);
        self.content.set_parameters(Name(state.as_bytes()));
        self.content.set_fill_rgb(red, green, blue);
    }

    fn outline(&mut self, points: &[[f64; 2]]) {
        for (at, point) in points.iter().enumerate() {
            let [x, y] = self.at(*point);
            if at == 0 {
                self.content.move_to(x, y);
            } else {
                self.content.line_to(x, y);
            }
        }
    }

    /// Position on the page, whose y axis points upwards. The y axis of a canvas points downwards.
    fn at(&self, [x, y]: [f64; 2]) -> [f32; 2] {
        [number(x), number(self.height - y)]
    }
}

/// Name of the graphics state for an opacity of `hundredths` percent.
pub(super) fn state_name(hundredths: u8) -> String {
    format!("G{hundredths}")
}

/// Scale factor rounded to a millionth, for the PDF file.
fn factor(value: f64) -> f32 {
    single((value * 1e6).round() / 1e6)
}

/// Coordinate or length rounded to a hundredth, for the PDF file.
pub(super) fn number(value: f64) -> f32 {
    single((value * 100.0).round() / 100.0)
}

/// RGB colour of an ink on white paper, each component 0 to 1.
fn colour(ink: Ink) -> [f32; 3] {
    let hex = match ink {
        Ink::Text => "#1b1f24",
        Ink::Muted => "#57606a",
        Ink::Grid => "#e4e7eb",
        Ink::Paper => "#ffffff",
        Ink::Series(position) => LIGHT[position % LIGHT.len()],
        Ink::Rgb(parts) => return parts.map(share),
    };
    let part = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).expect("six digits");
    [part(1), part(3), part(5)].map(share)
}

/// Component of a colour as a share of 255, rounded to a thousandth.
fn share(part: u8) -> f32 {
    (f32::from(part) / 255.0 * 1000.0).round() / 1000.0
}
