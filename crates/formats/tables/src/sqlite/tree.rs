//! B-trees of the tables of an SQLite database. Interior pages refer to other pages. Leaf pages contain rows in the order of their numbers.

use std::collections::HashSet;

use super::page::Pages;
use super::record::Record;
use super::{RowPlace, SqliteTable};
use crate::error::TableError;

/// Type of an interior page of a table. `LEAF` is the type of a leaf page.
const INNER: u8 = 5;
const LEAF: u8 = 13;
/// Maximum depth of a tree. Even a tree of all pages, in which each interior page has two children, is less deep.
const DEPTH: usize = 40;

/// Head of a page of a table.
pub(super) struct Head {
    kind: u8,
    cells: u16,
    /// Page number of the last child of an interior page.
    last: u32,
    /// Offset of the list of cell offsets in the page.
    places: usize,
}

impl Head {
    /// Parses the head of `page`, whose page number is `number`.
    pub(super) fn of(number: u32, page: &[u8]) -> Option<Head> {
        // The header of the file precedes the first page.
        let at = if number == 1 { 100 } else { 0 };
        let head = page.get(at..)?.first_chunk::<12>()?;
        let is_inner = head[0] == INNER;
        Some(Head {
            kind: head[0],
            cells: u16::from_be_bytes([head[3], head[4]]),
            last: u32::from_be_bytes([head[8], head[9], head[10], head[11]]),
            places: at + if is_inner { 12 } else { 8 },
        })
    }

    /// Bytes of `page` from the start of the cell with the index `cell` to the end of the page.
    pub(super) fn cell<'p>(&self, page: &'p [u8], cell: u16) -> Option<&'p [u8]> {
        if cell >= self.cells {
            return None;
        }
        let at = self.places + 2 * usize::from(cell);
        let place = page.get(at..at + 2)?;
        page.get(usize::from(u16::from_be_bytes([place[0], place[1]]))..)
    }

    /// True for a leaf page, which contains rows.
    pub(super) fn is_leaf(&self) -> bool {
        self.kind == LEAF
    }
}

/// Calls `each` with every row of `table`. Of a truncated file, only rows on existing pages are visited.
pub(super) fn walk(
    pages: &mut Pages<'_>,
    table: &SqliteTable,
    each: &mut dyn FnMut(RowPlace, &mut Record<'_, '_>) -> Result<(), TableError>,
) -> Result<(), TableError> {
    let mut seen = HashSet::new();
    // Pages to read, the next one last, each with its depth.
    let mut open = vec![(table.root, 0)];
    while let Some((number, depth)) = open.pop() {
        if !seen.insert(number) || depth > DEPTH {
            return Err(pages.damaged(number, "the B-tree of the table leads to this page twice"));
        }
        if pages.is_beyond_cut(number) {
            continue;
        }
        let page = pages.page(number)?;
        let Some(head) = Head::of(number, &page) else {
            return Err(pages.damaged(number, "cut short"));
        };
        match head.kind {
            LEAF => {
                for cell in 0..head.cells {
                    let place = RowPlace { page: number, cell };
                    each(place, &mut Record::read(pages, table, place)?)?;
                }
            }
            INNER => {
                let mut children = Vec::with_capacity(usize::from(head.cells) + 1);
                for cell in 0..head.cells {
                    let found = head
                        .cell(&page, cell)
                        .and_then(|bytes| bytes.first_chunk::<4>());
                    let child =
                        found.ok_or_else(|| pages.damaged(number, "a cell beyond its end"))?;
                    children.push((u32::from_be_bytes(*child), depth + 1));
                }
                children.push((head.last, depth + 1));
                open.extend(children.into_iter().rev());
            }
            other => {
                return Err(pages.damaged(
                    number,
                    format!("the page has kind {other}, expected a table page"),
                ));
            }
        }
    }
    Ok(())
}
