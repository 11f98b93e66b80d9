//! Values read from an array.

mod conversion;

/// Rows of an array: their shape, and their elements in C order.
///
/// ```no_run
/// use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues};
///
/// let file = ArrayFile::open("run.npz".as_ref(), ArrayFormat::Npz)?;
/// let wrench = file.read("ft", 0..10)?;
/// assert_eq!(wrench.shape, [10, 6]);
/// if let ArrayValues::F64(newtons) = wrench.values {
///     assert_eq!(newtons.len(), 60);
/// }
/// # Ok::<(), taceva_arrays::ArrayError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ArrayData {
    /// Lengths of the axes. The first is the number of rows read. Empty for a single number.
    pub shape: Vec<u64>,
    /// Elements of these rows. Their number is the product of the lengths in `shape`.
    pub values: ArrayValues,
}

/// Elements in the byte order of this machine. Floating-point numbers of 16 bits are converted to 32 bits exactly.
///
/// ```
/// use taceva_arrays::ArrayValues;
///
/// let values = ArrayValues::I16(vec![-3, 4]);
/// assert_eq!(values.len(), 2);
/// assert_eq!(values.to_f64(), Some(vec![-3.0, 4.0]));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ArrayValues {
    /// True or false.
    Bool(Vec<bool>),
    /// Unsigned whole numbers of 8 bits.
    U8(Vec<u8>),
    /// Unsigned whole numbers of 16 bits.
    U16(Vec<u16>),
    /// Unsigned whole numbers of 32 bits.
    U32(Vec<u32>),
    /// Unsigned whole numbers of 64 bits.
    U64(Vec<u64>),
    /// Signed whole numbers of 8 bits.
    I8(Vec<i8>),
    /// Signed whole numbers of 16 bits.
    I16(Vec<i16>),
    /// Signed whole numbers of 32 bits.
    I32(Vec<i32>),
    /// Signed whole numbers of 64 bits.
    I64(Vec<i64>),
    /// Floating-point numbers of 16 or 32 bits.
    F32(Vec<f32>),
    /// Floating-point numbers of 64 bits.
    F64(Vec<f64>),
    /// Text.
    Text(Vec<String>),
    /// Bytes of any length.
    Bytes(Vec<Vec<u8>>),
}

impl ArrayValues {
    /// Number of elements.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            ArrayValues::Bool(all) => all.len(),
            ArrayValues::U8(all) => all.len(),
            ArrayValues::U16(all) => all.len(),
            ArrayValues::U32(all) => all.len(),
            ArrayValues::U64(all) => all.len(),
            ArrayValues::I8(all) => all.len(),
            ArrayValues::I16(all) => all.len(),
            ArrayValues::I32(all) => all.len(),
            ArrayValues::I64(all) => all.len(),
            ArrayValues::F32(all) => all.len(),
            ArrayValues::F64(all) => all.len(),
            ArrayValues::Text(all) => all.len(),
            ArrayValues::Bytes(all) => all.len(),
        }
    }

    /// True if there are no elements.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Keeps every `step`-th element, beginning with the index `first`.
    #[cfg(feature = "hdf5")]
    pub(crate) fn every(self, first: usize, step: usize) -> ArrayValues {
        fn of<T>(all: Vec<T>, first: usize, step: usize) -> Vec<T> {
            all.into_iter().skip(first).step_by(step.max(1)).collect()
        }
        match self {
            ArrayValues::Bool(all) => ArrayValues::Bool(of(all, first, step)),
            ArrayValues::U8(all) => ArrayValues::U8(of(all, first, step)),
            ArrayValues::U16(all) => ArrayValues::U16(of(all, first, step)),
            ArrayValues::U32(all) => ArrayValues::U32(of(all, first, step)),
            ArrayValues::U64(all) => ArrayValues::U64(of(all, first, step)),
            ArrayValues::I8(all) => ArrayValues::I8(of(all, first, step)),
            ArrayValues::I16(all) => ArrayValues::I16(of(all, first, step)),
            ArrayValues::I32(all) => ArrayValues::I32(of(all, first, step)),
            ArrayValues::I64(all) => ArrayValues::I64(of(all, first, step)),
            ArrayValues::F32(all) => ArrayValues::F32(of(all, first, step)),
            ArrayValues::F64(all) => ArrayValues::F64(of(all, first, step)),
            ArrayValues::Text(all) => ArrayValues::Text(of(all, first, step)),
            ArrayValues::Bytes(all) => ArrayValues::Bytes(of(all, first, step)),
        }
    }

    /// Numbers as `f64`, with true as 1. `None` for text and bytes, and if a number of 64 bits cannot be represented exactly.
    #[must_use]
    pub fn to_f64(&self) -> Option<Vec<f64>> {
        fn all<T: Copy + Into<f64>>(values: &[T]) -> Option<Vec<f64>> {
            Some(values.iter().map(|value| (*value).into()).collect())
        }
        match self {
            ArrayValues::Bool(values) => Some(
                values
                    .iter()
                    .map(|value| f64::from(u8::from(*value)))
                    .collect(),
            ),
            ArrayValues::U8(values) => all(values),
            ArrayValues::U16(values) => all(values),
            ArrayValues::U32(values) => all(values),
            ArrayValues::I8(values) => all(values),
            ArrayValues::I16(values) => all(values),
            ArrayValues::I32(values) => all(values),
            ArrayValues::F32(values) => all(values),
            ArrayValues::F64(values) => Some(values.clone()),
            ArrayValues::U64(values) => values
                .iter()
                .map(|value| exact(i128::from(*value)))
                .collect(),
            ArrayValues::I64(values) => values
                .iter()
                .map(|value| exact(i128::from(*value)))
                .collect(),
            ArrayValues::Text(_) | ArrayValues::Bytes(_) => None,
        }
    }
}

/// Integer `number` as `f64`; `None` if the conversion is not exact.
fn exact(number: i128) -> Option<f64> {
    let near = number as f64;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "near is whole and below 2^65"
    )]
    let back = near as i128;
    (back == number).then_some(near)
}
