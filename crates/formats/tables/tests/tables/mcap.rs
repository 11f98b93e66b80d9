//! Tests with MCAP files that the Foxglove libraries wrote. Every message must equal the message that those libraries read back.

use crate::recordings::{at, digest, expected, number, picture_digest, recording};
use serde_json::Value;
use taceva_tables::{Cell, Picture, Recording, SampleForm, TableError, TopicTable};

const THREE: [u64; 3] = [0, 7, 23];
const FIELDS: [(&str, &str); 6] = [
    ("Fx", "wrench.force.x"),
    ("Fy", "wrench.force.y"),
    ("Fz", "wrench.force.z"),
    ("Tx", "wrench.torque.x"),
    ("Ty", "wrench.torque.y"),
    ("Tz", "wrench.torque.z"),
];
/// Files with the same messages: in chunks with indices, outside chunks, without indices, without a summary.
const WRITTEN: [&str; 4] = ["chunks", "loose", "no_index", "no_summary"];

fn open(folder: &str, file: &str) -> Recording {
    Recording::open(&recording(folder).join(file)).expect(file)
}

fn numbers(table: &TopicTable, name: &str) -> Vec<f64> {
    let column = table.column(name).expect(name);
    let number = |cell: &Cell| match cell {
        Cell::Number(value) => *value,
        other => panic!("{other:?}"),
    };
    column.iter().map(number).collect()
}

#[test]
fn forces_and_pictures_are_those_that_were_written() {
    for codec in ["none", "lz4", "zstd"] {
        let folder = format!("mcap-{codec}");
        let recording = open(&folder, "run.mcap");
        let expected = expected(&folder);
        let topics: Vec<_> = recording
            .topics()
            .iter()
            .map(|topic| {
                (
                    topic.name.as_str(),
                    topic.schema.as_str(),
                    topic.encoding.as_str(),
                    topic.count,
                )
            })
            .collect();
        assert_eq!(
            topics,
            [
                ("/ft/wrench", "geometry_msgs/msg/WrenchStamped", "cdr", 200),
                (
                    "/tactile/image/compressed",
                    "sensor_msgs/msg/CompressedImage",
                    "cdr",
                    24
                ),
                ("/tactile/image_raw", "sensor_msgs/msg/Image", "cdr", 3),
            ]
        );
        let pictures = recording
            .table("/tactile/image/compressed")
            .expect("a topic");
        let force = recording.table("/ft/wrench").expect("a topic");
        assert_eq!((pictures.rows(), force.rows()), (24, 200));
        assert_eq!(
            pictures.names().expect("names"),
            [
                "log_time",
                "log_time.ns",
                "publish_time",
                "publish_time.ns",
                "header.stamp",
                "header.frame_id",
                "format",
                "data"
            ]
        );
        let stamps = numbers(&pictures, "header.stamp");
        let force_stamps = numbers(&force, "header.stamp");
        let logged = pictures
            .columns(&["header.stamp.ns", "log_time.ns"])
            .expect("times");
        for (stamp, logged) in logged[0].iter().zip(&logged[1]) {
            let (Cell::Integer(stamp), Cell::Integer(logged)) = (stamp, logged) else {
                panic!()
            };
            // Both were rounded to nanoseconds in writing.
            assert!((logged - stamp - 2_000_000).abs() <= 1, "{stamp} {logged}");
        }
        for row in THREE {
            let labels = &expected["labels"][row.to_string()];
            let stamp = stamps[at(row)];
            assert!((stamp - 1_700_000_000.0 - number(&labels["t_s"])).abs() < 3e-7);
            // Force with the stamp nearest to 40 ms later.
            let distance = |at: &usize| (force_stamps[*at] - stamp - 0.040).abs();
            let nearest = (0..200)
                .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                .expect("some");
            for (channel, field) in FIELDS {
                let value = numbers(&force, field)[nearest];
                assert!(
                    (value - number(&labels[channel])).abs() < 1e-15,
                    "{codec}, {row}, {channel}"
                );
            }
        }
        let mut seen = 0;
        pictures
            .visit_pictures::<TableError>("data", &[0, 7, 7, 23], &mut |row, picture| {
                let Picture::Encoded(bytes) = picture else {
                    panic!()
                };
                assert_eq!(
                    picture_digest(&bytes),
                    expected["frames_sha256"][row.to_string()]
                );
                seen += 1;
                Ok(())
            })
            .expect("pictures");
        assert_eq!(seen, 4);
        let raw = recording.table("/tactile/image_raw").expect("a topic");
        raw.visit_pictures::<TableError>("data", &[0], &mut |row, picture| {
            let Picture::Samples(mut samples) = picture else {
                panic!()
            };
            assert_eq!(
                (samples.width, samples.height, samples.form),
                (64, 48, SampleForm::Bgr8)
            );
            samples
                .bytes
                .chunks_exact_mut(3)
                .for_each(|pixel| pixel.reverse());
            assert_eq!(
                digest(&samples.bytes),
                expected["frames_sha256"][row.to_string()]
            );
            Ok(())
        })
        .expect("pictures");
    }
}

/// Collects the fields of a message of `expected.json` with dotted names. Times and lists are not split.
fn flat(value: &Value, above: &str, into: &mut Vec<(String, Value)>) {
    match value {
        Value::Object(members) if members.len() == 2 && members.contains_key("nanosec") => {
            let stamp = members["sec"].as_i64().expect("seconds") * 1_000_000_000;
            let stamp = stamp + members["nanosec"].as_i64().expect("nanoseconds");
            into.push((format!("{above}.ns"), Value::from(stamp)));
        }
        Value::Object(members) => {
            for (name, member) in members {
                let dot = if above.is_empty() { "" } else { "." };
                flat(member, &format!("{above}{dot}{name}"), into);
            }
        }
        other => into.push((above.to_owned(), other.clone())),
    }
}

fn same(cell: &Cell, value: &Value) -> bool {
    match (cell, value) {
        (Cell::Bool(cell), Value::Bool(value)) => cell == value,
        (Cell::Integer(cell), Value::Number(value)) => value.to_string() == cell.to_string(),
        (Cell::Number(cell), Value::Number(value)) => value
            .as_f64()
            .is_some_and(|value| value.to_bits() == cell.to_bits()),
        (Cell::Text(cell), Value::String(value)) => cell == value,
        (Cell::List(cells), Value::Array(values)) => {
            cells.len() == values.len()
                && cells
                    .iter()
                    .zip(values)
                    .all(|(cell, value)| same(cell, value))
        }
        (Cell::Struct(cells), Value::Object(values)) => {
            cells.len() == values.len()
                && cells.iter().all(|(name, cell)| same(cell, &values[name]))
        }
        _ => false,
    }
}

#[test]
fn every_field_of_every_message_is_read_however_the_file_is_written() {
    let expected = expected("mcap");
    for written in WRITTEN {
        let recording = open("mcap", &format!("{written}.mcap"));
        for (topic, messages) in expected.as_object().expect("topics") {
            let table = recording.table(topic).expect(topic);
            let messages = messages.as_array().expect("messages");
            assert_eq!(table.rows(), messages.len() as u64, "{written}, {topic}");
            let mut first = Vec::new();
            flat(&messages[0]["message"], "", &mut first);
            let mut names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
            names.extend(["log_time.ns", "publish_time.ns"]);
            let columns = table.columns(&names).expect(topic);
            for (row, message) in messages.iter().enumerate() {
                let mut fields = Vec::new();
                flat(&message["message"], "", &mut fields);
                for time in ["log_time.ns", "publish_time.ns"] {
                    fields.push((time.to_owned(), message[time].clone()));
                }
                assert_eq!(fields.len(), columns.len());
                for ((name, value), column) in fields.iter().zip(&columns) {
                    assert!(
                        same(&column[row], value),
                        "{written}, {topic}, {name}, row {row}: {:?}, {value}",
                        column[row]
                    );
                }
            }
        }
    }
}

#[test]
fn places_inside_lists_and_messages_of_json_are_columns() {
    for written in WRITTEN {
        let recording = open("mcap", &format!("{written}.mcap"));
        let joints = recording.table("/joints").expect("a topic");
        assert_eq!(
            joints.column("position[0]").expect("numbers")[5],
            Cell::Number(2.5)
        );
        assert_eq!(
            joints.column("name[1]").expect("texts")[3].text(),
            "joint_b"
        );
        let problem = joints.column("velocity[0]").expect_err("empty").to_string();
        assert!(
            problem.contains("/joints") && problem.contains("no element `[0]`"),
            "{problem}"
        );
        let taxels = recording.table("/taxels").expect("a topic");
        assert_eq!(
            taxels.column("raw[3]").expect("numbers")[0],
            Cell::Integer(255)
        );
        let notes = recording.table("/notes").expect("a topic");
        assert_eq!(notes.rows(), 3);
        assert_eq!(notes.names().expect("names")[4..], ["grip", "object.name"]);
        let columns = notes
            .columns(&["object.name", "grip[0]", "log_time", "absent"])
            .expect("columns");
        assert_eq!(columns[0][2].text(), "cube2");
        assert_eq!(columns[1][1], Cell::Integer(1));
        assert_eq!(columns[2][2], Cell::Number(2.0));
        assert_eq!(columns[3][0], Cell::Null);
    }
}

#[test]
fn rows_of_padded_samples_lose_their_padding() {
    for written in WRITTEN {
        let depth = open("mcap", &format!("{written}.mcap"))
            .table("/depth")
            .expect("a topic");
        let mut rows = Vec::new();
        depth
            .visit_pictures::<TableError>("data", &[0, 2], &mut |row, picture| {
                let Picture::Samples(samples) = picture else {
                    panic!()
                };
                assert_eq!(
                    (samples.width, samples.height, samples.form),
                    (5, 3, SampleForm::Mono16)
                );
                let values = samples
                    .bytes
                    .chunks_exact(2)
                    .map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
                let tick = 4 * u16::try_from(row).expect("small");
                assert!(values.eq((0..15).map(|at| at * 1000 + tick)));
                rows.push(row);
                Ok(())
            })
            .expect("pictures");
        assert_eq!(rows, [0, 2]);
    }
}

#[test]
fn what_is_not_there_is_named_with_what_is() {
    let recording = open("mcap", "chunks.mcap");
    let message = recording.table("/force").expect_err("none").to_string();
    assert!(
        message.ends_with(
            "chunks.mcap: no `/force`, expected one of /array, /depth, /joints, /notes, /pose, /taxels"
        ),
        "{message}"
    );
    let pose = recording.table("/pose").expect("a topic");
    let message = pose
        .column("pose.position.w")
        .expect_err("none")
        .to_string();
    assert!(
        message.contains("no `pose.position.w`, expected one of log_time, "),
        "{message}"
    );
    let visit = |name: &str, rows: &[u64]| {
        let visited = pose.visit_pictures::<TableError>(name, rows, &mut |_, _| Ok(()));
        visited.expect_err(name).to_string()
    };
    assert!(visit("data", &[0]).contains("geometry_msgs/PoseStamped has no `data`"));
    assert!(
        visit("pose.position.x", &[0])
            .contains("`x` of geometry_msgs/Point is not a list of uint8")
    );
    let depth = recording.table("/depth").expect("a topic");
    let visit = |rows: &[u64]| {
        let visited = depth.visit_pictures::<TableError>("data", rows, &mut |_, _| Ok(()));
        visited.expect_err("wrong").to_string()
    };
    assert!(visit(&[3]).contains("row 3 was requested, but there are 3 rows, counted from 0"));
    assert!(visit(&[1, 0]).contains("rows must ascend"));
}

#[test]
fn threads_share_a_table() {
    let pictures = open("mcap-zstd", "run.mcap")
        .table("/tactile/image/compressed")
        .expect("a topic");
    let all: Vec<u64> = (0..24).collect();
    let read = |rows: &[u64]| {
        let mut digests = Vec::new();
        pictures
            .visit_pictures::<TableError>("data", rows, &mut |_, picture| {
                let Picture::Encoded(bytes) = picture else {
                    panic!()
                };
                digests.push(digest(&bytes));
                Ok(())
            })
            .expect("pictures");
        digests
    };
    let whole = read(&all);
    std::thread::scope(|scope| {
        for start in 0..4 {
            let (read, whole) = (&read, &whole);
            scope.spawn(move || {
                let rows: Vec<u64> = (start..24).step_by(4).collect();
                let expected: Vec<String> =
                    rows.iter().map(|row| whole[at(*row)].clone()).collect();
                assert_eq!(read(&rows), expected);
            });
        }
    });
}
