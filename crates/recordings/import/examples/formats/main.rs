//! Outcomes of files that other packages wrote, as rows of the table in `docs/your-recording.md`.
//!
//! ```text
//! cargo run -p taceva-import --example formats -- FOLDER [DATASETS]
//! ```
//!
//! With DATASETS each dataset is kept there with the map it was made by, for `tests/formats/compare.py`, which reads the files again by the packages.
//! `packages.json` says which file or folder of FOLDER which package wrote. Each is imported by its map beside this file, or else by a fresh draft whose
//! units are filled in as a lab would: N, Nm and mm. Clips need ffmpeg on the PATH.

#![expect(clippy::print_stdout, reason = "a program says what it found")]

use std::error::Error;
use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use serde::Deserialize;
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{Decoders, ImportMap, ImportPlan, MapDraft};

/// A file or folder and the package that wrote it.
#[derive(Deserialize)]
struct Written {
    path: String,
    package: String,
    version: String,
    /// The file beside this one that maps it, where a draft cannot know what the package's documents say.
    #[serde(default)]
    map: Option<String>,
}

/// The most letters of a refusal that a row shows.
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

/// Copies a file into `to`, or all that lies in a folder.
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

/// The counts of a dataset that was made of the lab's folder; it and its map are put into `target`.
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

/// Channels of a draft whose column a lab is asked for.
fn left_open(draft: &str) -> Vec<String> {
    let open = draft
        .lines()
        .filter(|line| line.contains("from = \"?\"") && !line.starts_with('#'));
    open.filter_map(|line| Some(line.split_once(" = ")?.0.to_owned()))
        .collect()
}

/// A draft with what only a lab knows.
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
    // Of a channel whose column is not known there is nothing to fill in.
    let known = draft.lines().filter(|line| !line.contains("from = \"?\""));
    known.map(line).collect::<Vec<String>>().join("\n")
}

/// The beginning of a message, without the folder that nobody else has.
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
