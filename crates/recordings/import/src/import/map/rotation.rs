//! Angles in a map: channels with a period, and channels that are parts of one rotation.

use serde::Deserialize;
use taceva_core::{Channel, Channels, Orientation, SourceUnit, Unit};
use toml::Spanned;

use super::ColumnMap;
use super::check::Check;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::shown;

/// Channels that are parts of one rotation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RotationMap {
    /// Rotation vector x, y, z, or quaternion x, y, z, w.
    pub(crate) channels: Vec<String>,
    /// Column of each channel.
    pub(crate) columns: Vec<String>,
    /// Unit of the columns.
    pub(crate) unit: SourceUnit,
}

impl RotationMap {
    /// Orientation from the cells of a row; `None` for a quaternion whose norm is not 1.
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

    /// Message that `cells` are not a unit quaternion.
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

    /// Equivalent numbers: the reversed turn, or the negative quaternion; `None` for a zero vector.
    pub(crate) fn twin(&self, cells: &[f64]) -> Option<Vec<f64>> {
        let factor = match cells.len() {
            3 => {
                let length = cells.iter().map(|cell| cell * cell).sum::<f64>().sqrt();
                let turn = 360.0 / self.unit.convert(1.0);
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
    /// Adds the map's period to `channel`.
    pub(super) fn periodic(
        &self,
        channel: Channel,
        period: f64,
        offset: usize,
    ) -> Result<Channel, DatasetError> {
        let name = channel.name().to_owned();
        let whole = (1_u16..=360).find(|whole| (f64::from(*whole) - period).abs() <= 0.0);
        match whole {
            Some(degrees) if channel.unit() == Unit::Degree => {
                let periodic = channel.with_period(degrees);
                periodic.map_err(|error| self.at(offset, &error.to_string()))
            }
            _ => Err(self.at(
                offset,
                &format!(
                    "period = {period} of `{name}`: expected a whole number of degrees from 1 to 360 and an angle in deg or rad; `period = 360` is a whole turn \
                     in either unit"
                ),
            )),
        }
    }

    /// Checks the rotations: channels exist, share a unit and are in one table.
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
                        "`rotation` names `{0}`, which is no channel: add `{0} = {{ from = …, unit = … }}` to [columns]",
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
