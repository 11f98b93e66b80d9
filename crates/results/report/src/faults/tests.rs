//! Tests of results with faults, as pages and choices read them.

use serde_json::{Value, json};

use super::FaultResult;
use crate::{Need, ReportPage, Study, choose_results, fault_page, report};

/// Result of the sensor `sensor` over the faults of `list`, with a mean degradation of Fz of `mean`.
pub(crate) fn drawn(sensor: &str, list: &str, mean: f64) -> FaultResult {
    FaultResult::read(&written(sensor, list, mean).to_string()).expect("a result")
}

/// Result of a model that predicts a constant.
pub(crate) fn without_skill(sensor: &str) -> FaultResult {
    let mut result = written(sensor, "tear", 1.0);
    result["clean"]["Fz"]["skill"] = json!({"value": 0.0, "ci95": [0.0, 0.0], "reason": null});
    FaultResult::read(&result.to_string()).expect("a result")
}

/// JSON of the result that [`drawn`] returns.
fn written(sensor: &str, list: &str, mean: f64) -> Value {
    let estimate =
        |value: f64| json!({"value": value, "ci95": [value - 0.1, value + 0.1], "reason": null});
    let cell = |severity: u8, value: f64| json!({"severity": severity, "stale": {"Fz": {"degradation": estimate(value)}}});
    json!({
        "schema": "taceva.stress/1",
        "subject": {"sensor": sensor, "serial": "1", "gel": "1", "source": "recorded"},
        "not_measured": null, "by": "stimulus",
        "list": {"name": list, "digest": list},
        "seed": 1, "samples": 12,
        "clean": {"Fz": {"skill": estimate(0.9)}},
        "faults": [{
            "id": "tear", "note": "it lies still", "severities": [cell(1, 1.5), cell(3, 40.0)],
            "unreached": [{"severity": 5}], "breaks_at": {"Fz": 3}
        }],
        "mD": {"Fz": estimate(mean)},
        "unnoticed": [{"fault": "tear", "severity": 3, "channel": "Fz"}],
        "skipped": [{"fault": "stale_frames", "reason": "no previous picture"}],
        "notes": ["one draw of places"]
    })
}

#[test]
fn a_page_has_a_section_on_faults_with_grid_hatching_and_unnoticed_faults() {
    let study = Study::of_faults(drawn("gel", "tear", 4.0));
    let studies = [study];
    let page = report(&ReportPage {
        title: "worn",
        studies: &studies,
        pictures: &[],
        triples: &[],
    });
    for words in [
        "<h2 id=\"h-faults\">Faults</h2>",
        "id=\"figure-faults-1\"",
        "tear, severity 3: 40",
        "tear, severity 5: skipped",
        "stale_frames, severity 1: skipped",
        "(fault, severity, channel): tear 3 Fz.",
        "skill of Fz is no longer shown at severity 3",
        "Skipped: stale_frames: no previous picture.",
    ] {
        assert!(page.contains(words), "{words} in {page}");
    }
    let without = report(&ReportPage {
        title: "worn",
        studies: &[Study::default()],
        pictures: &[],
        triples: &[],
    });
    assert!(!without.contains("h-faults"));
}

#[test]
fn the_page_of_one_result_has_the_section_of_a_run_and_nothing_else() {
    let section = |page: &str| {
        let start = page.find("<section id=\"faults\"").expect("a section");
        let end = page[start..].find("</section>").expect("its end");
        page[start..start + end].to_owned()
    };
    let studies = [Study::of_faults(drawn("gel", "tear", 4.0))];
    let of_run = report(&ReportPage {
        title: "worn",
        studies: &studies,
        pictures: &[],
        triples: &[],
    });
    let page = fault_page(drawn("gel", "tear", 4.0));
    assert_eq!(section(&page), section(&of_run));
    assert_eq!(page.matches("<section ").count(), 1, "{page}");
    assert!(page.contains("gel: errors with faults"), "{page}");
}

#[test]
fn a_page_names_shown_differences_from_a_reference_model_alone() {
    let mut beside = written("gel", "tear", 4.0);
    let page =
        |result: &Value| fault_page(FaultResult::read(&result.to_string()).expect("a result"));
    beside["faults"][0]["difference"] = json!({"Fz": {"value": -0.2, "is_shown": true}});
    let shown = page(&beside);
    let words =
        "; the fault adds less error to Fz than to the same channels of the reference model.";
    assert!(shown.contains(words), "{shown}");
    beside["faults"][0]["difference"]["Fz"]["is_shown"] = json!(false);
    assert!(!page(&beside).contains("reference model"));
}

#[test]
fn a_sensor_with_fewer_tested_severities_is_not_ranked_against_others() {
    let mut fewer = written("fewer", "tear", 1.2);
    let severities = fewer["faults"][0]["severities"].as_array_mut();
    severities.expect("a list").pop();
    let fewer = FaultResult::read(&fewer.to_string()).expect("a result");
    let [weak, strong] = [drawn("weak", "tear", 4.0), drawn("strong", "tear", 2.0)];
    let studies = [fewer, weak, strong].map(Study::of_faults);
    let choice = choose_results(&studies, &Need::parse("rugged").expect("a need"));
    let ranked: Vec<&str> = choice.ranked.iter().map(|of| of.name.as_str()).collect();
    assert_eq!(ranked, ["strong", "weak"]);
    assert_eq!(choice.apart[0].name, "fewer");
}

#[test]
fn another_schema_is_refused_and_not_taken_for_faults() {
    let mut other = written("gel", "tear", 4.0);
    other["schema"] = json!("taceva.stress/2");
    let text = other.to_string();
    assert!(!FaultResult::is_in(&text));
    let error = FaultResult::read(&text).expect_err("another schema");
    assert_eq!(
        error.to_string(),
        "schema: expected `taceva.stress/1`, found `taceva.stress/2`"
    );
}

#[test]
fn a_minor_version_of_the_schema_is_read() {
    let mut newer = written("gel", "tear", 4.0);
    newer["schema"] = json!("taceva.stress/1.1");
    let text = newer.to_string();
    assert!(FaultResult::is_in(&text));
    FaultResult::read(&text).expect("the same numbers");
    newer["schema"] = json!("taceva.stress/10");
    assert!(!FaultResult::is_in(&newer.to_string()));
}

#[test]
fn a_fault_of_times_alone_has_no_row_and_hides_no_end_of_skill() {
    let mut timed = written("gel", "tear,dropped_frames", 4.0);
    let faults = timed["faults"].as_array_mut().expect("a list");
    faults.push(json!({
        "id": "dropped_frames", "note": "times alone", "severities": [{"severity": 1, "stale": {}}],
        "unreached": [], "breaks_at": {}
    }));
    let timed = FaultResult::read(&timed.to_string()).expect("a result");
    assert_eq!(timed.skill_end("Fz"), Some(3.0));
    let studies = [Study::of_faults(timed)];
    let page = report(&ReportPage {
        title: "worn",
        studies: &studies,
        pictures: &[],
        triples: &[],
    });
    assert!(!page.contains("<li>dropped_frames"), "{page}");
    assert!(page.contains("dropped_frames: times alone."), "{page}");
}

#[test]
fn a_page_names_the_inputs_of_its_models() {
    let mut signals = written("skin", "taxel_gain", 4.0);
    signals["input"] = json!("signals");
    let signals = FaultResult::read(&signals.to_string()).expect("a result");
    let page = |results: Vec<FaultResult>| {
        let studies: Vec<Study> = results.into_iter().map(Study::of_faults).collect();
        report(&ReportPage {
            title: "worn",
            studies: &studies,
            pictures: &[],
            triples: &[],
        })
    };
    let alone = page(vec![signals.clone()]);
    assert!(alone.contains("faults of their signals."), "{alone}");
    assert!(alone.contains("no check of signals finds"), "{alone}");
    let both = page(vec![signals, drawn("gel", "tear", 4.0)]);
    let expected = "faults of their pictures or signals.";
    assert!(both.contains(expected), "{both}");
    assert!(both.contains("no check of pictures"), "{both}");
}
