//! Pictures of Foxglove in protobuf messages with published schemas: <https://docs.foxglove.dev/docs/sdk/schemas>.

use crate::bytes::Bytes;
use crate::cell::Cell;
use crate::ros::{self, Picture, RawPicture};

/// Description of a supported protobuf message.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct ProtobufMessage {
    name: &'static str,
    fields: &'static [Field],
}

/// Field of a protobuf message: its name, its number and its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Field {
    name: &'static str,
    number: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Time: a message with seconds in the first field and nanoseconds in the second.
    Time,
    Number,
    Text,
    Bytes,
}

/// Column of cells that are read from a field. `is_in_nanoseconds` is true for a time in nanoseconds instead of seconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    field: Field,
    is_in_nanoseconds: bool,
}

const fn field(name: &'static str, number: u32, kind: Kind) -> Field {
    Field { name, number, kind }
}

/// Supported protobuf messages.
static KNOWN: [ProtobufMessage; 2] = [
    ProtobufMessage {
        name: "foxglove.CompressedImage",
        fields: &[
            field("timestamp", 1, Kind::Time),
            field("frame_id", 4, Kind::Text),
            field("format", 3, Kind::Text),
            field("data", 2, Kind::Bytes),
        ],
    },
    ProtobufMessage {
        name: "foxglove.RawImage",
        fields: &[
            field("timestamp", 1, Kind::Time),
            field("frame_id", 7, Kind::Text),
            field("width", 2, Kind::Number),
            field("height", 3, Kind::Number),
            field("encoding", 4, Kind::Text),
            field("step", 5, Kind::Number),
            field("data", 6, Kind::Bytes),
        ],
    },
];

/// Supported message with the name `name`; `None` if it is not supported.
pub(crate) fn known(name: &str) -> Option<&'static ProtobufMessage> {
    KNOWN.iter().find(|message| message.name == name)
}

/// Names of the supported messages.
pub(crate) fn names() -> [&'static str; 2] {
    KNOWN.each_ref().map(|message| message.name)
}

impl ProtobufMessage {
    /// Names of the fields.
    pub(crate) fn names(&self) -> Vec<String> {
        let names = self.fields.iter();
        names.map(|field| field.name.to_owned()).collect()
    }

    /// Finds the columns `names`. The error is the first unknown name.
    pub(crate) fn fields<'n>(&self, names: &[&'n str]) -> Result<Vec<Column>, &'n str> {
        let column = |name: &&'n str| {
            let (base, is_in_nanoseconds) = match name.strip_suffix(".ns") {
                Some(base) => (base, true),
                None => (*name, false),
            };
            let mut fields = self.fields.iter();
            let found = fields.find(|field| {
                field.name == base && (!is_in_nanoseconds || field.kind == Kind::Time)
            });
            let field = *found.ok_or(*name)?;
            Ok(Column {
                field,
                is_in_nanoseconds,
            })
        };
        names.iter().map(column).collect()
    }

    /// Reads the cells of one message, one for each column. Fails with an error message.
    pub(crate) fn read(&self, columns: &[Column], message: &[u8]) -> Result<Vec<Cell>, String> {
        let values = self.values(message)?;
        let cell = |column: &Column| {
            let at = self.fields.iter().position(|field| *field == column.field);
            cell(column, &values[at.unwrap_or(0)])
        };
        columns.iter().map(cell).collect()
    }

    /// Checks that the field `name` contains pictures. The error names the field with the pictures.
    pub(crate) fn check_picture(&self, name: &str) -> Result<(), String> {
        match name {
            "data" => Ok(()),
            _ => Err(format!(
                "the pictures of {} are in its field `data`",
                self.name
            )),
        }
    }

    /// Reads the picture of a message. Fails with an error message.
    pub(crate) fn picture(&self, message: &[u8]) -> Result<Picture, String> {
        let values = self.values(message)?;
        let value = |name: &str| {
            let at = self.fields.iter().position(|field| field.name == name);
            at.map_or(Value::Absent, |at| values[at])
        };
        let bytes = value("data").bytes().to_vec();
        if self.fields.iter().all(|field| field.name != "step") {
            return match bytes.is_empty() {
                true => Err("the message has no bytes".to_owned()),
                false => Ok(Picture::Encoded(bytes)),
            };
        }
        let size = |name: &str| {
            let size = value(name).number();
            u32::try_from(size).map_err(|_| format!("a {name} of {size}"))
        };
        let raw = RawPicture {
            width: size("width")?,
            height: size("height")?,
            step: size("step")?,
            encoding: text(value("encoding").bytes())?,
            is_big_endian: false,
            data: bytes,
        };
        raw.samples().map(Picture::Samples)
    }

    /// Values of the fields in `message`. Of several values of one field, the last is used. Unknown fields are skipped.
    fn values<'m>(&self, message: &'m [u8]) -> Result<Vec<Value<'m>>, String> {
        let mut values = vec![Value::Absent; self.fields.len()];
        let mut bytes = Bytes::new(message);
        while !bytes.rest().is_empty() {
            let (number, value) = next(&mut bytes).ok_or("a protobuf field is cut short")?;
            let at = self
                .fields
                .iter()
                .position(|field| u64::from(field.number) == number);
            let Some(at) = at else { continue };
            let is_of_kind = match self.fields[at].kind {
                Kind::Number => matches!(value, Value::Number(_)),
                Kind::Time | Kind::Text | Kind::Bytes => matches!(value, Value::Bytes(_)),
            };
            if !is_of_kind {
                return Err(format!(
                    "`{}` of {} has another type",
                    self.fields[at].name, self.name
                ));
            }
            values[at] = value;
        }
        Ok(values)
    }
}

/// Value of a field; 0 or empty if the message omits it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Value<'m> {
    Absent,
    Number(u64),
    Bytes(&'m [u8]),
}

impl<'m> Value<'m> {
    fn number(self) -> u64 {
        match self {
            Value::Number(number) => number,
            _ => 0,
        }
    }

    fn bytes(self) -> &'m [u8] {
        match self {
            Value::Bytes(bytes) => bytes,
            _ => &[],
        }
    }
}

fn text(bytes: &[u8]) -> Result<String, String> {
    let text = std::str::from_utf8(bytes);
    text.map(str::to_owned)
        .map_err(|_| "a string is not UTF-8".to_owned())
}

fn cell(column: &Column, value: &Value<'_>) -> Result<Cell, String> {
    Ok(match column.field.kind {
        Kind::Number => Cell::Integer(value.number().into()),
        Kind::Text => Cell::Text(text(value.bytes())?),
        Kind::Bytes => Cell::Bytes(value.bytes().to_vec()),
        Kind::Time => {
            let (mut seconds, mut nanoseconds) = (0_u64, 0_u64);
            let mut bytes = Bytes::new(value.bytes());
            while !bytes.rest().is_empty() {
                match next(&mut bytes).ok_or("a protobuf time is cut short")? {
                    (1, Value::Number(number)) => seconds = number,
                    (2, Value::Number(number)) => nanoseconds = number,
                    _ => {}
                }
            }
            // A negative number is stored as the bits of an unsigned one.
            let seconds = i128::from(i64::from_ne_bytes(seconds.to_ne_bytes()));
            let nanoseconds = i128::from(i64::from_ne_bytes(nanoseconds.to_ne_bytes()));
            match column.is_in_nanoseconds {
                true => Cell::Integer(seconds * 1_000_000_000 + nanoseconds),
                false => Cell::Number(ros::seconds(seconds, nanoseconds)),
            }
        }
    })
}

/// Takes the number and the value of the next field from `bytes`.
fn next<'m>(bytes: &mut Bytes<'m>) -> Option<(u64, Value<'m>)> {
    let tag = varint(bytes)?;
    let value = match tag & 7 {
        0 => Value::Number(varint(bytes)?),
        1 => Value::Number(bytes.u64()?),
        2 => {
            let length = usize::try_from(varint(bytes)?).ok()?;
            Value::Bytes(bytes.take(length)?)
        }
        5 => Value::Number(u64::from(bytes.u32()?)),
        _ => return None,
    };
    Some((tag >> 3, value))
}

/// Varint of one to ten bytes, the lowest seven bits first.
fn varint(bytes: &mut Bytes<'_>) -> Option<u64> {
    let mut number = 0_u64;
    for shift in (0..70).step_by(7) {
        let byte = bytes.u8()?;
        let bits = u64::from(byte & 0x7f);
        number |= bits.checked_shl(shift).unwrap_or(0);
        if byte & 0x80 == 0 {
            return Some(number);
        }
    }
    None
}
