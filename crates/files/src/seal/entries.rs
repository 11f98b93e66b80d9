//! Entries of a JSON object, in file order and with unchanged formatting.

use crate::seal::error::SealError;

/// JSON object `text` without the entries of `keys`; all other characters are unchanged. `text` must be valid JSON.
pub(crate) fn without(text: &str, keys: &[&str]) -> Result<String, SealError> {
    let no_object = || SealError::Content {
        problem: "expected a JSON object".to_owned(),
    };
    let (before, inside) = text.split_once('{').ok_or_else(no_object)?;
    let (inside, after) = inside.rsplit_once('}').ok_or_else(no_object)?;
    let written = inside.trim_end();
    let end = &inside[written.len()..];
    let mut kept = Vec::new();
    for entry in split(written) {
        if !keys.contains(&key_of(entry)?.as_str()) {
            kept.push(entry);
        }
    }
    Ok(format!("{before}{{{}{end}}}{after}", kept.join(",")))
}

/// Splits `inside`, the content of an object, at the commas between entries.
fn split(inside: &str) -> Vec<&str> {
    let (mut depth, mut start) = (0_usize, 0);
    let (mut is_text, mut is_escaped) = (false, false);
    let mut entries = Vec::new();
    for (at, byte) in inside.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = is_text,
            b'"' => is_text = !is_text,
            _ if is_text => {}
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            b',' if depth == 0 => {
                entries.push(&inside[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    if !inside.is_empty() {
        entries.push(&inside[start..]);
    }
    entries
}

/// Key at the start of an entry.
fn key_of(entry: &str) -> Result<String, SealError> {
    let mut texts = serde_json::Deserializer::from_str(entry).into_iter::<String>();
    let key = texts.next().transpose();
    let key = key.map_err(|error| SealError::Content {
        problem: error.to_string(),
    })?;
    key.ok_or_else(|| SealError::Content {
        problem: "an entry has no key".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_named_entries_go_and_no_other_letter_changes() {
        let without = |text: &str| without(text, &["seal", "history"]).expect("an object");
        let pretty = "{\n  \"z\": 1.50,\n  \"seal\": {\"a\": [1, 2], \"b\": \"}, \\\" {\"},\n  \"a\": \"é, \\\\\",\n  \"history\": []\n}\n";
        assert_eq!(
            without(pretty),
            "{\n  \"z\": 1.50,\n  \"a\": \"é, \\\\\"\n}\n"
        );
        assert_eq!(without("{\"s\\u0065al\":1,\"b\":2}"), "{\"b\":2}");
        assert_eq!(without("{\"seal\":1}"), "{}");
        assert_eq!(without("{ }"), "{ }");
    }
}
