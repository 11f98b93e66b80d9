//! Tests that the user glossary has every printed word of a verdict, and no other.

use serde_json::json;
use taceva_metrics::Standing;
use taceva_metrology::conformity::Word;
use taceva_report::{Cell, CompareRequest, Need, Study, catalogue, choose, compare};

use crate::compare::{errors, score, study};

fn glossary() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../docs/glossary.md");
    std::fs::read_to_string(path).expect("there")
}

/// Rows of a section of the glossary, as cells.
fn rows(section: &str) -> Vec<Vec<String>> {
    let text = glossary();
    let (_, after) = text
        .split_once(&format!("\n## {section}\n"))
        .unwrap_or_else(|| panic!("no section {section}"));
    let section = after.split("\n## ").next().expect("a section");
    let lines = section.lines().filter_map(|line| line.strip_prefix("| "));
    let cells = lines.map(|line| {
        let cells = line.trim_end_matches('|').split(" | ");
        cells.map(|cell| cell.trim().to_owned()).collect()
    });
    // Skips the heads.
    cells.skip(1).collect()
}

#[test]
fn every_standing_has_one_row_with_its_phrase_its_word_in_files_and_what_narrows_it() {
    let rows = rows("Standings");
    assert_eq!(rows.len(), Standing::ALL.len(), "{rows:?}");
    for standing in Standing::ALL {
        let Some((phrase, words)) = standing.phrase().zip(standing.words()) else {
            continue;
        };
        let words = format!("`{words}`");
        let found = rows
            .iter()
            .filter(|row| row[0] == phrase && row[1] == words);
        let found: Vec<&Vec<String>> = found.collect();
        assert_eq!(found.len(), 1, "{phrase}, {words}: {rows:?}");
        assert!(
            found[0].len() == 4 && !found[0][3].is_empty(),
            "{:?}",
            found[0]
        );
    }
}

#[test]
fn the_words_of_limits_and_of_places_are_in_the_glossary() {
    let needs = Need::parse("accurate shear, ambient light, rate >= 20 Hz").expect("needs");
    let mut sensors = catalogue::all();
    let barred = sensors.iter_mut().flat_map(|sensor| &mut sensor.results);
    let mut barred = barred.filter(|result| result.metric == "mae" && result.channel == "Fxy");
    if let Some(result) = barred.next() {
        result.standing = Standing::NoSkill;
    }
    let table = choose(&sensors, &needs).values();
    let places = table.rows.iter().map(|row| row.plain()[1].clone());
    let places = places.filter(|place| !place.starts_with(char::is_numeric));
    let mut words: Vec<String> = places.collect();
    words.extend([true, false].map(|is_met| Cell::Verdict(is_met).plain()));
    words.sort();
    words.dedup();
    assert_eq!(words.len(), 5, "{words:?}");
    let text = glossary();
    for word in words {
        assert!(text.contains(&format!("`{word}`")), "{word}");
    }
}

#[test]
fn the_words_of_decision_rules_are_in_the_glossary() {
    let rows = rows("Decisions on limits");
    let words = [
        Word::Pass,
        Word::ConditionalPass,
        Word::ConditionalFail,
        Word::Fail,
        Word::Undecided,
    ];
    for (row, word) in rows.iter().zip(words) {
        assert_eq!(row[0], format!("`{word}`"));
    }
    assert!(rows.len() > words.len(), "{rows:?}");
}

/// All answers and decisions on `studies`.
fn said(studies: &[Study], margin: Option<f64>) -> Vec<String> {
    let margins = margin.map(|margin| ("mae".to_owned(), margin));
    let request = CompareRequest {
        metrics: ["mae", "sr", "sensitivity"].map(str::to_owned).to_vec(),
        margins: margins.into_iter().collect(),
        ..CompareRequest::default()
    };
    let comparison = compare(studies, &request);
    let answers = comparison.answers.iter();
    let answers = answers.map(|answer| answer.words(&comparison.names));
    let decisions = comparison.decisions().into_iter();
    answers.chain(decisions.map(|of| of.words)).collect()
}

#[test]
fn every_answer_is_a_word_of_the_glossary_and_every_word_is_an_answer() {
    let share = |sensor| study(sensor, &[("sr", "line", score(0.875, 0.01, "1"))], &[]);
    let softness = |sensor, value| {
        let value = score(value, 0.01, "mm/N");
        study(sensor, &[("sensitivity", "Fz", value)], &[])
    };
    let bare = |sensor, mae: serde_json::Value| study(sensor, &[("mae", "Fz", mae)], &["Fz"]);
    let mut weak = errors(&[("one", 0.5), ("two", 0.75)]);
    for score in weak.iter_mut().flat_map(|study| &mut study.scores) {
        score.standing = Standing::NoSkill;
    }
    let undefined =
        json!({"undefined": "one sample", "n": 1, "n_invalid": 0, "definition": "drawn/1"});
    let published = json!({"value": 0.5, "unit": "N", "n": 80, "definition": "drawn/1"});
    let texts = [
        said(&errors(&[("fine", 0.25), ("coarse", 0.75)]), None),
        said(&errors(&[("coarse", 0.75), ("fine", 0.25)]), None),
        said(&errors(&[("one", 0.5), ("two", 0.501)]), None),
        said(&errors(&[("one", 0.5), ("two", 0.501), ("far", 0.9)]), None),
        said(&errors(&[("one", 0.5), ("two", 0.501)]), Some(1.0)),
        said(&[softness("soft", 0.9), softness("hard", 0.1)], None),
        said(&[share("one"), share("two")], None),
        said(
            &[bare("one", published.clone()), bare("two", published)],
            None,
        ),
        said(
            &[bare("one", score(0.5, 0.01, "N")), bare("two", undefined)],
            None,
        ),
        said(&weak, None),
    ]
    .concat();
    let rows = rows("Answers");
    let words: Vec<&str> = rows.iter().map(|row| row[0].trim_matches('`')).collect();
    assert!(words.len() > 10, "{words:?}");
    for text in &texts {
        assert!(words.iter().any(|word| text.contains(word)), "{text}");
    }
    for word in words {
        assert!(
            texts.iter().any(|text| text.contains(word)),
            "{word}: {texts:#?}"
        );
    }
}
