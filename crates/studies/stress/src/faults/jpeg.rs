//! Fault of pictures: JPEG compression, as in cameras that send compressed pictures.

use std::array::from_fn;
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::LazyLock;

use taceva_core::single;

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "jpeg",
    title: "the picture is compressed as JPEG, as by cameras that send MJPEG",
    parameter: "100 less the quality of the encoder",
    scope: Scope::Fixed,
    table: [10.0, 30.0, 50.0, 70.0, 90.0],
    most: 99.0,
    note: None,
    effect: Effect::Numbers(apply),
};

/// Side of a JPEG block, in pixels.
const SIDE: usize = 8;
/// Middle of the 256 levels, which JPEG subtracts before the transform.
const MIDDLE: f32 = 128.0;
/// Matrix from red, green and blue to brightness and two colour differences (ITU-T T.871).
const TO: [[f32; 3]; 3] = [
    [0.299, 0.587, 0.114],
    [-0.168736, -0.331264, 0.5],
    [0.5, -0.418688, -0.081312],
];
/// Matrix from brightness and two colour differences to red, green and blue.
const FROM: [[f32; 3]; 3] = [
    [1.0, 0.0, 1.402],
    [1.0, -0.344136, -0.714136],
    [1.0, 1.772, 0.0],
];

/// Values of a JPEG block, row by row.
type Block = [[f32; SIDE]; SIDE];

/// Quantisation steps of brightness (ITU-T T.81, table K.1).
const BRIGHTNESS: Block = [
    [16.0, 11.0, 10.0, 16.0, 24.0, 40.0, 51.0, 61.0],
    [12.0, 12.0, 14.0, 19.0, 26.0, 58.0, 60.0, 55.0],
    [14.0, 13.0, 16.0, 24.0, 40.0, 57.0, 69.0, 56.0],
    [14.0, 17.0, 22.0, 29.0, 51.0, 87.0, 80.0, 62.0],
    [18.0, 22.0, 37.0, 56.0, 68.0, 109.0, 103.0, 77.0],
    [24.0, 35.0, 55.0, 64.0, 81.0, 104.0, 113.0, 92.0],
    [49.0, 64.0, 78.0, 87.0, 103.0, 121.0, 120.0, 101.0],
    [72.0, 92.0, 95.0, 98.0, 112.0, 100.0, 103.0, 99.0],
];
/// Quantisation steps of colour (ITU-T T.81, table K.2).
const COLOUR: Block = [
    [17.0, 18.0, 24.0, 47.0, 99.0, 99.0, 99.0, 99.0],
    [18.0, 21.0, 26.0, 66.0, 99.0, 99.0, 99.0, 99.0],
    [24.0, 26.0, 56.0, 99.0, 99.0, 99.0, 99.0, 99.0],
    [47.0, 66.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0],
    [99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0],
    [99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0],
    [99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0],
    [99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0, 99.0],
];

/// Cosines of k · π / 16 for k from 0 to 8. They are literals, because mathematical libraries round them differently.
const COSINES: [f64; 9] = [
    1.0,
    0.980_785_280_403_230_4,
    0.923_879_532_511_286_7,
    0.831_469_612_302_545_2,
    FRAC_1_SQRT_2,
    0.555_570_233_019_602_2,
    0.382_683_432_365_089_8,
    0.195_090_322_016_128_3,
    0.0,
];

/// Weights of the discrete cosine transform and of its inverse. The first has a row for each frequency, the second for each place.
static WEIGHTS: LazyLock<[Block; 2]> = LazyLock::new(|| {
    let forward: Block = from_fn(|frequency| {
        let scale = if frequency == 0 { FRAC_1_SQRT_2 } else { 1.0 };
        from_fn(|place| single(0.5 * scale * cosine((2 * place + 1) * frequency)))
    });
    let inverse = from_fn(|place| from_fn(|frequency: usize| forward[frequency][place]));
    [forward, inverse]
});

/// Cosine of `step` · π / 16.
fn cosine(step: usize) -> f64 {
    match step % 32 {
        step @ 0..=8 => COSINES[step],
        step @ 9..=16 => -COSINES[16 - step],
        step @ 17..=24 => -COSINES[step - 16],
        step => COSINES[32 - step],
    }
}

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let (width, height, depth) = (canvas.width(), canvas.height(), canvas.colours());
    let scale = canvas.full() / 255.0;
    let steps = [&BRIGHTNESS, &COLOUR].map(|table| steps(table, drawn.parameter));
    let planes = (0..depth).map(|at| {
        let middle = if at == 0 { MIDDLE } else { 0.0 };
        let pixels = canvas.values.chunks_exact(depth);
        let values = pixels.map(|pixel| mixed(&TO, pixel, at) / scale - middle);
        let whole = Plane {
            width,
            height,
            values: values.collect(),
        };
        let mut plane = if at == 0 { whole } else { whole.halved() };
        plane.compress(&steps[at.min(1)]);
        plane
    });
    let planes: Vec<Plane> = planes.collect();
    for (place, pixel) in canvas.pixels().enumerate() {
        let (column, row) = (place % width, place / width);
        let mut numbers = [planes[0].values[place] + MIDDLE, 0.0, 0.0];
        for (number, plane) in numbers.iter_mut().zip(&planes).skip(1) {
            *number = plane.values[row * plane.width + column / 2];
        }
        for (at, value) in pixel.iter_mut().enumerate() {
            let number = mixed(&FROM, &numbers[..depth], at);
            *value = number.round_ties_even().clamp(0.0, 255.0) * scale;
        }
    }
}

/// Sum of `numbers`, weighted by the row `at` of `weights`. A single number (a gray value) is returned unchanged.
fn mixed(weights: &[[f32; 3]; 3], numbers: &[f32], at: usize) -> f32 {
    match numbers {
        [only] => *only,
        _ => product(numbers, &weights[at]),
    }
}

fn product(numbers: &[f32], weights: &[f32]) -> f32 {
    let products = numbers.iter().zip(weights);
    products.map(|(number, weight)| number * weight).sum()
}

/// Quantisation steps at the JPEG quality 100 − `lost`, scaled from `table` as the encoder of the Independent JPEG Group does.
fn steps(table: &Block, lost: f32) -> Block {
    let quality = (100.0 - lost).max(1.0);
    let percent = match quality < 50.0 {
        true => 5000.0 / quality,
        false => 200.0 - 2.0 * quality,
    };
    let percent = percent.floor();
    table.map(|row| row.map(|step| (step * percent / 100.0 + 0.5).floor().clamp(1.0, 255.0)))
}

/// Plane of a picture: the brightness, or one colour difference, of all its pixels.
struct Plane {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Plane {
    /// Plane with half of the columns. Each value is the mean of two neighbours, as cameras subsample colour differences.
    fn halved(&self) -> Plane {
        let rows = self.values.chunks_exact(self.width);
        let pairs = rows.flat_map(|row| row.chunks(2));
        let values = pairs.map(|pair| 0.5 * (pair[0] + pair[pair.len() - 1]));
        Plane {
            width: self.width.div_ceil(2),
            height: self.height,
            values: values.collect(),
        }
    }

    /// Rounds the cosine coefficients of each block to multiples of `steps`. Beyond the edge of the plane, a block repeats the pixels at the edge.
    fn compress(&mut self, steps: &Block) {
        let [forward, inverse] = &*WEIGHTS;
        for top in (0..self.height).step_by(SIDE) {
            for left in (0..self.width).step_by(SIDE) {
                let number = |row: usize, column: usize| {
                    let row = (top + row).min(self.height - 1);
                    self.values[row * self.width + (left + column).min(self.width - 1)]
                };
                let block = from_fn(|row| from_fn(|column| number(row, column)));
                let found = transformed(&block, forward);
                let rounded = |row: usize, column: usize| {
                    let step = steps[row][column];
                    (found[row][column] / step).round_ties_even() * step
                };
                let coefficients = from_fn(|row| from_fn(|column| rounded(row, column)));
                let block = transformed(&coefficients, inverse);
                let length = SIDE.min(self.width - left);
                for (row, values) in block.iter().take(self.height - top).enumerate() {
                    let first = (top + row) * self.width + left;
                    self.values[first..first + length].copy_from_slice(&values[..length]);
                }
            }
        }
    }
}

/// Cosine transform of a block along its rows and columns, or the inverse, according to `weights`.
fn transformed(block: &Block, weights: &Block) -> Block {
    turned(&turned(block, weights), weights)
}

/// Transforms each row of `block`, and transposes the result.
fn turned(block: &Block, weights: &Block) -> Block {
    from_fn(|place| from_fn(|row| product(&block[row], &weights[place])))
}
