//! Tests of columns that cannot be read.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::*;

/// Source with an unreadable column, and with a column of too many cells.
#[derive(Debug, Default)]
struct Refusing {
    rows: usize,
    reads: Arc<AtomicUsize>,
}

impl ColumnSource for Refusing {
    fn rows(&self) -> usize {
        self.rows
    }

    fn names(&self) -> Vec<String> {
        vec!["z".to_owned()]
    }

    fn has(&self, name: &str) -> bool {
        name == "z"
    }

    fn columns(&self, _: &[&str]) -> Result<Vec<Vec<String>>, String> {
        self.reads.fetch_add(1, Ordering::Relaxed);
        Err("damaged".to_owned())
    }

    fn holds_integers(&self, _: &str) -> bool {
        false
    }

    fn picture_columns(&self) -> Vec<PictureColumn> {
        Vec::new()
    }

    fn pictures(&self, _: &FrameNames) -> Result<Arc<dyn Pictures>, String> {
        Err("none".to_owned())
    }
}

/// Error of the last of ten cells in a column that cannot be read, and the number of attempts to read it. The file has `rows` rows.
fn refused(rows: usize) -> (String, usize) {
    let file = tempfile::NamedTempFile::new().expect("a file");
    let reads = Arc::new(AtomicUsize::new(0));
    let source = Refusing {
        rows,
        reads: Arc::clone(&reads),
    };
    let table = ColumnTable::open(file.path(), || Ok(source)).expect("a table");
    let errors = (0..10).map(|row| table.cell(row, "z").expect_err("refused").to_string());
    let last = errors.last().expect("ten");
    (last, reads.load(Ordering::Relaxed))
}

#[test]
fn a_column_that_cannot_be_read_costs_one_attempt() {
    let (error, reads) = refused(10);
    assert!(error.ends_with("damaged") && reads == 1, "{reads}: {error}");
}

#[test]
fn a_column_of_too_many_cells_is_refused_before_it_is_unpacked() {
    let (error, reads) = refused(10_000_000);
    assert!(error.contains("take more than 100663296 bytes"), "{error}");
    assert_eq!(reads, 0);
}
