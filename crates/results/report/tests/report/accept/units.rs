//! Tests of the risks of limits among units of one process.

use serde_json::{Value, json};
use taceva_report::{Acceptance, LimitsFile, Study, accept, add_process_risks};

use super::rules::limits;
use crate::support;

/// Study of a unit whose mean absolute error of Fz is `error`, N, with a standard uncertainty of 10 % from 97 clusters.
fn unit(error: f64) -> Study {
    let (low, high) = (error / 1.22, error * 1.22);
    let json = json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": "drawn", "source": "simulated"},
        "metrics": {"mae": {"Fz": {
            "value": error, "unit": "N", "n": 460, "ci95": [low, high],
            "method": "jackknife by point_id, G=97, logarithmic"
        }}}
    });
    support::study(&json)
}

fn limit(most: f64) -> LimitsFile {
    let limit =
        format!("[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = {most}\n");
    limits("", &limit)
}

/// JSON of the risks, and CSV, for a unit with an error of 0.08 N among units with `errors`. The target risk is 0.005.
fn among(errors: &[f64], most: f64) -> (Value, String) {
    let study = unit(0.08);
    let limits = limit(most);
    let mut findings = accept(&study, &limits).expect("checks");
    let units: Vec<Study> = errors.iter().map(|error| unit(*error)).collect();
    add_process_risks(&mut findings, &study, &units, Some(0.005));
    let sheet = Acceptance {
        limits: &limits,
        study: &study,
        findings: &findings,
        date: None,
        pictures: None,
    };
    let json: Value = serde_json::from_str(&sheet.json()).expect("JSON");
    (json["findings"][0]["process"].clone(), sheet.table().csv())
}

const ERRORS: [f64; 6] = [0.05, 0.06, 0.07, 0.08, 0.1, 0.12];

#[test]
fn a_limit_nearer_to_the_units_has_a_greater_risk_and_its_target_needs_a_guard() {
    let risk = |most: f64| {
        let (process, _) = among(&ERRORS, most);
        assert_eq!(process["units"], 6);
        process["consumer_risk"].as_f64().expect("a share")
    };
    let (near, far) = (risk(0.12), risk(0.3));
    assert!((0.005..0.1).contains(&near) && far < 0.001, "{near} {far}");
    let (process, csv) = among(&ERRORS, 0.12);
    let inner = process["acceptance_limit"]["most"].as_f64();
    assert!(
        inner.is_some_and(|most| (0.08..0.12).contains(&most)),
        "{process}"
    );
    assert!(csv.contains(",consumer's risk,producer's risk,limit for risk,verdict,why"));
    // No guard: the risk is lower without one.
    let (process, _) = among(&ERRORS, 0.3);
    assert_eq!(process["acceptance_limit"]["most"], 0.3);
}

#[test]
fn few_units_and_such_without_an_interval_have_no_risk_but_a_reason() {
    let (process, csv) = among(&ERRORS[..3], 0.12);
    assert_eq!(
        process["undefined"],
        "the number of units is 3, expected at least 5 units of one process"
    );
    assert!(csv.contains(",–,–,–,pass,"), "{csv}");
}

#[test]
fn an_unknown_score_of_a_unit_is_named_by_its_number() {
    let study = unit(0.08);
    let limits = limit(0.12);
    let mut findings = accept(&study, &limits).expect("checks");
    let mut units: Vec<Study> = ERRORS.map(unit).to_vec();
    units[1].scores.clear();
    add_process_risks(&mut findings, &study, &units, None);
    let process = findings.remove(0).process.expect("asked for");
    assert_eq!(process, Err("unit 2: this score is missing".to_owned()));
}
