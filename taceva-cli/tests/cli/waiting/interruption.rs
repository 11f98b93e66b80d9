//! Signals during the reading of large files. The reader does not check for signals, but the program ends.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::support::Bench;
use crate::support::emulated::Running;

/// Size of the table in bytes. A draft reads it once for each of its [`TABLES`] names, which takes much longer than the allowed time.
const BYTES: usize = 48 << 20;
/// Number of names of the same table, as many as a draft reads.
const TABLES: usize = 64;
/// Number of members of an archive, each of [`ROWS`] rows. Reading a JSON member takes seconds.
const MEMBERS: usize = 4;
const ROWS: usize = 500_000;
/// Time allowed between a signal and the end. The program allows itself one second.
const SOON: Duration = Duration::from_secs(10);

/// Names in `folder`, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("listed").flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Sends `signal`, and expects the end of the program soon, with the code of a stopped command.
fn stopped(running: Running, signal: &str) {
    let sent = Instant::now();
    running.signal(signal);
    let ran = running.ended();
    assert_eq!(ran.code, 5, "{signal}: {}", ran.err);
    assert!(ran.err.contains("stopped on request"), "{}", ran.err);
    assert!(sent.elapsed() < SOON, "{signal}: {:?}", sent.elapsed());
}

#[test]
fn a_signal_ends_a_draft_and_an_import_while_they_read_long_tables() {
    let bench = Bench::new();
    let row = "picture.png,1.250,0.031\n";
    let table = format!("frame,Fz_N,time_s\n{}", row.repeat(BYTES / row.len()));
    bench.write("lab/a0.csv", &table);
    let first = bench.path("lab/a0.csv");
    for number in 1..TABLES {
        // Tables whose names differ in a word are tables of their own.
        let letters = [number / 8, number % 8].map(|digit| char::from(b"abcdefgh"[digit]));
        let name = bench.path(&format!("lab/table_{}{}.csv", letters[0], letters[1]));
        fs::hard_link(&first, name).expect("linked");
    }
    bench.write(
        "map.toml",
        "map_version = 2\ntable = \"*.csv\"\n[columns]\nFz = { from = \"Fz_N\", unit = \"N\" }\n[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"gel\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n",
    );
    for signal in ["TERM", "INT"] {
        let running = Running::start(&bench, "import lab --draft --out draft.toml");
        std::thread::sleep(Duration::from_millis(700));
        stopped(running, signal);
    }
    let running = Running::start(&bench, "import lab --map map.toml --out set");
    std::thread::sleep(Duration::from_millis(700));
    stopped(running, "TERM");
    assert_eq!(names(&bench.path(".")), ["lab", "map.toml"]);
}

#[test]
fn a_signal_removes_what_a_draft_has_unpacked() {
    let bench = Bench::new();
    let row = "{\"frame\": \"picture.png\", \"Fz_N\": 1.25},\n";
    let table = format!(
        "[{}{{\"frame\": \"picture.png\", \"Fz_N\": 1}}]\n",
        row.repeat(ROWS)
    );
    let file = fs::File::create(bench.path("lab.tar")).expect("created");
    let mut archive = tar::Builder::new(file);
    for member in 0..MEMBERS {
        let mut header = tar::Header::new_gnu();
        header.set_size(table.len() as u64);
        header.set_mode(0o644);
        let letter = char::from(b"abcd"[member]);
        archive
            .append_data(
                &mut header,
                format!("lab/table_{letter}.json"),
                table.as_bytes(),
            )
            .expect("written");
    }
    archive.finish().expect("written");
    // A draft is unpacked beside its map.
    let is_unpacked = || {
        let names = names(&bench.path("."));
        names
            .iter()
            .any(|name| name.starts_with(".taceva-unpacked"))
    };
    let running = Running::start(&bench, "import lab.tar --draft --out draft.toml");
    let began = Instant::now();
    while !is_unpacked() {
        assert!(began.elapsed() < SOON, "nothing is unpacked");
        std::thread::sleep(Duration::from_millis(5));
    }
    stopped(running, "TERM");
    assert!(!is_unpacked(), "{:?}", names(&bench.path(".")));
    assert!(!bench.path("draft.toml").exists());
}
