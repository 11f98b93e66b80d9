//! Tests of joins by row number. With several tables, each would begin with the first row again.

use super::{NO_TIME, lab, planned};
use taceva_dataset::Dataset;

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
            "\"t*.csv\"",
            "on = { row = \"end\" }",
            [
                "`on = { row = … }`",
                "each of the 2 tables",
                "a column of both",
            ],
        ),
        (
            "{ files = \"t*.csv\" }",
            "on = \"row\"",
            [
                "each of the 2 files",
                "in no reliable order",
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
    // The rows of one table may be counted.
    of("\"t0.csv\"", "on = \"row\"").expect("one table");
    of("\"t1.csv\"", "until = \"end\"").expect("one table");
    of("\"t1.csv\"", "on = { row = \"end\" }").expect("one table");
}

#[test]
fn a_frame_that_a_joined_table_names_lies_beside_that_table_unless_the_map_says_a_folder() {
    let picture = |level: u8| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::GrayImage::from_pixel(2, 2, image::Luma([level]))
            .write_to(&mut bytes, image::ImageFormat::Png)
            .expect("encoded");
        bytes.into_inner()
    };
    let folder = lab(&[
        ("labels/l.csv", "press,Fz\n1,1\n0,2\n"),
        (
            "camera/c.csv",
            "press,file,still\n0,0.png,r.png\n1,1.png,r.png\n",
        ),
    ]);
    // Pictures of the same names lie beside the main table.
    for (name, level) in [
        ("camera/0.png", 10),
        ("camera/1.png", 11),
        ("camera/r.png", 12),
        ("camera/2.png", 13),
        ("labels/0.png", 20),
        ("labels/1.png", 21),
        ("labels/r.png", 22),
    ] {
        std::fs::write(folder.path().join(name), picture(level)).expect("written");
    }
    let map = |folder: &str| {
        format!(
            "table = \"labels/l.csv\"\n[[join]]\nname = \"c\"\ntable = \"camera/c.csv\"\non = {{ press = \"press\" }}\n[frame]\ncolumn = \"c.file\"\n{folder}channel_order = \"gray\"\nreference = {{ column = \"c.still\" }}\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n{NO_TIME}"
        )
    };
    for (name, key, expected, reference, images) in [
        ("own", "", [11, 10], 12, 1),
        ("said", "folder = \"labels\"\n", [21, 20], 22, 0),
    ] {
        let target = folder.path().join(name);
        let plan = planned(folder.path(), &map(key)).expect("planned");
        assert_eq!(plan.summary().unnamed_images, images, "{name}");
        let jobs = std::num::NonZeroUsize::MIN;
        plan.run(&target, jobs, &taceva_core::SilentProgress)
            .expect("imported");
        let dataset = Dataset::open(&target).expect("opens");
        let level = |frame: taceva_core::Frame| frame.bytes()[0];
        let levels = [0, 1].map(|row| level(dataset.frame(row).expect("read").expect("a frame")));
        assert_eq!(levels, expected, "{name}");
        let still = dataset.reference().expect("read").expect("one");
        assert_eq!(level(still), reference, "{name}");
    }
    std::fs::remove_file(folder.path().join("camera/1.png")).expect("removed");
    let problem = planned(folder.path(), &map("")).expect_err("not there");
    assert!(
        problem.contains("`1.png`") && problem.contains("no such file"),
        "{problem}"
    );
}
