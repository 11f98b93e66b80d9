//! Table with the time of each frame.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use taceva_core::shown;

use super::error::SourceError;
use super::limits;

/// Row of the table: frame name, time and line number.
#[derive(Debug)]
pub(super) struct TimedName {
    pub(super) name: String,
    pub(super) time_s: f64,
    pub(super) line: u64,
}

/// Reads a CSV table with the columns `file` and `t_s`. Times must be finite and strictly increasing.
pub(super) fn read(path: &Path) -> Result<Vec<TimedName>, SourceError> {
    let fault = |line: Option<u64>, problem: String| SourceError::Times {
        path: path.to_owned(),
        line,
        problem,
    };
    let file = File::open(path).map_err(SourceError::io("open", path))?;
    let length = file
        .metadata()
        .map_err(SourceError::io("read", path))?
        .len();
    if length > limits::TABLE_BYTES {
        let most = limits::TABLE_BYTES;
        return Err(fault(
            None,
            format!("{length} bytes, expected at most {most}"),
        ));
    }
    let mut table = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_reader(file.take(limits::TABLE_BYTES));
    let unreadable = |error: csv::Error| {
        let line = error.position().map(csv::Position::line);
        fault(line, shown(&error.to_string()).to_string())
    };
    let header = table.headers().map_err(unreadable)?.clone();
    let column = |name: &str| {
        header
            .iter()
            .position(|found| found == name)
            .ok_or_else(|| {
                fault(
                    Some(1),
                    format!("no column `{name}`, expected `file` and `t_s`"),
                )
            })
    };
    let (file_column, time_column) = (column("file")?, column("t_s")?);
    let mut rows: Vec<TimedName> = Vec::new();
    for record in table.records() {
        let record = record.map_err(unreadable)?;
        let line = record.position().map_or(0, csv::Position::line);
        let text = |column: usize| record.get(column).unwrap_or_default();
        let written = text(time_column);
        let time_s = written.parse().ok().filter(|time: &f64| time.is_finite());
        let Some(time_s) = time_s else {
            let problem = format!("`{}` is not a time, expected seconds", shown(written));
            return Err(fault(Some(line), problem));
        };
        if let Some(before) = rows.last().filter(|before| time_s <= before.time_s) {
            let problem = format!(
                "{time_s} s follows {} s, expected increasing times",
                before.time_s
            );
            return Err(fault(Some(line), problem));
        }
        if rows.len() == limits::FRAMES {
            return Err(fault(
                Some(line),
                format!("more than {} rows", limits::FRAMES),
            ));
        }
        rows.push(TimedName {
            name: text(file_column).to_owned(),
            time_s,
            line,
        });
    }
    Ok(rows)
}
