//! Arrays from and to Python by the buffer protocol. Only this file and `arrow/structs.rs` use `unsafe`.

use std::ffi::{CStr, c_int, c_void};
use std::ops::Range;
use std::ptr;

use pyo3::buffer::{Element, PyBuffer};
use pyo3::exceptions::PyBufferError;
use pyo3::ffi;
use pyo3::prelude::*;

use crate::errors::value_error;

/// Copies the numbers at the positions `wanted` of an array in C order.
///
/// # Panics
/// If the range exceeds `array`.
pub(crate) fn values<T: Element>(
    py: Python<'_>,
    array: &PyBuffer<T>,
    wanted: Range<usize>,
) -> Vec<T> {
    let mut values = Vec::new();
    copy_into(py, array, wanted, &mut values);
    values
}

/// Replaces the content of `values` by the numbers in a range of an array in C order.
///
/// # Panics
/// If the range exceeds `array`.
#[expect(unsafe_code, reason = "the memory is Python's")]
pub(crate) fn copy_into<T: Element>(
    _py: Python<'_>,
    array: &PyBuffer<T>,
    wanted: Range<usize>,
    values: &mut Vec<T>,
) {
    assert!(
        array.is_c_contiguous() && wanted.start <= wanted.end && wanted.end <= array.item_count(),
        "a caller has checked the form of the array"
    );
    values.clear();
    values.reserve_exact(wanted.len());
    // SAFETY: the buffer holds the memory of `item_count` numbers, and `get` has checked that they are aligned and of this type. The lock of the
    // interpreter is held, so no Python code writes to it. C code such as numpy may write without the lock, but any bits are a valid number.
    unsafe {
        let start = array.buf_ptr().cast::<T>().add(wanted.start);
        ptr::copy_nonoverlapping(start, values.as_mut_ptr(), wanted.len());
        values.set_len(wanted.len());
    }
}

/// Number type of a buffer.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Number {
    U8,
    U16,
    F32,
    F64,
}

impl Number {
    /// Format character of Python's `struct` module, and size of one number in bytes.
    const fn form(self) -> (&'static CStr, isize) {
        match self {
            Number::U8 => (c"B", 1),
            Number::U16 => (c"H", 2),
            Number::F32 => (c"f", 4),
            Number::F64 => (c"d", 8),
        }
    }
}

/// An immutable array in C order; `numpy.asarray` takes it without a copy and keeps it alive.
#[pyclass(module = "taceva._taceva", frozen)]
pub(crate) struct Buffer {
    bytes: Vec<u8>,
    number: Number,
    shape: Vec<isize>,
    strides: Vec<isize>,
}

impl Buffer {
    /// Interprets `bytes` as numbers of `shape`; the length must match the shape.
    pub(crate) fn new(bytes: Vec<u8>, number: Number, shape: &[usize]) -> PyResult<Buffer> {
        let sizes: Option<Vec<isize>> = shape
            .iter()
            .map(|size| isize::try_from(*size).ok())
            .collect();
        let (_, size) = number.form();
        let shape =
            sizes.ok_or_else(|| PyBufferError::new_err("the array is larger than memory"))?;
        let stated = shape
            .iter()
            .try_fold(size, |product, size| product.checked_mul(*size));
        if stated.and_then(|stated| usize::try_from(stated).ok()) != Some(bytes.len()) {
            return Err(PyBufferError::new_err(format!(
                "{} bytes cannot be {shape:?} numbers of {size} bytes; this is a bug of taceva",
                bytes.len()
            )));
        }
        let mut strides = vec![size; shape.len()];
        for at in (1..shape.len()).rev() {
            strides[at - 1] = strides[at] * shape[at];
        }
        Ok(Buffer {
            bytes,
            number,
            shape,
            strides,
        })
    }

    /// Converts `numbers` to an array with rows of `width` numbers.
    pub(crate) fn of_rows(numbers: &[f64], width: usize) -> PyResult<Buffer> {
        let bytes = numbers
            .iter()
            .flat_map(|number| number.to_ne_bytes())
            .collect();
        let rows = numbers.len() / width.max(1);
        Buffer::new(bytes, Number::F64, &[rows, width])
    }
}

#[expect(
    unsafe_code,
    reason = "the buffer protocol is a C interface, and this file alone speaks it"
)]
#[pymethods]
impl Buffer {
    /// Fills `view` with the address, shape and number format of this array.
    ///
    /// # Safety
    /// CPython calls it with a view that is null or writable.
    unsafe fn __getbuffer__(
        slf: Bound<'_, Self>,
        view: *mut ffi::Py_buffer,
        flags: c_int,
    ) -> PyResult<()> {
        if view.is_null() {
            return Err(PyBufferError::new_err("no view to fill"));
        }
        // SAFETY: CPython passes a view that may be filled.
        unsafe { (*view).obj = ptr::null_mut() };
        if flags & ffi::PyBUF_WRITABLE == ffi::PyBUF_WRITABLE {
            return Err(PyBufferError::new_err(
                "this array is read-only: copy it with numpy.array",
            ));
        }
        let this = slf.get();
        let (format, size) = this.number.form();
        let is_asked = |flag: c_int| flags & flag == flag;
        let filled = ffi::Py_buffer {
            buf: this.bytes.as_ptr().cast_mut().cast::<c_void>(),
            len: this.bytes.len().cast_signed(),
            readonly: 1,
            itemsize: size,
            format: match is_asked(ffi::PyBUF_FORMAT) {
                true => format.as_ptr().cast_mut(),
                false => ptr::null_mut(),
            },
            ndim: c_int::try_from(this.shape.len()).unwrap_or(c_int::MAX),
            shape: match is_asked(ffi::PyBUF_ND) {
                true => this.shape.as_ptr().cast_mut(),
                false => ptr::null_mut(),
            },
            strides: match is_asked(ffi::PyBUF_STRIDES) {
                true => this.strides.as_ptr().cast_mut(),
                false => ptr::null_mut(),
            },
            suboffsets: ptr::null_mut(),
            internal: ptr::null_mut(),
            obj: slf.clone().into_any().into_ptr(),
        };
        // SAFETY: as above. The view holds a reference to the object, which never changes and keeps all its pointers alive.
        unsafe { ptr::write(view, filled) };
        Ok(())
    }
}

/// Pixels from Python: uint8 or uint16 in C order, `[rows, height, width, samples]` or `[height, width, samples]`.
pub(crate) enum Pixels {
    Bytes(PyBuffer<u8>),
    Words(PyBuffer<u16>),
}

impl Pixels {
    /// Reads `array` as pixels with `axes` axes; `name` is its name in errors.
    pub(crate) fn of(array: &Bound<'_, PyAny>, name: &str, axes: usize) -> PyResult<Pixels> {
        let pixels = match PyBuffer::<u8>::get(array) {
            Ok(buffer) => Pixels::Bytes(buffer),
            Err(_) => Pixels::Words(PyBuffer::<u16>::get(array).map_err(|_| {
                value_error(format_args!("{name}: expected an array of uint8 or uint16"))
            })?),
        };
        let is_contiguous = match &pixels {
            Pixels::Bytes(buffer) => buffer.is_c_contiguous(),
            Pixels::Words(buffer) => buffer.is_c_contiguous(),
        };
        if !is_contiguous || pixels.shape().len() != axes {
            return Err(value_error(format_args!(
                "{name} has the shape {:?}, expected a C-contiguous array of {axes} axes, the last of height, width and samples per pixel",
                pixels.shape()
            )));
        }
        Ok(pixels)
    }

    fn shape(&self) -> &[usize] {
        match self {
            Pixels::Bytes(buffer) => buffer.shape(),
            Pixels::Words(buffer) => buffer.shape(),
        }
    }

    /// Height, width and samples per pixel.
    pub(crate) fn frame_shape(&self) -> [usize; 3] {
        let shape = self.shape();
        let last = shape.len();
        [shape[last - 3], shape[last - 2], shape[last - 1]]
    }

    /// True if samples have 16 bits.
    pub(crate) fn is_deep(&self) -> bool {
        matches!(self, Pixels::Words(_))
    }

    /// Bytes of the frame at `row`, with 16-bit samples in little-endian order.
    pub(crate) fn bytes(&self, py: Python<'_>, row: usize) -> Vec<u8> {
        let length: usize = self.frame_shape().iter().product();
        let wanted = row * length..(row + 1) * length;
        match self {
            Pixels::Bytes(buffer) => values(py, buffer, wanted),
            Pixels::Words(buffer) => values(py, buffer, wanted)
                .into_iter()
                .flat_map(u16::to_le_bytes)
                .collect(),
        }
    }
}
