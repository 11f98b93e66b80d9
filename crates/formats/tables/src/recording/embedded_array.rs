//! NumPy arrays in JSON messages. An array is an object with its type, its shape, and its bytes as base64.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value};

use crate::cell::Cell;

/// Accepted names of the object member that contains the bytes of an array.
const BYTES: [&str; 3] = ["data_b64", "data_base64", "b64"];
/// Maximum number of elements of an array that is converted to numbers. The bytes of a larger array remain base64 text.
const MOST_NUMBERS: u64 = 1 << 16;

/// Numbers of an array in a JSON object, as nested lists of its shape; `None` for another object.
///
/// # Errors
/// Error message if the bytes do not match the stated type and shape.
pub(super) fn cell(members: &Map<String, Value>) -> Result<Option<Cell>, String> {
    let bytes = BYTES.iter().find_map(|name| members.get(*name)?.as_str());
    let (Some(bytes), Some(kind), Some(shape)) = (bytes, kind(members), shape(members)) else {
        return Ok(None);
    };
    let count = shape
        .iter()
        .try_fold(1_u64, |count, side| count.checked_mul(*side))
        .filter(|count| *count <= MOST_NUMBERS);
    let (Some(count), Some((width, number))) = (count, reader(kind)) else {
        return Ok(None);
    };
    let bytes = STANDARD
        .decode(bytes)
        .map_err(|error| format!("the bytes of an array are not base64: {error}"))?;
    if bytes.len() as u64 != count * width as u64 {
        return Err(format!(
            "an array of {} bytes, expected {count} numbers `{kind}` of {width} bytes",
            bytes.len()
        ));
    }
    let mut numbers: Vec<Cell> = bytes.chunks_exact(width).map(number).collect();
    for side in shape.iter().skip(1).rev() {
        let side = usize::try_from(*side).unwrap_or(usize::MAX).max(1);
        let rows = numbers.chunks(side);
        numbers = rows.map(|row| Cell::List(row.to_vec())).collect();
    }
    Ok(match shape.is_empty() {
        true => numbers.pop(),
        false => Some(Cell::List(numbers)),
    })
}

/// True if a cell states the type and shape of an array but contains no numbers.
pub(super) fn is_summary(cell: &Cell) -> bool {
    let Cell::Struct(members) = cell else {
        return false;
    };
    let has = |wanted: &str| members.iter().any(|(name, _)| name == wanted);
    let is_list = |wanted: &str| {
        let mut found = members.iter().filter(|(name, _)| name == wanted);
        found.any(|(_, cell)| matches!(cell, Cell::List(_)))
    };
    has("dtype")
        && is_list("shape")
        && !BYTES
            .iter()
            .chain(&["data", "values"])
            .any(|name| has(name))
}

fn kind(members: &Map<String, Value>) -> Option<&str> {
    members.get("dtype")?.as_str()
}

fn shape(members: &Map<String, Value>) -> Option<Vec<u64>> {
    let sides = members.get("shape")?.as_array()?;
    sides.iter().map(Value::as_u64).collect()
}

/// Converter of bytes to a number.
type NumberReader = fn(&[u8]) -> Cell;

/// Width in bytes of the number type `kind`, and its converter; `None` for an unsupported type.
fn reader(kind: &str) -> Option<(usize, NumberReader)> {
    fn bytes<const N: usize>(bytes: &[u8]) -> [u8; N] {
        bytes.try_into().unwrap_or([0; N])
    }
    Some(match kind.trim_start_matches(['<', '|', '=']) {
        "f4" | "float32" => (4, |own| Cell::Number(f32::from_le_bytes(bytes(own)).into())),
        "f8" | "float64" => (8, |own| Cell::Number(f64::from_le_bytes(bytes(own)))),
        "u1" | "uint8" => (1, |own| Cell::Integer(u8::from_le_bytes(bytes(own)).into())),
        "i1" | "int8" => (1, |own| Cell::Integer(i8::from_le_bytes(bytes(own)).into())),
        "u2" | "uint16" => (2, |own| {
            Cell::Integer(u16::from_le_bytes(bytes(own)).into())
        }),
        "i2" | "int16" => (2, |own| {
            Cell::Integer(i16::from_le_bytes(bytes(own)).into())
        }),
        "u4" | "uint32" => (4, |own| {
            Cell::Integer(u32::from_le_bytes(bytes(own)).into())
        }),
        "i4" | "int32" => (4, |own| {
            Cell::Integer(i32::from_le_bytes(bytes(own)).into())
        }),
        "u8" | "uint64" => (8, |own| {
            Cell::Integer(u64::from_le_bytes(bytes(own)).into())
        }),
        "i8" | "int64" => (8, |own| {
            Cell::Integer(i64::from_le_bytes(bytes(own)).into())
        }),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn read(value: &Value) -> Result<Option<Cell>, String> {
        cell(value.as_object().expect("an object"))
    }

    #[test]
    fn numbers_of_an_embedded_array_stand_in_lists_by_its_shape() {
        let bytes: Vec<u8> = [1.5_f32, -2.0, 0.25, 8.0, 1e-3, 7.0]
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        let array = json!({"dtype": "<f4", "shape": [2, 3], "data_b64": STANDARD.encode(&bytes)});
        let found = read(&array).expect("an array").expect("numbers");
        assert_eq!(found.at("[1,0]"), Some(&Cell::Number(8.0)));
        assert_eq!(found.at("[0,2]"), Some(&Cell::Number(0.25)));
        let array =
            json!({"dtype": "int16", "shape": [3], "b64": STANDARD.encode([1, 0, 255, 255, 0, 1])});
        let found = read(&array).expect("an array").expect("numbers");
        assert_eq!(found.text(), "[1, -1, 256]");
    }

    #[test]
    fn an_embedded_array_of_other_bytes_than_its_shape_is_refused() {
        for (shape, bytes) in [
            (json!([4]), "AAAA"),
            (json!([1]), "AAAAAAAAAAA="),
            (json!([0]), "AAAA"),
        ] {
            let array = json!({"dtype": "<f4", "shape": shape, "data_b64": bytes});
            assert!(
                read(&array).expect_err("refused").contains("expected"),
                "{array}"
            );
        }
        let array = json!({"dtype": "<f4", "shape": [1], "data_b64": "?"});
        assert!(read(&array).expect_err("refused").contains("base64"));
    }

    #[test]
    fn other_objects_are_no_embedded_arrays() {
        for object in [
            json!({"dtype": "<f4", "shape": [2], "min": 0.0}),
            json!({"data_b64": "AAAA"}),
            json!({"dtype": ">f4", "shape": [1], "data_b64": "AAAAAA=="}),
            json!({"dtype": "u1", "shape": [100_000, 100_000], "data_b64": "AA=="}),
        ] {
            assert_eq!(read(&object), Ok(None), "{object}");
        }
    }
}
