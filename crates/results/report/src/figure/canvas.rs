//! Canvas of a figure: marks in drawing order, each in one ink.

/// Colour role. A page assigns a light-mode and a dark-mode colour to each role.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Ink {
    /// Primary text.
    Text,
    /// Secondary text.
    Muted,
    /// Grid lines.
    Grid,
    /// Background of the page.
    Paper,
    /// One of several compared series.
    Series(usize),
    /// Fixed colour of a colour scale.
    Rgb([u8; 3]),
}

/// Line style.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    pub(crate) ink: Ink,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps; empty for a solid line.
    pub(crate) dash: &'static str,
}

impl Stroke {
    /// Thin solid line.
    pub(crate) const fn thin(ink: Ink) -> Stroke {
        Stroke {
            ink,
            width: 1.0,
            dash: "",
        }
    }

    /// Line of the series at `position`, with its own colour and dashes.
    pub(crate) fn series(position: usize) -> Stroke {
        const DASHES: [&str; 4] = ["", "7 3", "2 2.5", "9 3 2 3"];
        Stroke {
            ink: Ink::Series(position),
            width: 1.8,
            dash: DASHES[position % DASHES.len()],
        }
    }
}

/// Alignment of a text at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Text at a position.
#[derive(Clone, Debug)]
pub(crate) struct Label {
    pub(crate) at: [f64; 2],
    pub(crate) text: String,
    pub(crate) anchor: Anchor,
    pub(crate) ink: Ink,
    pub(crate) size: f64,
    pub(crate) bold: bool,
    /// True for text that runs upwards.
    pub(crate) upwards: bool,
}

impl Label {
    /// Creates a text of the default size.
    pub(crate) fn new(at: [f64; 2], text: impl Into<String>, anchor: Anchor) -> Label {
        Label {
            at,
            text: text.into(),
            anchor,
            ink: Ink::Muted,
            size: 11.0,
            bold: false,
            upwards: false,
        }
    }

    pub(crate) fn heading(self) -> Label {
        Label {
            ink: Ink::Text,
            size: 12.0,
            bold: true,
            ..self
        }
    }
}

/// Positions of dots, with their tooltips.
#[derive(Clone, Debug, Default)]
pub(crate) struct Points {
    pub(crate) at: Vec<[f64; 2]>,
    /// Tooltips of the dots: empty, or one tooltip for each dot.
    pub(crate) words: Vec<String>,
}

/// Drawing element of a canvas.
#[derive(Clone, Debug)]
pub(crate) enum Mark {
    Path {
        points: Vec<[f64; 2]>,
        stroke: Stroke,
    },
    Area {
        points: Vec<[f64; 2]>,
        ink: Ink,
        opacity: f64,
    },
    Box {
        /// Left, top, width and height of the box, in canvas units.
        place: [f64; 4],
        ink: Ink,
        words: String,
    },
    Points {
        points: Points,
        ink: Ink,
        radius: f64,
        opacity: f64,
    },
    Label(Label),
}

/// Size of a figure in print, and its font.
#[derive(Clone, Debug, Default)]
pub(crate) struct Print {
    pub(crate) width_pt: Option<f64>,
    pub(crate) font: Option<String>,
}

/// Marks in drawing order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Canvas {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) marks: Vec<Mark>,
    pub(crate) print: Print,
    /// True if the drawing contains a remark on an absent value.
    pub(crate) is_remarked: bool,
}

impl Canvas {
    pub(crate) fn new(width: f64, height: f64) -> Canvas {
        Canvas {
            width,
            height,
            marks: Vec::new(),
            print: Print::default(),
            is_remarked: false,
        }
    }

    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        self.path(vec![from, to], stroke);
    }

    pub(crate) fn path(&mut self, points: Vec<[f64; 2]>, stroke: Stroke) {
        if points.len() > 1 {
            self.marks.push(Mark::Path { points, stroke });
        }
    }

    pub(crate) fn area(&mut self, points: Vec<[f64; 2]>, ink: Ink, opacity: f64) {
        self.marks.push(Mark::Area {
            points,
            ink,
            opacity,
        });
    }

    /// Adds a filled box with the tooltip `words`; no tooltip if `words` is empty.
    pub(crate) fn fill(&mut self, place: [f64; 4], ink: Ink, words: String) {
        self.marks.push(Mark::Box { place, ink, words });
    }

    pub(crate) fn points(&mut self, points: Points, ink: Ink, radius: f64, opacity: f64) {
        if !points.at.is_empty() {
            self.marks.push(Mark::Points {
                points,
                ink,
                radius,
                opacity,
            });
        }
    }

    pub(crate) fn label(&mut self, label: Label) {
        self.marks.push(Mark::Label(label));
    }

    /// Adds a text on a coloured cell. The text is always dark, because cell colours are equal in light and dark mode.
    pub(crate) fn cell_label(&mut self, label: Label) {
        let ink = Ink::Rgb([27, 31, 36]);
        self.marks.push(Mark::Label(Label { ink, ..label }));
    }

    /// Adds a legend of lines by series position, from `at` to the right, in several rows if needed.
    pub(crate) fn legend(&mut self, at: [f64; 2], series: &[(usize, String)]) {
        for ([x, y], position, name) in self.entries(at, series) {
            self.line([x, y - 4.0], [x + 22.0, y - 4.0], Stroke::series(position));
            self.legend_name([x + 27.0, y], name);
        }
    }

    /// Same as [`Canvas::legend`], with dots instead of lines.
    pub(crate) fn dot_legend(&mut self, at: [f64; 2], series: &[(usize, String)]) {
        for ([x, y], position, name) in self.entries(at, series) {
            let dot = Points {
                at: vec![[x + 18.0, y - 4.0]],
                words: Vec::new(),
            };
            self.points(dot, Ink::Series(position), 3.6, 1.0);
            self.legend_name([x + 27.0, y], name);
        }
    }

    fn legend_name(&mut self, at: [f64; 2], name: String) {
        let mut label = Label::new(at, name, Anchor::Start);
        label.ink = Ink::Text;
        self.label(label);
    }

    /// Position of each entry of a legend, wrapped at the canvas width.
    fn entries(&self, at: [f64; 2], series: &[(usize, String)]) -> Vec<([f64; 2], usize, String)> {
        let [mut x, mut y] = at;
        let mut entries = Vec::new();
        for (position, name) in series {
            let name = short(name, 24);
            let width = 27.0 + width_of(&name, 11.0);
            if x > at[0] && x + width > self.width {
                (x, y) = (at[0], y + 16.0);
            }
            entries.push(([x, y], *position, name));
            x += width + 18.0;
        }
        entries
    }
}

use super::words::short;

/// Approximate width of a text. East Asian letters, and all letters with greater code points, are as wide as high.
pub(crate) fn width_of(text: &str, size: f64) -> f64 {
    let wide = text
        .chars()
        .filter(|letter| matches!(letter, '\u{1100}'..='\u{11ff}' | '\u{2e80}'..))
        .count();
    let letters = |count: usize| f64::from(u32::try_from(count).unwrap_or(u32::MAX));
    (letters(text.chars().count() - wide) * 0.56 + letters(wide)) * size
}
