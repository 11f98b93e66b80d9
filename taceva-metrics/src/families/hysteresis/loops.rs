//! Family of scores that compare loading with unloading at each contact point.

use taceva_core::{Batch, Field, Phase, Unit};

use super::branches::Branches;
use super::press::Press;
use crate::evaluate::family::{Details, Family, FamilyKind, Numbers, Output, each_row, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::exact::{Dyadic, ExactSum};
use crate::families::cells::{Cells, add_times};
use crate::families::surface::Grid;
use crate::pair::is_valid;
use crate::score::map::Map;
use crate::score::range::Range;
use crate::score::value::{Finished, UndefinedReason, Value};
use crate::score::{Count, Variant};

/// Family of metrics computed from force over depth at each contact point.
pub(crate) static KIND: FamilyKind =
    FamilyKind::new("taceva.loops/1", |plan| erased(Loops::for_plan(plan)?));

/// Collects force over depth of loading and unloading, by contact point.
pub(crate) struct Loops {
    depth: usize,
    force: usize,
    place: Option<[usize; 2]>,
    grid: Option<Grid>,
}

/// Number of samples, and forces by depth at each contact point.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LoopSums {
    n: u64,
    n_invalid: u64,
    cells: Cells<Branches>,
}

impl Loops {
    /// Creates the family for `plan`; `None` if the plan lacks `Pz` or `Fz`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<Loops> {
        let position = |name| plan.channels().position(name);
        let place = position("Px").zip(position("Py"));
        let footprint = plan.facts().footprint.filter(|_| place.is_some());
        Some(Loops {
            depth: position("Pz")?,
            force: position("Fz")?,
            place: place.map(|(x, y)| [x, y]),
            grid: footprint.map(|footprint| Grid::new(footprint, plan.settings().bins)),
        })
    }

    /// Place of the sample at `row`, mm; `None` if a coordinate is missing or unusable.
    fn place_mm(&self, batch: &Batch, row: usize) -> Option<[f64; 2]> {
        let [x, y] = self.place?;
        let place = [batch.truth(x).get(row)?, batch.truth(y).get(row)?];
        place.iter().all(|value| is_valid(*value)).then_some(place)
    }
}

impl Family for Loops {
    type Sums = LoopSums;

    fn empty(&self) -> Vec<LoopSums> {
        vec![LoopSums::default()]
    }

    fn deposit(&mut self, sums: &mut [LoopSums], batch: &Batch, rows: Option<&[u32]>) {
        let [sums] = sums else { return };
        let mut cells = sums.cells.of_batch(batch);
        let Some(phases) = batch.labels(Field::Phase) else {
            return;
        };
        each_row(batch, rows, |row| {
            let depth = batch.truth(self.depth).get(row);
            let force = batch.truth(self.force).get(row);
            let phase = phases.get(row).and_then(Phase::from_name);
            let (Some(depth), Some(force), Some(phase)) = (depth, force, phase) else {
                return;
            };
            if !is_valid(depth) || !is_valid(force) {
                sums.n_invalid += 1;
                return;
            }
            let cell = cells.at(row, 0);
            cell.add(phase, depth, force);
            if let Some(place) = self.place_mm(batch, row) {
                cell.add_place(place);
            }
            sums.n += 1;
        });
    }

    fn to_record(&self, sums: &LoopSums) -> Record {
        Record {
            counts: vec![sums.n, sums.n_invalid, u64::from(sums.cells.are_named())],
            cells: sums.cells.to_records(Branches::to_record),
            ..Record::default()
        }
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<LoopSums, String> {
        let (&[n, n_invalid, named], []) = record.with_cells()?;
        Ok(LoopSums {
            n,
            n_invalid,
            cells: Cells::from_record(record, named == 1, Branches::read_record)?,
        })
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        vec![Output {
            label: "Fz".to_owned(),
            unit: Unit::Newton,
            of: ["Pz", "Fz"].map(str::to_owned).to_vec(),
            parts: vec![0],
        }]
    }

    fn count(&self, _metric: &Metric, sums: &LoopSums) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &LoopSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &LoopSums) -> Numbers {
        let mean = |number: &dyn Fn(&Press) -> Option<f64>| sums.mean(number);
        Numbers::of(mean(&|press| Some(press.area)))
            .with(
                "signed_area",
                Unit::NewtonMillimetre,
                Range::Any,
                mean(&|press| Some(press.signed_area)),
            )
            .with("ratio", Unit::One, Range::Positive, mean(&Press::ratio))
            .with(
                "greatest_difference",
                Unit::One,
                Range::Positive,
                mean(&Press::relative_difference),
            )
    }

    fn details(&self, _metric: &Metric, _output: &Output, parts: &[&LoopSums]) -> Details {
        let [sums] = parts else {
            return Details::default();
        };
        let points = |counts: &dyn Fn(&Branches) -> bool| {
            let cells = sums.cells.iter().filter(|(_, cell)| counts(cell));
            cells.fold(0, |count, _| count + 1)
        };
        let count = |name, value| Count { name, value };
        let map = self.grid.as_ref().map(|grid| {
            let map = Value::Map(sums.map(grid));
            Variant::plain("map", Unit::NewtonMillimetre, map)
        });
        Details {
            variants: map.into_iter().collect(),
            counts: vec![
                count("points_valid", points(&|cell| cell.press().is_ok())),
                count("points_total", points(&|_| true)),
            ],
            ..Details::default()
        }
    }
}

impl LoopSums {
    /// Mean of `number` over the contact points with comparable branches, rounded once. A point is skipped if `number` returns `None`.
    fn mean(&self, number: &dyn Fn(&Press) -> Option<f64>) -> Finished {
        if self.n == 0 {
            return Err(UndefinedReason::Empty);
        }
        if !self.cells.are_named() {
            return Err(UndefinedReason::NoClusters);
        }
        let (mut sum, mut count) = (ExactSum::default(), 0);
        let mut reason = UndefinedReason::ShortBranch;
        for (_, cell) in self.cells.iter() {
            match cell.press().map(|press| number(&press)) {
                Ok(Some(value)) if value.is_finite() => {
                    sum.add(value);
                    count += 1;
                }
                Ok(None) => reason = further(reason, UndefinedReason::NoForce),
                Ok(Some(_)) => return Err(UndefinedReason::Overflow),
                Err(other) => reason = further(reason, other),
            }
        }
        if count == 0 {
            return Err(reason);
        }
        Ok(sum.to_dyadic().over(&Dyadic::from(count)))
    }

    /// Map of the mean hysteresis area, over the contact points in each cell of `grid`.
    fn map(&self, grid: &Grid) -> Map {
        let mut areas: SortedMap<(u32, u32), Moments> = SortedMap::default();
        for (_, cell) in self.cells.iter() {
            let place = cell.place_mm().and_then(|[x, y]| grid.cell(x, y));
            if let (Some(place), Ok(press)) = (place, cell.press()) {
                areas.entry(place).add(press.area);
            }
        }
        let bins = grid.bins();
        let row = |row| {
            let areas = (0..bins).map(|column| areas.get(&(row, column)));
            areas
                .map(|area| (area.and_then(Moments::mean), area.map_or(0, |area| area.n)))
                .unzip()
        };
        let (values, counts) = (0..bins).map(row).unzip();
        let [x_mm, y_mm] = grid.edges_mm();
        Map {
            x_mm,
            y_mm,
            values,
            counts,
        }
    }
}

impl Merge for LoopSums {
    fn merge(&mut self, other: &LoopSums) {
        self.merge_times(other, 1);
    }

    fn merge_times(&mut self, other: &LoopSums, times: u32) {
        add_times(&mut self.n, other.n, times);
        add_times(&mut self.n_invalid, other.n_invalid, times);
        self.cells.merge_times(&other.cells, times);
    }
}

/// Returns the one of two reasons that the computation would find later.
fn further(left: UndefinedReason, right: UndefinedReason) -> UndefinedReason {
    let came = |reason: &UndefinedReason| match reason {
        UndefinedReason::ShortBranch => 0,
        UndefinedReason::NoOverlap => 1,
        UndefinedReason::NoForce => 2,
        _ => 3,
    };
    if came(&right) > came(&left) {
        right
    } else {
        left
    }
}
