//! MagicTac: a clear block in which three layers of a lattice are seen to move.

mod glow;
mod lattice;
mod shift;
mod spec;

pub use spec::MagictacSpec;

use std::sync::Arc;

use self::glow::{Glow, Outside};
use self::shift::{Moved, Shift};
use super::ambient::AmbientLight;
use super::band::Band;
use super::camera::View;
use super::error::OpticsError;
use super::number::narrow;
use super::raster::Raster;
use super::relief::{Relief, Window};
use super::stimulus::Stimulus;
use super::texture::Texture;
use crate::displacement::{Profile, Tables};
use crate::random::{Purpose, Random};

/// A block of one unit, at one frame size.
#[derive(Clone, Debug)]
pub(super) struct Magictac {
    scene: Arc<Scene>,
    lighting: Arc<Lighting>,
    profiles: [Profile; 3],
    touch: Touch,
    shift: Shift,
    /// Which part of the buckling pattern this press looks at.
    buckling: [f32; 2],
}

/// What stays the same from frame to frame.
#[derive(Debug)]
struct Scene {
    raster: Raster,
    spec: MagictacSpec,
    tables: [Tables; 3],
    layers: [Texture; 3],
    buckling: Texture,
    buckling_part: f32,
    refraction: f32,
    gloss: f32,
    /// The lamps' light, red, green and blue of each pixel.
    glow: Vec<f32>,
}

/// The untouched block under one scene of light.
#[derive(Debug)]
struct Lighting {
    scene: AmbientLight,
    exposure: f32,
    /// What comes in from outside; empty if nothing does.
    outside: Vec<f32>,
    background: Vec<f32>,
}

#[derive(Clone, Debug)]
enum Touch {
    Nothing,
    Ball,
    Board(Relief),
}

/// Where the surface has to face for red, green and blue to grow.
const FACING: [[f32; 2]; 3] = [[0.7, -0.5], [-0.8, -0.2], [0.0, 0.9]];

impl Magictac {
    pub(super) fn new(spec: &MagictacSpec, raster: Raster, unit: u32) -> Magictac {
        let scene = Scene::new(spec, raster, unit);
        Magictac {
            lighting: Arc::new(Lighting::new(&scene, AmbientLight::Normal)),
            profiles: std::array::from_fn(|_| Profile::new()),
            touch: Touch::Nothing,
            shift: Shift::default(),
            buckling: [0.0; 2],
            scene: Arc::new(scene),
        }
    }

    pub(super) fn pose(&mut self, view: &View, random: &Random) -> Result<(), OpticsError> {
        let scene = &*self.scene;
        self.touch = match view.stimulus {
            Stimulus::Nothing => Touch::Nothing,
            Stimulus::Ball(contact) if !contact.touches() => Touch::Nothing,
            Stimulus::Ball(contact) => {
                let load = contact.load();
                for (tables, profile) in scene.tables.iter().zip(&mut self.profiles) {
                    tables.profile(&load, profile);
                }
                self.shift.take(&load, &self.profiles, scene.spec.wetting);
                let place = random.stream(Purpose::Buckling, view.press);
                self.buckling = [0, 1].map(|axis| narrow(place.between(axis, 0.0, 20.0)));
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
        if self.lighting.scene != view.light {
            self.lighting = Arc::new(Lighting::new(scene, view.light));
        }
        Ok(())
    }

    pub(super) fn paint(&self, band: &mut Band<'_>) {
        let start = band.first_row * band.width * 3;
        let length = band.light.len();
        band.light
            .copy_from_slice(&self.lighting.background[start..start + length]);
        match &self.touch {
            Touch::Nothing => {}
            Touch::Ball => self.paint_ball(band),
            Touch::Board(relief) => self.paint_board(relief, band),
        }
    }

    fn paint_ball(&self, band: &mut Band<'_>) {
        let (raster, shift) = (&self.scene.raster, &self.shift);
        for row in band.rows_among(raster.rows(shift.y, shift.reach)) {
            let y = raster.y(row);
            let dy = y - shift.y;
            let half = (shift.reach * shift.reach - dy * dy).max(0.0).sqrt();
            self.paint_row(row, raster.columns(shift.x, half), band, |x| {
                let moved = shift.at(x, y);
                (self.buckled(moved, x, y), 0.0)
            });
        }
    }

    /// A lattice under load gives way by chance: a part of how far it has moved, in a direction of its own.
    #[inline(always)]
    fn buckled(&self, mut moved: Moved, x: f32, y: f32) -> Moved {
        let [chance_x, chance_y] = (self.scene.buckling)
            .near(x + self.buckling[0], y + self.buckling[1])
            .map(|chance| chance * self.scene.buckling_part);
        // The fourth lane is no layer's: the surface does not buckle.
        for lane in 0..3 {
            let size = (moved.x[lane] * moved.x[lane] + moved.y[lane] * moved.y[lane]).sqrt();
            moved.x[lane] += size * chance_x;
            moved.y[lane] += size * chance_y;
        }
        moved
    }

    fn paint_board(&self, relief: &Relief, band: &mut Band<'_>) {
        let raster = &self.scene.raster;
        let [x, y] = relief.centre();
        let contrast = narrow(self.scene.spec.grating_contrast);
        for row in band.rows_among(raster.rows(y, relief.reach())) {
            let y = raster.y(row);
            self.paint_row(row, raster.columns(x, relief.reach()), band, |x| {
                (Moved::NOWHERE, contrast * relief.at(x, y))
            });
        }
    }

    /// Paints some pixels of a row; `at` says what happened at x, and how much brighter it is.
    #[inline(always)]
    fn paint_row(
        &self,
        row: usize,
        columns: std::ops::Range<usize>,
        band: &mut Band<'_>,
        at: impl Fn(f32) -> (Moved, f32),
    ) {
        let (scene, lighting) = (&*self.scene, &*self.lighting);
        let y = scene.raster.y(row);
        let start = row * band.width;
        let light = band.row_mut(row - band.first_row);
        for column in columns {
            let x = scene.raster.x(column);
            let (moved, brighter) = at(x);
            let pattern = scene.pattern(&moved, x, y);
            let pixel = 3 * (start + column);
            for colour in 0..3 {
                let glow = scene.glow[pixel + colour];
                let outside = lighting.outside.get(pixel + colour).copied().unwrap_or(0.0);
                light[3 * column + colour] =
                    lighting.exposure * (glow * (1.0 + (pattern[colour] + brighter))) + outside;
            }
        }
    }
}

impl Moved {
    const NOWHERE: Moved = Moved {
        x: [0.0; 4],
        y: [0.0; 4],
        wetting: 0.0,
    };
}

impl Scene {
    fn new(spec: &MagictacSpec, raster: Raster, unit: u32) -> Scene {
        let glow = Glow::new(
            spec,
            &Random::new(u64::from(unit)).stream(Purpose::LampGain, 0),
        );
        Scene {
            raster,
            spec: spec.clone(),
            tables: spec
                .layers_mm
                .map(|depth| Tables::new(spec.thickness_mm, depth)),
            layers: lattice::layers(spec, unit),
            buckling: lattice::buckling(unit),
            buckling_part: narrow(spec.buckling),
            refraction: narrow(spec.refraction_mm),
            gloss: narrow(spec.gloss),
            glow: field(&raster, |x, y| glow.at(x, y)),
        }
    }

    /// What the lattice and the surface do to the light at `x`, `y`: parts of it, around 0.
    #[inline(always)]
    fn pattern(&self, moved: &Moved, x: f32, y: f32) -> [f32; 3] {
        let [bent_x, bent_y] = [moved.x[3], moved.y[3]].map(|slope| slope * self.refraction);
        let seen_x = moved.x.map(|moved| x - moved - bent_x);
        let seen_y = moved.y.map(|moved| y - moved - bent_y);
        let sum = Texture::sum_at(&self.layers, seen_x, seen_y);
        let [slope_x, slope_y] = [moved.x[3], moved.y[3]].map(|slope| slope * self.gloss);
        std::array::from_fn(|colour| {
            let [facing_x, facing_y] = FACING[colour];
            sum[colour] - (slope_x * facing_x + slope_y * facing_y) + moved.wetting
        })
    }
}

impl Lighting {
    fn new(scene: &Scene, light: AmbientLight) -> Lighting {
        let source = Outside::new(light);
        let outside = if light == AmbientLight::Normal {
            Vec::new()
        } else {
            field(&scene.raster, |x, y| source.at(x, y))
        };
        let exposure = narrow(source.exposure());
        let mut background = scene.glow.clone();
        let raster = &scene.raster;
        let pixels = background.chunks_exact_mut(3).enumerate();
        for (index, pixel) in pixels {
            let [x, y] = [
                raster.x(index % raster.width),
                raster.y(index / raster.width),
            ];
            let pattern = scene.pattern(&Moved::NOWHERE, x, y);
            for (colour, light) in pixel.iter_mut().enumerate() {
                let outside = outside.get(3 * index + colour).copied().unwrap_or(0.0);
                *light = exposure * (*light * (1.0 + (pattern[colour] + 0.0))) + outside;
            }
        }
        Lighting {
            scene: light,
            exposure,
            outside,
            background,
        }
    }
}

/// A field of light over the frame.
fn field(raster: &Raster, at: impl Fn(f64, f64) -> [f64; 3]) -> Vec<f32> {
    let rows = (0..raster.height).map(|row| f64::from(raster.y(row)));
    rows.flat_map(|y| {
        let at = &at;
        (0..raster.width).flat_map(move |column| at(f64::from(raster.x(column)), y).map(narrow))
    })
    .collect()
}
