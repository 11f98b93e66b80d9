//! Tests of hostile input of every form in an import. The input must be rejected with a message or read, in at most ten seconds and 512 MiB. No code of the
//! input may run, and no file may remain.

mod arrays;
mod crafted;

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crafted::bomb_of_parquet;
use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan};

/// Maximum time of an import. `MEMORY_KIB` is its maximum memory, KiB.
const TIME: Duration = Duration::from_secs(10);
const MEMORY_KIB: u64 = 512 << 10;

const FACTS: &str =
    "[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";
const NO_TIME: &str = "[time]\nclock = \"unknown\"\n";
const FORCE: &str = "[columns]\nFz = { from = \"value\", unit = \"N\" }\n";

fn lab(files: &[(&str, &[u8])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("inside")).expect("made");
        fs::write(path, bytes).expect("written");
    }
    folder
}

/// Peak memory of this process, KiB; 0 if the system does not report it.
fn most_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let number = line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok());
    number.unwrap_or(0)
}

/// Imports the folder by a map of version 2, within the limits of time and memory. The error is the message of a rejection.
#[track_caller]
fn imported(folder: &Path, map: &str) -> Result<Kept, String> {
    let began = Instant::now();
    let text = format!("map_version = 2\n{map}{FACTS}");
    let outcome = tried(folder, &text);
    let took = began.elapsed();
    assert!(took < TIME, "{took:?}");
    let memory = most_memory();
    assert!(memory < MEMORY_KIB, "{memory} KiB");
    if let Err(problem) = &outcome {
        assert!(!problem.contains("panicked"), "{problem}");
    }
    outcome
}

struct Kept {
    dataset: Dataset,
    words: String,
    _target: tempfile::TempDir,
}

fn tried(folder: &Path, text: &str) -> Result<Kept, String> {
    let said = |error: taceva_import::ImportError| error.to_string();
    let map = ImportMap::parse("map.toml".as_ref(), text).map_err(said)?;
    let plan = ImportPlan::new(folder, &map).map_err(said)?;
    let words = plan.summary().to_string();
    let target = tempfile::tempdir().expect("a folder");
    let path = target.path().join("dataset");
    let outcome = plan.run(&path, NonZeroUsize::MIN, &SilentProgress);
    if let Err(error) = outcome {
        let left = fs::read_dir(target.path()).expect("there").count();
        assert_eq!(left, 0, "{error}");
        return Err(error.to_string());
    }
    Ok(Kept {
        dataset: Dataset::open(&path).expect("a dataset"),
        words,
        _target: target,
    })
}

#[track_caller]
fn refused(folder: &Path, map: &str, words: &[&str]) {
    let Err(problem) = imported(folder, map) else {
        panic!("imported")
    };
    for word in words {
        assert!(problem.contains(word), "no `{word}` in {problem}");
    }
}

/// Path of a file in the workspace, given relative to the root of the workspace.
fn workspace(path: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../..")).join(path)
}

#[test]
fn bombs_of_parquet_are_refused_by_their_column() {
    let folder = tempfile::tempdir().expect("a folder");
    bomb_of_parquet(&folder.path().join("bomb.parquet"));
    assert!(
        fs::metadata(folder.path().join("bomb.parquet"))
            .expect("there")
            .len()
            < 1 << 20
    );
    let map = format!("table = \"bomb.parquet\"\n{FORCE}[attributes]\ntext = \"text\"\n{NO_TIME}");
    refused(folder.path(), &map, &["bomb.parquet", "text"]);
}

#[test]
fn json_of_any_depth_is_refused() {
    for text in ["[".repeat(4_000_000), "{\"a\":".repeat(1_000_000)] {
        let folder = lab(&[("deep.json", text.as_bytes())]);
        let map = format!(
            "table = {{ file = \"deep.json\", rows = \"/*\" }}\n[columns]\nFz = {{ from = \"/a\", unit = \"N\" }}\n{NO_TIME}"
        );
        refused(folder.path(), &map, &["deep.json"]);
    }
}

#[test]
fn a_frame_beyond_the_clip_names_its_row_and_how_many_there_are() {
    let clip = fs::read(workspace("tests/recordings/avi-mjpeg/ball_1.avi")).expect("readable");
    let folder = lab(&[
        ("clip.avi", &clip),
        ("labels.csv", b"k,value\n0,1\n9000,2\n"),
    ]);
    let map = format!(
        "table = \"labels.csv\"\n[frame]\nvideo = \"clip.avi\"\nindex = \"k\"\nchannel_order = \"rgb\"\nreference = \"unknown\"\n{FORCE}{NO_TIME}"
    );
    refused(
        folder.path(),
        &map,
        &["labels.csv, line 3, column `k`", "no frame 9000: there are"],
    );
}

#[test]
fn two_clocks_that_never_meet_leave_no_row_and_the_error_names_the_join() {
    let folder = lab(&[
        ("run.csv", b"t,value\n0.0,1\n0.1,2\n"),
        ("ft.csv", b"t,Fz\n1700000000.0,1\n1700000000.1,2\n"),
    ]);
    let map = |unmatched: &str| {
        format!(
            "table = \"run.csv\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = {{ column = \"t\", unit = \"s\" }}\ntolerance_ms = 5\nlag_ms = 0\n{unmatched}[columns]\nFz = {{ from = \"ft.Fz\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n"
        )
    };
    refused(folder.path(), &map(""), &["run.csv", "join `ft`"]);
    refused(
        folder.path(),
        &map("unmatched = \"drop\"\n"),
        &["all 2 rows are left out (join ft 2)"],
    );
}

#[test]
fn times_of_a_main_table_that_go_back_are_kept_and_joined_by_their_time() {
    let folder = lab(&[
        ("run.csv", b"t,value\n0.2,1\n0.1,2\n"),
        ("ft.csv", b"t,Fz\n0.1,5\n0.2,6\n"),
    ]);
    let map = "table = \"run.csv\"\n[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\ntime = { column = \"t\", unit = \"s\" }\ntolerance_ms = 5\nlag_ms = 0\n[columns]\nFz = { from = \"ft.Fz\", unit = \"N\" }\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n";
    let kept = imported(folder.path(), map).unwrap_or_else(|problem| panic!("{problem}"));
    assert_eq!(kept.dataset.table().truth(0).get(0), Some(6.0));
}

#[test]
#[cfg(unix)]
fn a_pattern_that_matches_nothing_or_one_file_twice_is_refused() {
    let folder = lab(&[("a.csv", b"value\n1\n")]);
    std::os::unix::fs::symlink(folder.path().join("a.csv"), folder.path().join("b.csv"))
        .expect("linked");
    let map = |table: &str| format!("table = \"{table}\"\n{FORCE}{NO_TIME}");
    refused(
        folder.path(),
        &map("c*.csv"),
        &["c*.csv", "matches no file in"],
    );
    refused(
        folder.path(),
        &map("*.csv"),
        &["matches one file twice", "a.csv", "b.csv"],
    );
    assert!(imported(folder.path(), &map("a*.csv")).is_ok());
}

#[test]
fn names_in_any_script_are_files_columns_and_labels() {
    let text = "الصورة,قوة,材料\nصورة ١.png,1,凝膠 🫧\né́.png,2,ジェル\n";
    let picture = {
        let mut bytes = Vec::new();
        image::GrayImage::from_pixel(8, 8, image::Luma([90]))
            .write_to(
                &mut std::io::Cursor::new(&mut bytes),
                image::ImageFormat::Png,
            )
            .expect("written");
        bytes
    };
    let folder = lab(&[
        ("שולחן/labels.csv", text.as_bytes()),
        ("שולחן/صورة ١.png", &picture),
        ("שולחן/é́.png", &picture),
    ]);
    let map = format!(
        "table = \"*/labels.csv\"\n[path]\npattern = \"{{object}}/labels.csv\"\n[frame]\ncolumn = \"الصورة\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"قوة\", unit = \"N\" }}\n[attributes]\nmaterial = \"材料\"\nobject = \"path.object\"\n{NO_TIME}"
    );
    let kept = imported(folder.path(), &map).unwrap_or_else(|problem| panic!("{problem}"));
    let column = |name: &str| kept.dataset.table().as_text(name).expect("there");
    assert_eq!(column("material")[0].as_deref(), Some("凝膠 🫧"));
    assert_eq!(column("object")[1].as_deref(), Some("שולחן"));
    assert_eq!(
        column("source_frame")[0].as_deref(),
        Some("שולחן/صورة ١.png")
    );
}

/// The number of files is below a million, to keep the test short.
#[test]
#[expect(clippy::print_stdout, reason = "the time is the result")]
fn thousands_of_files_that_no_row_names_are_counted_in_time() {
    const FOLDERS: usize = 40;
    const EACH: usize = 1_000;
    let folder = lab(&[("labels.csv", b"file,value\n0/0.png,1\n")]);
    for place in 0..FOLDERS {
        let inside = folder.path().join(place.to_string());
        fs::create_dir(&inside).expect("made");
        for file in 0..EACH {
            fs::write(inside.join(format!("{file}.png")), []).expect("written");
        }
    }
    image::GrayImage::from_pixel(8, 8, image::Luma([90]))
        .save(folder.path().join("0/0.png"))
        .expect("saved");
    let map = format!(
        "table = \"labels.csv\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n{FORCE}{NO_TIME}"
    );
    let began = Instant::now();
    let kept = imported(folder.path(), &map).unwrap_or_else(|problem| panic!("{problem}"));
    println!("{} files in {:?}", FOLDERS * EACH, began.elapsed());
    assert_eq!(
        kept.dataset.header().left_out.images,
        (FOLDERS * EACH - 1) as u64
    );
    assert!(
        kept.words.contains("images that no row names: 39999"),
        "{}",
        kept.words
    );
}

#[test]
fn an_mcap_without_an_index_is_read_by_its_records() {
    let file = fs::read(workspace(
        "crates/formats/tables/tests/data/mcap/no_index.mcap",
    ))
    .expect("there");
    let folder = lab(&[("run.mcap", &file)]);
    let map = format!("table = {{ file = \"run.mcap\", rows = \"/none\" }}\n{FORCE}{NO_TIME}");
    // Topics are found although no index lists them.
    refused(folder.path(), &map, &["run.mcap", "/none"]);
}

#[test]
fn a_cell_that_is_no_picture_names_its_table_once() {
    let table = workspace("crates/formats/tables/tests/data/plain/none-1.parquet");
    let folder = lab(&[("run.parquet", &fs::read(table).expect("readable"))]);
    let map = format!(
        "table = \"run.parquet\"\n[frame]\nbytes = \"raw\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"row\", unit = \"N\" }}\n{NO_TIME}"
    );
    let Err(problem) = imported(folder.path(), &map) else {
        panic!("imported")
    };
    assert_eq!(problem.matches("run.parquet").count(), 1, "{problem}");
    assert!(problem.contains("row 0"), "{problem}");
}

#[test]
fn a_join_without_any_match_or_with_several_names_its_row() {
    let folder = lab(&[
        ("run.csv", b"k,value\n1,1\n"),
        ("none.csv", b"k,Fz\n2,1\n"),
        ("twice.csv", b"k,Fz\n1,1\n1,2\n"),
    ]);
    let map = |table: &str| {
        format!(
            "table = \"run.csv\"\n[[join]]\nname = \"ft\"\ntable = \"{table}\"\non = {{ k = \"k\" }}\n[columns]\nFz = {{ from = \"ft.Fz\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    refused(
        folder.path(),
        &map("none.csv"),
        &["run.csv, line 2", "no row of"],
    );
    refused(
        folder.path(),
        &map("twice.csv"),
        &["run.csv, line 2", "two rows of join `ft` match it"],
    );
}

#[test]
fn clips_whose_index_is_cut_or_changed_are_refused_or_read() {
    let whole = fs::read(workspace("tests/recordings/avi-mjpeg/ball_1.avi")).expect("readable");
    let map = format!(
        "table = \"labels.csv\"\n[frame]\nvideo = \"clip.avi\"\nchannel_order = \"rgb\"\nreference = \"unknown\"\n{FORCE}{NO_TIME}"
    );
    let index = whole
        .windows(4)
        .rposition(|bytes| bytes == b"idx1")
        .expect("an index");
    for (place, byte) in [
        (index + 4, 0xff),
        (index + 16, 0xff),
        (index + 20, 0x7f),
        (index, 0),
    ] {
        let mut bytes = whole.clone();
        bytes[place] = byte;
        let folder = lab(&[("clip.avi", &bytes), ("labels.csv", b"value\n1\n2\n")]);
        drop(imported(folder.path(), &map));
    }
    let folder = lab(&[
        ("clip.avi", &whole[..index + 6]),
        ("labels.csv", b"value\n1\n"),
    ]);
    refused(folder.path(), &map, &["clip.avi"]);
}

#[test]
fn messages_with_the_schema_of_another_message_are_refused_by_their_topic() {
    let whole = fs::read(workspace("tests/recordings/mcap-none/run.mcap")).expect("readable");
    let map = fs::read_to_string(workspace("tests/recordings/mcap-none/map.toml")).expect("there");
    let map = map.replace("map_version = 2", "");
    let map = map.split("[sensor]").next().expect("the rest");
    // One changed letter of the schema turns the forces into positions.
    let place = whole
        .windows(13)
        .position(|bytes| bytes == b"float64 x\nflo");
    let mut bytes = whole.clone();
    if let Some(place) = place {
        bytes[place..place + 7].copy_from_slice(b"float32");
    }
    let folder = lab(&[("run.mcap", &bytes)]);
    let outcome = imported(folder.path(), map);
    assert!(place.is_none() || outcome.is_err(), "{:?}", place);
}
