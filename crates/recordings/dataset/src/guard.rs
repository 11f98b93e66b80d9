//! Catches panics of third-party decoders and returns them as errors; nothing is printed.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Runs `decode`; if it panics, the panic's message is the error.
///
/// The process-wide panic hook is wrapped once: it prints nothing on a thread that is inside a guard and is otherwise the
/// hook that was there before.
pub fn guarded<T>(decode: impl FnOnce() -> T) -> Result<T, String> {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let loud = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !GUARDED.get() {
                loud(info);
            }
        }));
    });
    let outer = GUARDED.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(decode));
    GUARDED.set(outer);
    result.map_err(|payload| {
        let message = payload
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
        format!("the decoder panicked: {}", message.unwrap_or("no message"))
    })
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

    #[test]
    fn the_guard_of_one_thread_does_not_silence_another() {
        let is_hidden = guarded(|| {
            std::thread::spawn(|| GUARDED.get())
                .join()
                .expect("no panic")
        });
        assert_eq!(is_hidden, Ok(false));
    }
}
