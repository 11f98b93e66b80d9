//! Joins whose rows are counted: of several tables each would begin with the first row again.

use super::{NO_TIME, lab, planned};

#[test]
fn a_joined_table_whose_rows_are_counted_belongs_to_one_table_alone() {
    let of = |table: &str, by: &str| {
        let map = format!(
            "table = {table}\n[[join]]\nname = \"b\"\ntable = \"b/all.csv\"\n{by}\nunmatched = \"drop\"\n[columns]\nFz = {{ from = \"b.f\", unit = \"N\" }}\n{NO_TIME}"
        );
        planned(
            lab(&[
                ("t0.csv", "Fx\n1\n2\n"),
                ("t1.csv", "Fx\n3\n4\n"),
                ("b/all.csv", "f,end\n5,1\n6,2\n7,3\n8,4\n"),
            ])
            .path(),
            &map,
        )
    };
    for (table, by, expected) in [
        (
            "\"t*.csv\"",
            "on = \"row\"",
            ["`on = \"row\"`", "each of the 2 tables", "a column of both"],
        ),
        (
            "\"t*.csv\"",
            "until = \"end\"",
            ["`until`", "each of the 2 tables", "{path.NAME}"],
        ),
        (
            "{ files = \"t*.csv\" }",
            "on = \"row\"",
            [
                "each of the 2 files",
                "their order is no promise",
                "on = { \"path.NAME\" = \"COLUMN\" }",
            ],
        ),
    ] {
        let problem = of(table, by).expect_err(by);
        for expected in expected {
            assert!(problem.contains(expected), "{expected}: {problem}");
        }
        assert!(problem.contains("t1.csv: join `b`"), "{problem}");
        assert!(problem.contains("b/all.csv"), "{problem}");
    }
    // Of one table the rows are counted.
    of("\"t0.csv\"", "on = \"row\"").expect("one table");
    of("\"t1.csv\"", "until = \"end\"").expect("one table");
}
