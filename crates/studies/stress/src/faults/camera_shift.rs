//! Fault of pictures: the camera has moved in its mount.

use crate::canvas::{Canvas, Realisation, index};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "camera_shift",
    title: "the camera moved: the picture is displaced along x, half as much along y",
    parameter: "displacement along x, share of the width",
    scope: Scope::Fixed,
    table: [0.002, 0.005, 0.01, 0.02, 0.04],
    most: 0.25,
    note: None,
    effect: Effect::Numbers(apply),
};

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let by = drawn.parameter * canvas.width() as f32;
    let colours = canvas.colours();
    let row = canvas.width() * colours;
    for values in canvas.values.chunks_exact_mut(row) {
        displace(values, colours, by);
    }
    displace(&mut canvas.values, row, by / 2.0);
}

/// Moves groups of `length` values by `by` groups towards the end, with linear interpolation. The first group is repeated at the beginning.
fn displace(values: &mut [f32], length: usize, by: f32) {
    let whole = index(by);
    let part = by - by.floor();
    let source = values.to_vec();
    for (at, cell) in values.chunks_exact_mut(length).enumerate() {
        let near = at.saturating_sub(whole) * length;
        let far = at.saturating_sub(whole + 1) * length;
        let pairs = source[near..near + length].iter().zip(&source[far..]);
        for (place, (near, far)) in cell.iter_mut().zip(pairs) {
            *place = (1.0 - part) * near + part * far;
        }
    }
}
