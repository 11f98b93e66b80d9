//! Golden values, and comparison with them.

use serde_json::Value;

/// A file of golden values.
pub(crate) fn golden(text: &str) -> Value {
    serde_json::from_str(text).expect("golden values are JSON")
}

/// The golden case whose name begins with `name`.
pub(crate) fn case(name: &str) -> Value {
    let file = golden(include_str!("../golden/limits.json"));
    let cases = file["cases"].as_array().expect("cases");
    let is_it = |case: &&Value| {
        case["name"]
            .as_str()
            .is_some_and(|text| text.starts_with(name))
    };
    cases.iter().find(is_it).expect("a case").clone()
}

/// The number at the JSON pointer `pointer`.
pub(crate) fn number(of: &Value, pointer: &str) -> f64 {
    of.pointer(pointer)
        .and_then(Value::as_f64)
        .unwrap_or_else(|| panic!("no number at {pointer}"))
}

/// Fails if `found` is not within `relative` of `expected`.
pub(crate) fn close(found: f64, expected: f64, relative: f64, name: &str) {
    let off = (found - expected).abs() / expected.abs().max(f64::MIN_POSITIVE);
    let is_close = off <= relative || found.to_bits() == expected.to_bits();
    assert!(
        is_close,
        "{name}: {found} is not {expected}, off by {off:.1e}"
    );
}
