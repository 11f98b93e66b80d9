//! JSON and JSON lines: a row is a value, and its columns are pointers into it (RFC 6901).

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::members::in_order;
use crate::error::{ImportError, Place, table_error};
use taceva_dataset::internal::{limits, read_capped, shown, utf8};

/// Maximum number of rows that are searched for member names, and of leaves of the first row.
const LISTED: usize = 100;

/// Rows of a JSON file.
#[derive(Debug)]
pub(crate) struct JsonRows {
    path: PathBuf,
    rows: Vec<JsonRow>,
}

#[derive(Debug)]
struct JsonRow {
    /// Name of the row as a member of an object; `None` otherwise.
    key: Option<String>,
    value: Value,
    /// Line of the row; `None` unless the file is JSON lines.
    line: Option<u64>,
}

impl JsonRows {
    /// Reads the rows at the pointer `rows` in the file at `path`. A step `*` matches each member. Without a pointer, the rows are the elements of a list; any
    /// other value is a single row.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming the line of invalid JSON, or if no value is at the pointer.
    pub(super) fn read(path: &Path, rows: Option<&str>) -> Result<JsonRows, ImportError> {
        let whole = text(path)?;
        let value: Value =
            serde_json::from_str(&whole).map_err(|error| no_json(path, &whole, &error, 0))?;
        let pointer = rows.unwrap_or(if value.is_array() { "/*" } else { "" });
        let wrong = |problem: String| ImportError::table(path, problem);
        let ways = ways(pointer);
        let mut found = vec![(None, value)];
        for (depth, way) in ways.iter().enumerate() {
            // A member without a match has no rows.
            let within = found.into_iter();
            let within = within.filter_map(|(key, value)| Some((key, taken(value, way)?)));
            found = within.collect();
            if found.is_empty() {
                return Err(wrong(format!(
                    "no rows at `{}`: correct `rows` of the table in the map",
                    shown(&ways[..=depth].join("/*"))
                )));
            }
            if depth + 1 == ways.len() {
                break;
            }
            // Rows are numbered and joined in file order.
            let in_order = match depth {
                0 => in_order(&whole, way),
                _ => None,
            };
            let each: Option<Vec<_>> = match in_order {
                Some(members) => Some(
                    members
                        .into_iter()
                        .map(|(name, value)| (Some(name), value))
                        .collect(),
                ),
                None => found
                    .into_iter()
                    .map(members)
                    .collect::<Option<Vec<_>>>()
                    .map(|all| all.concat()),
            };
            found = each.ok_or_else(|| {
                wrong(format!(
                    "`{}` is a single value, expected a list or an object: correct `rows` of the table in the map",
                    shown(&ways[..=depth].join("/*"))
                ))
            })?;
        }
        let rows = found.into_iter().map(|(key, value)| JsonRow {
            key,
            value,
            line: None,
        });
        Ok(JsonRows {
            path: path.to_owned(),
            rows: rows.collect(),
        })
    }

    /// Reads JSON lines: each line that is not blank is a row.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming the invalid line.
    pub(super) fn read_lines(path: &Path) -> Result<JsonRows, ImportError> {
        let whole = text(path)?;
        let lines = (1..).zip(whole.lines());
        let lines = lines.filter(|(_, line)| !line.trim().is_empty());
        let rows: Result<Vec<JsonRow>, ImportError> = lines
            .map(|(number, line)| {
                let value = serde_json::from_str(line);
                Ok(JsonRow {
                    key: None,
                    value: value.map_err(|error| no_json(path, line, &error, number - 1))?,
                    line: Some(number),
                })
            })
            .collect();
        Ok(JsonRows {
            path: path.to_owned(),
            rows: rows?,
        })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn rows(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn key(&self, row: usize) -> Option<&str> {
        self.rows[row].key.as_deref()
    }

    /// True if any row has a value at the pointer `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        let mut rows = self.rows.iter();
        match name {
            VALUE => rows.any(|row| is_plain(&row.value)),
            name => name.starts_with('/') && rows.any(|row| row.value.pointer(name).is_some()),
        }
    }

    /// Value at the pointer `name`. If a row is itself a number, text or list, the name `value` denotes the whole row.
    fn at(&self, row: usize, name: &str) -> Option<&Value> {
        let value = &self.rows[row].value;
        match name {
            VALUE => is_plain(value).then_some(value),
            name => value.pointer(name),
        }
    }

    /// Cell at the pointer `name`: texts unchanged, numbers in the shortest form that parses back, lists as JSON, `null` as empty.
    pub(super) fn cell(&self, row: usize, name: &str) -> Cow<'_, str> {
        match self.at(row, name) {
            None | Some(Value::Null) => Cow::Borrowed(""),
            Some(Value::String(text)) => Cow::Borrowed(text.trim()),
            Some(value) => Cow::Owned(value.to_string()),
        }
    }

    /// True if a row has a value at the pointer `name`, and all values at this pointer are integers.
    pub(super) fn holds_integers(&self, name: &str) -> bool {
        let found = (0..self.rows.len()).filter_map(|row| self.at(row, name));
        let mut found = found.filter(|value| !value.is_null()).peekable();
        found.peek().is_some() && found.all(|value| value.is_i64() || value.is_u64())
    }

    pub(super) fn place(&self, row: usize) -> Place {
        match self.rows[row].line {
            Some(line) => Place::line(&self.path, line),
            None => Place::file(&self.path).in_row(row as u64),
        }
    }

    /// Pointers to the leaves of the first row: numbers, texts, and lists of these.
    pub(super) fn leaves(&self) -> Vec<String> {
        let mut found = Vec::new();
        if self.has(VALUE) {
            found.push(VALUE.to_owned());
        } else if let Some(row) = self.rows.first() {
            add_leaves(&row.value, String::new(), &mut found);
        }
        found
    }

    /// Members of the first rows, as pointers.
    pub(super) fn names(&self) -> Vec<String> {
        let objects = self.rows.iter().take(LISTED);
        let members = objects.filter_map(|row| row.value.as_object());
        let names: BTreeSet<String> = members
            .flat_map(|object| object.keys())
            .map(|key| format!("/{}", key.replace('~', "~0").replace('/', "~1")))
            .collect();
        let value = self.has(VALUE).then(|| VALUE.to_owned());
        value.into_iter().chain(names).collect()
    }
}

/// Name of the column of rows that are themselves numbers, texts or lists.
const VALUE: &str = "value";

/// True for a row without members: a number, a text or a list.
fn is_plain(value: &Value) -> bool {
    !value.is_object() && !value.is_null()
}

/// Adds pointers to the leaves of `value`, descending into objects and into lists of objects or lists.
fn add_leaves(value: &Value, pointer: String, found: &mut Vec<String>) {
    if found.len() >= LISTED {
        return;
    }
    match value {
        Value::Object(members) => {
            for (key, value) in members {
                let key = key.replace('~', "~0").replace('/', "~1");
                add_leaves(value, format!("{pointer}/{key}"), found);
            }
        }
        Value::Array(list)
            if list
                .iter()
                .any(|value| value.is_array() || value.is_object()) =>
        {
            for (at, value) in list.iter().enumerate() {
                add_leaves(value, format!("{pointer}/{at}"), found);
            }
        }
        _ => found.push(pointer),
    }
}

/// Parts of a pointer between the steps `*`.
fn ways(pointer: &str) -> Vec<String> {
    let mut ways = vec![String::new()];
    for step in pointer.split('/').skip(1) {
        match (step, ways.last_mut()) {
            ("*", _) | (_, None) => ways.push(String::new()),
            (step, Some(way)) => {
                way.push('/');
                way.push_str(step);
            }
        }
    }
    ways
}

/// Value with the names of the members on the path to it.
type Named = (Option<String>, Value);

/// Members of a list or an object, with names appended to `key`; `None` for any other value.
fn members((key, value): Named) -> Option<Vec<Named>> {
    match value {
        Value::Array(list) => Some(list.into_iter().map(|value| (key.clone(), value)).collect()),
        Value::Object(members) => {
            let full = |name: String| match &key {
                Some(key) => format!("{key}/{name}"),
                None => name,
            };
            let members = members.into_iter();
            Some(
                members
                    .map(|(name, value)| (Some(full(name)), value))
                    .collect(),
            )
        }
        _ => None,
    }
}

/// Text of a file, without the byte order mark.
fn text(path: &Path) -> Result<String, ImportError> {
    let mut bytes = read_capped(path, limits::JSON_BYTES)?;
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    Ok(utf8(path, bytes)?)
}

/// Takes the value at `pointer` out of `value`.
fn taken(mut value: Value, pointer: &str) -> Option<Value> {
    value.pointer_mut(pointer).map(Value::take)
}

/// Error for invalid JSON in `text`. The file has `lines_before` lines before `text`.
fn no_json(path: &Path, text: &str, error: &serde_json::Error, lines_before: u64) -> ImportError {
    let line = u64::try_from(error.line()).unwrap_or(1).max(1);
    table_error!(
        Place::line(path, lines_before + line),
        "invalid JSON: {}",
        json_problem(text, error)
    )
}

/// JSON error in `text` without its line, with a hint for numbers that JSON does not support.
pub(super) fn json_problem(text: &str, error: &serde_json::Error) -> String {
    let (line, column) = (error.line(), error.column());
    let said = error.to_string();
    let place = format!(" at line {line} column {column}");
    let said = said.strip_suffix(place.as_str()).unwrap_or(&said);
    let written = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
    match word_at(written, column) {
        Some(word) => format!(
            "`{word}` in column {column}: JSON has no such number; write `null` for a missing value"
        ),
        None if column == 0 => said.to_owned(),
        None => format!("{said} in column {column}"),
    }
}

/// NaN or infinity, as written around the byte `column`, from 1, of a line; `None` for other text.
fn word_at(line: &str, column: usize) -> Option<&str> {
    let bytes = line.as_bytes();
    let at = column.checked_sub(1)?.min(bytes.len().checked_sub(1)?);
    let is_of_word = |byte: u8| byte.is_ascii_alphabetic() || byte == b'-';
    let before = bytes[..at]
        .iter()
        .rev()
        .take_while(|byte| is_of_word(**byte));
    let behind = bytes[at..].iter().take_while(|byte| is_of_word(**byte));
    let (begin, end) = (at - before.count(), at + behind.count());
    // Next to an ASCII byte there is always a character boundary.
    let word = line.get(begin..end)?;
    let bare = word.trim_start_matches('-').to_ascii_lowercase();
    ["nan", "inf", "infinity"]
        .contains(&bare.as_str())
        .then_some(word)
}

#[cfg(test)]
mod tests;
