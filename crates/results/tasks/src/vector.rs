//! Lengths and angles of vectors in space, with the same bits on every machine.

/// Greatest magnitude of a coordinate, a depth and a size, mm. Squares and quotients of such numbers are finite.
pub(crate) const GREATEST_MM: f64 = 1e9;

/// Length of a vector, in the unit of its parts.
pub(crate) fn length([x, y, z]: [f64; 3]) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// Difference of two vectors.
pub(crate) fn minus(left: [f64; 3], right: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| left[axis] - right[axis])
}

/// Scalar product.
pub(crate) fn dot([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> f64 {
    a * x + b * y + c * z
}

/// Vector product.
pub(crate) fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Angle of the point (`along`, `across`) from the axis `along`, in degrees from −180 to 180.
///
/// Uses the arc tangent of `libm`, because results of platform libraries differ in their last bits. Unlike the arc cosine of a trace, this function
/// loses no digit near 0 and near a half turn.
pub(crate) fn degrees(across: f64, along: f64) -> f64 {
    libm::atan2(across, along).to_degrees()
}
