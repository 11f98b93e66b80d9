//! Input and output of the contact laws.

/// Position of a ball in a body, for the layer law and for the dome law.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    /// Indentation along the normal.
    pub(super) normal_depth_mm: f64,
    /// Outward normal.
    pub(super) normal: [f64; 3],
    /// Displacement along the surface since first touch.
    pub(super) slide: [f64; 3],
}

/// Response of a body to an indentation along the normal.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Answer {
    /// Normal force.
    pub(super) force_n: f64,
    /// Tangential stiffness.
    pub(super) shear_n_per_mm: f64,
    /// Contact radius.
    pub(super) radius_mm: f64,
    /// Effective modulus.
    pub(super) young_modulus_mpa: f64,
    /// Share of the skin in the force.
    pub(super) skin_share: f64,
}

/// Scalar product.
pub(super) fn dot(left: [f64; 3], right: [f64; 3]) -> f64 {
    left[0] * right[0] + left[1] * right[1] + left[2] * right[2]
}
