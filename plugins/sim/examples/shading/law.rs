//! Shading laws that are linear in their coefficients. Each term is the change of the picture per unit of one coefficient.

use std::error::Error;

use taceva_core::{Frame, FrameMut};
use taceva_sim::Model;
use taceva_sim::contact::Contact;
use taceva_sim::displacement::{Field, Profile, Tables};
use taceva_sim::optics::{Camera, CameraSpec, GelSpec, OpticsSpec, Stimulus, View};

use super::press::{Press, Presses};

/// Law of shading.
pub(crate) enum Law {
    /// Cameras of the bench, each with one lit lamp. The strength of each lamp in each colour is fitted. Lamps have the same places as in the bench.
    Lamps(Vec<Camera>),
    /// Powers of the surface normal, up to the second, each times 1, x and y of the pixel.
    Polynomial(Tables),
}

/// Term of a law, one value per pixel.
pub(crate) type Term = Vec<f64>;

/// Strength of a lit lamp, DN: bright enough for 16-bit quantisation, too dim to saturate.
const LIT_DN: f64 = 100.0;

/// Gel thickness of a GelSight in the bench, mm.
const THICKNESS_MM: f64 = 4.25;

impl Law {
    /// Lamp law with the optics of the bench, at the size of the pictures, without noise and unevenness.
    pub(crate) fn lamps(presses: &Presses) -> Result<Law, Box<dyn Error>> {
        let [width, height] = [presses.background.width, presses.background.height()];
        let size = [u32::try_from(width)?, u32::try_from(height)?];
        let mut parameters = Model::GelSightWm.parameters();
        let field = presses.field_mm();
        [parameters.surface.width_mm, parameters.surface.height_mm] = field;
        let mut spec = OpticsSpec::new(&parameters);
        spec.field = field;
        // Reduced pictures have 16 bits per colour.
        spec.native = size.map(|pixels| 2 * pixels);
        spec.camera = CameraSpec::QUIET;
        let GelSpec::Gelsight(gel) = &mut spec.gel else {
            return Err("the GelSight of the bench has no coated gel".into());
        };
        gel.sag_mm = [0.0; 2];
        gel.ambient_dn = [0.0; 3];
        gel.coating_spread = 0.0;
        gel.lamp_gain_spread = 0.0;
        let lamps = gel.lamps.clone();
        let cameras = lamps.into_iter().map(|lamp| {
            let mut lit = spec.clone();
            if let GelSpec::Gelsight(gel) = &mut lit.gel {
                gel.lamps = vec![taceva_sim::optics::LampSpec {
                    colour_dn: [LIT_DN; 3],
                    ..lamp
                }];
            }
            Camera::new(&lit, size, 0, 0)
        });
        Ok(Law::Lamps(cameras.collect::<Result<_, _>>()?))
    }

    pub(crate) fn polynomial() -> Law {
        Law::Polynomial(Tables::new(THICKNESS_MM, 0.0))
    }

    pub(crate) fn name(&self) -> &'static str {
        match self {
            Law::Lamps(_) => "lamps",
            Law::Polynomial(_) => "polynomial",
        }
    }

    /// Terms of the law for one press.
    pub(crate) fn terms(
        &self,
        press: &Press,
        presses: &Presses,
    ) -> Result<Vec<Term>, Box<dyn Error>> {
        match self {
            Law::Lamps(cameras) => {
                let terms = cameras
                    .iter()
                    .map(|camera| lit(camera.clone(), press, presses));
                terms.collect()
            }
            Law::Polynomial(tables) => Ok(powers(tables, press, presses)),
        }
    }
}

/// Light of one lamp on the pressed gel, minus its light on the untouched gel.
fn lit(mut camera: Camera, press: &Press, presses: &Presses) -> Result<Term, Box<dyn Error>> {
    let load = presses.load(press);
    let pressed = Stimulus::Ball(Contact {
        position_mm: load.centre_mm,
        depth_mm: load.depth_mm,
        normal_depth_mm: load.depth_mm,
        radius_mm: load.contact_radius_mm,
        indenter_radius_mm: load.indenter_radius_mm,
        young_modulus_mpa: load.young_modulus_mpa,
        normal_force_n: load.normal_force_n,
        ..Contact::default()
    });
    let mut take = |stimulus| -> Result<Term, Box<dyn Error>> {
        let info = camera.frame_info();
        let mut bytes = vec![
            0;
            info.byte_len()
                .ok_or("the frame exceeds the address space")?
        ];
        let view = View {
            stimulus,
            ..View::default()
        };
        camera.render(&view, FrameMut::new(info, &mut bytes)?)?;
        let red = Frame::new(info, bytes)?;
        let red = red.samples().step_by(info.format.samples());
        Ok(red
            .map(|counts| f64::from(counts) / 256.0 / LIT_DN)
            .collect())
    };
    let untouched = take(Stimulus::Nothing)?;
    let changed = take(pressed)?;
    let pairs = changed.iter().zip(&untouched);
    Ok(pairs
        .map(|(pressed, untouched)| pressed - untouched)
        .collect())
}

/// The 18 terms of ΔI = Σ a nₓⁱ nᵧʲ xᵏ yˡ, i + j ≤ 2 and k + l ≤ 1, with coefficients a, the unit surface normal n, and the place x, y in units of
/// half the picture.
fn powers(tables: &Tables, press: &Press, presses: &Presses) -> Vec<Term> {
    let load = presses.load(press);
    let mut profile = Profile::new();
    tables.profile(&load, &mut profile);
    let field = Field::new(&profile, &load);
    let half = presses.field_mm().map(|side| 0.5 * side);
    let [width, height] = [presses.background.width, presses.background.height()];
    let mut terms: Vec<Term> = (0..18)
        .map(|_| Vec::with_capacity(width * height))
        .collect();
    for row in 0..height {
        for column in 0..width {
            let [x, y] = presses.place_mm(column as f64, row as f64);
            let [slope_x, slope_y] = {
                #[expect(
                    clippy::cast_possible_truncation,
                    reason = "the tables take places in f32"
                )]
                let slope = field.slope(x as f32, y as f32);
                slope.map(f64::from)
            };
            let length = (1.0 + slope_x * slope_x + slope_y * slope_y).sqrt();
            let [nx, ny] = [-slope_x / length, -slope_y / length];
            let shapes = [1.0, nx, ny, nx * nx, nx * ny, ny * ny];
            let places = [1.0, x / half[0], y / half[1]];
            let products = shapes
                .iter()
                .flat_map(|shape| places.map(|place| shape * place));
            for (term, value) in terms.iter_mut().zip(products) {
                term.push(value);
            }
        }
    }
    terms
}
