//! Programs, devices and data that tests need, but that a machine may lack. A test whose need is not met calls [`skip`] and returns. `skip` adds a
//! line to the list that `.ci/test` prints at its end. The test fails instead if `TACEVA_REQUIRE` names the need.

#[cfg(feature = "browser")]
mod browser;
mod need;
mod record;

#[cfg(feature = "browser")]
pub use browser::{Browser, from_base64};
pub use need::{Need, UnknownNeed, required};
pub use record::LIST;

use std::fmt::Display;

/// Records that the calling test is skipped, wholly or in part, because `need` is not met for this `reason`.
///
/// The test's name is the name of its thread, which the test harness sets.
///
/// # Panics If `TACEVA_REQUIRE` names this need or an unknown need, or if the list cannot be written. The test then fails.
#[expect(clippy::print_stderr, reason = "a skipped test must say why")]
pub fn skip(need: Need, reason: impl Display) {
    let reason = reason.to_string();
    let required = required(std::env::var_os("TACEVA_REQUIRE").as_deref());
    let required = required.unwrap_or_else(|error| panic!("{error}"));
    assert!(
        !required.contains(&need),
        "TACEVA_REQUIRE names `{need}`, which is missing: {reason}"
    );
    eprintln!("skipped: {need}: {reason}");
    record::record(need, &reason);
}
