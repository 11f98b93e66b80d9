//! Fill value of elements that were never written.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;

use crate::fields::Item;

/// Bytes of one element of the type `item` with the fill value `value`; `None` if the value is of an unknown kind.
pub(crate) fn fill(value: &Value, item: &Item) -> Option<Vec<u8>> {
    let zero = || Some(vec![0; item.bytes]);
    let scalar = match item.fields.as_slice() {
        [field] if field.name.is_empty() => Some(field.scalar),
        _ => None,
    };
    match (value, scalar) {
        (Value::Null, _) => zero(),
        (Value::String(text), _) if text.is_empty() => zero(),
        (Value::Number(number), _) if number.to_string() == "0" => zero(),
        (Value::Bool(is_true), Some(scalar)) => scalar.encode(&u8::from(*is_true).into()),
        (Value::Number(number), Some(scalar)) => scalar.encode(number),
        (Value::String(text), Some(scalar)) => {
            float(text).map_or_else(|| bytes(text, item), |number| scalar.encode_float(number))
        }
        (Value::String(text), None) => bytes(text, item),
        _ => None,
    }
}

/// Floating-point number by its name: NaN and infinities, which JSON cannot express as numbers.
fn float(text: &str) -> Option<f64> {
    match text {
        "NaN" => Some(f64::NAN),
        "Infinity" => Some(f64::INFINITY),
        "-Infinity" => Some(f64::NEG_INFINITY),
        _ => None,
    }
}

/// Decodes a base64 fill value, as zarr version 2 writes it for texts and records.
fn bytes(text: &str, item: &Item) -> Option<Vec<u8>> {
    let bytes = BASE64_STANDARD.decode(text).ok()?;
    (bytes.len() == item.bytes).then_some(bytes)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::scalar::Scalar;

    #[test]
    fn fill_values_are_the_bytes_of_one_element() {
        let of = |name: &str| Item::plain(Scalar::from_numpy(name).expect("known"));
        for (value, name, expected) in [
            (json!(-4), ">i2", Some(vec![0xff, 0xfc])),
            (json!(1.5), "<f4", Some(1.5_f32.to_le_bytes().to_vec())),
            (
                json!("-Infinity"),
                "<f8",
                Some(f64::NEG_INFINITY.to_le_bytes().to_vec()),
            ),
            (json!(true), "|b1", Some(vec![1])),
            (json!(null), "<f8", Some(vec![0; 8])),
            (json!("YWJj"), "|S3", Some(b"abc".to_vec())),
            (json!("YWI="), "|S3", None),
            (json!(300), "|u1", None),
            (json!(-1), "|u1", None),
            (json!({"a": 1}), "<f8", None),
        ] {
            assert_eq!(fill(&value, &of(name)), expected, "{value} {name}");
        }
    }
}
