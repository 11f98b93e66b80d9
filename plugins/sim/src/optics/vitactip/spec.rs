//! Parameters of a clear dome.

use crate::elastic::shell;
use crate::optics::contrast::grating_contrast;
use crate::parameters::{Dome, GelWear, Parameters};

/// A clear dome with markers in its skin, seen from inside by a wide lens.
///
/// Places in the picture are in radii of the visible rim of the dome.
#[derive(Clone, Debug, PartialEq)]
pub struct VitactipSpec {
    /// Radius of the dome (from the sensor's geometry).
    pub dome_radius_mm: f64,
    /// Distance between apex and camera, on the axis (from the sensor's geometry).
    pub camera_distance_mm: f64,
    /// Decay length of a dimple of the skin (literature, for a skin of 1 mm).
    pub dimple_mm: f64,
    /// Sway of the apex per lateral force (free parameter).
    pub sway_mm_per_n: f64,
    /// Number of rings of markers around the middle marker: 6 make 127 markers (literature).
    pub rings: i32,
    /// Distance between markers, projected along the axis (literature).
    pub marker_pitch_mm: f64,
    /// Radius of a marker at the apex, in the picture (free parameter).
    pub marker_radius: f64,
    /// Part of the light that a marker absorbs (free parameter).
    pub marker_darkness: f64,
    /// Standard deviation of marker places between units (free parameter).
    pub marker_jitter_mm: f64,
    /// Brightness of the skin (fitted to a mean gray of 12 DN).
    pub skin_dn: f64,
    /// Brightness outside the dome (free parameter).
    pub surroundings_dn: f64,
    /// Standard deviation of the skin's unevenness (free parameter).
    pub unevenness: f64,
    /// Brightening by the ball at first touch, and the further brightening at 3.5 mm depth (free parameter).
    pub ball_glow: [f64; 2],
    /// Contrast of a grating through the skin (fitted).
    pub grating_contrast: f64,
    /// Standard deviation of the blur by skin and lens, on the board (fitted to gratings).
    pub blur_mm: f64,
    /// Standard deviation of the lamps' gain between units (free parameter).
    pub lamp_gain_spread: f64,
    /// Diameter of the visible field, along x and y.
    pub field_mm: [f64; 2],
    /// Wear of the skin, if any. A glossier skin reflects more of the ball (free parameter).
    pub wear: Option<GelWear>,
}

impl VitactipSpec {
    /// Optics of a dome.
    pub(in crate::optics) fn new(parameters: &Parameters, dome: &Dome) -> VitactipSpec {
        let markers = parameters.markers.as_ref();
        let camera_distance_mm = 2.5 * dome.radius_mm;
        let rim_angle = libm::atan2(dome.radius_mm, camera_distance_mm - dome.radius_mm);
        let gloss = parameters.wear.map_or(0.0, |wear| wear.gloss);
        let diameter_mm = markers.map_or(0.0, |markers| markers.diameter_mm);
        VitactipSpec {
            dome_radius_mm: dome.radius_mm,
            camera_distance_mm,
            dimple_mm: shell::decay_length(dome.radius_mm, dome.skin_thickness_mm, 0.5),
            sway_mm_per_n: dome.sway_mm_per_n,
            rings: markers.map_or(-1, |markers| rings(markers.columns)),
            marker_pitch_mm: markers.map_or(1.0, |markers| markers.pitch_mm),
            marker_radius: 0.5 * diameter_mm / (rim_angle * camera_distance_mm),
            marker_darkness: 0.8,
            marker_jitter_mm: markers.map_or(0.0, |markers| markers.jitter_mm),
            skin_dn: 1.34 * parameters.camera.mean_gray / NOMINAL_GRAY,
            surroundings_dn: 3.5 * parameters.camera.mean_gray / NOMINAL_GRAY,
            unevenness: 0.03,
            ball_glow: [0.5, 0.6].map(|glow| glow * (1.0 + gloss)),
            grating_contrast: grating_contrast(parameters),
            blur_mm: parameters.gratings.blur_mm,
            lamp_gain_spread: 0.02,
            field_mm: [parameters.surface.width_mm, parameters.surface.height_mm],
            wear: parameters.wear,
        }
    }

    /// Side of the square frame, in radii of the rim. The diameter of the rim is 46/48 of the side.
    pub(in crate::optics) fn frame_side(&self) -> f64 {
        2.0 * 48.0 / 46.0
    }
}

/// Mean gray, DN, of the untouched dome if `skin_dn` is 1.34 and `surroundings_dn` is 3.5 (fitted).
const NOMINAL_GRAY: f64 = 12.0;

fn rings(columns: f64) -> i32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a float cast saturates, and parameters are checked to be 1 to 200"
    )]
    let rings = columns.round() as i32;
    rings
}
