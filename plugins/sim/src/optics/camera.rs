//! Camera of a tactile sensor.

use taceva_core::{FrameInfo, FrameMut};

use super::ambient::AmbientLight;
use super::band::Band;
use super::bits::Bits;
use super::error::OpticsError;
use super::gel::Gel;
use super::luma::Luma;
use super::noise;
use super::raster::Raster;
use super::readout::Readout;
use super::simd;
use super::spec::{CameraSpec, GelSpec, OpticsSpec};
use super::view::View;
use crate::number::narrow;
use crate::random::{Purpose, Random};

/// Camera of one unit of a tactile sensor, at one frame size.
///
/// A picture depends only on the sensor, the unit, the seed and the [`View`], not on earlier pictures, threads or the processor. Samples have 8 bits
/// at full size. At a reduced size they have 16 bits, 256 counts per DN, and averaged pixel noise without rounding to whole DN.
///
/// ```
/// use taceva_core::FrameMut;
/// use taceva_sim::Model;
/// use taceva_sim::optics::{Camera, OpticsSpec, View};
/// let spec = OpticsSpec::new(&Model::ViTacTip.parameters());
/// let mut camera = Camera::new(&spec, [96, 96], 0, 7)?;
/// let info = camera.frame_info();
/// let mut bytes = vec![0; info.byte_len().expect("a small frame")];
/// let luma = camera.render(&View::default(), FrameMut::new(info, &mut bytes)?)?;
/// assert!((luma.mean_dn() - 12.0).abs() < 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Camera {
    info: FrameInfo,
    noise: CameraSpec,
    binning: f64,
    random: Random,
    is_transparent: bool,
    /// Inputs for computing the gel. The gel is computed at first use, because its tables are expensive.
    unmade: (GelSpec, Raster, u32),
    gel: Option<Gel>,
    /// Number of rows of a band; the next field is the buffer of a band.
    band_rows: usize,
    light: Vec<f32>,
}

/// Number of values in a band: as many as fit into the first-level cache.
const BAND: usize = 6144;

impl Camera {
    /// Creates the camera of unit `unit` of a sensor with the noise of `seed`. `size` is width and height of frames, pixels.
    ///
    /// # Errors
    /// [`OpticsError::Size`] for an empty frame or a frame larger than the sensor's full frame.
    pub fn new(
        spec: &OpticsSpec,
        size: [u32; 2],
        unit: u32,
        seed: u64,
    ) -> Result<Camera, OpticsError> {
        let info = spec.frame_info(size)?;
        let [width, height] = size.map(|pixels| usize::try_from(pixels).unwrap_or(usize::MAX));
        let raster = Raster::new([width, height], spec.field);
        let row = width * info.format.samples();
        let band_rows = (BAND / row).clamp(1, height);
        Ok(Camera {
            info,
            noise: spec.camera,
            binning: spec.binning(size),
            random: Random::new(seed),
            is_transparent: spec.is_transparent && spec.gel.has_outside_light(),
            unmade: (spec.gel.clone(), raster, unit),
            gel: None,
            band_rows,
            light: vec![0.0; band_rows * row],
        })
    }

    /// Changes the bits of a sample. View and noise do not change, only the quantisation.
    pub fn with_bits(mut self, bits: Bits) -> Camera {
        self.info = bits.of(self.info);
        self
    }

    /// Size and format of the frames of the camera.
    pub fn frame_info(&self) -> FrameInfo {
        self.info
    }

    /// True if ambient light reaches the camera.
    pub fn is_transparent(&self) -> bool {
        self.is_transparent
    }

    /// Computes the tables of the gel, within a second. Without this call, the first picture computes the tables.
    pub fn prepare(&mut self) {
        noise::prepare();
        self.gel();
    }

    /// Renders a picture.
    ///
    /// # Errors
    /// [`OpticsError::Frame`] for a buffer of another frame format, [`OpticsError::Opaque`] for a light scene that an opaque gel blocks.
    /// [`OpticsError::Value`] for values out of range. After an error, the buffer is unchanged.
    pub fn render(&mut self, view: &View, mut into: FrameMut<'_>) -> Result<Luma, OpticsError> {
        if into.info() != self.info {
            return Err(OpticsError::Frame {
                found: into.info(),
                expected: self.info,
            });
        }
        if view.light != AmbientLight::Normal && !self.is_transparent {
            return Err(OpticsError::Opaque { scene: view.light });
        }
        let random = self.random;
        self.gel().pose(view, &random)?;
        Ok(simd::expose(self, view, into.bytes_mut()))
    }

    fn gel(&mut self) -> &mut Gel {
        let (spec, raster, unit) = &self.unmade;
        self.gel
            .get_or_insert_with(|| Gel::new(spec, *raster, *unit))
    }

    /// Renders the current view and reads it out. The function is compiled twice, see [`simd::expose`].
    #[inline(always)]
    pub(super) fn expose(&mut self, view: &View, bytes: &mut [u8]) -> Luma {
        let readout = self.readout(view);
        let pixel_noise = self.random.stream(Purpose::PixelNoise, view.press);
        let channels = self.info.format.samples();
        let sample_bytes = self.info.format.bytes_per_sample();
        let row_length = self.light.len() / self.band_rows;
        let width = row_length / channels;
        let mut luma = Luma::new(if sample_bytes == 1 { 1 } else { COUNTS_PER_DN });
        let mut first_row = 0;
        for rows in bytes.chunks_mut(self.band_rows * row_length * sample_bytes) {
            let length = rows.len() / sample_bytes;
            let light = &mut self.light[..length];
            // Posing the view has already created the gel.
            if let Some(gel) = &self.gel {
                gel.paint(&mut Band {
                    first_row,
                    width,
                    channels,
                    light,
                });
            }
            for (light, into) in light
                .chunks_exact(row_length)
                .zip(rows.chunks_exact_mut(row_length * sample_bytes))
            {
                let index = u64::from(view.picture) << 32 | first_row as u64;
                let noise = noise::row(&pixel_noise, index, row_length);
                let sums = if sample_bytes == 1 {
                    readout.row::<1>(light, noise, into)
                } else {
                    readout.row::<2>(light, noise, into)
                };
                luma.add_row(&sums, channels, width);
                first_row += 1;
            }
        }
        luma
    }

    fn readout(&self, view: &View) -> Readout {
        let flicker = self.random.stream(Purpose::Flicker, view.press);
        let flicker = self.noise.flicker * flicker.normal(u64::from(view.picture));
        let read = self.noise.read_noise_dn;
        Readout {
            gain: narrow(1.0 + flicker),
            shot: narrow(self.noise.shot_gain_dn / self.binning),
            read_variance: narrow(read * read / self.binning),
            counts_per_dn: if self.info.format.bytes_per_sample() == 1 {
                1.0
            } else {
                narrow(COUNTS_PER_DN as f64)
            },
            full_counts: f32::from(self.info.format.full_scale()),
        }
    }
}

/// Counts of a 16-bit frame per DN.
pub(super) const COUNTS_PER_DN: u64 = 256;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Indentation, Solid};
    use crate::optics::Stimulus;
    use crate::parameters::Model;

    fn pressed(model: Model) -> (Camera, View) {
        let parameters = model.parameters();
        let spec = OpticsSpec::new(&parameters);
        let depth_mm = parameters.probing.depth_max_mm;
        let contact = Solid::new(&parameters).contact(&Indentation {
            place_mm: [1.3, -2.1],
            depth_mm,
            deepest_mm: depth_mm,
            shear_mm: [0.4, 0.3],
            indenter_radius_mm: 2.0,
            stiffness: 1.0,
        });
        let camera = Camera::new(&spec, [77, 91], 0, 5).expect("below the native size");
        let view = View {
            stimulus: Stimulus::Ball(contact),
            press: 3,
            ..View::default()
        };
        (camera, view)
    }

    fn take(camera: &mut Camera, view: &View) -> Vec<u8> {
        let mut bytes = vec![0; camera.info.byte_len().expect("a small frame")];
        let into = FrameMut::new(camera.info, &mut bytes).expect("its own frame");
        camera.render(view, into).expect("a picture");
        bytes
    }

    #[test]
    fn a_camera_that_was_prepared_takes_the_same_pictures() {
        for model in Model::ALL {
            let (mut camera, view) = pressed(model);
            let unprepared = take(&mut camera.clone(), &view);
            camera.prepare();
            assert!(camera.gel.is_some(), "{model}");
            camera.prepare();
            assert!(take(&mut camera, &view) == unprepared, "{model}");
        }
    }

    #[test]
    fn in_eight_bits_a_picture_is_the_one_in_sixteen_rounded() {
        for model in Model::ALL {
            let (mut camera, view) = pressed(model);
            let fine = take(&mut camera, &view);
            let mut coarse = camera.with_bits(Bits::Eight);
            let coarse = take(&mut coarse, &view);
            let (fine, []) = fine.as_chunks::<2>() else {
                panic!("16 bits a sample");
            };
            for (fine, coarse) in fine.iter().zip(&coarse) {
                let fine = f64::from(u16::from_le_bytes(*fine)) / 256.0;
                // Rounding error of one half, plus the rounding error of the finer quantisation.
                let off = (fine.min(255.0) - f64::from(*coarse)).abs();
                assert!(off <= 0.5 + 1.0 / 256.0, "{model}: {fine} {coarse}");
            }
        }
    }

    #[test]
    fn the_rows_painted_at_a_time_do_not_matter() {
        for model in Model::ALL {
            let (mut camera, view) = pressed(model);
            let whole = take(&mut camera, &view);
            let row = camera.light.len() / camera.band_rows;
            for band_rows in [1, 7, 91] {
                camera.band_rows = band_rows;
                camera.light = vec![0.0; band_rows * row];
                assert!(take(&mut camera, &view) == whole, "{model}: {band_rows}");
            }
        }
    }

    #[test]
    fn the_width_of_vectors_does_not_matter() {
        for model in Model::ALL {
            let (mut camera, view) = pressed(model);
            let widest = take(&mut camera, &view);
            let mut plain = vec![0; widest.len()];
            camera.expose(&view, &mut plain);
            assert!(plain == widest, "{model}");
        }
    }
}
