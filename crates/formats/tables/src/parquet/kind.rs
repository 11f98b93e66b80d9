//! Kind of a column, from its schema.

use parquet::basic::Type as Physical;

use super::schema::{LeafForm, Node, NodeKind};

/// Kind of the non-null cells of a column.
///
/// ```
/// use taceva_tables::{ColumnKind, ParquetTable};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.parquet");
/// let table = ParquetTable::open(path.as_ref())?;
/// assert_eq!(table.kind("image.bytes")?, ColumnKind::Bytes);
/// assert_eq!(table.kind("ft")?, ColumnKind::List(Box::new(ColumnKind::Number)));
/// assert_eq!(table.kind("ft[0]")?, ColumnKind::Number);
/// # Ok::<(), taceva_tables::TableError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColumnKind {
    /// Truth values.
    Bool,
    /// Integers.
    Integer,
    /// Numbers of half, single or double precision, or decimal numbers.
    Number,
    /// Texts.
    Text,
    /// Bytes, such as encoded pictures.
    Bytes,
    /// Times in the unit `d`, `s`, `ms`, `us` or `ns`, with cells [`Cell::Time`](crate::Cell::Time): points in time since 1970-01-01 00:00 (UTC with a time
    /// zone, otherwise local time), times of day since midnight, and durations.
    Time(&'static str),
    /// Lists of cells of this kind.
    List(Box<ColumnKind>),
    /// Structures.
    Struct,
}

impl ColumnKind {
    pub(crate) fn of_leaf(physical: Physical, form: LeafForm) -> ColumnKind {
        match form {
            LeafForm::Text => ColumnKind::Text,
            LeafForm::Unsigned => ColumnKind::Integer,
            LeafForm::Decimal { .. } | LeafForm::Half => ColumnKind::Number,
            LeafForm::Time(unit) => ColumnKind::Time(unit),
            LeafForm::Plain => match physical {
                Physical::BOOLEAN => ColumnKind::Bool,
                Physical::INT32 | Physical::INT64 => ColumnKind::Integer,
                Physical::INT96 => ColumnKind::Time("ns"),
                Physical::FLOAT | Physical::DOUBLE => ColumnKind::Number,
                Physical::BYTE_ARRAY | Physical::FIXED_LEN_BYTE_ARRAY => ColumnKind::Bytes,
            },
        }
    }

    pub(crate) fn of(node: &Node) -> ColumnKind {
        match &node.kind {
            NodeKind::Leaf { kind, .. } => kind.clone(),
            NodeKind::Struct(_) => ColumnKind::Struct,
            NodeKind::List { element, .. } => ColumnKind::List(Box::new(ColumnKind::of(element))),
        }
    }
}
