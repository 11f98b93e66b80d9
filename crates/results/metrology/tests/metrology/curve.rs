//! Calibration curves: published fits, detection, figures like those of ISO 376 and ISO 7500-1, bad input.

mod bad_input;
mod fits;
mod indications;
mod proving;

use serde_json::Value;
use taceva_metrology::curve::CurveRow;

/// Case of `limits.json` whose name begins with `name`.
fn case(name: &str) -> Value {
    let golden: Value = serde_json::from_str(include_str!("../golden/limits.json")).expect("JSON");
    let cases = golden["cases"].as_array().expect("cases");
    let is_it = |case: &&Value| {
        case["name"]
            .as_str()
            .is_some_and(|known| known.starts_with(name))
    };
    cases.iter().find(is_it).expect("the case").clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("numbers")
        .iter()
        .map(number)
        .collect()
}

fn rows(x: &[f64], y: &[f64]) -> Vec<CurveRow> {
    x.iter()
        .zip(y)
        .map(|(x, y)| CurveRow::new(*x, *y))
        .collect()
}

fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance * expected.abs(),
        "{found} is not {expected}"
    );
}
