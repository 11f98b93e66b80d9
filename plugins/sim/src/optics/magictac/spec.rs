//! Parameters of a clear block with a lattice.

use crate::optics::contrast::grating_contrast;
use crate::parameters::{GelWear, Lattice, Layer, Parameters};

/// A clear block with a printed lattice in three layers.
#[derive(Clone, Debug, PartialEq)]
pub struct MagictacSpec {
    /// Thickness of the block (from the sensor's geometry).
    pub thickness_mm: f64,
    /// Depths of the lattice's layers below the surface (from the sensor's geometry).
    pub layers_mm: [f64; 3],
    /// Distance between the lattice's lines (free parameter).
    pub pitch_mm: f64,
    /// Contrast of the lines and of the speckle between them (free parameter).
    pub contrast: [f64; 2],
    /// Shift of the view below the surface by refraction, per unit of surface slope (free parameter).
    pub refraction_mm: f64,
    /// Brightening by the slope of the surface (free parameter).
    pub gloss: f64,
    /// Brightening under the ball (free parameter).
    pub wetting: f64,
    /// Buckling of the lattice: a fraction of the local displacement, random for each press (free parameter).
    pub buckling: f64,
    /// Strength of the coloured glow and of the uniform light (fitted to a mean gray of 107 DN).
    pub glow_dn: [f64; 2],
    /// Contrast of a grating in the first layer (fitted).
    pub grating_contrast: f64,
    /// Standard deviation of the lens's blur, on the gel (fitted to gratings).
    pub blur_mm: f64,
    /// Standard deviation of the lamps' gains between units (free parameter).
    pub lamp_gain_spread: f64,
    /// Width and height of the field of view.
    pub field_mm: [f64; 2],
    /// Wear of the block, if any.
    pub wear: Option<GelWear>,
}

impl MagictacSpec {
    /// Optics of a clear layer with a lattice.
    pub(in crate::optics) fn new(
        parameters: &Parameters,
        layer: &Layer,
        lattice: &Lattice,
    ) -> MagictacSpec {
        let brightness = parameters.camera.mean_gray / NOMINAL_GRAY;
        MagictacSpec {
            thickness_mm: layer.thickness_mm,
            layers_mm: [
                lattice.first_depth_mm,
                lattice.second_depth_mm,
                lattice.third_depth_mm,
            ],
            pitch_mm: lattice.pitch_mm,
            contrast: [0.12, 0.16],
            refraction_mm: 0.35,
            gloss: 1.2 * (1.0 + parameters.wear.map_or(0.0, |wear| wear.gloss)),
            wetting: 0.10,
            buckling: lattice.buckling,
            glow_dn: [130.0, 55.0].map(|dn| dn * brightness),
            grating_contrast: grating_contrast(parameters),
            blur_mm: parameters.gratings.blur_mm,
            lamp_gain_spread: 0.02,
            field_mm: [parameters.surface.width_mm, parameters.surface.height_mm],
            wear: parameters.wear,
        }
    }
}

/// Mean gray, DN, of the untouched block if `glow_dn` is 130 and 55 (fitted).
const NOMINAL_GRAY: f64 = 114.8;
