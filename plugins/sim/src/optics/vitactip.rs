//! ViTacTip: a clear dome with moving markers. Its picture shows the object through the skin.

mod dome;
mod lens;
mod skin;
mod spec;

pub use spec::VitactipSpec;

use std::sync::Arc;

use self::dome::Dimple;
use self::lens::Lens;
use super::ambient::AmbientLight;
use super::band::Band;
use super::disc::{Disc, DiscSpec};
use super::error::OpticsError;
use super::marks::Marks;
use super::raster::Raster;
use super::relief::{Relief, Window};
use super::stimulus::{Board, Stimulus};
use super::texture::{self, Texture};
use super::view::View;
use crate::contact::Contact;
use crate::number::narrow;
use crate::random::{Purpose, Random};

/// A dome of one unit, at one frame size.
#[derive(Clone, Debug)]
pub(super) struct Vitactip {
    scene: Arc<Scene>,
    lighting: Arc<Lighting>,
    touch: Touch,
    /// Places of the markers in the picture.
    markers: Vec<[f32; 2]>,
    /// Places of the marks of wear in the picture.
    worn: Vec<[f32; 2]>,
}

/// Constant data of all frames.
#[derive(Debug)]
struct Scene {
    raster: Raster,
    spec: VitactipSpec,
    lens: Lens,
    dimple: Dimple,
    disc: Disc,
    /// Light of the skin under the dome's own lamps, without markers.
    skin: Vec<f32>,
    /// Places of the markers on the untouched dome, in mm from its centre; the next field has their places in the picture.
    markers: Vec<[f64; 3]>,
    seen: Vec<[f32; 2]>,
    marks: Marks,
    /// Places of the marks on the untouched dome; the next field has their places in the picture.
    worn: Vec<[f64; 3]>,
    worn_seen: Vec<[f32; 2]>,
}

/// Untouched dome in one scene of light, without markers.
#[derive(Debug)]
struct Lighting {
    scene: AmbientLight,
    background: Vec<f32>,
}

#[derive(Clone, Debug)]
enum Touch {
    Nothing,
    Ball(Ball),
    Board { relief: Relief, depth_mm: f64 },
}

/// Image of the ball through the skin: a bell-shaped light.
#[derive(Clone, Copy, Debug)]
struct Ball {
    middle: [f32; 2],
    width: f32,
    brightness: f32,
}

/// Reach of the bell, in widths. Its height there is four millionths.
const WIDTHS: f32 = 5.0;
/// Scale of the edges of markers and dome, in radii of the rim: a quarter of a pixel of a frame 96 pixels wide.
const EDGE: f64 = 0.25 / 46.0;
/// Texel of the skin's unevenness. The correlation length is three texels.
const TEXEL: f64 = 1.0 / 46.0;

impl Vitactip {
    pub(super) fn new(spec: &VitactipSpec, raster: Raster, unit: u32) -> Vitactip {
        let scene = Scene::new(spec, raster, unit);
        Vitactip {
            lighting: Arc::new(Lighting::new(&scene, AmbientLight::Normal)),
            touch: Touch::Nothing,
            markers: scene.seen.clone(),
            worn: scene.worn_seen.clone(),
            scene: Arc::new(scene),
        }
    }

    pub(super) fn pose(&mut self, view: &View) -> Result<(), OpticsError> {
        let scene = &*self.scene;
        self.touch = match view.stimulus {
            Stimulus::Ball(contact) if contact.touches() => Touch::Ball(scene.ball(&contact)),
            Stimulus::Nothing | Stimulus::Ball(_) => Touch::Nothing,
            Stimulus::Board(board) => Touch::Board {
                relief: scene.relief(&board)?,
                depth_mm: board.depth_mm,
            },
        };
        if let (Touch::Ball(_), Stimulus::Ball(contact)) = (&self.touch, view.stimulus) {
            let markers = self.markers.iter_mut().zip(&scene.markers);
            let marks = self.worn.iter_mut().zip(&scene.worn);
            for (place, marker) in markers.chain(marks) {
                let displaced = dome::displaced(*marker, &contact, &scene.dimple, &scene.spec);
                *place = scene.lens.project(displaced).map(narrow);
            }
        } else {
            self.markers.copy_from_slice(&scene.seen);
            self.worn.copy_from_slice(&scene.worn_seen);
        }
        if self.lighting.scene != view.light {
            self.lighting = Arc::new(Lighting::new(scene, view.light));
        }
        Ok(())
    }

    #[inline(always)]
    pub(super) fn paint(&self, band: &mut Band<'_>) {
        let scene = &*self.scene;
        let start = band.first_row * band.width;
        let length = band.light.len();
        band.light
            .copy_from_slice(&self.lighting.background[start..start + length]);
        match &self.touch {
            Touch::Nothing => {}
            Touch::Ball(ball) => scene.paint_ball(ball, band),
            Touch::Board { relief, depth_mm } => scene.paint_board(relief, *depth_mm, band),
        }
        for [x, y] in &self.markers {
            scene.disc.stamp(&scene.raster, *x, *y, band);
        }
        scene.marks.stamp(&self.worn, &scene.raster, band);
    }
}

impl Scene {
    fn new(spec: &VitactipSpec, raster: Raster, unit: u32) -> Scene {
        let random = Random::new(u64::from(unit));
        let lens = Lens::new(spec);
        let markers = places(spec, &random);
        let disc = DiscSpec {
            radius: spec.marker_radius,
            darkness: spec.marker_darkness,
            edge: EDGE,
        };
        let wear = spec.wear.as_ref();
        let apex = [0.0, 0.0, spec.dome_radius_mm];
        let marks = Marks::new(wear, spec.field_mm, unit, &raster, lens.scale(apex));
        let on_dome = |[x, y]: &[f64; 2]| on_dome([*x, *y], spec.dome_radius_mm);
        let worn: Vec<[f64; 3]> = marks.places_mm.iter().map(on_dome).collect();
        let gain = random.stream(Purpose::LampGain, 0).normal(0);
        let gain = 1.0 + spec.lamp_gain_spread * gain;
        let unevenness = texture::smooth_noise(&random.stream(Purpose::Texture, 0), 0, 3.0);
        let unevenness = Texture::new(TEXEL, &[unevenness]);
        let edge = outline_edge(&raster);
        let skin = field(&raster, |x, y| {
            let uneven = f64::from(unevenness.at(narrow(x), narrow(y))[0]);
            gain * skin::base(spec, (x * x + y * y).sqrt(), uneven, edge)
        });
        Scene {
            raster,
            spec: spec.clone(),
            lens,
            dimple: Dimple::new(),
            disc: Disc::new(disc, &raster),
            skin,
            seen: markers
                .iter()
                .map(|marker| lens.project(*marker).map(narrow))
                .collect(),
            markers,
            worn_seen: worn
                .iter()
                .map(|mark| lens.project(*mark).map(narrow))
                .collect(),
            worn,
            marks,
        }
    }

    /// Image of the ball of `contact`.
    fn ball(&self, contact: &Contact) -> Ball {
        let touched = contact
            .normal
            .map(|part| part * (self.spec.dome_radius_mm - contact.normal_depth_mm));
        let width = 0.8 * contact.indenter_radius_mm * self.lens.scale(touched);
        let facing = contact.normal[2].clamp(0.3, 1.0);
        let [first, deeper] = self.spec.ball_glow;
        Ball {
            middle: self.lens.project(touched).map(narrow),
            width: narrow(width),
            brightness: narrow((first + deeper * contact.normal_depth_mm / 3.5) * facing),
        }
    }

    #[inline(always)]
    fn paint_ball(&self, ball: &Ball, band: &mut Band<'_>) {
        let [x, y] = ball.middle;
        let reach = WIDTHS * ball.width;
        let columns = self.raster.columns(x, reach);
        let bell = |from: f32| libm::expf(-0.5 * (from / ball.width) * (from / ball.width));
        let across: Vec<f32> = columns
            .clone()
            .map(|column| bell(self.raster.x(column) - x))
            .collect();
        for row in band.rows_among(self.raster.rows(y, reach)) {
            let brightness = ball.brightness * bell(self.raster.y(row) - y);
            let skin = &self.skin[row * band.width..][columns.clone()];
            let light = &mut band.row_mut(row - band.first_row)[columns.clone()];
            for ((light, skin), across) in light.iter_mut().zip(skin).zip(&across) {
                *light += skin * (brightness * across);
            }
        }
    }

    fn relief(&self, board: &Board) -> Result<Relief, OpticsError> {
        let apex = [0.0, 0.0, self.spec.dome_radius_mm];
        let pixel = 0.5 * f64::from(self.raster.pitch[0] + self.raster.pitch[1]);
        Relief::new(
            board,
            Window {
                layer_mm: None,
                blur_mm: self.spec.blur_mm,
                pixel_mm: pixel / self.lens.scale(apex),
            },
        )
    }

    fn paint_board(&self, relief: &Relief, depth_mm: f64, band: &mut Band<'_>) {
        let contrast = narrow(self.spec.grating_contrast);
        for row in band.rows() {
            let y = f64::from(self.raster.y(row));
            for column in 0..band.width {
                let x = f64::from(self.raster.x(column));
                if x * x + y * y > 1.0 {
                    continue;
                }
                let [board_x, board_y] = self.lens.on_plane([x, y], depth_mm).map(narrow);
                let seen = contrast * relief.at(board_x, board_y);
                let skin = self.skin[row * band.width + column];
                band.row_mut(row - band.first_row)[column] += skin * seen;
            }
        }
    }
}

impl Lighting {
    fn new(scene: &Scene, light: AmbientLight) -> Lighting {
        let edge = outline_edge(&scene.raster);
        let outside = field(&scene.raster, |x, y| {
            skin::inside((x * x + y * y).sqrt(), edge) * skin::outside(light, x, y)
        });
        let lit = scene.skin.iter().zip(outside);
        Lighting {
            scene: light,
            background: lit.map(|(skin, outside)| skin + outside).collect(),
        }
    }
}

/// Width of the dome's outline: a quarter of a pixel, and at least the blur of the lens.
fn outline_edge(raster: &Raster) -> f64 {
    let pixel = 0.5 * f64::from(raster.pitch[0] + raster.pitch[1]);
    (EDGE * EDGE + pixel * pixel / 16.0).sqrt()
}

/// Places of the markers of a unit: a hexagonal grid along the axis, projected on the dome.
fn places(spec: &VitactipSpec, random: &Random) -> Vec<[f64; 3]> {
    let jitter = random.stream(Purpose::MarkerJitter, 0);
    let rings = spec.rings;
    let wear = spec.wear.as_ref();
    let shift = wear.map_or([0.0; 2], |wear| wear.shift_xy_mm());
    let cells = (-rings..=rings).flat_map(|q| (-rings..=rings).map(move |t| (q, t)));
    cells
        .filter(|(q, t)| (q + t).abs() <= rings)
        .zip(0..)
        .map(|((q, t), number)| {
            let [q, t] = [f64::from(q), f64::from(t)];
            let x = spec.marker_pitch_mm * (q + 0.5 * t);
            let y = spec.marker_pitch_mm * (0.75_f64.sqrt() * t);
            let x = x + spec.marker_jitter_mm * jitter.normal(2 * number);
            let y = y + spec.marker_jitter_mm * jitter.normal(2 * number + 1);
            on_dome([x + shift[0], y + shift[1]], spec.dome_radius_mm)
        })
        .collect()
}

/// Point of a dome of `radius` at `x`, `y`.
fn on_dome([x, y]: [f64; 2], radius: f64) -> [f64; 3] {
    [x, y, (radius * radius - x * x - y * y).max(0.0).sqrt()]
}

/// A field of light over the frame.
fn field(raster: &Raster, at: impl Fn(f64, f64) -> f64) -> Vec<f32> {
    let rows = (0..raster.height).map(|row| f64::from(raster.y(row)));
    rows.flat_map(|y| {
        let at = &at;
        (0..raster.width).map(move |column| narrow(at(f64::from(raster.x(column)), y)))
    })
    .collect()
}
