//! Greatest deviation of predictions from their least-squares line over the truth.

mod line;

use taceva_core::{Batch, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::exact::ColumnAdder;
use crate::exact::record::Record;
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::row_columns::Gathered;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::UndefinedReason;
use line::{Deviation, LEAST_SAMPLES, Line, LineSums, PRODUCTS};

pub(crate) static LINEARITY: Metric = Metric {
    id: "linearity",
    title: "linearity error",
    symbol: Some("linearity"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    variants: &[("slope", Better::Described), ("offset", Better::NearZero)],
    unit: ScoreUnit::One,
    range: Range::Greatest,
    definition: "linearity/1",
    reference: "independent linearity: greatest deviation from the least-squares line, as a share of full scale",
    documentation: "Greatest distance of a prediction from the line that best fits predictions to the truth, as a share of full scale, \
                    the range of the truth. It excludes the error of the line: `slope` and `offset` show what a recalibration would \
                    remove. Single samples determine it and it grows with their number, so it has no interval.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_least_samples(LEAST_SAMPLES),
    ..Metric::of(&KIND)
};

/// Family of metrics computed from the line of predictions over truth.
pub(crate) static KIND: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    ..FamilyKind::new("taceva.lines/1", |plan| {
        erased(ByChannel::new(Lines::default(), plan))
    })
};

/// Collects predictions and truths, by channel.
#[derive(Default)]
pub(crate) struct Lines {
    /// One column adder for each channel index, because channels differ in magnitude.
    adders: Vec<ColumnAdder>,
    gathered: Gathered,
}

impl Channelwise for Lines {
    type Sums = LineSums;

    fn deposit(
        &mut self,
        sums: &mut LineSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let columns = [batch.truth(position), batch.prediction(position)];
        while self.adders.len() <= position {
            self.adders.push(ColumnAdder::new(PRODUCTS.to_vec()));
        }
        self.adders[position].add(&self.gathered.rows(&columns, rows), sums);
    }

    fn to_record(&self, sums: &LineSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, record: &Record) -> Result<LineSums, String> {
        LineSums::read_record(record)
    }

    fn count(&self, sums: &LineSums) -> u64 {
        sums.n()
    }

    fn invalid(&self, sums: &LineSums) -> u64 {
        sums.n_invalid()
    }

    fn numbers(&self, _metric: &Metric, output: &Output, sums: &LineSums) -> Numbers {
        let deviation = Deviation::of(sums);
        let numbers = Numbers::of(deviation.map(|deviation| deviation.relative)).with(
            "greatest_deviation",
            output.unit,
            Range::Greatest,
            deviation.map(|deviation| deviation.greatest),
        );
        with_line(numbers, output, sums)
    }

    fn resampled(&self, _metric: &Metric, output: &Output, sums: &LineSums) -> Numbers {
        with_line(Numbers::of(Err(UndefinedReason::Greatest)), output, sums)
    }
}

/// Adds slope and offset of the line, which have intervals, to `numbers`.
fn with_line(numbers: Numbers, output: &Output, sums: &LineSums) -> Numbers {
    let line = Line::through(sums);
    numbers
        .with("slope", Unit::One, Range::Any, line.map(|line| line.slope))
        .with(
            "offset",
            output.unit,
            Range::Any,
            line.map(|line| line.offset),
        )
}
