//! Radial functions in a table.

/// Radial functions, in the units of a unit force on a unit modulus at unit contact radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Quantity {
    /// Depth of the surface under pressure, into the gel.
    Sink,
    /// Derivative of the depth by r, over r.
    SinkSlope,
    /// Outward displacement under pressure, over r.
    Outward,
    /// Displacement along the shear that is independent of the angle: A₀ + A₂.
    Along,
    /// Displacement towards the shear's axis, over r²: 2 A₂/r².
    Radial,
    /// Height of the bulge in front of the shear on its axis, over r.
    Bulge,
    /// Derivative by r of the bulge over r, over r.
    BulgeSlope,
}

impl Quantity {
    /// All quantities, in order of their numbers.
    pub const ALL: [Quantity; 7] = [
        Quantity::Sink,
        Quantity::SinkSlope,
        Quantity::Outward,
        Quantity::Along,
        Quantity::Radial,
        Quantity::Bulge,
        Quantity::BulgeSlope,
    ];

    /// True for responses to the shear, false for those to the pressure.
    pub(super) const fn is_of_shear(self) -> bool {
        !matches!(
            self,
            Quantity::Sink | Quantity::SinkSlope | Quantity::Outward
        )
    }

    /// Power of the contact radius in the denominator of its unit.
    pub(super) const fn radius_power(self) -> u8 {
        match self {
            Quantity::Sink | Quantity::Along => 1,
            Quantity::Outward | Quantity::Bulge => 2,
            Quantity::SinkSlope | Quantity::Radial => 3,
            Quantity::BulgeSlope => 4,
        }
    }
}
