//! ROS 2 recordings in SQLite databases (`.db3`): a table of topics and a table of messages.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::error::{Place, TableError};
use crate::limits;
use crate::message::{Channel, Entry, Message, MessageReader, MessageStore, Schema};
use crate::ros;
use crate::source::Source;
use crate::sqlite::{Database, Pages, Record, RowPlace, SqliteTable, Value};

/// Newest supported version of the database schema of rosbag2.
const VERSION: i64 = 4;
/// Names of the tables that schema versions up to [`VERSION`] have.
const TABLES: [&str; 5] = [
    "schema",
    "metadata",
    "topics",
    "messages",
    "message_definitions",
];
const OF_TOPICS: [&str; 6] = [
    "id",
    "name",
    "type",
    "serialization_format",
    "offered_qos_profiles",
    "type_description_hash",
];
const OF_MESSAGES: [&str; 4] = ["id", "topic_id", "timestamp", "data"];

/// Recording of ROS 2 in an SQLite database.
#[derive(Debug)]
pub(crate) struct Rosbag2 {
    database: Database,
    messages: SqliteTable,
    channels: BTreeMap<u32, Channel>,
}

/// Positions of three columns in the table `messages`.
#[derive(Clone, Copy, Debug)]
struct Columns {
    topic: usize,
    timestamp: usize,
    data: usize,
}

impl Rosbag2 {
    /// Opens the recording in `source`.
    ///
    /// # Errors
    /// [`TableError::Unsupported`] for a later schema, or if the database is not a recording; [`TableError::Damaged`] for an invalid page or row;
    /// [`TableError::Cut`] if pages are missing at the end.
    pub(crate) fn open(source: Source) -> Result<Rosbag2, TableError> {
        let database = Database::open(source)?;
        if database.cut_at().is_none() {
            return Rosbag2::of(database);
        }
        let (path, problem) = (
            database.source().path().to_owned(),
            database.missing_pages(),
        );
        // If a description is after the cut, no message can be read.
        let counts = Rosbag2::of(database).map(|bag| bag.channels.into_values());
        Err(TableError::Cut {
            path,
            place: Place::byte(0).in_name("header"),
            problem,
            messages: counts.map_or(0, |channels| channels.map(|channel| channel.count).sum()),
            remedy: "recover them with `sqlite3 FILE .recover | sqlite3 OUT.db3`",
        })
    }

    /// Opens the truncated database in `source`. Its messages are those that lie completely in the existing pages.
    ///
    /// # Errors
    /// Errors of [`open`](Self::open).
    pub(crate) fn open_to_cut(source: Source) -> Result<Rosbag2, TableError> {
        Rosbag2::of(Database::open(source)?)
    }

    fn of(database: Database) -> Result<Rosbag2, TableError> {
        check_schema(&database)?;
        let messages = table(&database, "messages", &OF_MESSAGES, 4)?.clone();
        let mut bag = Rosbag2 {
            channels: channels(&database)?,
            messages,
            database,
        };
        let mut counts: BTreeMap<u32, u64> = BTreeMap::new();
        bag.each_message(&mut |channel, _| {
            *counts.entry(channel).or_default() += 1;
            Ok(())
        })?;
        for (channel, count) in counts {
            match bag.channels.get_mut(&channel) {
                Some(channel) => channel.count = count,
                None => {
                    let problem = format!(
                        "{count} messages of topic {channel}, which its table of topics lacks"
                    );
                    return Err(bag.source().damaged(Place::of("messages"), problem));
                }
            }
        }
        Ok(bag)
    }

    fn columns(&self) -> Columns {
        let position = |name: &str| self.messages.position(name).unwrap_or(usize::MAX);
        Columns {
            topic: position("topic_id"),
            timestamp: position("timestamp"),
            data: position("data"),
        }
    }

    /// Calls `each` with the topic and the location of every message, in the order of row numbers.
    fn each_message(
        &self,
        each: &mut dyn FnMut(u32, Entry) -> Result<(), TableError>,
    ) -> Result<(), TableError> {
        let columns = self.columns();
        let is_cut = self.cut_at().is_some();
        self.database
            .each_row(&self.messages, &mut |place, record| {
                if is_cut && !record.is_before_cut()? {
                    return Ok(());
                }
                let (channel, log_time) = self.head(record, columns)?;
                let entry = Entry {
                    log_time,
                    chunk: Some(u64::from(place.page)),
                    at: u64::from(place.cell),
                };
                each(channel, entry)
            })
    }

    /// Number of the topic of a message, and the time of the message in ns.
    fn head(
        &self,
        record: &mut Record<'_, '_>,
        columns: Columns,
    ) -> Result<(u32, u64), TableError> {
        let (topic, time) = (
            record.value(columns.topic)?,
            record.value(columns.timestamp)?,
        );
        let (Value::Integer(topic), Value::Integer(time)) = (&topic, &time) else {
            let problem =
                format!("a message of topic {topic:?} at {time:?}, expected whole numbers");
            return Err(self.source().damaged(Place::of("messages"), problem));
        };
        match (u32::try_from(*topic), u64::try_from(*time)) {
            (Ok(topic), Ok(time)) => Ok((topic, time)),
            _ => {
                let problem = format!("a message of topic {topic} at {time} ns");
                Err(self.source().damaged(Place::of("messages"), problem))
            }
        }
    }
}

impl MessageStore for Rosbag2 {
    fn source(&self) -> &Source {
        self.database.source()
    }

    fn channels(&self) -> &BTreeMap<u32, Channel> {
        &self.channels
    }

    fn cut_at(&self) -> Option<u64> {
        self.database.cut_at()
    }

    fn index(&self, channels: &BTreeSet<u32>) -> Result<Vec<Entry>, TableError> {
        let mut entries = Vec::new();
        self.each_message(&mut |channel, entry| {
            if !channels.contains(&channel) {
                return Ok(());
            }
            if entries.len() >= limits::MESSAGES {
                let problem = format!("more than {} messages of one topic", limits::MESSAGES);
                return Err(self.source().too_large(Place::of("messages"), problem));
            }
            entries.push(entry);
            Ok(())
        })?;
        // Stable sort: rows at equal times stay in the order of writing.
        entries.sort_by_key(|entry| entry.log_time);
        Ok(entries)
    }

    fn reader(&self) -> Result<Box<dyn MessageReader + '_>, TableError> {
        Ok(Box::new(Rows {
            bag: self,
            pages: Pages::new(&self.database)?,
        }))
    }
}

/// Reader of the messages of a rosbag2 database, with its own cursor.
struct Rows<'a> {
    bag: &'a Rosbag2,
    pages: Pages<'a>,
}

impl MessageReader for Rows<'_> {
    fn message(&mut self, entry: &Entry) -> Result<Message, TableError> {
        let bag = self.bag;
        let page = entry.chunk.and_then(|page| u32::try_from(page).ok());
        let place = RowPlace {
            page: page.unwrap_or(0),
            cell: u16::try_from(entry.at).unwrap_or(u16::MAX),
        };
        let columns = bag.columns();
        let mut record = Record::read(&mut self.pages, &bag.messages, place)?;
        let (channel, log_time) = bag.head(&mut record, columns)?;
        let range = match record.value(columns.data)? {
            Value::Blob(range) => range,
            other => {
                let problem = format!("a message is {other:?}, expected bytes");
                return Err(bag.source().damaged(Place::of("messages"), problem));
            }
        };
        let held = Arc::new(record.into_bytes());
        Ok(Message::new(channel, log_time, log_time, held, range))
    }
}

/// Rejects a database of a later rosbag2, or a database that is not a recording.
fn check_schema(database: &Database) -> Result<(), TableError> {
    let source = database.source();
    let names: Vec<&str> = database
        .tables()
        .iter()
        .map(|table| table.name.as_str())
        .collect();
    if !names.contains(&"topics") || !names.contains(&"messages") {
        let problem = format!(
            "its tables are {}: expected `topics` and `messages`, as rosbag2 writes them",
            names.join(", ")
        );
        return Err(source.unsupported(Place::default(), problem));
    }
    let convert =
        "convert it to `storage_id: mcap` with `ros2 bag convert` of the ROS that wrote it";
    if let Some(other) = names.iter().find(|name| !TABLES.contains(name)) {
        let problem =
            format!("an unknown table, not in rosbag2 schemas up to version {VERSION}: {convert}");
        return Err(source.unsupported(Place::of(other), problem));
    }
    let versions = database
        .tables()
        .iter()
        .find(|table| table.name == "schema");
    let position = versions.and_then(|table| Some((table, table.position("schema_version")?)));
    let Some((table, position)) = position else {
        return Ok(());
    };
    database.each_row(table, &mut |_, record| match record.value(position)? {
        Value::Integer(version) if version > VERSION => {
            let problem = format!(
                "rosbag2 schema version {version}, but only versions up to {VERSION} are read: {convert}"
            );
            Err(source.unsupported(Place::of("schema"), problem))
        }
        _ => Ok(()),
    })
}

/// Finds the table `name`. It must have the first `least` columns of `known`, and no column that is not in `known`.
fn table<'d>(
    database: &'d Database,
    name: &str,
    known: &[&str],
    least: usize,
) -> Result<&'d SqliteTable, TableError> {
    let source = database.source();
    let found = database.tables().iter().find(|table| table.name == name);
    let Some(table) = found else {
        return Err(source.unsupported(Place::of(name), "there is no such table"));
    };
    let unknown = table
        .columns
        .iter()
        .find(|column| !known.contains(&column.as_str()));
    let missing = known
        .iter()
        .take(least)
        .find(|column| table.position(column).is_none());
    let problem = match (unknown, missing) {
        (None, None) => return Ok(table),
        (_, Some(column)) => {
            format!("no column `{column}`, although every version of rosbag2 writes it")
        }
        (Some(column), None) => format!(
            "an unknown column `{}`, not in rosbag2 schemas up to version {VERSION}: convert it to `storage_id: mcap` with `ros2 bag \
             convert` of the ROS that wrote it",
            crate::error::shown(column)
        ),
    };
    Err(source.unsupported(Place::of(name), problem))
}

/// Topics by number. The definition of their messages is from the file, or else a standard one of ROS 2, or missing.
fn channels(database: &Database) -> Result<BTreeMap<u32, Channel>, TableError> {
    let source = database.source();
    let definitions = definitions(database)?;
    let topics = table(database, "topics", &OF_TOPICS, 4)?;
    let [id, name, kind, encoding] = ["id", "name", "type", "serialization_format"]
        .map(|name| topics.position(name).unwrap_or(usize::MAX));
    let mut channels = BTreeMap::new();
    database.each_row(topics, &mut |_, record| {
        let id = match record.value(id)? {
            Value::Integer(id) => u32::try_from(id).ok(),
            _ => None,
        };
        let id =
            id.ok_or_else(|| source.damaged(Place::of("topics"), "a topic without a number"))?;
        let kind = record.text(kind)?;
        let known = || {
            ros::known_definition(&kind).map(|text| {
                Arc::new(Schema {
                    name: kind.clone(),
                    encoding: "ros2msg".to_owned(),
                    text: text.as_bytes().to_vec(),
                })
            })
        };
        let stated = definitions
            .get(&kind)
            .filter(|schema| schema.encoding == "ros2msg");
        let schema = stated
            .cloned()
            .or_else(known)
            .or_else(|| definitions.get(&kind).cloned());
        let channel = Channel {
            topic: record.text(name)?,
            encoding: record.text(encoding)?,
            schema: Some(schema.unwrap_or_else(|| {
                // Custom type of a laboratory, without a definition.
                Arc::new(Schema {
                    name: kind.clone(),
                    encoding: String::new(),
                    text: Vec::new(),
                })
            })),
            count: 0,
        };
        if channels.insert(id, channel).is_some() || channels.len() > limits::NAMES {
            let problem = format!(
                "topic {id} occurs twice, or there are more than {} topics",
                limits::NAMES
            );
            return Err(source.damaged(Place::of("topics"), problem));
        }
        Ok(())
    })?;
    Ok(channels)
}

/// Message definitions that the file contains, by type; empty for a recording older than ROS 2 Iron.
fn definitions(database: &Database) -> Result<BTreeMap<String, Arc<Schema>>, TableError> {
    let mut found = BTreeMap::new();
    let Some(table) = database
        .tables()
        .iter()
        .find(|table| table.name == "message_definitions")
    else {
        return Ok(found);
    };
    let positions =
        ["topic_type", "encoding", "encoded_message_definition"].map(|name| table.position(name));
    let [Some(kind), Some(encoding), Some(text)] = positions else {
        return Ok(found);
    };
    let mut described = 0_u64;
    database.each_row(table, &mut |_, record| {
        described = described.saturating_add(record.bytes());
        if described > limits::DESCRIPTION_BYTES {
            let place = Place::of(&table.name);
            return Err(database
                .source()
                .too_large(place, "more definitions than are accepted"));
        }
        let schema = Schema {
            name: record.text(kind)?,
            encoding: record.text(encoding)?,
            text: record.text(text)?.into_bytes(),
        };
        found.insert(schema.name.clone(), Arc::new(schema));
        Ok(())
    })?;
    Ok(found)
}
