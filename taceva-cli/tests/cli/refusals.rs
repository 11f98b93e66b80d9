//! Invalid arguments and files: an exit code, one line with the place, and nothing written.

use crate::support::{Bench, MAP, leftovers, of_format};

#[test]
fn arguments_that_cannot_be_meant_are_usage_errors() {
    let bench = Bench::imported();
    for (words, message) in [
        ("evaluate data --model rigde", "did you mean `ridge`?"),
        (
            "evaluate data --model ridge --set sise=8",
            "did you mean `size`?",
        ),
        ("evaluate data --model ridge --set size=0", "size=0"),
        (
            "evaluate data --model cnn --set device=gpu",
            "expected cpu, cuda or wgpu",
        ),
        #[cfg(not(feature = "cuda"))]
        (
            "evaluate data --model cnn --set device=cuda",
            "build it with `--features cuda`",
        ),
        (
            "evaluate data --model ridge --metrics smap",
            "did you mean `smape`?",
        ),
        ("evaluate data --model ridge --split randon", "randon"),
        (
            "evaluate data --model ridge --channels Fq",
            "the dataset has Px, Fz",
        ),
        ("check data --only TAC999", "unknown check `TAC999`"),
        (
            "score --truth map.toml --pred map.toml --units Fz",
            "expected NAME=UNIT",
        ),
        (
            "import lab --preset bristle --out x",
            "expected one of bristol, py3dcal",
        ),
    ] {
        bench.refused(words, 2, message);
    }
}

#[test]
fn a_map_with_an_unknown_key_names_the_nearest_and_the_line() {
    let bench = Bench::imported();
    bench.write("bad.toml", &MAP.replace("channel_order", "chanel_order"));
    bench.refused("import lab --map bad.toml --out new", 3, "channel_order");
    bench.refused("import lab --map bad.toml --out new", 3, "line 6");
}

#[test]
fn a_row_whose_image_is_absent_names_file_line_and_column() {
    let bench = Bench::imported();
    std::fs::remove_file(bench.path("lab/pictures/03.png")).expect("there");
    bench.refused(
        "import lab --map map.toml --out new",
        3,
        "line 5, column `file`",
    );
    assert_eq!(
        leftovers(&bench.path("."), &["lab", "map.toml", "drawn", "data"]),
        Vec::<String>::new()
    );
}

#[test]
fn a_label_that_is_no_number_names_file_line_and_column() {
    let bench = Bench::imported();
    let labels = std::fs::read_to_string(bench.path("lab/labels.csv")).expect("there");
    for wrong in ["NaN", "inf", "1e400", "abc"] {
        bench.write(
            "lab/labels.csv",
            &labels.replacen("0.2,p0", &format!("{wrong},p0"), 1),
        );
        bench.refused(
            "import lab --map map.toml --out new",
            3,
            "labels.csv, line 2, column `force_N`",
        );
    }
}

#[test]
fn labels_a_thousand_times_too_large_are_a_warning_with_a_code() {
    let bench = Bench::new();
    bench.lab();
    bench.write(
        "map.toml",
        &MAP.replace("unit = \"N\"", "unit = \"kN\", scale = 1"),
    );
    let out = bench.ok("import lab --map map.toml --out data -q");
    assert!(out.contains("warning  magnitude-large"), "{out}");
    let out = bench.ok("check data --only TAC001 -q");
    assert!(out.contains("warning  TAC001 units-by-magnitude"), "{out}");
}

#[test]
fn a_model_applied_to_frames_of_another_size_is_refused() {
    let bench = Bench::imported();
    bench.record("large", 40);
    bench.ok("fit data --model ridge --out model -q");
    bench.refused("evaluate large --with model", 3, "32×32 gray8");
    bench.refused("evaluate large --with model", 3, "model model on large: ");
    bench.refused(
        "predict large --with model --out pred.csv",
        3,
        "40×40 gray8",
    );
    assert!(!bench.path("pred.csv").exists());
}

#[test]
fn tables_of_different_length_or_ids_are_refused() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,Fz\na,1\nb,2\n");
    bench.write("short.csv", "Fz\n1\n");
    bench.refused(
        "score --truth truth.csv --pred short.csv",
        3,
        "short.csv: 1 row, but truth.csv has 2",
    );
    bench.write("other.csv", "id,Fz\na,1\nc,2\n");
    bench.refused(
        "score --truth truth.csv --pred other.csv",
        3,
        "other.csv: no row with id `b`, although truth.csv has such a row",
    );
    bench.write("twice.csv", "id,Fz\na,1\na,2\n");
    bench.refused(
        "score --truth truth.csv --pred twice.csv",
        3,
        "twice.csv: id `a` occurs twice",
    );
    bench.refused(
        "score --truth twice.csv --pred truth.csv",
        3,
        "twice.csv: id `a` occurs twice",
    );
    bench.write("more.csv", "id,Fz\na,1\nb,2\nc,3\n");
    bench.refused(
        "score --truth truth.csv --pred more.csv",
        3,
        "truth.csv: no row with id `c`",
    );
}

#[test]
fn tables_of_different_channels_are_refused() {
    let bench = Bench::new();
    bench.write("truth.csv", "Fx,Fz\n1,1\n2,2\n");
    bench.write("pred.csv", "Fz\n1\n2\n");
    bench.refused(
        "score --truth truth.csv --pred pred.csv",
        3,
        "no column `Fx`, although truth.csv has it",
    );
    bench.refused("score --truth pred.csv --pred truth.csv", 3, "Fx");
    bench.write("none.csv", "id,point_id\n1,1\n");
    bench.write("none-too.csv", "id,point_id\n1,1\n");
    bench.refused(
        "score --truth none.csv --pred none-too.csv",
        3,
        "no column is a channel",
    );
}

#[test]
fn invalid_cells_are_refused_by_name_and_counted_on_request() {
    let bench = Bench::new();
    bench.write("truth.csv", "Fz,point_id\n1,a\n2,b\n3,c\n4,d\n5,e\n6,f\n");
    bench.write("pred.csv", "Fz\n1\nnan\n3\n-inf\nx\n7\n");
    bench.refused(
        "score --truth truth.csv --pred pred.csv",
        3,
        "pred.csv, line 3, column `Fz`: `nan`",
    );
    let report =
        bench.json("score --truth truth.csv --pred pred.csv --metrics mae --allow-invalid");
    let mae = &report["metrics"]["mae"]["Fz"];
    assert_eq!(
        (mae["n"].as_u64(), mae["n_invalid"].as_u64()),
        (Some(3), Some(3))
    );
    assert_eq!(
        mae["value"].as_f64().map(f64::to_bits),
        Some((1.0_f64 / 3.0).to_bits())
    );
    assert_eq!(mae["ci95"]["undefined"], "3 clusters, 5 are needed");
}

#[test]
fn rows_are_matched_by_id_whatever_their_order() {
    let bench = Bench::new();
    bench.write("truth.csv", "id,Fz,point_id\na,1,p\nb,2,q\nc,4,r\n");
    bench.write("pred.csv", "id,Fz\nc,4.5\na,1\nb,2\n");
    let report = bench.json("score --truth truth.csv --pred pred.csv --metrics mae");
    assert_eq!(
        report["metrics"]["mae"]["Fz"]["value"]
            .as_f64()
            .map(f64::to_bits),
        Some((0.5_f64 / 3.0).to_bits())
    );
}

#[test]
fn samples_without_points_get_no_interval_rather_than_a_narrow_one() {
    let bench = Bench::new();
    let rows: String = (0..50).map(|row| format!("{row}\n")).collect();
    bench.write("truth.csv", &format!("Fz\n{rows}"));
    bench.write("pred.csv", &format!("Fz\n{rows}"));
    let report = bench.json("score --truth truth.csv --pred pred.csv --metrics mae,r2");
    assert_eq!(
        report["metrics"]["mae"]["Fz"]["ci95"]["undefined"],
        "samples without point_id"
    );
    assert_eq!(report["metrics"]["r2"]["Fz"]["value"], 1.0);
}

#[test]
fn a_folder_that_is_no_dataset_or_a_newer_one_is_refused() {
    let bench = Bench::imported();
    bench.refused("evaluate lab --model ridge", 3, "lab is not a dataset");
    bench.refused("check nowhere", 3, "nowhere is not a dataset");
    let header = std::fs::read_to_string(bench.path("data/dataset.toml")).expect("there");
    bench.write("data/dataset.toml", &of_format(&header, "2.0"));
    bench.refused(
        "evaluate data --model ridge",
        3,
        "format 2.0 needs a newer TacEva",
    );
}

#[test]
fn a_model_file_that_is_none_is_refused() {
    let bench = Bench::imported();
    bench.refused("evaluate data --with map.toml", 3, "map.toml");
    bench.refused("evaluate data --with absent", 3, "absent");
    bench.refused("evaluate data --with lab", 3, "lab");
}

#[test]
fn a_damaged_frame_is_named_before_any_number() {
    let bench = Bench::imported();
    let path = bench.path("data/frames/0000/000007.png");
    let mut bytes = std::fs::read(&path).expect("there");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).expect("written");
    bench.refused(
        "evaluate data --model ridge",
        3,
        "000007.png: damaged: expected sha256:",
    );
}

#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_any_file_is_refused_and_not_waited_for() {
    let bench = Bench::imported();
    let pipe = std::process::Command::new("mkfifo")
        .arg(bench.path("pipe"))
        .status();
    assert!(pipe.is_ok_and(|status| status.success()), "mkfifo is there");
    bench.refused("evaluate data --with pipe", 3, "not a regular file");
    bench.refused("import lab --map pipe --out new", 3, "pipe");
    bench.write("truth.csv", "Fz\n1\n");
    bench.refused("score --truth pipe --pred truth.csv", 3, "pipe");
    bench.refused("score --truth truth.csv --pred pipe", 3, "pipe");
    bench.refused("check pipe", 3, "pipe is not a dataset");
}

#[test]
fn the_first_bad_cell_is_the_same_for_any_number_of_jobs() {
    let bench = Bench::new();
    let rows = |bad: [usize; 2]| -> String {
        let cell = |row| {
            if bad.contains(&row) {
                "x".to_owned()
            } else {
                row.to_string()
            }
        };
        (0..30_000)
            .map(|row| format!("{},{}\n", row, cell(row)))
            .collect()
    };
    let table = format!("Fx,Fz\n{}", rows([25_000, 9_000]));
    bench.write("truth.csv", &table);
    bench.write("pred.csv", &table);
    for jobs in 1..=3 {
        bench.refused(
            &format!("score --truth truth.csv --pred pred.csv --jobs {jobs}"),
            3,
            "line 9002, column `Fz`",
        );
    }
}

#[cfg(unix)]
#[test]
fn a_signal_ends_an_import_with_its_own_code_and_leaves_nothing() {
    use std::os::unix::process::ExitStatusExt as _;
    let bench = Bench::imported();
    let mut seen = std::collections::BTreeSet::new();
    for wait_ms in [1, 3, 10, 30] {
        let mut child = bench
            .command("import lab --map map.toml --out new --jobs 1 -q")
            .spawn()
            .expect("starts");
        std::thread::sleep(std::time::Duration::from_millis(wait_ms));
        let kill = std::process::Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status();
        assert!(kill.is_ok(), "kill is there");
        let status = child.wait().expect("ended");
        // Before the handler is set, a signal ends the program as by default. After the last frame it comes too late.
        assert!(
            matches!(status.code(), Some(0 | 5)) || status.signal() == Some(2),
            "{status}"
        );
        seen.insert(status.code());
        if bench.path("new").exists() {
            bench.ok("check new -q");
            std::fs::remove_dir_all(bench.path("new")).expect("removed");
        } else if status.code() == Some(5) {
            assert_eq!(
                leftovers(&bench.path("."), &["lab", "map.toml", "drawn", "data"]),
                Vec::<String>::new()
            );
        }
    }
    assert!(!seen.is_empty());
}

#[test]
fn a_recording_without_labels_is_answered_with_the_section_that_names_them() {
    let bench = Bench::new();
    bench.lab();
    let (before, rest) = MAP.split_once("[columns]").expect("there");
    let (_, after) = rest.split_once("[ids]").expect("there");
    bench.write("bare.toml", &format!("{before}[ids]{after}"));
    bench.ok("import lab --map bare.toml --out bare -q");
    bench.refused(
        "evaluate bare --model ridge",
        2,
        "no channel to predict: import it again with a map that names labels under [columns]",
    );
}
