//! Draws a small recording to try TacEva on: 800 pictures of a marker gel, 200 contact points pressed at four depths.
//!
//! ```text
//! cargo run --release --example make_recording -- demo
//! cargo run --release -- evaluate demo --model ridge --split by-point --metrics accuracy
//! ```
//!
//! Optional arguments after the folder are the number of contact points and the seed. `make_recording -- demo 5000` draws 20,000 pictures, and
//! `make_recording -- tuesday 40 2` draws other presses than `make_recording -- monday 40 1`.
//!
//! Nothing here was measured. The labels follow closed forms (below), the pictures are drawn from the labels, and the dataset states
//! `source = "synthetic"`, which every report repeats.

use std::path::Path;

use taceva_core::random::mix;
use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample, Stamp,
};
use taceva_dataset::{Footprint, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

const SIZE: u32 = 96;
const DEPTHS: u32 = 4;
/// Radius of the pressed area of the gel, mm. The picture shows a slightly larger area.
const RADIUS_MM: f64 = 5.0;
const PIXELS_A_MM: f64 = 6.4;

/// Size and seed of a recording.
#[derive(Clone, Copy)]
struct Drawing {
    points: u32,
    seed: u64,
}

impl Default for Drawing {
    fn default() -> Drawing {
        Drawing {
            points: 200,
            seed: 20_260_101,
        }
    }
}

impl Drawing {
    /// Parses the number of points and the seed, with defaults for missing words. `None` for 0 points, or if a word is not a number.
    fn of(mut words: impl Iterator<Item = String>) -> Option<Drawing> {
        let mut drawing = Drawing::default();
        if let Some(points) = words.next() {
            drawing.points = points.parse().ok().filter(|points| *points > 0)?;
        }
        if let Some(seed) = words.next() {
            drawing.seed = seed.parse().ok()?;
        }
        words.next().is_none().then_some(drawing)
    }
}

/// Press: position, depth and shear of the tip, mm.
struct Press {
    x_mm: f64,
    y_mm: f64,
    depth_mm: f64,
    shear_x_mm: f64,
    shear_y_mm: f64,
}

impl Press {
    /// Press of a point and step. Points are on a sunflower spiral. Depth and shear depend only on the arguments, so each press can be computed
    /// alone.
    fn planned(drawing: Drawing, point: u32, step: u32) -> Press {
        let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let radius = RADIUS_MM * (f64::from(point) + 0.5).sqrt() / f64::from(drawing.points).sqrt();
        let angle = golden_angle * f64::from(point);
        let draw = |purpose| unit_draw(drawing.seed, point, step, purpose);
        let (shear, direction) = (0.5 * draw(1).sqrt(), std::f64::consts::TAU * draw(2));
        Press {
            x_mm: radius * angle.cos(),
            y_mm: radius * angle.sin(),
            depth_mm: 0.15 + 0.3 * (f64::from(step) + draw(0)),
            shear_x_mm: shear * direction.cos(),
            shear_y_mm: shear * direction.sin(),
        }
    }

    /// Forces in N on a sphere by Hertz. The normal force is proportional to depth^1.5, and the shear stiffness to the contact radius, so to
    /// depth^0.5.
    fn forces_newton(&self) -> [f64; 3] {
        let stiffness = 1.2 * self.depth_mm.sqrt();
        [
            stiffness * self.shear_x_mm,
            stiffness * self.shear_y_mm,
            1.3 * self.depth_mm.powf(1.5),
        ]
    }

    /// Displaced position of the marker whose rest position is `(x, y)`, mm. Shear moves the marker along, indentation moves it outward.
    fn displaced(&self, x: f64, y: f64) -> (f64, f64) {
        let (from_x, from_y) = (x - self.x_mm, y - self.y_mm);
        let near = (-(from_x * from_x + from_y * from_y) / (2.0 * 1.6 * 1.6)).exp();
        let outward = 0.35 * self.depth_mm * near;
        (
            x + self.shear_x_mm * near + outward * from_x,
            y + self.shear_y_mm * near + outward * from_y,
        )
    }

    /// Loss of brightness by the dent at a position, in grey levels.
    fn shade(&self, x: f64, y: f64) -> f64 {
        let (from_x, from_y) = (x - self.x_mm, y - self.y_mm);
        28.0 * self.depth_mm * (-(from_x * from_x + from_y * from_y) / (2.0 * 1.1 * 1.1)).exp()
    }

    fn draw(&self, drawing: Drawing, point: u32, step: u32) -> Frame {
        let side = SIZE as usize;
        let place = |pixel: usize| (to_f64(pixel) - to_f64(side - 1) / 2.0) / PIXELS_A_MM;
        let mut light: Vec<f64> = (0..side * side)
            .map(|pixel| {
                let (x, y) = (place(pixel % side), place(pixel / side));
                90.0 - 0.35 * (x * x + y * y) - self.shade(x, y)
            })
            .collect();
        for marker_y in -7..=7_i32 {
            for marker_x in -7..=7_i32 {
                let (x, y) = self.displaced(f64::from(marker_x), f64::from(marker_y));
                add_marker(&mut light, side, x, y);
            }
        }
        let noise = |pixel: usize| {
            2.0 * (unit_draw(drawing.seed ^ 1, point * DEPTHS + step, to_u32(pixel), 3) - 0.5)
        };
        let bytes = light
            .iter()
            .enumerate()
            .map(|(pixel, light)| to_byte(light + noise(pixel)))
            .collect();
        let info = FrameInfo {
            width: SIZE,
            height: SIZE,
            format: PixelFormat::Gray8,
        };
        Frame::new(info, bytes).expect("a byte for each pixel")
    }
}

/// Adds a white pin of 0.25 mm with a blurred edge, in the pixels that it touches.
fn add_marker(light: &mut [f64], side: usize, x_mm: f64, y_mm: f64) {
    let middle = to_f64(side - 1) / 2.0;
    let (x, y) = (x_mm * PIXELS_A_MM + middle, y_mm * PIXELS_A_MM + middle);
    for row in 0..side {
        for column in 0..side {
            let (from_x, from_y) = (to_f64(column) - x, to_f64(row) - y);
            let squared = from_x * from_x + from_y * from_y;
            if squared < 25.0 {
                light[row * side + column] += 120.0 * (-squared / (2.0 * 1.6 * 1.6)).exp();
            }
        }
    }
}

/// Random number in [0, 1) that depends only on the arguments.
fn unit_draw(seed: u64, point: u32, step: u32, purpose: u32) -> f64 {
    let place = [point, step, purpose]
        .into_iter()
        .fold(seed, |mixed, number| mix(mixed ^ u64::from(number)));
    f64::from(u32::try_from(place >> 32).unwrap_or_default()) / 4_294_967_296.0
}

fn record(path: &Path, drawing: Drawing) -> Result<(), Box<dyn std::error::Error>> {
    let sensor = SensorFacts::new("drawn marker gel")
        .with_serial("none")
        .with_gel("none")
        .with_opaque(true);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Monotonic, sensor)
        .with_footprint(Footprint::disc(RADIUS_MM).with_depth_max(1.5));
    let spec = RecordingSpec::new(facts, Channels::new(Channel::SIX)?);
    let mut recorder = Recorder::create(path, &spec)?;
    let untouched = Press {
        x_mm: 0.0,
        y_mm: 0.0,
        depth_mm: 0.0,
        shear_x_mm: 0.0,
        shear_y_mm: 0.0,
    };
    recorder.append_reference(&untouched.draw(drawing, drawing.points, 0))?;
    for point in 0..drawing.points {
        for step in 0..DEPTHS {
            let press = Press::planned(drawing, point, step);
            let [fx, fy, fz] = press.forces_newton();
            recorder.append(
                &Sample::new(format!("{point:03}-{step}"))
                    .with_point_id(format!("{point:03}"))
                    .with_depth_step(step)
                    .with_stamp(Stamp {
                        valid_s: 2.5 * f64::from(point * DEPTHS + step),
                        received_s: None,
                    })
                    .with_frame(press.draw(drawing, point, step))
                    .with_truth(Readings::from_values([
                        press.x_mm,
                        press.y_mm,
                        press.depth_mm,
                        fx,
                        fy,
                        fz,
                    ])),
            )?;
        }
    }
    recorder.close()?;
    Ok(())
}

#[expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program of its own"
)]
fn main() -> std::process::ExitCode {
    let mut words = std::env::args_os().skip(1);
    let path = words
        .next()
        .filter(|path| !path.to_string_lossy().starts_with('-'));
    let words = words.map(|word| word.to_string_lossy().into_owned());
    let (Some(path), Some(drawing)) = (path, Drawing::of(words)) else {
        eprintln!("usage: make_recording FOLDER [POINTS [SEED]]");
        return std::process::ExitCode::from(2);
    };
    let path = Path::new(&path);
    match record(path, drawing) {
        Ok(()) => {
            let (shown, samples) = (path.display(), drawing.points * DEPTHS);
            println!("{shown}: {samples} drawn pictures with closed-form labels (synthetic)");
            println!(
                "next: cargo run --release -- evaluate {shown} --model ridge --split by-point --metrics accuracy"
            );
            std::process::ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("make_recording: {error}");
            std::process::ExitCode::from(3)
        }
    }
}

fn to_f64(number: usize) -> f64 {
    f64::from(to_u32(number))
}

fn to_u32(number: usize) -> u32 {
    u32::try_from(number).expect("a place in a small picture")
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "rounded and clamped to a byte first"
)]
fn to_byte(light: f64) -> u8 {
    light.round().clamp(0.0, 255.0) as u8
}
