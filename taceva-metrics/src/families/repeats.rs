//! Metrics computed from repeated presses at the same contact point and depth.

pub(crate) mod spread;

use taceva_core::{Batch, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Details, FamilyKind, Numbers, Output, each_row, erased};
use crate::evaluate::metric::Metric;
use crate::exact::ExactSum;
use crate::exact::merge::Merge;
use crate::exact::moments::Moments;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::families::cells::{Cells, add_times};
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::pair::is_valid;
use crate::score::curve::Curve;
use crate::score::flag::Flag;
use crate::score::value::{UndefinedReason, Value};
use crate::score::{Count, Variant};
use spread::{Cell, SpreadSums, mean};

/// Family of metrics computed from repeated presses.
pub(crate) static REPEATS: FamilyKind = FamilyKind::new("taceva.repeats/1", |plan| {
    erased(ByChannel::new(Repeats, plan))
});

/// Fields that metrics of repeated presses need, for at least two samples.
pub(crate) const REPEAT_NEEDS: Needs = Needs::new(
    FieldSet::EMPTY
        .with(Field::Prediction)
        .with(Field::Point)
        .with(Field::DepthStep)
        .with(Field::Repeat),
)
.with_least_samples(2);

/// Formula of a metric of repeated presses.
pub(crate) struct RepeatFormula {
    /// Computes value and variants from the spreads of one channel, whose unit is given.
    pub(crate) finish: fn(&SpreadSums, Unit) -> Numbers,
    /// True if the score includes the mean spread at each depth step.
    pub(crate) has_curve: bool,
    /// True if the score gets a flag when labels vary less than repeated predictions.
    pub(crate) needs_stimulus: bool,
}

fn formula(metric: &Metric) -> Option<&'static RepeatFormula> {
    metric.formula.get()
}

/// Collects predictions by contact point and depth step.
struct Repeats;

/// Predictions of one channel by contact point and depth step, and sums of its labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct RepeatSums {
    n: u64,
    n_invalid: u64,
    cells: Cells<Cell>,
    /// Count and sums of the labels of these presses, if they have labels. The standard deviation of the labels measures the stimulus.
    truth: Moments,
}

impl RepeatSums {
    /// True if the standard deviation of labels is below the pooled spread of repeated predictions. Differences of predictions are then noise.
    fn is_low_stimulus(&self) -> bool {
        let stimulus = self.truth.deviation(1);
        let spread = SpreadSums::of(&self.cells).pooled().ok();
        stimulus
            .zip(spread)
            .is_some_and(|(stimulus, spread)| stimulus < spread)
    }
}

impl Merge for RepeatSums {
    fn merge(&mut self, other: &RepeatSums) {
        self.merge_times(other, 1);
    }

    fn merge_times(&mut self, other: &RepeatSums, times: u32) {
        add_times(&mut self.n, other.n, times);
        add_times(&mut self.n_invalid, other.n_invalid, times);
        self.cells.merge_times(&other.cells, times);
        self.truth.merge_times(&other.truth, times);
    }
}

impl Channelwise for Repeats {
    type Sums = RepeatSums;

    fn deposit(
        &mut self,
        sums: &mut RepeatSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let (predictions, truths) = (batch.prediction(position), batch.truth(position));
        let mut cells = sums.cells.of_batch(batch);
        let Some(steps) = batch.numbers(Field::DepthStep) else {
            return;
        };
        each_row(batch, rows, |row| {
            let (Some(prediction), Some(step)) = (predictions.get(row), steps.get(row)) else {
                return;
            };
            let Some(step) = whole_step(step) else {
                sums.n_invalid += 1;
                return;
            };
            // A press without usable values still counts as a cell.
            let cell = cells.at(row, step);
            if is_valid(prediction) {
                cell.add(prediction);
                sums.n += 1;
                if let Some(truth) = truths.get(row).filter(|truth| is_valid(*truth)) {
                    sums.truth.add(truth);
                }
            } else {
                sums.n_invalid += 1;
            }
        });
    }

    fn to_record(&self, sums: &RepeatSums) -> Record {
        Record {
            counts: vec![
                sums.n,
                sums.n_invalid,
                u64::from(sums.cells.are_named()),
                sums.truth.n,
            ],
            sums: vec![sums.truth.sum.clone(), sums.truth.squares.clone()],
            cells: sums.cells.to_records(|cell| cell.moments().to_record()),
            ..Record::default()
        }
    }

    fn read_record(&self, record: &Record) -> Result<RepeatSums, String> {
        let (&[n, n_invalid, named, labels], [sum, squares]) = record.with_cells()?;
        let truth = Moments {
            n: labels,
            sum: sum.clone(),
            squares: squares.clone(),
        };
        let read = |record: &Record| Moments::read_record(record).map(Cell::new);
        Ok(RepeatSums {
            n,
            n_invalid,
            cells: Cells::from_record(record, named == 1, read)?,
            truth,
        })
    }

    fn count(&self, sums: &RepeatSums) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &RepeatSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, metric: &Metric, output: &Output, sums: &RepeatSums) -> Numbers {
        let spreads = SpreadSums::of(&sums.cells);
        match formula(metric) {
            Some(formula) => (formula.finish)(&spreads, output.unit),
            None => Numbers::of(Err(UndefinedReason::Empty)),
        }
    }

    fn details(&self, metric: &Metric, output: &Output, parts: &[&RepeatSums]) -> Details {
        let fewest = |count: fn(&RepeatSums) -> u64| parts.iter().map(|part| count(part)).min();
        let count = |name, count| Count {
            name,
            value: fewest(count).unwrap_or_default(),
        };
        let counts = vec![
            count("cells_valid", |sums| SpreadSums::of(&sums.cells).count()),
            count("cells_total", |sums| {
                sums.cells.iter().fold(0, |count, _| count + 1)
            }),
        ];
        let formula = formula(metric);
        let variants = match formula.is_some_and(|formula| formula.has_curve) {
            true => vec![Variant::plain("curve", output.unit, depth_curve(parts))],
            false => Vec::new(),
        };
        let is_low = formula.is_some_and(|formula| formula.needs_stimulus)
            && parts.iter().any(|part| part.is_low_stimulus());
        Details {
            variants,
            counts,
            flags: is_low.then_some(Flag::LowStimulus).into_iter().collect(),
            ..Details::default()
        }
    }
}

/// Curve of the mean spread of repeated predictions, over the contact points of each depth step. A plane has the mean of both channels.
fn depth_curve(parts: &[&RepeatSums]) -> Value {
    let mut steps: SortedMap<u32, (ExactSum, u64)> = SortedMap::default();
    for part in parts {
        if !part.cells.are_named() {
            return Value::Undefined(UndefinedReason::NoClusters);
        }
        for (key, cell) in part.cells.iter() {
            let (sum, count) = steps.entry(key.step());
            if let Some(spread) = cell.spread().filter(|spread| spread.variance.is_finite()) {
                sum.add(spread.deviation);
                *count += 1;
            }
        }
    }
    let channels = parts.iter().fold(0, |channels, _| channels + 1).max(1);
    Value::Curve(Curve {
        x: steps.iter().map(|(&step, _)| f64::from(step)).collect(),
        x_unit: Unit::One,
        values: steps
            .values()
            .map(|(sum, count)| mean(sum, *count).ok())
            .collect(),
        counts: steps.values().map(|(_, count)| count / channels).collect(),
        band: None,
    })
}

/// Converts a depth step to an integer; `None` if `step` is not a whole number from 0 to 2³² − 1.
fn whole_step(step: f64) -> Option<u32> {
    let whole = (0.0..=f64::from(u32::MAX)).contains(&step) && step.fract().abs() <= 0.0;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "checked to be whole and in range"
    )]
    whole.then_some(step as u32)
}
