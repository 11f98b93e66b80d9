//! Radial functions in a table.

/// Radial functions, for unit force, unit modulus and unit contact radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Quantity {
    /// Depth of the surface under pressure, into the gel.
    Sink,
    /// Derivative of the depth with respect to the radius r, divided by r.
    SinkSlope,
    /// Outward displacement under pressure, divided by the radius r.
    Outward,
    /// Displacement along the shear direction that is independent of the angle: A₀ + A₂, the Hankel integrals of orders 0 and 2.
    Along,
    /// Displacement towards the axis of the shear, divided by the squared radius r²: 2 A₂/r², with the Hankel integral A₂ of order 2.
    Radial,
    /// Height of the bulge ahead of the shear, on the axis of the shear, divided by the radius r.
    Bulge,
    /// Derivative of the bulge over r with respect to the radius r, divided by r.
    BulgeSlope,
}

impl Quantity {
    /// All quantities, in the order of their numbers.
    pub const ALL: [Quantity; 7] = [
        Quantity::Sink,
        Quantity::SinkSlope,
        Quantity::Outward,
        Quantity::Along,
        Quantity::Radial,
        Quantity::Bulge,
        Quantity::BulgeSlope,
    ];

    /// True for responses to the shear, false for responses to the pressure.
    pub(super) const fn is_of_shear(self) -> bool {
        !matches!(
            self,
            Quantity::Sink | Quantity::SinkSlope | Quantity::Outward
        )
    }

    /// Power p of the contact radius a in the scale of the quantity, F/(E aᵖ), with the force F and the modulus E.
    pub(super) const fn radius_power(self) -> u8 {
        match self {
            Quantity::Sink | Quantity::Along => 1,
            Quantity::Outward | Quantity::Bulge => 2,
            Quantity::SinkSlope | Quantity::Radial => 3,
            Quantity::BulgeSlope => 4,
        }
    }
}
