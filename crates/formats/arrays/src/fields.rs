//! Records: array elements that consist of several consecutive fields. Each field is read as a separate array.

use crate::element::{ArrayInfo, Element};
use crate::error::Problem;
use crate::limits;
use crate::literal::Literal;
use crate::scalar::{Scalar, shown};
use crate::values::{ArrayData, ArrayValues};

/// Field of a record, or the whole element if it is not a record.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Field {
    /// Names of the nested fields, joined by dots, the outermost first; empty if the element is not a record.
    pub(crate) name: String,
    /// Offset of the field within the element, bytes.
    pub(crate) at: usize,
    /// Lengths of the axes within the field.
    pub(crate) extent: Vec<u64>,
    pub(crate) scalar: Scalar,
}

/// Layout of an element of an array in a file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Item {
    /// Size of one element, bytes.
    pub(crate) bytes: usize,
    pub(crate) fields: Vec<Field>,
}

impl Item {
    pub(crate) fn plain(scalar: Scalar) -> Item {
        Item {
            bytes: scalar.bytes(),
            fields: vec![Field {
                name: String::new(),
                at: 0,
                extent: Vec::new(),
                scalar,
            }],
        }
    }

    /// Type of an element that is a single scalar; `None` for other elements, and for elements of zero bytes.
    pub(crate) fn scalar(&self) -> Option<Scalar> {
        match self.fields.as_slice() {
            [field]
                if field.extent.is_empty()
                    && field.scalar.bytes() == self.bytes
                    && self.bytes > 0 =>
            {
                Some(field.scalar)
            }
            _ => None,
        }
    }

    /// Parses a NumPy `descr`, which is a type name or a list of named fields.
    pub(crate) fn from_descr(descr: &Literal) -> Result<Item, Problem> {
        let mut item = Item {
            bytes: 0,
            fields: Vec::new(),
        };
        item.add(descr, "", &[])?;
        Ok(item)
    }

    /// Appends the fields of `descr`, with `name` before their names and `extent` before their axes.
    fn add(&mut self, descr: &Literal, name: &str, extent: &[u64]) -> Result<(), Problem> {
        let unknown = || {
            Problem::unsupported(
                format!("an unsupported type near field `{}`", shown(name)),
                "save each field as a separate array",
            )
        };
        let count = extent
            .iter()
            .try_fold(1_u64, |product, side| product.checked_mul(*side));
        let count = count
            .and_then(|count| usize::try_from(count).ok())
            .ok_or_else(unknown)?;
        let start = self.bytes;
        match descr {
            // Padding bytes have no name.
            Literal::Text(filler)
                if filler.trim_start_matches('|').starts_with('V') && !name.is_empty() =>
            {
                let bytes = filler
                    .trim_start_matches(['|', 'V'])
                    .parse::<usize>()
                    .map_err(|_| unknown())?;
                self.bytes = start.checked_add(bytes).ok_or_else(unknown)?;
                return Ok(());
            }
            Literal::Text(type_name) => {
                let scalar = Scalar::from_numpy(type_name)?;
                self.fields.push(Field {
                    name: name.to_owned(),
                    at: start,
                    extent: extent.to_vec(),
                    scalar,
                });
                self.bytes = scalar.bytes();
            }
            // A field with several records is rejected, because the elements of its inner fields are not contiguous.
            Literal::Sequence(_) if !extent.is_empty() => return Err(unknown()),
            Literal::Sequence(fields) => {
                for field in fields {
                    let Literal::Sequence(parts) = field else {
                        return Err(unknown());
                    };
                    let (own, descr, extent) = match parts.as_slice() {
                        [own, descr] => (own, descr, Vec::new()),
                        [own, descr, extent] => (own, descr, extent.shape().ok_or_else(unknown)?),
                        _ => return Err(unknown()),
                    };
                    let own = match own {
                        Literal::Text(own) => own,
                        // A title and the name.
                        Literal::Sequence(names) => match names.as_slice() {
                            [_, Literal::Text(own)] => own,
                            _ => return Err(unknown()),
                        },
                        _ => return Err(unknown()),
                    };
                    let own = if own.is_empty() { "_" } else { own };
                    let full = if name.is_empty() {
                        own.to_owned()
                    } else {
                        format!("{name}.{own}")
                    };
                    self.add(descr, &full, &extent)?;
                }
                return Ok(());
            }
            _ => return Err(unknown()),
        }
        let end = self
            .bytes
            .checked_mul(count)
            .and_then(|bytes| bytes.checked_add(start));
        self.bytes = end.ok_or_else(unknown)?;
        Ok(())
    }

    /// Names and shapes of the arrays into which the fields of the array `name` are split.
    pub(crate) fn arrays(&self, name: &str, shape: &[u64]) -> Vec<(String, ArrayInfo)> {
        let array = |field: &Field| {
            let name = if field.name.is_empty() {
                name.to_owned()
            } else {
                format!("{name}.{}", field.name)
            };
            let shape = [shape, &field.extent].concat();
            (name, ArrayInfo::new(shape, field.scalar.element()))
        };
        self.fields.iter().map(array).collect()
    }

    /// Reads one field of the elements `raw`, which have the shape `shape`.
    pub(crate) fn read(
        &self,
        field: &Field,
        raw: Vec<u8>,
        shape: &[u64],
    ) -> Result<ArrayData, Problem> {
        let count = elements(shape) * elements(&field.extent);
        let values = field.scalar.decode(self.pick(field, raw), count)?;
        let shape = [shape, &field.extent].concat();
        Ok(ArrayData { shape, values })
    }

    /// Bytes of one field of the elements `raw`.
    pub(crate) fn pick(&self, field: &Field, raw: Vec<u8>) -> Vec<u8> {
        let width = elements(&field.extent) * field.scalar.bytes();
        if width == self.bytes {
            return raw;
        }
        let mut picked = Vec::with_capacity(raw.len() / self.bytes.max(1) * width);
        for item in raw.chunks_exact(self.bytes.max(1)) {
            picked.extend_from_slice(&item[field.at..field.at + width]);
        }
        picked
    }
}

/// Product of the lengths in `shape`. The caller has checked each length against a limit.
fn elements(shape: &[u64]) -> usize {
    let product = shape
        .iter()
        .try_fold(1_u64, |product, side| product.checked_mul(*side));
    product
        .and_then(|count| usize::try_from(count).ok())
        .unwrap_or(usize::MAX)
}

/// Checks the memory that `read` needs for an array of this shape, in addition to `held_bytes`, against the limit.
pub(crate) fn check_read(shape: &[u64], element: Element, held_bytes: u64) -> Result<(), Problem> {
    let least = match element {
        Element::Text | Element::Bytes => size_of::<String>() as u64,
        Element::Bool => 1,
        Element::Unsigned(bits) | Element::Signed(bits) | Element::Float(bits) => {
            u64::from(bits / 8)
        }
    };
    let each = held_bytes.max(least);
    let bytes = shape
        .iter()
        .try_fold(each, |product, side| product.checked_mul(*side));
    match bytes {
        Some(bytes) if bytes <= limits::READ_BYTES => Ok(()),
        more => Err(Problem::too_large(
            "bytes of these rows (read fewer at a time)",
            more.unwrap_or(u64::MAX),
            limits::READ_BYTES,
        )),
    }
}

impl From<ArrayValues> for ArrayData {
    /// Creates data with a single axis.
    fn from(values: ArrayValues) -> ArrayData {
        ArrayData {
            shape: vec![values.len() as u64],
            values,
        }
    }
}
