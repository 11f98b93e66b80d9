//! Skill: improvement over a constant prediction.

use crate::evaluate::family::{Details, Output};
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::exact::single::exactly;
use crate::exact::streams::{Stream, Streams};
use crate::families::accuracy::pair_sums::PairSums;
use crate::families::accuracy::pairs::{Axis, PAIR_NEEDS, PAIRS, PairFinish, PairFormula};
use crate::score::Variant;
use crate::score::direction::Better;
use crate::score::flag::Flag;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason, Value};
use crate::score::verdict_rule::VerdictRule;

pub(crate) static SKILL: Metric = Metric {
    id: "skill",
    title: "skill score",
    symbol: Some("skill"),
    theme: Theme::Accuracy,
    better: Better::Higher,
    variants: &[("constant", Better::Described)],
    unit: ScoreUnit::One,
    range: Range::BelowOne,
    definition: "skill/1",
    reference: "mean squared error skill score: Murphy 1988, Monthly Weather Review 116",
    documentation: "Share of the squared error of a constant prediction that the model removes: 1 − MSE of the model / MSE of the constant. \
                    1 is perfect, and 0 is no better than the constant. The constant is the mean of the training labels. If those are \
                    unknown, it is the mean of the evaluated truth, and the score is flagged. In a plane, both errors are \
                    squared distances and the constant is a point. A channel takes part in verdicts only if its 95 % interval is above \
                    zero.",
    needs: PAIR_NEEDS,
    verdict: VerdictRule::Skill,
    formula: Formula(&PairFormula {
        streams: STREAMS,
        gated: false,
        count: PairSums::n,
        finish: PairFinish::Axes {
            value: skill,
            details,
        },
    }),
    ..Metric::of(&PAIRS)
};

/// Sums of pairs that skill needs.
const STREAMS: Streams = Streams::of(&[Stream::Squared, Stream::Truth, Stream::TruthSquared]);

/// Skill: 1 − (squared errors of the model) / (squared errors of the constant prediction), each summed over the axes, rounded once.
///
/// Each axis of a plane has its own number of pairs. If both axes have all pairs, both sums are sums of squared distances in the plane.
fn skill(axes: &[Axis<'_>]) -> Finished {
    let mut total = Parts {
        scale: Dyadic::from(1),
        unexplained: Dyadic::from(0),
        spread: Dyadic::from(0),
    };
    for axis in axes {
        total = total.and(&Parts::of(*axis)?);
    }
    if total.spread.is_zero() {
        return Err(UndefinedReason::ConstantTruth {
            perfect: total.unexplained.is_zero(),
        });
    }
    Ok((&total.spread - &total.unexplained).over(&total.spread))
}

/// Constant prediction for an axis: the given constant, or the mean of truth. `None` for an axis without both.
fn constant(axis: Axis<'_>) -> Option<f64> {
    let mean = || (axis.sums.n() > 0).then(|| axis.sums.mean(Stream::Truth));
    axis.constant.or_else(mean)
}

/// Constant prediction of a score of one channel, and a flag if a constant is the mean of truth.
fn details(axes: &[Axis<'_>], output: &Output) -> Details {
    let is_mean = axes.iter().any(|axis| axis.constant.is_none());
    let variants = match axes[..] {
        [axis] => constant(axis)
            .map(|constant| Variant::plain("constant", output.unit, Value::Scalar(constant))),
        _ => None,
    };
    Details {
        variants: variants.into_iter().collect(),
        flags: is_mean.then_some(Flag::MeanOfTruth).into_iter().collect(),
        ..Details::default()
    }
}

/// Squared errors of the model and of the constant prediction, both multiplied by `scale`.
struct Parts {
    scale: Dyadic,
    unexplained: Dyadic,
    spread: Dyadic,
}

impl Parts {
    fn of(axis: Axis<'_>) -> Result<Parts, UndefinedReason> {
        let Axis { sums, constant } = axis;
        let squared = sums.sum(Stream::Squared).to_dyadic();
        let n = Dyadic::from(sums.n());
        match (sums.n(), constant) {
            (0, _) => Err(UndefinedReason::Empty),
            (1, None) => Err(UndefinedReason::TooFew { least: 2 }),
            (_, None) => Ok(Parts {
                unexplained: &n * &squared,
                spread: sums.scaled_spread(),
                scale: n,
            }),
            (_, Some(constant)) => {
                let constant = exactly(constant);
                let truth = sums.sum(Stream::Truth).to_dyadic();
                let twice = &Dyadic::from(2) * &(&constant * &truth);
                let moved = &sums.sum(Stream::TruthSquared).to_dyadic() - &twice;
                Ok(Parts {
                    scale: Dyadic::from(1),
                    unexplained: squared,
                    spread: &moved + &(&n * &(&constant * &constant)),
                })
            }
        }
    }

    /// Sum of `self` and `other`, on a common scale.
    fn and(&self, other: &Parts) -> Parts {
        let joined =
            |own: &Dyadic, others: &Dyadic| &(own * &other.scale) + &(others * &self.scale);
        Parts {
            unexplained: joined(&self.unexplained, &other.unexplained),
            spread: joined(&self.spread, &other.spread),
            scale: &self.scale * &other.scale,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::accuracy::pair_sums::PairSpec;
    use crate::pair::Paired;

    fn sums(estimate: &[f64], reference: &[f64]) -> PairSums {
        let mut sums = PairSums::new(PairSpec {
            streams: STREAMS,
            gate: None,
        });
        sums.update(Paired {
            estimate,
            reference,
        });
        sums
    }

    fn about(sums: &PairSums, constant: Option<f64>) -> Axis<'_> {
        Axis { sums, constant }
    }

    #[test]
    fn it_agrees_with_a_calculation_by_hand_about_both_constants() {
        // Errors 0, 1, 0; truths 1, 2, 6: about 1 the constant misses 0, 1, 25, about their mean 3 it misses 4, 1, 9.
        let sums = sums(&[1.0, 3.0, 6.0], &[1.0, 2.0, 6.0]);
        assert_eq!(skill(&[about(&sums, Some(1.0))]), Ok(1.0 - 1.0 / 26.0));
        assert_eq!(skill(&[about(&sums, None)]), Ok(1.0 - 1.0 / 14.0));
        assert_eq!(constant(about(&sums, None)), Some(3.0));
    }

    #[test]
    fn the_constant_itself_has_no_skill_but_for_the_rounding_of_its_residuals() {
        let constant = 0.1 + 0.2;
        let sums = sums(&[constant; 3], &[0.7, -1.9, 0.3]);
        let skill = skill(&[about(&sums, Some(constant))]).expect("a spread");
        assert!(skill.abs() < 1e-15, "{skill}");
    }

    #[test]
    fn in_a_plane_squared_distances_take_the_place_of_squares() {
        // Distances² of the predictions: 1 + 4 and 0; of the point (0, 0): 9 + 16 and 0 + 1.
        let x = sums(&[4.0, 0.0], &[3.0, 0.0]);
        let y = sums(&[2.0, 1.0], &[4.0, 1.0]);
        let origin = Some(0.0);
        assert_eq!(
            skill(&[about(&x, origin), about(&y, origin)]),
            Ok(1.0 - 5.0 / 26.0)
        );
        // About the mean (1.5, 2.5): 2.25 + 2.25 and 2.25 + 2.25.
        assert_eq!(
            skill(&[about(&x, None), about(&y, None)]),
            Ok(1.0 - 5.0 / 9.0)
        );
    }

    #[test]
    fn without_a_spread_about_the_constant_there_is_no_skill_to_speak_of() {
        let perfect = sums(&[2.0, 2.0], &[2.0, 2.0]);
        let constant = Err(UndefinedReason::ConstantTruth { perfect: true });
        assert_eq!(skill(&[about(&perfect, None)]), constant);
        assert_eq!(skill(&[about(&perfect, Some(2.0))]), constant);
        assert_eq!(skill(&[about(&perfect, Some(1.0))]), Ok(1.0));
        let nothing = sums(&[], &[]);
        assert_eq!(
            skill(&[about(&nothing, Some(1.0))]),
            Err(UndefinedReason::Empty)
        );
        let one = sums(&[1.0], &[2.0]);
        assert_eq!(
            skill(&[about(&one, None)]),
            Err(UndefinedReason::TooFew { least: 2 })
        );
    }
}
