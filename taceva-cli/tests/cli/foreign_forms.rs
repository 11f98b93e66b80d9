//! Recordings of external libraries through the program: drafts of maps, clips, and missing decoders.

use std::path::{Path, PathBuf};

use crate::support::Bench;

/// Test folder with a copy of the repository's recording `name` in `lab`, and its map `map.toml`.
fn bench(name: &str) -> Bench {
    let bench = Bench::new();
    let own = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../tests/recordings")
        .join(name);
    copy(&own, &bench.path("lab"));
    std::fs::rename(bench.path("lab/map.toml"), bench.path("map.toml")).expect("its map");
    std::fs::remove_file(bench.path("lab/expected.json")).expect("it was there");
    bench
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("made");
    for entry in std::fs::read_dir(from).expect("a folder").flatten() {
        let target: PathBuf = to.join(entry.file_name());
        match entry.file_type().expect("known").is_dir() {
            true => copy(&entry.path(), &target),
            false => drop(std::fs::copy(entry.path(), target).expect("copied")),
        }
    }
}

#[test]
fn a_draft_is_refused_by_the_line_of_its_first_open_unit_and_imports_once_they_are_filled_in() {
    let bench = bench("hdf5-groups");
    let draft = bench.ok("import --draft lab --out draft.toml");
    assert!(draft.is_empty(), "{draft}");
    bench.refused(
        "import lab --map draft.toml --out data",
        3,
        "`?` is a unit that a draft leaves open",
    );
    let text = std::fs::read_to_string(bench.path("draft.toml")).expect("written");
    let units = text.lines().map(|line| {
        let unit = if line.starts_with('T') {
            "\"Nm\""
        } else {
            "\"N\""
        };
        line.replace("unit = \"?\"", &format!("unit = {unit}"))
            .replace("model = \"?\"", "model = \"my gel\"")
    });
    let filled: Vec<String> = units.collect();
    bench.write("filled.toml", &filled.join("\n"));
    let done = bench.ok("import lab --map filled.toml --out data");
    assert!(done.contains("rows     24 read, 24 kept"), "{done}");
    // Without `--out` the draft goes to standard output. An existing file is not overwritten.
    assert_eq!(bench.ok("import --draft lab"), text);
    bench.refused("import --draft lab --out draft.toml", 3, "exists already");
}

#[test]
fn a_folder_without_any_table_or_picture_has_no_draft() {
    let bench = Bench::new();
    bench.write("lab/notes.txt", "pressed on Monday");
    bench.refused(
        "import --draft lab",
        3,
        "it contains no table and no picture",
    );
    bench.write("lab/run.bag", "#ROSBAG V2.0");
    bench.refused("import --draft lab", 3, "cut short");
}

#[test]
#[cfg(target_os = "linux")]
fn av1_is_decoded_where_no_other_program_is() {
    let bench = bench("mp4-av1");
    let done = bench
        .command("import lab --map map.toml --out data")
        .env("PATH", "")
        .output();
    let done = done.expect("it starts");
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    assert!(String::from_utf8_lossy(&done.stdout).contains("12 read, 12 kept"));
}

#[test]
fn a_clip_that_nothing_at_hand_decodes_names_its_codec_and_what_mends_it() {
    let bench = bench("mkv-ffv1");
    let mut command = bench.command("import lab --map map.toml --out data");
    let refused = command
        .env("PATH", "")
        .env_remove("TACEVA_FFMPEG")
        .output()
        .expect("it starts");
    let message = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(3), "{message}");
    for word in [
        "FFV1",
        "--ffmpeg PROGRAM",
        "TACEVA_FFMPEG",
        "pip install imageio-ffmpeg",
    ] {
        assert!(message.contains(word), "no `{word}` in {message}");
    }
    assert!(!bench.path("data").exists());
    let absent = bench.run("import lab --map map.toml --out data --ffmpeg no/such/program");
    assert_eq!(absent.code, 2, "{}", absent.err);
    assert!(absent.err.contains("no/such/program"), "{}", absent.err);
}

#[test]
fn workbooks_and_packed_recordings_name_the_command_that_converts_them() {
    let bench = Bench::new();
    let rest = "[time]\nclock = \"unknown\"\n[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";
    for (table, command) in [
        (
            "labels.xlsx",
            "libreoffice --headless --convert-to csv labels.xlsx",
        ),
        ("run.db3.zstd", "zstd -d run.db3.zstd -o run.db3"),
        ("run.mcap.zst", "zstd -d run.mcap.zst -o run.mcap"),
    ] {
        bench.write(&format!("lab/{table}"), "x");
        bench.write(
            "map.toml",
            &format!("map_version = 2\ntable = \"{table}\"\n{rest}"),
        );
        bench.refused("import lab --map map.toml --out data", 3, command);
        bench.refused(
            "import lab --map map.toml --out data",
            3,
            "map.toml, line 2",
        );
    }
}

#[test]
fn a_draft_does_not_take_the_place_of_a_file_of_the_lab() {
    let bench = Bench::new();
    bench.write("lab/labels.csv", "Fz\n1\n2\n");
    bench.refused(
        "import --draft lab --out lab/labels.csv --force",
        2,
        "is not a map",
    );
    assert_eq!(
        std::fs::read_to_string(bench.path("lab/labels.csv")).expect("there"),
        "Fz\n1\n2\n"
    );
    bench.ok("import --draft lab --out map.toml");
    bench.ok("import --draft lab --out map.toml --force");
}

#[test]
fn presets_are_listed_written_and_named_where_a_folder_does_not_fit() {
    let bench = Bench::new();
    let list = bench.ok("import --presets");
    for part in [
        "bristol                 targets.csv",
        "diffusion-zarr",
        "leaves open: ",
        "--print",
    ] {
        assert!(list.contains(part), "{list}");
    }
    assert!(
        list.lines().all(|line| line.chars().count() <= 110),
        "{list}"
    );
    let json: serde_json::Value =
        serde_json::from_str(&bench.ok("import --presets --format json")).expect("JSON");
    assert_eq!(json["schema"], "taceva.presets/1");
    assert_eq!(json["presets"].as_array().map(Vec::len), Some(22));
    bench.write(
        "poses/targets.csv",
        "sensor_image,pose_x,pose_y\nimage_1.png,1.5,2\n",
    );
    bench.write("poses/images/readme.txt", "x");
    let map = bench.ok("import poses --preset bristol --print");
    assert!(
        map.contains("Px = { from = \"pose_x\", unit = \"mm\" }"),
        "{map}"
    );
    bench.ok("import poses --preset bristol --print --out map.toml");
    let written = std::fs::read_to_string(bench.path("map.toml")).expect("written");
    assert_eq!(written, map);
    bench.refused(
        "import poses --preset poseit --explain",
        3,
        "--preset bristol",
    );
    bench.refused("import --presets poses", 2, "cannot be used");
    bench.refused("import poses --print --map map.toml", 2, "cannot be used");
}

#[test]
fn an_archive_is_imported_as_the_folder_that_it_holds_and_leaves_nothing() {
    let bench = Bench::new();
    let mut tar = tar::Builder::new(Vec::new());
    for (name, text) in [("run/labels.csv", "Fz\n1.5\n2.5\n"), ("run/note.txt", "x")] {
        let mut about = tar::Header::new_ustar();
        about.set_size(text.len() as u64);
        about.set_mode(0o644);
        tar.append_data(&mut about, name, text.as_bytes())
            .expect("packed");
    }
    std::fs::write(bench.path("run.tar"), tar.into_inner().expect("packed")).expect("written");
    let rest = "[time]\nclock = \"unknown\"\n[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";
    bench.write(
        "map.toml",
        &format!("map_version = 2\ntable = \"labels.csv\"\n{rest}"),
    );
    let done = bench.ok("import run.tar --map map.toml --out data");
    assert!(done.contains("wrote"), "{done}");
    let names = std::fs::read_dir(bench.path("")).expect("there").flatten();
    let hidden = names.filter(|entry| entry.file_name().to_string_lossy().contains("unpacked"));
    assert_eq!(hidden.count(), 0);
    assert!(bench.ok("import --draft run.tar").contains("from = \"Fz\""));
}
