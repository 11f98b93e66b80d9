//! What a column of a table holds.

use taceva_metrics::Better;

use super::Words;

/// A column: what its cells are, in which unit, and whether lower or higher ones are better.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// Its name.
    pub name: Words,
    /// Their unit, where all have the same.
    pub unit: Option<String>,
    /// Whether lower or higher ones are better.
    pub direction: Direction,
    /// On which side they stand.
    pub align: Align,
}

/// Whether lower or higher numbers are better; people read a sign, programs a word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// The cells are no scores.
    #[default]
    None,
    /// All of the column alike: people find the sign in the head; programs know the column by its name.
    Is(Better),
    /// Row by row, as the metric or variant says that the cell of this column names: people find the sign behind it, programs the word in a
    /// column `better` beside it.
    OfMetrics,
    /// The same, as [`Row::better`](super::Row::better) says.
    OfRows,
}

/// On which side cells stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Align {
    /// To the right where the column holds numbers only.
    #[default]
    Auto,
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// In plain text each number to the right and other cells to the left; elsewhere as [`Align::Auto`].
    ByCell,
}

impl Direction {
    /// Whether each row has its own.
    pub(super) fn is_by_row(self) -> bool {
        matches!(self, Direction::OfMetrics | Direction::OfRows)
    }
}

impl Column {
    /// A column without unit and direction.
    pub fn new(name: impl Into<Words>) -> Column {
        Column {
            name: name.into(),
            ..Column::default()
        }
    }

    /// A column of names of metrics or variants.
    pub fn of_metrics() -> Column {
        Column::new("metric").direction(Direction::OfMetrics)
    }

    /// The same with a unit.
    #[must_use]
    pub fn unit(self, unit: impl Into<String>) -> Column {
        Column {
            unit: Some(unit.into()),
            ..self
        }
    }

    /// The same with a direction.
    #[must_use]
    pub fn direction(self, direction: Direction) -> Column {
        Column { direction, ..self }
    }

    /// The same on another side.
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

    /// The head as people read it, with the sign of its direction.
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
