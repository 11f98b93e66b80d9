//! Text that a caller lends for the duration of a call.

#![expect(
    unsafe_code,
    reason = "text of the other side is read through its pointer"
)]

use core::ffi::{c_char, c_void};
use core::str::Utf8Error;

/// `taceva_text`: UTF-8 with a length, borrowed for the call.
///
/// Frozen, because other structs contain a `Text`.
///
/// ```
/// use taceva_abi::Text;
/// let text = Text::from("taceva.sensor/1");
/// // SAFETY: it was made from a text that lives for ever.
/// assert_eq!(unsafe { text.to_str() }, Ok("taceva.sensor/1"));
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Text {
    /// First byte; NULL only if `length` is 0.
    pub data: *const c_char,
    /// Length of the text, bytes.
    pub length: usize,
}

// SAFETY: a `Text` in a constant points to constant text. Any other is read only if its creator guarantees the bytes.
unsafe impl Sync for Text {}

impl Text {
    /// Empty text.
    pub const EMPTY: Text = Text::from("");

    /// Borrows `text`. The result is valid for its lifetime.
    pub const fn from(text: &str) -> Text {
        Text {
            data: text.as_ptr().cast(),
            length: text.len(),
        }
    }

    /// Borrowed text; empty for NULL.
    ///
    /// # Errors
    /// [`Utf8Error`] if it is not UTF-8.
    /// # Safety
    /// `data` is NULL, or points to `length` bytes that stay unchanged during `'a`.
    pub unsafe fn to_str<'a>(self) -> Result<&'a str, Utf8Error> {
        if self.data.is_null() {
            return Ok("");
        }
        // SAFETY: guaranteed by the caller.
        let bytes = unsafe { core::slice::from_raw_parts(self.data.cast::<u8>(), self.length) };
        core::str::from_utf8(bytes)
    }
}

/// `taceva_take_text`: callback that receives the texts that a function lists or writes.
///
/// ```
/// use std::ffi::c_void;
/// use taceva_abi::{TakeText, Text};
/// unsafe extern "C" fn count(context: *mut c_void, _: Text) {
///     // SAFETY: `context` is the pointer that was passed with this function.
///     unsafe { *context.cast::<u32>() += 1 };
/// }
/// let take: TakeText = Some(count);
/// let mut texts = 0_u32;
/// // SAFETY: `context` points to a `u32`, as `count` requires.
/// unsafe { take.expect("set")((&raw mut texts).cast(), Text::from("one")) };
/// assert_eq!(texts, 1);
/// ```
pub type TakeText = Option<unsafe extern "C" fn(context: *mut c_void, text: Text)>;
