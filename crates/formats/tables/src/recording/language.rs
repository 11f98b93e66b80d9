//! Encodings of the messages of a recording, and readers for them.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use super::Topic;
use super::json;
use crate::cell::Cell;
use crate::codec;
use crate::error::shown;
use crate::limits;
use crate::message::MessageStore;
use crate::protobuf::{self, ProtobufMessage};
use crate::ros::{self, Dialect, Fields, Picture, PictureField, RosSchema};

/// First bytes of rosbag2 messages that are compressed one by one. A CDR message never begins with these bytes.
const ZSTANDARD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

/// Encoding of messages.
#[derive(Clone, Debug)]
pub(super) enum Language {
    Ros(Arc<RosSchema>),
    Json,
    Protobuf(&'static ProtobufMessage),
}

/// Function that reads the requested fields of a message.
pub(super) type Reader<'a> = Box<dyn Fn(&[u8]) -> Result<Vec<Cell>, String> + 'a>;

/// Function that reads the picture in a message.
pub(super) type PictureReader<'a> = Box<dyn Fn(&[u8]) -> Result<Picture, String> + 'a>;

impl Language {
    /// Reader of the fields `names` of a message. The error is the first unknown name.
    pub(super) fn reader<'a>(&'a self, names: &[&'a str]) -> Result<Reader<'a>, &'a str> {
        match self {
            Language::Ros(schema) => {
                let fields = Fields::new(schema, names)?;
                Ok(Box::new(move |message| {
                    fields.read(schema, &unpacked(message)?)
                }))
            }
            Language::Protobuf(schema) => {
                let fields = schema.fields(names)?;
                Ok(Box::new(move |message| schema.read(&fields, message)))
            }
            Language::Json => {
                let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
                Ok(Box::new(move |message| {
                    let cell = json::cell(message)?;
                    let found = |name: &String| cell.at(name).cloned().unwrap_or(Cell::Null);
                    Ok(names.iter().map(found).collect())
                }))
            }
        }
    }

    /// Reader of the pictures in the field `name`. Returns an error message if the field contains no pictures.
    pub(super) fn pictures<'a>(&'a self, name: &str) -> Result<PictureReader<'a>, String> {
        match self {
            Language::Json => Err("pictures in JSON messages are not supported".to_owned()),
            Language::Protobuf(schema) => {
                schema.check_picture(name)?;
                Ok(Box::new(|message| schema.picture(message)))
            }
            Language::Ros(schema) => {
                let field = PictureField::new(schema, name)?;
                Ok(Box::new(move |message| {
                    field.read(schema, &unpacked(message)?)
                }))
            }
        }
    }
}

/// Content of a ROS message. A message that the recorder compressed with Zstandard is unpacked.
fn unpacked(message: &[u8]) -> Result<Cow<'_, [u8]>, String> {
    match message.starts_with(&ZSTANDARD) {
        false => Ok(Cow::Borrowed(message)),
        true => codec::zstandard_message(message, limits::PAGE_BYTES).map(Cow::Owned),
    }
}

/// Encoding of the messages of `topic`. Fails if the messages have several encodings or schemas.
pub(super) fn of_topic(store: &dyn MessageStore, topic: &Topic) -> Result<Language, String> {
    let channels = store.channels().values();
    let channels = channels.filter(|channel| channel.topic == topic.name);
    let mut schemas = channels.map(|channel| (&channel.encoding, &channel.schema));
    let Some((encoding, schema)) = schemas.next() else {
        return Err("no channel has this topic".to_owned());
    };
    if schemas.any(|other| other != (encoding, schema)) {
        return Err("its channels have different schemas".to_owned());
    }
    let schema = schema.as_deref();
    let written = schema.map_or("none", |schema| schema.encoding.as_str());
    let dialect = match (encoding.as_str(), written) {
        ("json", _) => return Ok(Language::Json),
        ("cdr", "ros2msg") => Dialect::Ros2,
        ("ros1", "ros1msg") => Dialect::Ros1,
        ("protobuf", _) => {
            return match protobuf::known(&topic.schema) {
                Some(known) => Ok(Language::Protobuf(known)),
                None => Err(format!(
                    "protobuf messages by `{}`, of which only {} are read: write them as JSON or as ROS 2 messages",
                    shown(&topic.schema),
                    protobuf::names().join(" and ")
                )),
            };
        }
        ("cdr", "") => {
            return Err(format!(
                "the file has no definition of `{}`, because rosbag2 wrote none before ROS 2 Iron: convert it to `storage_id: mcap` with \
                 `ros2 bag convert`, where the package of the type is installed",
                shown(&topic.schema)
            ));
        }
        (encoding, written) => {
            return Err(format!(
                "messages in `{}` by a schema in `{}`, expected `cdr` by `ros2msg`, `ros1` by `ros1msg`, `protobuf` or `json`",
                shown(encoding),
                shown(written)
            ));
        }
    };
    let text = schema.map(|schema| std::str::from_utf8(&schema.text));
    let Some(Ok(text)) = text else {
        return Err("its schema is not text".to_owned());
    };
    let parsed = RosSchema::parse(&topic.schema, text, dialect);
    let parsed = parsed.map_err(|problem| format!("the schema of {}: {problem}", topic.schema))?;
    Ok(Language::Ros(Arc::new(parsed)))
}

/// Names of the fields of ROS and protobuf messages.
pub(super) fn names(language: &Language) -> Result<Vec<String>, String> {
    match language {
        Language::Ros(schema) => ros::names(schema),
        Language::Protobuf(schema) => Ok(schema.names()),
        Language::Json => Ok(Vec::new()),
    }
}

/// Numbers of the channels of `topic`.
pub(super) fn channels(store: &dyn MessageStore, topic: &Topic) -> BTreeSet<u32> {
    let channels = store.channels().iter();
    let channels = channels.filter(|(_, channel)| channel.topic == topic.name);
    channels.map(|(id, _)| *id).collect()
}
