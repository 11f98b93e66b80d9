//! Values of a pickle. They refer to one another by number and own none. No depth of nesting therefore causes recursion.

use std::sync::Arc;

use crate::fields::Item;
use crate::scalar::Scalar;

/// Number of a value.
pub(crate) type Id = u32;

/// Bytes of a pickle.
#[derive(Clone, Debug)]
pub(crate) enum Bytes {
    /// Not read yet.
    InFile { at: u64, length: u64 },
    /// Bytes from protocol 2, which writes bytes as text.
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
    /// Under construction.
    Nothing,
    Numbers {
        item: Item,
        bytes: Bytes,
    },
    /// Python values, as the number of the list.
    Objects(Id),
}

/// Type of an array, possibly under construction.
#[derive(Clone, Debug)]
pub(crate) enum DType {
    /// Type without the byte order, such as `f8`.
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
    /// Known global.
    Global(&'static str),
    DType(DType),
    Array(PickledArray),
}
