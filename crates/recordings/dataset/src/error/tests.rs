use super::*;

#[test]
fn a_message_names_file_line_and_column() {
    let error = DatasetError::Image {
        place: Some(Box::new(Place {
            path: "labels.csv".into(),
            line: Some(3),
            row: None,
            column: Some("file".into()),
        })),
        path: "frames/2.png".into(),
        problem: "the file ends before its end marker".into(),
    };
    assert_eq!(
        error.to_string(),
        "labels.csv, line 3, column `file`: frames/2.png: the file ends before its end marker"
    );
}

#[test]
fn an_error_is_small_enough_to_be_returned_everywhere() {
    assert!(size_of::<DatasetError>() <= 128);
}
