//! Printed text: names do not control a terminal, nothing is lost without a message, and errors name the command to type.

use std::fs;
use std::process::{Command, Stdio};

use crate::support::{Bench, MAP, leftovers};
use taceva_core::is_obeyed;
use taceva_needs::{Need, skip};

/// Name with characters that clear the screen, reverse the direction of text, or are invisible.
const HOSTILE: &str = "gel\u{1b}[2J\u{9b}3m\u{202e}\u{2066}\u{200b}\u{61c}7";
/// The text of [`HOSTILE`] in TOML, where controls must be escaped.
const HOSTILE_TOML: &str = "gel\\u001b[2J\\u009b3m\u{202e}\u{2066}\u{200b}\u{61c}7";

/// Test folder with a dataset `data`, whose sensor, samples and points have hostile names.
fn hostile() -> Bench {
    let bench = Bench::new();
    bench.lab();
    let labels = fs::read_to_string(bench.path("lab/labels.csv")).expect("there");
    let (head, rows) = labels.split_once('\n').expect("a header");
    let rows = rows
        .replace(",s", &format!(",{HOSTILE}s"))
        .replace(",p", &format!(",{HOSTILE}p"));
    bench.write("lab/labels.csv", &format!("{head}\n{rows}"));
    let map = MAP
        .replace("model = \"drawn\"", &format!("model = \"{HOSTILE_TOML}\""))
        .replace("gel = \"unknown\"", &format!("gel = \"{HOSTILE_TOML}\""));
    bench.write("map.toml", &map);
    bench.ok("import lab --map map.toml --out data -q");
    bench
}

fn assert_harmless(text: &str, whence: &str) {
    let obeyed = |letter: char| is_obeyed(letter) && !matches!(letter, '\n' | '\t');
    let found = text.chars().find(|letter| obeyed(*letter));
    assert_eq!(found, None, "{whence}:\n{}", text.escape_debug());
}

#[test]
fn no_name_of_cards_ids_points_or_files_reaches_a_terminal_raw_by_any_command() {
    let bench = hostile();
    bench.ok("fit data --model ridge --set size=8x8 --out m.taceva -q");
    bench.ok("predict data --with m.taceva --out p.csv --truth-out t.csv -q");
    for (name, extra) in [("a", ""), ("b", " --set strength=9")] {
        bench.ok(&format!(
            "evaluate data --model ridge --split by-point --set size=8x8{extra} --format json --out {name}.json --samples-out {name}.samples.csv -q"
        ));
    }
    bench.write(
        "limits.toml",
        &format!("limits_version = 1\nname = \"{HOSTILE_TOML}\"\n[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nat_most = 1.0\n"),
    );
    bench.write(
        "scene.toml",
        &format!("scene_version = 1\nname = \"{HOSTILE_TOML}\"\n"),
    );
    bench.write(
        "unknown.toml",
        &format!("map_version = 2\n\"{HOSTILE_TOML}\" = 1\n"),
    );
    let mut ran = 0;
    for words in [
        "import lab --map map.toml --explain",
        "import lab --map map.toml --out again",
        "import lab --map unknown.toml --out new",
        "check data",
        "check data --split by-column:X",
        "fit data --model ridge --set size=8x8 --out n.taceva -v",
        "evaluate data --model ridge --split by-point --set size=8x8 -v",
        "evaluate data --with m.taceva",
        "evaluate data --with m.taceva --explain",
        "evaluate data --model X",
        "evaluate data --model ridge --channels X",
        "evaluate data --model ridge --set X=1",
        "predict data --with m.taceva --out q.csv",
        "score --truth t.csv --pred p.csv",
        "score --truth t.csv --pred p.csv --explain",
        "score --truth t.csv --pred X",
        "score --truth t.csv --pred p.csv --units X",
        "merge X",
        "compare a.json b.json",
        "compare a.json X",
        "choose --results a.json --need repeatable",
        "choose --need X",
        "accept a.json --limits limits.toml",
        "accept a.json --limits X",
        "catalogue show X",
        "plan scene.toml",
        "plan X",
        "run scene.toml --out r",
        "plugin info X",
        "plugin list --plugin-dir X",
        "devices --X",
        "X",
    ] {
        for format in ["", "text", "md", "json", "tex"] {
            let mut command = bench.command("");
            let typed = words.split_whitespace();
            command.args(typed.map(|word| word.replace('X', HOSTILE)));
            if !format.is_empty() {
                command.args(["--format", format]);
            }
            let done = command.output().expect("the program starts");
            let whence = format!("taceva {words} --format {format}");
            assert_harmless(&String::from_utf8(done.stdout).expect("text"), &whence);
            assert_harmless(&String::from_utf8(done.stderr).expect("text"), &whence);
            ran += 1;
        }
    }
    assert_eq!(ran, 160);
}

#[test]
fn json_keeps_the_names_that_it_escapes() {
    let bench = hostile();
    let report = bench.json("evaluate data --model ridge --split by-point --set size=8x8");
    assert_eq!(report["subject"]["sensor"], HOSTILE);
}

#[test]
fn on_a_terminal_tables_for_programs_are_as_harmless_as_words() {
    let bench = hostile();
    let program = env!("CARGO_BIN_EXE_taceva");
    for words in [
        "check data --format csv -q",
        "evaluate data --model ridge --split by-point --set size=8x8 --format csv -q",
    ] {
        let typed = format!("'{program}' {words}");
        let done = Command::new("script")
            .current_dir(bench.path("."))
            .args(["-qec", &typed, "/dev/null"])
            .stdin(Stdio::null())
            .output();
        let done = match done {
            Ok(done) => done,
            Err(error) => return skip(Need::Terminal, format!("`script`: {error}")),
        };
        let shown = String::from_utf8_lossy(&done.stdout).replace('\r', "");
        assert!(shown.lines().count() > 1, "{shown}");
        assert_harmless(&shown, words);
    }
}

/// Runs the line in a shell, with `TACEVA` replaced by the path of the program.
fn by_shell(bench: &Bench, line: &str) -> (i32, String) {
    let line = line.replace("TACEVA", &format!("'{}'", env!("CARGO_BIN_EXE_taceva")));
    let mut shell = Command::new("sh");
    shell.current_dir(bench.path(".")).args(["-c", &line]);
    let done = shell.output().expect("a shell");
    let code = done.status.code().expect("not ended by a signal");
    (code, String::from_utf8_lossy(&done.stderr).into_owned())
}

#[test]
#[cfg(target_os = "linux")]
fn a_closed_or_full_standard_output_is_an_error_and_one_that_was_read_enough_is_none() {
    let bench = Bench::new();
    let (code, said) = by_shell(&bench, "TACEVA catalogue list >&-");
    assert_eq!(code, 3, "{said}");
    assert!(said.contains("standard output is closed"), "{said}");
    let (code, said) = by_shell(&bench, "TACEVA catalogue list >/dev/full");
    assert_eq!(code, 3, "{said}");
    assert!(said.contains("cannot write to standard output"), "{said}");
    let (code, said) = by_shell(&bench, "TACEVA catalogue list >/dev/null");
    assert_eq!((code, said.as_str()), (0, ""));
    let (code, said) = by_shell(
        &bench,
        "{ TACEVA catalogue list; echo $? >code; } | head -c 1 >/dev/null",
    );
    assert_eq!((code, said.as_str()), (0, ""));
    assert_eq!(
        fs::read_to_string(bench.path("code")).expect("written"),
        "0\n"
    );
}

#[test]
#[cfg(unix)]
fn a_limit_of_file_sizes_is_an_error_that_leaves_nothing_behind() {
    let bench = Bench::new();
    bench.lab();
    let (code, said) = by_shell(
        &bench,
        "ulimit -f 1; exec TACEVA import lab --map map.toml --out data -q",
    );
    assert_eq!(code, 3, "{said}");
    assert!(said.contains("too large"), "{said}");
    assert_eq!(
        leftovers(&bench.path("."), &["lab", "map.toml", "drawn"]),
        Vec::<String>::new()
    );
}

#[test]
fn tables_and_recordings_without_a_row_are_bad_input() {
    let bench = Bench::new();
    bench.lab();
    let labels = fs::read_to_string(bench.path("lab/labels.csv")).expect("there");
    let head = labels.lines().next().expect("a header").to_owned() + "\n";
    bench.write("lab/labels.csv", &head);
    bench.refused(
        "import lab --map map.toml --out new",
        3,
        "no row below the header",
    );
    bench.write("t.csv", "Fz\n");
    bench.write("p.csv", "Fz\n\n");
    bench.refused(
        "score --truth t.csv --pred p.csv",
        3,
        "t.csv: the table has no row below its header",
    );
    bench.record_nothing("empty");
    for words in [
        "check empty",
        "evaluate empty --model ridge",
        "fit empty --model ridge --out m",
    ] {
        bench.refused(words, 3, "empty: the dataset has 0 rows");
    }
}

#[test]
fn one_file_given_twice_is_said_to_be_one_file() {
    let bench = Bench::new();
    bench.lab();
    bench.write("t.csv", "Fz\n1\n2\n");
    bench.refused("score --truth t.csv --pred ./t.csv", 2, "are the same file");
    bench.ok("import lab --map map.toml --out data -q");
    bench.ok(
        "evaluate data --model ridge --split by-point --set size=8x8 --format json --out a.json -q",
    );
    bench.refused("compare a.json ./a.json", 2, "./a.json is named twice");
}

#[test]
fn a_number_too_large_to_be_summed_is_refused_with_table_line_and_column() {
    let bench = Bench::new();
    bench.write("t.csv", "Fz\n1\n2\n");
    bench.write("p.csv", "Fz\n1\n1e308\n");
    let said = "p.csv, line 3, column `Fz`: `1e308` is too large a number, expected a magnitude up to 2.247e307";
    bench.refused("score --truth t.csv --pred p.csv", 3, said);
    bench.write("p.csv", "Fz\n1\n-1e200\n");
    let scored = bench.json("score --truth t.csv --pred p.csv --metrics mae");
    assert_eq!(scored["metrics"]["mae"]["Fz"]["n_invalid"], 0);
}

#[test]
fn a_folder_that_is_no_dataset_is_answered_with_the_line_to_type() {
    let bench = Bench::new();
    bench.lab();
    bench.refused(
        "check lab",
        3,
        "write a map first: taceva init recording lab",
    );
    bench.write("old/targets.csv", "x\n");
    bench.refused(
        "evaluate old --model ridge",
        3,
        "taceva import old --preset bristol --out DATASET",
    );
    bench.refused("check nowhere", 3, "no such file or folder");
    fs::create_dir_all(bench.path("run")).expect("made");
    bench.write("run/plans.json", "{}");
    fs::create_dir_all(bench.path("run/recordings")).expect("made");
    fs::rename(bench.path("drawn"), bench.path("run/recordings/1-drawn")).expect("moved");
    bench.refused(
        "check run",
        3,
        "name one of its recordings: run/recordings/1-drawn",
    );
}

#[test]
fn a_final_model_learns_from_every_sample_and_is_not_tested_on_them() {
    let bench = Bench::imported();
    let said = bench.ok("fit data --model ridge --set size=8x8 --split all --out m.taceva -q");
    assert!(
        said.contains("split    all, seed 0: train 60, validation 0, test 0"),
        "{said}"
    );
    for words in [
        "evaluate data --with m.taceva",
        "evaluate data --model ridge --set size=8x8 --split all",
    ] {
        bench.refused(words, 2, "no test part is left");
    }
    let report = bench.json("evaluate data --with m.taceva --part train");
    let notes = report["provenance"]["notes"].to_string();
    assert!(notes.contains("these scores are not a test"), "{notes}");
}

#[test]
fn a_recording_of_two_samples_is_checked_but_for_what_needs_parts() {
    let bench = Bench::new();
    bench.lab();
    let labels = fs::read_to_string(bench.path("lab/labels.csv")).expect("there");
    let few: Vec<&str> = labels.lines().take(3).collect();
    bench.write("lab/labels.csv", &few.join("\n"));
    bench.ok("import lab --map map.toml --out two -q");
    let said = bench.ok("check two -q");
    assert!(
        said.contains("skipped  check:TAC007: the samples cannot be divided into parts"),
        "{said}"
    );
    assert!(said.contains("TAC012"), "{said}");
}

#[test]
fn a_column_that_judges_rows_and_is_not_mentioned_is_said_at_import() {
    let bench = Bench::new();
    bench.lab();
    let labels = fs::read_to_string(bench.path("lab/labels.csv")).expect("there");
    let wider = labels.lines().enumerate().map(|(line, text)| match line {
        0 => format!("{text},quality_flags,note\n"),
        _ => format!("{text},,x\n"),
    });
    bench.write("lab/labels.csv", &wider.collect::<String>());
    let said = bench.ok("import lab --map map.toml --out data -q");
    assert!(
        said.contains("columns that the map does not mention: note, quality_flags\n"),
        "{said}"
    );
    assert!(
        said.contains("warning  unmentioned-quality: `quality_flags`"),
        "{said}"
    );
    // The dataset stores the warning for those who did not see the import.
    let said = bench.ok("check data --only TAC014 -q");
    let line = r#"`[drop] column = "quality_flags", quality_flags = ["…"]`"#;
    assert!(
        said.contains("warning  TAC014 unmentioned-columns: `quality_flags`")
            && said.contains(line),
        "{said}"
    );
    let note = "note     TAC014 unmentioned-columns: columns of the table that no key of the map names: note\n";
    assert!(said.contains(note), "{said}");
    // With the map entry of the hint, bad rows are left out and the note disappears.
    let map = fs::read_to_string(bench.path("map.toml")).expect("there");
    assert!(!map.contains("[drop]"), "{map}");
    bench.write(
        "map.toml",
        &format!("{map}\n[drop]\ncolumn = \"quality_flags\"\nquality_flags = [\"bad\"]\n"),
    );
    bench.ok("import lab --map map.toml --out again -q");
    let said = bench.ok("check again --only TAC014 -q");
    assert!(!said.contains("warning  TAC014"), "{said}");
    assert!(said.contains(note), "{said}");
}
