//! Python pickles of protocols 2 to 5, with NumPy arrays and plain values.
//!
//! Code of a pickle is never run. This module constructs the values of eleven known names, and rejects any other name.

mod calls;
mod columns;
mod cursor;
mod globals;
mod machine;
mod value;

use std::ops::Range;
use std::sync::Arc;

use crate::block::Block;
use crate::element::{ArrayInfo, Element};
use crate::error::Problem;
use crate::limits;
use crate::source::ByteSource;
use crate::store::{Arrays, Store};
use crate::values::{ArrayData, ArrayValues};

use columns::{Cells, Column, Values, held};
use value::{Bytes, Content, Id, PickledArray, Value};

/// Columns found in a pickle.
#[derive(Debug)]
pub(crate) struct Pickle {
    source: Arc<dyn ByteSource>,
    values: Vec<Value>,
    columns: Vec<(String, Vec<u64>, Stored)>,
    refused: Vec<(String, Problem)>,
}

/// Location of the elements of a column.
#[derive(Debug)]
enum Stored {
    /// One array for all rows, or one array for each row.
    Blocks {
        element: Element,
        blocks: Vec<Block>,
        is_one: bool,
    },
    Plain {
        element: Element,
        ids: Vec<Id>,
    },
}

impl Pickle {
    /// Parses the pickle that begins at `at`. Does not read the elements of arrays.
    pub(crate) fn open(source: Arc<dyn ByteSource>, at: u64) -> Result<Pickle, Problem> {
        let (values, whole) = machine::run(&*source, at)?;
        let text = |bytes: &Bytes| String::from_utf8(machine::read(&*source, bytes).ok()?).ok();
        let (columns, refused) = Values::new(&values, &text).columns(whole)?;
        let columns = columns
            .into_iter()
            .map(|column| stored(&source, column))
            .collect::<Result<_, _>>()?;
        Ok(Pickle {
            source,
            values,
            columns,
            refused,
        })
    }

    fn plain(&self, element: Element, ids: &[Id]) -> Result<ArrayValues, Problem> {
        let mut held_bytes = 0_u64;
        let mut bytes = |bytes: &Bytes| {
            held_bytes = held_bytes.saturating_add(bytes.length());
            if held_bytes > limits::READ_BYTES {
                return Err(Problem::too_large(
                    "bytes of these rows (read fewer at a time)",
                    held_bytes,
                    limits::READ_BYTES,
                ));
            }
            machine::read(&*self.source, bytes)
        };
        let each = ids.iter().map(|id| &self.values[*id as usize]);
        Ok(match element {
            Element::Bool => ArrayValues::Bool(
                each.map(|value| matches!(value, Value::Bool(true)))
                    .collect(),
            ),
            Element::Signed(_) => {
                let number = |value: &Value| {
                    if let Value::Whole(number) = value {
                        *number
                    } else {
                        0
                    }
                };
                ArrayValues::I64(each.map(number).collect())
            }
            Element::Text => {
                let text = |value: &Value| match value {
                    Value::Text(text) => String::from_utf8(bytes(text)?).map_err(|_| {
                        Problem::unsupported("a string that is not UTF-8", "write it again")
                    }),
                    _ => Ok(String::new()),
                };
                ArrayValues::Text(each.map(text).collect::<Result<_, _>>()?)
            }
            Element::Bytes => {
                let own = |value: &Value| {
                    if let Value::Bytes(own) = value {
                        bytes(own)
                    } else {
                        Ok(Vec::new())
                    }
                };
                ArrayValues::Bytes(each.map(own).collect::<Result<_, _>>()?)
            }
            _ => {
                let number = |value: &Value| match value {
                    Value::Float(number) => *number,
                    Value::Whole(number) => *number as f64,
                    _ => 0.0,
                };
                ArrayValues::F64(each.map(number).collect())
            }
        })
    }
}

/// Location of the elements of a column.
fn stored(
    source: &Arc<dyn ByteSource>,
    column: Column,
) -> Result<(String, Vec<u64>, Stored), Problem> {
    let (arrays, is_one) = match column.cells {
        Cells::Plain { element, ids } => {
            return Ok((column.name, column.shape, Stored::Plain { element, ids }));
        }
        Cells::Array(array) => (vec![array], true),
        Cells::Arrays(arrays) => (arrays, false),
    };
    let mut element = Element::Float(64);
    let mut blocks = Vec::with_capacity(arrays.len());
    for PickledArray {
        shape,
        is_fortran,
        content,
    } in arrays
    {
        let Content::Numbers { item, bytes } = content else {
            return Err(Problem::unsupported(
                "an array of objects",
                "write arrays of numbers",
            ));
        };
        element = item
            .fields
            .first()
            .map_or(element, |field| field.scalar.element());
        let (source, at): (Arc<dyn ByteSource>, u64) = match (&bytes, held(&bytes)) {
            (_, Some(held)) => (held, 0),
            (Bytes::InFile { at, .. }, _) => (Arc::clone(source), *at),
            (Bytes::Held(_), None) => continue,
        };
        blocks.push(Block::new(source, at, shape, item, is_fortran)?);
    }
    Ok((
        column.name,
        column.shape,
        Stored::Blocks {
            element,
            blocks,
            is_one,
        },
    ))
}

impl Store for Pickle {
    fn arrays(&self) -> Arrays {
        let info = |(name, shape, stored): &(String, Vec<u64>, Stored)| {
            let (Stored::Blocks { element, .. } | Stored::Plain { element, .. }) = stored;
            (name.clone(), ArrayInfo::new(shape.clone(), *element))
        };
        self.columns.iter().map(info).collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    /// Paths of the dictionaries within the dictionary of the pickle, by their keys: `trajectories.0`.
    fn groups(&self) -> Vec<String> {
        let mut groups = std::collections::BTreeSet::new();
        for (name, ..) in &self.columns {
            let dots = name.match_indices('.');
            groups.extend(dots.map(|(at, _)| name[..at].to_owned()));
        }
        groups.into_iter().collect()
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let (_, shape, stored) = &self.columns[index];
        let mut read = shape.clone();
        if let Some(first) = read.first_mut() {
            *first = rows.end - rows.start;
        }
        let place = |row: u64| usize::try_from(row).unwrap_or(usize::MAX);
        let values = match stored {
            Stored::Plain { element, ids } => {
                let row = shape.get(1..).unwrap_or(&[]).iter().product::<u64>();
                self.plain(
                    *element,
                    &ids[place(rows.start * row)..place(rows.end * row)],
                )?
            }
            Stored::Blocks {
                blocks,
                is_one: true,
                ..
            } => return blocks[0].read(0, rows),
            Stored::Blocks { blocks, .. } => {
                let mut raw = Vec::new();
                for block in &blocks[place(rows.start)..place(rows.end)] {
                    raw.extend(block.raw_rows(0..block.shape().first().copied().unwrap_or(1))?);
                }
                let Some(first) = blocks.first() else {
                    return Ok(ArrayData {
                        shape: read,
                        values: ArrayValues::F64(Vec::new()),
                    });
                };
                return first.item().read(&first.item().fields[0], raw, &read);
            }
        };
        Ok(ArrayData {
            shape: read,
            values,
        })
    }
}
