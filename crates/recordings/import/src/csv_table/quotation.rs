//! Tables with quoted cells. Cells are unquoted into a new text.

use std::path::Path;

use super::CsvTable;
use super::split::Block;
use crate::error::{ImportError, Place};
use taceva_dataset::internal::limits;

pub(super) fn read(path: &Path, text: &str, delimiter: u8) -> Result<CsvTable, ImportError> {
    let wrong = |line: u64, problem: String| ImportError::table(Place::line(path, line), problem);
    if text.bytes().filter(|byte| *byte == b'"').count() % 2 == 1 {
        return Err(wrong(1, "a quotation mark is never closed".to_owned()));
    }
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let mut record = csv::StringRecord::new();
    let mut names: Vec<String> = Vec::new();
    let mut unquoted = String::with_capacity(text.len());
    let mut bounds = Vec::new();
    let mut lines = Vec::new();
    while reader
        .read_record(&mut record)
        .map_err(|error| wrong(1, error.to_string()))?
    {
        let line = record.position().map_or(1, csv::Position::line);
        if names.is_empty() {
            names = record.iter().map(|name| name.trim().to_owned()).collect();
            continue;
        }
        if record.len() != names.len() {
            let found = record.len();
            let expected = names.len();
            return Err(wrong(
                line,
                format!(
                    "{}, expected {expected} as in the header",
                    taceva_core::counted(found, "cell")
                ),
            ));
        }
        for cell in &record {
            bounds.push(unquoted.len());
            unquoted.push_str(cell);
            unquoted.push('\n');
        }
        bounds.push(unquoted.len());
        lines.push(line);
    }
    let bounds: Result<Vec<u32>, _> = bounds.into_iter().map(u32::try_from).collect();
    let bounds = bounds.map_err(|_| {
        wrong(
            1,
            format!("more than {} bytes of cells", limits::TABLE_BYTES),
        )
    })?;
    let block = Block {
        rows: 0..lines.len(),
        columns: names.len(),
        bounds,
    };
    Ok(CsvTable {
        path: path.to_owned(),
        names,
        rows: lines.len(),
        text: unquoted,
        blocks: vec![block],
        lines: Some(lines),
        counted: std::sync::OnceLock::new(),
        added_lines: 0,
        left_out_lines: 0,
    })
}
