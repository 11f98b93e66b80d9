//! Draws frames of each simulated sensor: untouched, pressed, dragged, on gratings, and under ambient light.
//!
//! ```text
//! cargo run --release -p taceva-sim --example gallery -- gallery
//! ```
//!
//! Writes one PNG per sensor into the named folder, with its frames side by side. Frames of dark sensors are brightened; the file names state the
//! factor.

use std::error::Error;
use std::path::PathBuf;

use image::{Rgb, RgbImage};
use taceva_core::{Frame, FrameMut, GratingKind, Nanometre};
use taceva_sim::contact::{Indentation, Solid};
use taceva_sim::optics::{AmbientLight, Board, Camera, OpticsSpec, Stimulus, View};
use taceva_sim::{Grating, GratingPose, Model, Parameters};

/// Number of black pixels between frames.
const GAP: u32 = 4;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(
        std::env::args()
            .nth(1)
            .unwrap_or_else(|| "gallery".to_owned()),
    );
    std::fs::create_dir_all(&folder)?;
    for model in Model::ALL {
        let parameters = model.parameters();
        let (size, gain) = match model {
            Model::ViTacTip => ([240, 240], 5),
            Model::MagicTac => ([202, 240], 1),
            _ => ([184, 240], 1),
        };
        let mut camera = Camera::new(&OpticsSpec::new(&parameters), size, 0, 1)?;
        let mut views = touches(&parameters);
        if camera.is_transparent() {
            let pressed = views[1];
            views.extend(AmbientLight::ALL[1..].iter().map(|light| View {
                light: *light,
                ..pressed
            }));
        }
        let frames: Vec<Frame> = views
            .iter()
            .map(|view| take(&mut camera, view))
            .collect::<Result<_, _>>()?;
        let name = format!("{}-brightness-x{gain}-simulated.png", model.key());
        strip(&frames, gain).save(folder.join(name))?;
    }
    Ok(())
}

/// Views: untouched, pressed, pressed elsewhere, dragged, lines and dots.
fn touches(parameters: &Parameters) -> Vec<View> {
    let solid = Solid::new(parameters);
    let deepest_mm = parameters.probing.depth_max_mm;
    let ball = |place_mm: [f64; 2], part: f64, shear_mm: [f64; 2]| {
        let depth_mm = part * deepest_mm;
        Stimulus::Ball(solid.contact(&Indentation {
            place_mm,
            depth_mm,
            deepest_mm: depth_mm,
            shear_mm,
            indenter_radius_mm: 2.0,
            stiffness: 1.0,
        }))
    };
    let board = |kind, spacing_nm| {
        Stimulus::Board(Board {
            grating: Grating::new(kind, Nanometre(spacing_nm)).expect("in the catalogue"),
            pose: GratingPose {
                yaw_degree: 12.0,
                offset_mm: [0.4, -0.3],
            },
            pressure_mpa: 0.1,
            depth_mm: 1.0,
            young_modulus_mpa: 0.3,
        })
    };
    let shear = parameters.probing.shear_max_mm;
    let stimuli = [
        Stimulus::Nothing,
        ball([2.0, 1.5], 0.9, [0.0, 0.0]),
        ball([2.0, 1.5], 0.9, [0.8 * shear, 0.6 * shear]),
        ball([-2.5, -3.5], 0.4, [0.0, 0.0]),
        board(GratingKind::Line, 1_000_000),
        board(GratingKind::Dot, 1_250_000),
    ];
    stimuli
        .into_iter()
        .zip(0..)
        .map(|(stimulus, press)| View {
            stimulus,
            press,
            ..View::default()
        })
        .collect()
}

fn take(camera: &mut Camera, view: &View) -> Result<Frame, Box<dyn Error>> {
    let info = camera.frame_info();
    let mut bytes = vec![
        0;
        info.byte_len()
            .ok_or("the frame exceeds the address space")?
    ];
    camera.render(view, FrameMut::new(info, &mut bytes)?)?;
    Ok(Frame::new(info, bytes)?)
}

/// Concatenates the frames from left to right, with eight bits per colour.
fn strip(frames: &[Frame], gain: u16) -> RgbImage {
    let info = frames[0].info();
    let count = u32::try_from(frames.len()).expect("few frames");
    let mut picture = RgbImage::new(count * (info.width + GAP) - GAP, info.height);
    for (number, frame) in (0..).zip(frames) {
        let samples: Vec<u16> = frame.samples().collect();
        let channels = info.format.samples();
        for (index, pixel) in (0..).zip(samples.chunks_exact(channels)) {
            let eight_bit = |sample: u16| {
                let dn = sample.saturating_mul(gain) / 256;
                u8::try_from(dn).unwrap_or(u8::MAX)
            };
            let colour = [0, 1, 2].map(|colour| eight_bit(pixel[colour.min(channels - 1)]));
            let column = number * (info.width + GAP) + index % info.width;
            picture.put_pixel(column, index / info.width, Rgb(colour));
        }
    }
    picture
}
