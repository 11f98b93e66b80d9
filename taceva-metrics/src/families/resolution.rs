//! Spatial resolution: recognition of the spacing of a grating.

mod histogram;
mod success_rate;

pub(crate) use success_rate::SR;

use std::borrow::Cow;
use std::collections::BTreeMap;

use taceva_core::{Batch, Field, GratingKind, Labels, Nanometre, Unit};

use crate::evaluate::family::{Details, Family, FamilyKind, Numbers, Output, each_row, erased};
use crate::evaluate::metric::Metric;
use crate::evaluate::plan::MetricPlan;
use crate::exact::merge::keyed;
use crate::exact::record::Record;
use histogram::Histogram;

/// Metric family that counts the errors of predicted grating spacings.
pub(crate) static KIND: FamilyKind = FamilyKind::new("taceva.resolution/1", |plan| {
    erased(Resolution::for_plan(plan))
});

/// Family that counts spacing errors for each kind of grating.
pub(crate) struct Resolution {
    tolerance: Nanometre,
    by_point: bool,
}

impl Resolution {
    /// Creates the family for the settings and fields of `plan`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Resolution {
        Resolution {
            tolerance: plan.settings().resolution_tolerance,
            by_point: plan.carries(Field::Point),
        }
    }

    fn tolerance_nm(&self) -> u64 {
        self.tolerance.0.unsigned_abs()
    }
}

/// Converts a spacing that is a whole number of nanometres, up to 2⁵³, to an integer. `None` for any other number.
fn spacing(value: f64) -> Option<i64> {
    const GREATEST: f64 = 9_007_199_254_740_992.0;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a whole number of at most 2^53"
    )]
    (value.abs() <= GREATEST && value.fract().abs() <= 0.0).then_some(value as i64)
}

impl Family for Resolution {
    type Sums = Histogram;

    fn parameters(&self) -> BTreeMap<String, String> {
        let clusters = if self.by_point { "point_id" } else { "board" };
        keyed([("clusters".to_owned(), clusters.to_owned())])
    }

    fn empty(&self) -> Vec<Histogram> {
        vec![Histogram::default(); GratingKind::ALL.len()]
    }

    fn deposit(&mut self, sums: &mut [Histogram], batch: &Batch, rows: Option<&[u32]>) {
        let numbers = |field| batch.numbers(field);
        let (Some(kinds), Some(spacings), Some(predicted)) = (
            batch.labels(Field::Kind),
            numbers(Field::Spacing),
            numbers(Field::PredictedSpacing),
        ) else {
            return;
        };
        each_row(batch, rows, |row| {
            let kind = kinds.get(row).and_then(GratingKind::from_name);
            let position = GratingKind::ALL
                .into_iter()
                .position(|known| Some(known) == kind);
            let (Some(position), Some(truth), Some(estimate)) =
                (position, spacings.get(row), predicted.get(row))
            else {
                return;
            };
            match (spacing(truth), spacing(estimate)) {
                (Some(truth), Some(estimate)) => sums[position].add(truth, estimate),
                _ => sums[position].n_invalid += 1,
            }
        });
    }

    /// Clusters of the samples: boards (specimens with a grating), each pressed many times. The contact point identifies a board, or else the kind
    /// and spacing of its grating.
    fn clusters<'a>(&self, batch: &'a Batch) -> Option<Cow<'a, Labels>> {
        if self.by_point {
            return batch.points().map(Cow::Borrowed);
        }
        Some(Cow::Owned(boards(batch)))
    }

    fn to_record(&self, sums: &Histogram) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<Histogram, String> {
        Histogram::read_record(record)
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        let kinds = GratingKind::ALL.into_iter().enumerate();
        kinds
            .map(|(position, kind)| Output {
                label: kind.name().to_owned(),
                unit: Unit::One,
                of: Vec::new(),
                parts: vec![position],
            })
            .collect()
    }

    fn count(&self, _metric: &Metric, sums: &Histogram) -> u64 {
        sums.n()
    }

    fn invalid(&self, sums: &Histogram) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &Histogram) -> Numbers {
        success_rate::success_rate(sums, self.tolerance_nm())
    }

    fn details(&self, _metric: &Metric, _output: &Output, parts: &[&Histogram]) -> Details {
        let Some(histogram) = parts.first() else {
            return Details::default();
        };
        success_rate::details(histogram, self.tolerance, self.tolerance_nm())
    }
}

/// Name of each row's board: kind of its grating and spacing in nm, such as `line:350000`. Rows without a grating share the name `none`.
fn boards(batch: &Batch) -> Labels {
    let (kinds, spacings) = (batch.labels(Field::Kind), batch.numbers(Field::Spacing));
    let mut boards = Labels::default();
    for row in 0..batch.rows() {
        let kind = kinds.and_then(|kinds| kinds.get(row));
        let spacing = spacings.and_then(|spacings| spacings.get(row));
        match (kind, spacing.and_then(self::spacing)) {
            (Some(kind), Some(spacing)) => boards.push(&format!("{kind}:{spacing}")),
            _ => boards.push("none"),
        }
    }
    boards
}
