//! Converts panics of linfa and smartcore to errors, without printing the panic message.

use std::fmt::Display;

use taceva_core::{ErrorKind, ModelError, contained};

/// Calls a library for the model `name`, and converts its panics to errors.
///
/// # Errors
/// [`ModelError`] of kind `InvalidArgument` if the library fails, of kind `Panicked` if the library panics. Both errors name the model.
pub(crate) fn guarded<T, E: Display>(
    name: &str,
    call: impl FnOnce() -> Result<T, E>,
) -> Result<T, ModelError> {
    let of = |kind, why: String| ModelError::new(kind, format!("{name}: {why}"));
    match contained(call) {
        Ok(result) => result.map_err(|error| of(ErrorKind::InvalidArgument, error.to_string())),
        Err(panic) => {
            let why = format!("the library panicked: {panic}");
            Err(of(ErrorKind::Panicked, why))
        }
    }
}

/// Rejects fitted parameters of the model `name` that are not finite.
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
