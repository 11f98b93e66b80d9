//! What tests need that a machine may not have. A test that finds one of them absent calls [`skip`] and returns: the skip is written
//! into the list that `.ci/test` prints at its end, or fails the test where `TACEVA_REQUIRE` names the need.

#[cfg(feature = "browser")]
mod browser;
mod need;
mod record;

#[cfg(feature = "browser")]
pub use browser::{Browser, from_base64};
pub use need::{Need, UnknownNeed, required};
pub use record::LIST;

use std::fmt::Display;

/// Says that the calling test is skipped, wholly or in part, because `need` is not met for this `reason`.
///
/// The test's name comes from its thread, which the test harness names after it.
///
/// # Panics
/// If `TACEVA_REQUIRE` names the need, names one that does not exist, or the list cannot be written: the test fails.
#[expect(clippy::print_stderr, reason = "a skipped test must say why")]
pub fn skip(need: Need, reason: impl Display) {
    let reason = reason.to_string();
    let required = required(std::env::var_os("TACEVA_REQUIRE").as_deref());
    let required = required.unwrap_or_else(|error| panic!("{error}"));
    assert!(
        !required.contains(&need),
        "TACEVA_REQUIRE names `{need}`, which is not there: {reason}"
    );
    eprintln!("skipped: {need}: {reason}");
    record::record(need, &reason);
}
