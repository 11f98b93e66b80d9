//! Maps of layouts whose columns differ from recording to recording: a draft, whose units are those that the layout is written in.

use std::path::Path;

use crate::draft::MapDraft;
use taceva_dataset::DatasetError;

/// The map for the folder at `source`, below the comments of the layout.
pub(super) fn text(comments: &str, source: &Path) -> Result<String, DatasetError> {
    let draft = MapDraft::of(source)?;
    let mut text = format!("{}\n", comments.trim_end());
    let mut all = draft.text().lines();
    let has_channel =
        all.any(|line| line.contains("{ from = \"") && !line.contains("{ from = \"?\""));
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
        // A channel of which nothing is sure is left out, as long as there is another.
        let line = match line.contains("{ from = \"?\"") && has_channel {
            true => format!("# Left out: {}", line.replace("\"?\"", "?")),
            false => line,
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
