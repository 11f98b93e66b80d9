//! Cross-talk: the leak of one channel into the predictions of another.

mod fit;
mod sums;

use taceva_core::{Batch, Channel, Column, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Details, Family, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::evaluate::plan::MetricPlan;
use crate::exact::ColumnAdder;
use crate::exact::record::Record;
use crate::families::row_columns::Gathered;
use crate::score::Variant;
use crate::score::direction::Better;
use crate::score::flag::Flag;
use crate::score::matrix::Matrix;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{UndefinedReason, Value};
use fit::Leaks;
use sums::{JointSums, products};

pub(crate) static CROSSTALK: Metric = Metric {
    id: "crosstalk",
    title: "cross-talk between channels",
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::One,
    range: Range::Greatest,
    definition: "crosstalk/1",
    reference: "joint least-squares slopes of each prediction on all truths, as shares of full scale",
    documentation: "Change of the prediction of one channel, as a share of its full scale, when another channel alone moves over its \
                    full scale; full scale is the range of the truth. The score is the greatest magnitude between two different \
                    channels. `matrix` has a row for each predicted and a column for each true channel; its diagonal is 1 for a sensor \
                    without gain error. If no joint fit separates the truths, each slope is fitted on its own truth alone, and the score \
                    is flagged. It uses samples that have truth and prediction of all scored channels among the six. A greatest value has no \
                    interval.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_least_samples(3),
    ..Metric::of(&KIND)
};

/// Family of metrics computed from one regression of all predictions on all truths.
pub(crate) static KIND: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    is_whole: true,
    ..FamilyKind::new("taceva.joint/2", |plan| erased(Crosstalk::for_plan(plan)))
};

/// Joint regression of the predictions of up to six contact channels on their truths.
pub(crate) struct Crosstalk {
    /// Indices in the plan of those of the six contact channels that it has.
    positions: Vec<usize>,
    names: Vec<String>,
    adder: ColumnAdder,
    gathered: Gathered,
}

impl Crosstalk {
    /// Creates the joint regression for the contact channels of `plan`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Crosstalk {
        let channels = plan.channels().iter().enumerate();
        let six = channels.filter(|(_, channel)| Channel::SIX.contains(channel));
        let (positions, names): (Vec<usize>, Vec<String>) = six
            .map(|(position, channel)| (position, channel.name().to_owned()))
            .unzip();
        Crosstalk {
            adder: ColumnAdder::new(products(positions.len())),
            gathered: Gathered::default(),
            positions,
            names,
        }
    }
}

impl Family for Crosstalk {
    type Sums = JointSums;

    fn empty(&self) -> Vec<JointSums> {
        vec![JointSums::new(self.positions.len())]
    }

    fn deposit(&mut self, sums: &mut [JointSums], batch: &Batch, rows: Option<&[u32]>) {
        let [sums] = sums else { return };
        if self.positions.is_empty() {
            return sums.count(rows.map_or(batch.rows(), <[u32]>::len));
        }
        let positions = || self.positions.iter();
        let truths = positions().map(|&position| batch.truth(position));
        let predictions = positions().map(|&position| batch.prediction(position));
        let columns: Vec<&Column> = truths.chain(predictions).collect();
        self.adder.add(&self.gathered.rows(&columns, rows), sums);
    }

    fn to_record(&self, sums: &JointSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, _position: usize, record: &Record) -> Result<JointSums, String> {
        JointSums::read_record(record, self.positions.len())
    }

    fn outputs(&self, _metric: &Metric) -> Vec<Output> {
        vec![Output {
            label: "all".to_owned(),
            unit: Unit::One,
            of: self.names.clone(),
            parts: vec![0],
        }]
    }

    fn count(&self, _metric: &Metric, sums: &JointSums) -> u64 {
        sums.n()
    }

    fn invalid(&self, sums: &JointSums) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &JointSums) -> Numbers {
        Numbers::of(Leaks::of(sums).and_then(|leaks| leaks.greatest()))
    }

    fn details(&self, _metric: &Metric, _output: &Output, parts: &[&JointSums]) -> Details {
        let leaks = match parts {
            [sums] => Leaks::of(sums),
            _ => Err(UndefinedReason::Empty),
        };
        let flags = match &leaks {
            Ok(leaks) if !leaks.joint => vec![Flag::CollinearTruths],
            _ => Vec::new(),
        };
        let matrix = match leaks {
            Ok(leaks) => Value::Matrix(Matrix {
                rows: self.names.clone(),
                columns: self.names.clone(),
                values: leaks.shares,
            }),
            Err(reason) => Value::Undefined(reason),
        };
        Details {
            variants: vec![Variant::plain("matrix", Unit::One, matrix)],
            flags,
            ..Details::default()
        }
    }
}
