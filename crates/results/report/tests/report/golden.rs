//! Compares figures and tables with reviewed files: words exactly, numbers to a tenth of a pixel.
//!
//! `TACEVA_BLESS=1 cargo test -p taceva-report --test golden` writes the files again, for review.

use std::path::Path;

use crate::support::drawn;
use taceva_report::{Layout, ScoreTable, Study, figures};

/// Tolerance of numbers, because machines round the last digit of a sine differently.
const NEAR: f64 = 0.11;

fn studies() -> [Study; 2] {
    [drawn("one", 30, 1.0), drawn("two", 30, 1.5)]
}

#[test]
fn figures_are_as_they_were() {
    for figure in figures(&studies()) {
        if ["resolution", "radar-robustness", "hysteresis"].contains(&figure.id.as_str()) {
            hold(&format!("{}.svg", figure.id), &figure.svg());
        }
    }
}

#[test]
fn tables_are_as_they_were() {
    let table = ScoreTable::of(&studies()).headlines();
    let papers = table.for_papers("Drawn, 5 % & more");
    hold("scores.tex", &papers.latex(Layout::Float));
    hold("scores.md", &table.for_pages().markdown());
}

fn hold(name: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/golden")
        .join(name);
    if std::env::var_os("TACEVA_BLESS").is_some() {
        std::fs::write(&path, found).expect("written");
    }
    let expected = std::fs::read_to_string(&path).expect("there");
    let (found, expected) = (parts(found), parts(&expected));
    for (at, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let is_near = match (found.parse::<f64>(), expected.parse::<f64>()) {
            (Ok(found), Ok(expected)) => (found - expected).abs() <= NEAR,
            _ => found == expected,
        };
        assert!(
            is_near,
            "{name}, part {at}: `{found}`, expected `{expected}`"
        );
    }
    assert_eq!(found.len(), expected.len(), "{name}");
}

/// Splits `text` into numbers and the text between them.
fn parts(text: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    let mut was_number = false;
    for letter in text.chars() {
        let is_number = letter.is_ascii_digit() || letter == '.';
        match parts.last_mut() {
            Some(last) if is_number == was_number => last.push(letter),
            _ => parts.push(letter.to_string()),
        }
        was_number = is_number;
    }
    parts
}
