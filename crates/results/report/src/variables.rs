//! The four variables of the study.

/// Variables of the study, planes and normal axes, in the order of the tables of robustness.
pub(crate) const VARIABLES: [&str; 4] = ["Pxy", "Pz", "Fxy", "Fz"];
