//! Message definitions in the language of `.msg` files, as ROS 2 writes them into recordings. The definition of the message comes first. Each message
//! that it uses follows after a line of `=` and a line `MSG: package/Name`.

use std::collections::BTreeMap;

use super::definitions::KNOWN;
use crate::error::shown;
use crate::limits;

/// ROS 1 or ROS 2. The schemas are alike; the encoding of numbers and some types differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// ROS 1: little-endian numbers without alignment.
    Ros1,
    /// ROS 2: numbers in CDR, which are aligned.
    Ros2,
}

/// Message definitions of a schema. The first is that of the recorded messages.
#[derive(Clone, Debug)]
pub(crate) struct RosSchema {
    messages: Vec<Message>,
    dialect: Dialect,
}

#[derive(Clone, Debug)]
pub(crate) struct Message {
    /// Name in the form `package/Name`.
    pub(crate) name: String,
    pub(crate) fields: Vec<Field>,
}

#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) count: Count,
}

/// Number of elements of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Count {
    One,
    Fixed(usize),
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Bool,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
    Text,
    /// Another message, by its index in the schema.
    Message(usize),
}

impl Kind {
    /// Size of a number, bytes; `None` for a text or a message.
    pub(crate) fn size(self) -> Option<usize> {
        match self {
            Kind::Bool | Kind::I8 | Kind::U8 => Some(1),
            Kind::I16 | Kind::U16 => Some(2),
            Kind::I32 | Kind::U32 | Kind::F32 => Some(4),
            Kind::I64 | Kind::U64 | Kind::F64 => Some(8),
            Kind::Text | Kind::Message(_) => None,
        }
    }
}

/// Unresolved field, with the name of its type.
struct Written {
    name: String,
    kind: String,
    count: Count,
}

/// Time types that are built into ROS 1, with the names of the equal messages in ROS 2.
const OF_ROS_1: [(&str, &str); 2] = [
    ("builtin_interfaces/Time", "uint32 sec\nuint32 nanosec"),
    ("builtin_interfaces/Duration", "int32 sec\nint32 nanosec"),
];

impl RosSchema {
    /// Parses the schema of the message `name`, such as `sensor_msgs/msg/Image`. The error names the invalid part of `text`.
    pub(crate) fn parse(name: &str, text: &str, dialect: Dialect) -> Result<RosSchema, String> {
        let mut parts = vec![(short(name), fields_of("")?)];
        let mut body = String::new();
        let mut is_head_next = false;
        let close = |parts: &mut Vec<(String, Vec<Written>)>, body: &mut String| {
            let fields = fields_of(body)?;
            body.clear();
            if let Some(last) = parts.last_mut() {
                last.1 = fields;
            }
            Ok::<(), String>(())
        };
        for line in text.lines() {
            let is_rule = line.len() > 2 && line.trim_end().bytes().all(|letter| letter == b'=');
            if is_rule {
                close(&mut parts, &mut body)?;
                is_head_next = true;
            } else if is_head_next && !line.trim().is_empty() {
                let name = line
                    .trim()
                    .strip_prefix("MSG:")
                    .ok_or_else(|| format!("`{}`, expected `MSG:` and a name", shown(line)))?;
                parts.push((short(name.trim()), Vec::new()));
                is_head_next = false;
            } else {
                body.push_str(line);
                body.push('\n');
            }
        }
        close(&mut parts, &mut body)?;
        // Some recorders omit these messages from schemas, because every installation has them.
        let known: &[(&str, &str)] = match dialect {
            Dialect::Ros1 => &OF_ROS_1,
            Dialect::Ros2 => &KNOWN,
        };
        for (name, fields) in known {
            parts.push(((*name).to_owned(), fields_of(fields)?));
        }
        if parts.len() > limits::NAMES {
            return Err(format!("a schema of {} messages", parts.len()));
        }
        RosSchema::resolve(parts, dialect)
    }

    /// Replaces names of types by indices. Of two messages with the same name, the first is used.
    fn resolve(parts: Vec<(String, Vec<Written>)>, dialect: Dialect) -> Result<RosSchema, String> {
        let mut places = BTreeMap::new();
        for (at, (name, _)) in parts.iter().enumerate() {
            places.entry(name.clone()).or_insert(at);
        }
        let mut messages = Vec::with_capacity(parts.len());
        for (name, written) in parts {
            let mut fields = Vec::with_capacity(written.len());
            for field in written {
                fields.push(Field {
                    kind: kind(&field.kind, &name, &places, dialect).map_err(|problem| {
                        format!("`{}` of {name}: {problem}", shown(&field.name))
                    })?,
                    name: field.name,
                    count: field.count,
                });
            }
            messages.push(Message { name, fields });
        }
        let schema = RosSchema { messages, dialect };
        let mut depths = vec![None; schema.messages.len()];
        schema.check_depth(0, &mut depths, 0)?;
        Ok(schema)
    }

    /// Dialect of the messages: ROS 1 or ROS 2.
    pub(crate) fn dialect(&self) -> Dialect {
        self.dialect
    }

    pub(crate) fn root(&self) -> &Message {
        &self.messages[0]
    }

    pub(crate) fn message(&self, place: usize) -> &Message {
        &self.messages[place]
    }

    /// Checks the nesting depth of messages inside the message `place` against the limit. A message that contains itself would nest without end.
    fn check_depth(
        &self,
        place: usize,
        depths: &mut [Option<usize>],
        above: usize,
    ) -> Result<usize, String> {
        if let Some(depth) = depths[place] {
            return Ok(depth);
        }
        let message = &self.messages[place];
        if above > limits::DEPTH {
            return Err(format!(
                "{} nests deeper than {} messages",
                message.name,
                limits::DEPTH
            ));
        }
        let mut depth = 0;
        for field in &message.fields {
            if let Kind::Message(inner) = field.kind {
                depth = depth.max(1 + self.check_depth(inner, depths, above + 1)?);
            }
        }
        if depth > limits::DEPTH {
            return Err(format!(
                "{} nests deeper than {} messages",
                message.name,
                limits::DEPTH
            ));
        }
        depths[place] = Some(depth);
        Ok(depth)
    }
}

/// Fields in the lines of a message, without its constants.
fn fields_of(body: &str) -> Result<Vec<Written>, String> {
    let mut fields = Vec::new();
    for line in body.lines() {
        let code = line.split('#').next().unwrap_or("").trim();
        let Some((kind, rest)) = code.split_once(char::is_whitespace) else {
            match code.is_empty() {
                true => continue,
                false => return Err(format!("`{}`, expected a type and a name", shown(code))),
            }
        };
        let rest = rest.trim_start();
        let end = rest.find(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
        let (name, after) = rest.split_at(end.unwrap_or(rest.len()));
        // A constant has a value after `=`. A value without `=` is a default.
        if after.trim_start().starts_with('=') {
            continue;
        }
        if name.is_empty() {
            return Err(format!("`{}`, expected a type and a name", shown(code)));
        }
        let (kind, count) = counted(kind)?;
        fields.push(Written {
            name: name.to_owned(),
            kind: kind.to_owned(),
            count,
        });
        if fields.len() > limits::NAMES {
            return Err(format!("a message of more than {} fields", limits::NAMES));
        }
    }
    Ok(fields)
}

/// Splits a type into its name and the number of elements in brackets: `float64[6]`, `float64[]`, `float64[<=6]`.
fn counted(written: &str) -> Result<(&str, Count), String> {
    let Some((kind, rest)) = written.split_once('[') else {
        return Ok((written, Count::One));
    };
    let wrong = || format!("`{}` is not a type", shown(written));
    let inside = rest.strip_suffix(']').ok_or_else(wrong)?;
    if inside.is_empty() || inside.starts_with("<=") {
        return Ok((kind, Count::Any));
    }
    match inside.parse() {
        Ok(count) if count > 0 => Ok((kind, Count::Fixed(count))),
        _ => Err(wrong()),
    }
}

fn kind(
    written: &str,
    within: &str,
    places: &BTreeMap<String, usize>,
    dialect: Dialect,
) -> Result<Kind, String> {
    let plain = written.split("<=").next().unwrap_or(written);
    let plain = match (dialect, plain) {
        (Dialect::Ros1, "time") => "builtin_interfaces/Time",
        (Dialect::Ros1, "duration") => "builtin_interfaces/Duration",
        (Dialect::Ros1, "byte") => "int8",
        (_, plain) => plain,
    };
    Ok(match plain {
        "bool" => Kind::Bool,
        "int8" => Kind::I8,
        "uint8" | "byte" | "char" => Kind::U8,
        "int16" => Kind::I16,
        "uint16" => Kind::U16,
        "int32" => Kind::I32,
        "uint32" => Kind::U32,
        "int64" => Kind::I64,
        "uint64" => Kind::U64,
        "float32" => Kind::F32,
        "float64" => Kind::F64,
        "string" => Kind::Text,
        "wstring" => return Err("strings of wide characters are not supported".to_owned()),
        name => {
            let package = within.split('/').next().unwrap_or("");
            let full = match name.contains('/') {
                true => short(name),
                false if name == "Header" => "std_msgs/Header".to_owned(),
                false => format!("{package}/{name}"),
            };
            let place = places.get(&full);
            Kind::Message(
                *place.ok_or_else(|| format!("the schema does not define `{}`", shown(name)))?,
            )
        }
    })
}

/// Shortens `package/msg/Name` to `package/Name`.
pub(super) fn short(name: &str) -> String {
    let mut parts = name.split('/');
    match (parts.next(), parts.next_back()) {
        (Some(package), Some(name)) => format!("{package}/{name}"),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WRENCH: &str = "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n\
        ================================================================================\nMSG: geometry_msgs/Wrench\n\
        # Force and torque.\nVector3 force # N\nVector3  torque\n\
        ===\nMSG: geometry_msgs/Vector3\nfloat64 x 0.5\nfloat64 y\nfloat64 z\nint32 AXES=3\nstring NAME = \"a # b\"\n\
        ===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring<=64 frame_id\n";

    #[test]
    fn names_are_found_in_their_package_and_known_messages_without_being_there() {
        let schema = RosSchema::parse("geometry_msgs/msg/WrenchStamped", WRENCH, Dialect::Ros2)
            .expect("parses");
        let names = |message: &Message| {
            message
                .fields
                .iter()
                .map(|field| field.name.clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(names(schema.root()), ["header", "wrench"]);
        let Kind::Message(wrench) = schema.root().fields[1].kind else {
            panic!()
        };
        let Kind::Message(torque) = schema.message(wrench).fields[1].kind else {
            panic!()
        };
        assert_eq!(schema.message(torque).name, "geometry_msgs/Vector3");
        assert_eq!(names(schema.message(torque)), ["x", "y", "z"]);
        let Kind::Message(header) = schema.root().fields[0].kind else {
            panic!()
        };
        let Kind::Message(stamp) = schema.message(header).fields[0].kind else {
            panic!()
        };
        assert_eq!(schema.message(stamp).name, "builtin_interfaces/Time");
        assert_eq!(schema.message(header).fields[1].kind, Kind::Text);
    }

    #[test]
    fn counts_stand_in_brackets() {
        let schema = RosSchema::parse(
            "a/msg/B",
            "float64[6] wrench\nuint8[] data\nint16[<=4] some\nstring<=3[2] names",
            Dialect::Ros2,
        )
        .expect("parses");
        let counts: Vec<Count> = schema
            .root()
            .fields
            .iter()
            .map(|field| field.count)
            .collect();
        assert_eq!(
            counts,
            [Count::Fixed(6), Count::Any, Count::Any, Count::Fixed(2)]
        );
    }

    #[test]
    fn what_a_schema_does_not_explain_is_refused_by_name() {
        for (text, expected) in [
            ("Pose pose", "the schema does not define `Pose`"),
            ("float64", "expected a type and a name"),
            ("float64 =3", ""),
            ("float64[0] none", "is not a type"),
            ("float64[-1] none", "is not a type"),
            ("float64[6 none", "is not a type"),
            ("wstring name", "wide characters"),
            ("B inner", "nests deeper than 32"),
            ("int8 a\n===\nint8 b", "expected `MSG:`"),
            (
                "C c\n===\nMSG: a/C\nD d\n===\nMSG: a/D\nC c",
                "nests deeper",
            ),
        ] {
            match RosSchema::parse("a/msg/B", text, Dialect::Ros2) {
                Err(problem) => assert!(
                    problem.contains(expected) && !expected.is_empty(),
                    "{problem}"
                ),
                Ok(_) => assert!(expected.is_empty(), "{text}"),
            }
        }
    }
}
