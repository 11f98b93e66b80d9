//! Corrections of forces: subtraction of the zero and of the weight of a tool.

use serde::Deserialize;
use taceva_core::{Channels, SourceUnit, Unit};
use toml::Spanned;

use super::RotationMap;
use super::check::{Check, ColumnName};
use taceva_dataset::DatasetError;
use taceva_dataset::internal::shown;

/// Rows whose mean is subtracted from forces and torques.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ZeroMap {
    pub(crate) rows: ZeroRows,
    /// Column whose equal cells form a block with a separate zero; `None` for one block per table.
    pub(crate) block: Option<String>,
    /// Positions of the corrected channels among the channels of the map, from 0.
    pub(crate) channels: Vec<usize>,
}

/// Rule that selects the rows of a block at zero force.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ZeroRows {
    /// This number of rows at the beginning of the block.
    First(usize),
    /// Rows whose number in a column is below or above a limit.
    Beside {
        column: String,
        limit: f64,
        is_below: bool,
    },
}

impl ZeroMap {
    /// Describes the zero: the mean of certain rows of each block or table.
    pub(crate) fn rule(&self) -> String {
        let rows = match &self.rows {
            ZeroRows::First(count) => format!("first {count} rows"),
            ZeroRows::Beside {
                column,
                limit,
                is_below,
            } => {
                let side = if *is_below { "below" } else { "above" };
                format!("rows with `{}` {side} {limit}", shown(column))
            }
        };
        match &self.block {
            Some(block) => format!("mean of the {rows} of each `{}`", shown(block)),
            None => format!("mean of the {rows} of each table"),
        }
    }

    /// Columns that select the zero rows and the blocks.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &String> {
        let column = match &self.rows {
            ZeroRows::First(_) => None,
            ZeroRows::Beside { column, .. } => Some(column),
        };
        column.into_iter().chain(&self.block)
    }
}

/// Weight of a tool on the transducer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GravityMap {
    /// Mass, kg.
    pub(crate) mass: f64,
    /// Centre of mass in the frame of the transducer, mm.
    pub(crate) centre: [f64; 3],
    /// Orientation of the transducer in a frame whose z axis points up.
    pub(crate) orientation: RotationMap,
    /// Positions of Fx, Fy, Fz, Tx, Ty and Tz among the channels; `None` for a missing channel.
    pub(crate) channels: [Option<usize>; 6],
}

impl GravityMap {
    /// Describes the subtracted weight: mass, centre of mass, and columns of the orientation.
    pub(crate) fn rule(&self) -> String {
        format!(
            "weight of {} kg at {:?} mm, turned by {}",
            self.mass,
            self.centre,
            self.orientation.columns.join(", ")
        )
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenZero {
    from: Spanned<String>,
    column: Option<ColumnName>,
    below: Option<f64>,
    above: Option<f64>,
    block: Option<ColumnName>,
    channels: Option<Spanned<Vec<String>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenGravity {
    mass: f64,
    centre: [f64; 3],
    orientation: Option<Spanned<Vec<ColumnName>>>,
    unit: Option<Spanned<String>>,
}

impl Check<'_> {
    pub(super) fn zero(
        &self,
        written: WrittenZero,
        channels: &Channels,
    ) -> Result<ZeroMap, DatasetError> {
        let offset = written.from.span().start;
        let from = written.from.get_ref().as_str();
        let limits = (written.column, written.below, written.above);
        let count = from.strip_prefix("first ").map(str::trim).map(str::parse);
        let rows = match (from, count, limits) {
            (_, Some(Ok(count)), (None, None, None)) if count > 0 => ZeroRows::First(count),
            ("without contact", _, (Some(column), below, above))
                if below.is_some() != above.is_some() =>
            {
                ZeroRows::Beside {
                    column: column.into_name(),
                    limit: below.or(above).unwrap_or_default(),
                    is_below: below.is_some(),
                }
            }
            ("without contact", ..) => {
                return Err(self.at(
                    offset,
                    "`from = \"without contact\"` needs a column that shows contact and a limit: `column = \"contact\", below = 0.5`, or \
                     `above`; an import does not detect contact in pictures",
                ));
            }
            _ => {
                return Err(self.at(
                    offset,
                    &format!(
                        "`{}`: expected `from = \"first 10\"`, or `from = \"without contact\"` with `column` and `below` or `above`",
                        shown(from)
                    ),
                ));
            }
        };
        let is_force = |unit: Unit| matches!(unit, Unit::Newton | Unit::NewtonMillimetre);
        let found = match &written.channels {
            None => {
                let all = channels.iter().enumerate();
                let forces = all.filter(|(_, channel)| is_force(channel.unit()));
                forces.map(|(position, _)| position).collect()
            }
            Some(names) => {
                let positions = names.get_ref().iter().map(|name| {
                    channels.position(name).ok_or_else(|| {
                        let problem = format!("`{}` is not a channel of [columns]", shown(name));
                        self.at(names.span().start, &problem)
                    })
                });
                positions.collect::<Result<Vec<usize>, DatasetError>>()?
            }
        };
        if found.is_empty() {
            return Err(self.at(
                offset,
                "[zero] applies to forces and torques, and [columns] has none; name other channels by `channels = [\"NAME\"]`",
            ));
        }
        Ok(ZeroMap {
            rows,
            block: written.block.map(ColumnName::into_name),
            channels: found,
        })
    }

    pub(super) fn gravity(
        &self,
        written: Spanned<WrittenGravity>,
        channels: &Channels,
    ) -> Result<GravityMap, DatasetError> {
        let offset = written.span().start;
        let written = written.into_inner();
        let Some(orientation) = written.orientation else {
            return Err(self.at(
                offset,
                "[gravity] needs `orientation`, which decides how the weight of the tool splits into axes. Write `orientation = [\"rx\", \"ry\", \"rz\"]` with `unit`, or four columns of a quaternion x, y, z, w. For a tool that never turns use [zero]",
            ));
        };
        let columns = orientation.get_ref().iter().cloned();
        let columns: Vec<String> = columns.map(ColumnName::into_name).collect();
        let unit = match (&written.unit, columns.len()) {
            (None, 4) => SourceUnit::parse("1").ok(),
            (Some(unit), 3) => Some(self.unit(unit)?).filter(|unit| unit.unit() == Unit::Degree),
            _ => None,
        };
        let Some(unit) = unit else {
            return Err(self.at(
                orientation.span().start,
                "`orientation` must name three columns of a rotation vector with `unit = \"rad\"` or \"deg\", or four of a quaternion x, \
                 y, z, w without a unit",
            ));
        };
        let numbers = [&[written.mass][..], &written.centre].concat();
        if written.mass <= 0.0 || numbers.iter().any(|number| !number.is_finite()) {
            return Err(self.at(
                offset,
                "`mass` must be in kg and above 0, and `centre` must be three lengths in mm",
            ));
        }
        let names = ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"];
        let found = names.map(|name| {
            let position = channels.position(name)?;
            let unit = channels.as_slice()[position].unit();
            matches!(unit, Unit::Newton | Unit::NewtonMillimetre).then_some(position)
        });
        if found.iter().all(Option::is_none) {
            return Err(self.at(
                offset,
                "[gravity] applies to Fx, Fy, Fz, Tx, Ty and Tz, and [columns] has none of them",
            ));
        }
        Ok(GravityMap {
            mass: written.mass,
            centre: written.centre,
            orientation: RotationMap {
                channels: Vec::new(),
                columns,
                unit,
            },
            channels: found,
        })
    }
}
