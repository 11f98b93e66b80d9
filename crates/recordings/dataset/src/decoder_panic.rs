//! Converts panics of third-party decoders to errors.

/// Returns the value of `decode`. A panic becomes an error with its message, and nothing is printed.
pub fn guarded<T>(decode: impl FnOnce() -> T) -> Result<T, String> {
    taceva_core::contained(decode).map_err(|message| format!("the decoder panicked: {message}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error_with_its_message() {
        let caught = guarded(|| -> u8 { panic!("index {} out of range", 7) });
        assert_eq!(
            caught,
            Err("the decoder panicked: index 7 out of range".to_owned())
        );
        assert_eq!(guarded(|| 5), Ok(5));
    }
}
