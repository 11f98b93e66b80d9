//! Checks of a plugin in the format of a test runner.

use std::io::{self, Write};

use serde::Serialize;
use taceva_conformance::{CheckResult, Outcome};

use super::json;
use crate::args::ListFormat;

/// Writes all checks. Text omits lines that were already shown, and ends with the reasons of skipped checks.
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
    )?;
    skips(results)
        .iter()
        .try_for_each(|(why, checks)| writeln!(out, "{checks} skipped: {why}"))
}

/// Reasons of skipped checks with the number of checks for each, the most frequent reason last.
fn skips(results: &[CheckResult]) -> Vec<(&str, usize)> {
    let mut skips: Vec<(&str, usize)> = Vec::new();
    for result in results {
        let Outcome::Skipped(why) = &result.outcome else {
            continue;
        };
        match skips.iter_mut().find(|skip| skip.0 == why.as_str()) {
            Some(skip) => skip.1 += 1,
            None => skips.push((why.as_str(), 1)),
        }
    }
    skips.sort_by_key(|skip| skip.1);
    skips
}

/// Writes the line of a check, with the reason of a failure. A skipped check has no line, but counts in the reasons at the end.
pub(crate) fn line(result: &CheckResult, out: &mut dyn Write) -> io::Result<()> {
    let (check, took) = (result.check, result.took_s);
    let place = match &result.subject {
        Some(subject) => format!("{check:<42} {subject}"),
        None => check.to_owned(),
    };
    match &result.outcome {
        Outcome::Passed => writeln!(out, "pass  {took:6.2}s  {place}"),
        Outcome::Failed(why) => {
            let why = why.trim().replace('\n', " / ");
            writeln!(out, "FAIL  {took:6.2}s  {place}: {why}")
        }
        Outcome::Skipped(_) => Ok(()),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn result(check: &'static str, outcome: Outcome) -> CheckResult {
        CheckResult {
            check,
            subject: None,
            outcome,
            took_s: 0.25,
        }
    }

    #[test]
    fn a_failed_check_is_one_line_with_its_subject_and_reason() {
        let failed = CheckResult {
            subject: Some("org.example.x/scale".to_owned()),
            ..result(
                "force/reads",
                Outcome::Failed("NaN,\nexpected a number".to_owned()),
            )
        };
        let mut out = Vec::new();
        line(&failed, &mut out).expect("memory");
        let text = String::from_utf8(out).expect("text");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.starts_with("FAIL    0.25s  force/reads "), "{text}");
        assert!(
            text.ends_with(" org.example.x/scale: NaN, / expected a number\n"),
            "{text}"
        );
    }

    #[test]
    fn skipped_checks_are_counted_by_their_reason_at_the_end() {
        let missing = || Outcome::Skipped("`file`: missing".to_owned());
        let results = [
            result("driver/opens", missing()),
            result("driver/memory", Outcome::Passed),
            result("force/numbers", Outcome::Skipped("no number".to_owned())),
            result("force/reads", missing()),
        ];
        let mut out = Vec::new();
        write("id", 7, &results, false, ListFormat::Text, &mut out).expect("memory");
        let text = String::from_utf8(out).expect("text");
        let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
        let expected = [
            "pass    0.25s  driver/memory",
            "id: 1 passed, 0 failed, 3 skipped (seed 7)",
            "1 skipped: no number",
            "2 skipped: `file`: missing",
        ];
        assert_eq!(lines, expected);
    }
}
