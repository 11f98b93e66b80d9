//! Printed lattice: three patterns at three depths.

use std::f64::consts::TAU;

use super::spec::MagictacSpec;
use crate::number::{count, narrow};
use crate::optics::texture::{SIDE, Texture, smooth_noise};
use crate::random::{Purpose, Random};

/// Texel of a layer, mm. The pattern repeats after 128 texels, 23 mm, beyond the visible field.
const TEXEL_MM: f64 = 0.18;
/// Correlation length of the speckle, in texels; the next constant is the correlation length of the unevenness of the lines.
const SPECKLE: f64 = 2.2;
const UNEVENNESS: f64 = 20.0;
/// Standard deviation of the position of a line, mm.
const LINE_JITTER_MM: f64 = 0.22;
/// Correlation length of the buckling, in texels: 1.5 mm, two cells of the lattice.
const BUCKLE: f64 = 8.0;

/// Lines and speckle of the three layers of a unit: contrast around 0, red, green, blue.
pub(super) fn layers(spec: &MagictacSpec, unit: u32) -> [Texture; 3] {
    let random = Random::new(u64::from(unit));
    let [lines, speckle] = spec.contrast;
    // A whole number of lines on the torus, so the pattern has no seam.
    let periods = (count(SIDE) * TEXEL_MM / spec.pitch_mm).round().max(1.0);
    [0, 1, 2].map(|layer| {
        let stream = random.stream(Purpose::Texture, layer);
        let jitter = smooth_noise(&stream, 0, UNEVENNESS);
        let colours = [1, 2, 3].map(|colour| {
            let speckles = smooth_noise(&stream, colour, SPECKLE);
            (0..SIDE * SIDE)
                .map(|index| {
                    let shift = LINE_JITTER_MM / spec.pitch_mm * f64::from(jitter[index]);
                    let line = |texel: usize| {
                        libm::cos(TAU * (periods * count(texel) / count(SIDE) + shift))
                    };
                    let line = 0.5 * (line(index % SIDE) + line(index / SIDE));
                    narrow(lines * line + speckle * f64::from(speckles[index]))
                })
                .collect()
        });
        Texture::new(TEXEL_MM, &colours)
    })
}

/// Buckling pattern of a unit: two values with a standard deviation of 1 at each place. Each press uses a different offset.
pub(super) fn buckling(unit: u32) -> Texture {
    let stream = Random::new(u64::from(unit)).stream(Purpose::Buckling, 0);
    let patterns = [0, 1].map(|layer| smooth_noise(&stream, layer, BUCKLE));
    Texture::new(TEXEL_MM, &patterns)
}
