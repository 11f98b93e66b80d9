//! Places names next to dots. Avoids overlap with dots and other names.

use super::canvas::{Anchor, Ink, Label, width_of};
use super::panel::Area;

/// Half the side of the square that a dot occupies.
const DOT: f64 = 6.5;
const SIZE: f64 = 11.0;
/// Positions of a name next to its dot, best first.
const PLACES: [([f64; 2], Anchor); 10] = [
    // Above a line that continues from the dot.
    ([8.0, -7.0], Anchor::Start),
    ([-10.0, 4.0], Anchor::End),
    ([10.0, 4.0], Anchor::Start),
    ([0.0, -10.0], Anchor::Middle),
    ([0.0, 19.0], Anchor::Middle),
    ([8.0, 15.0], Anchor::Start),
    ([-8.0, -7.0], Anchor::End),
    ([-8.0, 15.0], Anchor::End),
    ([10.0, -19.0], Anchor::Start),
    ([10.0, 27.0], Anchor::Start),
];

/// Bounds of a rectangle in canvas units: left, top, right, bottom.
type Bounds = [f64; 4];

/// Label for each dot inside `area`, at the position with the least overlap.
pub(crate) fn beside(dots: &[([f64; 2], String)], area: Area) -> Vec<Label> {
    let around = |[x, y]: [f64; 2]| [x - DOT, y - DOT, x + DOT, y + DOT];
    let mut taken: Vec<Bounds> = dots.iter().map(|(at, _)| around(*at)).collect();
    let mut labels = Vec::new();
    for (position, (at, name)) in dots.iter().enumerate() {
        let covered = |label: &Label| -> f64 {
            let bounds = bounds(label);
            let others = taken
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != position);
            let shared: f64 = others.map(|(_, other)| shared(bounds, *other)).sum();
            shared + outside(bounds, area)
        };
        let mut best: Option<(f64, Label)> = None;
        for ([right, down], anchor) in PLACES {
            let label = Label {
                ink: Ink::Text,
                size: SIZE,
                ..Label::new([at[0] + right, at[1] + down], name.clone(), anchor)
            };
            let covers = covered(&label);
            if best.as_ref().is_none_or(|(least, _)| covers < *least) {
                best = Some((covers, label));
            }
        }
        if let Some((_, label)) = best {
            taken.push(bounds(&label));
            labels.push(label);
        }
    }
    labels
}

fn bounds(label: &Label) -> Bounds {
    let width = width_of(&label.text, label.size);
    let [x, y] = label.at;
    let left = match label.anchor {
        Anchor::Start => x,
        Anchor::Middle => x - width / 2.0,
        Anchor::End => x - width,
    };
    [
        left,
        y - label.size * 0.8,
        left + width,
        y + label.size * 0.25,
    ]
}

/// Area that two rectangles share.
fn shared(a: Bounds, b: Bounds) -> f64 {
    let across = a[2].min(b[2]) - a[0].max(b[0]);
    let down = a[3].min(b[3]) - a[1].max(b[1]);
    across.max(0.0) * down.max(0.0)
}

/// Penalty for the area of `bounds` outside `area`, greater than the penalty for an overlap with another name.
fn outside(bounds: Bounds, area: Area) -> f64 {
    let inside = [area.left, area.top, area.right(), area.bottom()];
    let size = (bounds[2] - bounds[0]) * (bounds[3] - bounds[1]);
    4.0 * (size - shared(bounds, inside))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_neighbours_do_not_cover_each_other() {
        let area = Area {
            left: 0.0,
            top: 0.0,
            width: 300.0,
            height: 200.0,
        };
        let dots: Vec<([f64; 2], String)> = [[150.0, 100.0], [160.0, 102.0], [290.0, 50.0]]
            .into_iter()
            .map(|at| (at, "neighbour".to_owned()))
            .collect();
        let labels = beside(&dots, area);
        let boxes: Vec<Bounds> = labels.iter().map(bounds).collect();
        for (at, one) in boxes.iter().enumerate() {
            assert!(outside(*one, area) < 1e-9);
            for other in &boxes[at + 1..] {
                assert!(shared(*one, *other) < 1e-9);
            }
        }
    }
}
