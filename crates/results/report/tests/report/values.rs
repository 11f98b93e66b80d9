//! Tests of values side by side: of results, of the catalogue and of both, at any terminal width.

use serde_json::{Value, json};
use taceva_report::{CompareRequest, Need, ScoreTable, Study, Table, catalogue, choose};

use crate::support;

/// A score of 80 samples with an interval of ±10 %.
fn score(value: f64, unit: &str) -> Value {
    json!({
        "value": value, "unit": unit, "n": 80, "ci95": [value * 0.9, value * 1.1],
        "clusters": 20, "method": "drawn", "definition": "drawn/1"
    })
}

/// A result with the error `mae` of Fz and an R² of 0.9.
fn result(sensor: &str, mae: f64) -> Value {
    json!({
        "schema": "taceva.evaluation/1.0",
        "subject": {"sensor": sensor, "serial": "1", "gel": "1", "source": "simulated"},
        "metrics": {"mae": {"Fz": score(mae, "N")}, "r2": {"Fz": score(0.9, "1")}, "rmse": {"Fz": score(mae, "N")}}
    })
}

fn published(name: &str) -> Study {
    catalogue::find(name).expect("there").as_study()
}

fn values(studies: &[Study], metrics: &[&str], is_all: bool) -> Table {
    let metrics = metrics.iter().map(|metric| (*metric).to_owned());
    let request = CompareRequest {
        metrics: metrics.collect(),
        ..CompareRequest::default()
    };
    ScoreTable::compared(studies, &request).side_by_side(studies, &request, is_all)
}

/// Cells of the row called `name`.
fn row(table: &Table, name: &str) -> Vec<String> {
    let mut rows = table.rows.iter().map(|row| row.plain());
    let found = rows.find(|row| row[0] == name);
    found.unwrap_or_else(|| panic!("no row `{name}`: {}", table.text()))
}

fn has_note(table: &Table, words: &str) -> bool {
    table.notes.iter().any(|note| note.plain().contains(words))
}

#[test]
fn two_results_stand_side_by_side_with_intervals_and_their_number_of_samples() {
    let studies = [result("Fine", 0.25), result("Coarse", 0.75)].map(|of| support::study(&of));
    let table = values(&studies, &[], false);
    assert_eq!(
        table.caption,
        "Values of 2 sensors on 80 simulated samples each, with 95 % intervals."
    );
    let heads: Vec<&str> = table.columns.iter().map(|of| of.name.plain()).collect();
    assert_eq!(heads, ["quantity", "Fine", "Coarse"]);
    let mae = row(&table, "mae Fz (N) ↓");
    assert!(
        mae[1].starts_with("0.25") && mae[1].contains("0.225 … 0.275"),
        "{mae:?}"
    );
    assert!(mae[2].starts_with("0.7"), "{mae:?}");
    let is_rmse = |table: &Table| table.text().contains("rmse");
    assert!(!is_rmse(&table) && is_rmse(&values(&studies, &[], true)));
    assert!(is_rmse(&values(&studies, &["rmse"], false)));
}

#[test]
fn two_entries_of_the_catalogue_show_their_numbers_and_facts_and_what_is_not_published() {
    let table = values(&[published("GelSight"), published("DIGIT")], &[], false);
    assert_eq!(
        table.caption,
        "Values of 2 sensors, as published, without intervals."
    );
    assert_eq!(
        row(&table, "mae Fz (N) ↓")[1..3],
        ["0.0361", "not in the catalogue"]
    );
    let rate = row(&table, "intrinsic frame_rate (Hz)");
    assert_eq!(rate[1..], ["25", "60", "other sources"]);
    assert_eq!(row(&table, "size (mm)")[2], "20 × 27 × 18");
    let parts = "15 USD (parts of one sensor, of 1000 made), 2026-11-28";
    assert_eq!(row(&table, "cost of parts")[2], parts);
    let price = row(&table, "price");
    assert!(price[1].starts_with("510 USD, "), "{price:?}");
    assert_eq!(price[2], "not in the catalogue");
    assert_eq!(row(&table, "availability")[2], "bought; built");
    assert!(has_note(
        &table,
        "not in the catalogue: the entry has none; a publication may have one."
    ));
    assert!(has_note(&table, "taceva catalogue show NAME"));
    let only = values(
        &[published("GelSight"), published("DIGIT")],
        &["mae"],
        false,
    );
    assert!(!only.text().contains("USD"), "{}", only.text());
}

#[test]
fn published_numbers_of_one_row_say_whether_source_conditions_and_definition_are_the_same() {
    let origins = |names: [&str; 2], quantity: &str| {
        let cells = row(&values(&names.map(published), &[], false), quantity);
        cells.last().cloned().expect("a cell")
    };
    let study = ["GelSight", "MagicTac"];
    assert_eq!(origins(study, "mae Fz (N) ↓"), "one source");
    assert_eq!(
        origins(study, "intrinsic resolution (px)"),
        "other conditions"
    );
    let others = ["GelSight", "DIGIT"];
    assert_eq!(
        origins(others, "intrinsic field_of_view (mm²)"),
        "other sources"
    );
    assert_eq!(
        origins(others, "intrinsic resolution (px)"),
        "definitions differ"
    );
    let thick = ["ViTacTip", "PaXini DP-S1813-Elite"];
    assert_eq!(
        origins(thick, "intrinsic thickness (mm)"),
        "definitions differ"
    );
    let table = values(&others.map(published), &[], false);
    assert!(
        has_note(&table, "`definitions differ`: not comparable"),
        "{}",
        table.text()
    );
    assert!(has_note(
        &table,
        "‡: no test shows whether the predictions behind the number"
    ));
}

#[test]
fn a_result_stands_beside_an_entry_of_the_catalogue() {
    let mine = support::study(&result("Mine", 0.25));
    let table = values(&[mine, published("GelSight")], &[], false);
    assert!(
        table.caption.contains("some as published"),
        "{}",
        table.caption
    );
    assert_eq!(row(&table, "mae Fz (N) ↓")[2], "0.0361");
    assert_eq!(row(&table, "intrinsic frame_rate (Hz)")[1], "not scored");
    assert_eq!(row(&table, "gel_thickness gel (mm)")[1], "unknown");
    assert_eq!(row(&table, "samples")[1..], ["80", "–"]);
    for words in ["not scored: the result has no such score.", "unknown: the "] {
        assert!(has_note(&table, words), "{words}: {}", table.text());
    }
}

#[test]
fn an_undefined_a_skipped_and_an_excluded_value_say_why_and_where() {
    let mut weak = result("Weak", 0.25);
    weak["metrics"]["r2"]["Fz"] = json!({"value": 0.1, "unit": "1", "n": 80, "ci95": [-0.2, 0.4]});
    weak["metrics"]["hysteresis"] = json!({"Fz": {"undefined": "no unloading", "n": 0, "n_invalid": 0, "definition": "drawn/1"}});
    weak["skipped"] = json!([{"what": "metric:uniformity", "reason": "one place"}]);
    let mut other = result("Other", 0.5);
    other["metrics"]["uniformity"] = json!({"Fz": score(0.9, "1")});
    other["metrics"]["hysteresis"] = json!({"Fz": score(0.5, "N·mm")});
    let table = values(&[support::study(&weak), support::study(&other)], &[], false);
    let mae = row(&table, "mae Fz (N) ↓");
    assert!(mae[1].contains('†') && !mae[2].contains('†'), "{mae:?}");
    assert_eq!(row(&table, "hysteresis Fz (N·mm) ↓")[1], "undefined");
    assert_eq!(row(&table, "uniformity Fz ↑")[1], "skipped");
    for words in [
        "†, excluded from verdicts: not better than predicting the mean (Weak: mae Fz (N), ",
        "undefined: no unloading (Weak: hysteresis Fz (N·mm)).",
        concat!("skipped", ": one place (Weak: uniformity Fz)."),
    ] {
        assert!(has_note(&table, words), "{words}: {}", table.text());
    }
}

/// Asserts that each line fits `width`, and that every cell and note is present.
fn assert_whole_within(table: &Table, width: usize) -> String {
    let text = table.text_within(width);
    for line in text.lines() {
        assert!(line.chars().count() <= width, "{width}: {line}\n{text}");
    }
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let joined = words(&text);
    let cells = table.rows.iter().flat_map(|row| row.plain());
    let notes = table.notes.iter().map(|note| note.plain().to_owned());
    for part in cells.chain(notes) {
        assert!(joined.contains(&words(&part)), "{width}: {part}\n{text}");
    }
    text
}

#[test]
fn a_terminal_of_forty_columns_shows_one_sensor_after_the_other_and_loses_nothing() {
    let studies = [result("Fine", 0.25), result("Coarse", 0.75)].map(|of| support::study(&of));
    let table = values(&studies, &[], false);
    let narrow = assert_whole_within(&table, 40);
    let heads = |text: &str| {
        text.lines()
            .filter(|line| line.starts_with("quantity"))
            .count()
    };
    assert_eq!(
        (heads(&narrow), heads(&table.text_within(100))),
        (2, 1),
        "{narrow}"
    );
    for (width, names) in [
        (40, ["GelSight", "MagicTac"]),
        (40, ["GelSight", "DIGIT"]),
        (60, ["DIGIT", "TacTip"]),
        (100, ["GelSight", "ViTacTip"]),
    ] {
        assert_whole_within(&values(&names.map(published), &[], true), width);
    }
}

#[test]
fn a_choice_shows_the_numbers_of_every_sensor_that_was_considered() {
    let needs = Need::parse("accurate shear, ambient light").expect("needs");
    let sensors = ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"];
    let sensors = sensors.map(|name| catalogue::find(name).expect("there"));
    let choice = choose(&sensors, &needs);
    let table = choice.values();
    let places: Vec<Vec<String>> = table.rows.iter().map(|row| row.plain()).collect();
    let place = |name: &str| {
        let found = places.iter().find(|cells| cells[0] == name);
        found.unwrap_or_else(|| panic!("no row of {name}"))[1].clone()
    };
    let found = ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"].map(place);
    assert_eq!(found[..2], ["1", "2"]);
    assert!(
        found[2..]
            .iter()
            .all(|place| !place.starts_with(char::is_numeric)),
        "{found:?}"
    );
    assert!(table.text().contains("MAE of Fxy ↓"), "{}", table.text());
    assert!(table.text().contains("0.0245 N"), "{}", table.text());
    assert_whole_within(&table, 40);
}

#[test]
fn a_published_number_keeps_its_digits() {
    let table = values(&["GelSightWM", "ViTacTip"].map(published), &["mae"], false);
    let error = &row(&table, "mae Pxy (mm) ↓")[1];
    assert!(error.starts_with("0.1445"), "{error}");
}
