use super::*;

/// Error of an image that a cell of a table names.
fn of_cell(image: &str) -> ImportError {
    let place = Place::line("labels.csv".as_ref(), 3).in_column("file");
    ImportError::image(image.as_ref(), "the file ends before its end marker").named_at(place)
}

#[test]
fn a_message_names_file_line_and_column() {
    assert_eq!(
        of_cell("frames/2.png").to_string(),
        "labels.csv, line 3, column `file`: frames/2.png: the file ends before its end marker"
    );
}

#[test]
fn a_file_that_names_its_own_pictures_is_named_once() {
    assert_eq!(
        of_cell("labels.csv").to_string(),
        "labels.csv, line 3, column `file`: the file ends before its end marker"
    );
}

#[test]
fn a_named_error_keeps_its_kind_and_a_table_has_no_error_of_a_dataset() {
    let named = ImportError::path("../a.png", "leaves the folder").named_at(Place::default());
    assert_eq!(named.kind(), ErrorKind::InvalidArgument);
    assert!(matches!(named.dataset(), Some(DatasetError::Path { .. })));
    let table = ImportError::table("labels.csv", "no row").named_at(Place::default());
    assert!(
        matches!(&table, ImportError::Table { place, .. } if place.path.ends_with("labels.csv"))
    );
    assert!(table.dataset().is_none());
}

#[test]
fn paths_of_an_unpacked_archive_are_replaced_in_every_place() {
    let replaced = of_cell("frames/2.png")
        .with_paths(&|path| Path::new("run.tar").join(path), &|text| {
            text.replace("file", "member")
        });
    assert_eq!(
        replaced.to_string(),
        "run.tar/labels.csv, line 3, column `file`: run.tar/frames/2.png: the member ends before its end marker"
    );
}

#[test]
fn an_error_is_small_enough_to_be_returned_everywhere() {
    assert!(size_of::<ImportError>() < 128);
}
