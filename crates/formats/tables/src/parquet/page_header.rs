//! Header of a Parquet page: a structure in the compact protocol of Thrift. Only the fields that the reader needs are kept.
//!
//! Field and type numbers are from `parquet.thrift`, version 2.12. Statistics, which may contain two whole pictures, are skipped.

use std::io::{BufRead, Read};

use crate::limits;

/// Fields of a page header.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct PageHeader {
    pub(super) kind: PageKind,
    /// Size of the page in the file, without its header, bytes.
    pub(super) packed: u32,
    pub(super) unpacked: u32,
    /// CRC-32 of the page as stored in the file; `None` if the file states none.
    pub(super) crc: Option<u32>,
    pub(super) values: u32,
    pub(super) encoding: i32,
    /// Encoding of the definition levels, for data pages of version 1. `repetition_encoding` is that of the repetition levels.
    pub(super) definition_encoding: i32,
    pub(super) repetition_encoding: i32,
    /// Number of nulls, for data pages of version 2. Their levels are uncompressed, with known sizes.
    pub(super) nulls: u32,
    pub(super) rows: u32,
    pub(super) definition_bytes: u32,
    pub(super) repetition_bytes: u32,
    pub(super) is_packed: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum PageKind {
    #[default]
    Data,
    Index,
    Dictionary,
    DataV2,
}

/// Reads a page header. Returns the header and its size in bytes, or an error message.
pub(super) fn read_header(from: &mut impl BufRead) -> Result<(PageHeader, u64), String> {
    let mut thrift = Thrift { from, read: 0 };
    let mut header = PageHeader {
        is_packed: true,
        ..PageHeader::default()
    };
    let mut fields = Fields::default();
    let mut kind = None;
    let (mut packed, mut unpacked, mut values) = (None, None, None);
    while let Some((field, form)) = thrift.field(&mut fields)? {
        match (field, form) {
            (1, Form::I32) => {
                kind = Some(match thrift.int()? {
                    0 => PageKind::Data,
                    1 => PageKind::Index,
                    2 => PageKind::Dictionary,
                    3 => PageKind::DataV2,
                    other => return Err(format!("a page of kind {other}, expected 0 to 3")),
                });
            }
            (2, Form::I32) => unpacked = Some(thrift.count("bytes unpacked")?),
            (3, Form::I32) => packed = Some(thrift.count("bytes")?),
            (4, Form::I32) => {
                let crc = thrift.int()?.to_le_bytes();
                header.crc = Some(u32::from_le_bytes([crc[0], crc[1], crc[2], crc[3]]));
            }
            (5 | 7 | 8, Form::Struct) => {
                let mut inner = Fields::default();
                while let Some((member, form)) = thrift.field(&mut inner)? {
                    match (field, member, form) {
                        (_, 1, Form::I32) => values = Some(thrift.count("values")?),
                        (5 | 7, 2, Form::I32) | (8, 4, Form::I32) => {
                            header.encoding = thrift.small()?
                        }
                        (5, 3, Form::I32) => header.definition_encoding = thrift.small()?,
                        (5, 4, Form::I32) => header.repetition_encoding = thrift.small()?,
                        (8, 2, Form::I32) => header.nulls = thrift.count("nulls")?,
                        (8, 3, Form::I32) => header.rows = thrift.count("rows")?,
                        (8, 5, Form::I32) => {
                            header.definition_bytes = thrift.count("bytes of levels")?
                        }
                        (8, 6, Form::I32) => {
                            header.repetition_bytes = thrift.count("bytes of levels")?
                        }
                        (8, 7, Form::True) => header.is_packed = true,
                        (8, 7, Form::False) => header.is_packed = false,
                        (_, _, other) => thrift.skip(other, 0)?,
                    }
                }
            }
            (_, other) => thrift.skip(other, 0)?,
        }
    }
    header.kind = kind.ok_or("the page header has no kind")?;
    header.packed = packed.ok_or("the page header has no packed size")?;
    header.unpacked = unpacked.ok_or("the page header has no unpacked size")?;
    header.values = match header.kind {
        PageKind::Index => 0,
        _ => values.ok_or("the page header has no number of values")?,
    };
    Ok((header, thrift.read))
}

/// Wire type of a field in the compact protocol of Thrift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    True,
    False,
    Byte,
    I16,
    I32,
    I64,
    Double,
    Binary,
    List,
    Map,
    Struct,
}

/// Number of the last field that was read from a structure. The file states the number of the next field relative to it.
#[derive(Default)]
struct Fields {
    last: i32,
    count: usize,
}

struct Thrift<'a, R> {
    from: &'a mut R,
    read: u64,
}

impl<R: BufRead> Thrift<'_, R> {
    /// Reads the number and wire type of the next field of a structure; `None` at its end.
    fn field(&mut self, fields: &mut Fields) -> Result<Option<(i32, Form)>, String> {
        let byte = self.byte()?;
        if byte == 0 {
            return Ok(None);
        }
        fields.count += 1;
        if fields.count > limits::NAMES {
            return Err("the page header has too many fields".to_owned());
        }
        let number = match byte >> 4 {
            0 => self.small()?,
            step => fields
                .last
                .checked_add(i32::from(step))
                .ok_or("a field number is too large")?,
        };
        fields.last = number;
        Ok(Some((number, Form::of(byte & 0x0f)?)))
    }

    fn skip(&mut self, form: Form, depth: usize) -> Result<(), String> {
        if depth > limits::DEPTH {
            return Err("the page header nests too deeply".to_owned());
        }
        match form {
            Form::True | Form::False => Ok(()),
            Form::Byte => self.pass(1),
            Form::I16 | Form::I32 | Form::I64 => self.varint().map(drop),
            Form::Double => self.pass(8),
            Form::Binary => {
                let length = self.varint()?;
                self.pass(length)
            }
            Form::List => {
                let byte = self.byte()?;
                let count = match byte >> 4 {
                    15 => self.varint()?,
                    count => u64::from(count),
                };
                self.skip_elements(Form::of(byte & 0x0f)?, count, depth)
            }
            Form::Map => match self.varint()? {
                0 => Ok(()),
                count => {
                    let kinds = self.byte()?;
                    let (key, value) = (Form::of(kinds >> 4)?, Form::of(kinds & 0x0f)?);
                    for _ in 0..count {
                        self.skip_elements(key, 1, depth)?;
                        self.skip_elements(value, 1, depth)?;
                    }
                    Ok(())
                }
            },
            Form::Struct => {
                let mut fields = Fields::default();
                while let Some((_, form)) = self.field(&mut fields)? {
                    self.skip(form, depth + 1)?;
                }
                Ok(())
            }
        }
    }

    /// Skips `count` elements of a list. Each takes at least one byte, even a truth value, so that a false count fails at the end of the file.
    fn skip_elements(&mut self, form: Form, count: u64, depth: usize) -> Result<(), String> {
        for _ in 0..count {
            match form {
                Form::True | Form::False => self.pass(1)?,
                other => self.skip(other, depth + 1)?,
            }
        }
        Ok(())
    }

    fn count(&mut self, of: &str) -> Result<u32, String> {
        let number = self.int()?;
        u32::try_from(number)
            .ok()
            .filter(|number| i32::try_from(*number).is_ok())
            .ok_or_else(|| format!("a page of {number} {of}"))
    }

    fn small(&mut self) -> Result<i32, String> {
        let number = self.int()?;
        i32::try_from(number)
            .map_err(|_| format!("a page header states {number}, expected a number of 32 bits"))
    }

    /// Reads a zigzag integer, which has its sign in the lowest bit.
    fn int(&mut self) -> Result<i64, String> {
        let bits = self.varint()?;
        Ok((bits >> 1).cast_signed() ^ -((bits & 1).cast_signed()))
    }

    fn varint(&mut self) -> Result<u64, String> {
        let mut number = 0_u64;
        for shift in (0..70).step_by(7) {
            let byte = self.byte()?;
            let bits = u64::from(byte & 0x7f);
            if shift == 63 && bits > 1 {
                break;
            }
            number |= bits << shift;
            if byte & 0x80 == 0 {
                return Ok(number);
            }
        }
        Err("a page header has a number of more than 64 bits".to_owned())
    }

    fn byte(&mut self) -> Result<u8, String> {
        let mut byte = [0];
        self.from
            .read_exact(&mut byte)
            .map_err(|_| "the header of a page is cut short".to_owned())?;
        self.read += 1;
        Ok(byte[0])
    }

    fn pass(&mut self, count: u64) -> Result<(), String> {
        let passed = std::io::copy(&mut self.from.by_ref().take(count), &mut std::io::sink())
            .map_err(|error| format!("the header of a page cannot be read: {error}"))?;
        self.read += passed;
        match passed == count {
            true => Ok(()),
            false => Err("the header of a page is cut short".to_owned()),
        }
    }
}

impl Form {
    fn of(code: u8) -> Result<Form, String> {
        Ok(match code {
            1 => Form::True,
            2 => Form::False,
            3 => Form::Byte,
            4 => Form::I16,
            5 => Form::I32,
            6 => Form::I64,
            7 => Form::Double,
            8 => Form::Binary,
            9 | 10 => Form::List,
            11 => Form::Map,
            12 => Form::Struct,
            other => {
                return Err(format!(
                    "a page header has a field of type {other}, expected 1 to 12"
                ));
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_read_with_its_length() {
        let mut bytes = vec![0x15, 0, 0x15, 20, 0x15, 18]; // kind 0, 10 bytes unpacked, 9 in the file
        bytes.extend_from_slice(&[0x15, 0x03]); // CRC -2
        bytes.extend_from_slice(&[0x1c, 0x15, 6, 0x15, 16, 0x15, 6, 0x15, 6]); // 3 values, encoding 8, levels 3 and 3
        bytes.extend_from_slice(&[0x1c, 0x18, 2, b'a', b'b', 0x11, 0]); // statistics: two bytes, a truth value
        bytes.extend_from_slice(&[0, 0, 99]);
        let (header, length) = read_header(&mut &bytes[..]).expect("a header");
        assert_eq!(length, bytes.len() as u64 - 1);
        assert_eq!(
            header,
            PageHeader {
                kind: PageKind::Data,
                packed: 9,
                unpacked: 10,
                crc: Some(u32::MAX - 1),
                values: 3,
                encoding: 8,
                definition_encoding: 3,
                repetition_encoding: 3,
                is_packed: true,
                ..PageHeader::default()
            }
        );
        for cut in 0..bytes.len() - 1 {
            let problem = read_header(&mut &bytes[..cut]).expect_err("cut");
            assert!(problem.contains("cut short"), "{problem}");
        }
    }

    #[test]
    fn no_header_makes_the_reader_loop_or_nest_without_end() {
        let deep = [&[0x9c_u8][..], &[0x1c; 200]].concat();
        assert!(read_header(&mut &deep[..]).is_err());
        let long = [
            0x19, 0xfc, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01,
        ];
        assert!(read_header(&mut &long[..]).is_err());
        let negative = [0x15, 0, 0x15, 1, 0];
        assert_eq!(
            read_header(&mut &negative[..]),
            Err("a page of -1 bytes unpacked".to_owned())
        );
    }
}
