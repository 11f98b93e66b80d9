//! Files that mention an example of a feature, such as one metric or one driver. A developer who adds such a feature must change these files.

use std::fs;
use std::path::{Path, PathBuf};

use crate::root;

/// Example of a feature that is added repeatedly.
#[derive(Debug)]
pub struct Example {
    /// Kind of feature.
    pub kind: &'static str,
    /// Words that name the example in product code, manifests and headers.
    pub words: &'static [&'static str],
    /// Greatest number of files that may mention the example.
    pub most: usize,
}

/// Examples whose files are counted.
pub const EXAMPLES: &[Example] = &[
    Example {
        kind: "metric",
        words: &[
            "signal_to_repeatability",
            "SignalToRepeatability",
            "SIGNAL_TO_REPEATABILITY",
        ],
        // File, catalogue row and radar axis of the metric.
        most: 3,
    },
    Example {
        kind: "model",
        words: &["elastic_net", "ElasticNet"],
        most: 5,
    },
    Example {
        kind: "check",
        words: &["stuck_taxel", "StuckTaxel"],
        most: 1,
    },
    Example {
        kind: "preset",
        words: &["ycb-slide"],
        most: 1,
    },
    Example {
        kind: "driver",
        words: &["netft", "NetFt"],
        most: 9,
    },
    Example {
        kind: "kind of device",
        words: &["changer", "Changer", "CHANGER", "bring"],
        most: 68,
    },
];

/// Product files that mention the example, relative to the workspace: Rust, C, Python and TOML outside tests, benches, examples and
/// documents.
///
/// # Panics
/// If a file cannot be read, which ends the test.
pub fn mentions(example: &Example) -> Vec<String> {
    let mut files = Vec::new();
    for folder in [
        "taceva-core",
        "taceva-metrics",
        "taceva-drivers",
        "taceva-models",
        "taceva-cli",
        "crates",
        "plugins",
        "python",
    ] {
        walk(&root().join(folder), &mut files);
    }
    let mut found: Vec<String> = files
        .iter()
        .filter(|file| {
            let text = fs::read_to_string(file).unwrap_or_default();
            let code = text
                .split("\n#[cfg(test)]\nmod ")
                .next()
                .unwrap_or_default();
            let lines = code
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"));
            lines
                .flat_map(words)
                .any(|word| example.words.contains(&word))
        })
        .map(|file| {
            file.strip_prefix(root())
                .expect("below the root")
                .display()
                .to_string()
        })
        .collect();
    found.sort();
    found
}

/// Words of a line; `-` is a letter of a word.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|letter: char| !(letter.is_alphanumeric() || letter == '_' || letter == '-'))
}

/// Product files below `folder`.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).into_iter().flatten();
    for path in entries.map(|entry| entry.expect("readable").path()) {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let is_beside = [
            "tests", "benches", "examples", "fuzz", "target", "vendor", "tests.rs",
        ]
        .contains(&name.as_str());
        if is_beside || path.is_symlink() {
            continue;
        }
        if path.is_dir() {
            walk(&path, files);
        } else if path.extension().is_some_and(|end| {
            ["rs", "h", "hpp", "py", "pyi", "toml", "in"]
                .iter()
                .any(|known| end == *known)
        }) {
            files.push(path);
        }
    }
}
