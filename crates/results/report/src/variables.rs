//! The four variables of the TacEva study.

/// Variables of the TacEva study, planes and normal axes, in the order of the tables of robustness.
pub(crate) const VARIABLES: [&str; 4] = ["Pxy", "Pz", "Fxy", "Fz"];
