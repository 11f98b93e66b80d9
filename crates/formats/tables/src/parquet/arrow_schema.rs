//! Units of durations from the Arrow schema, because Parquet has no type for durations and stores integers.
//!
//! The metadata text under `ARROW:schema` is the base64 of an Arrow IPC message. Its schema is a FlatBuffers table
//! (<https://arrow.apache.org/docs/format/Columnar.html#encapsulated-message-format>). Only names, types, children and units of durations are read. A
//! schema that is inconsistent or has other columns is ignored.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

use super::kind::ColumnKind;
use super::schema::{LeafForm, Node, NodeKind};
use crate::flatbuffer::Table;

/// Type code of a duration in an Arrow schema.
const DURATION: u8 = 18;
/// Header type of a schema message in Arrow IPC.
const SCHEMA: u8 = 1;
/// Maximum length of the Arrow schema text, bytes.
const LONGEST: usize = 1 << 20;

/// Sets the unit of the `columns` that are durations according to the Arrow schema text `text`.
pub(super) fn apply(text: &str, columns: &mut [Node]) {
    let Some(bytes) = (text.len() <= LONGEST)
        .then(|| BASE64_STANDARD.decode(text).ok())
        .flatten()
    else {
        return;
    };
    let fields = message(&bytes).and_then(|message| {
        let is_schema = message.byte(1)? == SCHEMA;
        is_schema.then(|| message.table(2)?.tables(1)).flatten()
    });
    for (position, node) in columns.iter_mut().enumerate() {
        let field = fields.and_then(|fields| fields.at(position));
        if let Some(field) = field.filter(|field| field.text(0) == Some(node.name.as_bytes())) {
            name_units(field, node);
        }
    }
}

/// Sets the unit of the column `node` and of its children from the Arrow field `field`. Both are trees of the same structure and order.
fn name_units(field: Table<'_>, node: &mut Node) {
    let child = |position| field.tables(5)?.at(position);
    match &mut node.kind {
        NodeKind::Leaf { form, kind, .. } => {
            let is_plain = *form == LeafForm::Plain && *kind == ColumnKind::Integer;
            let unit = (is_plain && field.byte(2) == Some(DURATION))
                .then(|| duration(field))
                .flatten();
            if let Some(unit) = unit {
                *form = LeafForm::Time(unit);
                *kind = ColumnKind::Time(unit);
            }
        }
        NodeKind::Struct(members) => {
            for (position, member) in members.iter_mut().enumerate() {
                let own = child(position);
                let own = own.filter(|own| own.text(0) == Some(member.name.as_bytes()));
                if let Some(own) = own {
                    name_units(own, member);
                }
            }
        }
        NodeKind::List { element, .. } => {
            if let Some(own) = child(0) {
                name_units(own, element);
            }
        }
    }
}

/// Unit of a duration field; the default of the Arrow format if the field states no unit.
fn duration(field: Table<'_>) -> Option<&'static str> {
    let unit = field.table(3)?.short(0).unwrap_or(1);
    ["s", "ms", "us", "ns"].get(usize::from(unit)).copied()
}

/// FlatBuffers table of an Arrow message. The length of the message precedes it, in newer files after a marker.
fn message(bytes: &[u8]) -> Option<Table<'_>> {
    let begin = if bytes.get(..4)? == [0xff; 4] { 8 } else { 4 };
    Table::root(bytes.get(begin..)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Vec<Node> {
        let leaf = |name: &str| Node {
            name: name.to_owned(),
            definition: 0,
            kind: NodeKind::Leaf {
                column: 0,
                form: LeafForm::Plain,
                kind: ColumnKind::Integer,
            },
        };
        vec![leaf("d"), leaf("n")]
    }

    /// Schema of `d: duration[us]` and `n: int64`, written by pyarrow 26.
    const WRITTEN: &str = include_str!("arrow_schema.base64");

    #[test]
    fn durations_have_the_unit_that_is_written_and_integers_have_none() {
        let mut found = columns();
        apply(WRITTEN.trim(), &mut found);
        let kinds: Vec<ColumnKind> = found.iter().map(ColumnKind::of).collect();
        assert_eq!(kinds, [ColumnKind::Time("us"), ColumnKind::Integer]);
        // A schema with other column names does not apply.
        let mut other = columns();
        other[0].name = "e".to_owned();
        apply(WRITTEN.trim(), &mut other);
        assert_eq!(ColumnKind::of(&other[0]), ColumnKind::Integer);
    }

    #[test]
    fn a_damaged_schema_ends_nothing() {
        let text = WRITTEN.trim();
        for end in 0..text.len() {
            apply(&text[..end], &mut columns());
        }
        for at in 0..text.len() {
            for letter in ["A", "/", "g", "é"] {
                let mut damaged = text.to_owned();
                damaged.replace_range(at..=at, letter);
                apply(&damaged, &mut columns());
            }
        }
    }
}
