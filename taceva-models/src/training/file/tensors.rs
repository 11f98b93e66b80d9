//! Tensors of a model file. They are written in the order of their names, and read by name, type and shape.

use safetensors::tensor::{Dtype, SafeTensors, TensorView};

use crate::training::file::error::FormatError;

/// Name of the tensor with the principal directions of the training features.
pub(crate) const DIRECTIONS: &str = "distance.directions";
/// Name of the tensor with the mean of the training features.
pub(crate) const MEAN: &str = "distance.mean";
/// Name of the tensor with the standard deviations of the training features along their principal directions.
pub(crate) const DEVIATIONS: &str = "distance.deviations";
/// Names of the tensors that describe the training features, for the distance of a sample from them.
pub(crate) const DISTANCE: [&str; 3] = [DIRECTIONS, MEAN, DEVIATIONS];

/// A tensor as stored in a file.
#[derive(Debug, PartialEq)]
pub(crate) struct Raw {
    pub(crate) name: String,
    pub(crate) kind: Dtype,
    pub(crate) shape: Vec<usize>,
    pub(crate) bytes: Vec<u8>,
}

impl Raw {
    pub(crate) fn doubles(name: &str, shape: Vec<usize>, values: &[f64]) -> Raw {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        Raw::of(name, Dtype::F64, shape, bytes.collect())
    }

    pub(crate) fn singles(name: &str, shape: Vec<usize>, values: &[f32]) -> Raw {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        Raw::of(name, Dtype::F32, shape, bytes.collect())
    }

    pub(crate) fn integers(name: &str, shape: Vec<usize>, values: &[u32]) -> Raw {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        Raw::of(name, Dtype::U32, shape, bytes.collect())
    }

    fn of(name: &str, kind: Dtype, shape: Vec<usize>, bytes: Vec<u8>) -> Raw {
        Raw {
            name: name.to_owned(),
            kind,
            shape,
            bytes,
        }
    }
}

/// Tensors of a file that is being read.
pub(crate) struct Tensors<'a>(pub(crate) SafeTensors<'a>);

impl<'a> Tensors<'a> {
    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.tensor(name).is_ok()
    }

    /// Returns an error if the file has a tensor that is not in `known`. Tensors in [`DISTANCE`] are allowed, because they are read separately.
    pub(crate) fn only(&self, known: &[&str]) -> Result<(), FormatError> {
        let mut names = self.0.names().into_iter();
        match names.find(|name| !known.contains(name) && !DISTANCE.contains(name)) {
            None => Ok(()),
            Some(name) => Err(FormatError::Unexpected {
                name: name.to_owned(),
            }),
        }
    }

    /// Size of the first dimension of the tensor `name`.
    pub(crate) fn rows(&self, name: &'static str) -> Result<usize, FormatError> {
        let tensor = self.0.tensor(name);
        let tensor = tensor.map_err(|_| FormatError::Missing { name })?;
        tensor.shape().first().copied().ok_or(FormatError::Card)
    }

    pub(crate) fn doubles(
        &self,
        name: &'static str,
        shape: &[usize],
    ) -> Result<Vec<f64>, FormatError> {
        let tensor = self.tensor(name, Dtype::F64, shape)?;
        let (numbers, _) = tensor.data().as_chunks::<8>();
        Ok(numbers
            .iter()
            .map(|bytes| f64::from_le_bytes(*bytes))
            .collect())
    }

    pub(crate) fn singles(
        &self,
        name: &'static str,
        shape: &[usize],
    ) -> Result<Vec<f32>, FormatError> {
        let tensor = self.tensor(name, Dtype::F32, shape)?;
        let (numbers, _) = tensor.data().as_chunks::<4>();
        Ok(numbers
            .iter()
            .map(|bytes| f32::from_le_bytes(*bytes))
            .collect())
    }

    pub(crate) fn integers(
        &self,
        name: &'static str,
        shape: &[usize],
    ) -> Result<Vec<u32>, FormatError> {
        let tensor = self.tensor(name, Dtype::U32, shape)?;
        let (numbers, _) = tensor.data().as_chunks::<4>();
        Ok(numbers
            .iter()
            .map(|bytes| u32::from_le_bytes(*bytes))
            .collect())
    }

    fn tensor(
        &self,
        name: &'static str,
        kind: Dtype,
        shape: &[usize],
    ) -> Result<TensorView<'a>, FormatError> {
        let tensor = self.0.tensor(name);
        let tensor = tensor.map_err(|_| FormatError::Missing { name })?;
        if tensor.dtype() != kind || tensor.shape() != shape {
            return Err(FormatError::Tensor {
                name,
                found: format!("{:?} {:?}", tensor.dtype(), tensor.shape()),
                expected: format!("{kind:?} {shape:?}"),
            });
        }
        Ok(tensor)
    }
}
