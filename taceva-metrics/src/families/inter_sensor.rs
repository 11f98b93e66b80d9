//! Gap between the surfaces of several units of one sensor model.

mod gap;
mod pairs;
mod surfaces;

use taceva_core::{Batch, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Details, Family, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::evaluate::plan::MetricPlan;
use crate::exact::record::Record;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::Value;
use crate::score::{Count, Variant};
use pairs::UnitGaps;
use surfaces::SurfaceClouds;

/// Channel with the height of the untouched surface, measured at the first contact of the indenter.
const SURFACE_CHANNEL: &str = "surface_z";

pub(crate) static INTER_SENSOR: Metric = Metric {
    id: "inter_sensor",
    title: "gap between the surfaces of units",
    symbol: Some("between units"),
    theme: Theme::Robustness,
    better: Better::Lower,
    unit: ScoreUnit::Fixed(Unit::Millimetre),
    range: Range::Positive,
    definition: "inter_sensor/1",
    reference: "TacEva, project page",
    documentation: "Distance between the untouched surfaces of two aligned units, averaged over all pairs of units. The surface of a \
                    unit_id is the true Px, Py and the channel `surface_z` in mm at first contact. Two units are aligned by their common \
                    point_id if they share three or more, otherwise by 50 steps of iterative closest point. The gap is the mean distance \
                    to the nearest point of the other unit, averaged over both directions. It uses points inside the hull of the other \
                    unit, seen from above. `forward` starts from the unit whose name comes first, `backward` from the other; `matrix` \
                    has the gap of each pair.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::UnitId))
        .with_channels(&["Px", "Py", SURFACE_CHANNEL])
        .with_least_samples(2),
    ..Metric::of(&KIND)
};

/// Family of metrics that compare the surfaces of units of one sensor model.
pub(crate) static KIND: FamilyKind = FamilyKind::new("taceva.clouds/1", |plan| {
    erased(InterSensor::for_plan(plan)?)
});

/// Collects surface points of each unit of a sensor model.
pub(crate) struct InterSensor {
    axes: [usize; 3],
}

impl InterSensor {
    /// Creates the family for `plan`; `None` if the plan lacks `Px`, `Py` or `surface_z`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Option<InterSensor> {
        let position = |name| plan.channels().position(name);
        Some(InterSensor {
            axes: [position("Px")?, position("Py")?, position(SURFACE_CHANNEL)?],
        })
    }
}

impl Family for InterSensor {
    type Sums = SurfaceClouds;

    fn empty(&self) -> Vec<SurfaceClouds> {
        vec![SurfaceClouds::default()]
    }

    fn deposit(&mut self, sums: &mut [SurfaceClouds], batch: &Batch, rows: Option<&[u32]>) {
        if let [sums] = sums {
            sums.deposit(batch, self.axes, rows);
        }
    }

    fn to_record(&self, sums: &SurfaceClouds) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<SurfaceClouds, String> {
        SurfaceClouds::read_record(record)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        vec![Output {
            label: SURFACE_CHANNEL.to_owned(),
            unit: Unit::Millimetre,
            of: ["Px", "Py", SURFACE_CHANNEL].map(str::to_owned).to_vec(),
            parts: vec![0],
        }]
    }

    fn count(&self, _metric: &Metric, sums: &SurfaceClouds) -> u64 {
        sums.n()
    }

    fn invalid(&self, sums: &SurfaceClouds) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &SurfaceClouds) -> Numbers {
        let gaps = UnitGaps::of(sums);
        let mean = |number| {
            gaps.as_ref()
                .map_err(|reason| *reason)
                .and_then(|gaps| gaps.mean(number))
        };
        Numbers::of(mean(|gap| gap.both()))
            .with(
                "forward",
                Unit::Millimetre,
                Range::Positive,
                mean(|gap| gap.forward),
            )
            .with(
                "backward",
                Unit::Millimetre,
                Range::Positive,
                mean(|gap| gap.backward),
            )
    }

    fn details(&self, _metric: &Metric, _output: &Output, parts: &[&SurfaceClouds]) -> Details {
        let gaps = match parts {
            [sums] => UnitGaps::of(sums),
            _ => return Details::default(),
        };
        let count = |name, value| Count { name, value };
        match gaps {
            Ok(gaps) => Details {
                counts: vec![
                    count("units", gaps.units()),
                    count("pairs_valid", gaps.valid()),
                    count("pairs_total", gaps.total()),
                    count("pairs_by_point_id", gaps.by_point()),
                    count("pairs_unsettled", gaps.unsettled()),
                ],
                variants: vec![Variant::plain(
                    "matrix",
                    Unit::Millimetre,
                    Value::Matrix(gaps.matrix()),
                )],
                ..Details::default()
            },
            Err(_) => Details::default(),
        }
    }
}
