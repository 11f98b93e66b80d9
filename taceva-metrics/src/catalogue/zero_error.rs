//! Mean predicted force without contact.

use taceva_core::Unit;

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::moments::Moments;
use crate::families::idle::{GATE_N, IDLE, IDLE_NEEDS, IdleFormula, enough};
use crate::score::Parameter;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::UndefinedReason;

pub(crate) static ZERO_ERROR: Metric = Metric {
    id: "zero_error",
    title: "error at zero",
    symbol: Some("$F_0$"),
    theme: Theme::Detail,
    better: Better::NearZero,
    unit: ScoreUnit::OfChannel,
    range: Range::Any,
    definition: "zero_error/1",
    reference: "VIM 4.28, zero error: the measurement error where the value is zero",
    documentation: "Mean force that is predicted without contact, |true Fz| < 0.02 N; a tare removes it. Forces only, from ten such \
                    samples on. It may exceed the noise-equivalent force.",
    needs: IDLE_NEEDS,
    forces_only: true,
    constants: gate,
    formula: Formula(&IdleFormula(zero_error)),
    ..Metric::of(&IDLE)
};

fn gate(_: Unit) -> Vec<Parameter> {
    vec![Parameter {
        name: "gate",
        value: GATE_N,
    }]
}

/// Mean of the predictions without contact, rounded once.
fn zero_error(predictions: &Moments, _: Unit) -> Numbers {
    let mean = enough(predictions).and_then(|()| predictions.mean().ok_or(UndefinedReason::Empty));
    Numbers::of(mean)
}
