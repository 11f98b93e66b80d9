//! Fault of pictures: a camera or a program that repeats pictures.

use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "stale_frames",
    title: "the previous picture is repeated",
    parameter: "share of pictures",
    scope: Scope::Each,
    table: [0.01, 0.03, 0.1, 0.25, 0.5],
    most: 1.0,
    note: Some("the previous picture is that of the previous scored sample"),
    effect: Effect::Before,
};
