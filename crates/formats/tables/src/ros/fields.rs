//! Fields of ROS messages by dotted name, and the columns that are read from them.

use super::cdr::{Cdr, Want};
use super::schema::{Count, Field, Kind, Message, RosSchema};
use crate::cell::Cell;
use crate::limits;
use crate::path::longest;

/// Fields of a message that the requested columns need.
#[derive(Debug)]
pub(crate) struct Fields {
    want: Want,
    slots: usize,
    picks: Vec<Pick>,
}

/// Column: the slot with its field, the path within the field, and whether a time is in seconds or nanoseconds.
#[derive(Clone, Debug)]
struct Pick {
    slot: usize,
    rest: String,
    form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Plain,
    Seconds,
    Nanoseconds,
}

impl Fields {
    /// Finds the fields of the columns `names`. The error is the first name that the schema lacks.
    pub(crate) fn new<'n>(schema: &RosSchema, names: &[&'n str]) -> Result<Fields, &'n str> {
        let mut fields = Fields {
            want: Want::Nothing,
            slots: 0,
            picks: Vec::new(),
        };
        // Containers come first, so that their members find them.
        let mut order: Vec<usize> = (0..names.len()).collect();
        order.sort_by_key(|at| names[*at].len());
        let mut picks = vec![None; names.len()];
        for at in order {
            picks[at] = Some(fields.pick(schema, names[at]).ok_or(names[at])?);
        }
        fields.picks = picks.into_iter().flatten().collect();
        Ok(fields)
    }

    /// Reads the cells of one message, one for each column. Fails with an error message.
    pub(crate) fn read(&self, schema: &RosSchema, message: &[u8]) -> Result<Vec<Cell>, String> {
        let mut slots = vec![Cell::Null; self.slots];
        Cdr::new(message, schema.dialect())?.read(schema, &self.want, &mut slots)?;
        self.picks
            .iter()
            .map(|pick| {
                let cell = slots.get(pick.slot).and_then(|cell| cell.at(&pick.rest));
                let cell = cell.ok_or_else(|| format!("no element `{}`", pick.rest))?;
                Ok(pick.form.apply(cell))
            })
            .collect()
    }

    fn pick(&mut self, schema: &RosSchema, name: &str) -> Option<Pick> {
        let way = Way::to(schema, name)?;
        let mut want = &mut self.want;
        let mut message = schema.root();
        for (place, rest) in &way.steps {
            if *want == Want::Nothing {
                *want = Want::Fields(vec![Want::Nothing; message.fields.len()]);
            }
            let Want::Fields(wants) = want else {
                return None;
            };
            want = wants.get_mut(*place)?;
            if let Want::Whole(slot) = want {
                return Some(Pick {
                    slot: *slot,
                    rest: (*rest).to_owned(),
                    form: way.form,
                });
            }
            if let Some(inner) = inner(schema, &message.fields[*place]) {
                message = inner;
            }
        }
        let slot = self.slots;
        self.slots += 1;
        *want = Want::Whole(slot);
        let rest = way.steps.last()?.1.to_owned();
        Some(Pick {
            slot,
            rest,
            form: way.form,
        })
    }
}

/// Path to a field: for each nested message, the index of the next field, and the part of the name after it.
type Steps<'n> = Vec<(usize, &'n str)>;

/// Path to a field, and whether its cell is a time in seconds, a time in nanoseconds, or neither.
struct Way<'n> {
    steps: Steps<'n>,
    form: Form,
}

impl<'n> Way<'n> {
    /// Path to the field `name`; `None` if it does not exist. A time is one number in seconds, and its member `ns` is one in nanoseconds.
    fn to(schema: &RosSchema, name: &'n str) -> Option<Way<'n>> {
        if let Some((steps, end)) = steps(schema, name) {
            let form = match end.is_some_and(is_time) {
                true => Form::Seconds,
                false => Form::Plain,
            };
            return Some(Way { steps, form });
        }
        let (steps, end) = steps(schema, name.strip_suffix(".ns")?)?;
        end.is_some_and(is_time).then_some(Way {
            steps,
            form: Form::Nanoseconds,
        })
    }
}

/// Path to the field `name`, and the message type of the field if it is a single message.
fn steps<'s, 'n>(schema: &'s RosSchema, name: &'n str) -> Option<(Steps<'n>, Option<&'s Message>)> {
    let mut message = schema.root();
    let mut steps = Vec::new();
    let mut rest = name;
    loop {
        let names = message.fields.iter().map(|field| field.name.as_str());
        let (place, after) = longest(rest, names)?;
        rest = after;
        steps.push((place, rest));
        let field = &message.fields[place];
        match inner(schema, field) {
            Some(inner) if rest.is_empty() => return Some((steps, Some(inner))),
            Some(inner) => message = inner,
            None if rest.is_empty() => return Some((steps, None)),
            None if rest.starts_with('[') && field.count != Count::One => {
                return Some((steps, None));
            }
            None => return None,
        }
    }
}

/// Message type of a field that contains one message.
fn inner<'s>(schema: &'s RosSchema, field: &Field) -> Option<&'s Message> {
    match (field.kind, field.count) {
        (Kind::Message(place), Count::One) => Some(schema.message(place)),
        _ => None,
    }
}

/// True if a message is a time or a duration, with seconds and nanoseconds.
fn is_time(message: &Message) -> bool {
    let is_named = matches!(
        message.name.as_str(),
        "builtin_interfaces/Time" | "builtin_interfaces/Duration"
    );
    is_named
        && matches!(message.fields.as_slice(), [sec, nanosec] if sec.name == "sec" && nanosec.name == "nanosec")
}

/// Names of all fields. Members of messages have dotted names. A list has one name, and a time has one name.
pub(crate) fn names(schema: &RosSchema) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    add_names(schema, schema.root(), "", &mut names)?;
    Ok(names)
}

fn add_names(
    schema: &RosSchema,
    message: &Message,
    above: &str,
    into: &mut Vec<String>,
) -> Result<(), String> {
    for field in &message.fields {
        let name = format!("{above}{}", field.name);
        match inner(schema, field) {
            Some(inner) if !is_time(inner) => add_names(schema, inner, &format!("{name}."), into)?,
            _ => into.push(name),
        }
        if into.len() > limits::NAMES {
            return Err(format!("a message of more than {} fields", limits::NAMES));
        }
    }
    Ok(())
}

impl Form {
    fn apply(self, cell: &Cell) -> Cell {
        let member = |name: &str| match cell.at(name) {
            Some(Cell::Integer(value)) => *value,
            _ => 0,
        };
        match self {
            Form::Plain => cell.clone(),
            Form::Seconds => Cell::Number(seconds(member("sec"), member("nanosec"))),
            Form::Nanoseconds => Cell::Integer(member("sec") * NANO + member("nanosec")),
        }
    }
}

const NANO: i128 = 1_000_000_000;

/// Converts seconds and nanoseconds to one number, as the ROS libraries do.
pub(crate) fn seconds(seconds: i128, nanoseconds: i128) -> f64 {
    seconds as f64 + nanoseconds as f64 / 1e9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ros::Dialect;

    const JOINTS: &str = "std_msgs/Header header\nstring[] name\nfloat64[] position\nPair[2] pairs\n\
        ===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n===\nMSG: a/Pair\nuint8 low\nint16 high";

    /// Test message with numbers in the requested byte order.
    fn message(is_big_endian: bool) -> Vec<u8> {
        let mut bytes = vec![0, u8::from(!is_big_endian), 0, 0];
        let mut put = |number: &[u8]| {
            while (bytes.len() - 4) % number.len() != 0 {
                bytes.push(0xaa);
            }
            let mut number = number.to_vec();
            if is_big_endian {
                number.reverse();
            }
            bytes.extend_from_slice(&number);
        };
        put(&1_700_000_000_i32.to_le_bytes());
        put(&250_000_000_u32.to_le_bytes());
        put(&4_u32.to_le_bytes());
        for letter in *b"gel\0" {
            put(&[letter]);
        }
        put(&1_u32.to_le_bytes());
        put(&3_u32.to_le_bytes());
        for letter in *b"j1\0" {
            put(&[letter]);
        }
        put(&2_u32.to_le_bytes());
        put(&1.5_f64.to_le_bytes());
        put(&(-2.5_f64).to_le_bytes());
        for (low, high) in [(7_u8, -300_i16), (255, 2)] {
            put(&[low]);
            put(&high.to_le_bytes());
        }
        bytes
    }

    #[test]
    fn fields_are_found_in_messages_of_both_orders_of_bytes() {
        let schema = RosSchema::parse("a/msg/Joints", JOINTS, Dialect::Ros2).expect("parses");
        let columns = [
            ("header.stamp.ns", "1700000000250000000"),
            ("header.stamp", "1700000000.25"),
            ("header.stamp.nanosec", "250000000"),
            ("header.frame_id", "gel"),
            ("name[0]", "j1"),
            ("position[1]", "-2.5"),
            ("position", "[1.5, -2.5]"),
            ("pairs[0].high", "-300"),
            ("pairs[1]", r#"{"low": 255, "high": 2}"#),
            (
                "header",
                r#"{"stamp": {"sec": 1700000000, "nanosec": 250000000}, "frame_id": "gel"}"#,
            ),
        ];
        let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
        for is_big_endian in [false, true] {
            let bytes = message(is_big_endian);
            for asked in [&names[..], &names[..1], &names[4..9]] {
                let fields = Fields::new(&schema, asked).expect("known");
                let cells = fields.read(&schema, &bytes).expect("reads");
                for (name, cell) in asked.iter().zip(cells) {
                    let text = columns
                        .iter()
                        .find(|(known, _)| known == name)
                        .expect("known")
                        .1;
                    assert_eq!(cell.text(), text, "{name}");
                }
            }
            let fields = Fields::new(&schema, &["pairs"]).expect("known");
            for cut in 0..bytes.len() {
                assert!(fields.read(&schema, &bytes[..cut]).is_err(), "{cut}");
            }
            let fields = Fields::new(&schema, &["position[2]"]).expect("known");
            assert_eq!(
                fields.read(&schema, &bytes),
                Err("no element `[2]`".to_owned())
            );
        }
    }

    #[test]
    fn a_name_that_is_no_field_is_given_back() {
        let schema = RosSchema::parse("a/msg/Joints", JOINTS, Dialect::Ros2).expect("parses");
        for name in [
            "stamp",
            "header.stamp.seconds",
            "header.ns",
            "position.x",
            "header[0]",
            "name.ns",
            "",
        ] {
            assert_eq!(Fields::new(&schema, &["name", name]).err(), Some(name));
        }
        assert_eq!(
            names(&schema).expect("few"),
            [
                "header.stamp",
                "header.frame_id",
                "name",
                "position",
                "pairs"
            ]
        );
    }

    #[test]
    fn lists_longer_than_their_message_are_refused_before_anything_is_allocated() {
        let schema = RosSchema::parse("a/msg/Long", "float64[] a\nstring[] b", Dialect::Ros2)
            .expect("parses");
        let fields = Fields::new(&schema, &["a", "b"]).expect("known");
        let bytes = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0];
        let problem = fields.read(&schema, &bytes).expect_err("too long");
        assert!(
            problem.contains("4294967295 elements are announced, but only 4 bytes follow"),
            "{problem}"
        );
    }
}
