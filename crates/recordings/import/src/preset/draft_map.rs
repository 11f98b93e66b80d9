//! Drafts maps for layouts whose columns vary, with the units of the layout.

use std::path::Path;

use crate::draft::MapDraft;
use crate::error::ImportError;

/// Drafted map for the folder at `source`, preceded by the comments of the layout.
pub(super) fn text(comments: &str, source: &Path) -> Result<String, ImportError> {
    let draft = MapDraft::of(source)?;
    let mut text = format!("{}\n", comments.trim_end());
    let mut all = draft.text().lines();
    let has_channel =
        all.any(|line| line.contains("{ from = \"") && !line.contains("{ from = \"?\""));
    let lines = draft.text().lines();
    let lines = lines.skip_while(|line| line.starts_with('#'));
    // The user has already chosen the preset.
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
        // An uncertain channel is left out if there is another channel.
        let line = match line.contains("{ from = \"?\"") && has_channel {
            true => format!("# Left out: {}", line.replace("\"?\"", "?")),
            false => line,
        };
        text += &line;
        text.push('\n');
    }
    match text.contains("\"?\"") {
        false => Ok(text),
        true => Err(ImportError::request(
            source,
            "the drafted map leaves open more than units: write the draft by `--draft`, and replace every \"?\"",
        )),
    }
}
