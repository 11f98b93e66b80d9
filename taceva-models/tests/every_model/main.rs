//! What every registered model promises, from its training samples to its file.

#[path = "../blobs/mod.rs"]
mod blobs;
mod case;
mod cases;
mod determinism;
mod files;
mod fits;
mod model_specific;
mod networks;
mod refusals;

use case::CASES;
use taceva_models::{ALL, Models};

/// The models that are tested here.
fn models() -> Models {
    Models::builtin()
}

#[test]
fn no_model_is_registered_without_being_held_to_this() {
    let registered: Vec<&str> = ALL.iter().map(|info| info.name).collect();
    let held: Vec<&str> = CASES.iter().map(|case| case.name).collect();
    assert_eq!(registered, held);
}
