//! Models of libraries keep what every model promises.
#![cfg(all(feature = "linfa", feature = "smartcore"))]

#[path = "../../../../taceva-models/tests/blobs/mod.rs"]
mod blobs;
#[path = "../../../../taceva-models/tests/every_model/case.rs"]
mod case;
mod cases;
#[path = "../../../../taceva-models/tests/every_model/determinism.rs"]
mod determinism;
#[path = "../../../../taceva-models/tests/every_model/files.rs"]
mod files;
#[path = "../../../../taceva-models/tests/every_model/fits.rs"]
mod fits;
#[path = "../../../../taceva-models/tests/every_model/refusals.rs"]
mod refusals;
mod registered;

use taceva_models::Models;

/// The models that are tested here.
fn models() -> Models {
    Models::builtin().with_libraries(taceva_baselines::all())
}
