//! Parts of what is too much at once, and of what is too little to keep a GPU busy.

use burn_tensor::Tensor;
use burn_tensor::backend::Backend;

/// Tiles of 64 × 64 that a GPU is busy with: products of fewer are formed in parts, which are added up.
const BUSY: usize = 512;

/// Numbers of a window that stay together.
pub(crate) const LINE: usize = 32;

/// Products that a part of a sum has at least.
const LEAST: usize = 128;

/// In how many equal parts sums of `length` products are formed for a matrix of `size`, so that the GPU is busy; each of whole lines.
pub(crate) fn stack(length: usize, line: usize, [rows, columns]: [usize; 2]) -> usize {
    let tiles = rows.div_ceil(64) * columns.div_ceil(64);
    let wanted = (BUSY / tiles).min(length / LEAST).max(1);
    let mut fitting = (1..=wanted).rev();
    fitting
        .find(|parts| length.is_multiple_of(parts * line))
        .unwrap_or(1)
}

/// `pictures`, at most `most` at once.
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

/// `parts` one behind the other.
pub(crate) fn together<B: Backend>(mut parts: Vec<Tensor<B, 3>>, along: usize) -> Tensor<B, 3> {
    match parts.len() {
        1 => parts.remove(0),
        _ => Tensor::cat(parts, along),
    }
}

/// The sum of a stack.
pub(crate) fn added<B: Backend>(stack: Tensor<B, 3>) -> Tensor<B, 3> {
    match stack.dims() {
        [1, ..] => stack,
        _ => stack.sum_dim(0),
    }
}
