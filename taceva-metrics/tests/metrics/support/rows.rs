//! Rows and evaluators of two channels.

use taceva_core::{Batch, Channel, Channels, Column, FieldSet, Labels};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan, catalogue};

/// One sample of two channels, Fx and Fy.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) truth: [Option<f64>; 2],
    pub(crate) prediction: [Option<f64>; 2],
    pub(crate) point: Option<u32>,
}

impl Row {
    /// A sample with equal values in both channels.
    pub(crate) fn same(truth: f64, prediction: f64, point: u32) -> Row {
        Row {
            truth: [Some(truth); 2],
            prediction: [Some(prediction); 2],
            point: Some(point),
        }
    }
}

fn channels() -> Channels {
    Channels::new([Channel::FX, Channel::FY]).expect("two channels")
}

/// Every metric of predictions of Fx and Fy.
pub(crate) fn plan() -> MetricPlan {
    let names = ["accuracy", "rmse", "bias", "smape_gated", "mae_euclid"];
    let wanted = catalogue::select(names).expect("known names");
    MetricPlan::new(&wanted, channels(), FieldSet::PAIRS)
}

/// The rows as columns, with contact points if every row has one.
pub(crate) fn batch(rows: &[Row]) -> Batch {
    let columns = |values: fn(&Row) -> [Option<f64>; 2]| {
        let column = |channel: usize| {
            let mut column = Column::default();
            rows.iter()
                .for_each(|row| column.push(values(row)[channel]));
            column
        };
        vec![column(0), column(1)]
    };
    let mut points = Labels::default();
    let named: Option<Vec<u32>> = rows.iter().map(|row| row.point).collect();
    let named = named.filter(|named| !named.is_empty());
    named
        .iter()
        .flatten()
        .for_each(|point| points.push(&format!("point {point}")));
    Batch::from_columns(
        channels(),
        columns(|row| row.truth),
        columns(|row| row.prediction),
        named.is_some().then_some(points),
    )
}

/// Evaluator after adding the rows in one batch.
pub(crate) fn evaluator(rows: &[Row]) -> Evaluator {
    let mut evaluator = Evaluator::new(&plan());
    evaluator.update(&batch(rows)).expect("the plan's channels");
    evaluator
}

/// The scores of the rows.
pub(crate) fn evaluate(rows: &[Row]) -> Evaluation {
    evaluator(rows).finish().expect("the plan's channels")
}
