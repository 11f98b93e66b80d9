//! MagicTac: a clear block. Its picture shows the motion of a lattice in three layers.

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
use super::error::OpticsError;
use super::marks::Marks;
use super::raster::Raster;
use super::relief::{Relief, Window};
use super::simd::Lanes;
use super::stimulus::Stimulus;
use super::texture::Texture;
use super::view::View;
use crate::displacement::{Field, Load, Profile, Tables};
use crate::number::narrow;
use crate::random::{Purpose, Random};

/// A block of one unit, at one frame size.
#[derive(Clone, Debug)]
pub(super) struct Magictac {
    scene: Arc<Scene>,
    lighting: Arc<Lighting>,
    profiles: [Profile; 3],
    touch: Touch,
    shift: Shift,
    /// Offset of this press in the buckling pattern.
    buckling: [f32; 2],
    /// Present places of the marks of wear.
    worn: Vec<[f32; 2]>,
}

/// Constant data of all frames.
#[derive(Debug)]
struct Scene {
    raster: Raster,
    spec: MagictacSpec,
    tables: [Arc<Tables>; 3],
    layers: [Texture; 3],
    buckling: Texture,
    buckling_part: f32,
    refraction: f32,
    gloss: f32,
    /// Light of the lamps at each pixel: red, green and blue.
    glow: Vec<[f32; 3]>,
    /// Shift of the block in its housing.
    shift: [f32; 2],
    marks: Marks,
    /// Places of the marks on the untouched block.
    worn: Vec<[f32; 2]>,
}

/// Untouched block in one scene of light.
#[derive(Debug)]
struct Lighting {
    scene: AmbientLight,
    sources: Vec<Source>,
    background: Vec<f32>,
}

#[derive(Clone, Debug)]
enum Touch {
    Nothing,
    Ball,
    Board(Relief),
}

/// Directions of surface slope that brighten red, green and blue: along x, then along y.
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
            worn: scene.worn.clone(),
            scene: Arc::new(scene),
        }
    }

    pub(super) fn pose(&mut self, view: &View, random: &Random) -> Result<(), OpticsError> {
        let scene = &*self.scene;
        self.worn.copy_from_slice(&scene.worn);
        self.touch = match view.stimulus {
            Stimulus::Nothing => Touch::Nothing,
            Stimulus::Ball(contact) if !contact.touches() => Touch::Nothing,
            Stimulus::Ball(contact) => {
                let load = contact.load();
                if !self.worn.is_empty() {
                    scene.displace(&load, &mut self.worn);
                }
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
        let scene = &*self.scene;
        scene.marks.stamp(&self.worn, &scene.raster, band);
    }

    /// Renders a ball. The lattice moves smoothly, so that its shift is computed for every second pixel of a row and interpolated for the other
    /// pixels.
    #[inline(always)]
    fn paint_ball(&self, band: &mut Band<'_>) {
        let (scene, raster, shift) = (&*self.scene, &self.scene.raster, &self.shift);
        for row in band.rows_among(raster.rows(shift.y, shift.reach)) {
            let y = raster.y(row);
            let dy = y - shift.y;
            let half = (shift.reach * shift.reach - dy * dy).max(0.0).sqrt();
            let moved = |x: f32| self.buckled(shift.at(x, y), x, y);
            let columns = raster.columns(shift.x, half);
            let Stretch { light, source } = self.stretch(row, columns.clone(), band);
            let mut here = moved(raster.x(columns.start));
            for ((light, source), column) in light
                .chunks_mut(2)
                .zip(source.chunks(2))
                .zip(columns.step_by(2))
            {
                let next = moved(raster.x(column + 2));
                let seen = [here, here.halfway_to(&next)];
                for (((light, source), moved), column) in
                    light.iter_mut().zip(source).zip(&seen).zip(column..)
                {
                    let pattern = scene.pattern(moved, raster.x(column), y);
                    *light = source.under(&pattern, 0.0);
                }
                here = next;
            }
        }
    }

    /// Adds random buckling of the loaded lattice: a fraction of its shift, in a random direction.
    #[inline(always)]
    fn buckled(&self, mut moved: Moved, x: f32, y: f32) -> Moved {
        let [chance_x, chance_y] = (self.scene.buckling)
            .near(x + self.buckling[0], y + self.buckling[1])
            .map(|chance| chance * self.scene.buckling_part);
        // The fourth lane is the surface, which does not buckle.
        let size = moved.x.times(moved.x).plus(moved.y.times(moved.y)).root();
        let by = |chance: f32| size.times(Lanes::new([chance, chance, chance, 0.0]));
        moved.x = moved.x.plus(by(chance_x));
        moved.y = moved.y.plus(by(chance_y));
        moved
    }

    #[inline(always)]
    fn paint_board(&self, relief: &Relief, band: &mut Band<'_>) {
        let (scene, raster) = (&*self.scene, &self.scene.raster);
        let [x, y] = relief.centre();
        let contrast = narrow(scene.spec.grating_contrast);
        for row in band.rows_among(raster.rows(y, relief.reach())) {
            let y = raster.y(row);
            let columns = raster.columns(x, relief.reach());
            let Stretch { light, source } = self.stretch(row, columns.clone(), band);
            for ((light, source), column) in light.iter_mut().zip(source).zip(columns) {
                let x = raster.x(column);
                let pattern = scene.pattern(&Moved::nowhere(), x, y);
                *light = source.under(&pattern, contrast * relief.at(x, y));
            }
        }
    }

    /// Borrows the pixels `columns` of a row, with their light sources.
    #[inline(always)]
    fn stretch<'a>(
        &'a self,
        row: usize,
        columns: std::ops::Range<usize>,
        band: &'a mut Band<'_>,
    ) -> Stretch<'a> {
        let first = row * band.width;
        let light = band.row_mut(row - band.first_row);
        Stretch {
            light: &mut light.as_chunks_mut::<3>().0[columns.clone()],
            source: &self.lighting.sources[first + columns.start..first + columns.end],
        }
    }
}

/// Adjacent pixels of a row.
struct Stretch<'a> {
    light: &'a mut [[f32; 3]],
    source: &'a [Source],
}

/// Light sources of a pixel: red, green and blue.
#[derive(Clone, Copy, Debug)]
struct Source {
    /// Light of the lamps after exposure.
    glow: [f32; 3],
    /// Ambient light.
    outside: [f32; 3],
}

impl Source {
    /// Light of a pixel with the lattice `pattern`, brightened by the fraction `brighter`.
    #[inline(always)]
    fn under(&self, pattern: &[f32; 4], brighter: f32) -> [f32; 3] {
        [0, 1, 2].map(|colour: usize| {
            self.glow[colour] * (1.0 + (pattern[colour] + brighter)) + self.outside[colour]
        })
    }
}

impl Moved {
    /// No motion, as outside a contact.
    #[inline(always)]
    fn nowhere() -> Moved {
        Moved {
            x: Lanes::splat(0.0),
            y: Lanes::splat(0.0),
            wetting: 0.0,
        }
    }

    #[inline(always)]
    fn halfway_to(&self, other: &Moved) -> Moved {
        let half = Lanes::splat(0.5);
        Moved {
            x: self.x.plus(other.x).times(half),
            y: self.y.plus(other.y).times(half),
            wetting: 0.5 * (self.wetting + other.wetting),
        }
    }
}

impl Scene {
    fn new(spec: &MagictacSpec, raster: Raster, unit: u32) -> Scene {
        let glow = Glow::new(
            spec,
            &Random::new(u64::from(unit)).stream(Purpose::LampGain, 0),
        );
        let wear = spec.wear.as_ref();
        let marks = Marks::new(wear, spec.field_mm, unit, &raster, 1.0);
        let shift = wear.map_or([0.0; 2], |wear| wear.shift_xy_mm());
        Scene {
            raster,
            spec: spec.clone(),
            tables: spec
                .layers_mm
                .map(|depth| Tables::shared(spec.thickness_mm, depth)),
            layers: lattice::layers(spec, unit),
            buckling: lattice::buckling(unit),
            buckling_part: narrow(spec.buckling),
            refraction: narrow(spec.refraction_mm),
            gloss: narrow(spec.gloss),
            glow: field(&raster, |x, y| glow.at(x, y)),
            shift: shift.map(narrow),
            worn: marks.places_mm.iter().map(|at| at.map(narrow)).collect(),
            marks,
        }
    }

    /// Moves `places` with the surface under `load`.
    fn displace(&self, load: &Load, places: &mut [[f32; 2]]) {
        let mut profile = Profile::new();
        Tables::shared(self.spec.thickness_mm, 0.0).profile(load, &mut profile);
        let field = Field::new(&profile, load);
        for place in places {
            let [x, y] = *place;
            let [along_x, along_y, _] = field.at(x, y);
            *place = [x + along_x, y + along_y];
        }
    }

    /// Relative change of the light by lattice and surface at `x`, `y`, for red, green and blue, around 0.
    #[inline(always)]
    fn pattern(&self, moved: &Moved, x: f32, y: f32) -> [f32; 4] {
        let [x, y] = [x - self.shift[0], y - self.shift[1]];
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
        let sources: Vec<Source> = scene
            .glow
            .iter()
            .zip(field(raster, |x, y| source.at(x, y)))
            .map(|(glow, outside)| Source {
                glow: glow.map(|glow| exposure * glow),
                outside,
            })
            .collect();
        let background = sources.iter().enumerate().flat_map(|(index, source)| {
            let x = raster.x(index % raster.width);
            let y = raster.y(index / raster.width);
            source.under(&scene.pattern(&Moved::nowhere(), x, y), 0.0)
        });
        Lighting {
            scene: light,
            background: background.collect(),
            sources,
        }
    }
}

/// A field of light over the frame, with one colour at each pixel.
fn field(raster: &Raster, at: impl Fn(f64, f64) -> [f64; 3]) -> Vec<[f32; 3]> {
    (0..raster.width * raster.height)
        .map(|index| {
            let x = raster.x(index % raster.width);
            let y = raster.y(index / raster.width);
            at(f64::from(x), f64::from(y)).map(narrow)
        })
        .collect()
}
