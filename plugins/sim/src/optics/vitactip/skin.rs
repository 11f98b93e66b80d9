//! Brightness of the skin of the dome by its own lamps and by ambient light.

use super::spec::VitactipSpec;
use crate::optics::ambient::AmbientLight;

/// Weight of a place in the dome: 1 inside, 0 outside, with an edge of width `edge`.
///
/// # Units
/// Radii of the rim, in this function and in the functions below.
pub(super) fn inside(from_middle: f64, edge: f64) -> f64 {
    1.0 / (1.0 + libm::exp((from_middle - OUTLINE) / edge))
}

/// Radius of the visible outline, in radii of the rim: slightly outside the rim.
const OUTLINE: f64 = 47.0 / 46.0;

/// Light of the dome's own lamps on skin of brightness 1: uniform, brighter in the centre, and a ring inside the rim.
pub(super) fn glow(from_middle: f64) -> f64 {
    7.0 + 9.0 * bell(from_middle, 30.0 / 46.0) + 5.0 * bell(from_middle - 42.0 / 46.0, 3.0 / 46.0)
}

/// Light that a scene adds to the skin, in DN. It is fitted to mean grays of 17, 28, 34.5 and 47 DN under scenes S1 to S4. Without a scene, the mean
/// gray is 12 DN.
pub(super) fn outside(scene: AmbientLight, x: f64, y: f64) -> f64 {
    let from = |middle: f64| ((x - middle) * (x - middle) + y * y).sqrt();
    match scene {
        AmbientLight::Normal => 0.0,
        AmbientLight::Ceiling => 7.0,
        AmbientLight::WideBeam => 15.3 + 18.9 * bell(from(-8.0 / 46.0), 30.0 / 46.0),
        AmbientLight::Ring => 18.8 + 22.1 * bell(from(0.0) - 20.0 / 46.0, 18.0 / 46.0),
        AmbientLight::Spot => {
            let spot = 220.0 * bell(from(34.0 / 46.0), 16.1 / 46.0);
            20.6 + spot + 18.0 * bell(from(20.0 / 46.0), 30.0 / 46.0)
        }
    }
}

/// Brightness of the dome and its surroundings under the lamps of the dome, in DN.
pub(super) fn base(spec: &VitactipSpec, from_middle: f64, uneven: f64, edge: f64) -> f64 {
    let within = inside(from_middle, edge);
    let skin = spec.skin_dn * glow(from_middle);
    (within * skin + (1.0 - within) * spec.surroundings_dn) * (1.0 + spec.unevenness * uneven)
}

fn bell(x: f64, width: f64) -> f64 {
    libm::exp(-(x / width) * (x / width))
}
