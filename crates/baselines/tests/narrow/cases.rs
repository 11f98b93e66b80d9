//! The model that needs at least as many samples as features, as the suite fits it.

use crate::case::{Case, case};

pub(crate) const CASES: &[Case] = &[Case {
    least: 16,
    order: Some(1e-2),
    ..case("smartcore/svr", &[], 1.0)
}];
