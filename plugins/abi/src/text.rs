//! Text that is borrowed for a call.

#![expect(
    unsafe_code,
    reason = "text of the other side is read through its pointer"
)]

use core::ffi::{c_char, c_void};
use core::str::Utf8Error;

/// `taceva_text`: UTF-8 with a length, borrowed for the call.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Text {
    /// The first byte; may be NULL only where `length` is 0.
    pub data: *const c_char,
    /// In bytes.
    pub length: usize,
}

// SAFETY: a `Text` in a constant points to constant text; any other is read only where whoever made it promises the bytes.
unsafe impl Sync for Text {}

impl Text {
    /// No text.
    pub const EMPTY: Text = Text::from("");

    /// The text, for as long as it lives.
    pub const fn from(text: &str) -> Text {
        Text {
            data: text.as_ptr().cast(),
            length: text.len(),
        }
    }

    /// The text that is borrowed; NULL is empty.
    ///
    /// # Errors
    /// [`Utf8Error`] if it is none.
    /// # Safety
    /// Unless it is NULL, `data` points to `length` bytes that nobody changes during `'a`.
    pub unsafe fn to_str<'a>(self) -> Result<&'a str, Utf8Error> {
        if self.data.is_null() {
            return Ok("");
        }
        // SAFETY: promised by the caller.
        let bytes = unsafe { core::slice::from_raw_parts(self.data.cast::<u8>(), self.length) };
        core::str::from_utf8(bytes)
    }
}

/// `taceva_take_text`: takes what a function lists or writes.
pub type TakeText = Option<unsafe extern "C" fn(context: *mut c_void, text: Text)>;
