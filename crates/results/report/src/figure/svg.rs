//! Writes figures as SVG. Classes for inks let a page choose colours for light and dark mode without inline styles.

use std::fmt::Write;

use super::Figure;
use super::canvas::{Anchor, Ink, Label, Mark, Points, Stroke};
use super::palette::LIGHT;
use crate::escape;

/// Style of figures. A page or a standalone figure must also define the variables of the style.
pub const STYLE: &str = "\
svg text{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;font-variant-numeric:tabular-nums}\
svg .b{font-weight:600}\
svg .ft{fill:var(--text)}svg .fm{fill:var(--muted)}svg .fg{fill:var(--grid)}svg .fp{fill:var(--paper)}\
svg .kt{stroke:var(--text)}svg .km{stroke:var(--muted)}svg .kg{stroke:var(--grid)}svg .kp{stroke:var(--paper)}\
svg .f0{fill:var(--s0)}svg .f1{fill:var(--s1)}svg .f2{fill:var(--s2)}svg .f3{fill:var(--s3)}svg .f4{fill:var(--s4)}svg .f5{fill:var(--s5)}svg .f6{fill:var(--s6)}\
svg .k0{stroke:var(--s0)}svg .k1{stroke:var(--s1)}svg .k2{stroke:var(--s2)}svg .k3{stroke:var(--s3)}svg .k4{stroke:var(--s4)}svg .k5{stroke:var(--s5)}svg .k6{stroke:var(--s6)}\
svg path,svg polyline{fill:none;stroke-linejoin:round;stroke-linecap:round}svg polygon{stroke:none}";

pub(super) fn write(figure: &Figure, alone: bool) -> String {
    let canvas = &figure.canvas;
    let (width, height) = (canvas.width, canvas.height);
    let id = escape::svg(&figure.id);
    let mut out = String::new();
    let mut namespace = if alone {
        " xmlns=\"http://www.w3.org/2000/svg\""
    } else {
        " tabindex=\"0\""
    }
    .to_owned();
    if let (true, Some(width_pt)) = (alone, canvas.print.width_pt) {
        let height_pt = height * width_pt / width;
        push(
            &mut namespace,
            format_args!(" width=\"{width_pt:.2}pt\" height=\"{height_pt:.2}pt\""),
        );
    }
    push(
        &mut out,
        format_args!(
            "<svg{namespace} viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-labelledby=\"t-{id} d-{id}\">\
             <title id=\"t-{id}\">{}</title><desc id=\"d-{id}\">{}</desc>",
            escape::svg(&figure.title),
            escape::svg(&figure.description)
        ),
    );
    if alone {
        push(
            &mut out,
            format_args!("<style>svg{{{}}}{STYLE}{}</style>", paper(), font(figure)),
        );
        push(
            &mut out,
            format_args!("<rect width=\"{width:.0}\" height=\"{height:.0}\" class=\"fp\"/>"),
        );
    }
    for mark in &canvas.marks {
        draw(mark, alone, &mut out);
    }
    out.push_str("</svg>\n");
    out
}

/// CSS rule that puts the requested font first; empty without a requested font.
fn font(figure: &Figure) -> String {
    let plain = |letter: &char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_' | '.');
    match &figure.canvas.print.font {
        Some(family) => {
            let family: String = family.chars().filter(plain).collect();
            format!("svg text{{font-family:'{family}',Arial,sans-serif}}")
        }
        None => String::new(),
    }
}

/// Values of the style variables for a figure on white paper.
fn paper() -> String {
    let series = LIGHT.iter().enumerate();
    let series: String = series.fold(String::new(), |mut all, (at, colour)| {
        push(&mut all, format_args!("--s{at}:{colour};"));
        all
    });
    format!("--text:#1b1f24;--muted:#57606a;--grid:#e4e7eb;--paper:#ffffff;{series}")
}

fn draw(mark: &Mark, alone: bool, out: &mut String) {
    match mark {
        Mark::Path { points, stroke } => path(points, *stroke, out),
        Mark::Area {
            points,
            ink,
            opacity,
        } => {
            push(out, format_args!("<polygon points=\""));
            coordinates(points, out);
            push(
                out,
                format_args!("\"{} fill-opacity=\"{opacity}\"/>", fill(*ink)),
            );
        }
        Mark::Box { place, ink, words } => {
            let [x, y, width, height] = place;
            push(
                out,
                format_args!(
                    "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"{}",
                    fill(*ink)
                ),
            );
            close(words, "rect", alone, out);
        }
        Mark::Points {
            points,
            ink,
            radius,
            opacity,
        } => dots(points, *ink, *radius, *opacity, alone, out),
        Mark::Label(label) => text(label, out),
    }
}

fn path(points: &[[f64; 2]], stroke: Stroke, out: &mut String) {
    push(out, format_args!("<polyline points=\""));
    coordinates(points, out);
    push(
        out,
        format_args!("\"{} stroke-width=\"{}\"", line(stroke.ink), stroke.width),
    );
    if !stroke.dash.is_empty() {
        push(out, format_args!(" stroke-dasharray=\"{}\"", stroke.dash));
    }
    out.push_str("/>");
}

fn dots(points: &Points, ink: Ink, radius: f64, opacity: f64, alone: bool, out: &mut String) {
    push(
        out,
        format_args!("<g{} fill-opacity=\"{opacity}\">", fill(ink)),
    );
    for (at, [x, y]) in points.at.iter().enumerate() {
        push(
            out,
            format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\""),
        );
        let words = points.words.get(at).map_or("", String::as_str);
        close(words, "circle", alone, out);
    }
    out.push_str("</g>");
}

/// Ends an element with its tooltip `words`: a data attribute on a page, a title in a standalone figure.
fn close(words: &str, element: &str, alone: bool, out: &mut String) {
    match (words.is_empty(), alone) {
        (true, _) => out.push_str("/>"),
        (false, true) => push(
            out,
            format_args!("><title>{}</title></{element}>", escape::svg(words)),
        ),
        (false, false) => push(out, format_args!(" data-t=\"{}\"/>", escape::svg(words))),
    }
}

fn text(label: &Label, out: &mut String) {
    let [x, y] = label.at;
    let anchor = match label.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let place = if label.upwards {
        format!("transform=\"translate({x:.1} {y:.1}) rotate(-90)\"")
    } else {
        format!("x=\"{x:.1}\" y=\"{y:.1}\"")
    };
    let paint = match label.ink {
        Ink::Text | Ink::Muted if label.bold => " class=\"ft b\"".to_owned(),
        ink => fill(ink),
    };
    push(
        out,
        format_args!(
            "<text {place} text-anchor=\"{anchor}\" font-size=\"{}\"{paint}>{}</text>",
            label.size,
            escape::svg(&label.text)
        ),
    );
}

fn coordinates(points: &[[f64; 2]], out: &mut String) {
    for (at, [x, y]) in points.iter().enumerate() {
        let space = if at > 0 { " " } else { "" };
        push(out, format_args!("{space}{x:.1},{y:.1}"));
    }
}

fn fill(ink: Ink) -> String {
    paint(ink, "f", "fill")
}

fn line(ink: Ink) -> String {
    paint(ink, "k", "stroke")
}

fn paint(ink: Ink, class: &str, attribute: &str) -> String {
    match ink {
        Ink::Text => format!(" class=\"{class}t\""),
        Ink::Muted => format!(" class=\"{class}m\""),
        Ink::Grid => format!(" class=\"{class}g\""),
        Ink::Paper => format!(" class=\"{class}p\""),
        Ink::Series(position) => format!(" class=\"{class}{}\"", position % LIGHT.len()),
        Ink::Rgb([red, green, blue]) => {
            format!(" {attribute}=\"#{red:02x}{green:02x}{blue:02x}\"")
        }
    }
}

/// Appends formatted text to `out`.
fn push(out: &mut String, words: std::fmt::Arguments<'_>) {
    out.write_fmt(words)
        .expect("a text takes whatever is written to it");
}
