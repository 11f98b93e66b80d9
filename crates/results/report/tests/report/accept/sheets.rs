//! Tests of data sheets of limits that rules decide, and of edited results, in every format.

use serde_json::Value;
use taceva_report::{Acceptance, Layout, LimitCheck, LimitsFile, Study, accept};

use super::rules::{limits, study};

const ERROR: &str = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 0.09\n";
const SHARE: &str =
    "[[limit]]\nmetric = \"r2\"\nchannel = \"Fz\"\nunit = \"1\"\nleast = 0.5\nrule = \"simple\"\n";
const GUARDED: &str = "[decision]\nrule = \"guarded\"";
const GUARD: &str = "guard band w = 1 U, U at a coverage of 0.95, on the logarithmic scale of the interval: the limit divided by 1.22";
const SCATTER: &str =
    "u includes the scatter of the tested presses, but not the calibration of the reference.";

fn checks(study: &Study, limits: &LimitsFile) -> Vec<LimitCheck> {
    accept(study, limits).expect("checks")
}

fn sheet<'a>(
    study: &'a Study,
    limits: &'a LimitsFile,
    findings: &'a [LimitCheck],
) -> Acceptance<'a> {
    Acceptance {
        limits,
        study,
        findings,
        date: Some("2026-11-22"),
        pictures: None,
    }
}

/// The sheet in each format with its name.
fn formats(sheet: &Acceptance<'_>) -> [(&'static str, String); 6] {
    let table = sheet.table();
    [
        ("text", table.text()),
        ("CSV", sheet.numbers().csv()),
        ("Markdown", table.markdown()),
        ("LaTeX", table.latex(Layout::Float)),
        ("JSON", sheet.json()),
        ("page", sheet.page()),
    ]
}

#[test]
fn every_format_has_uncertainty_probability_acceptance_limit_and_verdict() {
    let study = study();
    let limits = limits(GUARDED, &format!("{ERROR}{SHARE}"));
    let findings = checks(&study, &limits);
    let sheet = sheet(&study, &limits, &findings);
    for (format, text) in formats(&sheet) {
        assert!(text.contains("conditional pass"), "{format}: {text}");
        // A tenth of the value in 96 degrees of freedom, and the limit less a guard of a fifth.
        for number in ["0.00828", "96", "0.82", "0.0736"] {
            assert!(text.contains(number), "{format} has no {number}: {text}");
        }
        let is_stated = match format {
            "CSV" => {
                let lines: Vec<&str> = text.lines().collect();
                lines[0].ends_with(",u,nu,p_c,acceptance limit,verdict,why,rule")
                    && lines[1].ends_with(&format!(",\"{GUARD}\""))
                    && lines[2].ends_with(",\"simple acceptance, w = 0\"")
            }
            "JSON" => text.contains("\"rule\": \"guarded\""),
            _ => text.contains(GUARD),
        };
        assert!(is_stated, "{format}: {text}");
    }
}

#[test]
fn programs_find_the_decision_of_each_limit() {
    let study = study();
    let limits = limits(GUARDED, &format!("{ERROR}{SHARE}")).counting_conditional_passes();
    let findings = checks(&study, &limits);
    let text = sheet(&study, &limits, &findings).json();
    let json: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(json["passed"], true);
    assert_eq!(json["conditional_pass_counts"], true);
    let [error, share] = [0, 1].map(|at| &json["findings"][at]);
    assert_eq!(error["verdict"], "conditional pass");
    assert_eq!(error["rule"]["rule"], "guarded");
    assert_eq!(error["rule"]["r"], 1.0);
    assert_eq!(share["rule"]["rule"], "simple");
    assert_eq!(share["verdict"], "pass");
    let number = |key: &str| error[key].as_f64().expect("a number");
    assert!((number("U") - number("k") * number("u")).abs() < 1e-12);
    assert!((number("k") - 1.985).abs() < 5e-4);
    let limit = &error["acceptance_limit"];
    assert!(limit["least"].is_null() && limit["most"].is_number());
}

#[test]
fn a_page_counts_the_words_of_its_verdicts_and_prints_expanded_uncertainties() {
    let study = study();
    let strict = limits(GUARDED, &format!("{ERROR}{SHARE}"));
    let findings = checks(&study, &strict);
    let page = sheet(&study, &strict, &findings).page();
    let verdict = "<p class=\"fail\">not accepted: 1 conditional pass.</p>";
    assert!(page.contains(verdict), "{page}");
    assert!(page.contains(">U</th>"), "{page}");
    assert!(page.contains("Decision rule of r2 Fz: simple acceptance, w = 0."));
    assert!(page.contains(SCATTER), "{page}");
    let counting = strict.counting_conditional_passes();
    let findings = checks(&study, &counting);
    let page = sheet(&study, &counting, &findings).page();
    let verdict = "<p class=\"pass\">PASS: every limit is met (1 conditional pass).</p>";
    assert!(page.contains(verdict), "{page}");
    assert!(page.contains("A conditional pass counts as met."));
}

#[test]
fn the_rule_names_what_its_guard_divides_and_multiplies() {
    let study = study();
    let rule = |decision: &str, each: &str| {
        let limits = limits(decision, each);
        let findings = checks(&study, &limits);
        let notes = sheet(&study, &limits, &findings).table().notes;
        let mut notes = notes.iter().map(|note| note.plain().to_owned());
        notes.find(|note| note.starts_with("Decision rule"))
    };
    let scale = "on the logarithmic scale of the interval";
    let guarded = "Decision rule: guard band w = 1 U, U at a coverage of 0.95";
    let both = ERROR.replace("most", "least = 0.05\nmost");
    let share = SHARE.replace("rule = \"simple\"\n", "");
    for (each, expected) in [
        (
            both,
            format!(
                "{guarded}, {scale}: the limit divided by 1.22 (upper) and multiplied by 1.22 (lower)."
            ),
        ),
        (
            format!("{ERROR}{share}"),
            format!(
                "{guarded}, {scale}: mae Fz, the limit divided by 1.22; r2 Fz, 1 − limit divided by 2.00."
            ),
        ),
        // No interval, so no scale.
        (ERROR.replace("Fz", "Fx"), format!("{guarded}.")),
    ] {
        assert_eq!(rule(GUARDED, &each), Some(expected), "{each}");
    }
    let simple = rule("", ERROR);
    assert_eq!(
        simple.as_deref(),
        Some("Decision rule: simple acceptance, w = 0.")
    );
}

#[test]
fn only_a_fail_is_called_failed_and_open_limits_are_counted() {
    let study = study();
    let missing = ERROR.replace("Fz", "Fq");
    let open = limits(GUARDED, &format!("{ERROR}{missing}{SHARE}"));
    let words = |limits: &LimitsFile| {
        let findings = checks(&study, limits);
        let sheet = sheet(&study, limits, &findings);
        (sheet.table().caption, sheet.page())
    };
    let (caption, page) = words(&open);
    let expected =
        "drawn, serial 7: not accepted by line 3, 2026-11-22: 1 conditional pass, 1 undecided";
    assert_eq!(caption, expected);
    let verdict = "<p class=\"fail\">not accepted: 1 conditional pass, 1 undecided.</p>";
    assert!(page.contains(verdict), "{page}");
    // A conditional pass that counts as met does not stand in the way.
    let (caption, _) = words(&open.counting_conditional_passes());
    assert!(caption.ends_with("2026-11-22: 1 undecided"), "{caption}");
    for (most, word) in [("0.06", "1 fail"), ("0.075", "1 conditional fail")] {
        let beyond = ERROR.replace("0.09", most);
        let (caption, page) = words(&limits(GUARDED, &format!("{beyond}{missing}")));
        assert_eq!(caption, "drawn, serial 7: failed by line 3, 2026-11-22");
        let verdict = format!("FAIL: 2 of 2 limits are not passed ({word}, 1 undecided).");
        assert!(page.contains(&verdict), "{page}");
    }
}

#[test]
fn limits_by_value_have_the_columns_that_they_had() {
    let study = study();
    let limits = LimitsFile::read(ERROR).expect("limits");
    let findings = checks(&study, &limits);
    let text = sheet(&study, &limits, &findings).numbers().csv();
    let head = "metric,better,channel,limit,value,95 %,unit,n,verdict,why";
    assert_eq!(text.lines().next(), Some(head));
    assert!(text.contains(",pass,met by the value only"), "{text}");
    let page = sheet(&study, &limits, &findings).page();
    assert!(!page.contains(SCATTER), "{page}");
}

#[test]
fn every_format_says_that_a_result_was_edited() {
    let edit = "results, 2026-11-20: better so (sha256:00000000 → sha256:11111111)";
    let mut study = study();
    study.edits.push(edit.to_owned());
    for text in [ERROR.to_owned(), format!("limits_version = 2\n{ERROR}")] {
        let limits = LimitsFile::read(&text).expect("limits");
        let findings = checks(&study, &limits);
        let sheet = sheet(&study, &limits, &findings);
        for (format, text) in formats(&sheet) {
            let is_said = match format {
                "CSV" => text.contains(",edits") && text.contains(",1 accepted edit"),
                _ => text.contains("better so"),
            };
            assert!(is_said, "{format}: {text}");
        }
    }
}
