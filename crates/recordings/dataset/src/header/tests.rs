use taceva_core::{FrameInfo, Limit, PixelFormat};

use super::*;
use crate::decode::ChannelOrder;

fn yaw() -> Channel {
    let yaw = Channel::named("yaw", Unit::Degree).and_then(|yaw| yaw.with_period(360));
    yaw.expect("an angle")
}

fn slip() -> Task {
    let mut slip = Task::new("slip", task::TaskKind::Event, "trajectory");
    slip.names = ["no_slip", "slip"].map(str::to_owned).to_vec();
    slip.positive = Some("slip".to_owned());
    slip.is_timed = true;
    slip.rule = Some("shear > 1.6 normal".to_owned());
    slip.thresholds = Some(task::PoseThresholds::new(
        vec!["0.1".to_owned()],
        Vec::new(),
    ));
    slip
}

fn header() -> Header {
    Header {
        format: Version::CURRENT,
        source: Source::Simulated,
        clock: Clock::Monotonic,
        recorded_on: Some(Date::of_unix_s(0)),
        recorded_until: Some(Date::of_unix_s(86_400)),
        sensor: SensorFacts {
            model: "a \"b\"\n[c]".to_owned(),
            serial: "unknown".to_owned(),
            gel: "g1".to_owned(),
            opaque: Known::Unknown,
            presses_since_gel: Some(1200),
            leds: Leds {
                red: Some(PictureSide::Left),
                ..Leds::default()
            },
        },
        footprint: Some(Footprint {
            shape: Shape::Disc,
            radius_mm: Some(10.0),
            half_x_mm: None,
            half_y_mm: None,
            depth_max_mm: Some(2.5),
        }),
        settings: BTreeMap::from([("exposure_ms".to_owned(), "15.7".to_owned())]),
        traceability: vec![Traceability::new(taceva_core::Instrument::Force)],
        channels: Channels::new([Channel::FZ, Channel::PZ, yaw()]).expect("distinct"),
        attributes: vec!["video".to_owned()],
        views: Vec::new(),
        sources: None,
        columns: vec![MappedColumn {
            sign: -1,
            offset: vec![0.1],
            ..MappedColumn::new("Fz", vec!["force [z]".to_owned()], "mN")
        }],
        joins: vec![MappedJoin {
            unmatched: "drop".to_owned(),
            lag_ms: Some(12.5),
            skip: vec!["4 = -1".to_owned()],
            ..MappedJoin::new("ft", "time")
        }],
        pictures: vec![MappedPictures {
            range: Some([0.0, 0.1]),
            bits: Some(8),
            ..MappedPictures::new("array", "/rgb")
        }],
        classes: vec![MappedClass::new(
            "texture",
            "path.class",
            vec!["smooth".to_owned(), "rough".to_owned()],
        )],
        tasks: vec![slip()],
        digest_with_tasks: Some(Digest::of(b"tasks")),
        rotations: vec![["Rx", "Ry", "Rz"].map(str::to_owned).to_vec()],
        left_out: LeftOut::default(),
        warnings: vec!["zone-unstated: `t` states no time zone".to_owned()],
        unmentioned_columns: vec!["quality_flags".to_owned()],
        frames: Some(FramesInfo {
            count: 3,
            info: FrameInfo {
                width: 4,
                height: 2,
                format: PixelFormat::Rgb8,
            },
            channel_order: ChannelOrder::Bgr,
            codec: None,
            other_codecs: Vec::new(),
            reduced: Some(ReducedFrames::area_averages(FrameInfo {
                width: 8,
                height: 6,
                format: PixelFormat::Rgb16,
            })),
            reference: None,
        }),
        stream: None,
        predictions: Some(LivePredictions::new(
            "ridge",
            Digest::of(b"model"),
            b"sample\na\n",
        )),
        signals: None,
        extended: Vec::new(),
        presses: BTreeMap::from([
            (PressOutcome::Complete, 2),
            (PressOutcome::Limited(Limit::NormalForce), 1),
        ]),
        table: TableInfo {
            rows: 3,
            digest: Digest::of(b"t"),
            sha256: Digest::of(b"f"),
        },
        digest: Digest::of(b"d"),
        seal: Opened::default(),
    }
}

#[test]
fn a_header_reads_back_as_it_was_written() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("dataset.toml"), header().to_toml()).expect("written");
    let held = HeldFolder::open(folder.path()).expect("a folder");
    let read = Header::read(&held).expect("reads");
    let unread = Header {
        seal: Opened::default(),
        ..read
    };
    assert_eq!(unread, header());
}

#[test]
fn an_unknown_side_or_colour_of_leds_is_refused_with_its_line_and_the_known_ones() {
    let known = "red = \"left\"";
    for (wrong, expected) in [
        (
            "red = \"up\"",
            "unknown variant `up`, expected one of `left`, `right`, `top`, `bottom`",
        ),
        (
            "amber = \"left\"",
            "`amber`: unknown key; known here: red, green, blue",
        ),
    ] {
        let text = header().body().replace(known, wrong);
        let text = taceva_files::seal::toml_text::seal(&text).expect("TOML");
        let line = text.lines().position(|line| line.contains(wrong));
        let line = line.expect("written") + 1;
        let message = Header::parse(Path::new("dataset.toml"), text.into_bytes());
        let message = message.expect_err("wrong").to_string();
        let expected = format!("line {line}: {expected}");
        assert!(message.contains(&expected), "{expected}: {message}");
    }
}

#[test]
fn a_newer_major_is_refused_before_anything_else_is_understood() {
    let text = b"format = \"2.0\"\nnews = 1\n".to_vec();
    let message = Header::parse(Path::new("dataset.toml"), text);
    let message = message.expect_err("newer").to_string();
    assert!(
        message.ends_with("format 2.0 needs a newer TacEva; this one reads up to 1.x"),
        "{message}"
    );
}

#[test]
fn an_earlier_format_is_refused_with_the_command_that_makes_the_dataset_anew() {
    let current = format!("\"{}\"", Version::CURRENT);
    let text = header().body().replace(&current, "\"1.10\"").into_bytes();
    let message = Header::parse(Path::new("dataset.toml"), text);
    let message = message.expect_err("earlier").to_string();
    assert!(
        message.starts_with("dataset.toml: format 1.10 was written by TacEva before 0.2.0; ")
            && message.contains("taceva import FOLDER --map MAP.toml --out DATASET"),
        "{message}"
    );
}

#[test]
fn a_newer_minor_may_say_more() {
    let current = format!("\"{}\"", Version::CURRENT);
    let text = header().body().replace(&current, "\"1.11\"");
    let text = taceva_files::seal::toml_text::seal(&format!("humidity = 40\n{text}"));
    let text = text.expect("TOML").into_bytes();
    let header = Header::parse(Path::new("dataset.toml"), text);
    assert_eq!(
        header.expect("reads").format,
        Version {
            major: 1,
            minor: 11
        }
    );
}

#[test]
fn a_kind_of_task_of_a_later_minor_is_skipped_and_the_others_are_read() {
    let later = "[task.sheen]\nkind = \"spectrum\"\narray = \"sheen.npy\"\n";
    let text = format!("{}\n{later}", header().body());
    let text = taceva_files::seal::toml_text::seal(&text).expect("TOML");
    let read = Header::parse(Path::new("dataset.toml"), text.into_bytes());
    assert_eq!(read.expect("reads").tasks, [slip()]);
}

#[test]
fn an_edited_header_is_refused_by_its_key_and_one_without_a_seal_by_that() {
    let parse = |text: &str| Header::parse(Path::new("dataset.toml"), text.as_bytes().to_vec());
    let sealed = header().to_toml();
    let edited = sealed.replace("radius_mm = 10.0", "radius_mm = 9.0");
    let message = parse(&edited).expect_err("edited").to_string();
    assert!(
        message.starts_with("dataset.toml: `footprint.radius_mm` was changed after it was sealed"),
        "{message}"
    );
    let body = header().body();
    let message = parse(&body).expect_err("no seal").to_string();
    assert!(message.contains("the seal is missing"), "{message}");
    let current = format!("\"{}\"", Version::CURRENT);
    let (_, alone) = sealed.split_once("\n[seal]").expect("sealed");
    let alone = format!("format = {current}\n[seal]{alone}");
    assert!(parse(&alone).is_err());
}
