//! Tests of units in names, compared with the map for every named column.

use super::{
    FACTS, NO_TIME, assert_near, case, imported, lab, map_of, mean, planned, planned_with,
};

#[test]
fn a_unit_of_american_transducers_in_a_name_is_refused_in_newtons_and_read_as_what_it_is() {
    let folder = case("unit-in-name-lbf");
    let map = map_of("unit-in-name-lbf");
    let problem = planned(&folder, &map).expect_err("refused");
    assert!(
        problem.contains("`Fz(lbf)`") && problem.contains("`unit = \"lbf\"`"),
        "{problem}"
    );
    let right = map.replace("unit = \"N\"", "unit = \"lbf\"");
    assert_near(mean(&imported(&folder, &right, "Fz")), 1.5848);
}

#[test]
fn a_unit_in_a_name_is_held_against_the_map_of_columns_cells_pointers_joins_paths_times_and_taxels()
{
    let columns = |from: &str, unit: &str| {
        format!("[columns]\nFz = {{ from = \"{from}\", unit = \"{unit}\" }}\n{NO_TIME}")
    };
    let join = "[[join]]\nname = \"ft\"\ntable = \"ft.csv\"\non = \"row\"\n";
    let path = "[path]\npattern = \"Fz{fz:number}mN.csv\"\n";
    let signals = |from: &str, unit: &str| {
        format!(
            "[signals]\nfrom = {from}\nunit = \"{unit}\"\nplaces = [2, 1]\nchannels = [\"p\"]\n{NO_TIME}"
        )
    };
    let time = |unit: &str| {
        format!(
            "[columns]\nFz = {{ from = \"f\", unit = \"N\" }}\n[time]\nclock = \"monotonic\"\ncolumn = \"t_ms\"\nunit = \"{unit}\"\n"
        )
    };
    for (files, table, map, wrong, right) in [
        (
            &[("t.csv", "Fz_mN\n1\n2\n")][..],
            "\"t.csv\"",
            columns("Fz_mN", "UNIT"),
            "N",
            "mN",
        ),
        (
            &[("t.csv", "\"Fz, gf\"\n1\n2\n")],
            "\"t.csv\"",
            columns("Fz, gf", "UNIT"),
            "N",
            "gf",
        ),
        (
            &[("t.csv", "Fz/kN\n1\n2\n")],
            "\"t.csv\"",
            columns("Fz/kN", "UNIT"),
            "N",
            "kN",
        ),
        (
            &[("t.csv", "ft_mN\n\"[1, 2]\"\n")],
            "\"t.csv\"",
            columns("ft_mN[1]", "UNIT"),
            "N",
            "mN",
        ),
        (
            &[("t.json", "[{\"wrench_mN\": {\"z\": 1}}]")],
            "\"t.json\"",
            columns("/wrench_mN/z", "UNIT"),
            "N",
            "mN",
        ),
        (
            &[("t.csv", "n\na\n"), ("ft.csv", "force z [ozf]\n1\n")],
            "\"t.csv\"",
            columns("ft.force z [ozf]", "UNIT") + join,
            "N",
            "ozf",
        ),
        (
            &[("Fz250mN.csv", "n\na\n")],
            "\"Fz*.csv\"",
            columns("path.fz", "UNIT") + path,
            "N",
            "mN",
        ),
        (
            &[("t.csv", "t_ms,f\n1,1\n2,2\n")],
            "\"t.csv\"",
            time("UNIT"),
            "s",
            "ms",
        ),
        (
            &[("t.csv", "p0_psi,p1_psi\n1,2\n")],
            "\"t.csv\"",
            signals("[\"p0_psi\", \"p1_psi\"]", "UNIT"),
            "kPa",
            "psi",
        ),
        (
            &[("t.csv", "taxels_bar\n\"[1, 2]\"\n")],
            "\"t.csv\"",
            signals("\"taxels_bar\"", "UNIT"),
            "kPa",
            "bar",
        ),
    ] {
        let folder = lab(files);
        let of = |unit: &str| {
            planned_with(
                folder.path(),
                &format!("table = {table}\n{}", map.replace("UNIT", unit)),
            )
        };
        let problem = of(wrong).expect_err("refused");
        assert!(problem.contains("` by its name"), "{table}: {problem}");
        of(right).unwrap_or_else(|problem| panic!("{map}: {problem}"));
    }
}

#[test]
fn a_scale_in_the_map_knows_better_than_a_name_and_counts_need_one() {
    let folder = lab(&[("t.csv", "fz_lsb,Fz_mN\n25,2500\n50,5000\n")]);
    let map = |from: &str, more: &str| {
        format!(
            "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"{from}\", unit = \"N\"{more} }}\n{NO_TIME}{FACTS}"
        )
    };
    let problem = planned(folder.path(), &map("fz_lsb", "")).expect_err("refused");
    assert!(problem.contains("`scale`"), "{problem}");
    assert_eq!(
        imported(folder.path(), &map("fz_lsb", ", scale = 0.1"), "Fz"),
        [2.5, 5.0]
    );
    assert_eq!(
        imported(folder.path(), &map("Fz_mN", ", scale = 1"), "Fz"),
        [2500.0, 5000.0]
    );
}

#[test]
fn units_of_force_torque_and_pressure_of_american_makers_are_known() {
    let folder = lab(&[("t.csv", "f,t,g\n2,3,4\n")]);
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"f\", unit = \"ozf\" }}\nTz = {{ from = \"t\", unit = \"lbf-in\" }}\nFx = {{ from = \"g\", unit = \"dyn\" }}\n{NO_TIME}{FACTS}"
    );
    let near = |column: &str, expected: f64| {
        let found = imported(folder.path(), &map, column)[0];
        assert!((found / expected - 1.0).abs() < 1e-14, "{column}: {found}");
    };
    near("Fz", 2.0 * 4.448_221_615_260_5 / 16.0);
    near("Tz", 3.0 * 4.448_221_615_260_5 * 25.4);
    near("Fx", 4e-5);
}
