//! The fitted parameters of a library's model as tensors with names.

use safetensors::tensor::Dtype;
use taceva_core::{ErrorKind, ModelError};

use crate::training::file::tensors::{Raw, Tensors};

/// Before the names of tensors that are a library's parameters.
const PREFIX: &str = "library.model.";

/// A tensor: its name, its shape and its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryTensor {
    /// The name, within the model.
    pub name: String,
    /// The length of each dimension.
    pub shape: Vec<usize>,
    /// As many numbers as the shape has places.
    pub numbers: Numbers,
}

/// Numbers of one kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// In double precision.
    Doubles(Vec<f64>),
    /// In single precision.
    Singles(Vec<f32>),
    /// Not negative.
    Integers(Vec<u32>),
}

impl LibraryTensor {
    /// A tensor of doubles.
    pub fn doubles(name: &str, shape: Vec<usize>, values: Vec<f64>) -> LibraryTensor {
        LibraryTensor {
            name: name.to_owned(),
            shape,
            numbers: Numbers::Doubles(values),
        }
    }

    /// A tensor of singles.
    pub fn singles(name: &str, shape: Vec<usize>, values: Vec<f32>) -> LibraryTensor {
        LibraryTensor {
            name: name.to_owned(),
            shape,
            numbers: Numbers::Singles(values),
        }
    }

    /// A tensor of integers.
    pub fn integers(name: &str, shape: Vec<usize>, values: Vec<u32>) -> LibraryTensor {
        LibraryTensor {
            name: name.to_owned(),
            shape,
            numbers: Numbers::Integers(values),
        }
    }

    pub(crate) fn raw(&self) -> Raw {
        let (name, shape) = (format!("{PREFIX}{}", self.name), self.shape.clone());
        match &self.numbers {
            Numbers::Doubles(values) => Raw::doubles(&name, shape, values),
            Numbers::Singles(values) => Raw::singles(&name, shape, values),
            Numbers::Integers(values) => Raw::integers(&name, shape, values),
        }
    }
}

/// The tensors that a file keeps of a library's model.
#[derive(Clone, Debug, Default)]
pub struct LibraryTensors(Vec<LibraryTensor>);

impl LibraryTensors {
    /// These tensors.
    pub fn new(tensors: Vec<LibraryTensor>) -> LibraryTensors {
        LibraryTensors(tensors)
    }

    pub(crate) fn read(tensors: &Tensors<'_>) -> LibraryTensors {
        let own = tensors.0.tensors().into_iter();
        let own = own.filter_map(|(name, view)| {
            let name = name.strip_prefix(PREFIX)?.to_owned();
            let data = view.data();
            let numbers = match view.dtype() {
                Dtype::F64 => Numbers::Doubles(
                    (data.as_chunks::<8>().0.iter())
                        .map(|bytes| f64::from_le_bytes(*bytes))
                        .collect(),
                ),
                Dtype::F32 => Numbers::Singles(
                    (data.as_chunks::<4>().0.iter())
                        .map(|bytes| f32::from_le_bytes(*bytes))
                        .collect(),
                ),
                Dtype::U32 => Numbers::Integers(
                    (data.as_chunks::<4>().0.iter())
                        .map(|bytes| u32::from_le_bytes(*bytes))
                        .collect(),
                ),
                _ => return None,
            };
            let shape = view.shape().to_vec();
            Some(LibraryTensor {
                name,
                shape,
                numbers,
            })
        });
        LibraryTensors(own.collect())
    }

    /// The first length of the shape of `name`.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if there is no such tensor, or it is a number.
    pub fn rows(&self, name: &str) -> Result<usize, ModelError> {
        let shape = &self.tensor(name)?.shape;
        shape.first().copied().ok_or_else(|| wrong(name, "rows"))
    }

    /// The doubles of `name`, all finite.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if there is no such tensor, it has another shape, or a number is not finite.
    pub fn doubles(&self, name: &str, shape: &[usize]) -> Result<Vec<f64>, ModelError> {
        let tensor = self.tensor(name)?;
        match &tensor.numbers {
            Numbers::Doubles(values)
                if tensor.shape == shape && values.iter().all(|value| value.is_finite()) =>
            {
                Ok(values.clone())
            }
            _ => Err(wrong(name, "finite doubles of the shape of the model")),
        }
    }

    /// The singles of `name`, all finite.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if there is no such tensor, it has another shape, or a number is not finite.
    pub fn singles(&self, name: &str, shape: &[usize]) -> Result<Vec<f32>, ModelError> {
        let tensor = self.tensor(name)?;
        match &tensor.numbers {
            Numbers::Singles(values)
                if tensor.shape == shape && values.iter().all(|value| value.is_finite()) =>
            {
                Ok(values.clone())
            }
            _ => Err(wrong(name, "finite singles of the shape of the model")),
        }
    }

    /// The integers of `name`.
    ///
    /// # Errors
    /// [`ModelError`] of kind `Protocol` if there is no such tensor, or it has another shape.
    pub fn integers(&self, name: &str, shape: &[usize]) -> Result<Vec<u32>, ModelError> {
        let tensor = self.tensor(name)?;
        match &tensor.numbers {
            Numbers::Integers(values) if tensor.shape == shape => Ok(values.clone()),
            _ => Err(wrong(name, "integers of the shape of the model")),
        }
    }

    fn tensor(&self, name: &str) -> Result<&LibraryTensor, ModelError> {
        let found = self.0.iter().find(|tensor| tensor.name == name);
        found.ok_or_else(|| wrong(name, "a tensor of that name"))
    }
}

fn wrong(name: &str, expected: &str) -> ModelError {
    let why = format!("tensor `{PREFIX}{name}`: expected {expected}");
    ModelError::new(ErrorKind::Protocol, why)
}
