//! Subtracts the zero of forces and the weight of a tool.

use std::collections::BTreeMap;

use super::MappedTable;
use crate::error::ImportError;
use crate::import::map::{GravityMap, RotationMap, ZeroMap, ZeroRows};
use crate::import::warning::ImportWarning;
use taceva_dataset::internal::shown;

/// Standard acceleration of gravity, m/s².
const FREE_FALL: f64 = 9.806_65;
/// Maximum spread of the zero rows, as a fraction of the spread of all rows of a block. The import warns of a greater spread.
const SPREAD: f64 = 0.2;

/// Zeros that are subtracted from the channels of each block of rows.
pub(in crate::import) struct Zeros {
    /// Index of the block of each row.
    blocks: Vec<usize>,
    /// Zero of each channel of the map, by block, in the unit of the channel.
    means: Vec<Vec<f64>>,
}

impl Zeros {
    /// Minimum and maximum zero of the channel at `position` of the map, with the number of blocks.
    pub(in crate::import) fn range(&self, position: usize) -> ([f64; 2], u64) {
        let means = self.means.iter().map(|block| block[position]);
        let least = means.clone().fold(f64::INFINITY, f64::min);
        let greatest = means.fold(f64::NEG_INFINITY, f64::max);
        ([least, greatest], self.means.len() as u64)
    }
}

/// Kept rows that share a zero, each with true for a row at zero force.
type Block = Vec<(usize, bool)>;

impl MappedTable<'_> {
    /// Numbers of a row, one per channel, as stored in the dataset.
    pub(super) fn truth(&self, row: usize) -> Result<Vec<Option<f64>>, ImportError> {
        let mut labels = self.measured(row)?;
        if let Some((map, zeros)) = self.map.zero.as_ref().zip(self.zeros.as_ref()) {
            let means = &zeros.means[zeros.blocks[row]];
            for (position, mean) in map.channels.iter().zip(means) {
                labels[*position] = labels[*position].map(|label| label - mean);
            }
        }
        Ok(labels)
    }

    /// Computes the zeros of `map`.
    ///
    /// # Errors
    /// [`ImportError::Table`] for a block with too few zero rows, or with cells that are not numbers.
    pub(super) fn find_zeros(&mut self, map: &ZeroMap) -> Result<(), ImportError> {
        let column = match &map.rows {
            ZeroRows::First(_) => None,
            ZeroRows::Beside { column, .. } => Some(self.table.position(column)?),
        };
        let block_column = map.block.as_ref();
        let block_column = block_column.map(|block| self.table.position(block));
        let block_column = block_column.transpose()?;
        let mut names: BTreeMap<String, usize> = BTreeMap::new();
        let mut blocks: Vec<Block> = Vec::new();
        let mut of_rows = Vec::with_capacity(self.rows());
        for row in 0..self.rows() {
            let name = block_column.map_or("", |column| self.table.cell(row, column));
            let block = *names.entry(name.to_owned()).or_insert_with(|| {
                blocks.push(Block::new());
                blocks.len() - 1
            });
            of_rows.push(block);
            if !self.drop_reasons(row).is_empty() {
                continue;
            }
            let rows = &mut blocks[block];
            let is_at_zero = match &map.rows {
                ZeroRows::First(count) => rows.len() < *count,
                ZeroRows::Beside {
                    limit, is_below, ..
                } => {
                    let number = column.map(|column| self.table.number(row, column));
                    let number = number.transpose()?.flatten();
                    number.is_some_and(|number| match is_below {
                        true => number < *limit,
                        false => number > *limit,
                    })
                }
            };
            rows.push((row, is_at_zero));
        }
        let mut means = vec![Vec::new(); blocks.len()];
        for (name, block) in &names {
            // All rows of the block are dropped.
            if blocks[*block].is_empty() {
                means[*block] = vec![0.0; map.channels.len()];
                continue;
            }
            means[*block] = self.means(map, name, &blocks[*block])?;
        }
        self.zeros = Some(Zeros {
            blocks: of_rows,
            means,
        });
        Ok(())
    }

    /// Zero of each channel in the block called `name`.
    fn means(
        &mut self,
        map: &ZeroMap,
        name: &str,
        block: &[(usize, bool)],
    ) -> Result<Vec<f64>, ImportError> {
        let place = self.place(block[0].0);
        let refused = |problem: String| ImportError::table(place.clone(), problem);
        let whose = match name {
            "" => "this table".to_owned(),
            name => format!("block `{}`", shown(name)),
        };
        let count = block.iter().filter(|(_, is_at_zero)| *is_at_zero).count();
        match &map.rows {
            ZeroRows::First(wanted) if count < *wanted => {
                return Err(refused(format!(
                    "[zero] averages the first {wanted} rows, but {whose} keeps only {count}: write `from = \"first {count}\"` or fewer"
                )));
            }
            ZeroRows::Beside { column, limit, .. } if count == 0 => {
                return Err(refused(format!(
                    "[zero] averages the {}, but {whose} has none: correct the limit {limit} of `{}`, or write `from = \"first 10\"`",
                    map.rule().trim_start_matches("mean of the "),
                    shown(column)
                )));
            }
            _ => {}
        }
        let all: Result<Vec<Vec<Option<f64>>>, ImportError> =
            block.iter().map(|(row, _)| self.measured(*row)).collect();
        let all = all?;
        let mut means = Vec::new();
        for position in &map.channels {
            let channel = self.map.channels.as_slice()[*position].name().to_owned();
            let pairs = block.iter().zip(&all);
            let pairs = pairs.filter(|((_, is_at_zero), _)| *is_at_zero);
            let at_zero: Vec<f64> = pairs.filter_map(|(_, labels)| labels[*position]).collect();
            if at_zero.is_empty() {
                return Err(refused(format!(
                    "`{channel}` has no value in the rows of {whose} that [zero] averages: leave this channel out by `channels` of [zero]"
                )));
            }
            means.push(at_zero.iter().sum::<f64>() / at_zero.len() as f64);
            let all: Vec<f64> = all.iter().filter_map(|labels| labels[*position]).collect();
            if all.len() > at_zero.len() && spread(&at_zero) > SPREAD * spread(&all) {
                self.warnings.push(ImportWarning::ZeroSpread {
                    channel,
                    rule: map.rule(),
                });
            }
        }
        Ok(means)
    }

    /// Subtracts the weight of the tool from the forces and torques of a row, in the transducer's frame.
    pub(super) fn take_weight(
        &self,
        row: usize,
        map: &GravityMap,
        labels: &mut [Option<f64>],
    ) -> Result<(), ImportError> {
        let mut cells = Vec::new();
        for name in &map.orientation.columns {
            let column = self.table.position(name)?;
            let Some(number) = self.table.number(row, column)? else {
                return Err(self.wrong(
                    row,
                    column,
                    "empty, expected the orientation that [gravity] needs",
                ));
            };
            cells.push(number);
        }
        let orientation = map
            .orientation
            .orientation(&cells)
            .ok_or_else(|| ImportError::table(self.place(row), RotationMap::no_rotation(&cells)))?;
        let weight = orientation.into_body([0.0, 0.0, -map.mass * FREE_FALL]);
        let [x, y, z] = map.centre;
        let [a, b, c] = weight;
        let torque = [y * c - z * b, z * a - x * c, x * b - y * a];
        let all = weight.into_iter().chain(torque);
        for (position, part) in map.channels.iter().zip(all) {
            if let Some(position) = position {
                labels[*position] = labels[*position].map(|label| label - part);
            }
        }
        Ok(())
    }
}

/// Range of `numbers`: maximum minus minimum.
fn spread(numbers: &[f64]) -> f64 {
    let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    greatest - least
}
