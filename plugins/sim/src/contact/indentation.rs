//! The movement of a ball into a body.

/// Where a ball goes, from the place where it would just touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indentation {
    /// Where it comes down.
    pub place_mm: [f64; 2],
    /// How far below touching it stands.
    pub depth_mm: f64,
    /// How far below touching it has been: more than `depth_mm` on the way out.
    pub deepest_mm: f64,
    /// How far it is dragged along the surface, once deep.
    pub shear_mm: [f64; 2],
    /// Its radius.
    pub indenter_radius_mm: f64,
    /// How stiff the gel is here over its nominal stiffness.
    pub stiffness: f64,
}
