//! Share of predictions within a tolerance of the truth.

use taceva_core::{Batch, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Details, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::evaluate::plan::MetricPlan;
use crate::exact::Dyadic;
use crate::exact::level::{from_millionths, millionths, step};
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::families::channelwise::{ByChannel, Channelwise};
use crate::families::row_columns::Gathered;
use crate::score::curve::Curve;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, InapplicableReason, UndefinedReason, Value};
use crate::score::verdict_rule::{OF_CONSTANT, VerdictRule};
use crate::score::{Parameter, Variant};

/// Tolerances in thousandths of the unit's [`step`]. They are 0.01 to 2 mm or N, and 0.1 to 20 degrees or N mm.
const TOLERANCES: [i64; 8] = [100, 200, 500, 1000, 2000, 5000, 10_000, 20_000];
/// Index of the tolerance of the score: 0.05 mm or N, 0.5 degrees or N mm.
const HEADLINE: usize = 2;

pub(crate) static TOLERANCE: Metric = Metric {
    id: "tolerance",
    title: "share within tolerance",
    theme: Theme::Accuracy,
    better: Better::Higher,
    unit: ScoreUnit::One,
    range: Range::Share,
    definition: "tolerance/1",
    reference: "distribution of |truth − prediction|",
    documentation: "Share of predictions within 0.05 mm or 0.05 N of the truth, 0.5 for degrees and N mm; `curve` has the share for \
                    tolerances from 0.01 to 2, or 0.1 to 20. Truth and prediction are first rounded to a millionth of the unit, so 0.40 \
                    is within 0.05 of 0.35; an error equal to the tolerance is within it. `of_constant` is the share that the constant \
                    of the skill score reaches, if the training part is known. A score takes part in verdicts only if its interval is \
                    above that share.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_least_samples(1),
    constants: headline,
    verdict: VerdictRule::ShareBesideConstant,
    ..Metric::of(&KIND)
};

fn headline(unit: Unit) -> Vec<Parameter> {
    let tolerance = tolerances(unit).map(|tolerances| Parameter {
        name: "tolerance",
        value: from_millionths(tolerances[HEADLINE]),
    });
    tolerance.into_iter().collect()
}

/// Tolerances for `unit` in millionths of it, ascending; `None` if no tolerances are defined for the unit.
fn tolerances(unit: Unit) -> Option<[i64; 8]> {
    let step = step(unit)?;
    Some(TOLERANCES.map(|thousandths| step / 1000 * thousandths))
}

/// Metric family that counts errors by magnitude.
pub(crate) static KIND: FamilyKind = FamilyKind {
    clusters_of_plan: true,
    ..FamilyKind::new("taceva.tolerances/1", |plan| {
        erased(ByChannel::new(Tolerances::for_plan(plan), plan))
    })
};

/// Family that counts the errors of each channel by tolerance.
pub(crate) struct Tolerances {
    /// Constant prediction with which skill compares the model, for each channel, in millionths of the unit. `None` if the training part is
    /// unknown.
    constants: Vec<Option<i64>>,
    gathered: Gathered,
}

impl Tolerances {
    /// Creates the family for the channels and constants of `plan`.
    pub(crate) fn for_plan(plan: &MetricPlan) -> Tolerances {
        let channels = plan.channels().iter();
        let constants = channels.map(|channel| plan.constant(channel.name()).and_then(millionths));
        Tolerances {
            constants: constants.collect(),
            gathered: Gathered::default(),
        }
    }

    /// Share of true values within the tolerance of a constant prediction; for two channels, the mean of both shares. `None` if a constant is
    /// unknown.
    fn of_constant(&self, positions: &[usize], parts: &[&ErrorCounts]) -> Option<f64> {
        let share = |(position, sums): (&usize, &&ErrorCounts)| {
            let of_constant = sums.of_constant.filter(|_| sums.n > 0)?;
            let is_of_model = self.constants[*position] == Some(of_constant.constant);
            is_of_model.then(|| Dyadic::from(of_constant.met).over(&Dyadic::from(sums.n)))
        };
        let shares: Option<Vec<f64>> = positions.iter().zip(parts).map(share).collect();
        match shares?[..] {
            [share] => Some(share),
            [x, y] => Some(f64::midpoint(x, y)),
            _ => None,
        }
    }
}

/// Index of the smallest tolerance that is at least `error`; the number of tolerances if `error` exceeds all of them.
#[inline]
fn class(error: i64, tolerances: &[i64; 8]) -> usize {
    // Bisection without branches, as the class of an error is unpredictable.
    let mut class = 4 * usize::from(error > tolerances[3]);
    class += 2 * usize::from(error > tolerances[class + 1]);
    class += usize::from(error > tolerances[class]);
    class + usize::from(error > tolerances[7])
}

/// Counts of the errors of one channel, grouped by tolerance.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ErrorCounts {
    n: u64,
    n_invalid: u64,
    /// Number of errors for each tolerance: above the previous tolerance, up to this tolerance.
    classes: [u64; TOLERANCES.len()],
    /// Count for the constant prediction of the channel. `None` if the constant is unknown, or if samples have models with different constants.
    of_constant: Option<OfConstant>,
}

/// Number of true values within the score's tolerance of a constant prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OfConstant {
    /// Constant prediction, in millionths of the unit.
    constant: i64,
    met: u64,
}

impl OfConstant {
    /// Adds the count of `other`; `None` if both have different constants.
    fn and(self, other: OfConstant) -> Option<OfConstant> {
        (self.constant == other.constant).then(|| OfConstant {
            met: self.met.saturating_add(other.met),
            ..self
        })
    }
}

impl ErrorCounts {
    /// Share of errors within the tolerance at index `position`, rounded once.
    fn share(&self, position: usize) -> Finished {
        match (self.n, self.n_invalid) {
            (0, 0) => return Err(UndefinedReason::Empty),
            (0, _) => return Err(UndefinedReason::NoMillionths),
            _ => {}
        }
        let within: u64 = self.classes[..=position].iter().sum();
        Ok(Dyadic::from(within).over(&Dyadic::from(self.n)))
    }
}

impl Channelwise for Tolerances {
    type Sums = ErrorCounts;

    fn deposit(
        &mut self,
        sums: &mut ErrorCounts,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let Some(tolerances) = tolerances(batch.channels().as_slice()[position].unit()) else {
            return;
        };
        let columns = [batch.truth(position), batch.prediction(position)];
        let [truths, estimates] = self.gathered.rows(&columns, rows)[..] else {
            return;
        };
        let mut counted = ErrorCounts::default();
        let mut classes = [0; TOLERANCES.len() + 1];
        let constant = self.constants[position];
        let mut met = 0;
        for (truth, estimate) in truths.iter().zip(estimates) {
            let Some((truth, estimate)) = millionths(*truth).zip(millionths(*estimate)) else {
                counted.n_invalid += 1;
                continue;
            };
            counted.n += 1;
            classes[class((truth - estimate).abs(), &tolerances)] += 1;
            if let Some(constant) = constant {
                met += u64::from(truth.abs_diff(constant) <= tolerances[HEADLINE].unsigned_abs());
            }
        }
        counted
            .classes
            .copy_from_slice(&classes[..TOLERANCES.len()]);
        let constant = constant.filter(|_| counted.n > 0);
        counted.of_constant = constant.map(|constant| OfConstant { constant, met });
        sums.merge(&counted);
    }

    fn to_record(&self, sums: &ErrorCounts) -> Record {
        let counts = [sums.n, sums.n_invalid].into_iter().chain(sums.classes);
        let of_constant = sums
            .of_constant
            .map(|of| [of.constant.cast_unsigned(), of.met]);
        Record {
            counts: counts.chain(of_constant.into_iter().flatten()).collect(),
            ..Record::default()
        }
    }

    fn read_record(&self, record: &Record) -> Result<ErrorCounts, String> {
        // The record has two numbers fewer if no constant is known.
        let ((n, n_invalid, classes), of_constant) = match record.counts.len() {
            10 => {
                let (&[n, n_invalid, ref classes @ ..], []) = record.exactly::<10, 0>()?;
                ((n, n_invalid, *classes), None)
            }
            _ => {
                let (&[n, n_invalid, ref classes @ .., constant, met], []) =
                    record.exactly::<12, 0>()?;
                let constant = constant.cast_signed();
                ((n, n_invalid, *classes), Some(OfConstant { constant, met }))
            }
        };
        let within = classes
            .iter()
            .try_fold(0_u64, |sum, count| sum.checked_add(*count));
        let is_possible = within.is_some_and(|within| within <= n)
            && of_constant.is_none_or(|of_constant| of_constant.met <= n);
        if !is_possible {
            return Err(format!("classes hold more than {n} errors"));
        }
        Ok(ErrorCounts {
            n,
            n_invalid,
            classes,
            of_constant,
        })
    }

    fn count(&self, sums: &ErrorCounts) -> u64 {
        sums.n
    }

    fn invalid(&self, sums: &ErrorCounts) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, _output: &Output, sums: &ErrorCounts) -> Numbers {
        Numbers::of(sums.share(HEADLINE))
    }

    fn inapplicable(&self, output: &Output) -> Option<InapplicableReason> {
        let unknown = tolerances(output.unit).is_none();
        unknown.then_some(InapplicableReason::NoStep(output.unit))
    }

    fn details(&self, _metric: &Metric, output: &Output, parts: &[&ErrorCounts]) -> Details {
        let of_constant = self.of_constant(&output.parts, parts);
        let of_constant =
            of_constant.map(|share| Variant::plain(OF_CONSTANT, Unit::One, Value::Scalar(share)));
        let (&[sums], Some(tolerances)) = (parts, tolerances(output.unit)) else {
            return Details {
                variants: of_constant.into_iter().collect(),
                ..Details::default()
            };
        };
        let positions = 0..tolerances.len();
        let curve = Curve {
            x: tolerances.map(from_millionths).to_vec(),
            x_unit: output.unit,
            values: positions
                .map(|position| sums.share(position).ok())
                .collect(),
            counts: vec![sums.n; tolerances.len()],
            band: None,
        };
        Details {
            variants: std::iter::once(Variant::plain("curve", Unit::One, Value::Curve(curve)))
                .chain(of_constant)
                .collect(),
            ..Details::default()
        }
    }
}

impl Merge for ErrorCounts {
    fn merge(&mut self, other: &ErrorCounts) {
        self.of_constant = match (self.n, other.n) {
            (0, _) => other.of_constant,
            (_, 0) => self.of_constant,
            _ => self
                .of_constant
                .zip(other.of_constant)
                .and_then(|(own, others)| own.and(others)),
        };
        self.n = self.n.saturating_add(other.n);
        self.n_invalid = self.n_invalid.saturating_add(other.n_invalid);
        for (class, other) in self.classes.iter_mut().zip(other.classes) {
            *class = class.saturating_add(other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_class_of_an_error_is_the_least_tolerance_that_it_is_within() {
        let tolerances = tolerances(Unit::Millimetre).expect("levels of millimetres");
        let near = |tolerance: &i64| [tolerance - 1, *tolerance, tolerance + 1];
        for error in tolerances.iter().flat_map(near).chain([0, 1, i64::MAX]) {
            let least = tolerances.iter().position(|tolerance| error <= *tolerance);
            assert_eq!(class(error, &tolerances), least.unwrap_or(8), "{error}");
        }
    }
}
