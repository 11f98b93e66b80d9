//! Every preset on a folder of its layout, drawn by `tests/presets/make.py`: counts, labels, pictures, times and roles of the rows.

mod archive;
mod taxels;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{Decoders, ImportMap, ImportPlan, MapDraft, Preset};

/// Expected result of importing a layout.
struct Expected {
    /// Name of the preset.
    preset: &'static str,
    rows: usize,
    channels: &'static [&'static str],
    /// Row, channel, number in the stored unit.
    numbers: &'static [(usize, &'static str, f64)],
    /// The number of the picture of each row, as it was drawn; JPEG is not exact.
    pictures: &'static [u8],
    point: Option<&'static str>,
    attributes: &'static [(&'static str, usize, &'static str)],
    time: Option<(usize, f64)>,
}

/// Torques are stored in N·mm, positions in mm.
const EXPECTED: [Expected; 14] = [
    Expected {
        preset: "bristol",
        rows: 3,
        channels: &[
            "Px", "Py", "Pz", "Rx", "Ry", "Rz", "shear_Rx", "shear_Ry", "shear_Rz", "shear_x",
            "shear_y", "shear_z",
        ],
        numbers: &[(1, "Px", 2.0), (2, "Py", 5.0), (2, "Rz", 10.0)],
        pictures: &[0, 1, 2],
        point: Some("image_1.png"),
        attributes: &[],
        time: None,
    },
    Expected {
        preset: "py3dcal",
        rows: 3,
        channels: &["Px", "Py", "Pz"],
        numbers: &[(1, "Px", 2.0), (2, "Py", 5.0), (0, "Pz", 0.5)],
        pictures: &[0, 1, 2],
        point: Some("1.0:0.0"),
        attributes: &[],
        time: None,
    },
    Expected {
        preset: "9dtact",
        rows: 3,
        channels: &["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"],
        numbers: &[
            (1, "Fx", 0.25),
            (2, "Fz", 3.5),
            (2, "Tx", 250.0),
            (0, "Tz", -250.0),
        ],
        pictures: &[0, 1, 2],
        point: None,
        attributes: &[("object", 0, "1")],
        time: None,
    },
    Expected {
        preset: "allsight",
        rows: 3,
        channels: &["Px", "Py", "Pz", "Fx", "Fy", "Fz", "Tx", "Ty", "Tz"],
        numbers: &[(1, "Fy", -0.5), (2, "Fz", 3.5), (1, "Px", 2000.0)],
        pictures: &[0, 1, 2],
        point: None,
        attributes: &[
            ("gel", 0, "markers"),
            ("indenter", 2, "sphere3"),
            ("led", 0, "rrrgggbbb"),
        ],
        time: Some((2, 1.0)),
    },
    Expected {
        preset: "sparsh-force",
        rows: 4,
        channels: &["Fx", "Fy", "Fz"],
        numbers: &[(0, "Fz", 2.5), (2, "Fx", 1.0), (3, "Fz", 6.5)],
        // The last two are in the second pickle.
        pictures: &[1, 2, 4, 5],
        point: Some("sphere:batch_1:0"),
        attributes: &[("slip", 1, "1"), ("shape", 0, "sphere")],
        time: None,
    },
    Expected {
        preset: "ycb-slide",
        rows: 3,
        channels: &["Px", "Py", "Pz"],
        numbers: &[(1, "Px", 2000.0), (2, "Py", 5000.0)],
        pictures: &[0, 1, 2],
        point: Some("035_power_drill:0"),
        attributes: &[("object", 0, "035_power_drill")],
        time: Some((1, 10.5)),
    },
    Expected {
        preset: "touchd",
        rows: 3,
        channels: &["Fx", "Fy", "Fz"],
        numbers: &[(1, "Fy", -0.5), (2, "Fz", 3.5)],
        pictures: &[0, 1, 2],
        point: Some("006:1"),
        attributes: &[("action", 0, "press"), ("speed", 0, "1")],
        time: None,
    },
    Expected {
        preset: "tacquad",
        rows: 3,
        channels: &[],
        numbers: &[],
        pictures: &[0, 1, 2],
        point: Some("apple"),
        attributes: &[
            ("contact_first", 0, "1"),
            ("contact_last", 0, "2"),
            ("number", 2, "2"),
        ],
        time: None,
    },
    Expected {
        preset: "poseit",
        rows: 3,
        channels: &["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"],
        // The first force of each second.
        numbers: &[(1, "Fx", 0.25), (2, "Fz", 3.5)],
        pictures: &[0, 1, 2],
        point: Some("bangle:1612630172:8"),
        attributes: &[
            ("stage", 1, "grasping"),
            ("stage", 2, "pose"),
            ("grip", 0, "80"),
        ],
        time: Some((1, 1_612_630_173.0)),
    },
    Expected {
        preset: "tool-force",
        rows: 3,
        channels: &["Fz"],
        numbers: &[(0, "Fz", 1.5), (2, "Fz", 3.5)],
        pictures: &[0, 1, 2],
        point: Some("trial1"),
        attributes: &[],
        time: None,
    },
    Expected {
        preset: "univtac",
        rows: 3,
        channels: &["Px", "Py", "Pz"],
        numbers: &[(1, "Px", 2000.0), (2, "Py", 5000.0)],
        pictures: &[0, 1, 2],
        point: None,
        attributes: &[("episode", 0, "0")],
        time: None,
    },
    Expected {
        preset: "gelsight-live",
        rows: 3,
        channels: &[],
        numbers: &[],
        pictures: &[0, 1, 2],
        point: None,
        attributes: &[],
        time: None,
    },
    Expected {
        preset: "fota",
        rows: 6,
        channels: &["Px", "Py", "Pz"],
        numbers: &[(1, "Px", 2.0), (5, "Py", 5.0)],
        pictures: &[0, 1, 2, 0, 1, 2],
        point: None,
        attributes: &[("shard", 3, "000001")],
        time: None,
    },
    Expected {
        preset: "diffusion-zarr",
        rows: 3,
        channels: &["Fx", "Fy", "Fz"],
        numbers: &[(1, "Fx", 0.25), (2, "Fz", 3.5)],
        pictures: &[0, 1, 2],
        point: Some("0"),
        attributes: &[("episode", 1, "0"), ("episode", 2, "1")],
        time: None,
    },
];

pub(crate) fn preset(name: &str) -> Preset {
    Preset::from_name(name).expect("a preset")
}

/// The drawn folder of a layout.
pub(crate) fn drawn(name: &str) -> PathBuf {
    let presets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../tests/presets");
    presets.join(name)
}

fn import(source: &Path, map: &ImportMap, target: &Path) -> Dataset {
    let plan = ImportPlan::with_decoders(source, map, &Decoders::default()).expect("a plan");
    plan.run(target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(target).expect("opens")
}

impl Expected {
    fn hold(&self, dataset: &Dataset) {
        let name = self.preset;
        let table = dataset.table();
        assert_eq!(table.rows(), self.rows, "{name}");
        let mut channels: Vec<&str> = dataset
            .header()
            .channels
            .iter()
            .map(taceva_core::Channel::name)
            .collect();
        channels.sort_unstable();
        let mut expected = self.channels.to_vec();
        expected.sort_unstable();
        assert_eq!(channels, expected, "{name}");
        for (row, channel, expected) in self.numbers {
            let cells = table.as_text(channel).expect("a channel");
            let number: f64 = cells[*row]
                .as_deref()
                .expect("filled")
                .parse()
                .expect("a number");
            assert!(
                (number - expected).abs() < 1e-9,
                "{name}: {channel} of {row} is {number}"
            );
        }
        for (attribute, row, expected) in self.attributes {
            let cells = table.as_text(attribute).expect("an attribute");
            assert_eq!(
                cells[*row].as_deref(),
                Some(*expected),
                "{name}: {attribute} of {row}"
            );
        }
        let point = self
            .point
            .is_some()
            .then(|| table.point_id()[0].clone())
            .flatten();
        assert_eq!(point.as_deref(), self.point, "{name}");
        if let Some((row, expected)) = self.time {
            let cells = table.as_text("t_s").expect("times");
            assert_eq!(
                cells[row].as_deref().map(str::parse),
                Some(Ok(expected)),
                "{name}"
            );
        }
        for (row, number) in self.pictures.iter().enumerate() {
            let frame = dataset.frame(row).expect("decodes").expect("there");
            let red = frame.bytes()[0];
            assert!(
                red.abs_diff(40 + 10 * number) <= 2,
                "{name}: red {red} of row {row}"
            );
        }
    }
}

#[test]
fn every_layout_is_imported_by_its_preset() {
    for expected in EXPECTED {
        let target = tempfile::tempdir().expect("a folder");
        let source = drawn(expected.preset);
        let map = preset(expected.preset)
            .map(&source)
            .unwrap_or_else(|error| panic!("{error}"));
        let dataset = import(&source, &map, &target.path().join("set"));
        expected.hold(&dataset);
    }
}

#[test]
fn lerobot_and_ros_recordings_of_other_libraries_are_imported_by_their_presets() {
    for (name, recording, rows) in [
        ("lerobot-v3", "lerobot-v3-h264", 24),
        ("rosbag", "mcap-none", 24),
    ] {
        let preset = preset(name);
        let own = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../../tests/recordings")
            .join(recording);
        let target = tempfile::tempdir().expect("a folder");
        let text = preset.text(&own).unwrap_or_else(|error| panic!("{error}"));
        assert!(!text.contains("\"?\""), "{text}");
        let dataset = import(
            &own,
            &preset.map(&own).expect("a map"),
            &target.path().join("set"),
        );
        assert_eq!(dataset.table().rows(), rows, "{recording}");
        // By the map of the recording itself, because a preset cannot know the lag of its clocks.
        let written = std::fs::read_to_string(own.join("map.toml")).expect("there");
        let lines = written
            .lines()
            .map(|line| match line.starts_with("lag_ms") {
                true => "lag_ms = 0",
                false => line,
            });
        let text = lines.collect::<Vec<_>>().join("\n");
        let by_hand = ImportMap::parse("map.toml".as_ref(), &text).expect("a map");
        let by_hand = import(&own, &by_hand, &target.path().join("by_hand"));
        assert_eq!(dataset.table().rows(), rows, "{recording}");
        for channel in ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz", "t_s"] {
            let cells = dataset.table().as_text(channel).expect("a channel");
            assert_eq!(
                Some(cells),
                by_hand.table().as_text(channel),
                "{recording}: {channel}"
            );
        }
    }
}

#[test]
fn every_drawn_folder_is_recognised_and_a_draft_names_its_preset() {
    for expected in EXPECTED {
        let name = expected.preset;
        let draft = MapDraft::of(&drawn(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let line = format!("--preset {name}");
        assert!(draft.text().contains(&line), "{name}: {}", draft.text());
    }
}

#[test]
fn a_preset_on_a_folder_of_another_layout_names_what_it_expects_and_which_fits() {
    let error = preset("poseit")
        .map(&drawn("tacquad"))
        .expect_err("no grasps");
    let message = error.to_string();
    for part in [
        "*/gelsight/gelsight_*.jpg",
        "preset poseit expects",
        "--preset tacquad",
    ] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn the_written_map_is_the_map_that_is_imported() {
    for expected in EXPECTED {
        let source = drawn(expected.preset);
        let text = preset(expected.preset).text(&source).expect("a map");
        let parsed = ImportMap::parse("map.toml".as_ref(), &text).expect("a map");
        assert_eq!(parsed, preset(expected.preset).map(&source).expect("a map"));
    }
}
