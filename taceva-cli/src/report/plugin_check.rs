//! Checks of a plugin in the format of a test runner.

use std::io::{self, Write};

use serde::Serialize;
use taceva_conformance::{CheckResult, Outcome};

use super::json;
use crate::args::ListFormat;

/// All checks; in text without the lines that were already shown.
pub(crate) fn write(
    plugin: &str,
    seed: u64,
    results: &[CheckResult],
    are_shown: bool,
    format: ListFormat,
    out: &mut dyn Write,
) -> io::Result<()> {
    let count = |wanted: fn(&Outcome) -> bool| {
        results
            .iter()
            .filter(|result| wanted(&result.outcome))
            .count()
    };
    let (passed, failed, skipped) = (
        count(|outcome| *outcome == Outcome::Passed),
        count(|outcome| matches!(outcome, Outcome::Failed(_))),
        count(|outcome| matches!(outcome, Outcome::Skipped(_))),
    );
    if format == ListFormat::Json {
        let written = Written {
            schema: "taceva.plugin-check/1",
            plugin,
            seed,
            passed,
            failed,
            skipped,
            results,
        };
        return json::write(&written, out);
    }
    if !are_shown {
        results.iter().try_for_each(|result| line(result, out))?;
    }
    writeln!(
        out,
        "{plugin}: {passed} passed, {failed} failed, {skipped} skipped (seed {seed})"
    )
}

pub(crate) fn line(result: &CheckResult, out: &mut dyn Write) -> io::Result<()> {
    let subject = result.subject.as_deref().unwrap_or("");
    let (word, why) = match &result.outcome {
        Outcome::Passed => ("pass", ""),
        Outcome::Failed(why) => ("FAIL", why.as_str()),
        Outcome::Skipped(why) => ("skip", why.as_str()),
    };
    let (check, took) = (result.check, result.took_s);
    writeln!(out, "{word}  {took:6.2}s  {check:<42} {subject}")?;
    if !why.is_empty() {
        writeln!(out, "               {why}")?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Written<'a> {
    schema: &'static str,
    plugin: &'a str,
    seed: u64,
    passed: usize,
    failed: usize,
    skipped: usize,
    results: &'a [CheckResult],
}
