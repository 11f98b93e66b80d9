//! Structs of the Arrow C interface. Only this file fills them.
//!
//! A schema and a batch own their memory. Their release functions free it in any order and on any thread.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

use super::{ArrowColumn, aligned};

/// `ARROW_FLAG_NULLABLE` of the Arrow C interface.
const NULLABLE: i64 = 2;

/// `struct ArrowSchema` of the Arrow C interface.
#[repr(C)]
struct Schema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    n_children: i64,
    children: *mut *mut Schema,
    dictionary: *mut Schema,
    release: Option<unsafe extern "C" fn(*mut Schema)>,
    private_data: *mut c_void,
}

/// Memory behind the pointers of a [`Schema`].
struct SchemaMemory {
    name: CString,
    metadata: Vec<u8>,
    children: Vec<*mut Schema>,
}

impl Schema {
    fn new(
        format: &'static CStr,
        name: CString,
        metadata: Vec<u8>,
        children: Vec<Schema>,
    ) -> Schema {
        let children = children
            .into_iter()
            .map(|child| Box::into_raw(Box::new(child)));
        let mut memory = Box::new(SchemaMemory {
            name,
            metadata,
            children: children.collect(),
        });
        Schema {
            format: format.as_ptr(),
            name: memory.name.as_ptr(),
            metadata: memory.metadata.as_ptr().cast(),
            flags: NULLABLE,
            n_children: memory.children.len() as i64,
            children: memory.children.as_mut_ptr(),
            dictionary: ptr::null_mut(),
            release: Some(release_schema),
            private_data: Box::into_raw(memory).cast(),
        }
    }
}

#[expect(
    unsafe_code,
    reason = "this is a callback of the Arrow C data interface"
)]
unsafe extern "C" fn release_schema(schema: *mut Schema) {
    // SAFETY: a reader calls it once, with the struct that `Schema::new` filled or a copy of it. The children are our boxes; children that the reader
    // has moved out have no `release`.
    unsafe {
        let memory = Box::from_raw((*schema).private_data.cast::<SchemaMemory>());
        for child in memory.children {
            if let Some(release) = (*child).release {
                release(child);
            }
            drop(Box::from_raw(child));
        }
        (*schema).release = None;
    }
}

/// `struct ArrowArray` of the Arrow C interface.
#[repr(C)]
struct Array {
    length: i64,
    null_count: i64,
    offset: i64,
    n_buffers: i64,
    n_children: i64,
    buffers: *mut *const c_void,
    children: *mut *mut Array,
    dictionary: *mut Array,
    release: Option<unsafe extern "C" fn(*mut Array)>,
    private_data: *mut c_void,
}

/// Memory behind the pointers of an [`Array`].
struct ArrayMemory {
    buffers: Vec<*const c_void>,
    children: Vec<*mut Array>,
    /// Owns the memory of `buffers`.
    _values: Vec<Vec<u64>>,
}

impl Array {
    /// Creates `values` of `rows` rows, with null where `is_there` is false; a struct has children and no values.
    fn new(rows: usize, is_there: &[bool], values: Vec<Vec<u64>>, children: Vec<Array>) -> Array {
        let mut all = Vec::new();
        let nulls = is_there.iter().filter(|is_there| !**is_there).count();
        if nulls > 0 {
            let bits = is_there.chunks(8).map(|rows| {
                let bits = rows.iter().enumerate();
                bits.fold(0, |byte, (at, is_there)| byte | (u8::from(*is_there) << at))
            });
            all.push(aligned(bits.collect()));
        }
        // Without nulls there is no validity bitmap, and its pointer is null.
        let mut buffers: Vec<*const c_void> = match nulls {
            0 => vec![ptr::null()],
            _ => Vec::new(),
        };
        all.extend(values);
        buffers.extend(all.iter().map(|values| values.as_ptr().cast::<c_void>()));
        let children = children
            .into_iter()
            .map(|child| Box::into_raw(Box::new(child)));
        let mut memory = Box::new(ArrayMemory {
            buffers,
            children: children.collect(),
            _values: all,
        });
        Array {
            length: rows as i64,
            null_count: nulls as i64,
            offset: 0,
            n_buffers: memory.buffers.len() as i64,
            n_children: memory.children.len() as i64,
            buffers: memory.buffers.as_mut_ptr(),
            children: memory.children.as_mut_ptr(),
            dictionary: ptr::null_mut(),
            release: Some(release_array),
            private_data: Box::into_raw(memory).cast(),
        }
    }
}

#[expect(
    unsafe_code,
    reason = "this is a callback of the Arrow C data interface"
)]
unsafe extern "C" fn release_array(array: *mut Array) {
    // SAFETY: as for `release_schema`.
    unsafe {
        let memory = Box::from_raw((*array).private_data.cast::<ArrayMemory>());
        for child in memory.children {
            if let Some(release) = (*child).release {
                release(child);
            }
            drop(Box::from_raw(child));
        }
        (*array).release = None;
    }
}

/// `struct ArrowArrayStream` of the Arrow C interface.
#[repr(C)]
pub(super) struct Stream {
    get_schema: Option<unsafe extern "C" fn(*mut Stream, *mut Schema) -> c_int>,
    get_next: Option<unsafe extern "C" fn(*mut Stream, *mut Array) -> c_int>,
    get_last_error: Option<unsafe extern "C" fn(*mut Stream) -> *const c_char>,
    release: Option<unsafe extern "C" fn(*mut Stream)>,
    private_data: *mut c_void,
}

/// Columns of `rows` rows, with metadata of the table.
pub(super) struct Batch {
    pub(super) rows: usize,
    pub(super) columns: Vec<ArrowColumn>,
    pub(super) metadata: Vec<u8>,
}

/// Data that a [`Stream`] owns.
struct StreamMemory {
    batch: Batch,
    is_given: bool,
}

impl Stream {
    /// A stream that returns `batch` once.
    pub(super) fn of(batch: Batch) -> Stream {
        let memory = Box::new(StreamMemory {
            batch,
            is_given: false,
        });
        Stream {
            get_schema: Some(get_schema),
            get_next: Some(get_next),
            get_last_error: Some(get_last_error),
            release: Some(release_stream),
            private_data: Box::into_raw(memory).cast(),
        }
    }
}

#[expect(
    unsafe_code,
    reason = "the memory behind the pointer belongs to the struct"
)]
// SAFETY: its pointer is to a box of plain memory that nothing else accesses.
unsafe impl Send for Stream {}

impl Drop for Stream {
    #[expect(
        unsafe_code,
        reason = "this is a callback of the Arrow C data interface"
    )]
    fn drop(&mut self) {
        if let Some(release) = self.release {
            // SAFETY: the stream was not moved out, because that clears `release`.
            unsafe { release(self) };
        }
    }
}

#[expect(
    unsafe_code,
    reason = "this is a callback of the Arrow C data interface"
)]
unsafe extern "C" fn get_schema(stream: *mut Stream, into: *mut Schema) -> c_int {
    // SAFETY: a reader passes a stream that it has not released, and a struct to fill.
    unsafe {
        let batch = &(*(*stream).private_data.cast::<StreamMemory>()).batch;
        let fields = batch.columns.iter().map(|column| {
            let metadata = column.metadata.clone();
            Schema::new(column.format(), column.name.clone(), metadata, Vec::new())
        });
        let whole = Schema::new(
            c"+s",
            CString::default(),
            batch.metadata.clone(),
            fields.collect(),
        );
        ptr::write(into, whole);
    }
    0
}

#[expect(
    unsafe_code,
    reason = "this is a callback of the Arrow C data interface"
)]
unsafe extern "C" fn get_next(stream: *mut Stream, into: *mut Array) -> c_int {
    // SAFETY: as for `get_schema`.
    unsafe {
        let memory = &mut *(*stream).private_data.cast::<StreamMemory>();
        let rows = memory.batch.rows;
        let batch = match std::mem::replace(&mut memory.is_given, true) {
            // A released array marks the end of the stream.
            true => {
                let mut none = Array::new(0, &[], Vec::new(), Vec::new());
                release_array(&raw mut none);
                none
            }
            false => {
                let columns = memory.batch.columns.iter().map(|column| {
                    Array::new(rows, &column.cells.is_there(), column.values(), Vec::new())
                });
                Array::new(rows, &[], Vec::new(), columns.collect())
            }
        };
        ptr::write(into, batch);
    }
    0
}

#[expect(
    unsafe_code,
    reason = "this is a callback of the Arrow C data interface"
)]
unsafe extern "C" fn get_last_error(_stream: *mut Stream) -> *const c_char {
    // No call fails, because all values are in memory.
    ptr::null()
}

#[expect(
    unsafe_code,
    reason = "this is a callback of the Arrow C data interface"
)]
unsafe extern "C" fn release_stream(stream: *mut Stream) {
    // SAFETY: a reader calls it once, with the struct that `stream` filled or a copy of it.
    unsafe {
        drop(Box::from_raw((*stream).private_data.cast::<StreamMemory>()));
        (*stream).release = None;
    }
}
