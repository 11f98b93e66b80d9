//! Values of a pickle. Values refer to one another by number and own no other values, so deep nesting causes no recursion.

use std::sync::Arc;

use crate::fields::Item;
use crate::scalar::Scalar;

/// Number that identifies a value.
pub(crate) type Id = u32;

/// Bytes of a pickle.
#[derive(Clone, Debug)]
pub(crate) enum Bytes {
    /// Bytes in the file, which are not read yet.
    InFile { at: u64, length: u64 },
    /// Bytes in memory. A pickle of protocol 2 writes bytes as text, which was converted.
    Held(Arc<Vec<u8>>),
}

impl Bytes {
    pub(crate) fn length(&self) -> u64 {
        match self {
            Bytes::InFile { length, .. } => *length,
            Bytes::Held(bytes) => bytes.len() as u64,
        }
    }
}

/// NumPy array.
#[derive(Clone, Debug)]
pub(crate) struct PickledArray {
    pub(crate) shape: Vec<u64>,
    pub(crate) is_fortran: bool,
    pub(crate) content: Content,
}

/// Elements of an array.
#[derive(Clone, Debug)]
pub(crate) enum Content {
    /// No elements yet, because the array is under construction.
    Nothing,
    Numbers {
        item: Item,
        bytes: Bytes,
    },
    /// Python values, as the number of their list.
    Objects(Id),
}

/// Element type of an array. The byte order of a `Named` type is not known yet.
#[derive(Clone, Debug)]
pub(crate) enum DType {
    /// Name of a type without its byte order, such as `f8`.
    Named(String),
    Known(Scalar),
    Objects,
}

#[derive(Clone, Debug)]
pub(crate) enum Value {
    None,
    Bool(bool),
    Whole(i64),
    Float(f64),
    /// UTF-8 text.
    Text(Bytes),
    Bytes(Bytes),
    List(Vec<Id>),
    Tuple(Vec<Id>),
    Dictionary(Vec<(Id, Id)>),
    /// Internal name of a known class or function.
    Global(&'static str),
    DType(DType),
    Array(PickledArray),
}
