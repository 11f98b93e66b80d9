use super::*;

fn file(text: &str) -> tempfile::NamedTempFile {
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), text).expect("written");
    file
}

#[test]
fn members_lists_and_the_whole_are_rows() {
    let of = |text: &str, rows: Option<&str>| {
        let file = file(text);
        let table = JsonRows::read(file.path(), rows).expect("rows");
        (0..table.rows())
            .map(|row| {
                let key = table.key(row).unwrap_or("-").to_owned();
                format!("{key}:{}", table.cell(row, "/a"))
            })
            .collect::<Vec<_>>()
    };
    assert_eq!(
        of(r#"{"x": {"a": 1}, "y": {"a": 0.1}}"#, Some("/*")),
        ["x:1", "y:0.1"]
    );
    assert_eq!(of(r#"[{"a": "p"}, {"a": null}]"#, None), ["-:p", "-:"]);
    assert_eq!(of(r#"{"a": [1, 2]}"#, None), ["-:[1,2]"]);
    assert_eq!(of(r#"{"in": [{"a": 3}]}"#, Some("/in/*")), ["-:3"]);
    let deep = r#"{"y": {"s": [{"a": 1}, {"a": 2}]}, "x": {"t": []}, "w": {"s": [{"a": 3}]}}"#;
    assert_eq!(of(deep, Some("/*/s/*")), ["y:1", "y:2", "w:3"]);
    assert_eq!(of(deep, Some("/*/s/0")), ["y:1", "w:3"]);
}

#[test]
fn rows_that_are_numbers_themselves_are_called_value() {
    let file = file(r#"{"sampling": {"timestamps_s": [0.0, 0.01, null, 3]}}"#);
    let table = JsonRows::read(file.path(), Some("/sampling/timestamps_s/*")).expect("rows");
    assert_eq!(
        (table.names(), table.leaves()),
        (vec![VALUE.to_owned()], vec![VALUE.to_owned()])
    );
    let cells: Vec<_> = (0..4)
        .map(|row| table.cell(row, VALUE).into_owned())
        .collect();
    assert_eq!(cells, ["0.0", "0.01", "", "3"]);
    assert!(!table.holds_integers(VALUE));
}

#[test]
fn members_are_rows_in_the_order_of_the_file() {
    let file = file(r#"{"2": {"a": 20}, "10": {"a": 100}, "1": {"a": 10}}"#);
    let table = JsonRows::read(file.path(), Some("/*")).expect("rows");
    let keys: Vec<Option<&str>> = (0..3).map(|row| table.key(row)).collect();
    assert_eq!(keys, [Some("2"), Some("10"), Some("1")]);
    assert_eq!(table.cell(1, "/a"), "100");
}

#[test]
fn what_is_no_json_names_its_line_and_deep_lists_are_refused() {
    let lines = file("{\"a\": 1}\n\n{\"a\": }\n");
    let error = JsonRows::read_lines(lines.path()).expect_err("no JSON");
    assert!(error.to_string().contains("line 3"), "{error}");
    let deep = file(&"[".repeat(100_000));
    let error = JsonRows::read(deep.path(), None).expect_err("deep");
    assert!(error.to_string().contains("recursion limit"), "{error}");
    let nowhere = file("{}");
    let error = JsonRows::read(nowhere.path(), Some("/data/*")).expect_err("nothing");
    assert!(error.to_string().contains("no rows at `/data`"), "{error}");
}

#[test]
fn a_number_that_json_does_not_have_names_its_line_once_and_the_remedy() {
    for (word, column) in [("NaN", 6), ("Infinity", 6), ("-Infinity", 7)] {
        let row = format!("{{\"a\":{word}}}");
        let lines = file(&format!("{{\"a\":1}}\n{row}\n"));
        let error = JsonRows::read_lines(lines.path()).expect_err("no JSON");
        let error = error.to_string();
        let expected = format!("line 2: invalid JSON: `{word}` in column {column}: ");
        assert!(error.contains(&expected), "{error}");
        assert!(error.contains("write `null`"), "{error}");
        assert!(!error.contains("line 1"), "{error}");
        let whole = file(&format!("[{{\"a\":1}},\n{row}]"));
        let error = JsonRows::read(whole.path(), None).expect_err("no JSON");
        assert!(error.to_string().contains(&expected), "{error}");
    }
    let cut = file("{\"a\":1}\n{\"a\":\n");
    let error = JsonRows::read_lines(cut.path()).expect_err("cut");
    let error = error.to_string();
    assert!(error.contains("line 2: invalid JSON: EOF"), "{error}");
    assert!(!error.contains("line 1"), "{error}");
}

#[test]
fn a_mark_of_the_order_of_bytes_is_skipped() {
    let lines = file("\u{feff}{\"a\": 1}\n{\"a\": 2}\n");
    let table = JsonRows::read_lines(lines.path()).expect("rows");
    assert_eq!((table.rows(), &*table.cell(0, "/a")), (2, "1"));
    let whole = file("\u{feff}[{\"a\": 3}]");
    let table = JsonRows::read(whole.path(), None).expect("rows");
    assert_eq!(table.cell(0, "/a"), "3");
}
