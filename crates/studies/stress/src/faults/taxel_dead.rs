//! Fault of signals: taxels that no longer respond.

use crate::fault::{Effect, Fault, Scope};
use crate::taxels::{BY_PARAMETER, TaxelChange, TaxelDraw};

pub(super) static FAULT: Fault = Fault {
    id: "taxel_dead",
    title: "taxels give 0 in every number: a broken wire",
    parameter: "share of taxels",
    scope: Scope::Drawn,
    table: [0.01, 0.02, 0.05, 0.1, 0.2],
    most: 1.0,
    note: Some(BY_PARAMETER),
    effect: Effect::Taxels(TaxelChange {
        grows: false,
        change,
    }),
};

fn change(values: &mut [f32], drawn: &TaxelDraw<'_>) {
    for (counter, taxel) in (0_u64..).zip(values.chunks_mut(drawn.channels)) {
        if drawn.draws.unit(counter) < drawn.parameter {
            taxel.fill(0.0);
        }
    }
}
