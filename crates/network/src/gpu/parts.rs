//! Divides work that exceeds the memory limit, and sums with too few outputs to occupy a GPU.

use burn_tensor::Tensor;
use burn_tensor::backend::Backend;

/// Number of tiles of 64 × 64 that occupy a GPU. Products with fewer tiles are computed in parts, which are then added.
const BUSY: usize = 512;

/// Number of consecutive values of a window that a division into parts keeps together.
pub(crate) const LINE: usize = 32;

/// Minimum number of products in a part of a sum.
const LEAST: usize = 128;

/// Number of equal parts of each sum of `length` products in a matrix of `rows` × `columns`, to occupy the GPU. With several parts, the length of
/// each is a multiple of `line`.
pub(crate) fn stack(length: usize, line: usize, [rows, columns]: [usize; 2]) -> usize {
    let tiles = rows.div_ceil(64) * columns.div_ceil(64);
    let wanted = (BUSY / tiles).min(length / LEAST).max(1);
    let mut fitting = (1..=wanted).rev();
    fitting
        .find(|parts| length.is_multiple_of(parts * line))
        .unwrap_or(1)
}

/// Divides `pictures` into batches of at most `most` pictures.
pub(crate) fn split<B: Backend>(
    pictures: Tensor<B, 4>,
    most: usize,
) -> impl Iterator<Item = Tensor<B, 4>> {
    let [samples, ..] = pictures.dims();
    (0..samples).step_by(most).map(move |start| {
        if samples <= most {
            pictures.clone()
        } else {
            let range = start..samples.min(start + most);
            pictures.clone().slice([range])
        }
    })
}

/// Concatenates `parts` along the dimension `along`.
pub(crate) fn together<B: Backend>(mut parts: Vec<Tensor<B, 3>>, along: usize) -> Tensor<B, 3> {
    match parts.len() {
        1 => parts.remove(0),
        _ => Tensor::cat(parts, along),
    }
}

/// Sum over the first dimension.
pub(crate) fn added<B: Backend>(stack: Tensor<B, 3>) -> Tensor<B, 3> {
    match stack.dims() {
        [1, ..] => stack,
        _ => stack.sum_dim(0),
    }
}
