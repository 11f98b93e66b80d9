//! Smooth periodic random patterns: speckle, unevenness of a coating, buckling of a lattice.

use super::simd::Lanes;
use crate::number::{count, narrow};
use crate::random::Stream;

/// Pattern on a torus of texels. Each texel has four values, with linear interpolation between texels.
#[derive(Clone, Debug)]
pub(super) struct Texture {
    cells: Box<[Cell; SIDE * SIDE]>,
    texels_per_unit: f32,
}

/// Interpolation data of a place between four texels, in one cache line. Holds the first texel, its differences to the next texel in the row and to
/// the texel above, and the mixed difference.
type Cell = [[f32; 4]; 4];

/// Side of a texture in texels; a power of two.
pub(super) const SIDE: usize = 1 << SIDE_BITS;
const SIDE_BITS: i32 = 7;
/// Constant for rounding. The sum of a value from −2²¹ to 2²¹ and this constant has the nearest integer in the low bits.
const ROUND: f32 = 12_582_912.0;

impl Texture {
    /// Creates a texture of `layers`. `pitch` is the distance between texels, in the unit of the field of view.
    pub(super) fn new(pitch: f64, layers: &[Vec<f32>]) -> Texture {
        let texel = |row: usize, column: usize| {
            let index = row % SIDE * SIDE + column % SIDE;
            std::array::from_fn(|lane| layers.get(lane).map_or(0.0, |layer| layer[index]))
        };
        let cells: Vec<Cell> = (0..SIDE * SIDE)
            .map(|index| {
                let (row, column) = (index / SIDE, index % SIDE);
                cell_of(
                    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(up, on)| texel(row + up, column + on)),
                )
            })
            .collect();
        Texture {
            cells: cells.try_into().expect("as many cells as requested"),
            texels_per_unit: narrow(1.0 / pitch),
        }
    }

    /// Four values at the place `x`, `y`, which has the unit of the field of view.
    #[inline(always)]
    pub(super) fn at(&self, x: f32, y: f32) -> [f32; 4] {
        let places = Places::of(Lanes::splat(x), Lanes::splat(y), self.texels_per_unit);
        self.between(&places, 0).to_array()
    }

    /// Sum of three textures with the same pitch, each at the place in its lane. Ignores the fourth lane of the places.
    #[inline(always)]
    pub(super) fn sum_at(layers: &[Texture; 3], x: Lanes, y: Lanes) -> Lanes {
        let places = Places::of(x, y, layers[0].texels_per_unit);
        let value = |layer: usize| layers[layer].between(&places, layer);
        value(0).plus(value(1)).plus(value(2))
    }

    /// First two values of the texel nearest to a place.
    #[inline(always)]
    pub(super) fn near(&self, x: f32, y: f32) -> [f32; 2] {
        let nearest = |place: f32| Lanes::splat(place * self.texels_per_unit + ROUND);
        let [index, ..] = nearest(x).joined_with::<SIDE_BITS>(nearest(y));
        let [[first, second, ..], ..] = self.cell(index);
        [*first, *second]
    }

    /// Values at the place in a lane of `places`.
    #[inline(always)]
    fn between(&self, places: &Places, lane: usize) -> Lanes {
        let [first, on, up, both] = self.cell(places.index[lane]).map(Lanes::new);
        let across = Lanes::splat(places.across[lane]);
        let rise = up.plus(across.times(both));
        first
            .plus(across.times(on))
            .plus(Lanes::splat(places.up[lane]).times(rise))
    }

    #[inline(always)]
    fn cell(&self, index: u32) -> &Cell {
        // The index has no more bits than there are cells. The mask tells this to the compiler.
        &self.cells[index as usize & (SIDE * SIDE - 1)]
    }
}

/// Builds the cell of a texel from the next texel in its row, the texel above and the diagonal texel.
fn cell_of([first, next, above, beside]: [[f32; 4]; 4]) -> Cell {
    let lanes = |value: fn(f32, f32, f32, f32) -> f32| {
        std::array::from_fn(|lane| value(first[lane], next[lane], above[lane], beside[lane]))
    };
    [
        first,
        lanes(|first, next, _, _| next - first),
        lanes(|first, _, above, _| above - first),
        lanes(|first, next, above, beside| (beside - above) - (next - first)),
    ]
}

/// Cell and fraction of the place in each lane, on a torus.
struct Places {
    index: [u32; 4],
    across: [f32; 4],
    up: [f32; 4],
}

impl Places {
    #[inline(always)]
    fn of(x: Lanes, y: Lanes, texels_per_unit: f32) -> Places {
        let [x, y] = [x, y].map(|places| places.times(Lanes::splat(texels_per_unit)));
        // The integer nearest to place − ½ is the integer below the place. A tie makes the fraction 0 or 1, which is the same point.
        let round = Lanes::splat(ROUND);
        let [column, row] = [x, y].map(|places| places.minus(Lanes::splat(0.5)).plus(round));
        Places {
            index: column.joined_with::<SIDE_BITS>(row),
            across: x.minus(column.minus(round)).to_array(),
            up: y.minus(row.minus(round)).to_array(),
        }
    }
}

/// Pattern of mean 0 and standard deviation 1 that varies over `sigma` texels, row by row.
///
/// White noise, smoothed by a periodic Gaussian window of standard deviation `sigma`.
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

/// Weights of a Gaussian with a standard deviation of `sigma` texels, from its centre outwards.
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
        // Correlation of Gaussian windows at a distance d: exp(−d²/4σ²).
        let expected = libm::exp(-0.25 * (2.0 / sigma) * (2.0 / sigma));
        let found = f64::from(product) / count(SIDE * SIDE);
        assert!((found - expected).abs() < 0.05, "{found} {expected}");
    }
}
