//! Fault of times: rows (samples) that a recorder loses.

use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "dropped_frames",
    title: "rows of the recording are left out: a camera, a bus or a disk that is too slow",
    parameter: "share of rows",
    scope: Scope::Each,
    table: [0.01, 0.03, 0.1, 0.25, 0.5],
    most: 1.0,
    note: Some(
        "the fault leaves the errors of the other rows as they are, so only metrics of time are computed, from all rows of the recording; \
         its severity is its parameter",
    ),
    effect: Effect::Rows,
};
