//! Reader of JSON messages.

use serde_json::Value;

use super::embedded_array;
use crate::cell::Cell;
use crate::limits;

/// Parses a JSON message to a cell, or returns an error message. `serde_json` limits the nesting to 128 levels.
pub(super) fn cell(message: &[u8]) -> Result<Cell, String> {
    if message.len() as u64 > limits::JSON_BYTES {
        return Err(format!("{} bytes of JSON", message.len()));
    }
    let value = serde_json::from_slice(message);
    of_value(value.map_err(|error| format!("not JSON: {error}"))?)
}

fn of_value(value: Value) -> Result<Cell, String> {
    Ok(match value {
        Value::Null => Cell::Null,
        Value::Bool(value) => Cell::Bool(value),
        Value::Number(number) => match (number.as_u64(), number.as_i64()) {
            (Some(value), _) => Cell::Integer(value.into()),
            (None, Some(value)) => Cell::Integer(value.into()),
            (None, None) => number.as_f64().map_or(Cell::Null, Cell::Number),
        },
        Value::String(text) => Cell::Text(text),
        Value::Array(values) => {
            let cells: Result<_, String> = values.into_iter().map(of_value).collect();
            Cell::List(cells?)
        }
        Value::Object(members) => match embedded_array::cell(&members)? {
            Some(array) => array,
            None => {
                let members = members.into_iter();
                let cells: Result<_, String> = members
                    .map(|(name, value)| Ok((name, of_value(value)?)))
                    .collect();
                Cell::Struct(cells?)
            }
        },
    })
}

/// Adds to `into` the names of the members of `cell` that state the shape of an array but contain no numbers. `above` precedes each name.
pub(super) fn add_absent_arrays(cell: &Cell, above: &str, into: &mut Vec<String>) {
    let Cell::Struct(members) = cell else { return };
    for (name, member) in members {
        let name = format!("{above}{name}");
        match embedded_array::is_summary(member) {
            true => into.push(name),
            false => add_absent_arrays(member, &format!("{name}."), into),
        }
    }
}

/// Adds to `into` the names of the members of `cell` that are not objects. `above` precedes each name.
pub(super) fn add_names(cell: &Cell, above: &str, into: &mut Vec<String>) {
    let Cell::Struct(members) = cell else { return };
    for (name, member) in members {
        let name = format!("{above}{name}");
        match member {
            Cell::Struct(_) => add_names(member, &format!("{name}."), into),
            _ => into.push(name),
        }
    }
}
