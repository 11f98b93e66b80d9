//! Numbers with the unit in the type, for public signatures. These types get no further field, because the number is the only content.

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
    ///
    /// ```
    /// use taceva_core::Millimetre;
    /// assert_eq!(Millimetre(2.5).to_string(), "2.5 mm");
    /// ```
    Millimetre, "mm";
    /// A force in N.
    ///
    /// ```
    /// use taceva_core::Newton;
    /// assert_eq!(Newton(1.25).to_string(), "1.25 N");
    /// ```
    Newton, "N";
    /// A torque in N·mm.
    ///
    /// ```
    /// use taceva_core::NewtonMillimetre;
    /// assert_eq!(NewtonMillimetre(0.5).to_string(), "0.5 N·mm");
    /// ```
    NewtonMillimetre, "N·mm";
    /// An angle in degrees.
    ///
    /// ```
    /// use taceva_core::Degree;
    /// assert_eq!(Degree(-12.5).to_string(), "-12.5 deg");
    /// ```
    Degree, "deg";
    /// A rate in Hz.
    ///
    /// ```
    /// use taceva_core::Hertz;
    /// assert_eq!(Hertz(30.0).to_string(), "30 Hz");
    /// ```
    Hertz, "Hz";
    /// An illuminance in lx.
    ///
    /// ```
    /// use taceva_core::Lux;
    /// assert_eq!(Lux(480.0).to_string(), "480 lx");
    /// ```
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
