//! Schema of a stream: the types of its columns, and their buffers in a batch.

use crate::flatbuffer::Table;
use crate::limits;
use crate::parquet::{ColumnKind, LeafForm, Node, NodeKind};
use crate::path::longest;

/// Parts of the schema that the reader uses.
pub(super) struct Schema {
    pub(super) fields: Vec<Field>,
    /// Metadata of the schema, by key.
    pub(super) written: Vec<(String, String)>,
    /// Number of buffers of each batch.
    pub(super) buffers: usize,
}

/// Column, or part of a column.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) name: String,
    /// Index of the first buffer of the field. This is the validity buffer if the field has a validity buffer.
    pub(super) buffer: usize,
    pub(super) kind: FieldKind,
}

#[derive(Clone, Debug)]
pub(super) enum FieldKind {
    Null,
    Bool,
    /// Numbers: the size of each in bytes, and its meaning.
    Fixed(usize, Number),
    /// Texts or bytes of any length. Their offsets have 4 or 8 bytes.
    Bytes {
        is_text: bool,
        offset: usize,
    },
    Struct(Vec<Field>),
    List {
        offset: usize,
        element: Box<Field>,
    },
    FixedList {
        length: u64,
        element: Box<Field>,
    },
}

/// Meaning of the bytes of a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Number {
    Signed,
    Unsigned,
    Float,
    Decimal(i32),
    Time(&'static str),
    /// Bytes that are not a number.
    Opaque,
}

/// Units of times, by their code in the schema.
const UNITS: [&str; 4] = ["s", "ms", "us", "ns"];
/// Remedy for an unsupported type.
const REMEDY: &str = "write Parquet: `ds.to_parquet(\"table.parquet\")` of datasets, `pyarrow.parquet.write_table(table, \
    \"table.parquet\")`";

/// Parses the schema in the header of an Arrow message. The error names the unsupported part and the remedy.
pub(super) fn schema(header: Table<'_>) -> Result<Schema, String> {
    if header.short(0).is_some_and(|order| order != 0) {
        return Err(format!(
            "numbers in big-endian order are not supported: {REMEDY}"
        ));
    }
    let mut made = Made {
        buffers: 0,
        fields: 0,
    };
    let fields = made.children(header, 1, 0)?;
    let pairs = header.tables(2);
    let pairs = pairs.into_iter().flat_map(|pairs| {
        let count = pairs.length().min(limits::NAMES);
        (0..count).filter_map(move |at| pairs.at(at))
    });
    let text = |pair: Table<'_>, number| {
        let bytes = pair.text(number)?;
        String::from_utf8(bytes.to_vec()).ok()
    };
    Ok(Schema {
        written: pairs
            .filter_map(|pair| Some((text(pair, 0)?, text(pair, 1)?)))
            .collect(),
        fields,
        buffers: made.buffers,
    })
}

/// Numbers of fields and buffers parsed so far.
struct Made {
    buffers: usize,
    fields: usize,
}

impl Made {
    fn children(
        &mut self,
        table: Table<'_>,
        number: usize,
        depth: usize,
    ) -> Result<Vec<Field>, String> {
        let Some(children) = table.tables(number) else {
            return Ok(Vec::new());
        };
        let fields = (0..children.length()).map(|at| {
            let child = children.at(at).ok_or("a missing field")?;
            self.field(child, depth)
        });
        fields.collect()
    }

    fn field(&mut self, field: Table<'_>, depth: usize) -> Result<Field, String> {
        let name = String::from_utf8_lossy(field.text(0).unwrap_or_default()).into_owned();
        self.fields += 1;
        if depth > limits::DEPTH || self.fields > limits::NAMES {
            return Err(format!(
                "`{name}` is one of more than {} fields, or nests deeper than {} levels",
                limits::NAMES,
                limits::DEPTH
            ));
        }
        if field.table(4).is_some() {
            return Err(format!(
                "the column `{name}` is a dictionary (of categories), which is not supported: {REMEDY}"
            ));
        }
        let buffer = self.buffers;
        let (kind, own) = self.kind(field, &name)?;
        self.buffers += own;
        let kind = self.nested(kind, field, &name, depth)?;
        Ok(Field { name, buffer, kind })
    }

    /// Kind of a field without its children, and the number of buffers of the field without those of its children.
    fn kind(&self, field: Table<'_>, name: &str) -> Result<(Flat, usize), String> {
        let own = field.table(3);
        let short = |number, otherwise| own.and_then(|own| own.short(number)).unwrap_or(otherwise);
        let integer = |number, otherwise| {
            let given = own.and_then(|own| own.integer(number));
            given.unwrap_or(otherwise)
        };
        let unit = |number: u16| UNITS.get(usize::from(number)).copied().unwrap_or("ns");
        let bits = |bits: i32| usize::try_from(bits).unwrap_or(0) / 8;
        let code = field.byte(2).unwrap_or(0);
        let number = |bytes: usize, number| match (bytes, number) {
            (1..=8, _) | (16, Number::Decimal(_)) => {
                Ok((Flat::Leaf(FieldKind::Fixed(bytes, number)), 2))
            }
            _ => Err(format!(
                "the column `{name}` has numbers of {bytes} bytes, which are not supported: {REMEDY}"
            )),
        };
        let bytes = |is_text, offset| Flat::Leaf(FieldKind::Bytes { is_text, offset });
        Ok(match code {
            1 => (Flat::Leaf(FieldKind::Null), 0),
            2 => {
                let is_signed = own
                    .and_then(|own| own.byte(1))
                    .is_some_and(|byte| byte != 0);
                let form = if is_signed {
                    Number::Signed
                } else {
                    Number::Unsigned
                };
                return number(bits(integer(0, 0)), form);
            }
            3 => return number(2 << short(0, 0).min(2), Number::Float),
            4 => (bytes(false, 4), 3),
            5 => (bytes(true, 4), 3),
            6 => (Flat::Leaf(FieldKind::Bool), 2),
            7 => match integer(1, 0) {
                scale @ 0..=38 => return number(bits(integer(2, 128)), Number::Decimal(scale)),
                scale => {
                    return Err(format!(
                        "the column `{name}` has {scale} decimals, expected 0 to 38"
                    ));
                }
            },
            8 => match short(0, 1) {
                0 => return number(4, Number::Time("d")),
                _ => return number(8, Number::Time("ms")),
            },
            9 => return number(bits(integer(1, 32)), Number::Time(unit(short(0, 1)))),
            10 => return number(8, Number::Time(unit(short(0, 0)))),
            18 => return number(8, Number::Time(unit(short(0, 1)))),
            12 | 17 => (Flat::List(4), 2),
            13 => (Flat::Struct, 1),
            15 => match usize::try_from(integer(0, 0)) {
                Ok(width @ 1..) => (Flat::Leaf(FieldKind::Fixed(width, Number::Opaque)), 2),
                _ => return Err(format!("the column `{name}` has bytes without a length")),
            },
            16 => (
                Flat::FixedList(u64::try_from(integer(0, 0)).unwrap_or(0)),
                1,
            ),
            19 => (bytes(false, 8), 3),
            20 => (bytes(true, 8), 3),
            21 => (Flat::List(8), 2),
            other => {
                let kind = match other {
                    11 => "intervals",
                    14 => "a union of types",
                    22 => "run-length encoded cells",
                    23 | 24 => {
                        "views of strings or bytes, as polars writes them (avoid views with `df.write_ipc(path, \
                         compat_level=pl.CompatLevel.oldest())`)"
                    }
                    25 | 26 => "views of lists",
                    _ => "a type newer than this program",
                };
                return Err(format!(
                    "the column `{name}` holds {kind}, which is not supported: {REMEDY}"
                ));
            }
        })
    }

    fn nested(
        &mut self,
        kind: Flat,
        field: Table<'_>,
        name: &str,
        depth: usize,
    ) -> Result<FieldKind, String> {
        let members = match &kind {
            Flat::Leaf(_) => Vec::new(),
            _ => self.children(field, 5, depth + 1)?,
        };
        let mut members = members;
        let count = members.len();
        let mut element = || match (members.pop(), count) {
            (Some(element), 1) => Ok(Box::new(element)),
            _ => Err(format!(
                "the list `{name}` has {count} kinds of elements, expected one"
            )),
        };
        Ok(match kind {
            Flat::Leaf(kind) => kind,
            Flat::List(offset) => FieldKind::List {
                offset,
                element: element()?,
            },
            Flat::FixedList(length) => FieldKind::FixedList {
                length,
                element: element()?,
            },
            Flat::Struct if count == 0 => {
                return Err(format!("the structure `{name}` has no members"));
            }
            Flat::Struct => FieldKind::Struct(members),
        })
    }
}

/// Kind of a field. Its children are parsed later.
enum Flat {
    Leaf(FieldKind),
    Struct,
    List(usize),
    FixedList(u64),
}

impl Field {
    /// Field as a node of the schema tree that Parquet columns use, so that names, kinds and paths are computed in one place. All levels are 0.
    pub(super) fn node(&self) -> Node {
        let leaf = |kind| NodeKind::Leaf {
            column: self.buffer,
            form: LeafForm::Plain,
            kind,
        };
        Node {
            name: self.name.clone(),
            definition: 0,
            kind: match &self.kind {
                FieldKind::Bool => leaf(ColumnKind::Bool),
                FieldKind::Null => leaf(ColumnKind::Integer),
                FieldKind::Fixed(_, number) => leaf(match number {
                    Number::Signed | Number::Unsigned => ColumnKind::Integer,
                    Number::Float | Number::Decimal(_) => ColumnKind::Number,
                    Number::Time(unit) => ColumnKind::Time(unit),
                    Number::Opaque => ColumnKind::Bytes,
                }),
                FieldKind::Bytes { is_text: true, .. } => leaf(ColumnKind::Text),
                FieldKind::Bytes { is_text: false, .. } => leaf(ColumnKind::Bytes),
                FieldKind::Struct(members) => {
                    NodeKind::Struct(members.iter().map(Field::node).collect())
                }
                FieldKind::List { element, .. } | FieldKind::FixedList { element, .. } => {
                    NodeKind::List {
                        definition: 0,
                        repetition: 0,
                        element: Box::new(element.node()),
                    }
                }
            },
        }
    }
}

/// Finds the column whose name `name` begins with. Of a structure, keeps only the member that `name` selects.
pub(super) fn named(fields: &[Field], name: &str) -> Option<Field> {
    let names = fields.iter().map(|field| field.name.as_str());
    let (at, rest) = longest(name, names)?;
    let field = &fields[at];
    let kind = match &field.kind {
        FieldKind::Struct(members) if !rest.is_empty() => {
            FieldKind::Struct(vec![named(members, rest)?])
        }
        kind => kind.clone(),
    };
    Some(Field {
        kind,
        ..field.clone()
    })
}
