//! Writes a value as YAML, for file formats of other programs.

use serde_json::Value;
use taceva_core::is_obeyed;

/// Block of YAML with the content of `value`. Texts are quoted, keys are not.
pub(crate) fn block(value: &Value) -> String {
    let mut text = String::new();
    write(value, 0, &mut text);
    text
}

/// Writes `value` on its own lines, `depth` levels deep.
fn write(value: &Value, depth: usize, text: &mut String) {
    match value {
        Value::Object(entries) if !entries.is_empty() => {
            for (key, entry) in entries {
                entry_of(&format!("{key}:"), entry, depth, text);
            }
        }
        Value::Array(entries) if !entries.is_empty() => {
            for entry in entries {
                entry_of("-", entry, depth, text);
            }
        }
        scalar => *text += &format!("{}{}\n", "  ".repeat(depth), of_scalar(scalar)),
    }
}

/// Writes `value` after `mark`, which is a key or a dash.
fn entry_of(mark: &str, value: &Value, depth: usize, text: &mut String) {
    *text += &format!("{}{mark}", "  ".repeat(depth));
    let is_block = match value {
        Value::Object(entries) => !entries.is_empty(),
        Value::Array(entries) => !entries.is_empty(),
        _ => false,
    };
    if is_block {
        text.push('\n');
        write(value, depth + 1, text);
    } else {
        *text += &format!(" {}\n", of_scalar(value));
    }
}

/// Formats a scalar. An empty list or map has the form of JSON.
fn of_scalar(value: &Value) -> String {
    match value {
        Value::String(text) => quoted(text),
        // YAML 1.1 takes `1e-7` for a text, so numbers have no exponent.
        Value::Number(number) if number.is_f64() => number
            .as_f64()
            .map_or_else(|| number.to_string(), |own| own.to_string()),
        other => other.to_string(),
    }
}

/// Text between quotes, on one line.
fn quoted(text: &str) -> String {
    let mut written = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => written.extend(['\\', letter]),
            letter if is_obeyed(letter) => {
                written += &format!("\\U{:08X}", u32::from(letter));
            }
            letter => written.push(letter),
        }
    }
    written.push('"');
    written
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn maps_lists_and_scalars_stand_in_blocks_and_texts_are_quoted() {
        let value = json!({
            "a": [{"n": 40, "value": 1e-7}, []],
            "b": {"ci95": [0.5, -2.0], "none": null},
            "c": "Zoë \"O\\'Neil\": #1\n- é\u{202e}",
        });
        let expected = concat!(
            "a:\n  -\n    n: 40\n    value: 0.0000001\n  - []\n",
            "b:\n  ci95:\n    - 0.5\n    - -2\n  none: null\n",
            "c: \"Zoë \\\"O\\\\'Neil\\\": #1\\U0000000A- é\\U0000202E\"\n",
        );
        assert_eq!(block(&value), expected);
    }
}
