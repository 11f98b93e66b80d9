//! Matrix products and Gram matrices.

use std::ops::Range;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use rayon::prelude::*;
use taceva_core::{ModelError, Progress};

use super::design::Design;
use crate::linalg::progress::{ReportedStage, interrupted};

/// Rows and columns of a tile of a Gram matrix.
const TILE: usize = 256;

/// Number of samples or features converted to 64 bits at a time.
const SLAB: usize = 1024;

/// Product of `left` and `right`, computed by the calling thread.
pub(crate) fn multiply(left: MatRef<'_, f64>, right: MatRef<'_, f64>) -> Mat<f64> {
    let mut product = Mat::zeros(left.nrows(), right.ncols());
    matmul(&mut product, Accum::Replace, left, right, 1.0, Par::Seq);
    product
}

/// Adds the product of `left` and `right` to `sums`, in the calling thread.
pub(super) fn add_product(sums: &mut Mat<f64>, left: MatRef<'_, f64>, right: MatRef<'_, f64>) {
    matmul(sums, Accum::Add, left, right, 1.0, Par::Seq);
}

/// Splits `length` samples or features into ranges that are summed in one step each.
pub(super) fn slabs(length: usize) -> impl Iterator<Item = Range<usize>> {
    (0..length)
        .step_by(SLAB)
        .map(move |start| start..length.min(start + SLAB))
}

/// Kind of Gram matrix of a design matrix X.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// X Xᵀ, with one row and column per sample.
    Samples,
    /// Xᵀ X, with one row and column per feature.
    Features,
}

/// Gram matrix of `design`. Only the lower triangle is filled.
pub(super) fn gram(
    design: &Design<'_>,
    side: Side,
    progress: &dyn Progress,
) -> Result<Mat<f64>, ModelError> {
    let (size, depth) = match side {
        Side::Samples => (design.samples(), design.width()),
        Side::Features => (design.width(), design.samples()),
    };
    let mut tiles = lower_tiles(size);
    let stage = ReportedStage::begin(progress, "products of features", depth.div_ceil(SLAB));
    for slab in slabs(depth) {
        match side {
            Side::Samples => {
                let block = design.block(0..size, slab);
                add_outer(&mut tiles, block.transpose());
            }
            Side::Features => {
                let block = design.block(slab, 0..size);
                add_outer(&mut tiles, block.as_ref());
            }
        }
        stage.advance();
        interrupted(progress)?;
    }
    let mut whole = Mat::zeros(size, size);
    for Tile { row, column, sums } in &tiles {
        whole
            .submatrix_mut(*row, *column, sums.nrows(), sums.ncols())
            .copy_from(sums);
    }
    Ok(whole)
}

/// Gram matrix Xᵀ X of `design`, with both triangles filled.
pub(crate) fn feature_gram(
    design: &Design<'_>,
    progress: &dyn Progress,
) -> Result<Mat<f64>, ModelError> {
    let mut whole = gram(design, Side::Features, progress)?;
    for column in 0..whole.ncols() {
        for row in column + 1..whole.nrows() {
            whole[(column, row)] = whole[(row, column)];
        }
    }
    Ok(whole)
}

struct Tile {
    row: usize,
    column: usize,
    sums: Mat<f64>,
}

fn lower_tiles(size: usize) -> Vec<Tile> {
    let starts = || (0..size).step_by(TILE);
    let length = |start: usize| TILE.min(size - start);
    starts()
        .flat_map(|row| {
            starts()
                .take_while(move |&column| column <= row)
                .map(move |column| Tile {
                    row,
                    column,
                    sums: Mat::zeros(length(row), length(column)),
                })
        })
        .collect()
}

/// Adds the product of `slab` and its transpose to the sums of `tiles`.
fn add_outer(tiles: &mut [Tile], slab: MatRef<'_, f64>) {
    tiles.par_iter_mut().for_each(|tile| {
        let left = slab.subrows(tile.row, tile.sums.nrows());
        let right = slab.subrows(tile.column, tile.sums.ncols());
        add_product(&mut tile.sums, left, right.transpose());
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::FeatureScale;
    use taceva_core::{FeatureShape, Features, SilentProgress};

    #[test]
    fn tiles_and_slabs_make_the_whole_product() {
        let (samples, width) = (300, 1100);
        let mut random = taceva_core::random::SplitMix64::new(3);
        let values = (0..samples * width)
            .map(|_| f32::from(random.next_u64().to_le_bytes()[0]))
            .collect();
        let features = Features::new(FeatureShape::flat(width), values).expect("whole");
        let design = Design::new(&features, FeatureScale::None);
        let plain = design.block(0..samples, 0..width);
        for (side, expected) in [
            (Side::Samples, multiply(plain.transpose(), plain.as_ref())),
            (Side::Features, multiply(plain.as_ref(), plain.transpose())),
        ] {
            let found = gram(&design, side, &SilentProgress).expect("not cancelled");
            for column in 0..found.ncols() {
                for row in column..found.nrows() {
                    let (found, expected) = (found[(row, column)], expected[(row, column)]);
                    // Sums of at most 1100 products below 2^16: 1100 roundings of 2^27.
                    assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
                }
            }
        }
    }
}
