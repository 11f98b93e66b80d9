//! Figures as PDF: vectors, the fonts that every reader has, one page as large as the figure.

mod text;

use std::collections::BTreeMap;
use std::fmt::Write;

use super::Figure;
use super::canvas::{Ink, Mark, Points, Stroke};
use super::palette::LIGHT;

/// A circle of four Bézier curves: how far their handles reach, as a part of the radius.
const HANDLE: f64 = 0.552_284_75;

/// `figure` as a file of PDF 1.4.
pub(super) fn write(figure: &Figure) -> Vec<u8> {
    let canvas = &figure.canvas;
    let mut content = Content {
        height: canvas.height,
        operators: String::new(),
        opacities: BTreeMap::new(),
    };
    canvas.marks.iter().for_each(|mark| content.mark(mark));
    let states = content.opacities.iter();
    let states = states.fold(String::new(), |all, (opacity, name)| {
        let share = f64::from(*opacity) / 100.0;
        all + &format!("/G{name} << /ca {share} >> ")
    });
    let font = |name: &str| {
        format!("<< /Type /Font /Subtype /Type1 /BaseFont /{name} /Encoding /WinAnsiEncoding >>")
    };
    let stream = &content.operators;
    let objects = [
        "<< /Type /Catalog /Pages 2 0 R >>".to_owned(),
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_owned(),
        format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.0} {:.0}] /Contents 4 0 R /Resources << /Font << /F0 5 0 R /F1 6 0 R /F2 7 0 R >> /ExtGState << {states}>> >> >>",
            canvas.width, canvas.height
        ),
        format!("<< /Length {} >>\nstream\n{stream}endstream", stream.len()),
        font("Helvetica"),
        font("Helvetica-Bold"),
        "<< /Type /Font /Subtype /Type1 /BaseFont /Symbol >>".to_owned(),
        format!(
            "<< /Title {} /Producer (TacEva) >>",
            text::literal(&figure.title)
        ),
    ];
    assemble(&objects)
}

/// Numbered objects with the table that says where each begins.
fn assemble(objects: &[String]) -> Vec<u8> {
    let mut file = b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n".to_vec();
    let mut table = String::new();
    for (at, object) in objects.iter().enumerate() {
        push(&mut table, format_args!("{:010} 00000 n \n", file.len()));
        file.extend(format!("{} 0 obj\n{object}\nendobj\n", at + 1).into_bytes());
    }
    let (begin, count) = (file.len(), objects.len() + 1);
    let end = format!(
        "xref\n0 {count}\n0000000000 65535 f \n{table}trailer\n<< /Size {count} /Root 1 0 R /Info {} 0 R >>\nstartxref\n{begin}\n%%EOF\n",
        objects.len()
    );
    file.extend(end.into_bytes());
    file
}

/// The operators of a page.
struct Content {
    height: f64,
    operators: String,
    /// Hundredths of opacity, each with the number of its state.
    opacities: BTreeMap<u8, usize>,
}

impl Content {
    fn mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Path { points, stroke } => self.path(points, *stroke),
            Mark::Area {
                points,
                ink,
                opacity,
            } => {
                self.begin(*ink, *opacity);
                self.outline(points);
                self.put(format_args!("h f Q\n"));
            }
            Mark::Box { place, ink, .. } => {
                let [x, y, width, height] = place;
                self.begin(*ink, 1.0);
                let bottom = self.height - y - height;
                self.put(format_args!(
                    "{x:.2} {bottom:.2} {width:.2} {height:.2} re f Q\n"
                ));
            }
            Mark::Points {
                points,
                ink,
                radius,
                opacity,
            } => self.dots(points, (*ink, *radius, *opacity)),
            Mark::Label(label) => {
                let operators = text::label(label, self.height, &colour(label.ink, "rg"));
                self.operators += &operators;
            }
        }
    }

    fn path(&mut self, points: &[[f64; 2]], stroke: Stroke) {
        let (colour, dash) = (colour(stroke.ink, "RG"), stroke.dash);
        let width = stroke.width;
        self.put(format_args!("q {colour} {width} w [{dash}] 0 d 1 J 1 j\n"));
        self.outline(points);
        self.put(format_args!("S Q\n"));
    }

    fn dots(&mut self, points: &Points, (ink, radius, opacity): (Ink, f64, f64)) {
        if opacity <= 0.0 {
            // Only there to be pointed at.
            return;
        }
        self.begin(ink, opacity);
        let reach = radius * HANDLE;
        for [x, y] in &points.at {
            let y = self.height - y;
            let (left, right, low, high) = (x - radius, x + radius, y - radius, y + radius);
            self.put(format_args!("{right:.2} {y:.2} m "));
            for [ax, ay, bx, by, to_x, to_y] in [
                [right, y + reach, x + reach, high, *x, high],
                [x - reach, high, left, y + reach, left, y],
                [left, y - reach, x - reach, low, *x, low],
                [x + reach, low, right, y - reach, right, y],
            ] {
                self.put(format_args!(
                    "{ax:.2} {ay:.2} {bx:.2} {by:.2} {to_x:.2} {to_y:.2} c "
                ));
            }
            self.put(format_args!("f\n"));
        }
        self.put(format_args!("Q\n"));
    }

    /// Keeps the state, and sets the colour and the opacity of what is filled.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "hundredths of a share"
    )]
    fn begin(&mut self, ink: Ink, opacity: f64) {
        let hundredths = (opacity.clamp(0.0, 1.0) * 100.0).round() as u8;
        let next = self.opacities.len();
        let state = *self.opacities.entry(hundredths).or_insert(next);
        let colour = colour(ink, "rg");
        self.put(format_args!("q /G{state} gs {colour} "));
    }

    fn outline(&mut self, points: &[[f64; 2]]) {
        for (at, [x, y]) in points.iter().enumerate() {
            let operator = if at == 0 { "m" } else { "l" };
            let y = self.height - y;
            self.put(format_args!("{x:.2} {y:.2} {operator} "));
        }
    }

    fn put(&mut self, words: std::fmt::Arguments<'_>) {
        push(&mut self.operators, words);
    }
}

/// A colour on white paper, for the operator that sets it.
fn colour(ink: Ink, operator: &str) -> String {
    let hex = match ink {
        Ink::Text => "#1b1f24",
        Ink::Muted => "#57606a",
        Ink::Grid => "#e4e7eb",
        Ink::Paper => "#ffffff",
        Ink::Series(position) => LIGHT[position % LIGHT.len()],
        Ink::Rgb([red, green, blue]) => {
            let [red, green, blue] = [red, green, blue].map(|part| f64::from(part) / 255.0);
            return format!("{red:.3} {green:.3} {blue:.3} {operator}");
        }
    };
    let part = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).expect("six digits");
    let [red, green, blue] = [part(1), part(3), part(5)].map(|part| f64::from(part) / 255.0);
    format!("{red:.3} {green:.3} {blue:.3} {operator}")
}

/// Writing to a text cannot fail.
fn push(out: &mut String, words: std::fmt::Arguments<'_>) {
    out.write_fmt(words)
        .expect("a text takes whatever is written to it");
}
