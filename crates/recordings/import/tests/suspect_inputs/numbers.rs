//! Tests of grouped digits, decimal commas, columns named twice, and booleans as numbers.

use super::{
    NO_TIME, assert_near, case, codes, imported, lab, map_of, mean, parquet_lab, planned,
    planned_with, summary,
};
use taceva_tables::Cell;

#[test]
fn whole_numbers_with_a_point_between_groups_of_digits_are_warned_of_until_the_map_says_what_they_are()
 {
    let folder = case("dot-groups-thousands");
    let map = map_of("dot-groups-thousands");
    assert_eq!(codes(&summary(&folder, &map)), ["grouped-digits"]);
    let said = summary(&folder, &map).to_string();
    assert!(
        said.contains("warning  grouped-digits: `fz`") && said.contains("`thousands = \".\"`"),
        "{said}"
    );
    let table = "table = \"labels.csv\"";
    let grouped = map.replace(
        table,
        "table = { file = \"labels.csv\", thousands = \".\" }",
    );
    assert_near(mean(&imported(&folder, &grouped, "Fz")), 1.7335);
    assert_eq!(codes(&summary(&folder, &grouped)), [""; 0]);
    let fractions = map.replace(table, "table = { file = \"labels.csv\", thousands = \"\" }");
    assert_eq!(codes(&summary(&folder, &fractions)), [""; 0]);
}

#[test]
fn grouped_digits_of_other_tables_separators_and_signs_are_warned_of_too() {
    let columns =
        |from: &str| format!("[columns]\nPx = {{ from = \"{from}\", unit = \"um\" }}\n{NO_TIME}");
    let tabs = lab(&[("t.tsv", "n\tx\na\t-1.250\nb\t12.500\nc\t2.750\nd\t980\n")]);
    let quoted = lab(&[(
        "t.csv",
        "n,x\n\"a\",\"1.250\"\n\"b\",\"3.500\"\n\"c\",\"2.750\"\n\"d\",\"-5\"\n",
    )]);
    let joined = lab(&[
        ("t.csv", "n\na\nb\nc\nd\n"),
        ("x.csv", "n;x\na;1.250\nb;3.500\nc;102.750\nd;17\n"),
    ]);
    let join = "[[join]]\nname = \"other\"\ntable = \"x.csv\"\non = \"row\"\n";
    for (folder, map) in [
        (&tabs, format!("table = \"t.tsv\"\n{}", columns("x"))),
        (&quoted, format!("table = \"t.csv\"\n{}", columns("x"))),
        (
            &joined,
            format!("table = \"t.csv\"\n{}{join}", columns("other.x")),
        ),
    ] {
        let plan = planned_with(folder.path(), &map).expect("an import");
        assert_eq!(codes(plan.summary()), ["grouped-digits"], "{map}");
    }
}

#[test]
fn fractions_of_three_digits_are_no_groups() {
    for cells in [
        "0.512\n1.333\n756\n2.250\n",
        "1.333\n2.698\n3.125\n4.250\n",
        "1.333\n2.5\n3.125\n4\n",
        "1.333\n2.698\n3.125\n1756\n",
        "0\n1.333\n2.698\n3.125\n",
    ] {
        let folder = lab(&[("t.csv", &format!("fz\n{cells}"))]);
        let map = format!(
            "table = \"t.csv\"\n[columns]\nFz = {{ from = \"fz\", unit = \"mN\" }}\n{NO_TIME}"
        );
        let plan = planned_with(folder.path(), &map).expect("an import");
        assert_eq!(codes(plan.summary()), [""; 0], "{cells}");
    }
}

#[test]
fn commas_for_points_are_read_by_the_map_and_refused_with_the_key_without_it() {
    let folder = lab(&[("t.csv", "fz;fx\n1,5;-0,25\n1.002,5;1e-1\n")]);
    let columns = format!(
        "[columns]\nFx = {{ from = \"fx\", unit = \"N\" }}\nFz = {{ from = \"fz\", unit = \"N\" }}\n{NO_TIME}"
    );
    let problem =
        planned_with(folder.path(), &format!("table = \"t.csv\"\n{columns}")).expect_err("refused");
    assert!(
        problem.contains("`decimal`") && problem.contains("line 2"),
        "{problem}"
    );
    let map =
        format!("table = {{ file = \"t.csv\", decimal = \",\", thousands = \".\" }}\n{columns}");
    let whole = format!("map_version = 2\n{map}{}", super::FACTS);
    assert_eq!(imported(folder.path(), &whole, "Fz"), [1.5, 1002.5]);
    assert_eq!(imported(folder.path(), &whole, "Fx"), [-0.25, 0.1]);
    let wrong = lab(&[("t.csv", "fz;fx\n1,5;1\n1.02;1\n")]);
    let problem = planned_with(wrong.path(), &map).expect_err("refused");
    assert!(
        problem.contains("line 3") && problem.contains("groups of three digits"),
        "{problem}"
    );
}

#[test]
fn a_column_that_is_named_for_two_channels_is_warned_of() {
    let folder = case("column-mapped-twice");
    let found = summary(&folder, &map_of("column-mapped-twice"));
    assert_eq!(codes(&found), ["column-twice"]);
    assert!(
        found.to_string().contains("`fx` is read as Fx and Fy"),
        "{found}"
    );
}

#[test]
fn a_column_that_is_named_twice_is_warned_of_in_cells_parquet_and_joins_but_not_with_another_sign()
{
    let cells = lab(&[("t.csv", "ft\n\"[1, 2]\"\n\"[3, 4]\"\n")]);
    let json = lab(&[("t.json", "[{\"f\": {\"z\": 1}}, {\"f\": {\"z\": 2}}]")]);
    let joined = lab(&[("t.csv", "n\na\nb\n"), ("o.csv", "f\n1\n2\n")]);
    let join = "[[join]]\nname = \"o\"\ntable = \"o.csv\"\non = \"row\"\n";
    let rows = [1.0, 2.0].map(|force| vec![Cell::Number(force)]);
    let parquet = parquet_lab("t.parquet", &["f"], &rows);
    for (folder, table, from, more, expected) in [
        (&parquet, "t.parquet", "f", "", 1),
        (&cells, "t.csv", "ft[1]", "", 1),
        (&json, "t.json", "/f/z", "", 1),
        (&joined, "t.csv", "o.f", join, 1),
        (&json, "t.json", "/f/z", "sign", 0),
    ] {
        let (sign, join) = match more {
            "sign" => (", sign = -1", ""),
            join => ("", join),
        };
        let map = format!(
            "table = \"{table}\"\n[columns]\nFy = {{ from = \"{from}\", unit = \"N\" }}\nFz = {{ from = \"{from}\", unit = \"N\"{sign} }}\n{NO_TIME}{join}"
        );
        let plan = planned_with(folder.path(), &map).expect("an import");
        assert_eq!(codes(plan.summary()).len(), expected, "{map}");
    }
}

#[test]
fn a_column_of_true_and_false_is_refused_as_a_number_with_the_section_that_reads_it() {
    for (name, text) in [
        ("t.csv", "contact\ntrue\nfalse\n"),
        ("t.csv", "contact\nTrue\nFalse\n"),
        ("t.json", "[{\"contact\": true}, {\"contact\": false}]"),
    ] {
        let folder = lab(&[(name, text)]);
        let from = if name.ends_with("json") {
            "/contact"
        } else {
            "contact"
        };
        let map = format!(
            "table = \"{name}\"\n[columns]\nFz = {{ from = \"{from}\", unit = \"N\" }}\n{NO_TIME}"
        );
        let problem = planned_with(folder.path(), &map).expect_err("refused");
        assert!(problem.contains("[classes]"), "{problem}");
    }
}

#[test]
fn an_episode_of_two_takes_is_refused_with_the_count_of_both() {
    let folder = case("lerobot-two-takes-one-episode");
    let problem = planned(&folder, &map_of("lerobot-two-takes-one-episode")).expect_err("refused");
    assert!(
        problem.contains("episode 2 has 12 rows") && problem.contains("states 6"),
        "{problem}"
    );
}
