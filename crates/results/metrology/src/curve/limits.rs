//! Limits of relative errors, similar to those of a standard, and the strictest row of limits that all figures meet.

use std::fmt;

/// Multiples of the class 1 limits. The standards define no class for these multiples.
const MULTIPLES: [u32; 6] = [5, 10, 20, 50, 100, 200];

/// A table of limits in %.
pub(super) struct Table {
    pub(super) standard: &'static str,
    /// Names of the figures that the table limits.
    pub(super) figures: &'static [&'static str],
    /// Name of each row, and the limits of the figures in this row. The strictest row is first.
    pub(super) rows: &'static [(&'static str, &'static [f64])],
}

/// Magnitude of a figure in %, or the name of the series that is missing.
pub(super) type Figure = Result<f64, &'static str>;

/// Strictest row of a table of limits that all figures meet, or the reason why there is none. The limits are similar to those of a standard.
///
/// No class is claimed, because procedure and limits differ from the standard.
///
/// This type gets no further variant: the figures meet a row, exceed all rows, or are incomplete.
///
/// ```
/// use taceva_metrology::curve::{Indication, IndicationLevel};
/// let level = IndicationLevel::new(&[Indication::new(100.0, 100.0), Indication::new(100.0, 98.0), Indication::new(100.0, 100.0)]);
/// let place = level.figures(200.0)?.standing();
/// assert_eq!(place.to_string(), "unknown: a downward series, zero readings and the resolution are missing");
/// # Ok::<(), taceva_metrology::curve::CurveUndefined>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Standing {
    /// All figures meet the limits of this row of the table.
    Within {
        /// Name of the row.
        row: &'static str,
        /// Standard that the limits resemble.
        standard: &'static str,
    },
    /// A figure exceeds the limit of the last row, which has the widest limits.
    Beyond {
        /// Figure that exceeds its limit most.
        figure: &'static str,
        /// Magnitude of the figure, %.
        value: f64,
        /// Name of the last row.
        row: &'static str,
        /// Limit of that row, %.
        end: f64,
        /// Least multiple of the class 1 limits, from 5 to 200, that covers all known figures; `None` if no multiple does.
        multiple: Option<u32>,
        /// True if no series is missing, so that the multiple covers all figures.
        is_complete: bool,
        /// Standard that the limits resemble.
        standard: &'static str,
    },
    /// Some series are missing, and no known figure exceeds the last row.
    Unknown {
        /// Names of the missing series.
        missing: Vec<&'static str>,
    },
}

impl fmt::Display for Standing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Standing::Within { row, standard } => {
                write!(
                    f,
                    "within row {row} of limits like those of {standard}, which is not a class of the standard"
                )
            }
            Standing::Beyond {
                figure,
                value,
                row,
                end,
                multiple,
                is_complete,
                standard,
            } => {
                write!(
                    f,
                    "none: {figure} = {value:.1} %, class {row} ends at {end:.2} %"
                )?;
                let known = if *is_complete { "" } else { "known figures " };
                match multiple {
                    Some(multiple) => {
                        write!(
                            f,
                            "; {known}within class 1 x {multiple}, not a class of {standard}"
                        )
                    }
                    None => write!(f, "; beyond class 1 x 200, not a class of {standard}"),
                }
            }
            Standing::Unknown { missing } => {
                let (last, first) = missing.split_last().unwrap_or((&"", &[]));
                let is = taceva_core::by_count(missing.len(), "is", "are");
                match first {
                    [] => write!(f, "unknown: {last} {is} missing"),
                    _ => write!(f, "unknown: {} and {last} {is} missing", first.join(", ")),
                }
            }
        }
    }
}

impl Table {
    /// Standing of `figures`, in the order of the table. `may_have` returns false for rows that other conditions exclude.
    pub(super) fn standing(&self, figures: &[Figure], may_have: impl Fn(&str) -> bool) -> Standing {
        let places = || figures.iter().enumerate();
        let known = || places().filter_map(|(at, figure)| Some((at, figure.ok()?)));
        let is_within =
            |ends: &[f64], times: f64| known().all(|(at, value)| value <= ends[at] * times);
        let Some((last, ends)) = self.rows.last() else {
            let missing = Vec::new();
            return Standing::Unknown { missing };
        };
        let beyond = known().map(|(at, value)| (at, value, value / ends[at]));
        let beyond = beyond.filter(|(at, value, _)| *value > ends[*at]);
        if let Some((at, value, _)) = beyond.max_by(|one, other| one.2.total_cmp(&other.2)) {
            let first = self.rows.iter().find(|(name, _)| *name == "1");
            let holds =
                |times: &u32| first.is_some_and(|(_, ends)| is_within(ends, f64::from(*times)));
            return Standing::Beyond {
                figure: self.figures[at],
                value,
                row: last,
                end: ends[at],
                multiple: MULTIPLES.into_iter().find(holds),
                is_complete: figures.iter().all(Result::is_ok),
                standard: self.standard,
            };
        }
        let mut missing: Vec<&'static str> =
            figures.iter().filter_map(|figure| figure.err()).collect();
        missing.dedup();
        let row = self
            .rows
            .iter()
            .find(|(name, ends)| may_have(name) && is_within(ends, 1.0));
        match row {
            Some((row, _)) if missing.is_empty() => Standing::Within {
                row,
                standard: self.standard,
            },
            None if missing.is_empty() => Standing::Unknown {
                missing: vec!["a force of 500 resolutions or more"],
            },
            _ => Standing::Unknown { missing },
        }
    }
}
