//! Paired rows of both tables, parsed while they are scored. Memory never contains a whole column.

use std::ops::Range;

use taceva_core::{Batch, Channel, Column, Field, Labels};
use taceva_import::CsvTable;
use taceva_metrics::{ClusteredBy, MetricPlan};

use super::ScorePlan;
use super::agreement::Matching;
use super::fields::{self, Place};
use super::row_key::key_of;
use super::tables::Pairing;
use crate::accumulate::Rows;
use crate::error::EvaluateError;
use crate::note::PairedBy;

/// Both tables, row by row.
pub(super) struct PairedRows<'a> {
    truth: &'a CsvTable,
    prediction: &'a CsvTable,
    pairing: &'a Pairing,
    /// Column positions of each channel in the truth and in the predictions.
    channels: Vec<[usize; 2]>,
    /// Locations of the fields that metrics read.
    places: Vec<Place>,
    /// Column of the truth that names samples, if each sample is a cluster.
    names: Option<usize>,
    matching: &'a Matching,
    allow_invalid: bool,
}

impl<'a> PairedRows<'a> {
    /// Pairs the rows of truth and predictions by `pairing`. Selects the columns that `plan` reads.
    pub(super) fn new(
        [truth, prediction]: [&'a CsvTable; 2],
        pairing: &'a Pairing,
        matching: &'a Matching,
        plan: &ScorePlan,
        allow_invalid: bool,
    ) -> Result<PairedRows<'a>, EvaluateError> {
        let stand = |channel: &Channel| {
            let name = channel.name();
            Ok([truth.position(name)?, prediction.position(name)?])
        };
        let channels: Result<_, EvaluateError> =
            plan.metrics.channels().iter().map(stand).collect();
        let wanted = plan.metrics.fields();
        let places = plan.places.iter().copied();
        let names = match &matching.by {
            PairedBy::Key { truth: key, .. }
                if plan.metrics.clustered_by() == ClusteredBy::Sample =>
            {
                Some(truth.position(key)?)
            }
            _ => None,
        };
        Ok(PairedRows {
            truth,
            prediction,
            pairing,
            channels: channels?,
            places: places
                .filter(|place| wanted.contains(place.field))
                .collect(),
            names,
            matching,
            allow_invalid,
        })
    }

    fn numbers(
        &self,
        table: &CsvTable,
        column: usize,
        rows: impl ExactSizeIterator<Item = usize>,
    ) -> Result<Column, EvaluateError> {
        Ok(match self.allow_invalid {
            true => table.numbers_in_with_invalid(column, rows),
            false => table.numbers_in(column, rows),
        }?)
    }

    /// Rows of the truth, each with the values of the paired prediction.
    fn side_by_side(
        &self,
        plan: &MetricPlan,
        rows: Range<usize>,
        paired: impl ExactSizeIterator<Item = usize> + Clone,
    ) -> Result<Batch, EvaluateError> {
        let tables = [self.truth, self.prediction];
        self.matching
            .check(tables, rows.clone().zip(paired.clone()))?;
        let truth: Result<_, EvaluateError> = self
            .channels
            .iter()
            .map(|[column, _]| self.numbers(self.truth, *column, rows.clone()))
            .collect();
        let prediction: Result<_, EvaluateError> = self
            .channels
            .iter()
            .map(|[_, column]| self.numbers(self.prediction, *column, paired.clone()))
            .collect();
        let point = self.places.iter().find(|place| place.field == Field::Point);
        let points = point.map(|place| match place.in_truth {
            true => fields::labels(self.truth, Field::Point, place.column, rows.clone()),
            false => fields::labels(self.prediction, Field::Point, place.column, paired.clone()),
        });
        let channels = plan.channels().clone();
        let mut batch = Batch::from_columns(channels, truth?, prediction?, points.transpose()?);
        if let Some(column) = self.names {
            let mut labels = Labels::default();
            rows.clone()
                .for_each(|row| labels.push(key_of(self.truth.cell(row, column))));
            batch = batch.with_samples(labels);
        }
        for place in self
            .places
            .iter()
            .filter(|place| place.field != Field::Point)
        {
            batch = match place.in_truth {
                true => self.with_field(batch, self.truth, *place, rows.clone())?,
                false => self.with_field(batch, self.prediction, *place, paired.clone())?,
            };
        }
        Ok(batch)
    }

    fn with_field(
        &self,
        batch: Batch,
        table: &CsvTable,
        place: Place,
        rows: impl ExactSizeIterator<Item = usize>,
    ) -> Result<Batch, EvaluateError> {
        let Place { field, column, .. } = place;
        Ok(match field {
            Field::Stamp | Field::Intensity => {
                batch.with_numbers(field, self.numbers(table, column, rows)?)
            }
            Field::DepthStep | Field::Repeat | Field::Spacing | Field::PredictedSpacing => {
                batch.with_numbers(field, fields::exact_numbers(table, field, column, rows)?)
            }
            _ => batch.with_labels(field, fields::labels(table, field, column, rows)?),
        })
    }
}

impl Rows for PairedRows<'_> {
    fn rows(&self) -> usize {
        self.truth.rows()
    }

    fn batch(&self, plan: &MetricPlan, rows: Range<usize>) -> Result<Batch, EvaluateError> {
        match self.pairing {
            Pairing::ByOrder => self.side_by_side(plan, rows.clone(), rows),
            Pairing::ByKey(paired) => {
                let paired = paired[rows.clone()].iter().copied();
                self.side_by_side(plan, rows, paired)
            }
        }
    }
}
