//! Optical parameters of a tactile sensor: its camera and gel.

use taceva_core::{FrameInfo, PixelFormat};

use super::error::OpticsError;
use super::gelsight::GelsightSpec;
use super::magictac::MagictacSpec;
use super::noise::LONGEST_ROW;
use super::vitactip::VitactipSpec;
use crate::parameters::{self, Body, Parameters};

/// Optics of a tactile sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticsSpec {
    /// Pixels of a full-size frame, width first.
    pub native: [u32; 2],
    /// Width and height of the visible field, in the gel's unit: mm, or radii of the dome's rim.
    pub field: [f64; 2],
    /// Camera of the sensor.
    pub camera: CameraSpec,
    /// True if ambient light reaches the camera.
    pub is_transparent: bool,
    /// Gel of the sensor.
    pub gel: GelSpec,
}

/// Noise of a camera at full size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSpec {
    /// Variance of the shot noise per DN of light.
    pub shot_gain_dn: f64,
    /// Standard deviation of the read noise.
    pub read_noise_dn: f64,
    /// Standard deviation of the brightness between frames, relative to the brightness.
    pub flicker: f64,
}

impl CameraSpec {
    /// A camera without noise, for tests and for reference pictures.
    pub const QUIET: CameraSpec = CameraSpec {
        shot_gain_dn: 0.0,
        read_noise_dn: 0.0,
        flicker: 0.0,
    };

    /// Scales the noise of `camera`, stated for a picture 96 pixels wide, to a picture `width` pixels wide.
    fn new(camera: &parameters::Camera, width: u32) -> CameraSpec {
        let across = f64::from(width) / REFERENCE_WIDTH;
        CameraSpec {
            shot_gain_dn: camera.shot_gain * across * across,
            read_noise_dn: camera.read_noise * across,
            flicker: camera.flicker,
        }
    }
}

/// Width of the picture for which parameters state the noise, pixels.
const REFERENCE_WIDTH: f64 = 96.0;

fn pixels(count: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a float cast saturates, and parameters are checked to be 16 to 16,384"
    )]
    let count = count.round() as u32;
    count
}

/// Gel in front of a camera.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GelSpec {
    /// A coated flat gel under coloured lamps.
    Gelsight(GelsightSpec),
    /// A clear dome with markers in its skin.
    Vitactip(VitactipSpec),
    /// A clear block with a printed lattice in layers.
    Magictac(MagictacSpec),
}

impl GelSpec {
    /// True if the bench models ambient light in this gel.
    pub(super) fn has_outside_light(&self) -> bool {
        !matches!(self, GelSpec::Gelsight(_))
    }
}

impl OpticsSpec {
    /// Optics of the sensor with `parameters`. A dome gives a ViTacTip, a layer with a lattice a MagicTac, any other layer a
    /// GelSight with its markers, if any.
    ///
    /// The longer side of the frame lies along the longer side of the gel. The frame of a dome is cropped to a square.
    pub fn new(parameters: &Parameters) -> OpticsSpec {
        let camera = &parameters.camera;
        let [longer, shorter] = {
            let [width, height] = [camera.width_px, camera.height_px].map(pixels);
            [width.max(height), width.min(height)]
        };
        let surface = &parameters.surface;
        let flat = [surface.width_mm, surface.height_mm];
        let upright = if flat[1] >= flat[0] {
            [shorter, longer]
        } else {
            [longer, shorter]
        };
        let (native, field, gel) = match (parameters.body, &parameters.lattice) {
            (Body::Dome(dome), _) => {
                let gel = VitactipSpec::new(parameters, &dome);
                ([shorter; 2], [gel.frame_side(); 2], GelSpec::Vitactip(gel))
            }
            (Body::Layer(layer), Some(lattice)) => {
                let gel = MagictacSpec::new(parameters, &layer, lattice);
                (upright, flat, GelSpec::Magictac(gel))
            }
            (Body::Layer(layer), None) => {
                let gel = GelsightSpec::new(parameters, &layer);
                (upright, flat, GelSpec::Gelsight(gel))
            }
        };
        OpticsSpec {
            native,
            field,
            camera: CameraSpec::new(camera, native[0]),
            is_transparent: camera.transparency > 0.5,
            gel,
        }
    }

    /// Size and format of a frame of `size` pixels: 8 bits at full size, 16 below it.
    ///
    /// # Errors
    /// [`OpticsError::Size`] for an empty frame, or a frame with more rows or columns than the full-size frame.
    pub fn frame_info(&self, size: [u32; 2]) -> Result<FrameInfo, OpticsError> {
        let [width, height] = size;
        let [native_width, native_height] = self.native;
        let format = match (&self.gel, size == self.native) {
            (GelSpec::Vitactip(_), true) => PixelFormat::Gray8,
            (GelSpec::Vitactip(_), false) => PixelFormat::Gray16,
            (_, true) => PixelFormat::Rgb8,
            (_, false) => PixelFormat::Rgb16,
        };
        let longest = LONGEST_ROW / format.samples();
        let fits = (1..=native_width).contains(&width)
            && (1..=native_height).contains(&height)
            && usize::try_from(width).is_ok_and(|width| width <= longest);
        fits.then_some(FrameInfo {
            width,
            height,
            format,
        })
        .ok_or(OpticsError::Size {
            width,
            height,
            native_width,
            native_height,
        })
    }

    /// Number of full-size pixels in one pixel of a frame of `size`.
    pub(super) fn binning(&self, size: [u32; 2]) -> f64 {
        let pixels = |size: [u32; 2]| f64::from(size[0]) * f64::from(size[1]);
        pixels(self.native) / pixels(size)
    }
}
