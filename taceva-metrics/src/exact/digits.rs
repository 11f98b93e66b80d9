//! Where the digits of an exact sum lie.

/// Digits of the whole range: from below the square of the least denormal to above 2⁶⁴ squares of the greatest number.
pub(super) const DIGITS: usize = 140;
/// The weight of bit 0 of digit 0 is 2 to this power.
pub(super) const UNIT_EXPONENT: i32 = -2176;
