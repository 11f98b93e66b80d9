//! Products of matrices in single precision.
//!
//! burn multiplies by whatever is fastest, which on NVIDIA's GPUs is tensor cores: they round both sides to TF32, eleven bits. Here every
//! product is formed by the ordinary units, of f32 and in f32.

use burn_cubecl::cubecl::server::ComputeServer;
use burn_cubecl::ops::numeric::empty_device_contiguous_dtype;
use burn_cubecl::{BoolElement, CubeBackend, CubeRuntime, IntElement};
use burn_tensor::backend::{Backend, DeviceOps};
use burn_tensor::{Tensor, TensorPrimitive};
use cubek::matmul::definition::{MatmulElems, MatmulGlobalElems};
use cubek::matmul::launch::{Strategy, launch_ref};
use cubek::std::InputBinding;

/// A backend that multiplies matrices in single precision.
pub(crate) trait Products: Backend {
    /// `left` times `right`, for each matrix of a stack.
    ///
    /// # Shapes
    /// `left`: `[stack, rows, inner]`; `right`: `[stack, inner, columns]`; the product: `[stack, rows, columns]`.
    fn product(left: Tensor<Self, 3>, right: Tensor<Self, 3>) -> Tensor<Self, 3>;
}

impl<R, I, B> Products for CubeBackend<R, f32, I, B>
where
    R: CubeRuntime,
    R::Server: ComputeServer,
    R::Device: DeviceOps,
    I: IntElement,
    B: BoolElement,
{
    fn product(left: Tensor<Self, 3>, right: Tensor<Self, 3>) -> Tensor<Self, 3> {
        let ([stack, rows, _], [.., columns]) = (left.dims(), right.dims());
        let [left, right] = [left, right].map(|side| side.into_primitive().tensor());
        let (client, element) = (left.client.clone(), left.dtype.into());
        let product = empty_device_contiguous_dtype(
            client.clone(),
            left.device.clone(),
            [stack, rows, columns].into(),
            left.dtype,
        );
        let [left, right] =
            [left, right].map(|side| InputBinding::new(side.binding(), element));
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
        let made = multiply(&Strategy::SimpleUnit(Default::default()));
        let made = made.or_else(|_| multiply(&Strategy::Naive));
        made.expect("matrices of fitting sizes");
        Tensor::from_primitive(TensorPrimitive::Float(product))
    }
}
