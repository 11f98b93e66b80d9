//! Sums over light presses, and the number of presses at each place.

use crate::exact::ExactSum;
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::families::cells::{Cells, add_times};
use crate::pair::Paired;

/// Sums over light presses, and the number of presses at each place.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LightSums {
    pub(super) n_invalid: u64,
    pub(super) line: LineSums,
    pub(super) places: Cells<Presses>,
}

/// Sums for a line through light presses, with x the true and y the predicted force.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LineSums {
    pub(super) n: u64,
    /// Σ x, Σ y, Σ x², Σ x y and Σ y² over presses, with true force x and predicted force y, N.
    pub(super) sums: [ExactSum; 5],
    /// Least and greatest true force; `None` without presses.
    pub(super) range: Option<Forces>,
}

/// Least and greatest true force of light presses, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Forces {
    pub(super) least: f64,
    pub(super) greatest: f64,
}

/// Number of presses at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Presses(pub(super) u64);

impl Merge for Presses {
    fn merge(&mut self, other: &Presses) {
        self.0 = self.0.saturating_add(other.0);
    }
}

impl Forces {
    fn and(self, other: Forces) -> Forces {
        Forces {
            least: self.least.min(other.least),
            greatest: self.greatest.max(other.greatest),
        }
    }
}

impl LineSums {
    /// Adds a press.
    pub(super) fn add(&mut self, pair: Paired<f64>) {
        let Paired {
            estimate: y,
            reference: x,
        } = pair;
        self.n += 1;
        let [of_x, of_y, xx, xy, yy] = &mut self.sums;
        of_x.add(x);
        of_y.add(y);
        xx.add_product(x, x);
        xy.add_product(x, y);
        yy.add_product(y, y);
        let own = Forces {
            least: x,
            greatest: x,
        };
        self.range = Some(self.range.map_or(own, |range| range.and(own)));
    }
}

impl LightSums {
    /// Converts the sums to a record for a saved state.
    pub(super) fn to_record(&self) -> Record {
        let line = &self.line;
        let range = line.range.map(|range| vec![range.least, range.greatest]);
        Record {
            counts: vec![line.n, self.n_invalid, u64::from(self.places.are_named())],
            sums: line.sums.to_vec(),
            values: range.unwrap_or_default(),
            cells: self.places.to_records(|presses| Record {
                counts: vec![presses.0],
                ..Record::default()
            }),
        }
    }

    /// Reads the sums from a record of a saved state.
    pub(super) fn read_record(record: &Record) -> Result<LightSums, String> {
        let (&[n, n_invalid, named], sums) = record.with_cells()?;
        let range = match record.values[..] {
            [] if n == 0 => None,
            [least, greatest] if n > 0 && least <= greatest => Some(Forces { least, greatest }),
            _ => {
                return Err(format!(
                    "{:?} as the forces of {n} presses, expected the least and the greatest, or none without presses",
                    record.values
                ));
            }
        };
        let read = |record: &Record| {
            let (&[presses], _) = record.exactly::<1, 0>()?;
            Ok(Presses(presses))
        };
        Ok(LightSums {
            n_invalid,
            line: LineSums {
                n,
                sums: sums.clone(),
                range,
            },
            places: Cells::from_record(record, named == 1, read)?,
        })
    }
}

impl Merge for LightSums {
    fn merge(&mut self, other: &LightSums) {
        self.merge_times(other, 1);
    }

    fn merge_times(&mut self, other: &LightSums, times: u32) {
        add_times(&mut self.n_invalid, other.n_invalid, times);
        self.line.merge_times(&other.line, times);
        self.places.merge_times(&other.places, times);
    }
}

impl Merge for LineSums {
    fn merge(&mut self, other: &LineSums) {
        self.n = self.n.saturating_add(other.n);
        self.sums.merge(&other.sums);
        self.range = match (self.range, other.range) {
            (Some(own), Some(other)) => Some(own.and(other)),
            (own, other) => own.or(other),
        };
    }
}
