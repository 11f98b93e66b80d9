//! Maps of layouts whose columns differ from recording to recording: a draft, whose units are those that the layout is written in.

use std::path::Path;

use super::layouts::Preset;
use crate::draft::MapDraft;
use taceva_dataset::DatasetError;

const LEROBOT: &str = "\
# LeRobot 2.1 or 3.0. What a state means is known by the names in meta/info.json; its units stand nowhere: N, N·m and m are assumed.
";
const ROS: &str = "\
# A recording of ROS 2. Units are those of REP 103, which its messages are written in: N, N·m, m, s.
# How much later one clock shows the same instant stands nowhere: `lag_ms = 0` is assumed.
";

/// The map for the folder at `source`.
pub(super) fn text(preset: Preset, source: &Path) -> Result<String, DatasetError> {
    let draft = MapDraft::of(source)?;
    let mut text = match preset {
        Preset::Rosbag => ROS.to_owned(),
        _ => LEROBOT.to_owned(),
    };
    let lines = draft.text().lines();
    let lines = lines.skip_while(|line| line.starts_with('#'));
    // That there is such a preset is known here.
    for line in lines.filter(|line| !line.contains("`--preset")) {
        let unit = match line.as_bytes().first() {
            Some(b'F') => "\"N\"",
            Some(b'T') => "\"Nm\"",
            _ => "\"m\"",
        };
        let line = match line.starts_with("model = ") {
            true => line.replace("\"?\"", "\"unknown\""),
            false => line.replace("unit = \"?\"", &format!("unit = {unit}")),
        };
        text += &line;
        text.push('\n');
    }
    match text.contains("\"?\"") {
        false => Ok(text),
        true => Err(DatasetError::Request {
            path: source.to_owned(),
            problem: "more than units is open in it: `--draft` writes a map to be filled in"
                .to_owned(),
        }),
    }
}
