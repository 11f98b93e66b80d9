//! Columns of a table.

use taceva_metrics::Better;

use super::Words;

/// Column: name, unit, better direction and alignment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// Name in the head of the column.
    pub name: Words,
    /// Common unit of the cells; `None` without a common unit.
    pub unit: Option<String>,
    /// Better direction of the cells.
    pub direction: Direction,
    /// Alignment of the cells.
    pub align: Align,
}

/// Better direction of numbers: a sign for readers, a word for programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// The cells are not scores.
    #[default]
    None,
    /// Same direction for the whole column, shown to readers as a sign in the head. Output for programs omits the direction.
    Is(Better),
    /// Direction by the metric or variant in this column. Readers see a sign after the name; programs get an additional column `better`.
    OfMetrics,
    /// Direction by [`Row::better`](super::Row::better), shown as for [`Direction::OfMetrics`].
    OfRows,
}

/// Alignment of cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Align {
    /// Right-aligned if the column contains only numbers.
    #[default]
    Auto,
    /// Left-aligned.
    Left,
    /// Right-aligned.
    Right,
    /// In plain text, numbers are right-aligned and other cells left-aligned. Other formats use [`Align::Auto`].
    ByCell,
}

impl Direction {
    /// True if each row has its own direction.
    pub(super) fn is_by_row(self) -> bool {
        matches!(self, Direction::OfMetrics | Direction::OfRows)
    }
}

impl Column {
    /// Column without unit and direction.
    pub fn new(name: impl Into<Words>) -> Column {
        Column {
            name: name.into(),
            ..Column::default()
        }
    }

    /// Column for names of metrics or variants, which determine the direction of each row.
    pub fn of_metrics() -> Column {
        Column::new("metric").direction(Direction::OfMetrics)
    }

    /// Sets the unit.
    #[must_use]
    pub fn unit(self, unit: impl Into<String>) -> Column {
        Column {
            unit: Some(unit.into()),
            ..self
        }
    }

    /// Sets the direction.
    #[must_use]
    pub fn direction(self, direction: Direction) -> Column {
        Column { direction, ..self }
    }

    /// Sets the alignment.
    #[must_use]
    pub fn align(self, align: Align) -> Column {
        Column { align, ..self }
    }

    /// Name and unit: `fit (s)`.
    pub fn title(&self) -> String {
        match &self.unit {
            Some(unit) => format!("{} ({unit})", self.name.plain()),
            None => self.name.plain().to_owned(),
        }
    }

    /// Head for readers, with its direction sign.
    pub(super) fn head(&self) -> Words {
        let words = match &self.unit {
            Some(_) => Words::new(self.title()),
            None => self.name.clone(),
        };
        match self.direction {
            Direction::Is(better) => words.directed(Some(better)),
            _ => words,
        }
    }
}

impl From<&str> for Column {
    fn from(name: &str) -> Column {
        Column::new(name)
    }
}
