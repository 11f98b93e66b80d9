//! Tests of the methods paragraph, which must be true of every result, and of the citation.

use super::page;
use crate::support::{self, drawn};
use taceva_report::{Layout, ReportPage, device_table, report};

#[test]
fn methods_say_how_it_was_done_and_nothing_that_is_not_known() {
    let page = page(&[drawn("one", 60, 1.0), drawn("two", 60, 1.2)]);
    let text = page
        .split("<p id=\"methods-text\">")
        .nth(1)
        .expect("a paragraph");
    let text = text.split("</p>").next().expect("an end");
    for part in [
        "We evaluated 2 tactile sensors (one and two) with TacEva 0.1.0.",
        "none was measured on hardware",
        "Intervals are of 95 % (jackknife by point_id)",
        "Holm's method",
        "the model one for one",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let empty = support::read(
        &serde_json::json!({"schema": "taceva.evaluation/1.0", "subject": {"sensor": "x"}, "metrics": {}}),
    );
    let page = report(&ReportPage {
        title: "empty",
        studies: &empty.expect("a result"),
        pictures: &[],
        triples: &[],
    });
    assert!(
        page.contains("We evaluated 1 tactile sensor (x) with TacEva of an unknown version.</p>")
    );
}

#[test]
fn methods_are_true_of_every_part_dataset_and_sensor() {
    let parts = ["train", "validation", "test", "all"];
    let cases = parts.iter().flat_map(|part| {
        let bits = 0..8_u8;
        bits.map(move |bits| (*part, bits & 1 > 0, bits & 2 > 0, bits & 4 > 0))
    });
    for (part, is_own, is_same_sensor, is_pressed) in cases {
        let mut result = support::results("one", 1.0);
        result["provenance"]["part"] = part.into();
        result["provenance"]["dataset"] = "sha256:a".into();
        let fitted_on = if is_own { "sha256:a" } else { "sha256:b" };
        result["provenance"]["model"]["fitted_on"] = fitted_on.into();
        let presses = serde_json::json!({"sha256:a": {"complete": 12}});
        result["provenance"]["presses"] = if is_pressed {
            presses
        } else {
            serde_json::json!({})
        };
        let mut other = result.clone();
        if !is_same_sensor {
            other["subject"]["sensor"] = "two".into();
        }
        let page = page(&[support::study(&result), support::study(&other)]);
        let case = format!("{part} {is_own} {is_same_sensor} {is_pressed}");
        let is_seen = is_own && part != "test";
        assert_eq!(page.contains("so they are not a test;"), is_seen, "{case}");
        assert_eq!(
            page.contains("samples that the model had not seen; scores"),
            !is_seen,
            "{case}"
        );
        let counted = "We evaluated 2 results of 1 tactile sensor";
        assert_eq!(page.contains(counted), is_same_sensor, "{case}");
        assert_eq!(
            page.contains("A protocol made 12 presses"),
            is_pressed,
            "{case}"
        );
    }
}

#[test]
fn the_study_is_cited_with_all_of_its_authors() {
    let page = page(&[drawn("one", 30, 1.0)]);
    let entry = page
        .split("@article{taceva-study")
        .nth(1)
        .expect("an entry");
    let authors = entry
        .lines()
        .find(|line| line.contains("author"))
        .expect("they are named");
    assert_eq!(authors.matches(" and ").count(), 5, "{authors}");
    assert!(!page.contains("others}"));
}

#[test]
fn methods_say_that_only_scores_with_skill_are_compared_and_which_marks_there_are() {
    let mut studies = [drawn("one", 30, 1.0), drawn("two", 30, 1.5)];
    let unmarked = page(&studies);
    assert!(unmarked.contains("Scores of predictions are compared only where the model has skill"));
    assert!(unmarked.contains("No score here is excluded"));
    studies[0].scores[0].standing = taceva_metrics::Standing::NoSkill;
    let marked = page(&studies);
    assert!(marked.contains("are marked “not better than predicting the mean” (the skill of the model is not shown to be above zero) and are \
        excluded from comparisons"));
}

#[test]
fn methods_state_how_readings_were_joined_to_samples() {
    let mut result = support::results("one", 1.0);
    let join = "table ft joined by its time stamp: linear between two rows, at most 100 ms away";
    result["provenance"]["notes"] = serde_json::json!([format!("import: {join}")]);
    let page = page(&[support::study(&result)]);
    let words = join.trim_start_matches("table ");
    let sentence = format!(" The import joined tables ({words}).");
    assert!(page.contains(&sentence), "{page}");
}

#[test]
fn methods_claim_no_unseen_places_where_a_recording_names_none() {
    let sentence = "It is unknown if the tested places were seen in training";
    let mut result = support::results("one", 1.0);
    for (note, is_said) in [("the recording names no places", true), ("other", false)] {
        result["provenance"]["notes"] = serde_json::json!([note]);
        let page = page(&[support::study(&result)]);
        assert_eq!(page.contains(sentence), is_said, "{note}");
    }
}

#[test]
fn methods_count_the_samples_that_a_split_leaves_out_of_a_recording_without_protocol() {
    let mut result = support::results("one", 1.0);
    result["provenance"]["split"] = "by-block 70/20/10".into();
    result["provenance"]["presses"] = serde_json::json!({});
    result["provenance"]["samples"] =
        serde_json::json!({"train": 150, "validation": 30, "test": 34, "left_out": 86});
    let page = page(&[support::study(&result)]);
    let sentence = " samples, with 86 samples in no part.";
    assert!(page.contains(sentence), "{page}");
    assert!(page.contains("left out 86"), "{page}");
    assert!(!page.contains("of other parts of the protocol"), "{page}");
}

#[test]
fn methods_state_how_a_fit_chose_its_setting() {
    let mut result = support::results("one", 1.0);
    let how = "strength with each training sample left out in turn";
    result["provenance"]["model"]["chosen_by"] = how.into();
    let page = page(&[support::study(&result)]);
    assert!(page.contains(&format!("; its fit chose {how}.")), "{page}");
}

#[test]
fn the_intervals_of_independent_samples_apply_to_samples() {
    let result = support::results("one", 1.0).to_string();
    let method = "jackknife, samples taken as independent, G=20";
    let result = result.replace("jackknife by point_id, G=20", method);
    let result: serde_json::Value = serde_json::from_str(&result).expect("a result");
    let page = page(&[support::study(&result)]);
    assert!(page.contains(" Intervals apply to other samples on the same units"));
}

/// Methods paragraph of the page.
fn paragraph(studies: &[taceva_report::Study]) -> String {
    let page = page(studies);
    let (_, text) = page
        .split_once("<p id=\"methods-text\">")
        .expect("a paragraph");
    let (text, _) = text.split_once("</p>").expect("an end");
    text.to_owned()
}

/// Asserts that the table of devices states each fact in every format, and the paragraph each value. The JSON of the result is their source.
fn same_facts_in_every_format(study: &taceva_report::Study, paragraph: &str) {
    let table = device_table(std::slice::from_ref(study)).expect("devices");
    let page = page(std::slice::from_ref(study));
    assert!(page.contains("Devices of the recordings"));
    // Both escape signs, but no letters and digits.
    for text in [table.markdown(), table.latex(Layout::Float)] {
        for words in ["transducer", "FT12345", "filter", "v2.7.0"] {
            assert!(text.contains(words), "{words}: {text}");
        }
    }
    let formats = [table.csv(), page];
    for row in [
        ["force transducer", "driver", "ati/netft"],
        ["force transducer", "serial number", "FT12345"],
        [
            "force transducer",
            "certificate",
            "D-K-1 of a laboratory, 2026-05-12",
        ],
        ["force transducer", "filter", "8"],
        ["robot", "firmware", "v2.7.0"],
        ["sensor", "driver", "camera/v4l2"],
    ] {
        for text in &formats {
            assert!(row.iter().all(|cell| text.contains(*cell)), "{row:?}");
        }
        let found = table.rows.iter().any(|of| of.plain()[1..] == row);
        assert!(found && paragraph.contains(row[2]), "{row:?}");
    }
    let latency = ["force transducer", "latency_ms", "31.8 ± 0.3"];
    assert!(table.rows.iter().any(|of| of.plain()[1..] == latency));
    let force = |row: &&taceva_report::Row| row.plain()[1] == "force transducer";
    assert_eq!(table.rows.iter().filter(force).count(), 7);
}

#[test]
fn methods_name_the_devices_of_a_measured_recording_and_invent_none() {
    let mut plain = support::results("one", 1.0);
    plain["subject"]["source"] = "recorded".into();
    let mut equipped = plain.clone();
    equipped["subject"]["sensor"] = "two".into();
    let certificate = serde_json::json!({"number": "D-K-1", "laboratory": "a laboratory", "issued": "2026-05-12",
        "serial": "FT12345", "k": 2.0, "U": {"Fz": "3 mN"}});
    equipped["provenance"]["traceability"] = serde_json::json!([
        {"instrument": "force", "driver": "ati/netft", "serial": "FT12345", "certificate": certificate},
        {"instrument": "robot", "driver": "ufactory/xarm", "serial": "XF1300"},
    ]);
    equipped["provenance"]["devices"] = serde_json::json!({
        "exposure_ms": "15",
        "force_axes": "[\"x\", \"-y\", \"-z\"]",
        "force_filter": "8",
        "force_latency_ms": "31.8",
        "force_latency_u_ms": "0.3",
        "force_rate_hz": "500",
        "force_serial": "FT12345",
        "laboratory": "Soft Robotics",
        "operator": "A. Lovelace",
        "rig_file": "sha256:abc",
        "robot_firmware": "v2.7.0",
        "sensor_clock_drift_ppm": "41.30",
        "sensor_clock_drift_u_ppm": "0.20",
        "sensor_driver": "camera/v4l2",
    });
    let text = paragraph(&[support::study(&equipped)]);
    let expected = "Devices: the force transducer (driver ati/netft; serial number FT12345; certificate D-K-1 of a laboratory, 2026-05-12; \
        axes = [&quot;x&quot;, &quot;-y&quot;, &quot;-z&quot;]; filter = 8; rate_hz = 500; latency of 31.8 ± 0.3 ms subtracted from its stamps) \
        measured the forces; the robot (driver ufactory/xarm; serial number XF1300; firmware = v2.7.0) moved the tip; the sensor (driver \
        camera/v4l2; exposure_ms = 15; clock that drifted by 41.30 ± 0.20 ppm) recorded the frames.";
    assert!(text.contains(expected), "{text}");
    same_facts_in_every_format(&support::study(&equipped), &text);
    let both = paragraph(&[support::study(&plain), support::study(&equipped)]);
    assert!(
        both.contains("Devices of two: the force transducer"),
        "{both}"
    );
    let without = paragraph(&[support::study(&plain)]);
    assert!(!without.contains("Devices"), "{without}");
    assert!(device_table(&[support::study(&plain)]).is_none());
    // An emulated rig names devices that do not exist.
    equipped["subject"]["source"] = "simulated".into();
    let simulated = paragraph(&[support::study(&equipped)]);
    assert!(!simulated.contains("Devices"), "{simulated}");
    assert!(device_table(&[support::study(&equipped)]).is_none());
    assert!(
        simulated.contains("none was measured on hardware"),
        "{simulated}"
    );
}
