//! Panics of code that is not ours, caught and returned as their messages.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// How many calls of [`contained`] are nested on this thread.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
}

/// What `run` gives, or the message of its panic. Nothing is printed for a panic in here; elsewhere the hook of the program still runs.
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
    let outcome = panic::catch_unwind(AssertUnwindSafe(run));
    DEPTH.set(DEPTH.get() - 1);
    outcome.map_err(|payload| match payload.downcast::<String>() {
        Ok(message) => *message,
        Err(payload) => match payload.downcast_ref::<&str>() {
            Some(message) => (*message).to_owned(),
            None => "a panic without a message".to_owned(),
        },
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
    }
}
