//! GelSight: a coated gel. Its slopes appear in the colours of the lamps around it.

mod dent;
mod lamp;
mod spec;

pub use lamp::LampSpec;
pub use spec::{GelsightSpec, MarkerGrid};

use std::sync::Arc;

use self::dent::Dent;
use self::lamp::{CHUNK, Caster, Lamp, Slopes};
use super::band::Band;
use super::disc::{Disc, DiscSpec};
use super::error::OpticsError;
use super::marks::Marks;
use super::raster::Raster;
use super::relief::{Relief, Window};
use super::stimulus::Stimulus;
use super::texture::{self, Texture};
use super::view::View;
use crate::displacement::{Field, Profile, Tables};
use crate::number::narrow;
use crate::random::{Purpose, Random};

/// A coated gel of one unit, at one frame size.
#[derive(Clone, Debug)]
pub(super) struct Gelsight {
    scene: Arc<Scene>,
    profile: Profile,
    touch: Touch,
    dent: Dent,
    markers: Vec<[f32; 2]>,
    /// Present places of the marks of wear.
    worn: Vec<[f32; 2]>,
}

/// Constant data of all frames.
#[derive(Debug)]
struct Scene {
    raster: Raster,
    spec: GelsightSpec,
    lamps: Vec<Lamp>,
    ambient: [f32; 3],
    /// Slope of the untouched surface per mm of distance, towards the camera.
    sag: [f32; 2],
    /// Reflectance of the coating at each pixel.
    reflectance: Vec<f32>,
    tables: Arc<Tables>,
    /// Picture of the untouched gel without markers.
    background: Vec<f32>,
    disc: Option<Disc>,
    markers: Vec<[f32; 2]>,
    marks: Marks,
    /// Places of the marks on the untouched gel.
    worn: Vec<[f32; 2]>,
}

/// Object that touches the gel in this frame.
#[derive(Clone, Debug)]
enum Touch {
    Nothing,
    Ball,
    Board(Relief),
}

impl Gelsight {
    pub(super) fn new(spec: &GelsightSpec, raster: Raster, unit: u32) -> Gelsight {
        let scene = Scene::new(spec, raster, unit);
        Gelsight {
            profile: Profile::new(),
            touch: Touch::Nothing,
            dent: Dent::default(),
            markers: scene.markers.clone(),
            worn: scene.worn.clone(),
            scene: Arc::new(scene),
        }
    }

    pub(super) fn pose(&mut self, view: &View) -> Result<(), OpticsError> {
        let scene = &self.scene;
        self.markers.copy_from_slice(&scene.markers);
        self.worn.copy_from_slice(&scene.worn);
        self.touch = match view.stimulus {
            Stimulus::Nothing => Touch::Nothing,
            Stimulus::Ball(contact) if !contact.touches() => Touch::Nothing,
            Stimulus::Ball(contact) => {
                let load = contact.load();
                scene.tables.profile(&load, &mut self.profile);
                let spec = &scene.spec;
                self.dent
                    .take(&load, &self.profile, spec.blur_mm, spec.shadow);
                let field = Field::new(&self.profile, &load);
                for place in self.markers.iter_mut().chain(&mut self.worn) {
                    let [x, y] = *place;
                    let [along_x, along_y, _] = field.at(x, y);
                    *place = [x + along_x, y + along_y];
                }
                Touch::Ball
            }
            Stimulus::Board(board) => Touch::Board(Relief::new(
                &board,
                Window {
                    layer_mm: Some(scene.spec.thickness_mm),
                    blur_mm: scene.spec.blur_mm,
                    pixel_mm: 0.5 * f64::from(scene.raster.pitch[0] + scene.raster.pitch[1]),
                },
            )?),
        };
        Ok(())
    }

    #[inline(always)]
    pub(super) fn paint(&self, band: &mut Band<'_>) {
        let scene = &*self.scene;
        let start = band.first_row * band.width * 3;
        let length = band.light.len();
        band.light
            .copy_from_slice(&scene.background[start..start + length]);
        match &self.touch {
            Touch::Nothing => {}
            Touch::Ball => self.paint_ball(band),
            Touch::Board(relief) => scene.paint_board(relief, band),
        }
        if let Some(disc) = &scene.disc {
            for [x, y] in &self.markers {
                disc.stamp(&scene.raster, *x, *y, band);
            }
        }
        scene.marks.stamp(&self.worn, &scene.raster, band);
    }

    #[inline(always)]
    fn paint_ball(&self, band: &mut Band<'_>) {
        let (scene, dent) = (&*self.scene, &self.dent);
        for row in band.rows_among(scene.raster.rows(dent.y, dent.reach)) {
            let y = scene.raster.y(row);
            let half = (dent.reach * dent.reach - (y - dent.y) * (y - dent.y))
                .max(0.0)
                .sqrt();
            let columns = scene.raster.columns(dent.x, half);
            scene.shade(row, columns, dent.caster(), band, |x, slopes| {
                dent.add_to(x, y, slopes);
            });
        }
    }
}

impl Scene {
    fn new(spec: &GelsightSpec, raster: Raster, unit: u32) -> Scene {
        let random = Random::new(u64::from(unit));
        let gains = random.stream(Purpose::LampGain, 0);
        let lamps = spec
            .lamps
            .iter()
            .zip(0..)
            .map(|(lamp, number)| {
                let gain = Lamp::gain(&gains, number, spec.lamp_gain_spread);
                Lamp::new(lamp, spec.lamp_reach_mm, gain)
            })
            .collect();
        let coating = texture::smooth_noise(&random.stream(Purpose::Texture, 0), 0, 6.0);
        let coating = Texture::new(TEXEL_MM, &[coating]);
        let wear = spec.wear.as_ref();
        let shift = wear.map_or([0.0; 2], |wear| wear.shift_xy_mm());
        let marks = Marks::new(wear, spec.field_mm, unit, &raster, 1.0);
        let [shift_x, shift_y] = shift.map(narrow);
        let mut scene = Scene {
            raster,
            spec: spec.clone(),
            lamps,
            ambient: spec.ambient_dn.map(narrow),
            sag: [
                narrow(2.0 * spec.sag_mm[0] / (7.0 * 7.0)),
                narrow(2.0 * spec.sag_mm[1] / (9.0 * 9.0)),
            ],
            reflectance: (0..raster.height)
                .flat_map(|row| (0..raster.width).map(move |column| (column, row)))
                .map(|(column, row)| {
                    let uneven = coating.at(raster.x(column) - shift_x, raster.y(row) - shift_y)[0];
                    1.0 + narrow(spec.coating_spread) * uneven
                })
                .collect(),
            tables: Tables::shared(spec.thickness_mm, 0.0),
            background: Vec::new(),
            disc: spec.markers.map(|grid| {
                let disc = DiscSpec {
                    radius: 0.5 * grid.diameter_mm,
                    darkness: grid.darkness,
                    edge: MARKER_EDGE_MM,
                };
                Disc::new(disc, &raster)
            }),
            markers: spec
                .markers
                .map_or_else(Vec::new, |grid| places(&grid, &random, shift)),
            worn: marks.places_mm.iter().map(|at| at.map(narrow)).collect(),
            marks,
        };
        let mut background = vec![0.0; raster.width * raster.height * 3];
        let mut band = Band {
            first_row: 0,
            width: raster.width,
            channels: 3,
            light: &mut background,
        };
        for row in 0..raster.height {
            scene.shade(
                row,
                0..raster.width,
                Caster::default(),
                &mut band,
                |_, _| {},
            );
        }
        scene.background = background;
        scene
    }

    fn paint_board(&self, relief: &Relief, band: &mut Band<'_>) {
        let [x, y] = relief.centre();
        for row in band.rows_among(self.raster.rows(y, relief.reach())) {
            let y = self.raster.y(row);
            let columns = self.raster.columns(x, relief.reach());
            self.shade(row, columns, Caster::default(), band, |x, slopes| {
                for (i, x) in x.iter().enumerate() {
                    let [slope_x, slope_y] = relief.slope(*x, y);
                    slopes.x[i] += slope_x;
                    slopes.y[i] += slope_y;
                }
            });
        }
    }

    /// Shades the pixels of a row of the frame. `press` adds its slopes to the slopes of the untouched gel.
    #[inline(always)]
    fn shade(
        &self,
        row: usize,
        columns: std::ops::Range<usize>,
        caster: Caster,
        band: &mut Band<'_>,
        press: impl Fn(&[f32; CHUNK], &mut Slopes),
    ) {
        let y = self.raster.y(row);
        let band_width = band.width;
        let light = band.row_mut(row - band.first_row);
        for first in columns.clone().step_by(CHUNK) {
            let x: [f32; CHUNK] = std::array::from_fn(|i| self.raster.x(first + i));
            let mut slopes = Slopes {
                x: x.map(|x| self.sag[0] * x),
                y: [self.sag[1] * y; CHUNK],
                shadow: [0.0; CHUNK],
                upright: [0.0; CHUNK],
            };
            press(&x, &mut slopes);
            slopes.measure();
            let mut colours = self.ambient.map(|dn| [dn; CHUNK]);
            for lamp in &self.lamps {
                lamp.light(&x, y, &slopes, caster, &mut colours);
            }
            let last = columns.end.min(first + CHUNK);
            let reflectance = &self.reflectance[row * band_width..][first..last];
            let (pixels, _) = light[3 * first..3 * last].as_chunks_mut::<3>();
            for (i, (pixel, reflectance)) in pixels.iter_mut().zip(reflectance).enumerate() {
                *pixel = [0, 1, 2].map(|colour: usize| colours[colour][i] * reflectance);
            }
        }
    }
}

/// Texel of the coating, mm. The standard deviation of its smoothing is six texels, 1.1 mm.
const TEXEL_MM: f64 = 0.18;
/// Scale of a marker's edge, mm.
const MARKER_EDGE_MM: f64 = 0.045;

/// Places of the markers of a unit.
fn places(grid: &MarkerGrid, random: &Random, shift_mm: [f64; 2]) -> Vec<[f32; 2]> {
    let jitter = random.stream(Purpose::MarkerJitter, 0);
    let [columns, rows] = grid.count;
    let middle = |number: u16, count: u16| f64::from(number) - 0.5 * (f64::from(count) - 1.0);
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    cells
        .zip(0..)
        .map(|((column, row), number)| {
            let [x, y] = [middle(column, columns), middle(row, rows)];
            [
                narrow(
                    x * grid.pitch_mm + grid.jitter_mm * jitter.normal(2 * number) + shift_mm[0],
                ),
                narrow(
                    y * grid.pitch_mm
                        + grid.jitter_mm * jitter.normal(2 * number + 1)
                        + shift_mm[1],
                ),
            ]
        })
        .collect()
}
