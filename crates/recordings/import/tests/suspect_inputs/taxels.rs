//! Tests of placeholder codes of taxels.

use super::{FACTS, case, codes, draft, lab, line, map_of, summary};

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
