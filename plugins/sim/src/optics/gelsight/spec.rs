//! Parameters of a coated gel.

use std::f64::consts::FRAC_PI_4;

use super::lamp::LampSpec;
use crate::parameters::{GelWear, Layer, Markers, Parameters};

/// A coated flat gel under coloured lamps.
#[derive(Clone, Debug, PartialEq)]
pub struct GelsightSpec {
    /// Thickness of the gel (literature).
    pub thickness_mm: f64,
    /// Sag of the surface at x = 7 mm and at y = 9 mm (from the sensor's geometry).
    pub sag_mm: [f64; 2],
    /// Lamps: red on the left, green on the right, blue at the bottom, and weak cyan at the top (free parameter).
    pub lamps: Vec<LampSpec>,
    /// Distance at which the colours of the lamps are stated (free parameter).
    pub lamp_reach_mm: f64,
    /// Ambient light: red, green, blue (free parameter).
    pub ambient_dn: [f64; 3],
    /// Standard deviation of the lamps' gains between units (free parameter).
    pub lamp_gain_spread: f64,
    /// Standard deviation of the coating's reflectance (free parameter).
    pub coating_spread: f64,
    /// Share of a lamp's light that the rim of a contact blocks (free parameter).
    pub shadow: f64,
    /// Standard deviation of the lens's blur, on the gel (fitted to gratings).
    pub blur_mm: f64,
    /// Markers, if there are any.
    pub markers: Option<MarkerGrid>,
    /// Width and height of the field of view.
    pub field_mm: [f64; 2],
    /// Wear of the gel, if any. A glossier coating reflects more light of the lamps and less diffuse light (free parameter).
    pub wear: Option<GelWear>,
}

/// Grid of dark discs on the gel's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerGrid {
    /// Number of markers along x and along y.
    pub count: [u16; 2],
    /// Distance between centres (literature).
    pub pitch_mm: f64,
    /// Diameter of a marker (literature).
    pub diameter_mm: f64,
    /// Part of the light that a marker absorbs (free parameter).
    pub darkness: f64,
    /// Standard deviation of the marker places between units (free parameter).
    pub jitter_mm: f64,
}

impl GelsightSpec {
    /// Optics of a coated layer.
    pub(in crate::optics) fn new(parameters: &Parameters, layer: &Layer) -> GelsightSpec {
        let markers = parameters.markers.as_ref().map(MarkerGrid::new);
        let taken = markers.map_or(0.0, |grid| grid.light_taken(parameters));
        let brightness = parameters.camera.mean_gray / (NOMINAL_GRAY * (1.0 - taken));
        let gloss = parameters.wear.map_or(0.0, |wear| wear.gloss);
        let lamp = |x: f64, y: f64, along: [f64; 2], colour: [f64; 3]| LampSpec {
            middle_mm: [x, y, 3.5],
            half_length_mm: along,
            colour_dn: colour.map(|dn| dn * brightness * (1.0 + gloss)),
        };
        let surface = &parameters.surface;
        // Lamp positions beside the picture, for any picture size.
        let [side, end] = [0.5 * surface.width_mm + 4.85, 0.5 * surface.height_mm + 4.7];
        GelsightSpec {
            thickness_mm: layer.thickness_mm,
            sag_mm: [surface.sag_x_mm, surface.sag_y_mm],
            lamps: vec![
                lamp(-side, 0.0, [0.0, 3.0], [190.0, 34.0, 42.0]),
                lamp(side, 4.0, [0.0, 3.0], [24.0, 160.0, 56.0]),
                lamp(0.0, -end, [3.0, 0.0], [40.0, 48.0, 160.0]),
                lamp(0.0, end, [3.0, 0.0], [17.0, 63.0, 63.0]),
            ],
            lamp_reach_mm: 14.0,
            ambient_dn: [28.0, 38.0, 40.0].map(|dn| dn * brightness * (1.0 - gloss).max(0.0)),
            lamp_gain_spread: 0.02,
            coating_spread: 0.01,
            shadow: 0.35,
            blur_mm: parameters.gratings.blur_mm,
            markers,
            field_mm: [surface.width_mm, surface.height_mm],
            wear: parameters.wear,
        }
    }
}

impl MarkerGrid {
    fn new(markers: &Markers) -> MarkerGrid {
        MarkerGrid {
            count: [markers.columns, markers.rows].map(whole),
            pitch_mm: markers.pitch_mm,
            diameter_mm: markers.diameter_mm,
            darkness: 0.85,
            jitter_mm: markers.jitter_mm,
        }
    }

    /// Part of all light that the markers absorb.
    fn light_taken(&self, parameters: &Parameters) -> f64 {
        let [columns, rows] = self.count.map(f64::from);
        let discs = columns * rows * FRAC_PI_4 * self.diameter_mm * self.diameter_mm;
        let surface = &parameters.surface;
        (self.darkness * discs / (surface.width_mm * surface.height_mm)).min(0.9)
    }
}

/// Mean gray, DN, of the untouched gel without markers, under the lamps and ambient light of [`GelsightSpec::new`] at brightness 1 (fitted).
const NOMINAL_GRAY: f64 = 144.8;

fn whole(count: f64) -> u16 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a float cast saturates, and parameters are checked to be 1 to 200"
    )]
    let count = count.round() as u16;
    count
}
