//! Storage of the parameters of library models as tensors of a model file. Their names have a common prefix.

use safetensors::tensor::{Dtype, TensorView};
use taceva_core::{ErrorKind, ModelError};

use crate::training::file::tensors::{Raw, Tensors};

/// Prefix of the tensor names.
const PREFIX: &str = "library.model.";

/// Adds the prefix to the name of `tensor`.
pub(super) fn prefixed(tensor: Raw) -> Raw {
    Raw {
        name: format!("{PREFIX}{}", tensor.name),
        ..tensor
    }
}

/// Tensors of a library model in a file. Callers give names without the prefix.
pub(crate) struct LibraryTensors<'a>(pub(super) &'a Tensors<'a>);

impl<'a> LibraryTensors<'a> {
    /// Size of the first dimension of the tensor `name`.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if the tensor is missing or a scalar.
    pub(crate) fn rows(&self, name: &str) -> Result<usize, ModelError> {
        let rows = self.tensor(name)?.shape().first().copied();
        rows.ok_or_else(|| wrong(name, "rows"))
    }

    /// Values of the f64 tensor `name`. All values are finite.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if the tensor is missing, of another type or shape, or not finite.
    pub(crate) fn doubles(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, ModelError> {
        let expected = "finite doubles of the shape of the model";
        let bytes = self.bytes(name, Dtype::F64, shape, expected)?;
        let numbers = bytes.as_chunks::<8>().0.iter();
        let values: Vec<f64> = numbers.map(|bytes| f64::from_le_bytes(*bytes)).collect();
        let is_finite = values.iter().all(|value| value.is_finite());
        is_finite
            .then_some(values)
            .ok_or_else(|| wrong(name, expected))
    }

    /// Values of the f32 tensor `name`. All values are finite.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if the tensor is missing, of another type or shape, or not finite.
    pub(crate) fn singles(&self, name: &str, shape: &[usize]) -> Result<Vec<f32>, ModelError> {
        let expected = "finite singles of the shape of the model";
        let bytes = self.bytes(name, Dtype::F32, shape, expected)?;
        let numbers = bytes.as_chunks::<4>().0.iter();
        let values: Vec<f32> = numbers.map(|bytes| f32::from_le_bytes(*bytes)).collect();
        let is_finite = values.iter().all(|value| value.is_finite());
        is_finite
            .then_some(values)
            .ok_or_else(|| wrong(name, expected))
    }

    /// Values of the u32 tensor `name`.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if the tensor is missing, or of another type or shape.
    pub(crate) fn integers(&self, name: &str, shape: &[usize]) -> Result<Vec<u32>, ModelError> {
        let expected = "integers of the shape of the model";
        let bytes = self.bytes(name, Dtype::U32, shape, expected)?;
        let numbers = bytes.as_chunks::<4>().0.iter();
        Ok(numbers.map(|bytes| u32::from_le_bytes(*bytes)).collect())
    }

    fn bytes(
        &self,
        name: &str,
        kind: Dtype,
        shape: &[usize],
        expected: &str,
    ) -> Result<&'a [u8], ModelError> {
        let tensor = self.tensor(name)?;
        match tensor.dtype() == kind && tensor.shape() == shape {
            true => Ok(tensor.data()),
            false => Err(wrong(name, expected)),
        }
    }

    fn tensor(&self, name: &str) -> Result<TensorView<'a>, ModelError> {
        let tensor = self.0.0.tensor(&format!("{PREFIX}{name}"));
        tensor.map_err(|_| wrong(name, "a tensor of that name"))
    }
}

fn wrong(name: &str, expected: &str) -> ModelError {
    let why = format!("tensor `{PREFIX}{name}`: expected {expected}");
    ModelError::new(ErrorKind::Protocol, why)
}
