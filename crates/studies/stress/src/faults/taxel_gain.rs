//! Fault of signals: taxels whose gain is wrong.

use crate::fault::{Effect, Fault, Scope};
use crate::taxels::{BY_PARAMETER, TaxelChange, TaxelDraw, finite};

pub(super) static FAULT: Fault = Fault {
    id: "taxel_gain",
    title: "each number of a taxel is too large or too small by the same share: amplifiers that differ",
    parameter: "share by which a number is too large or too small",
    scope: Scope::Drawn,
    table: [0.01, 0.03, 0.1, 0.2, 0.4],
    most: 1.0,
    note: Some(BY_PARAMETER),
    effect: Effect::Taxels(TaxelChange {
        grows: false,
        change,
    }),
};

fn change(values: &mut [f32], drawn: &TaxelDraw<'_>) {
    for (counter, value) in (0_u64..).zip(values) {
        let gain = 1.0 + drawn.sign(counter) * drawn.parameter;
        *value = finite(gain * f64::from(*value));
    }
}
