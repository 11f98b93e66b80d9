//! The layouts of `taceva import --preset`.

use std::io::{self, Write};

use serde::Serialize;
use taceva_import::Preset;

use super::json;
use crate::args::ListFormat;

/// Indent of the description of a preset, characters.
const INDENT: usize = 24;

/// Writes all presets. Text has lines of at most `line` characters.
pub(crate) fn list(format: ListFormat, line: usize, out: &mut dyn Write) -> io::Result<()> {
    if format == ListFormat::Json {
        return json::write(&WrittenPresets::all(), out);
    }
    for preset in Preset::all() {
        let open = format!("leaves open: {}", preset.leaves_open());
        let reads = format!("reads {}", preset.reads());
        let mut name = preset.name();
        for text in [preset.layout(), &reads, &open] {
            for part in wrapped(text, line.saturating_sub(INDENT)) {
                writeln!(out, "{name:<INDENT$}{part}")?;
                name = "";
            }
        }
    }
    writeln!(
        out,
        "\ntaceva import FOLDER --preset NAME --out DATASET; with --print its map, to be adapted"
    )
}

/// Wraps text to lines of at most `letters` characters. A longer word has its own line.
fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= letters => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[derive(Serialize)]
struct WrittenPresets {
    schema: &'static str,
    presets: Vec<WrittenPreset>,
}

#[derive(Serialize)]
struct WrittenPreset {
    name: &'static str,
    layout: &'static str,
    reads: &'static str,
    leaves_open: &'static str,
}

impl WrittenPresets {
    fn all() -> WrittenPresets {
        let presets = Preset::all().map(|preset| WrittenPreset {
            name: preset.name(),
            layout: preset.layout(),
            reads: preset.reads(),
            leaves_open: preset.leaves_open(),
        });
        WrittenPresets {
            schema: "taceva.presets/1",
            presets: presets.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_between_words_and_a_long_word_stands_alone() {
        assert_eq!(wrapped("a bc def", 4), ["a bc", "def"]);
        assert_eq!(wrapped("a muchtoolong b", 4), ["a", "muchtoolong", "b"]);
        assert_eq!(wrapped("", 4), [""]);
    }
}
