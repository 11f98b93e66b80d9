//! Reads columns of arrays as texts.

use taceva_arrays::{ArrayInfo, ArrayValues};
use taceva_tables::Cell;

use super::ArrayRows;
use super::attributes::{self, problem};
use super::cells::Texts;
use super::group::{Group, candidates};

/// Maximum size of the text of a column in memory, bytes.
const COLUMN_BYTES: u64 = 1 << 30;
/// Maximum number of values of a cell that contains a whole array.
const CELL_VALUES: u64 = 1 << 16;

impl ArrayRows {
    /// Reads a whole array as one cell.
    fn whole_cell(&self, path: &str, info: &ArrayInfo) -> Result<String, String> {
        let elements = info
            .shape
            .iter()
            .try_fold(1_u64, |product, side| product.checked_mul(*side));
        let elements = elements.unwrap_or(u64::MAX);
        if elements > CELL_VALUES {
            return Err(format!(
                "{elements} values, more than the {CELL_VALUES} that a cell holds; without `whole = true` each position along the first \
                 axis is a row"
            ));
        }
        let read = self.file.read(path, 0..info.rows()).map_err(problem)?;
        let sides = info.shape.iter().map(|side| usize::try_from(*side));
        let shape: Result<Vec<usize>, _> = sides.collect();
        let shape = shape.map_err(|error| error.to_string())?;
        Ok(Texts(&read.values).packed(0, &shape))
    }

    /// Path and description of the array to which `name` in a map refers, searched from `group`.
    pub(super) fn info(&self, group: &Group, name: &str) -> Option<(String, &ArrayInfo)> {
        candidates(&group.path, name)
            .into_iter()
            .find_map(|path| self.file.info(&path).map(|info| (path, info)))
    }

    pub(super) fn attribute(&self, group: &Group, name: &str) -> Option<String> {
        let (owner, attribute) = name.rsplit_once('@')?;
        let owner = owner.trim_end_matches('/');
        let owner = match owner {
            "" => group.path.clone(),
            _ => format!("{}/{owner}", group.path),
        };
        let owner = if owner.is_empty() { "/" } else { &owner };
        self.file.attribute(owner, attribute)
    }

    /// Unit of a time column as stated by the file; `None` for other columns.
    pub(super) fn unit_of_times(&self, group: &Group, name: &str) -> Option<&'static str> {
        let (path, _) = self.info(group, name)?;
        attributes::unit_of_times(&self.file, &path)
    }

    pub(super) fn cells(&self, group: &Group, name: &str) -> Result<Vec<String>, String> {
        if let Some(text) = self.attribute(group, name) {
            return Ok(vec![text; group.rows]);
        }
        if name == "group" && !group.path.is_empty() {
            let between = if group.path.contains('/') { '/' } else { '.' };
            let last = group.path.rsplit(between).next().unwrap_or_default();
            return Ok(vec![last.to_owned(); group.rows]);
        }
        let (path, info) = self
            .info(group, name)
            .ok_or_else(|| format!("there is no array of this name in `{}`", group.path))?;
        if self.is_whole {
            return self.whole_cell(&path, info).map(|cell| vec![cell]);
        }
        let across = info
            .row_elements()
            .ok_or("its rows exceed the address space")?;
        if across.saturating_mul(info.rows()) > COLUMN_BYTES / 8 {
            return Err(format!(
                "{} rows of {across} values are too many for labels: `[frame] array = \"{name}\"` reads frames",
                info.rows()
            ));
        }
        let is_scalar = info.shape.is_empty() || (info.rows() == 1 && group.rows != 1);
        if !is_scalar && info.rows() != group.rows as u64 {
            return Err(format!(
                "{} values along its first axis, expected {} as in the other arrays",
                info.rows(),
                group.rows
            ));
        }
        let read = self.file.read(&path, 0..info.rows()).map_err(problem)?;
        let sides = info.shape.iter().skip(1);
        let shape: Result<Vec<usize>, _> = sides.map(|side| usize::try_from(*side)).collect();
        let shape = shape.map_err(|error| error.to_string())?;
        if let (Some(unit), ArrayValues::I64(times)) =
            (self.unit_of_times(group, name), &read.values)
            && !is_scalar
            && shape.is_empty()
        {
            return Ok(times.iter().map(|time| seconds(*time, unit)).collect());
        }
        let texts = Texts(&read.values);
        let width = usize::try_from(across).map_err(|error| error.to_string())?;
        let cell = |row: usize| texts.packed(row * width, &shape);
        Ok(match is_scalar {
            true => vec![cell(0); group.rows],
            false => (0..group.rows).map(cell).collect(),
        })
    }
}

/// Converts a NumPy time to seconds without loss of digits. "Not a time" becomes an empty cell.
fn seconds(time: i64, unit: &str) -> String {
    let nanoseconds = match unit {
        "s" => 1_000_000_000,
        "ms" => 1_000_000,
        "us" => 1_000,
        _ => 1_i128,
    };
    match time {
        i64::MIN => String::new(),
        time => Cell::Time(i128::from(time) * nanoseconds)
            .text()
            .into_owned(),
    }
}
