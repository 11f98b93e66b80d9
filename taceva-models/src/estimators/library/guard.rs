//! Catches panics of linfa and smartcore and returns them as errors; nothing is printed.

use std::cell::Cell;
use std::fmt::Display;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

use taceva_core::{ErrorKind, ModelError};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// What `call` of the library gives for the model called `name`.
///
/// The panic hook of the process is wrapped once: it prints nothing on a thread that is inside a guard.
///
/// # Errors
/// [`ModelError`] of kind `InvalidArgument` if the library refuses, of kind `Panicked` if it panics; both name the model.
pub(crate) fn guarded<T, E: Display>(
    name: &str,
    call: impl FnOnce() -> Result<T, E>,
) -> Result<T, ModelError> {
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
    let result = panic::catch_unwind(AssertUnwindSafe(call));
    GUARDED.set(outer);
    match result {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(ModelError::new(
            ErrorKind::InvalidArgument,
            format!("{name}: {error}"),
        )),
        Err(payload) => {
            let text = payload.downcast_ref::<&str>().copied();
            let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
            let text = text.unwrap_or("no message");
            Err(ModelError::new(
                ErrorKind::Panicked,
                format!("{name}: the library panicked: {text}"),
            ))
        }
    }
}

/// Refuses a fitted parameter that is not finite.
pub(crate) fn finite<'a>(
    name: &str,
    mut numbers: impl Iterator<Item = &'a f64>,
) -> Result<(), ModelError> {
    if numbers.all(|number| number.is_finite()) {
        return Ok(());
    }
    Err(ModelError::new(
        ErrorKind::OutOfRange,
        format!("{name}: the library fitted a parameter that is not finite"),
    ))
}

/// Stops between two calls of a library if the fit was cancelled.
pub(crate) fn interrupted(progress: &dyn taceva_core::Progress) -> Result<(), ModelError> {
    if progress.is_cancelled() {
        return Err(ModelError::new(
            ErrorKind::Interrupted,
            "fitting was cancelled",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_and_a_refusal_are_errors_that_name_the_model() {
        let panicked = guarded::<u8, String>("linfa/pls", || panic!("index {} out of range", 7));
        let error = panicked.expect_err("it panicked");
        assert_eq!(error.kind(), ErrorKind::Panicked);
        assert_eq!(
            error.to_string(),
            "linfa/pls: the library panicked: index 7 out of range"
        );
        let refused = guarded::<u8, _>("linfa/pls", || Err("too few"));
        assert_eq!(
            refused.expect_err("it refused").to_string(),
            "linfa/pls: too few"
        );
        assert_eq!(guarded::<_, String>("linfa/pls", || Ok(5)).ok(), Some(5));
    }
}
