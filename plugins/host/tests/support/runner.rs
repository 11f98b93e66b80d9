//! Runs tests in a program whose `main` must begin with something else than the usual harness.

use std::panic::catch_unwind;
use std::process::ExitCode;

/// A test by name.
pub(crate) type Test = (&'static str, fn());

/// Runs the tests whose names hold the first argument that is no option, one after another.
#[expect(clippy::print_stdout, reason = "a test program says what it did")]
pub(crate) fn run(tests: &[Test]) -> ExitCode {
    let filter = std::env::args().skip(1).find(|word| !word.starts_with('-'));
    let chosen = |name: &str| filter.as_deref().is_none_or(|filter| name.contains(filter));
    let mut failed = Vec::new();
    let mut passed = 0;
    for (name, test) in tests.iter().filter(|(name, _)| chosen(name)) {
        let is_sound = catch_unwind(test).is_ok();
        println!("test {name} ... {}", if is_sound { "ok" } else { "FAILED" });
        match is_sound {
            true => passed += 1,
            false => failed.push(name),
        }
    }
    println!(
        "\ntest result: {passed} passed; {} failed {failed:?}",
        failed.len()
    );
    if failed.is_empty() {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
