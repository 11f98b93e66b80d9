//! Guarantees of every registered model, from training samples to model file.

pub(crate) mod case;
pub(crate) mod cases;
mod determinism;
mod files;
mod fits;
mod model_specific;
mod networks;
mod refusals;

use cases::BUILT_IN;
use taceva_models::ALL;

#[test]
fn no_model_is_registered_without_being_held_to_this() {
    let registered: Vec<&str> = ALL.iter().map(|info| info.name).collect();
    let held: Vec<&str> = BUILT_IN.iter().map(|case| case.name).collect();
    assert_eq!(registered, held);
}
