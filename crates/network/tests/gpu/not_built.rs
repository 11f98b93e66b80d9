//! Entry in the list of skipped tests for builds without a GPU feature, which lack `device.rs` and its tests.

#![cfg(not(any(feature = "cuda", feature = "wgpu")))]

use taceva_needs::{Need, skip};

#[test]
fn the_engines_of_gpus_are_tried_where_a_feature_builds_them() {
    skip(Need::Gpu, "built without the features `cuda` and `wgpu`");
}
