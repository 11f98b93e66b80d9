//! Tests of Parquet lists that older writers wrote: without a group of their own, without a list annotation, or with the names of Hive.

use crate::recordings::parquet_file::parquet_file;
use parquet::column::writer::ColumnWriter;
use taceva_tables::ParquetTable;

/// Column of integers: its schema, the definition and the repetition levels of its entries, and the texts of its rows.
type Written<'a> = (&'a str, &'a [i16], &'a [i16], &'a [&'a str]);

#[test]
fn every_form_of_list_gives_the_same_rows() {
    // Rows: 1 and 2, none, null if the form can state it, 3.
    let forms: [Written<'_>; 6] = [
        (
            "repeated int32 a;",
            &[1, 1, 0, 1],
            &[0, 1, 0, 0],
            &["[1, 2]", "[]", "[3]"],
        ),
        (
            "optional group a (LIST) { repeated int32 element; }",
            &[2, 2, 1, 0, 2],
            &[0, 1, 0, 0, 0],
            &["[1, 2]", "[]", "", "[3]"],
        ),
        (
            "required group a (LIST) { repeated group list { required int32 element; } }",
            &[1, 1, 0, 1],
            &[0, 1, 0, 0],
            &["[1, 2]", "[]", "[3]"],
        ),
        (
            "optional group a (LIST) { repeated group bag { optional int32 array_element; } }",
            &[3, 3, 1, 0, 3],
            &[0, 1, 0, 0, 0],
            &["[1, 2]", "[]", "", "[3]"],
        ),
        (
            "optional group a (LIST) { repeated group array { required int32 x; } }",
            &[2, 2, 1, 0, 2],
            &[0, 1, 0, 0, 0],
            &[r#"[{"x": 1}, {"x": 2}]"#, "[]", "", r#"[{"x": 3}]"#],
        ),
        (
            "repeated group a { optional int32 x; }",
            &[2, 2, 0, 1, 2],
            &[0, 1, 0, 0, 0],
            &[
                r#"[{"x": 1}, {"x": 2}]"#,
                "[]",
                r#"[{"x": null}]"#,
                r#"[{"x": 3}]"#,
            ],
        ),
    ];
    for (schema, definitions, repetitions, rows) in forms {
        let (_folder, path) = parquet_file(&format!("message x {{ {schema} }}"), |column| {
            let ColumnWriter::Int32ColumnWriter(column) = column else {
                panic!()
            };
            column
                .write_batch(&[1, 2, 3], Some(definitions), Some(repetitions))
                .expect("written");
        });
        let table = ParquetTable::open(&path).expect(schema);
        let column = table.column("a").expect(schema);
        let texts: Vec<_> = column.iter().map(|cell| cell.text()).collect();
        assert_eq!(texts, rows, "{schema}");
    }
}
