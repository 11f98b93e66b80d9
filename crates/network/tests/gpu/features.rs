//! Tests of the errors of a program without a GPU feature.

use taceva_network::{Gpu, GpuError, GpuKind};

#[test]
fn a_kind_that_was_not_built_names_its_feature() {
    for kind in GpuKind::ALL {
        match kind.check_built() {
            Ok(()) => {}
            Err(refusal) => {
                assert_eq!(refusal, GpuError::NotBuilt { kind });
                assert_eq!(Gpu::find(kind).expect_err("not built"), refusal);
                assert!(refusal.to_string().contains(&format!("--features {kind}")));
            }
        }
    }
}
