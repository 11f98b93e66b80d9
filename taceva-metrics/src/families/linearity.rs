//! How far predictions stray from a straight line of the truth.

mod line;

use taceva_core::{Batch, Field, FieldSet, Needs, Unit};

use crate::evaluate::state::Record;
use crate::families::channelwise::{Channelwise, each_pair};
use crate::families::family::{Numbers, Output};
use crate::metric::{Formula, Metric, ScoreUnit};
use crate::score::Parameter;
use crate::score::better::Better;
use crate::score::range::Range;
use line::{LEAST_SAMPLES, Line, LineSums};

pub(crate) static LINEARITY: Metric = Metric {
    id: "linearity",
    title: "linearity error",
    better: Better::Lower,
    unit: ScoreUnit::One,
    range: Range::Greatest,
    definition: "linearity/1",
    reference: "independent linearity: greatest deviation from the least-squares line, as a share of full scale",
    documentation: "The greatest distance of a prediction from the line that fits predictions to the truth best, as a share of \
                    full scale, the range of the truth. The line's own error is no part of it: `slope` and `offset` say what a \
                    recalibration would remove. It is set by single samples and grows with their number, so \
                    that it has no interval.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_least_samples(LEAST_SAMPLES),
    facts: &[],
    constants: no_constants,
    formula: Formula::Linearity,
};

fn no_constants(_: Unit) -> Vec<Parameter> {
    Vec::new()
}

/// Predictions over truth.
pub(crate) struct Lines;

impl Channelwise for Lines {
    type Sums = LineSums;
    const SCHEMA: &'static str = "taceva.lines/1";

    fn finishes(&self, metric: &Metric) -> bool {
        matches!(metric.formula, Formula::Linearity)
    }

    fn deposit(&self, sums: &mut LineSums, batch: &Batch, position: usize, rows: Option<&[u32]>) {
        let mut pairs = Vec::new();
        each_pair(batch, position, rows, |_, pair| pairs.push(pair));
        sums.add(&pairs);
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
        let line = Line::through(sums);
        let of = |number: fn(&Line) -> f64| line.map(|line| number(&line));
        Numbers::of(of(|line| line.relative_deviation))
            .with(
                "greatest_deviation",
                output.unit,
                Range::Greatest,
                of(|line| line.greatest_deviation),
            )
            .with("slope", Unit::One, Range::Any, of(|line| line.slope))
            .with("offset", output.unit, Range::Any, of(|line| line.offset))
    }
}
