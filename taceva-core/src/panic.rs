//! Catches panics of plugin code and returns their messages.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Number of calls of [`contained`] in progress on this thread.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
}

/// Returns the value of `run`, or the message of its panic. The panic is not printed. Panics outside `run` still call the panic hook of the program.
pub fn contained<T>(run: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let of_the_program = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if DEPTH.get() == 0 {
                of_the_program(panic);
            }
        }));
    });
    DEPTH.set(DEPTH.get() + 1);
    let outcome = caught(run);
    DEPTH.set(DEPTH.get() - 1);
    outcome
}

/// Returns the value of `run`, or the message of its panic. The panic hook of the program is called first.
pub fn caught<T>(run: impl FnOnce() -> T) -> Result<T, String> {
    panic::catch_unwind(AssertUnwindSafe(run)).map_err(|payload| {
        let message = match payload.downcast_ref::<&str>() {
            Some(message) => Some((*message).to_owned()),
            None => payload.downcast_ref::<String>().cloned(),
        };
        message.unwrap_or_else(|| {
            // Dropping a payload of another type may panic again.
            std::mem::forget(payload);
            "a panic without a message".to_owned()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_comes_back_as_its_message() {
        let index = 7;
        assert_eq!(
            contained(|| -> u8 { panic!("row {index} of 5") }),
            Err("row 7 of 5".to_owned())
        );
        assert_eq!(
            contained(|| -> u8 { panic!("short") }),
            Err("short".to_owned())
        );
        assert_eq!(contained(|| 5), Ok(5));
        assert_eq!(caught(|| 5), Ok(5));
    }

    /// A panic payload that panics when it is dropped.
    struct Bomb;

    impl Drop for Bomb {
        fn drop(&mut self) {
            panic!("dropped");
        }
    }

    #[test]
    fn a_payload_that_panics_when_dropped_is_not_dropped() {
        let caught = contained(|| -> u8 { panic::panic_any(Bomb) });
        assert_eq!(caught, Err("a panic without a message".to_owned()));
    }

    #[test]
    fn one_thread_does_not_silence_another() {
        let depth = contained(|| std::thread::spawn(|| DEPTH.get()).join().expect("no panic"));
        assert_eq!(depth, Ok(0));
    }
}
