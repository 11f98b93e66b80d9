//! Converts array values to cells of a table.

use taceva_arrays::ArrayValues;

use crate::foreign::cell_list;

/// Array values as the cells of a table.
pub(super) struct Texts<'a>(pub(super) &'a ArrayValues);

impl Texts<'_> {
    /// Values from `first` on as nested lists of the shape `shape`. A text in a list is quoted if it could be taken for several values.
    pub(super) fn packed(&self, first: usize, shape: &[usize]) -> String {
        match shape {
            [] => self.one(first),
            _ => self.list(first, shape),
        }
    }

    fn list(&self, first: usize, shape: &[usize]) -> String {
        let Some((count, rest)) = shape.split_first() else {
            let one = self.one(first);
            return match self.0 {
                ArrayValues::Text(_) => cell_list::member(one),
                _ => one,
            };
        };
        let width: usize = rest.iter().product();
        let parts: Vec<String> = (0..*count)
            .map(|at| self.list(first + at * width, rest))
            .collect();
        format!("[{}]", parts.join(", "))
    }

    fn one(&self, at: usize) -> String {
        match self.0 {
            ArrayValues::Bool(all) => all[at].to_string(),
            ArrayValues::U8(all) => all[at].to_string(),
            ArrayValues::U16(all) => all[at].to_string(),
            ArrayValues::U32(all) => all[at].to_string(),
            ArrayValues::U64(all) => all[at].to_string(),
            ArrayValues::I8(all) => all[at].to_string(),
            ArrayValues::I16(all) => all[at].to_string(),
            ArrayValues::I32(all) => all[at].to_string(),
            ArrayValues::I64(all) => all[at].to_string(),
            ArrayValues::F32(all) => number(f64::from(all[at])),
            ArrayValues::F64(all) => number(all[at]),
            ArrayValues::Text(all) => all[at].clone(),
            _ => String::new(),
        }
    }
}

/// Number as a cell; NaN becomes an empty cell.
fn number(value: f64) -> String {
    match value.is_nan() {
        true => String::new(),
        false => format!("{value:?}"),
    }
}
