//! Fault of pictures: a lens out of focus.

use taceva_core::single;
use taceva_metrics::elementary::exponential;

use crate::canvas::{Canvas, Realisation, index};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "defocus",
    title: "the lens is out of focus: Gaussian blur",
    parameter: "standard deviation, share of the width",
    scope: Scope::Fixed,
    table: [0.003, 0.006, 0.010, 0.016, 0.025],
    most: 0.1,
    note: None,
    effect: Effect::Numbers(apply),
};

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let deviation = drawn.parameter * canvas.width() as f32;
    let kernel = kernel(deviation);
    along_rows(canvas, &kernel);
    along_columns(canvas, &kernel);
}

/// Weights of a Gaussian with the standard deviation `deviation`, in pixels, up to three deviations on either side.
fn kernel(deviation: f32) -> Vec<f32> {
    let reach = index(3.0 * deviation + 1.0);
    let weight = |tap: usize| {
        let from = (tap as f64 - reach as f64) / f64::from(deviation);
        exponential(-0.5 * from * from)
    };
    let weights: Vec<f64> = (0..=2 * reach).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    let weights = weights.into_iter().map(|weight| single(weight / sum));
    weights.collect()
}

/// Convolves each row with `kernel`. Outside the picture, the pixels at its edge are repeated.
fn along_rows(canvas: &mut Canvas, kernel: &[f32]) {
    let (colours, reach) = (canvas.colours(), kernel.len() / 2);
    let mut wide = Vec::new();
    for row in canvas.rows() {
        wide.clear();
        let length = row.len();
        (0..reach).for_each(|_| wide.extend_from_slice(&row[..colours]));
        wide.extend_from_slice(row);
        (0..reach).for_each(|_| wide.extend_from_slice(&row[length - colours..]));
        row.fill(0.0);
        for (tap, weight) in kernel.iter().enumerate() {
            add(row, &wide[tap * colours..tap * colours + length], *weight);
        }
    }
}

/// Convolves each column with `kernel`. Outside the picture, the pixels at its edge are repeated.
fn along_columns(canvas: &mut Canvas, kernel: &[f32]) {
    let (length, reach) = (canvas.width() * canvas.colours(), kernel.len() / 2);
    let last = canvas.height() - 1;
    let source = canvas.values.clone();
    for (y, row) in canvas.rows().enumerate() {
        row.fill(0.0);
        for (tap, weight) in kernel.iter().enumerate() {
            let from = (y + tap).saturating_sub(reach).min(last) * length;
            add(row, &source[from..from + length], *weight);
        }
    }
}

/// Adds `source` times `weight` to `row`.
fn add(row: &mut [f32], source: &[f32], weight: f32) {
    for (place, value) in row.iter_mut().zip(source) {
        *place += weight * value;
    }
}
