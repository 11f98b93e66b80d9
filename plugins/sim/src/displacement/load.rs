//! Load on a gel, as input of displacements.

/// A round contact with pressure and shear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Centre of the contact on the surface.
    pub centre_mm: [f64; 2],
    /// Contact radius a.
    pub contact_radius_mm: f64,
    /// Depth of the ball along its contact normal.
    pub depth_mm: f64,
    /// Radius of the ball.
    pub indenter_radius_mm: f64,
    /// Effective modulus of the gel at this depth.
    pub young_modulus_mpa: f64,
    /// Force along the normal, positive into the gel.
    pub normal_force_n: f64,
    /// Shear force of the ball on the gel, x and y.
    pub shear_force_n: [f64; 2],
}

impl Load {
    /// Magnitude of the shear force.
    pub fn shear_n(&self) -> f64 {
        let [x, y] = self.shear_force_n;
        (x * x + y * y).sqrt()
    }

    /// Direction of the shear force as a unit vector; along x without shear.
    pub fn shear_direction(&self) -> [f64; 2] {
        let size = self.shear_n();
        if size > 0.0 {
            self.shear_force_n.map(|component| component / size)
        } else {
            [1.0, 0.0]
        }
    }
}
