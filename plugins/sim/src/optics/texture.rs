//! Smooth random patterns that repeat: speckle, unevenness of a coating, the buckling of a lattice.

use super::number::{count, narrow};
use super::simd::Lanes;
use crate::random::Stream;

/// A pattern on a torus of texels, four values each; linear between them.
#[derive(Clone, Debug)]
pub(super) struct Texture {
    texels: Box<[[f32; 4]; SIDE * SIDE]>,
    texels_per_unit: f32,
}

/// Texels a side; a power of two.
pub(super) const SIDE: usize = 1 << SIDE_BITS;
const SIDE_BITS: u32 = 7;
const MASK: u32 = (1 << SIDE_BITS) - 1;
/// Added to a number from −2²¹ to 2²¹, leaves its nearest whole number in the low bits.
const ROUND: f32 = 12_582_912.0;

impl Texture {
    /// A texture of `layers`, at `pitch` of the field's unit a texel.
    pub(super) fn new(pitch: f64, layers: &[Vec<f32>]) -> Texture {
        let texel = |index: usize| {
            std::array::from_fn(|lane| layers.get(lane).map_or(0.0, |layer| layer[index]))
        };
        Texture {
            texels: boxed(texel),
            texels_per_unit: narrow(1.0 / pitch),
        }
    }

    /// The four values at a place, in the field's unit.
    #[inline(always)]
    pub(super) fn at(&self, x: f32, y: f32) -> [f32; 4] {
        let cells = Cells::of(Lanes::new([x, y, 0.0, 0.0]), self.texels_per_unit);
        self.between(&cells, 0, &cells, 1).to_array()
    }

    /// The sum of three textures of one pitch, each at the place in its lane; the fourth lane of the places is left alone.
    #[inline(always)]
    pub(super) fn sum_at(layers: &[Texture; 3], x: Lanes, y: Lanes) -> Lanes {
        let pitch = layers[0].texels_per_unit;
        let (columns, rows) = (Cells::of(x, pitch), Cells::of(y, pitch));
        let value = |layer: usize| layers[layer].between(&columns, layer, &rows, layer);
        value(0).plus(value(1)).plus(value(2))
    }

    /// The first two values of the texel nearest to a place.
    #[inline(always)]
    pub(super) fn near(&self, x: f32, y: f32) -> [f32; 2] {
        let texel = |place: f32| ((place * self.texels_per_unit + ROUND).to_bits() & MASK) as usize;
        let [first, second, _, _] = self.texels[texel(y) * SIDE + texel(x)];
        [first, second]
    }

    /// The values in the cell of `columns` in lane `across` and of `rows` in lane `up`.
    #[inline(always)]
    fn between(&self, columns: &Cells, across: usize, rows: &Cells, up: usize) -> Lanes {
        let texel = |column: u32, row: u32| {
            // Both are masked, so the index is in range; masked once more, the compiler knows it too.
            let index = (row << SIDE_BITS | column) as usize & (SIDE * SIDE - 1);
            Lanes::new(self.texels[index])
        };
        let [left, right] = [columns.before[across], columns.after[across]];
        let [low, high] = [rows.before[up], rows.after[up]];
        let part = Lanes::splat(columns.fraction[across]);
        let below = texel(left, low).towards(texel(right, low), part);
        let above = texel(left, high).towards(texel(right, high), part);
        below.towards(above, Lanes::splat(rows.fraction[up]))
    }
}

/// The texels one after another, on the heap from the start.
fn boxed(texel: impl Fn(usize) -> [f32; 4]) -> Box<[[f32; 4]; SIDE * SIDE]> {
    let texels: Vec<[f32; 4]> = (0..SIDE * SIDE).map(texel).collect();
    texels.try_into().expect("as many as were asked for")
}

/// For each lane the texel before a place, the one after it, and how far on from the first; on a torus.
struct Cells {
    before: [u32; 4],
    after: [u32; 4],
    fraction: [f32; 4],
}

impl Cells {
    #[inline(always)]
    fn of(places: Lanes, texels_per_unit: f32) -> Cells {
        // The nearest whole number to place − ½ is the one before it; a tie makes the fraction 0 or 1, which is the same point.
        let places = places.times(Lanes::splat(texels_per_unit));
        let round = Lanes::splat(ROUND);
        let shifted = places.minus(Lanes::splat(0.5)).plus(round);
        let before = shifted.masked_bits(MASK);
        Cells {
            before,
            after: before.map(|before| (before + 1) & MASK),
            fraction: places.minus(shifted.minus(round)).to_array(),
        }
    }
}

/// A pattern of mean 0 and standard deviation 1 that varies over `sigma` texels, row by row.
///
/// White noise under a Gaussian window of that standard deviation, wrapped around.
pub(super) fn smooth_noise(stream: &Stream, layer: u64, sigma: f64) -> Vec<f32> {
    let first = layer * (SIDE * SIDE) as u64;
    let white: Vec<f64> = (first..first + (SIDE * SIDE) as u64)
        .map(|index| stream.normal(index))
        .collect();
    let window = window(sigma);
    let blurred = blur_rows(&transposed(&blur_rows(&white, &window)), &window);
    let mean = blurred.iter().sum::<f64>() / count(blurred.len());
    let variance =
        blurred.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count(blurred.len());
    blurred
        .iter()
        .map(|x| narrow((x - mean) / variance.sqrt()))
        .collect()
}

/// A Gaussian window from its middle outwards.
fn window(sigma: f64) -> Vec<f64> {
    (0..SIDE / 2)
        .map(count)
        .take_while(|distance| *distance <= 4.0 * sigma)
        .map(|distance| libm::exp(-0.5 * (distance / sigma) * (distance / sigma)))
        .collect()
}

fn blur_rows(pattern: &[f64], window: &[f64]) -> Vec<f64> {
    let mut blurred = Vec::with_capacity(pattern.len());
    for row in pattern.chunks_exact(SIDE) {
        for column in 0..SIDE {
            let sum: f64 = window
                .iter()
                .enumerate()
                .skip(1)
                .map(|(distance, weight)| {
                    let left = row[(column + SIDE - distance) % SIDE];
                    weight * (left + row[(column + distance) % SIDE])
                })
                .sum();
            blurred.push(sum + window[0] * row[column]);
        }
    }
    blurred
}

fn transposed(pattern: &[f64]) -> Vec<f64> {
    (0..SIDE * SIDE)
        .map(|index| pattern[(index % SIDE) * SIDE + index / SIDE])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Random};

    fn stream() -> Stream {
        Random::new(5).stream(Purpose::Texture, 0)
    }

    #[test]
    fn texels_come_back_at_their_places_and_the_pattern_repeats() {
        let layer = smooth_noise(&stream(), 0, 2.0);
        let texture = Texture::new(0.5, std::slice::from_ref(&layer));
        for (column, row) in [(0_u16, 0_u16), (5, 7), (127, 127)] {
            let [x, y] = [column, row].map(|texel| f32::from(texel) * 0.5);
            let expected = layer[usize::from(row) * SIDE + usize::from(column)];
            for around in [0.0, 64.0, -64.0] {
                let found = texture.at(x + around, y - around)[0];
                assert!((found - expected).abs() < 1e-5, "{found} {expected}");
            }
        }
    }

    #[test]
    fn between_texels_it_is_linear() {
        let texture = Texture::new(1.0, &[smooth_noise(&stream(), 0, 2.0)]);
        let [left, middle, right] = [3.0, 3.25, 4.0].map(|x| texture.at(x, 9.0)[0]);
        assert!((middle - (0.75 * left + 0.25 * right)).abs() < 1e-5);
    }

    #[test]
    fn neighbours_resemble_each_other_as_the_window_says() {
        let sigma = 2.0;
        let layer = smooth_noise(&stream(), 1, sigma);
        let product: f32 = (0..SIDE * SIDE)
            .map(|index| layer[index] * layer[index - index % SIDE + (index + 2) % SIDE])
            .sum();
        // The correlation of Gaussian windows a distance d apart: exp(−d²/4σ²).
        let expected = libm::exp(-0.25 * (2.0 / sigma) * (2.0 / sigma));
        let found = f64::from(product) / count(SIDE * SIDE);
        assert!((found - expected).abs() < 0.05, "{found} {expected}");
    }
}
