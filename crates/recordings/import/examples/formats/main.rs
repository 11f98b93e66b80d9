//! Outcomes of importing files that other packages wrote, as rows of the table in `docs/your-recording.md`.
//!
//! ```text
//! cargo run -p taceva-import --example formats -- FOLDER [DATASETS]
//! ```
//!
//! With DATASETS, each dataset is kept in that folder with its map, so that `tests/formats/compare.py` can read the files again with their packages.
//! `packages.json` names the package that wrote each file or folder of FOLDER. The map beside this file imports it. Without a map, a fresh draft
//! imports it, with the units N, Nm and mm filled in. Clips need ffmpeg on the PATH.

#![expect(clippy::print_stdout, reason = "a program says what it found")]

use std::error::Error;
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use serde::Deserialize;
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{Decoders, ImportMap, ImportPlan, MapDraft};

/// File or folder, and the package that wrote it.
#[derive(Deserialize)]
struct Written {
    path: String,
    package: String,
    version: String,
    /// File name of a map beside this example; `None` for a fresh draft.
    #[serde(default)]
    map: Option<String>,
}

/// Maximum length of an error message in a row, characters.
const SHOWN: usize = 400;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("expected the FOLDER")?;
    let kept = arguments.next();
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/formats");
    let all: Vec<Written> = serde_json::from_str(&fs::read_to_string(own.join("packages.json"))?)?;
    println!("| package | version | files | outcome |\n|---|---|---|---|");
    for written in all {
        let lab = tempfile::tempdir()?;
        copy(&Path::new(&folder).join(&written.path), lab.path())?;
        let map = written
            .map
            .as_ref()
            .map(|map| fs::read_to_string(own.join(map)));
        let target = tempfile::tempdir()?;
        let target = match &kept {
            Some(kept) => Path::new(kept).join(written.path.replace('/', "-")),
            None => target.path().join("kept"),
        };
        fs::create_dir_all(&target)?;
        let outcome = match imported(lab.path(), map.transpose()?, &target) {
            Ok(outcome) => outcome,
            Err(problem) => format!("refused: {}", short(&problem.to_string(), lab.path())),
        };
        println!(
            "| {} | {} | `{}` | {outcome} |",
            written.package, written.version, written.path
        );
    }
    Ok(())
}

/// Copies a file, or the content of a folder, to `to`.
fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    if from.is_file() {
        let name = from.file_name().unwrap_or_default();
        return fs::write(to.join(name), fs::read(from)?);
    }
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        match entry.file_type()?.is_dir() {
            true => {
                let inside = to.join(entry.file_name());
                fs::create_dir(&inside)?;
                copy(&entry.path(), &inside)?;
            }
            false => copy(&entry.path(), to)?,
        }
    }
    Ok(())
}

/// Imports the lab's folder, writes the dataset and the map to `target`, and returns a summary.
fn imported(lab: &Path, map: Option<String>, target: &Path) -> Result<String, Box<dyn Error>> {
    let by = if map.is_some() {
        "by its map"
    } else {
        "by its draft"
    };
    let mut open = Vec::new();
    let text = match map {
        Some(map) => map,
        None => {
            let draft = MapDraft::of(lab)?;
            open = left_open(draft.text());
            filled(draft.text())
        }
    };
    fs::write(target.join("map.toml"), &text)?;
    let map = ImportMap::parse("map.toml".as_ref(), &text)?;
    let decoders = Decoders {
        ffmpeg: Some("ffmpeg".into()),
        ..Decoders::default()
    };
    let path = target.join("dataset");
    let threads = NonZeroUsize::new(2).unwrap_or(NonZeroUsize::MIN);
    ImportPlan::with_decoders(lab, &map, &decoders)?.run(&path, threads, &SilentProgress)?;
    let dataset = Dataset::open(&path)?;
    let table = dataset.table();
    let channels: Vec<String> = table
        .channels()
        .iter()
        .map(|channel| channel.name().to_owned())
        .collect();
    let mut parts = vec![format!("{} samples", table.rows())];
    if !channels.is_empty() {
        parts.push(channels.join(" "));
    }
    let frames = table.frames().iter().flatten().count();
    if frames > 0 {
        parts.push(format!("{frames} pictures"));
    }
    if let Some(signals) = &dataset.header().signals {
        parts.push(format!("{} numbers of taxels", signals.spec.info.len()));
    }
    let open = match open.is_empty() {
        true => String::new(),
        false => format!(" ({} left open)", open.join(" ")),
    };
    Ok(format!("{}, {by}{open}", parts.join(", ")))
}

/// Channels whose column the draft leaves open (`"?"`).
fn left_open(draft: &str) -> Vec<String> {
    let open = draft
        .lines()
        .filter(|line| line.contains("from = \"?\"") && !line.starts_with('#'));
    open.filter_map(|line| Some(line.split_once(" = ")?.0.to_owned()))
        .collect()
}

/// Draft with units and sensor model filled in, without the channels of [`left_open`].
fn filled(draft: &str) -> String {
    let line = |line: &str| {
        let unit = match line.as_bytes().first() {
            Some(b'F') => "N",
            Some(b'T') => "Nm",
            Some(b'P') => "mm",
            _ => "1",
        };
        let line = line.replace("unit = \"?\"", &format!("unit = {unit:?}"));
        match line.starts_with("model = ") {
            true => "model = \"a gel\"".to_owned(),
            false => line,
        }
    };
    // Channels with an open column are removed.
    let known = draft.lines().filter(|line| !line.contains("from = \"?\""));
    known.map(line).collect::<Vec<String>>().join("\n")
}

/// Beginning of a message, without the path of the lab's folder.
fn short(message: &str, lab: &Path) -> String {
    let message = message
        .replace(&format!("{}/", lab.display()), "")
        .replace(&lab.display().to_string(), "the folder");
    let message = message.replace('\n', " ").replace('|', "\\|");
    match message.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &message[..end]),
        None => message,
    }
}
