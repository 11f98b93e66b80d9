//! Attributes of groups and datasets, as text.

use std::collections::HashMap;

use hdf5_pure::{AttrValue, File};

/// Attribute `name` of `owner` as text; `None` if the attribute is missing or has no text form.
pub(crate) fn read(file: &File, owner: &str, name: &str) -> Option<String> {
    text(all(file, owner)?.remove(name)?)
}

/// Names of the attributes of `owner`, sorted.
pub(crate) fn names(file: &File, owner: &str) -> Vec<String> {
    let mut names: Vec<String> = all(file, owner)
        .into_iter()
        .flatten()
        .map(|(name, _)| name)
        .collect();
    names.sort_unstable();
    names
}

fn all(file: &File, owner: &str) -> Option<HashMap<String, AttrValue>> {
    if owner.trim_matches('/').is_empty() {
        return file.root().attrs().ok();
    }
    let group = file.group(owner).and_then(|group| group.attrs());
    group.or_else(|_| file.dataset(owner)?.attrs()).ok()
}

fn text(value: AttrValue) -> Option<String> {
    fn list<T: ToString>(values: &[T]) -> String {
        match values {
            [one] => one.to_string(),
            several => format!(
                "[{}]",
                several
                    .iter()
                    .map(T::to_string)
                    .collect::<Vec<_>>()
                    .join(", ")
            ),
        }
    }
    Some(match value {
        AttrValue::F32(value) => value.to_string(),
        AttrValue::F32Array(values) => list(&values),
        AttrValue::F64(value) => value.to_string(),
        AttrValue::F64Array(values) => list(&values),
        AttrValue::I8(value) => value.to_string(),
        AttrValue::I8Array(values) => list(&values),
        AttrValue::I16(value) => value.to_string(),
        AttrValue::I16Array(values) => list(&values),
        AttrValue::I32(value) => value.to_string(),
        AttrValue::I32Array(values) => list(&values),
        AttrValue::I64(value) => value.to_string(),
        AttrValue::I64Array(values) => list(&values),
        AttrValue::U8(value) => value.to_string(),
        AttrValue::U8Array(values) => list(&values),
        AttrValue::U16(value) => value.to_string(),
        AttrValue::U16Array(values) => list(&values),
        AttrValue::U32(value) => value.to_string(),
        AttrValue::U32Array(values) => list(&values),
        AttrValue::U64(value) => value.to_string(),
        AttrValue::U64Array(values) => list(&values),
        AttrValue::String(text)
        | AttrValue::StringSized { value: text, .. }
        | AttrValue::AsciiString(text)
        | AttrValue::AsciiStringSized { value: text, .. }
        | AttrValue::VarLenString(text)
        | AttrValue::VarLenAsciiString(text) => text,
        AttrValue::StringArray(texts)
        | AttrValue::StringArraySized { values: texts, .. }
        | AttrValue::AsciiStringArray(texts)
        | AttrValue::AsciiStringArraySized { values: texts, .. }
        | AttrValue::VarLenAsciiCharArray(texts)
        | AttrValue::VarLenStringArray(texts)
        | AttrValue::VarLenAsciiStringArray(texts) => list(&texts),
        _ => return None,
    })
}
