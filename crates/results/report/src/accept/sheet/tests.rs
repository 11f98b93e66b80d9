//! Tests of the data sheet: it lists every finding, and passes only if all limits are met.

use serde_json::Value;

use super::*;
use crate::accept::{LimitsFile, accept};
use crate::table::Row;
use taceva_results::Samples;

/// Simulated unit with two mean absolute errors: 0.5 N with the interval 0.375 N to 0.75 N, and 0.25 mm without an interval.
fn study() -> Study {
    let studies = crate::results::unsealed(
        r#"{"schema": "taceva.evaluation/1.0",
            "subject": {"sensor": "drawn", "serial": "7", "gel": "B", "source": "simulated"},
            "metrics": {"mae": {
                "Fz": {"value": 0.5, "unit": "N", "n": 80, "ci95": [0.375, 0.75], "method": "drawn"},
                "Pz": {"value": 0.25, "unit": "mm", "n": 40}}},
            "provenance": {"split": "by point"}}"#,
    );
    studies.expect("a result").remove(0)
}

const KEPT: &str = "metric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 1.5";
const BROKEN: &str = "metric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nleast = 0.25\nmost = 0.625\nwhole_interval = true";
const MISSING: &str = "metric = \"mae\"\nchannel = \"Fx\"\nunit = \"N\"\nleast = 0.25";

/// Limits file, and the check of each of its limits.
struct Held {
    limits: LimitsFile,
    findings: Vec<LimitCheck>,
}

/// Checks each of `limits` in a file of version 1.
fn held(study: &Study, limits: &[&str]) -> Held {
    held_below("name = \"batch 3\"", study, limits)
}

fn held_below(head: &str, study: &Study, limits: &[&str]) -> Held {
    let each = limits.iter();
    let text: String = each.map(|limit| format!("[[limit]]\n{limit}\n")).collect();
    let limits = LimitsFile::read(&format!("{head}\n{text}")).expect("limits");
    let findings = accept(study, &limits).expect("checks");
    Held { limits, findings }
}

fn sheet<'a>(study: &'a Study, held: &'a Held) -> Acceptance<'a> {
    Acceptance {
        limits: &held.limits,
        study,
        findings: &held.findings,
        date: Some("2026-11-22"),
        pictures: None,
    }
}

#[test]
fn a_unit_passes_if_all_limits_are_kept_and_not_if_one_is_broken() {
    let study = study();
    for (limits, is_passed) in [
        (&[KEPT][..], true),
        (&[KEPT, BROKEN], false),
        (&[BROKEN, KEPT], false),
    ] {
        let findings = held(&study, limits);
        let sheet = sheet(&study, &findings);
        assert_eq!(sheet.is_passed(), is_passed, "{limits:?}");
        let verdict = if is_passed { "passed" } else { "failed" };
        let json: Value = serde_json::from_str(&sheet.json()).expect("JSON");
        assert_eq!(json["passed"], is_passed);
        let caption = sheet.table().caption;
        let expected = format!("drawn, serial 7: {verdict} by batch 3, 2026-11-22");
        assert_eq!(caption, expected);
    }
}

#[test]
fn each_row_has_the_limit_what_was_found_and_why_it_is_not_enough() {
    let study = study();
    let findings = held(&study, &[KEPT, BROKEN, MISSING]);
    let table = sheet(&study, &findings).table();
    let expected = [
        [
            "mae",
            "Fz",
            "≤ 1.5",
            "0.5",
            "0.375 … 0.75",
            "N",
            "80",
            "pass",
            "",
        ],
        [
            "mae",
            "Fz",
            "0.25 … 0.625, whole interval",
            "0.5",
            "0.375 … 0.75",
            "N",
            "80",
            "FAIL",
            "interval reaches 0.75, above 0.625",
        ],
        [
            "mae",
            "Fx",
            "≥ 0.25",
            "–",
            "–",
            "N",
            "0",
            "FAIL",
            "this score is missing",
        ],
    ];
    let rows: Vec<Vec<String>> = table.rows.iter().map(Row::plain).collect();
    assert_eq!(rows, expected);
    let notes: Vec<&str> = table.notes.iter().map(|note| note.plain()).collect();
    assert_eq!(
        notes,
        ["Nothing here was measured: the samples are simulated."]
    );
}

#[test]
fn a_sheet_of_measured_labels_begins_with_their_certificate_or_says_that_there_is_none() {
    let first_note = |provenance: &str| {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "drawn", "source": "recorded"}},
                "metrics": {{"mae": {{"Fz": {{"value": 0.5, "unit": "N", "n": 80}}}}}}, "provenance": {{{provenance}}}}}"#
        );
        let studies = crate::results::unsealed(&text);
        let mut study = studies.expect("a result").remove(0);
        // Rules and edits have notes too.
        study
            .edits
            .push("results, 2026-11-20: better so".to_owned());
        let findings = held_below("limits_version = 2", &study, &[KEPT]);
        let sheet = sheet(&study, &findings);
        let table = sheet.table();
        assert!(table.notes.len() > 3, "{:?}", table.notes);
        let first = table.notes[0].plain().to_owned();
        let json: Value = serde_json::from_str(&sheet.json()).expect("JSON");
        assert_eq!(json["traceability"], first);
        first
    };
    assert_eq!(
        first_note(""),
        "not traceable: no certificate of the force transducer"
    );
    let certificate = r#"{"number": "D-K-1", "laboratory": "a laboratory", "issued": "2026-05-12", "serial": "42", "k": 2, "U": {"Fz": "3 mN"}}"#;
    let traced =
        format!(r#""traceability": [{{"instrument": "force", "certificate": {certificate}}}]"#);
    assert_eq!(
        first_note(&traced),
        "force: certificate D-K-1 of a laboratory, 2026-05-12, serial 42"
    );
}

#[test]
fn a_sheet_without_name_and_date_speaks_of_neither() {
    let study = study();
    let findings = held_below("", &study, &[KEPT]);
    let sheet = Acceptance {
        date: None,
        ..sheet(&study, &findings)
    };
    assert_eq!(sheet.table().caption, "drawn, serial 7: passed");
    assert!(!sheet.page().contains("<dt>date</dt>"));
}

#[test]
fn programs_find_every_limit_with_its_ends_and_its_reason() {
    let study = study();
    let findings = held(&study, &[KEPT, BROKEN]);
    let json: Value = serde_json::from_str(&sheet(&study, &findings).json()).expect("JSON");
    assert_eq!(json["schema"], ACCEPTANCE_SCHEMA);
    assert_eq!(json["date"], "2026-11-22");
    // Nothing was measured.
    assert!(json.get("traceability").is_some_and(Value::is_null));
    assert_eq!(json["subject"]["serial"], "7");
    let [kept, broken] = [0, 1].map(|at| &json["findings"][at]);
    assert_eq!(
        (&kept["kept"], &kept["reason"]),
        (&true.into(), &Value::Null)
    );
    assert_eq!((&kept["most"], &kept["least"]), (&1.5.into(), &Value::Null));
    assert_eq!(broken["ci95"], serde_json::json!([0.375, 0.75]));
    assert_eq!(broken["reason"], "interval reaches 0.75, above 0.625");
    assert_eq!(broken["better"], "lower");
}

#[test]
fn a_page_says_its_verdict_in_words_and_counts_what_is_broken() {
    let study = study();
    let findings = held(&study, &[KEPT]);
    let page = sheet(&study, &findings).page();
    assert!(page.contains("<p class=\"pass\">PASS: every limit is met.</p>"));
    assert!(!page.contains("FAIL"));
    let findings = held(&study, &[KEPT, BROKEN, MISSING]);
    let page = sheet(&study, &findings).page();
    assert!(page.contains("<p class=\"fail\">FAIL: 2 of 3 limits are not met.</p>"));
    assert!(!page.contains("PASS") && page.contains("this score is missing"));
}

#[test]
fn a_page_names_the_unit_and_the_ranges_that_were_tried_where_samples_are_at_hand() {
    let mut study = study();
    let findings = held(&study, &[KEPT]);
    let page = sheet(&study, &findings).page();
    for entry in [
        "<dt>sensor</dt><dd>drawn</dd>",
        "<dt>serial</dt><dd>7</dd>",
        "<dt>gel</dt><dd>B</dd>",
        "<dt>date</dt><dd>2026-11-22</dd>",
        "<dt>samples</dt><dd>simulated</dd>",
        "<dt>split</dt><dd>by point</dd>",
    ] {
        assert!(page.contains(entry), "{entry}");
    }
    assert!(!page.contains("ranges tried"));
    let samples = "id,Pz,Pz_predicted,Fz\na,1.25,9,-0.5\nb,0,9,\nc,0.5,9,2\n";
    study.samples = Some(Samples::read(samples).expect("samples"));
    let page = sheet(&study, &findings).page();
    let ranges = "<dt>ranges tried</dt><dd>Pz 0 … 1.25 mm; Fz −0.5 … 2 N</dd>";
    assert!(page.contains(ranges), "{page}");
}

#[test]
fn of_several_serial_numbers_only_those_of_units_with_samples_are_named() {
    let mut study = study();
    study.serial = "0, 1, 2".to_owned();
    let findings = held(&study, &[KEPT]);
    for (samples, serial) in [
        ("id,unit_id,Pz,Pz_predicted\na,0,1,1\nb,0,2,2\n", "0"),
        ("id,unit_id,Pz,Pz_predicted\na,2,1,1\nb,0,2,2\n", "0, 2"),
        // Names of other units, and none.
        ("id,unit_id,Pz,Pz_predicted\na,0,1,1\nb,9,2,2\n", "0, 1, 2"),
        ("id,Pz,Pz_predicted\na,1,1\n", "0, 1, 2"),
    ] {
        study.samples = Some(Samples::read(samples).expect("samples"));
        let sheet = sheet(&study, &findings);
        let caption = sheet.table().caption;
        let head = format!("drawn, serial {serial}: passed");
        assert!(caption.starts_with(&head), "{caption}");
        let page = sheet.page();
        let entry = format!("<dt>serial</dt><dd>{serial}</dd>");
        assert!(page.contains(&entry), "{page}");
        let json: Value = serde_json::from_str(&sheet.json()).expect("JSON");
        assert_eq!(json["subject"]["serial"], serial);
    }
}

#[test]
fn sheet_and_provenance_name_the_laboratory_and_the_operator_of_the_recording() {
    let studies = crate::results::unsealed(
        r#"{"schema": "taceva.evaluation/1.0",
            "subject": {"sensor": "drawn", "serial": "7", "gel": "B", "source": "recorded"},
            "metrics": {"mae": {"Fz": {"value": 0.5, "unit": "N", "n": 80}}},
            "provenance": {"devices": {"exposure_ms": "15", "laboratory": "Soft Robotics", "operator": "A. Lovelace"}}}"#,
    );
    let study = studies.expect("a result").remove(0);
    let page = sheet(&study, &held(&study, &[KEPT])).page();
    for entry in [
        "<dt>laboratory</dt><dd>Soft Robotics</dd>",
        "<dt>operator</dt><dd>A. Lovelace</dd>",
    ] {
        assert!(page.contains(entry), "{page}");
    }
    let devices = study.provenance.iter().find(|(name, _)| name == "devices");
    assert_eq!(devices.expect("settings").1, "exposure_ms = 15");
}

#[test]
fn a_limit_without_a_variant_names_the_variant_that_verdicts_use() {
    let studies = crate::results::unsealed(
        r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "drawn"}, "metrics": {
            "uniformity": {"Fz": {"value": 0.75, "unit": "1", "n": 80,
                "debiased": {"value": 0.875, "unit": "1"}}}}}"#,
    );
    let study = studies.expect("a result").remove(0);
    let limit = "metric = \"uniformity\"\nchannel = \"Fz\"\nunit = \"1\"\nleast = 0.8";
    let text = sheet(&study, &held(&study, &[limit])).table().text();
    let note = "uniformity: the limit applies to uniformity.debiased, which verdicts use.";
    assert!(text.contains("0.875") && text.contains(note), "{text}");
    let template = crate::accept::limits_template(&study);
    let metric = "\nmetric = \"uniformity.debiased\"\n";
    assert!(template.contains(metric), "{template}");
}
