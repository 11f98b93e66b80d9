//! Movement of a ball into a gel.

/// Displacement of a ball from first touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indentation {
    /// Place of first touch.
    pub place_mm: [f64; 2],
    /// Depth below first touch.
    pub depth_mm: f64,
    /// Maximum depth that was reached. It exceeds `depth_mm` during unloading.
    pub deepest_mm: f64,
    /// Displacement of the ball along the surface after the indentation.
    pub shear_mm: [f64; 2],
    /// Radius of the ball.
    pub indenter_radius_mm: f64,
    /// Stiffness of the gel at `place_mm`, relative to its nominal stiffness.
    pub stiffness: f64,
}
