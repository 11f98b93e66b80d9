//! Web of a radar: rings, axes with names, and the outline of one series.

use std::f64::consts::TAU;

use taceva_metrics::Better;

use crate::figure::{Anchor, Canvas, Ink, Label, Points, SERIES, Stroke, short};
use crate::number::numeral;

/// Name and better direction of an axis, printed at the rim.
pub(super) struct Rim<'a> {
    pub(super) name: &'a str,
    pub(super) better: Better,
}

/// Width of a radar that fits a phone, with axis names in two lines.
pub(super) const WIDTH: f64 = 440.0;
const RADIUS: f64 = 130.0;

fn place(axis: usize, count: usize, share: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let angle = TAU * axis as f64 / count as f64 - TAU / 4.0;
    [
        x + RADIUS * share * angle.cos(),
        y + RADIUS * share * angle.sin(),
    ]
}

pub(super) fn web(axes: &[Rim<'_>], centre: [f64; 2], canvas: &mut Canvas) {
    let count = axes.len();
    for ring in [0.25, 0.5, 0.75, 1.0] {
        let points = (0..=count).map(|axis| place(axis % count, count, ring, centre));
        canvas.path(points.collect(), Stroke::thin(Ink::Grid));
    }
    for (position, Rim { name, better }) in axes.iter().enumerate() {
        let end = place(position, count, 1.0, centre);
        canvas.line(centre, end, Stroke::thin(Ink::Grid));
        let [x, y] = place(position, count, 1.09, centre);
        let anchor = match x - centre[0] {
            off if off > 10.0 => Anchor::Start,
            off if off < -10.0 => Anchor::End,
            _ => Anchor::Middle,
        };
        let arrow = match better {
            Better::Higher => "↑",
            _ => "↓",
        };
        let name = format!("{name} {arrow}");
        let (first, second) = name.split_once(' ').unwrap_or((&name, ""));
        // Names are above the upper half and below the lower half, clear of the web.
        let aside = (y - centre[1]) / RADIUS * 8.0;
        for (line, down) in [(first, -2.0), (second, 11.0)] {
            let mut label = Label::new([x, y + down + aside], line, anchor);
            label.ink = Ink::Text;
            canvas.label(label);
        }
    }
}

pub(super) fn outline(
    shares: &[Option<(f64, f64)>],
    axes: &[Rim<'_>],
    centre: [f64; 2],
    at: usize,
    name: &str,
    canvas: &mut Canvas,
) {
    let count = shares.len();
    let corner = |axis: usize| {
        shares[axis % count].map(|(share, _)| place(axis % count, count, share, centre))
    };
    let closed: Option<Vec<[f64; 2]>> = (0..=count).map(corner).collect();
    if let Some(points) = closed {
        canvas.area(points.clone(), Ink::Series(at), 0.06);
        canvas.path(points, Stroke::series(at % SERIES));
    } else {
        for axis in 0..count {
            if let (Some(from), Some(to)) = (corner(axis), corner(axis + 1)) {
                canvas.line(from, to, Stroke::series(at % SERIES));
            }
        }
    }
    let mut points = Points::default();
    for (position, Rim { name: axis, .. }) in axes.iter().enumerate() {
        if let (Some(corner), Some((share, value))) = (corner(position), shares[position]) {
            points.at.push(corner);
            points.words.push(format!(
                "{}, {}: {} ({} % of the best)",
                short(name, 40),
                axis,
                numeral(value),
                numeral(share * 100.0)
            ));
        }
    }
    canvas.points(points, Ink::Series(at), 3.4, 1.0);
}
