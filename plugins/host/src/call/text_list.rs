//! Texts that a library passes to the host.

#![expect(unsafe_code, reason = "texts come through the plugin's functions")]

use std::ffi::c_void;

use taceva_abi as abi;
use taceva_core::ErrorKind;

use super::Failure;

/// Collected texts of a plugin, one per callback.
#[derive(Debug, Default)]
pub struct Taken {
    texts: Vec<String>,
    bytes: usize,
    fault: Option<&'static str>,
}

/// Maximum number of texts.
const TEXTS_MAX: usize = 4_096;
/// Maximum total length of the texts, bytes.
const BYTES_MAX: usize = 1 << 20;

impl Taken {
    /// Context pointer for [`take`].
    pub fn context(&mut self) -> *mut c_void {
        std::ptr::from_mut(self).cast()
    }

    /// Collected texts, or an error for an invalid text or an exceeded limit.
    pub fn texts(self) -> Result<Vec<String>, Failure> {
        match self.fault {
            None => Ok(self.texts),
            Some(fault) => Err(Failure::new(ErrorKind::Abi, fault)),
        }
    }

    /// Concatenation of all texts.
    pub fn whole(self) -> Result<String, Failure> {
        Ok(self.texts()?.concat())
    }

    fn add(&mut self, text: abi::Text) {
        self.bytes = self.bytes.saturating_add(text.length);
        if text.data.is_null() && text.length > 0 {
            self.fault = Some("a text that is NULL but has a length");
        } else if self.bytes > BYTES_MAX || self.texts.len() >= TEXTS_MAX {
            self.fault = Some("more than 4096 texts or 1 MiB of text");
        }
        if self.fault.is_some() {
            return;
        }
        // SAFETY: not NULL above a length of 0, and borrowed for this call by the rule of `taceva_take_text`. A length beyond mapped memory breaks
        // the plugin's guarantee, and lengths above 1 MiB were rejected.
        match unsafe { text.to_str() } {
            Ok(text) => self.texts.push(text.to_owned()),
            Err(_) => self.fault = Some("a string that is not UTF-8"),
        }
    }
}

/// Appends one text to the [`Taken`] at `context`.
///
/// # Safety
/// `context` is the pointer that `Taken::context` returned for the pending call, and no other code accesses the list during the call.
pub unsafe extern "C" fn take(context: *mut c_void, text: abi::Text) {
    // SAFETY: guaranteed by the caller.
    let taken = unsafe { &mut *context.cast::<Taken>() };
    taken.add(text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_that_is_none_is_a_fault_and_nothing_of_it_is_read() {
        let taken = |texts: &[abi::Text]| {
            let mut taken = Taken::default();
            for text in texts {
                // SAFETY: the context belongs to `taken`, and each text has its stated length or is rejected by it.
                unsafe { take(taken.context(), *text) };
            }
            taken.whole()
        };
        assert_eq!(
            taken(&[abi::Text::from("a"), abi::Text::from("b")]),
            Ok("ab".to_owned())
        );
        let nothing = abi::Text {
            data: std::ptr::null(),
            length: 5,
        };
        let endless = abi::Text {
            data: c"x".as_ptr(),
            length: usize::MAX,
        };
        let odd = abi::Text {
            data: c"\xff\xfe".as_ptr(),
            length: 2,
        };
        for text in [nothing, endless, odd] {
            assert!(taken(&[text]).is_err());
            assert!(taken(&[abi::Text::from("a"), text]).is_err());
        }
    }
}
