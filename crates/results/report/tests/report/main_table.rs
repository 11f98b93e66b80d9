//! Tests of the main table of a paper: its content for every kind of result, and its fit in a paper column.

use serde_json::{Value, json};
use taceva_report::{Layout, ScoreTable, Study, Table};

use crate::paper::{assert_fits_a_column, assert_fits_by_lualatex};
use crate::support;

/// A result with these channels, each with MAE, R² and sMAPE and their intervals.
fn result(sensor: &str, channels: &[&str]) -> Value {
    let mut metrics = json!({});
    for (at, channel) in (0..).zip(channels) {
        let unit = if channel.starts_with('P') { "mm" } else { "N" };
        let score = |value: f64, unit: &str| {
            json!({"value": value, "unit": unit, "n": 20, "n_invalid": 0, "ci95": [value * 0.93, value * 1.04],
                "method": "jackknife by point_id, G=20", "definition": "drawn/1"})
        };
        metrics["mae"][*channel] = score(0.0361 + 0.01 * f64::from(at), unit);
        metrics["r2"][*channel] = score(0.95, "1");
        metrics["smape"][*channel] = score(0.1234, "1");
        metrics["hysteresis"][*channel] = score(0.5, "N·mm");
    }
    json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": sensor, "source": "simulated"},
        "metrics": metrics,
        "provenance": {"taceva": "0.2.0", "part": "test",
            "model": {"name": "ridge", "settings": {}, "digest": "d", "fitted_on": "f"}}
    })
}

const PLANES: [&str; 4] = ["Fxy", "Fz", "Pxy", "Pz"];

fn tables(studies: &[Study]) -> Vec<Table> {
    let scores = ScoreTable::of(studies);
    scores.for_column(&scores.caption())
}

/// Main tables of `studies` as LaTeX. Asserts that each table fits a column.
fn latex(name: &str, studies: &[Study]) -> String {
    let text = text(studies);
    assert_fits_a_column(name, &text);
    text
}

fn text(studies: &[Study]) -> String {
    let tables = tables(studies);
    let texts = tables.iter().map(|table| table.latex(Layout::Column));
    texts.collect()
}

fn assert_holds(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn one_result_has_a_row_a_channel_and_says_how_many_samples_and_clusters_were_scored() {
    let text = latex("one", &[support::study(&result("GelSight", &PLANES))]);
    assert_holds(
        &text,
        &[
            "\\caption{Accuracy of GelSight (ridge) on 20 simulated test samples in 20 clusters by contact point, with 95 \\% intervals.}",
            "MAE $\\downarrow$ & $R^2$ $\\uparrow$ & sMAPE $\\downarrow$ \\\\",
            "$F_{xy}$ (N) & 0.0361 & 0.950 & 0.123 \\\\",
            "\\scriptsize [0.0336, 0.0375]",
            "\\toprule",
        ],
    );
    assert!(!text.contains("hysteresis"), "{text}");
}

#[test]
fn four_sensors_stand_in_columns_with_the_best_in_bold() {
    let sensors = ["ViTacTip", "MagicTac", "GelSight", "GelSightWM"];
    let studies: Vec<Study> = (0..)
        .zip(sensors)
        .map(|(at, name)| {
            let mut result = result(name, &PLANES);
            if at > 0 {
                for channel in PLANES {
                    let score = &mut result["metrics"]["mae"][channel];
                    *score = json!({"value": 0.4, "unit": score["unit"], "n": 20 + at, "ci95": [0.38, 0.42],
                        "method": "jackknife by point_id, G=20", "definition": "drawn/1"});
                }
            }
            support::study(&result)
        })
        .collect();
    assert_eq!(tables(&studies).len(), 1);
    let text = latex("four", &studies);
    assert_holds(
        &text,
        &[
            "Accuracy of 4 sensors on simulated test samples, with 95 \\% intervals.",
            "\\multicolumn{5}{@{}l}{MAE $\\downarrow$} \\\\",
            "\\textbf{0.036}",
            "$n$ & 20 & 20--21 & 20--22 & 20--23 \\\\",
            "Bold: better than every other sensor at a level of 5 \\% after Holm's adjustment.",
        ],
    );
}

#[test]
fn sensors_that_need_two_tables_are_divided_evenly_and_their_names_stay_whole() {
    let sensors = ["ViTacTip", "MagicTac", "GelSight", "GelSightWM"];
    let studies = sensors.map(|name| {
        let mut result = result(name, &PLANES);
        result["metrics"]["mae"]["Fxy"]["value"] = 0.0091.into();
        result["metrics"]["mae"]["Fxy"]["ci95"] = json!([0.0055, 0.0152]);
        support::study(&result)
    });
    let columns = tables(&studies)
        .into_iter()
        .map(|table| table.columns.len());
    assert_eq!(columns.collect::<Vec<_>>(), [3, 3]);
    let text = latex("two tables", &studies);
    assert_holds(
        &text,
        &[
            " & ViTacTip & MagicTac \\\\",
            " & GelSight & GelSightWM \\\\",
        ],
    );
}

#[test]
fn a_result_without_intervals_says_so_and_why() {
    let mut result = result("GelSight", &PLANES);
    for metric in ["mae", "r2", "smape"] {
        for channel in PLANES {
            result["metrics"][metric][channel]["ci95"] = json!({"undefined": "one contact point"});
        }
    }
    let text = latex("no intervals", &[support::study(&result)]);
    let caption = "on 20 simulated test samples, without intervals (one contact point).";
    assert_holds(
        &text,
        &[
            caption,
            "$F_{xy}$ (N) & 0.0361\\dag{} & 0.950\\dag{} & 0.123\\dag{}",
        ],
    );
    assert!(!text.contains('['), "{text}");
}

#[test]
fn a_result_of_one_sample_speaks_of_one_sample() {
    let mut result = result("GelSight", &["Fz"]);
    for metric in ["mae", "r2", "smape"] {
        result["metrics"][metric]["Fz"]["n"] = 1.into();
        result["metrics"][metric]["Fz"]["ci95"] = json!({"undefined": "one sample"});
    }
    result["metrics"]["r2"]["Fz"] =
        json!({"undefined": "one sample", "n": 1, "definition": "drawn/1"});
    let text = latex("one sample", &[support::study(&result)]);
    assert_holds(&text, &["on 1 simulated test sample,", " & -- & "]);
}

#[test]
fn forty_channels_stand_in_tables_that_fit_a_page() {
    let names: Vec<String> = (0..40)
        .map(|at| format!("left_taxel_{at}_pressure"))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let study = support::study(&result("Hand", &names));
    let drawn = tables(std::slice::from_ref(&study));
    assert_eq!(drawn.len(), 3);
    let rows: usize = drawn.iter().map(|table| table.rows.len()).sum();
    assert_eq!(rows, 40);
    let text = latex("forty channels", &[study]);
    assert_holds(&text, &["intervals, part 2 of 3.", "taxel\\_39\\_"]);
}

#[test]
fn sensors_of_different_channels_keep_every_row() {
    let studies = [
        support::study(&result("one", &["Fz", "Pz"])),
        support::study(&result("two", &["Fz", "yaw"])),
    ];
    let text = latex("different channels", &studies);
    assert_holds(
        &text,
        &["$P_{z}$ (mm) & 0.0461 & --", "yaw (N) & -- & 0.0461"],
    );
}

#[test]
fn ten_sensors_stand_in_several_tables() {
    let names: Vec<String> = (0..10)
        .map(|at| format!("GelSight Mini number {at}"))
        .collect();
    let studies: Vec<Study> = names
        .iter()
        .map(|name| support::study(&result(name, &PLANES)))
        .collect();
    assert!(tables(&studies).len() > 1);
    let text = latex("ten sensors", &studies);
    assert_holds(
        &text,
        &[
            "number\\\\9",
            "Accuracy of 10 sensors on 20 simulated test samples each",
        ],
    );
}

#[test]
fn names_in_any_script_compile_with_pdflatex_and_lualatex() {
    let names = [
        "Ünïcode Őńę «ð»",
        "触覚センサー",
        "Датчик силы",
        "مستشعر",
        "สัมผัส",
        "a_b & 50 % #1 {x} $y$ ^2 ~ \\end{document} <\"'> | µm · ≤ → ε 🤖",
    ];
    let mut all = String::new();
    for name in names {
        let mut one = result(name, &["Fz", name]);
        one["provenance"]["model"]["name"] = name.into();
        let studies = [
            support::study(&one),
            support::study(&result("other", &["Fz", name])),
        ];
        all += &text(&studies);
        all += &text(&studies[..1]);
        all += "\\clearpage\n";
    }
    assert_holds(&all, &["\\tacevaletter{89E6}{触}", "Ünïcode"]);
    assert_fits_a_column("names", &all);
    assert_fits_by_lualatex("names", &all);
}

#[test]
fn a_caption_of_many_recordings_counts_them() {
    let mut result = result("GelSight", &PLANES);
    let recordings: Vec<Value> = (0..60)
        .map(|at| json!({"name": format!("monday_{at}"), "digest": "d", "samples": 40}))
        .collect();
    result["provenance"]["recordings"] = recordings.into();
    let text = latex("many recordings", &[support::study(&result)]);
    assert_holds(
        &text,
        &["on 20 simulated test samples of 60 recordings in 20 clusters by contact point, with"],
    );
    assert!(!text.contains("monday"), "{text}");
}

#[test]
fn a_caption_of_folds_says_that_each_sample_was_held_out() {
    let mut result = result("GelSight", &PLANES);
    result["provenance"]["split"] = "cv:5 by-column:video".into();
    result["provenance"]["samples"] = json!({"test": 20, "train": 0, "validation": 0});
    let study = support::study(&result);
    let caption = ScoreTable::of(std::slice::from_ref(&study)).caption();
    assert_eq!(
        caption,
        "Accuracy of GelSight (ridge) on 20 simulated samples in 20 clusters by contact point, each held out once (5-fold cross-validation by \
         video), with 95 % intervals."
    );
    let page = taceva_report::report(&taceva_report::ReportPage {
        title: "folds",
        studies: &[study],
        pictures: &[],
        triples: &[],
    });
    let methods = "Each sample was held out once, and predicted by a model that was fitted without its group (5-fold cross-validation by \
        video; split cv:5 by-column:video).";
    assert!(page.contains(methods), "{page}");
    let once = "<dd>20 samples, each predicted once by one of 5 models</dd>";
    assert!(page.contains(once), "{page}");
    assert!(!page.contains("<dt>part</dt>"), "{page}");
}

#[test]
fn the_page_of_one_result_explains_no_bold_value() {
    let page = |studies: &[Study]| {
        taceva_report::report(&taceva_report::ReportPage {
            title: "bold",
            studies,
            pictures: &[],
            triples: &[],
        })
    };
    let [one, other] = ["one", "two"].map(|name| support::study(&result(name, &PLANES)));
    assert!(!page(std::slice::from_ref(&one)).contains("Bold: shown"));
    assert!(page(&[one, other]).contains("Bold: shown"));
}

#[test]
fn caption_and_page_name_the_groups_that_intervals_leave_out() {
    let mut result = result("GelSight", &PLANES);
    result["provenance"]["split"] = "cv:5 by-column:object".into();
    result["provenance"]["samples"] = json!({"test": 20, "train": 0, "validation": 0});
    for (_, channels) in result["metrics"].as_object_mut().into_iter().flatten() {
        for (_, score) in channels.as_object_mut().into_iter().flatten() {
            score["method"] = "jackknife by group, G=5, logarithmic".into();
        }
    }
    let study = support::study(&result);
    let caption = ScoreTable::of(std::slice::from_ref(&study)).caption();
    assert_eq!(
        caption,
        "Accuracy of GelSight (ridge) on 20 simulated samples of 5 groups by object, each held out once (5-fold cross-validation by \
         object), with 95 % intervals."
    );
    let page = taceva_report::report(&taceva_report::ReportPage {
        title: "groups",
        studies: &[study],
        pictures: &[],
        triples: &[],
    });
    for words in [
        "n = 20 of 5 groups.",
        "apply to other groups by object on the same units with models fitted in the same way;",
        "All intervals are of 95 %, over groups by object unless a line says otherwise.",
        "<li>jackknife by object, G=5, logarithmic</li>",
    ] {
        assert!(page.contains(words), "{words}: {page}");
    }
}

#[test]
fn results_without_accuracy_keep_their_other_scores() {
    let mut result = result("GelSight", &["Fz"]);
    let metrics = result["metrics"].as_object_mut().expect("metrics");
    for metric in ["mae", "r2", "smape"] {
        metrics.remove(metric);
    }
    let text = latex("no accuracy", &[support::study(&result)]);
    assert_holds(&text, &["Scores of GelSight (ridge)", "hysteresis"]);
}

#[test]
fn published_numbers_are_said_to_be_published() {
    let studies: Vec<Study> = ["GelSight", "MagicTac"]
        .iter()
        .filter_map(|name| taceva_report::catalogue::find(name))
        .map(|sensor| sensor.as_study())
        .collect();
    let text = latex("published", &studies);
    assert_holds(
        &text,
        &["Accuracy of 2 sensors, as published, without intervals."],
    );
}

#[test]
fn named_channels_have_rows_of_their_own_beside_a_plane() {
    let studies = [support::study(&result(
        "GelSight",
        &["Fx", "Fy", "Fxy", "Fz"],
    ))];
    let rows = |names: &[&str]| -> Vec<String> {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let scores = ScoreTable::of(&studies).of_channels(&names);
        let rows = scores.main().rows.into_iter();
        rows.filter(|row| row.metric == "mae")
            .map(|row| row.channel)
            .collect()
    };
    assert_eq!(rows(&[]), ["Fxy", "Fz"]);
    assert_eq!(rows(&["Fx", "Fy", "Fz"]), ["Fx", "Fy", "Fz"]);
}
