//! Tests of taxels: codes for nothing, names and positions of columns.

use super::{FACTS, NO_TIME, case, codes, draft, lab, line, map_of, planned, summary};

#[test]
fn a_code_of_a_taxel_for_nothing_measured_leaves_its_rows_out_and_is_drafted() {
    let folder = case("taxel-code-for-nothing");
    let map = map_of("taxel-code-for-nothing");
    assert_eq!(summary(&folder, &map).rows_kept, 120);
    let coded = map.replace("unit = \"count\"", "unit = \"count\"\nplaceholders = [-1]");
    let found = summary(&folder, &coded);
    assert_eq!(found.rows_kept, 102);
    assert_eq!(found.dropped.get("placeholders of [signals]"), Some(&18));
    let draft = draft(&folder);
    let drafted = line(&draft, "placeholders = ");
    assert!(
        drafted.starts_with("placeholders = [-1]")
            && drafted.contains("\"c5\" is -1 in 18 of 120 rows"),
        "{draft}"
    );
    assert_eq!(line(&draft, "from = \"c0"), "from = \"c0..15\"");
    assert!(line(&draft, "Fz = ").contains("from = \"fz\""), "{draft}");
}

#[test]
fn codes_in_one_cell_in_json_and_in_an_array_beside_the_table_leave_rows_out() {
    let map = |table: &str, from: &str| {
        format!(
            "map_version = 2\ntable = \"{table}\"\n[signals]\nfrom = {from}\nunit = \"mT\"\nplaces = [2, 1]\nchannels = [\"p\"]\nplaceholders = [-1, 65535]\n[time]\nclock = \"unknown\"\n{FACTS}"
        )
    };
    let cells = lab(&[(
        "t.csv",
        "tax\n\"[1, 2]\"\n\"[-1, 2]\"\n\"[3, 65535]\"\n\"[4, 0]\"\n",
    )]);
    assert_eq!(summary(cells.path(), &map("t.csv", "\"tax\"")).rows_kept, 2);
    let json = lab(&[(
        "t.json",
        "[{\"a\": [1, 2]}, {\"a\": [65535, 2]}, {\"a\": [3, 4]}]",
    )]);
    assert_eq!(summary(json.path(), &map("t.json", "\"/a\"")).rows_kept, 2);
    let array = lab(&[("t.csv", "n\na\nb\nc\n")]);
    let header = "{'descr': '<i4', 'fortran_order': False, 'shape': (3, 2), }\n";
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).expect("short").to_le_bytes());
    bytes.extend(header.as_bytes());
    for number in [1_i32, 2, 3, -1, 5, 6] {
        bytes.extend(number.to_le_bytes());
    }
    std::fs::write(array.path().join("tax.npy"), bytes).expect("written");
    let found = summary(array.path(), &map("t.csv", "{ file = \"tax.npy\" }"));
    assert_eq!((found.rows_kept, found.dropped.len()), (2, 1));
}

#[test]
fn a_code_of_taxels_that_the_map_does_not_list_is_warned_of_once() {
    let folder = case("taxel-code-for-nothing");
    let map = map_of("taxel-code-for-nothing");
    let found = summary(&folder, &map);
    let said: Vec<String> = found.warnings.iter().map(ToString::to_string).collect();
    let said: Vec<&String> = said
        .iter()
        .filter(|said| said.starts_with("taxel-code: "))
        .collect();
    let [said] = said[..] else {
        panic!("{:?}", found.warnings);
    };
    assert!(
        said.contains("`c5` is often -1,") && said.contains("`placeholders = [-1]` in [signals]"),
        "{said}"
    );
    let coded = map.replace("unit = \"count\"", "unit = \"count\"\nplaceholders = [-1]");
    assert!(!codes(&summary(&folder, &coded)).contains(&"taxel-code"));
    // Two taxels in a cell; both have the code. Noise around 0 is none.
    let of_cells = |code: i32| {
        let row = |row: i32| match row % 6 {
            0 => format!("\"[{code}, {code}]\"\n"),
            _ => format!("\"[{}, {}]\"\n", row % 2, row % 2),
        };
        let cells = lab(&[(
            "t.csv",
            &format!("tax\n{}", (0..60).map(row).collect::<String>()),
        )]);
        let map = format!(
            "map_version = 2\ntable = \"t.csv\"\n[signals]\nfrom = \"tax\"\nunit = \"count\"\nplaces = [2, 1]\nchannels = [\"p\"]\n[time]\nclock = \"unknown\"\n{FACTS}"
        );
        codes(&summary(cells.path(), &map))
    };
    assert_eq!(of_cells(65_535), ["taxel-code"]);
    assert_eq!(of_cells(-1), [""; 0]);
}

/// Map of a table `t.csv` with `time` and the taxels `from`, a grid of `places` × 1.
fn map_with_taxels(from: &str, places: u32) -> String {
    format!(
        "map_version = 2\ntable = \"t.csv\"\n[signals]\nfrom = {from}\nunit = \"count\"\nplaces = [{places}, 1]\nchannels = [\"p\"]\n{NO_TIME}{FACTS}"
    )
}

const NAMED: &str = "time,palm,thumb,index,middle,ring,little,wrist,heel\n0.1,1,2,3,4,5,6,7,8\n0.2,11,12,13,14,15,16,17,18\n";

fn taxels_of(folder: &std::path::Path, map: &str) -> Vec<f32> {
    let plan = planned(folder, map).unwrap_or_else(|problem| panic!("{problem}\n{map}"));
    let target = tempfile::tempdir().expect("a folder");
    let target = target.path().join("dataset");
    plan.run(
        &target,
        std::num::NonZeroUsize::MIN,
        &taceva_core::SilentProgress,
    )
    .expect("imported");
    let dataset = taceva_dataset::Dataset::open(&target).expect("a dataset");
    let signals = dataset.signals(1).expect("read").expect("there");
    signals.values().to_vec()
}

#[test]
fn taxels_of_a_table_with_names_are_named_by_position_too() {
    let folder = lab(&[("t.csv", NAMED)]);
    let expected = [11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0];
    let by_position = taxels_of(folder.path(), &map_with_taxels("\"1..8\"", 8));
    assert_eq!(by_position, expected);
    let some = taxels_of(folder.path(), &map_with_taxels("\"3..4\"", 2));
    assert_eq!(some, [13.0, 14.0]);
    // A name is preferred: here `2` is the third column.
    let named = lab(&[("t.csv", "2,1,3\n5,6,7\n8,9,10\n")]);
    let by_name = taxels_of(named.path(), &map_with_taxels("\"1..2\"", 2));
    assert_eq!(by_name, [9.0, 8.0]);
}

#[test]
fn positions_beyond_the_columns_of_a_table_are_refused_with_its_columns() {
    let folder = lab(&[("t.csv", NAMED)]);
    let said = planned(folder.path(), &map_with_taxels("\"1..12\"", 12)).expect_err("refused");
    for part in [
        "t.csv: [signals]: `1..12` are not in the header",
        "beyond its 9 columns, which are 0 to 8",
        "the columns are time, palm",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let said = planned(folder.path(), &map_with_taxels("\"1..8\"", 9)).expect_err("refused");
    assert!(said.contains("8 columns for"), "{said}");
    // Some of the numbers are names, so the others are missing names.
    let half = lab(&[("t.csv", "0,1,2\n5,6,7\n")]);
    let said = planned(half.path(), &map_with_taxels("\"1..3\"", 3)).expect_err("refused");
    assert!(said.contains("no column `3`"), "{said}");
}

#[test]
fn a_draft_with_a_list_of_taxels_offers_their_positions() {
    let rows: String = (0..12)
        .map(|row| {
            let cells: Vec<String> = (0..12).map(|at| format!("{}", (row * at) % 7)).collect();
            format!("r{row},{}\n", cells.join(","))
        })
        .collect();
    let names: Vec<String> = (0..12).map(|at| format!("s{at:02}")).collect();
    let folder = lab(&[("t.csv", &format!("label,{}\n{rows}", names.join(",")))]);
    let draft = draft(folder.path());
    assert!(
        line(&draft, "from = ").starts_with("from = [\"s00\", "),
        "{draft}"
    );
    let offered = line(&draft, "# or, by position from 0: ");
    assert!(offered.ends_with("from = \"1..12\""), "{draft}");
}

#[test]
fn numbered_columns_called_t_are_drafted_as_taxels_and_none_of_them_as_the_time() {
    let table = |first: &str, of_row: &dyn Fn(usize) -> String| {
        let names: Vec<String> = (0..16).map(|at| format!("t{at}")).collect();
        let rows: String = (0..20)
            .map(|row| {
                let cells: Vec<String> = (0..16).map(|at| format!("{}.5", row * 3 + at)).collect();
                format!("{}{}\n", of_row(row), cells.join(","))
            })
            .collect();
        lab(&[("t.csv", &format!("{first}{}\n{rows}", names.join(",")))])
    };
    let with_time = table("time_s,", &|row| format!("0.{row:02},"));
    let found = draft(with_time.path());
    assert_eq!(line(&found, "from = \"t0"), "from = \"t0..15\"", "{found}");
    assert!(found.contains("column = \"time_s\""), "{found}");
    let alone = table("", &|_| String::new());
    let found = draft(alone.path());
    assert_eq!(line(&found, "from = \"t0"), "from = \"t0..15\"", "{found}");
    assert!(!found.contains("column = \"t"), "{found}");
    // Names of times are no names of taxels.
    let folder = lab(&[(
        "t.csv",
        "time0,time1,time2,Fz_N\n0.1,0.2,0.3,1\n0.4,0.5,0.6,3\n",
    )]);
    let found = draft(folder.path());
    assert!(found.contains("column = \"time0\""), "{found}");
}
