//! What stands in the list of skips where no feature builds an engine of a GPU, and `device.rs` with all its tests is not there.

#![cfg(not(any(feature = "cuda", feature = "wgpu")))]

use taceva_needs::{Need, skip};

#[test]
fn the_engines_of_gpus_are_tried_where_a_feature_builds_them() {
    skip(Need::Gpu, "built without the features `cuda` and `wgpu`");
}
