//! Sums of the surface compliance.

use super::grid::Cell;
use crate::exact::ExactSum;
use crate::exact::merge::{Merge, keyed, merge_cells};
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::pair::is_valid;
use crate::score::value::UndefinedReason;

/// Name of the variant that is computed only from samples without shear.
pub(crate) const NORMAL_ONLY: &str = "normal_only";

/// Depth and normal force of a press, measured by the reference instruments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Press {
    pub(crate) depth_mm: f64,
    pub(crate) force_n: f64,
}

/// Counts and exact sums of the compliance Δz / F over the samples in contact. Δz is the depth in mm, F the normal force in N.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SurfaceSums {
    pub(crate) n_invalid: u64,
    /// Number of samples without contact: force below the threshold, or no indentation.
    pub(crate) gated: u64,
    /// Number of samples in contact outside the footprint.
    pub(crate) outside: u64,
    pub(crate) compliance: Total,
    /// Count and sum of the compliance of samples without shear, mm/N.
    pub(crate) normal: Total,
    /// Sum of depth times normal force over the samples in contact, N mm.
    pub(crate) work: ExactSum,
    /// Sum of the squared normal forces over the samples in contact, N².
    pub(crate) force_squares: ExactSum,
    /// Moments of the compliance in each cell of the footprint, mm/N: of all samples in contact, and of those without shear.
    pub(crate) cells: SortedMap<Cell, [Moments; 2]>,
}

/// Number of values, and their exact sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Total {
    pub(crate) n: u64,
    pub(crate) sum: ExactSum,
}

impl Total {
    fn add(&mut self, value: f64) {
        self.n += 1;
        self.sum.add(value);
    }

    fn merge(&mut self, other: &Total) {
        self.n = self.n.saturating_add(other.n);
        self.sum.merge(&other.sum);
    }
}

/// Place of a press relative to the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place {
    /// The place is unknown, or not needed.
    Unknown,
    /// The place is outside the footprint.
    Outside,
    /// The place is in this cell of the grid.
    Cell(Cell),
}

impl SurfaceSums {
    /// Adds a press at `place`. A press with a force below `gate_n` newtons, or without indentation, is counted in `gated`.
    pub(crate) fn add(&mut self, press: Press, gate_n: f64, without_shear: bool, place: Place) {
        let Press { depth_mm, force_n } = press;
        if !is_valid(depth_mm) || !is_valid(force_n) {
            self.n_invalid += 1;
            return;
        }
        if force_n < gate_n || depth_mm <= 0.0 {
            self.gated += 1;
            return;
        }
        let compliance = depth_mm / force_n;
        if !is_valid(compliance) {
            self.n_invalid += 1;
            return;
        }
        self.compliance.add(compliance);
        self.work.add_product(depth_mm, force_n);
        self.force_squares.add_product(force_n, force_n);
        if without_shear {
            self.normal.add(compliance);
        }
        match place {
            Place::Unknown => {}
            Place::Outside => self.outside += 1,
            Place::Cell(cell) => {
                let [all, normal] = self.cells.entry(cell);
                all.add(compliance);
                if without_shear {
                    normal.add(compliance);
                }
            }
        }
    }

    /// Number of samples in contact at known places within the footprint.
    pub(crate) fn binned(&self) -> u64 {
        self.cells.values().map(|[all, _]| all.n).sum()
    }

    pub(crate) fn to_record(&self) -> Record {
        let cell = |(&(row, column), [all, normal]): (&Cell, &[Moments; 2])| {
            let mut record = all.to_record();
            let normal = normal.to_record();
            record.counts.extend(normal.counts);
            record.sums.extend(normal.sums);
            (format!("{row} {column}"), record)
        };
        Record {
            counts: vec![
                self.compliance.n,
                self.n_invalid,
                self.gated,
                self.outside,
                self.normal.n,
            ],
            sums: vec![
                self.compliance.sum.clone(),
                self.work.clone(),
                self.force_squares.clone(),
                self.normal.sum.clone(),
            ],
            cells: keyed(self.cells.iter().map(cell)),
            ..Record::default()
        }
    }

    /// Reads the sums from the record of a state whose grid has `bins` cells along each side.
    pub(crate) fn read_record(record: &Record, bins: u32) -> Result<SurfaceSums, String> {
        let ([n, n_invalid, gated, outside, n_normal], sums) = record.with_cells()?;
        let [compliance, work, force_squares, normal] = sums;
        let parse = |key: &str| {
            let (row, column) = key.split_once(' ')?;
            let number = |text: &str| text.parse::<u32>().ok().filter(|number| *number < bins);
            Some((number(row)?, number(column)?))
        };
        let cells = record.read_cells(parse, |record| {
            let ([n, n_normal], [sum, squares, normal_sum, normal_squares]) = record.exactly()?;
            if *n == 0 || n_normal > n {
                return Err(format!("{n} samples in a cell, {n_normal} of them without shear, expected a sample or more, and at most all without shear"));
            }
            let moments = |n: &u64, sum: &ExactSum, squares: &ExactSum| Moments {
                n: *n,
                sum: sum.clone(),
                squares: squares.clone(),
            };
            Ok([
                moments(n, sum, squares),
                moments(n_normal, normal_sum, normal_squares),
            ])
        })?;
        Ok(SurfaceSums {
            n_invalid: *n_invalid,
            gated: *gated,
            outside: *outside,
            compliance: Total {
                n: *n,
                sum: compliance.clone(),
            },
            normal: Total {
                n: *n_normal,
                sum: normal.clone(),
            },
            work: work.clone(),
            force_squares: force_squares.clone(),
            cells,
        })
    }
}

impl Merge for SurfaceSums {
    fn merge(&mut self, other: &SurfaceSums) {
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        self.gated = self.gated.saturating_add(other.gated);
        self.outside = self.outside.saturating_add(other.outside);
        self.compliance.merge(&other.compliance);
        self.normal.merge(&other.normal);
        self.work.merge(&other.work);
        self.force_squares.merge(&other.force_squares);
        merge_cells(&mut self.cells, &other.cells);
    }
}

/// Checks that at least one sample is in contact.
pub(crate) fn contact(sums: &SurfaceSums) -> Result<(), UndefinedReason> {
    match (sums.compliance.n, sums.gated) {
        (0, 0) => Err(UndefinedReason::Empty),
        (0, _) => Err(UndefinedReason::BelowGate),
        _ => Ok(()),
    }
}
