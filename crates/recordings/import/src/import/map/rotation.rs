//! Angles in a map: channels with a period, and channels that together form a rotation.

use serde::Deserialize;
use taceva_core::{Channel, Channels, Orientation, SourceUnit, Unit};
use toml::Spanned;

use super::ColumnMap;
use super::check::Check;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::shown;

/// Maximum deviation of a period in radians from whole degrees, degrees. Rounding to three decimals causes this deviation.
const ROUNDED_DEG: f64 = 0.03;

/// Full turn in `unit`: 360 for degrees, 2π for radians.
pub(crate) fn turn_in(unit: SourceUnit) -> f64 {
    360.0 / unit.convert(1.0)
}

/// Channels that together form a rotation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RotationMap {
    /// Channels of a rotation vector x, y, z, or of a quaternion x, y, z, w.
    pub(crate) channels: Vec<String>,
    /// Column of each channel.
    pub(crate) columns: Vec<String>,
    /// Unit of the columns.
    pub(crate) unit: SourceUnit,
}

impl RotationMap {
    /// Orientation of the cells of a row; `None` for a quaternion whose norm is not 1.
    pub(crate) fn orientation(&self, cells: &[f64]) -> Option<Orientation> {
        match *cells {
            [x, y, z] => {
                let radians = |cell: f64| self.unit.convert(cell).to_radians();
                Some(Orientation::of_vector([x, y, z].map(radians)))
            }
            [x, y, z, w] => Orientation::of_quaternion([x, y, z, w]),
            _ => None,
        }
    }

    /// Error message for `cells` that are not a unit quaternion.
    pub(crate) fn no_rotation(cells: &[f64]) -> String {
        let length = cells.iter().map(|cell| cell * cell).sum::<f64>().sqrt();
        format!(
            "{cells:?} is not a unit quaternion: its norm is {length}, expected 1; if it marks a missing value, leave out the row by \
             [drop.placeholders], or correct the table"
        )
    }

    /// Components of `orientation`, in the unit of the columns.
    pub(crate) fn cells(&self, orientation: Orientation) -> Vec<f64> {
        match self.columns.len() {
            3 => {
                let scale = self.unit.convert(1.0);
                let vector = orientation.vector().into_iter();
                vector.map(|part| part.to_degrees() / scale).collect()
            }
            _ => orientation.quaternion().to_vec(),
        }
    }

    /// Numbers for the same rotation: the reverse axis with the remaining angle, or the negative quaternion. `None` for a zero vector.
    pub(crate) fn twin(&self, cells: &[f64]) -> Option<Vec<f64>> {
        let factor = match cells.len() {
            3 => {
                let length = cells.iter().map(|cell| cell * cell).sum::<f64>().sqrt();
                let turn = turn_in(self.unit);
                (length > turn * 1e-9).then(|| 1.0 - turn / length)?
            }
            _ => -1.0,
        };
        Some(cells.iter().map(|cell| cell * factor).collect())
    }
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "[\"Rx\", \"Ry\", \"Rz\"], the channels of a rotation vector, four of a quaternion x, y, z, w, or a list of such lists"
)]
pub(super) enum WrittenRotations {
    One(Vec<String>),
    Several(Vec<Vec<String>>),
}

impl Check<'_> {
    /// Adds the period that the map states, in the unit `unit` of the column, to `channel`.
    pub(super) fn periodic(
        &self,
        channel: Channel,
        period: f64,
        unit: SourceUnit,
        offset: usize,
    ) -> Result<Channel, DatasetError> {
        let is_in_radians = unit.symbol() == "rad";
        let whole = match is_in_radians {
            true => whole_degrees(period.to_degrees(), ROUNDED_DEG),
            false => whole_degrees(period, 0.0),
        };
        let expected = match whole {
            _ if channel.unit() != Unit::Degree => "an angle in deg or rad".to_owned(),
            Some(degrees) => {
                let periodic = channel.with_period(degrees);
                return periodic.map_err(|error| self.at(offset, &error.to_string()));
            }
            None => match (is_in_radians, whole_degrees(period, 0.0)) {
                (true, Some(degrees)) => format!(
                    "{} in rad, or `unit = \"deg\"` if the numbers are degrees",
                    f64::from(degrees).to_radians()
                ),
                (true, None) => "whole degrees in rad, such as 6.283185307179586".to_owned(),
                (false, _) => match whole_degrees(period.to_degrees(), ROUNDED_DEG) {
                    Some(degrees) => {
                        format!("{degrees} in deg, or `unit = \"rad\"` if the numbers are radians")
                    }
                    None => "a whole number of degrees from 1 to 360".to_owned(),
                },
            },
        };
        Err(self.at(
            offset,
            &format!(
                "period = {period} of `{}`: expected {expected}",
                channel.name()
            ),
        ))
    }

    /// Checks the rotations. Their channels must exist, share a unit and be in one table.
    pub(super) fn rotations(
        &self,
        written: Option<Spanned<WrittenRotations>>,
        channels: &Channels,
        columns: &[ColumnMap],
    ) -> Result<Vec<RotationMap>, DatasetError> {
        let Some(written) = written else {
            return Ok(Vec::new());
        };
        let offset = written.span().start;
        let lists = match written.into_inner() {
            WrittenRotations::One(list) => vec![list],
            WrittenRotations::Several(lists) => lists,
        };
        let mut seen: Vec<String> = Vec::new();
        let maps = lists.into_iter().map(|names| {
            if let Some(twice) = names.iter().find(|name| {
                seen.contains(name) || names.iter().filter(|other| other == name).count() > 1
            }) {
                return Err(self.at(
                    offset,
                    &format!("`rotation` names `{}` twice", shown(twice)),
                ));
            }
            seen.extend(names.iter().cloned());
            self.rotation(names, offset, channels, columns)
        });
        maps.collect()
    }

    fn rotation(
        &self,
        names: Vec<String>,
        offset: usize,
        channels: &Channels,
        columns: &[ColumnMap],
    ) -> Result<RotationMap, DatasetError> {
        let unit = match names.len() {
            3 => Unit::Degree,
            4 => Unit::One,
            other => {
                return Err(self.at(
                    offset,
                    &format!(
                        "`rotation` lists {other} channels, expected three of a rotation vector (x, y, z) or four of a quaternion (x, y, z, w)"
                    ),
                ));
            }
        };
        let mut parts: Vec<&ColumnMap> = Vec::new();
        for name in &names {
            let Some(at) = channels.position(name) else {
                return Err(self.at(
                    offset,
                    &format!(
                        "`rotation` names `{0}`, which is not a channel: add `{0} = {{ from = …, unit = … }}` to [columns]",
                        shown(name)
                    ),
                ));
            };
            let channel = &channels.as_slice()[at];
            let column = &columns[at];
            if channel.unit() != unit || channel.period().is_some() || column.is_moved() {
                let expected = match names.len() {
                    3 => "\"rad\" or \"deg\"",
                    _ => "\"1\"",
                };
                return Err(self.at(
                    offset,
                    &format!(
                        "`{name}` is a part of `rotation`: its unit is {expected}, and it has no `period`, `offset` or `scale`"
                    ),
                ));
            }
            parts.push(column);
        }
        let source = |column: &ColumnMap| {
            let join = column.from.split_once('.').map(|(join, _)| join.to_owned());
            (join, column.unit.symbol())
        };
        if parts.iter().any(|part| source(part) != source(parts[0]))
            || parts.iter().any(|part| part.from.starts_with("[[matrix]]"))
        {
            return Err(self.at(
                offset,
                &format!(
                    "the parts of a rotation must be in one table and one unit, outside of [[matrix]]: correct `from` and `unit` of {}",
                    names.join(", ")
                ),
            ));
        }
        Ok(RotationMap {
            unit: parts[0].unit,
            columns: parts.iter().map(|part| part.from.clone()).collect(),
            channels: names,
        })
    }
}

/// Whole number of degrees, from 1 to 360, that differs from `degrees` by at most `rounding`.
fn whole_degrees(degrees: f64, rounding: f64) -> Option<u16> {
    (1..=360).find(|whole| (f64::from(*whole) - degrees).abs() <= rounding)
}
