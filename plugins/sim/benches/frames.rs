//! Pictures per second of each simulated sensor on one core, from contact to bytes.
//!
//! `cargo bench -p taceva-sim --bench frames`. Frames have 19,200 pixels unless the name states otherwise, with noise. A sample is 64 frames. The press moves
//! from frame to frame, so that all samples are equally difficult.

use divan::Bencher;
use divan::counter::ItemsCount;
use taceva_core::FrameMut;
use taceva_sim::Model;
use taceva_sim::contact::{Contact, Indentation, Solid};
use taceva_sim::optics::{Camera, OpticsSpec, Stimulus, View};

fn main() {
    divan::main();
}

/// Longer side of a frame as used by models, pixels. The shorter side is three quarters of it.
const SMALL: u32 = 160;
/// Frames per sample.
const FRAMES: u32 = 64;

/// Motion of the ball along the gel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Touch {
    Pressed,
    Dragged,
}

#[divan::bench(args = Model::ALL)]
fn untouched(bencher: Bencher<'_, '_>, model: Model) {
    frames(bencher, model, SMALL, &[]);
}

#[divan::bench(args = Model::ALL)]
fn pressed(bencher: Bencher<'_, '_>, model: Model) {
    frames(bencher, model, SMALL, &contacts(model, Touch::Pressed));
}

#[divan::bench(args = Model::ALL)]
fn pressed_640_by_480(bencher: Bencher<'_, '_>, model: Model) {
    frames(bencher, model, 640, &contacts(model, Touch::Pressed));
}

#[divan::bench(args = Model::ALL)]
fn dragged(bencher: Bencher<'_, '_>, model: Model) {
    frames(bencher, model, SMALL, &contacts(model, Touch::Dragged));
}

/// Contacts for [`FRAMES`] frames over the probed surface, at various depths.
fn contacts(model: Model, touch: Touch) -> Vec<Contact> {
    let parameters = model.parameters();
    let solid = Solid::new(&parameters);
    let probing = &parameters.probing;
    (0..FRAMES)
        .map(|number| {
            let turn = f64::from(number);
            // Even cover of a disc: multiples of the golden angle, at radii proportional to the root of the number.
            let out = 0.9 * (turn / f64::from(FRAMES)).sqrt();
            let (sin, cos) = (2.399_963 * turn).sin_cos();
            let depth_mm = probing.depth_max_mm * (0.2 + 0.8 * (turn * 0.618).fract());
            let shear = match touch {
                Touch::Pressed => 0.0,
                Touch::Dragged => probing.shear_max_mm,
            };
            solid.contact(&Indentation {
                place_mm: [
                    probing.half_width_mm * out * cos,
                    probing.half_height_mm * out * sin,
                ],
                depth_mm,
                deepest_mm: depth_mm,
                shear_mm: [shear * sin, shear * cos],
                indenter_radius_mm: 2.0,
                stiffness: 1.0,
            })
        })
        .collect()
}

fn frames(bencher: Bencher<'_, '_>, model: Model, longer: u32, contacts: &[Contact]) {
    let spec = OpticsSpec::new(&model.parameters());
    let upright = spec.native[1] > spec.native[0];
    let shorter = longer * 3 / 4;
    let size = if upright {
        [shorter, longer]
    } else {
        [longer, shorter]
    };
    let mut camera = Camera::new(&spec, size, 0, 1).expect("a frame below the native size");
    let info = camera.frame_info();
    let mut bytes = vec![0; info.byte_len().expect("a small frame")];
    let views: Vec<View> = (0..FRAMES)
        .map(|number| View {
            stimulus: usize::try_from(number)
                .ok()
                .and_then(|number| contacts.get(number))
                .map_or(Stimulus::Nothing, |contact| Stimulus::Ball(*contact)),
            press: u64::from(number),
            ..View::default()
        })
        .collect();
    bencher.counter(ItemsCount::new(FRAMES)).bench_local(|| {
        for view in &views {
            let into = FrameMut::new(info, &mut bytes).expect("the camera's own frame");
            camera.render(view, into).expect("a picture");
        }
        bytes[0]
    });
}
