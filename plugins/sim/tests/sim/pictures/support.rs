//! Cameras, presses and frames for the tests of pictures.

use taceva_core::{Frame, FrameMut};
use taceva_sim::contact::{Contact, Indentation, Solid};
use taceva_sim::optics::{Camera, CameraSpec, Luma, OpticsSpec, Stimulus, View};
use taceva_sim::{Model, Parameters};

/// Optics of a sensor without camera noise.
pub(super) fn quiet(model: Model) -> OpticsSpec {
    OpticsSpec {
        camera: CameraSpec::QUIET,
        ..OpticsSpec::new(&model.parameters())
    }
}

/// Contact of a ball of 2 mm, pressed `depth_mm` deep at `place_mm` and sheared by `shear_mm`.
pub(super) fn contact(
    parameters: &Parameters,
    place_mm: [f64; 2],
    depth_mm: f64,
    shear_mm: [f64; 2],
) -> Contact {
    Solid::new(parameters).contact(&Indentation {
        place_mm,
        depth_mm,
        deepest_mm: depth_mm,
        shear_mm,
        indenter_radius_mm: 2.0,
        stiffness: 1.0,
    })
}

pub(super) fn view(contact: Contact) -> View {
    View {
        stimulus: Stimulus::Ball(contact),
        ..View::default()
    }
}

pub(super) fn camera(spec: &OpticsSpec, size: [u32; 2]) -> Camera {
    Camera::new(spec, size, 0, 11).expect("below the native size")
}

pub(super) fn take(camera: &mut Camera, view: &View) -> (Frame, Luma) {
    let info = camera.frame_info();
    let mut bytes = vec![0; info.byte_len().expect("a small frame")];
    let into = FrameMut::new(info, &mut bytes).expect("the camera's own frame");
    let luma = camera.render(view, into).expect("a picture");
    (Frame::new(info, bytes).expect("all its bytes"), luma)
}

/// Samples of a frame, in DN.
pub(super) fn dn(frame: &Frame) -> Vec<f64> {
    frame
        .samples()
        .map(|sample| f64::from(sample) / 256.0)
        .collect()
}
