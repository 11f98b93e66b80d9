//! Transforms tiles of pictures to points, shape `[point, tile, channel]`, and back.

use std::ops::Range;

use super::transform;
use super::{SIDE, TILE, Tiles};
use crate::convolution::ending::{Finish, Start, SumRule};
use crate::planes::Layout;
use crate::simd::{Spaced, Vector};

/// A range of tiles in pictures of one layout.
#[derive(Clone)]
pub(super) struct Stretch {
    pub(super) tiles: Tiles,
    pub(super) range: Range<usize>,
    /// Stride between points, in values.
    pub(super) slab: usize,
}

/// Values of pictures of one layout.
#[derive(Clone, Copy)]
pub(super) struct PictureValues<'a> {
    pub(super) values: &'a [f32],
    pub(super) layout: Layout,
}

/// Buffer for a part of the output pictures.
pub(super) struct OutputBuffer<'a> {
    pub(super) values: &'a mut [f32],
    pub(super) layout: Layout,
    /// Number of picture values before the start of the buffer.
    pub(super) skipped: usize,
}

impl Stretch {
    /// Writes the transformed inputs of the tiles.
    ///
    /// # Shapes
    /// `pictures`: must have a border of at least one pixel.
    #[inline(always)]
    pub(super) fn read_inputs<V: Vector>(
        &self,
        proof: V::Proof,
        pictures: PictureValues<'_>,
        into: &mut [f32],
    ) {
        let PictureValues {
            values: pictures,
            layout,
        } = pictures;
        let (channels, row) = (layout.picture.channels, layout.row());
        for (position, tile) in self.range.clone().enumerate() {
            let place = self.tiles.place(tile);
            // A tile begins one pixel above and left of its outputs. Values beyond the border are zero.
            let corner = place.image * layout.len()
                + (place.y + layout.border - 1) * row
                + (place.x + layout.border - 1) * channels;
            let (rows, columns) = (place.below + 2, place.beside + 2);
            for channel in (0..channels).step_by(V::LANES) {
                let mut half = [[V::zero(proof); SIDE]; SIDE];
                for column in 0..SIDE {
                    let pixels = Spaced {
                        start: corner + column * channels + channel,
                        stride: row,
                        count: if column < columns { rows } else { 0 },
                    };
                    let values = transform::input(proof, pixels.load(proof, pictures));
                    for (half, value) in half.iter_mut().zip(values) {
                        half[column] = value;
                    }
                }
                for (row, half) in half.into_iter().enumerate() {
                    let points = self.row_of_points(row, position * channels + channel);
                    points.store(transform::input(proof, half), into);
                }
            }
        }
    }

    /// Writes the transformed output gradients of the tiles.
    #[inline(always)]
    pub(super) fn read_gradients<V: Vector>(
        &self,
        proof: V::Proof,
        pictures: PictureValues<'_>,
        into: &mut [f32],
    ) {
        let PictureValues {
            values: pictures,
            layout,
        } = pictures;
        let (channels, row) = (layout.picture.channels, layout.row());
        for (position, tile) in self.range.clone().enumerate() {
            let place = self.tiles.place(tile);
            let corner =
                place.image * layout.len() + layout.start_of_row(place.y) + place.x * channels;
            for channel in (0..channels).step_by(V::LANES) {
                let mut half = [[V::zero(proof); TILE]; SIDE];
                for column in 0..TILE {
                    let is_within = column < place.beside;
                    let pixels = Spaced {
                        start: corner + column * channels + channel,
                        stride: row,
                        count: if is_within { place.below } else { 0 },
                    };
                    let values = transform::gradient(proof, pixels.load(proof, pictures));
                    for (half, value) in half.iter_mut().zip(values) {
                        half[column] = value;
                    }
                }
                for (row, half) in half.into_iter().enumerate() {
                    let points = self.row_of_points(row, position * channels + channel);
                    points.store(transform::gradient(proof, half), into);
                }
            }
        }
    }

    /// Computes the outputs of the tiles from the sums at each point, and writes them.
    #[inline(always)]
    pub(super) fn write_outputs<V: Vector>(
        &self,
        proof: V::Proof,
        sums: &[f32],
        output: &mut OutputBuffer<'_>,
        rule: SumRule<'_>,
    ) {
        let (layout, skipped) = (output.layout, output.skipped);
        let pictures = &mut *output.values;
        let (channels, row) = (layout.picture.channels, layout.row());
        for (position, tile) in self.range.clone().enumerate() {
            let place = self.tiles.place(tile);
            let corner =
                place.image * layout.len() + layout.start_of_row(place.y) + place.x * channels
                    - skipped;
            for channel in (0..channels).step_by(V::LANES) {
                let mut half = [[V::zero(proof); SIDE]; TILE];
                for column in 0..SIDE {
                    let points = Spaced {
                        start: column * self.slab + position * channels + channel,
                        stride: SIDE * self.slab,
                        count: SIDE,
                    };
                    let values = transform::output(proof, points.load(proof, sums));
                    for (half, value) in half.iter_mut().zip(values) {
                        half[column] = value;
                    }
                }
                for (at, half) in half.into_iter().enumerate() {
                    if at < place.below {
                        let pixels = Spaced {
                            start: corner + at * row + channel,
                            stride: channels,
                            count: place.beside,
                        };
                        let sums = transform::output(proof, half);
                        let sums = finished(proof, sums, pixels, channel, pictures, rule);
                        pixels.store(sums, pictures);
                    }
                }
            }
        }
    }

    /// Positions of the six points of `row`, with an offset of `start` values from the beginning of each point.
    #[inline(always)]
    fn row_of_points(&self, row: usize, start: usize) -> Spaced {
        Spaced {
            start: row * SIDE * self.slab + start,
            stride: self.slab,
            count: SIDE,
        }
    }
}

/// Sums of one row of a tile from `channel` on, after the start value and the operation on finished sums.
#[inline(always)]
fn finished<V: Vector>(
    proof: V::Proof,
    mut sums: [V; TILE],
    pixels: Spaced,
    channel: usize,
    pictures: &[f32],
    rule: SumRule<'_>,
) -> [V; TILE] {
    let before = match rule.start {
        Start::Zero => None,
        Start::Output => Some(pixels.load(proof, pictures)),
        Start::Bias(bias) => {
            let place = Spaced {
                start: channel,
                stride: 0,
                count: TILE,
            };
            Some(place.load(proof, bias))
        }
    };
    if let Some(before) = before {
        sums = plus(sums, before);
    }
    match rule.finish {
        Finish::Keep => sums,
        Finish::Relu => positive_part(sums),
        Finish::AddThenRelu(other) => positive_part(plus(sums, pixels.load(proof, other))),
    }
}

#[inline(always)]
fn plus<V: Vector>(mut sums: [V; TILE], others: [V; TILE]) -> [V; TILE] {
    for (sum, other) in sums.iter_mut().zip(others) {
        *sum = sum.plus(other);
    }
    sums
}

#[inline(always)]
fn positive_part<V: Vector>(mut sums: [V; TILE]) -> [V; TILE] {
    for sum in &mut sums {
        *sum = sum.positive_part();
    }
    sums
}
