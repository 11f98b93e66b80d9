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
use super::simd::Lanes;
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
    /// The lamps' light as it is exposed, and what comes in from outside.
    glow: Vec<f32>,
    outside: Vec<f32>,
    background: Vec<f32>,
}

#[derive(Clone, Debug)]
enum Touch {
    Nothing,
    Ball,
    Board(Relief),
}

/// Where the surface has to face for red, green and blue to grow: along x, along y.
const FACING: [[f32; 4]; 2] = [[0.7, -0.8, 0.0, 0.0], [-0.5, -0.2, 0.9, 0.0]];

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

    #[inline(always)]
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

    #[inline(always)]
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
        let size = moved.x.times(moved.x).plus(moved.y.times(moved.y)).root();
        let by = |chance: f32| size.times(Lanes::new([chance, chance, chance, 0.0]));
        moved.x = moved.x.plus(by(chance_x));
        moved.y = moved.y.plus(by(chance_y));
        moved
    }

    fn paint_board(&self, relief: &Relief, band: &mut Band<'_>) {
        let raster = &self.scene.raster;
        let [x, y] = relief.centre();
        let contrast = narrow(self.scene.spec.grating_contrast);
        for row in band.rows_among(raster.rows(y, relief.reach())) {
            let y = raster.y(row);
            self.paint_row(row, raster.columns(x, relief.reach()), band, |x| {
                (Moved::nowhere(), contrast * relief.at(x, y))
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
        let pixels = row * band.width + columns.start..row * band.width + columns.end;
        let glows = &lighting.glow.as_chunks::<3>().0[pixels.clone()];
        let outsides = &lighting.outside.as_chunks::<3>().0[pixels];
        let light = band.row_mut(row - band.first_row);
        let lights = &mut light.as_chunks_mut::<3>().0[columns.clone()];
        for (((column, light), glow), outside) in columns.zip(lights).zip(glows).zip(outsides) {
            let x = scene.raster.x(column);
            let (moved, brighter) = at(x);
            let pattern = scene.pattern(&moved, x, y);
            *light = [0, 1, 2].map(|colour: usize| {
                glow[colour] * (1.0 + (pattern[colour] + brighter)) + outside[colour]
            });
        }
    }
}

impl Moved {
    /// What happens where nothing touches.
    #[inline(always)]
    fn nowhere() -> Moved {
        Moved {
            x: Lanes::splat(0.0),
            y: Lanes::splat(0.0),
            wetting: 0.0,
        }
    }
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

    /// What the lattice and the surface do to the light at `x`, `y`: parts of it, around 0, red, green and blue.
    #[inline(always)]
    fn pattern(&self, moved: &Moved, x: f32, y: f32) -> [f32; 4] {
        let [slope_x, slope_y] = [moved.x.to_array()[3], moved.y.to_array()[3]];
        let seen = |at: f32, moved: Lanes, slope: f32| {
            Lanes::splat(at - self.refraction * slope).minus(moved)
        };
        let sum = Texture::sum_at(
            &self.layers,
            seen(x, moved.x, slope_x),
            seen(y, moved.y, slope_y),
        );
        let [facing_x, facing_y] = FACING.map(Lanes::new);
        let facing_x = Lanes::splat(self.gloss * slope_x).times(facing_x);
        let facing_y = Lanes::splat(self.gloss * slope_y).times(facing_y);
        let wet = Lanes::splat(moved.wetting);
        sum.minus(facing_x.plus(facing_y)).plus(wet).to_array()
    }
}

impl Lighting {
    fn new(scene: &Scene, light: AmbientLight) -> Lighting {
        let source = Outside::new(light);
        let raster = &scene.raster;
        let exposure = narrow(source.exposure());
        let glow: Vec<f32> = scene.glow.iter().map(|glow| exposure * glow).collect();
        let outside = field(raster, |x, y| source.at(x, y));
        let mut background = vec![0.0; glow.len()];
        let (pixels, _) = background.as_chunks_mut::<3>();
        for (index, pixel) in pixels.iter_mut().enumerate() {
            let x = raster.x(index % raster.width);
            let y = raster.y(index / raster.width);
            let pattern = scene.pattern(&Moved::nowhere(), x, y);
            *pixel = [0, 1, 2].map(|colour: usize| {
                let sample = 3 * index + colour;
                glow[sample] * (1.0 + (pattern[colour] + 0.0)) + outside[sample]
            });
        }
        Lighting {
            scene: light,
            glow,
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
