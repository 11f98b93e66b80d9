//! Read-only access to tables of an SQLite 3 database: <https://www.sqlite.org/fileformat2.html>.
//!
//! Only B-trees of tables are read. Indices, triggers and views are ignored. Rows are thus found by number only.

mod columns;
mod page;
mod record;
mod tree;

use std::path::{Path, PathBuf};

use crate::error::{Place, TableError};
use crate::limits;
use crate::source::Source;
use columns::{Columns, columns};
pub(crate) use page::Pages;
pub(crate) use record::{Record, Value};
use tree::walk;

/// First bytes of a database.
pub(crate) const MAGIC: [u8; 16] = *b"SQLite format 3\0";
/// Size of the header of a file, bytes.
const HEADER: u64 = 100;
/// First bytes of a hot journal, which SQLite must roll back before the database is read.
const JOURNAL: [u8; 8] = [0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7];

/// Open SQLite database with its tables.
#[derive(Debug)]
pub(crate) struct Database {
    source: Source,
    /// Size of a page, bytes.
    page_bytes: u32,
    /// Size of a page without the bytes reserved at its end, bytes.
    usable: u32,
    /// Number of pages in the file.
    pages: u32,
    /// Number of pages that the header of the file states.
    announced: u32,
    tables: Vec<SqliteTable>,
}

/// Table of a database.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SqliteTable {
    pub(crate) name: String,
    root: u32,
    /// Names of the columns.
    pub(crate) columns: Vec<String>,
    /// Position of the column that stands for the row number; `None` if no column does.
    id: Option<usize>,
}

/// Location of a row: its page, and the index of its cell in the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RowPlace {
    pub(crate) page: u32,
    pub(crate) cell: u16,
}

impl Database {
    /// Opens the database in `source`.
    ///
    /// # Errors
    /// [`TableError::Unsupported`] if a log beside the database has pending changes; [`TableError::Damaged`] if the file is not a database.
    pub(crate) fn open(source: Source) -> Result<Database, TableError> {
        check_logs(&source)?;
        let mut file = source.open()?;
        let head = source.bytes(&mut file, 0, HEADER.min(source.length()), HEADER)?;
        let begin = Place::byte(0).in_name("header");
        let damaged = |problem: String| source.damaged(begin.clone(), problem);
        if head.get(..16) != Some(&MAGIC) {
            return Err(damaged(
                "not a SQLite database: it does not begin with its magic bytes".to_owned(),
            ));
        }
        let Some(head) = head.first_chunk::<100>() else {
            return Err(damaged("cut short".to_owned()));
        };
        let four =
            |at: usize| u32::from_be_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
        let page_bytes = match u16::from_be_bytes([head[16], head[17]]) {
            1 => 65_536,
            other => u32::from(other),
        };
        let usable = page_bytes.saturating_sub(u32::from(head[20]));
        if !page_bytes.is_power_of_two() || page_bytes < 512 || usable < 480 {
            return Err(damaged(format!(
                "pages of {page_bytes} bytes, {} of them reserved",
                head[20]
            )));
        }
        if head[21..24] != [64, 32, 32] {
            return Err(damaged(
                "payload fractions that no version of SQLite writes".to_owned(),
            ));
        }
        if head[19] > 2 || four(44) > 4 {
            let problem = format!(
                "written for a later version of SQLite (read version {}, schema format {}): copy it with `sqlite3 FILE \".backup \
                 OUT.db3\"` of that version",
                head[19],
                four(44)
            );
            return Err(source.unsupported(begin, problem));
        }
        if !matches!(four(56), 0 | 1) {
            return Err(source.unsupported(begin, "strings in UTF-16, expected UTF-8"));
        }
        let whole = u32::try_from(source.length() / u64::from(page_bytes)).unwrap_or(u32::MAX);
        // The page count in the header is valid only if the change counter equals the counter of the last version.
        let stated = Some(four(28)).filter(|pages| *pages > 0 && four(24) == four(92));
        let announced = stated.unwrap_or(whole);
        let mut database = Database {
            source,
            page_bytes,
            usable,
            pages: announced.min(whole),
            announced,
            tables: Vec::new(),
        };
        database.tables = database.read_tables()?;
        Ok(database)
    }

    pub(crate) fn source(&self) -> &Source {
        &self.source
    }

    /// Offset of the end of the last page of a file that has fewer pages than its header states; `None` for a complete file.
    pub(crate) fn cut_at(&self) -> Option<u64> {
        (self.pages < self.announced).then(|| u64::from(self.pages) * u64::from(self.page_bytes))
    }

    /// Size that the header states for the complete file, bytes.
    fn announced_bytes(&self) -> u64 {
        let announced = u64::from(self.announced) * u64::from(self.page_bytes);
        self.source.length().max(announced)
    }

    /// Error message about the missing pages of a truncated database.
    pub(crate) fn missing_pages(&self) -> String {
        format!(
            "{} pages of {} bytes are announced, but the file has {}: it is cut short",
            self.announced,
            self.page_bytes,
            self.source.length()
        )
    }

    /// Tables of the database, in the order of creation.
    pub(crate) fn tables(&self) -> &[SqliteTable] {
        &self.tables
    }

    /// Calls `each` with the location and the record of every row of `table`.
    pub(crate) fn each_row(
        &self,
        table: &SqliteTable,
        each: &mut dyn FnMut(RowPlace, &mut Record<'_, '_>) -> Result<(), TableError>,
    ) -> Result<(), TableError> {
        let mut pages = Pages::new(self)?;
        walk(&mut pages, table, each)
    }

    /// Reads the list of tables from the first page, with their SQL texts.
    fn read_tables(&self) -> Result<Vec<SqliteTable>, TableError> {
        let master = SqliteTable {
            name: "sqlite_schema".to_owned(),
            root: 1,
            columns: ["type", "name", "tbl_name", "rootpage", "sql"]
                .map(str::to_owned)
                .to_vec(),
            id: None,
        };
        let mut tables = Vec::new();
        let mut described = 0_u64;
        self.each_row(&master, &mut |_, record| {
            described = described.saturating_add(record.bytes());
            if described > limits::DESCRIPTION_BYTES {
                let place = Place::of(&master.name);
                return Err(self
                    .source
                    .too_large(place, "more tables than are accepted"));
            }
            let (kind, name) = (record.text(0)?, record.text(1)?);
            let (root, sql) = (record.value(3)?, record.text(4)?);
            let root = match root {
                Value::Integer(root) => u32::try_from(root).unwrap_or(0),
                _ => 0,
            };
            // Skips internal tables and objects that are not row tables.
            if kind != "table" || name.starts_with("sqlite_") || root == 0 {
                return Ok(());
            }
            if let Some(Columns { names, id }) = columns(&sql) {
                tables.push(SqliteTable {
                    name,
                    root,
                    columns: names,
                    id,
                });
            }
            Ok(())
        })?;
        Ok(tables)
    }
}

impl SqliteTable {
    /// Position of the column `name`.
    pub(crate) fn position(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }
}

/// Path `path` with `ending` appended.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

/// Rejects a database with a log of changes that are not yet in the database, or that must be rolled back.
fn check_logs(source: &Source) -> Result<(), TableError> {
    let refuse = |log: &Path, what: &str| {
        let name = log
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let problem = format!(
            "`{name}` beside it holds {what}: the recorder did not close it. Merge a copy of both files with `sqlite3 FILE \"PRAGMA \
             journal_mode = DELETE\"`"
        );
        Err(source.unsupported(Place::default(), problem))
    };
    let log = beside(source.path(), "-wal");
    if log.metadata().is_ok_and(|facts| facts.len() > 0) {
        return refuse(
            &log,
            "a write-ahead log with messages that this file still lacks",
        );
    }
    let journal = beside(source.path(), "-journal");
    if let Ok(other) = Source::new(&journal)
        && let Ok(mut file) = other.open()
        && let Ok(begin) = other.bytes(&mut file, 0, 8, 8)
        && begin == JOURNAL
    {
        return refuse(&journal, "a rollback journal of unfinished changes");
    }
    Ok(())
}
