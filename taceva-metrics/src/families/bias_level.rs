//! Mean error in each level of the truth. Levels are ranges of equal width.

mod window;

use taceva_core::{Batch, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Details, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::exact::level::{from_millionths, step};
use crate::exact::merge::{Merge, keyed, merge_cells};
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::exact::{Dyadic, ExactSum};
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::row_columns::Gathered;
use crate::pair::Paired;
use crate::score::curve::Curve;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, InapplicableReason, UndefinedReason, Value};
use crate::score::{Count, Parameter, Variant};
use window::Window;

/// Least number of samples in a level. Levels with fewer samples do not enter the score.
const LEAST_SAMPLES: u64 = 5;

pub(crate) static BIAS_LEVEL: Metric = Metric {
    id: "bias_level",
    title: "greatest mean error over the range",
    symbol: Some("bias by level"),
    theme: Theme::Accuracy,
    better: Better::Lower,
    unit: ScoreUnit::OfChannel,
    range: Range::Greatest,
    definition: "bias_level/1",
    reference: "mean of truth − prediction in steps of the truth",
    documentation: "Greatest magnitude of the mean error over the levels of the truth with five samples or more. It shows over- and \
                    underestimation that cancel in the bias of all samples. Levels are 0.1 mm, 0.1 N, 1 degree or 1 N mm wide, from −∞ \
                    to +∞, and hold their lower edge; `curve` has every level with samples. A greatest value has no interval.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_least_samples(LEAST_SAMPLES),
    constants: width_and_least,
    ..Metric::of(&KIND)
};

fn width_and_least(unit: Unit) -> Vec<Parameter> {
    let width = step(unit).map(|width| Parameter {
        name: "width",
        value: from_millionths(width),
    });
    let least = Parameter {
        name: "n_min",
        value: 5.0,
    };
    width.into_iter().chain([least]).collect()
}

/// Family of metrics computed from the errors in each level of the truth.
pub(crate) static KIND: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    is_whole: true,
    ..FamilyKind::new("taceva.levels/2", |plan| {
        erased(ByChannel::new(Levels::default(), plan))
    })
};

/// Adds errors to the level of their truth.
#[derive(Default)]
pub(crate) struct Levels {
    window: Window,
    gathered: Gathered,
}

/// Sums of the errors of one channel, by level of the truth.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LevelSums {
    n: u64,
    n_invalid: u64,
    /// Errors of each level, by its number ⌊truth / width⌋. Truth and width are in millionths of the channel's unit.
    levels: SortedMap<i64, LevelErrors>,
}

/// Number and exact sum of the errors in one level.
#[derive(Clone, Debug, Default, PartialEq)]
struct LevelErrors {
    n: u64,
    errors: ExactSum,
}

impl LevelErrors {
    fn add(&mut self, error: f64) {
        self.n += 1;
        self.errors.add(error);
    }

    /// Mean error over the samples of the level, rounded once.
    fn mean(&self) -> f64 {
        self.errors.to_dyadic().over(&Dyadic::from(self.n))
    }
}

/// Greatest magnitude of the mean error, over levels with at least five samples.
fn greatest_bias(sums: &LevelSums) -> Finished {
    match (sums.n, sums.n_invalid) {
        (0, 0) => return Err(UndefinedReason::Empty),
        (0, _) => return Err(UndefinedReason::NoMillionths),
        _ => {}
    }
    let enough = sums
        .levels
        .values()
        .filter(|level| level.n >= LEAST_SAMPLES);
    let biases = enough.map(|level| level.mean().abs());
    biases.max_by(f64::total_cmp).ok_or(UndefinedReason::NoBin {
        least: LEAST_SAMPLES,
    })
}

/// Curve of mean errors: one point for each level, at the middle of the level.
fn curve(sums: &LevelSums, unit: Unit, width: i64) -> Curve {
    let middle = |level: &i64| from_millionths(level * width + width / 2);
    Curve {
        x: sums.levels.iter().map(|(level, _)| middle(level)).collect(),
        x_unit: unit,
        values: sums
            .levels
            .values()
            .map(|level| Some(level.mean()))
            .collect(),
        counts: sums.levels.values().map(|level| level.n).collect(),
        band: None,
    }
}

impl Channelwise for Levels {
    type Sums = LevelSums;

    fn deposit(
        &mut self,
        sums: &mut LevelSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let Some(width) = step(batch.channels().as_slice()[position].unit()) else {
            return;
        };
        let columns = [batch.truth(position), batch.prediction(position)];
        let [reference, estimate] = self.gathered.rows(&columns, rows)[..] else {
            return;
        };
        let pairs = Paired {
            estimate,
            reference,
        };
        self.window.add(pairs, width, sums);
    }

    fn to_record(&self, sums: &LevelSums) -> Record {
        let level = |(level, errors): (&i64, &LevelErrors)| {
            let record = Record {
                counts: vec![errors.n],
                sums: vec![errors.errors.clone()],
                ..Record::default()
            };
            (level.to_string(), record)
        };
        Record {
            counts: vec![sums.n, sums.n_invalid],
            cells: keyed(sums.levels.iter().map(level)),
            ..Record::default()
        }
    }

    fn read_record(&self, record: &Record) -> Result<LevelSums, String> {
        let (&[n, n_invalid], []) = record.with_cells()?;
        // Beyond this limit a level has no representable middle.
        let parse = |text: &str| {
            let level = text
                .parse::<i64>()
                .ok()
                .filter(|level| level.abs() <= 1 << 40);
            level.filter(|level| level.to_string() == text)
        };
        let levels = record.read_cells(parse, |record| {
            let (&[n], [errors]) = record.exactly()?;
            let errors = errors.clone();
            Some(LevelErrors { n, errors })
                .filter(|_| n > 0)
                .ok_or("no sample".to_owned())
        })?;
        Ok(LevelSums {
            n,
            n_invalid,
            levels,
        })
    }

    fn count(&self, sums: &LevelSums) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &LevelSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &LevelSums) -> Numbers {
        Numbers::of(greatest_bias(sums))
    }

    fn inapplicable(&self, output: &Output) -> Option<InapplicableReason> {
        step(output.unit)
            .is_none()
            .then_some(InapplicableReason::NoStep(output.unit))
    }

    fn details(&self, _metric: &Metric, output: &Output, parts: &[&LevelSums]) -> Details {
        let (&[sums], Some(width)) = (parts, step(output.unit)) else {
            return Details::default();
        };
        let enough = sums
            .levels
            .values()
            .filter(|level| level.n >= LEAST_SAMPLES);
        let curve = Value::Curve(curve(sums, output.unit, width));
        Details {
            variants: vec![Variant::plain("curve", output.unit, curve)],
            counts: vec![Count {
                name: "bins_used",
                value: enough.fold(0, |count, _| count + 1),
            }],
            ..Details::default()
        }
    }
}

impl Merge for LevelSums {
    fn merge(&mut self, other: &LevelSums) {
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        merge_cells(&mut self.levels, &other.levels);
    }
}

impl Merge for LevelErrors {
    fn merge(&mut self, other: &LevelErrors) {
        self.n = self.n.saturating_add(other.n);
        self.errors.merge(&other.errors);
    }
}
