//! Matrix products in single precision.
//!
//! All products are computed by ordinary units in f32. By default, burn chooses the fastest algorithm. On NVIDIA GPUs, this algorithm uses tensor cores, which
//! round both factors to TF32 (eleven bits).

use burn_cubecl::cubecl::server::ComputeServer;
use burn_cubecl::ops::numeric::empty_device_contiguous_dtype;
use burn_cubecl::{BoolElement, CubeBackend, CubeRuntime, IntElement};
use burn_tensor::backend::{Backend, DeviceOps};
use burn_tensor::{Tensor, TensorPrimitive};
use cubek::matmul::definition::{MatmulElems, MatmulGlobalElems};
use cubek::matmul::launch::{Strategy, launch_ref};
use cubek::matmul::routines::double_unit::DoubleUnitSelectionArgs;
use cubek::matmul::routines::{BlueprintStrategy, TileSizeSelection};
use cubek::std::InputBinding;

/// A backend that multiplies matrices in single precision.
pub(crate) trait Products: Backend {
    /// Multiplies `left` by `right`, matrix by matrix of the stack.
    ///
    /// # Shapes
    /// `left`: `[stack, rows, inner]`. `right`: `[stack, inner, columns]`. Returns `[stack, rows, columns]`.
    fn product(left: Tensor<Self, 3>, right: Tensor<Self, 3>) -> Tensor<Self, 3>;
}

/// Minimum number of products per sum for double buffering. Double buffering is faster, but makes cubek 0.2 compute shorter sums wrongly.
const LONG: usize = 128;

impl<R, I, B> Products for CubeBackend<R, f32, I, B>
where
    R: CubeRuntime,
    R::Server: ComputeServer,
    R::Device: DeviceOps,
    I: IntElement,
    B: BoolElement,
{
    fn product(left: Tensor<Self, 3>, right: Tensor<Self, 3>) -> Tensor<Self, 3> {
        let ([stack, rows, inner], [.., columns]) = (left.dims(), right.dims());
        let [left, right] = [left, right].map(|side| side.into_primitive().tensor());
        let (client, element) = (left.client.clone(), left.dtype.into());
        let product = empty_device_contiguous_dtype(
            client.clone(),
            left.device.clone(),
            [stack, rows, columns].into(),
            left.dtype,
        );
        let [left, right] = [left, right].map(|side| InputBinding::new(side.binding(), element));
        let multiply = |strategy: &Strategy| {
            let mut elements = MatmulElems::from_globals(&MatmulGlobalElems {
                lhs: element,
                rhs: element,
                out: element,
            });
            let (left, right) = (left.clone(), right.clone());
            let into = product.clone().binding();
            launch_ref(strategy, &client, left, right, into, &mut elements)
        };
        let tile_size = TileSizeSelection::MinTileSize;
        let double = BlueprintStrategy::Inferred(DoubleUnitSelectionArgs { tile_size });
        let simple = Strategy::SimpleUnit(Default::default());
        let made = match inner {
            LONG.. => multiply(&Strategy::DoubleUnit(double)).or_else(|_| multiply(&simple)),
            _ => multiply(&simple),
        };
        let made = made.or_else(|_| multiply(&Strategy::Naive));
        made.expect("product of matrices whose sizes match");
        Tensor::from_primitive(TensorPrimitive::Float(product))
    }
}

#[cfg(test)]
mod tests {
    use super::{LONG, Products};
    use crate::gpu::devices::on_each;
    use burn_tensor::{Tensor, TensorData};

    /// Sizes for tests, `[stack, rows, inner, columns]`.
    const SIZES: [[usize; 4]; 12] = [
        [1, 1, 512, 6],
        [1, 3, 1, 5],
        [1, 6, 8, 96],
        [1, 432, 1, 64],
        [4, 432, 18, 64],
        [1, 72, 75, 16],
        [1, 130, 147, 64],
        [3, 65, LONG - 1, 33],
        [3, 65, LONG, 33],
        [2, 64, LONG + 1, 48],
        [8, 100, 144, 512],
        [1, 1, 4608, 1],
    ];

    fn numbers(count: usize, seed: u32) -> Vec<f32> {
        let mut state = seed;
        let next = |_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f32::from(u16::try_from(state >> 16).expect("sixteen bits")) / 32_768.0 - 1.0
        };
        (0..count).map(next).collect()
    }

    fn check<B: Products>() {
        let device = B::Device::default();
        let tensor = |values: &[f32], shape: [usize; 3]| {
            Tensor::<B, 3>::from_data(TensorData::new(values.to_vec(), shape), &device)
        };
        for [stack, rows, inner, columns] in SIZES {
            let left = numbers(stack * rows * inner, 1);
            let right = numbers(stack * inner * columns, 2);
            let right_there = tensor(&right, [stack, inner, columns]);
            // Plain, transposed, and with a part of each row as a matrix of the stack, as in convolutions.
            let plain = tensor(&left, [stack, rows, inner]);
            let turned = plain
                .clone()
                .swap_dims(1, 2)
                .reshape([stack * inner * rows]);
            let turned = turned.reshape([stack, inner, rows]).swap_dims(1, 2);
            let parted = plain
                .clone()
                .swap_dims(0, 1)
                .reshape([rows * stack * inner]);
            let parted = parted.reshape([rows, stack, inner]).swap_dims(0, 1);
            for (how, left_there) in [("plain", plain), ("turned", turned), ("parted", parted)] {
                let found = B::product(left_there, right_there.clone()).into_data();
                let found: Vec<f32> = found.iter::<f32>().collect();
                let mut far = 0.0_f64;
                for (at, found) in found.iter().enumerate() {
                    let (row, column) = (at / columns, at % columns);
                    let first = row / rows * inner * columns + column;
                    let terms = (0..inner).map(|term| {
                        let right = right[first + term * columns];
                        f64::from(left[row * inner + term]) * f64::from(right)
                    });
                    far = far.max((f64::from(*found) - terms.sum::<f64>()).abs());
                }
                let error = far / (inner as f64).sqrt();
                let size = [stack, rows, inner, columns];
                assert!(error < 1e-5, "{size:?}, {how}: {error:e}");
            }
        }
    }

    #[test]
    fn products_of_every_size_are_those_of_f32() {
        on_each!(check);
    }
}
