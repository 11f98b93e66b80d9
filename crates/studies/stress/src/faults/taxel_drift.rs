//! Fault of signals: taxels whose offset drifts with time.

use crate::fault::{Effect, Fault, Scope};
use crate::taxels::{BY_PARAMETER, TaxelChange, TaxelDraw, finite};

pub(super) static FAULT: Fault = Fault {
    id: "taxel_drift",
    title: "the offset of each number of a taxel grows or falls evenly with time: electronics that warm up",
    parameter: "offset gained or lost in an hour, share of the greatest change by contact",
    scope: Scope::Drawn,
    table: [0.005, 0.01, 0.02, 0.05, 0.1],
    most: 1.0,
    note: Some(BY_PARAMETER),
    effect: Effect::Taxels(TaxelChange {
        grows: true,
        change,
    }),
};

fn change(values: &mut [f32], drawn: &TaxelDraw<'_>) {
    let numbers = (0_u64..).zip(values).zip(drawn.full_scale.iter().cycle());
    for ((counter, value), full) in numbers {
        let offset = drawn.sign(counter) * drawn.parameter * drawn.hours * full;
        *value = finite(f64::from(*value) + offset);
    }
}
