//! Numbers that carry their unit in their type, for public signatures where a bare `f64` would be guessed at.

use std::fmt;

macro_rules! quantity {
    ($($(#[$doc:meta])* $name:ident, $symbol:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name(pub f64);

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)?;
                f.write_str(concat!(" ", $symbol))
            }
        }
    )*};
}

quantity! {
    /// A length or a position in mm.
    Millimetre, "mm";
    /// A force in N.
    Newton, "N";
    /// A torque in N·mm.
    NewtonMillimetre, "N·mm";
    /// An angle in degrees.
    Degree, "deg";
    /// A rate in Hz.
    Hertz, "Hz";
    /// An illuminance in lx.
    Lux, "lx";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantity_prints_with_its_unit() {
        assert_eq!(Millimetre(2.5).to_string(), "2.5 mm");
        assert_eq!(format!("{:.1}", Newton(1.25)), "1.2 N");
    }
}
