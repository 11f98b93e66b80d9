//! Decoder of CDR, the encoding of ROS 2. The offset of a number, counted from the end of the first four bytes, is a multiple of its size.
//!
//! ROS 1 messages are packed without alignment from the first byte on.

use super::schema::{Count, Dialect, Field, Kind, Message, RosSchema};
use crate::cell::Cell;
use crate::limits;

/// Request for parts of a message or a field, which are stored in numbered slots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Want {
    /// Skips the field.
    Nothing,
    /// Stores the whole field as a cell in the slot with this number.
    Whole(usize),
    /// Stores the bytes of a list of `uint8` in the slot with this number.
    Bytes(usize),
    /// One request for each field of a message.
    Fields(Vec<Want>),
}

/// Reader of the bytes of a message.
#[derive(Debug)]
pub(crate) struct Cdr<'a> {
    bytes: &'a [u8],
    at: usize,
    is_big_endian: bool,
    dialect: Dialect,
    /// Number of cells created from this message.
    cells: usize,
}

impl<'a> Cdr<'a> {
    /// Creates the reader of `message`. A ROS 2 message begins with four bytes that state its encoding.
    pub(crate) fn new(message: &'a [u8], dialect: Dialect) -> Result<Cdr<'a>, String> {
        if dialect == Dialect::Ros1 {
            return Ok(Cdr {
                bytes: message,
                at: 0,
                is_big_endian: false,
                dialect,
                cells: 0,
            });
        }
        let Some((head, bytes)) = message.split_first_chunk::<4>() else {
            return Err(format!(
                "a message of {} bytes has no CDR header",
                message.len()
            ));
        };
        let is_big_endian = match head[..2] {
            [0, 0] => true,
            [0, 1] => false,
            [0, kind] if kind < 12 => {
                return Err(format!(
                    "encapsulation {kind} of CDR, expected 0 or 1 as ROS 2 writes it"
                ));
            }
            _ => {
                return Err(format!(
                    "the message begins with {:02x} {:02x}, which is not CDR",
                    head[0], head[1]
                ));
            }
        };
        Ok(Cdr {
            bytes,
            at: 0,
            is_big_endian,
            dialect,
            cells: 0,
        })
    }

    /// Reads the message once. Stores the parts that `want` requests in `slots`.
    pub(crate) fn read(
        &mut self,
        schema: &RosSchema,
        want: &Want,
        slots: &mut [Cell],
    ) -> Result<(), String> {
        self.message(schema, schema.root(), want, slots)
    }

    fn message(
        &mut self,
        schema: &RosSchema,
        message: &Message,
        want: &Want,
        slots: &mut [Cell],
    ) -> Result<(), String> {
        if message.fields.is_empty() && self.dialect == Dialect::Ros2 {
            // A ROS 2 message without fields has one byte.
            self.take(1)?;
        }
        for (at, field) in message.fields.iter().enumerate() {
            let want = match want {
                Want::Fields(wants) => wants.get(at).unwrap_or(&Want::Nothing),
                _ => &Want::Nothing,
            };
            self.field(schema, field, want, slots).map_err(|problem| {
                match problem.starts_with('`') {
                    true => problem,
                    false => format!("`{}` of {}: {problem}", field.name, message.name),
                }
            })?;
        }
        Ok(())
    }

    fn field(
        &mut self,
        schema: &RosSchema,
        field: &Field,
        want: &Want,
        slots: &mut [Cell],
    ) -> Result<(), String> {
        match want {
            Want::Whole(slot) => {
                let cell = self.cell(schema, field)?;
                if let Some(slot) = slots.get_mut(*slot) {
                    *slot = cell;
                }
                Ok(())
            }
            Want::Bytes(slot) => {
                let count = self.count(field)?;
                let bytes = self.take(count)?.to_vec();
                if let Some(slot) = slots.get_mut(*slot) {
                    *slot = Cell::Bytes(bytes);
                }
                Ok(())
            }
            Want::Fields(_) => match (field.kind, field.count) {
                (Kind::Message(place), Count::One) => {
                    self.message(schema, schema.message(place), want, slots)
                }
                _ => self.pass(schema, field),
            },
            Want::Nothing => self.pass(schema, field),
        }
    }

    /// Skips the next field of the message.
    fn pass(&mut self, schema: &RosSchema, field: &Field) -> Result<(), String> {
        let count = self.count(field)?;
        if let Some(size) = field.kind.size() {
            if count > 0 {
                self.align(size);
            }
            return self.take(count.checked_mul(size).ok_or(CUT)?).map(drop);
        }
        for _ in 0..count {
            match field.kind {
                Kind::Message(place) => {
                    self.message(schema, schema.message(place), &Want::Nothing, &mut [])?
                }
                _ => drop(self.text_bytes()?),
            }
        }
        Ok(())
    }

    /// Reads the next field to a cell, which is a list if the field is an array.
    fn cell(&mut self, schema: &RosSchema, field: &Field) -> Result<Cell, String> {
        if field.count == Count::One {
            return self.one(schema, field.kind);
        }
        let count = self.count(field)?;
        self.cells = self.cells.saturating_add(count);
        if self.cells > limits::MESSAGE_CELLS {
            return Err(format!(
                "{count} elements, at most {} per message become cells",
                limits::MESSAGE_CELLS
            ));
        }
        let mut cells = Vec::with_capacity(count);
        for _ in 0..count {
            cells.push(self.one(schema, field.kind)?);
        }
        Ok(Cell::List(cells))
    }

    fn one(&mut self, schema: &RosSchema, kind: Kind) -> Result<Cell, String> {
        Ok(match kind {
            Kind::Bool => match self.number::<1>()? {
                [0] => Cell::Bool(false),
                [1] => Cell::Bool(true),
                [other] => return Err(format!("a boolean has the value {other}, expected 0 or 1")),
            },
            Kind::I8 => Cell::Integer(i8::from_le_bytes(self.number()?).into()),
            Kind::U8 => Cell::Integer(u8::from_le_bytes(self.number()?).into()),
            Kind::I16 => Cell::Integer(i16::from_le_bytes(self.number()?).into()),
            Kind::U16 => Cell::Integer(u16::from_le_bytes(self.number()?).into()),
            Kind::I32 => Cell::Integer(i32::from_le_bytes(self.number()?).into()),
            Kind::U32 => Cell::Integer(u32::from_le_bytes(self.number()?).into()),
            Kind::I64 => Cell::Integer(i64::from_le_bytes(self.number()?).into()),
            Kind::U64 => Cell::Integer(u64::from_le_bytes(self.number()?).into()),
            Kind::F32 => Cell::Number(f32::from_le_bytes(self.number()?).into()),
            Kind::F64 => Cell::Number(f64::from_le_bytes(self.number()?)),
            Kind::Text => Cell::Text(self.text()?.to_owned()),
            Kind::Message(place) => {
                let message = schema.message(place);
                if message.fields.is_empty() && self.dialect == Dialect::Ros2 {
                    self.take(1)?;
                }
                let mut members = Vec::with_capacity(message.fields.len());
                for field in &message.fields {
                    members.push((field.name.clone(), self.cell(schema, field)?));
                }
                Cell::Struct(members)
            }
        })
    }

    /// Number of elements of the next field. An element takes at least one byte, so a number that exceeds the number of remaining bytes is rejected.
    fn count(&mut self, field: &Field) -> Result<usize, String> {
        let count = match field.count {
            Count::One => 1,
            Count::Fixed(count) => count,
            Count::Any => u32::from_le_bytes(self.number()?) as usize,
        };
        let least = match field.kind {
            Kind::Text => 4,
            kind => kind.size().unwrap_or(1),
        };
        let left = self.bytes.len().saturating_sub(self.at);
        match count.checked_mul(least).is_some_and(|bytes| bytes <= left) {
            true => Ok(count),
            false => Err(format!(
                "{count} elements are announced, but only {left} bytes follow"
            )),
        }
    }

    /// Reads the length of a text, then its bytes.
    fn text_bytes(&mut self) -> Result<&'a [u8], String> {
        let length = u32::from_le_bytes(self.number()?) as usize;
        self.take(length)
    }

    fn text(&mut self) -> Result<&'a str, String> {
        let bytes = self.text_bytes()?;
        // The length includes a zero at the end.
        let text = bytes.strip_suffix(&[0]).unwrap_or(bytes);
        std::str::from_utf8(text).map_err(|_| "a string is not UTF-8".to_owned())
    }

    /// Reads the next number of `N` bytes, and returns its bytes in little-endian order.
    fn number<const N: usize>(&mut self) -> Result<[u8; N], String> {
        self.align(N);
        let bytes = self.take(N)?;
        let mut number: [u8; N] = bytes.try_into().map_err(|_| CUT)?;
        if self.is_big_endian {
            number.reverse();
        }
        Ok(number)
    }

    fn align(&mut self, size: usize) {
        if self.dialect == Dialect::Ros2 {
            self.at = self.at.next_multiple_of(size);
        }
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let end = self.at.checked_add(count).ok_or(CUT)?;
        let taken = self.bytes.get(self.at..end).ok_or(CUT)?;
        self.at = end;
        Ok(taken)
    }
}

/// Error message if a message is shorter than its schema.
const CUT: &str = "the message is shorter than its schema";
