//! Test runner for a program whose `main` cannot start with the usual harness.

use std::panic::catch_unwind;
use std::process::ExitCode;

/// Name and function of a test.
pub(crate) type Test = (&'static str, fn());

/// Runs the selected tests in order. Arguments select tests by parts of their names; arguments after `--skip` exclude tests.
#[expect(clippy::print_stdout, reason = "a test program says what it did")]
pub(crate) fn run(tests: &[Test]) -> ExitCode {
    let (mut filters, mut skipped) = (Vec::new(), Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(word) = arguments.next() {
        match word.as_str() {
            "--skip" => skipped.extend(arguments.next()),
            "--test-threads" => drop(arguments.next()),
            option if option.starts_with('-') => {}
            _ => filters.push(word),
        }
    }
    let holds = |name: &str, words: &[String]| words.iter().any(|word| name.contains(word));
    let chosen =
        |name: &str| (filters.is_empty() || holds(name, &filters)) && !holds(name, &skipped);
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
