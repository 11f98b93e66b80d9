//! Compression as by cameras that send JPEG pictures.

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

/// Side of a block.
const SIDE: usize = 8;
/// Middle of the 256 levels.
const MIDDLE: f32 = 128.0;

/// Numbers of a block, row by row.
type Block = [[f32; SIDE]; SIDE];

/// Steps of brightness (ITU-T T.81, table K.1).
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
/// Steps of colour (ITU-T T.81, table K.2).
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

/// Cosines of k · π / 16 for k from 0 to 8, as literals: a library of the system may round them otherwise.
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

/// Weights of the discrete cosine transform: a row for each frequency.
static FORWARD: LazyLock<Block> = LazyLock::new(|| {
    let mut weights = [[0.0; SIDE]; SIDE];
    for (frequency, row) in weights.iter_mut().enumerate() {
        let scale = if frequency == 0 { FRAC_1_SQRT_2 } else { 1.0 };
        for (place, weight) in row.iter_mut().enumerate() {
            *weight = single(0.5 * scale * cosine((2 * place + 1) * frequency));
        }
    }
    weights
});
/// Weights of the inverse transform: a row for each place.
static INVERSE: LazyLock<Block> = LazyLock::new(|| {
    let mut weights = [[0.0; SIDE]; SIDE];
    for (place, row) in weights.iter_mut().enumerate() {
        for (weight, frequency) in row.iter_mut().zip(FORWARD.iter()) {
            *weight = frequency[place];
        }
    }
    weights
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

/// One plane of numbers.
struct Plane {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let (width, height, full) = (canvas.width(), canvas.height(), canvas.full());
    let (brightness, colour) = (
        steps(&BRIGHTNESS, drawn.parameter),
        steps(&COLOUR, drawn.parameter),
    );
    let is_gray = canvas.colours() == 1;
    let plane = |values| Plane {
        width,
        height,
        values,
    };
    let to_byte = 255.0 / full;
    let scaled: Vec<[f32; 3]> = canvas
        .pixels()
        .map(|pixel| {
            let number = |colour: usize| pixel[colour.min(pixel.len() - 1)] * to_byte;
            [number(0), number(1), number(2)]
        })
        .collect();
    let part = |weights: [f32; 3]| -> Vec<f32> {
        let parts = scaled.iter();
        parts
            .map(|[red, green, blue]| weights[0] * red + weights[1] * green + weights[2] * blue)
            .collect()
    };
    let mut light = match is_gray {
        true => plane(scaled.iter().map(|[gray, ..]| *gray).collect()),
        false => plane(part([0.299, 0.587, 0.114])),
    };
    light.values.iter_mut().for_each(|value| *value -= MIDDLE);
    light.compress(&brightness);
    let colours = (!is_gray).then(|| {
        let weights = [[-0.168736, -0.331264, 0.5], [0.5, -0.418688, -0.081312]];
        weights.map(|weights| {
            let mut half = plane(part(weights)).halved();
            half.compress(&colour);
            half
        })
    });
    let to_full = full / 255.0;
    for (place, pixel) in canvas.pixels().enumerate() {
        let light = light.values[place] + MIDDLE;
        let numbers = match &colours {
            None => [light; 3],
            Some([blue, red]) => {
                let (column, row) = (place % width, place / width);
                let [blue, red] = [blue, red].map(|of| of.values[row * of.width + column / 2]);
                [
                    light + 1.402 * red,
                    light - 0.344136 * blue - 0.714136 * red,
                    light + 1.772 * blue,
                ]
            }
        };
        for (value, number) in pixel.iter_mut().zip(numbers) {
            *value = number.round_ties_even().clamp(0.0, 255.0) * to_full;
        }
    }
}

/// Steps of the coefficients at a quality of 100 less `lost`, as the encoder of the Independent JPEG Group scales them.
fn steps(table: &Block, lost: f32) -> Block {
    let quality = (100.0 - lost).max(1.0);
    let percent = match quality < 50.0 {
        true => 5000.0 / quality,
        false => 200.0 - 2.0 * quality,
    };
    table.map(|row| row.map(|step| (step * percent / 100.0 + 0.5).floor().clamp(1.0, 255.0)))
}

impl Plane {
    /// The plane with half of its columns: means of two neighbours, as cameras send colour.
    fn halved(&self) -> Plane {
        let rows = self.values.chunks_exact(self.width);
        let values = rows.flat_map(|row| {
            row.chunks(2)
                .map(|pair| 0.5 * (pair[0] + pair[pair.len() - 1]))
        });
        Plane {
            width: self.width.div_ceil(2),
            height: self.height,
            values: values.collect(),
        }
    }

    /// Rounds the coefficients of each block to `steps`. Blocks at the edge continue its last pixel.
    fn compress(&mut self, steps: &Block) {
        for top in (0..self.height).step_by(SIDE) {
            for left in (0..self.width).step_by(SIDE) {
                let place = |row: usize, column: usize| {
                    let row = (top + row).min(self.height - 1);
                    row * self.width + (left + column).min(self.width - 1)
                };
                let mut block = [[0.0; SIDE]; SIDE];
                for (row, values) in block.iter_mut().enumerate() {
                    for (column, value) in values.iter_mut().enumerate() {
                        *value = self.values[place(row, column)];
                    }
                }
                let mut coefficients = transformed(&block, &FORWARD);
                for (row, steps) in coefficients.iter_mut().zip(steps) {
                    for (coefficient, step) in row.iter_mut().zip(steps) {
                        *coefficient = (*coefficient / step).round_ties_even() * step;
                    }
                }
                let block = transformed(&coefficients, &INVERSE);
                let length = SIDE.min(self.width - left);
                for (row, values) in block.iter().take(self.height - top).enumerate() {
                    let first = (top + row) * self.width + left;
                    self.values[first..first + length].copy_from_slice(&values[..length]);
                }
            }
        }
    }
}

/// Transform of a block along rows and columns.
fn transformed(block: &Block, weights: &Block) -> Block {
    turned(&turned(block, weights), weights)
}

/// Transform of each row, written as a column.
fn turned(block: &Block, weights: &Block) -> Block {
    let mut turned = [[0.0; SIDE]; SIDE];
    for (row, values) in block.iter().enumerate() {
        for (place, weights) in turned.iter_mut().zip(weights) {
            let products = values.iter().zip(weights);
            place[row] = products.map(|(value, weight)| value * weight).sum();
        }
    }
    turned
}
