//! Compliance of the surface under normal force, for sensitivity and uniformity.

mod grid;
pub(crate) mod sums;

pub(crate) use grid::Grid;

use std::collections::BTreeMap;

use taceva_core::{Batch, Unit};

use crate::count::as_f64;
use crate::evaluate::family::{
    Details, Family, FamilyKind, Intervals, Numbers, Output, each_row, erased,
};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::evaluate::settings::Settings;
use crate::exact::merge::keyed;
use crate::exact::record::Record;
use crate::pair::is_valid;
use crate::score::flag::Flag;
use crate::score::map::Map;
use crate::score::sensor_facts;
use crate::score::value::{InapplicableReason, UndefinedReason, Value};
use crate::score::{Count, Parameter, Variant};
use sums::{NORMAL_ONLY, Place, Press, SurfaceSums};

/// Metric family of surface compliance: indentation depth over normal force.
pub(crate) static SURFACE: FamilyKind =
    FamilyKind::new("taceva.surface/1", |plan| erased(Surface::for_plan(plan)?));

/// Formula of a metric that is computed from sums of surface compliance.
pub(crate) struct SurfaceFormula {
    /// Names of the channels from which the score is computed.
    pub(crate) of: &'static [&'static str],
    /// Number of samples that the score uses.
    pub(crate) count: fn(&SurfaceSums) -> u64,
    /// Computes the score and its variants.
    pub(crate) finish: fn(&SurfaceSums, &Settings) -> Numbers,
    /// Computes the variants that need the sums of each cluster, with their intervals.
    pub(crate) of_clusters: Option<fn(&[&SurfaceSums], &Settings) -> Intervals>,
    /// True if the score includes a map with the mean compliance of each cell.
    pub(crate) has_map: bool,
}

fn formula(metric: &Metric) -> Option<&'static SurfaceFormula> {
    metric.formula.get()
}

/// Family that sums the surface compliance, also for each cell of a grid if a footprint is declared.
pub(crate) struct Surface {
    settings: Settings,
    grid: Option<Grid>,
    depth: usize,
    force: usize,
    place: Option<[usize; 2]>,
    shear: Result<[usize; 2], &'static str>,
}

impl Surface {
    /// Creates the family for `plan`; `None` without the channels of depth (`Pz`) and normal force (`Fz`).
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<Surface> {
        let position = |name: &'static str| plan.channels().position(name).ok_or(name);
        let both = |[first, second]: [&'static str; 2]| Ok([position(first)?, position(second)?]);
        let place = both(["Px", "Py"]).ok();
        let footprint = plan.facts().footprint.filter(|_| place.is_some());
        Some(Surface {
            settings: *plan.settings(),
            grid: footprint.map(|footprint| Grid::new(footprint, plan.settings().bins)),
            depth: position("Pz").ok()?,
            force: position("Fz").ok()?,
            place,
            shear: both(["Fx", "Fy"]),
        })
    }

    /// Place of the sample at `row`; `None` if a coordinate is NaN or too large. Without a grid or a coordinate, the place is [`Place::Unknown`].
    fn place(&self, batch: &Batch, row: usize) -> Option<Place> {
        let (Some(grid), Some([x, y])) = (&self.grid, self.place) else {
            return Some(Place::Unknown);
        };
        let (Some(x_mm), Some(y_mm)) = (batch.truth(x).get(row), batch.truth(y).get(row)) else {
            return Some(Place::Unknown);
        };
        if !is_valid(x_mm) || !is_valid(y_mm) {
            return None;
        }
        Some(grid.cell(x_mm, y_mm).map_or(Place::Outside, Place::Cell))
    }

    /// True if both shear forces of the sample at `row` are measured and below the contact threshold.
    fn without_shear(&self, batch: &Batch, row: usize) -> bool {
        let small = |axis: usize| {
            let force = batch.truth(axis).get(row);
            force.is_some_and(|force| force.abs() < self.settings.gate.0)
        };
        self.shear.is_ok_and(|axes| axes.into_iter().all(small))
    }

    fn map(&self, grid: &Grid, sums: &SurfaceSums) -> Map {
        let bins = grid.bins();
        let rows = |cell: &dyn Fn(u32, u32) -> (Option<f64>, u64)| {
            let row = |row: u32| (0..bins).map(|column| cell(row, column)).unzip();
            (0..bins).map(row).unzip()
        };
        let (values, counts) = rows(&|row, column| match sums.cells.get(&(row, column)) {
            Some([cell, _]) => {
                let enough = cell.n >= self.settings.n_min;
                (cell.mean().filter(|_| enough), cell.n)
            }
            None => (None, 0),
        });
        let [x_mm, y_mm] = grid.edges_mm();
        Map {
            x_mm,
            y_mm,
            values,
            counts,
        }
    }
}

impl Family for Surface {
    type Sums = SurfaceSums;

    fn parameters(&self) -> BTreeMap<String, String> {
        let mut parameters = keyed([
            ("gate_N".to_owned(), self.settings.gate.0.to_string()),
            ("shear".to_owned(), self.shear.is_ok().to_string()),
        ]);
        if let Some(grid) = &self.grid {
            parameters.insert("bins".to_owned(), grid.bins().to_string());
            parameters.insert(
                "footprint".to_owned(),
                sensor_facts::written(&grid.footprint()),
            );
        }
        parameters
    }

    fn empty(&self) -> Vec<SurfaceSums> {
        vec![SurfaceSums::default()]
    }

    fn deposit(&mut self, sums: &mut [SurfaceSums], batch: &Batch, rows: Option<&[u32]>) {
        let sums = &mut sums[0];
        each_row(batch, rows, |row| {
            let depth = batch.truth(self.depth).get(row);
            let force = batch.truth(self.force).get(row);
            let (Some(depth_mm), Some(force_n)) = (depth, force) else {
                return;
            };
            let press = Press { depth_mm, force_n };
            match self.place(batch, row) {
                Some(place) => {
                    let without_shear = self.without_shear(batch, row);
                    sums.add(press, self.settings.gate.0, without_shear, place);
                }
                None => sums.n_invalid += 1,
            }
        });
    }

    fn to_record(&self, sums: &SurfaceSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<SurfaceSums, String> {
        SurfaceSums::read_record(record, self.grid.map_or(0, |grid| grid.bins()))
    }

    fn outputs(&self, metric: &Metric) -> Vec<Output> {
        let of = formula(metric).into_iter().flat_map(|formula| formula.of);
        vec![Output {
            label: "Fz".to_owned(),
            unit: Unit::Newton,
            of: of.map(|&name| name.to_owned()).collect(),
            parts: vec![0],
        }]
    }

    fn count(&self, metric: &Metric, sums: &SurfaceSums) -> u64 {
        formula(metric).map_or(0, |formula| (formula.count)(sums))
    }

    fn invalid(&self, sums: &SurfaceSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, metric: &Metric, _output: &Output, sums: &SurfaceSums) -> Numbers {
        let Some(formula) = formula(metric) else {
            return Numbers::of(Err(UndefinedReason::Empty));
        };
        let mut numbers = (formula.finish)(sums, &self.settings);
        if self.shear.is_err() {
            numbers
                .variants
                .retain(|variant| variant.name != NORMAL_ONLY);
        }
        numbers
    }

    fn intervals(
        &self,
        metric: &Metric,
        _output: &Output,
        clusters: &[&Vec<SurfaceSums>],
    ) -> Option<Intervals> {
        let of_clusters = formula(metric)?.of_clusters?;
        let sums = clusters.iter().filter_map(|parts| parts.first());
        let sums: Vec<&SurfaceSums> = sums.collect();
        Some(of_clusters(&sums, &self.settings))
    }

    fn details(&self, metric: &Metric, _output: &Output, parts: &[&SurfaceSums]) -> Details {
        let Some(sums) = parts.first() else {
            return Details::default();
        };
        let count = |name, value| Count { name, value };
        let mut details = Details {
            counts: vec![count("gated", sums.gated)],
            parameters: vec![Parameter {
                name: "gate",
                value: self.settings.gate.0,
            }],
            ..Details::default()
        };
        if let Err(name) = self.shear {
            let unknown = Value::NotApplicable(InapplicableReason::ChannelAbsent(name));
            let variant = Variant::plain(NORMAL_ONLY, metric.unit.of(Unit::Newton), unknown);
            details.variants.push(variant);
        }
        let Some(grid) = &self.grid else {
            return details;
        };
        let used = sums
            .cells
            .values()
            .filter(|[cell, _]| cell.n >= self.settings.n_min);
        let used = used.fold(0, |used, _| used + 1);
        details
            .counts
            .extend([count("outside", sums.outside), count("bins_used", used)]);
        let parameter = |name, value| Parameter { name, value };
        details.parameters.extend([
            parameter("bins", f64::from(grid.bins())),
            parameter("n_min", as_f64(self.settings.n_min)),
            parameter("ddof", f64::from(self.settings.ddof)),
        ]);
        if formula(metric).is_some_and(|formula| formula.has_map) {
            let map = Value::Map(self.map(grid, sums));
            let map = Variant::plain("map", Unit::MillimetrePerNewton, map);
            details.variants.push(map);
        } else if used == 1 {
            details.flags.push(Flag::OneBin);
        }
        details
    }
}
