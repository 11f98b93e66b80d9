//! The four variables of the study.

/// Variables of the study, in the order of its tables of robustness: planes and normal axes.
pub(crate) const VARIABLES: [&str; 4] = ["Pxy", "Pz", "Fxy", "Fz"];
