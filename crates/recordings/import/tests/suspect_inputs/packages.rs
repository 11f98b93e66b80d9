//! Tests of files of tactile packages whose content differs from what their names suggest.

use super::drafts::filled;
use super::{FACTS, NO_TIME, assert_near, case, draft, imported, lab, line, planned};
use taceva_import::MapDraft;

/// Copy of a data frame that pandas wrote, as `run.h5`.
fn data_frame(name: &str) -> tempfile::TempDir {
    let folder = lab(&[]);
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../formats/arrays/tests/data/pandas")
        .join(name);
    std::fs::copy(path, folder.path().join("run.h5")).expect("copied");
    folder
}

#[test]
fn a_data_frame_in_the_fixed_form_of_pandas_is_a_table_of_its_columns() {
    let folder = data_frame("mixed.h5");
    let draft = draft(folder.path());
    for line in ["Fx = { from = ", "Fz = { from = "] {
        assert!(draft.contains(line), "no `{line}` in\n{draft}");
    }
    let map = format!(
        "map_version = 2\ntable = {{ file = \"run.h5\", rows = \"/run\" }}\n[columns]\nFx = {{ from = \"Fx\", unit = \"N\" }}\nFz = {{ from = \"Fz\", unit = \"N\" }}\n\
         [attributes]\nobj = \"obj\"\n[time]\ncolumn = \"t\"\nunit = \"s\"\nclock = \"unix\"\n{FACTS}"
    );
    let expected: Vec<f64> = (0..24).map(|k| f64::from(k) * 0.25).collect();
    assert_eq!(imported(folder.path(), &map, "Fz"), expected);
    let times = imported(folder.path(), &map, "t_s");
    let expected: Vec<f64> = (0..24_u32)
        .map(|k| 1_700_000_000.0 + f64::from(k) * 0.033)
        .collect();
    for (found, expected) in times.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
    }
    // The index is a time if pandas marks it as one, in another unit and another group.
    let folder = data_frame("timed.h5");
    let map = format!(
        "map_version = 2\ntable = {{ file = \"run.h5\", rows = \"/run\" }}\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\ncolumn = \"index\"\nunit = \"s\"\n\
         clock = \"unix\"\n{FACTS}"
    );
    let times = imported(folder.path(), &map, "t_s");
    assert!(
        (times[23] - times[0] - 23.0 * 0.02).abs() < 1e-6,
        "{times:?}"
    );
}

#[test]
fn a_data_frame_that_pandas_stopped_to_write_is_refused_in_the_draft_and_by_the_map() {
    for (file, word) in [("cut.h5", "block 1 of 2"), ("levels.h5", "several levels")] {
        let folder = data_frame(file);
        let problem = MapDraft::of(folder.path()).expect_err(file).to_string();
        assert!(
            problem.contains(word) && problem.contains("run.h5"),
            "{problem}"
        );
        let group = if file == "cut.h5" { "/run" } else { "/f" };
        let map = format!(
            "map_version = 2\ntable = {{ file = \"run.h5\", rows = \"{group}\" }}\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}{FACTS}"
        );
        let problem = planned(folder.path(), &map).expect_err(file);
        assert!(problem.contains(word), "{problem}");
    }
}

#[test]
fn messages_with_arrays_within_them_are_taxels_and_those_with_summaries_alone_lead_to_the_call() {
    let folder = case("embedded-arrays");
    let found = draft(&folder);
    assert!(found.contains("from = \"taxels\""), "{found}");
    let summaries = MapDraft::of(&case("array-summaries"))
        .expect_err("no numbers")
        .to_string();
    for word in [
        "`taxels`",
        "shape of an array",
        "embed_payloads=True",
        "run.mcap",
    ] {
        assert!(summaries.contains(word), "no `{word}` in {summaries}");
    }
}

#[test]
fn a_folder_of_lerobot_whose_version_bears_a_name_is_read_and_the_length_of_a_vector_is_no_force() {
    let folder = case("lerobot-named-version");
    let draft = draft(&folder);
    assert!(
        draft.contains("format = \"lerobot\" }   # 24 rows"),
        "{draft}"
    );
    assert!(!draft.contains("\nFz = "), "{draft}");
    assert!(draft.contains("the length of a vector"), "{draft}");
    let map = format!(
        "map_version = 2\ntable = {{ file = \".\", format = \"lerobot\" }}\n[columns]\nFz = {{ from = \"observation.tactile[3]\", unit = \"N\" }}\n[time]\n\
         column = \"timestamp\"\nunit = \"s\"\nclock = \"monotonic\"\n{FACTS}"
    );
    let forces = imported(&folder, &map, "Fz");
    assert_eq!(forces.len(), 24);
    assert_eq!(forces[4].to_bits(), 6.0_f64.to_bits());
}

/// Table as `paxini-sdk` exports it: for each module, the resultant force and four taxels.
fn paxini(modules: &[&str]) -> String {
    let axes = ["X", "Y", "Z"];
    let columns = modules.iter().flat_map(|module| {
        let resultant = axes.map(|axis| format!("{module}-1x1-{axis}"));
        let taxels =
            (0..4).flat_map(move |at| axes.map(|axis| format!("{module}-NxN-{axis}[{at}]")));
        resultant.into_iter().chain(taxels)
    });
    let columns: Vec<String> = columns.collect();
    let rows = (0..8).map(|row| {
        let cells = (0..columns.len()).map(|at| (row * 7 + at * 5) % 23);
        let cells: Vec<String> = cells.map(|cell| cell.to_string()).collect();
        format!("03:21:2{row}.429,{}\n", cells.join(","))
    });
    format!(
        "Timestamp,{}\n{}",
        columns.join(","),
        rows.collect::<String>()
    )
}

#[test]
fn the_resultant_of_a_paxini_module_is_a_force_in_tenths_of_newtons_beside_its_taxels() {
    for (module, name) in [("1-2", "vendor.csv"), ("0-11", "glove/left.csv")] {
        let folder = lab(&[(name, &paxini(&[module]))]);
        let text = draft(folder.path());
        for (axis, channel) in [("X", "Fx"), ("Y", "Fy"), ("Z", "Fz")] {
            let expected = format!(
                "{channel} = {{ from = \"{module}-1x1-{axis}\", unit = \"N\", scale = 0.1 }}"
            );
            assert!(
                line(&text, &format!("{channel} = ")).starts_with(&expected),
                "{text}"
            );
        }
        let taxels = line(&text, "from = [");
        let first = format!("from = [\"{module}-NxN-X[0]\", \"{module}-NxN-Y[0]\"");
        assert!(
            taxels.starts_with(&first) && !taxels.contains("1x1"),
            "{text}"
        );
        assert!(
            line(&text, "places = ").starts_with("places = [2, 2]"),
            "{text}"
        );
        let forces = imported(folder.path(), &filled(&text), "Fz");
        assert_eq!(forces.len(), 8, "{text}");
        for (row, force) in (0..8_u32).zip(forces) {
            assert_near(force, 0.1 * f64::from((row * 7 + 2 * 5) % 23));
        }
    }
}

#[test]
fn two_paxini_modules_leave_the_forces_open_with_their_scale() {
    let folder = lab(&[("vendor.csv", &paxini(&["1-2", "1-3"]))]);
    let text = draft(folder.path());
    let force = line(&text, "Fz = ");
    assert!(
        force.starts_with("Fz = { from = \"?\", unit = \"N\", scale = 0.1 }"),
        "{text}"
    );
    assert!(
        force.contains("\"1-2-1x1-Z\"") && force.contains("\"1-3-1x1-Z\""),
        "{text}"
    );
    let other = line(&text, "# or: from = ");
    assert!(other.contains("1-3-NxN-X[0]"), "{text}");
}

/// NumPy file of three numbers.
fn three(numbers: [f64; 3]) -> Vec<u8> {
    let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (3,), }\n";
    let length = u16::try_from(header.len()).expect("short").to_le_bytes();
    let numbers = numbers.map(f64::to_le_bytes).concat();
    [
        b"\x93NUMPY\x01\x00",
        &length[..],
        header.as_bytes(),
        &numbers[..],
    ]
    .concat()
}

#[test]
fn fields_of_webdataset_are_all_behind_the_first_dot() {
    let folder = lab(&[]);
    let shard = std::fs::File::create(folder.path().join("s.tar")).expect("made");
    let mut shard = tar::Builder::new(shard);
    for press in 0..4_u32 {
        let force = f64::from(press);
        let meta = format!("{{\"object\": \"ball\", \"t_s\": {force}}}");
        let members = [
            ("fz.cls", press.to_string().into_bytes()),
            ("ft.npy", three([0.1, 0.25 * force, 0.5 * force])),
            ("meta.json", meta.into_bytes()),
            ("note.pyd", b"x".to_vec()),
        ];
        for (field, bytes) in members {
            let mut header = tar::Header::new_gnu();
            header.set_size(bytes.len() as u64);
            header.set_mode(0o644);
            let name = format!("press{press}.{field}");
            let added = shard.append_data(&mut header, name, &bytes[..]);
            added.expect("packed");
        }
    }
    shard.finish().expect("written");
    let text = draft(folder.path());
    for words in [
        "`.note.pyd` of its samples",
        "Fz = { from = \"ft.npy[2]\"",
        "column = \"meta.json/t_s\"",
        "object = \"meta.json/object\"",
    ] {
        assert!(text.contains(words), "no `{words}` in {text}");
    }
    let forces = imported(folder.path(), &filled(&text), "Fz");
    assert_eq!(forces, [0.0, 0.5, 1.0, 1.5]);
    let by_class = format!(
        "map_version = 2\ntable = \"s.tar\"\n[columns]\nFz = {{ from = \"fz.cls\", unit = \"N\" }}\n{NO_TIME}{FACTS}"
    );
    let forces = imported(folder.path(), &by_class, "Fz");
    assert_eq!(forces, [0.0, 1.0, 2.0, 3.0]);
}
