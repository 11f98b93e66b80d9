//! Tests of lines before and below the header that are not rows.

use super::{FACTS, assert_near, case, draft, imported, lab, mean, planned};

fn map_of(name: &str) -> String {
    let path = case("lines-before-the-header").join(name);
    std::fs::read_to_string(path).expect("it is there")
}

#[test]
fn a_row_of_units_comments_and_a_line_of_the_separator_are_read_by_a_key_that_the_refusal_names() {
    let folder = case("lines-before-the-header");
    let of = |name: &str, keys: &str| {
        let table = format!("table = \"{name}.csv\"");
        let keyed = format!("table = {{ file = \"{name}.csv\", {keys} }}");
        map_of(&format!("{name}.toml")).replace(&table, &keyed)
    };
    for (name, keys) in [
        ("units-row", "units_row = true"),
        ("comments", "comment = \"#\""),
    ] {
        let problem = planned(&folder, &map_of(&format!("{name}.toml"))).expect_err("refused");
        assert!(problem.contains(keys), "{problem}");
    }
    assert_near(
        mean(&imported(&folder, &of("comments", "comment = \"#\""), "Fz")),
        1.99570,
    );
    assert_near(mean(&imported(&folder, &map_of("sep.toml"), "Fz")), 1.99570);
    // The units row states mN, the map N.
    let contradicted = of("units-row", "units_row = true");
    let problem = planned(&folder, &contradicted).expect_err("refused");
    assert!(problem.contains("is `mN` in the file"), "{problem}");
    let right = contradicted.replace("unit = \"N\"", "unit = \"mN\"");
    assert_near(mean(&imported(&folder, &right, "Fz")), 1.99570e-3);
}

#[test]
fn lines_of_gauges_and_spreadsheets_are_skipped_by_their_number_or_mark_and_lines_keep_their_numbers()
 {
    let rest = format!(
        "[columns]\nFz = {{ from = \"fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n{FACTS}"
    );
    for (text, keys, line) in [
        (
            "Mark-10 M5\nserial 3321\n\nfz\n1.5\n2.5\nx\n",
            "skip_lines = 3",
            7,
        ),
        ("% a\n% b\nfz\n1.5\n% c\n2.5\nx\n", "comment = \"%\"", 7),
        (
            "title\nfz\nN\n1.5\n2.5\nx\n",
            "skip_lines = 1, units_row = true",
            6,
        ),
        (
            "sep=;\nfz;n\n(N);-\n1.5;a\n2.5;b\nx;c\n",
            "units_row = true",
            6,
        ),
    ] {
        let folder = lab(&[("t.csv", text)]);
        let map = format!("map_version = 2\ntable = {{ file = \"t.csv\", {keys} }}\n{rest}");
        let problem = planned(folder.path(), &map).expect_err("x is no number");
        assert!(
            problem.contains(&format!("line {line}")),
            "{text}: {problem}"
        );
        let right = lab(&[("t.csv", &text.replace("\nx", "\n3.5"))]);
        assert_eq!(
            imported(right.path(), &map, "Fz"),
            [1.5, 2.5, 3.5],
            "{text}"
        );
    }
}

#[test]
fn a_draft_says_how_a_table_of_text_is_written() {
    for (text, keys) in [
        (
            "# load cell\n# lab 3\nt,Fz\n0.1,1.5\n0.2,2.5\n",
            "comment = \"#\"",
        ),
        ("t,Fz\ns,mN\n0.1,1.5\n0.2,2.5\n", "units_row = true"),
        ("Gauge\nserial\nt,Fz\n0.1,1.5\n0.2,2.5\n", "skip_lines = 2"),
        ("t;Fz\n0,1;1,5\n0,2;2,5\n", "decimal = \",\""),
    ] {
        let folder = lab(&[("t.csv", text)]);
        let draft = draft(folder.path());
        assert!(
            draft.contains(&format!("{{ file = \"t.csv\", {keys} }}")),
            "{draft}"
        );
        let filled = draft
            .replace("unit = \"?\"", "unit = \"N\"")
            .replace("model = \"?\"", "model = \"gel\"");
        let expected = if keys.starts_with("units") {
            [1.5e-3, 2.5e-3]
        } else {
            [1.5, 2.5]
        };
        assert_eq!(imported(folder.path(), &filled, "Fz"), expected, "{filled}");
    }
}

#[test]
fn keys_of_text_are_refused_of_other_tables_and_signs_that_are_none() {
    let folder = lab(&[("t.json", "[{\"fz\": 1}]"), ("t.csv", "fz\n1\n")]);
    let rest = format!(
        "[columns]\nFz = {{ from = \"fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n{FACTS}"
    );
    for (table, word) in [
        (
            "{ file = \"t.json\", decimal = \",\" }",
            "apply to CSV and TSV only",
        ),
        ("{ file = \"t.csv\", decimal = \";\" }", "`decimal"),
        (
            "{ file = \"t.csv\", decimal = \".\", thousands = \".\" }",
            "`thousands",
        ),
        ("{ file = \"t.csv\", comment = \"\" }", "`comment`"),
        ("{ file = \"t.csv\", skip_lines = 9 }", "no header is left"),
    ] {
        let problem = planned(
            folder.path(),
            &format!("map_version = 2\ntable = {table}\n{rest}"),
        )
        .expect_err("refused");
        assert!(problem.contains(word), "{table}: {problem}");
    }
}
