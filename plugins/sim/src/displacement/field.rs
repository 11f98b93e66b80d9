//! Displacements of a profile that is placed at its contact.

use super::load::Load;
use super::profile::Profile;
use super::radial::Quantity;
use crate::number::narrow;

/// Displacements of the gel under one press, by position.
///
/// ```
/// use taceva_sim::displacement::{Field, Load, Profile, Tables};
/// let tables = Tables::new(4.25, 0.0);
/// let load = Load {
///     contact_radius_mm: 1.0,
///     depth_mm: 0.464,
///     indenter_radius_mm: 2.0,
///     young_modulus_mpa: 1.0,
///     normal_force_n: 1.0,
///     ..Load::default()
/// };
/// let mut profile = Profile::new();
/// tables.profile(&load, &mut profile);
/// let field = Field::new(&profile, &load);
/// let [x, y, up] = field.at(2.0, 0.0);
/// assert!(x > 0.0 && y == 0.0 && up < 0.0, "pushed outwards and down");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Field<'p> {
    profile: &'p Profile,
    centre: [f32; 2],
    shear: [f32; 2],
}

impl<'p> Field<'p> {
    /// Places `profile` at the contact of `load`.
    pub fn new(profile: &'p Profile, load: &Load) -> Field<'p> {
        Field {
            profile,
            centre: load.centre_mm.map(narrow),
            shear: load.shear_direction().map(narrow),
        }
    }

    /// Displacement of the point at `x_mm`, `y_mm`: along x, along y and upwards, out of the gel, in mm.
    pub fn at(&self, x_mm: f32, y_mm: f32) -> [f32; 3] {
        let [x, y] = [x_mm - self.centre[0], y_mm - self.centre[1]];
        let [shear_x, shear_y] = self.shear;
        let place = self.profile.locate(x * x + y * y);
        let value = |quantity| place.of(self.profile.table(quantity));
        let towards = x * shear_x + y * shear_y;
        let outward = value(Quantity::Outward) - towards * value(Quantity::Radial);
        let along = value(Quantity::Along);
        [
            x * outward + shear_x * along,
            y * outward + shear_y * along,
            towards * value(Quantity::Bulge) - value(Quantity::Sink),
        ]
    }

    /// Gradient of the height at `x_mm`, `y_mm`: derivatives with respect to x and y, mm/mm.
    pub fn slope(&self, x_mm: f32, y_mm: f32) -> [f32; 2] {
        let [x, y] = [x_mm - self.centre[0], y_mm - self.centre[1]];
        let [shear_x, shear_y] = self.shear;
        let place = self.profile.locate(x * x + y * y);
        let value = |quantity| place.of(self.profile.table(quantity));
        let towards = x * shear_x + y * shear_y;
        let radial = towards * value(Quantity::BulgeSlope) - value(Quantity::SinkSlope);
        let bulge = value(Quantity::Bulge);
        [x * radial + shear_x * bulge, y * radial + shear_y * bulge]
    }
}
