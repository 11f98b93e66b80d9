//! Camera of the bench: noise, sizes, determinism and errors.

use std::thread;

use taceva_core::{FrameMut, PixelFormat};
use taceva_sim::Model;
use taceva_sim::optics::{AmbientLight, Camera, CameraSpec, OpticsError, OpticsSpec, View};

use super::support::{camera, contact, dn, quiet, take, view};

#[test]
fn noise_has_the_variance_of_the_camera_averaged_over_the_pixels_binned() {
    let noisy = OpticsSpec {
        camera: CameraSpec {
            shot_gain_dn: 0.5,
            read_noise_dn: 3.0,
            flicker: 0.0,
        },
        ..OpticsSpec::new(&Model::ViTacTip.parameters())
    };
    let size = [120, 120];
    let binning = f64::from(noisy.native[0] * noisy.native[1]) / (120.0 * 120.0);
    let clean = dn(&take(&mut camera(&quiet(Model::ViTacTip), size), &View::default()).0);
    let mut with_noise = camera(&noisy, size);
    let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
    let mut neighbours = 0.0;
    for picture in 0..20 {
        let view = View {
            picture,
            ..View::default()
        };
        let frame = dn(&take(&mut with_noise, &view).0);
        let normal: Vec<f64> = frame
            .iter()
            .zip(&clean)
            .map(|(noisy, clean)| (noisy - clean) / ((0.5 * clean + 9.0) / binning).sqrt())
            .collect();
        for (first, second) in normal.iter().zip(&normal[1..]) {
            neighbours += first * second;
        }
        for value in normal {
            sum += value;
            squares += value * value;
            count += 1.0;
        }
    }
    assert!((sum / count).abs() < 0.01, "mean {}", sum / count);
    assert!(
        (squares / count - 1.0).abs() < 0.02,
        "variance {}",
        squares / count
    );
    assert!(
        (neighbours / count).abs() < 0.01,
        "neighbours {}",
        neighbours / count
    );
}

#[test]
fn two_pictures_of_one_press_share_nothing_but_the_press() {
    let spec = OpticsSpec::new(&Model::GelSightWm.parameters());
    let mut camera = camera(&spec, [96, 128]);
    let clean = dn(&take(
        &mut super::support::camera(&quiet(Model::GelSightWm), [96, 128]),
        &View::default(),
    )
    .0);
    let mut noise = |press, picture| {
        let view = View {
            press,
            picture,
            ..View::default()
        };
        let frame = dn(&take(&mut camera, &view).0);
        let noise: Vec<f64> = frame.iter().zip(&clean).map(|(a, b)| a - b).collect();
        let mean = noise.iter().sum::<f64>() / 36_864.0;
        noise.into_iter().map(|x| x - mean).collect::<Vec<f64>>()
    };
    let [first, second, third] = [noise(0, 0), noise(0, 1), noise(1, 0)];
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for other in [&second, &third] {
        let correlation = dot(&first, other) / (dot(&first, &first) * dot(other, other)).sqrt();
        // Stretches of one tile sometimes overlap, so the spread is wider than for independent numbers.
        assert!(
            correlation.abs() < 5.0 / 36_864.0_f64.sqrt(),
            "{correlation}"
        );
    }
}

#[test]
fn frames_have_eight_bits_at_full_size_and_sixteen_below() {
    let spec = OpticsSpec::new(&Model::ViTacTip.parameters());
    assert_eq!(
        spec.frame_info(spec.native).expect("native").format,
        PixelFormat::Gray8
    );
    assert_eq!(
        spec.frame_info([96, 96]).expect("small").format,
        PixelFormat::Gray16
    );
    let spec = OpticsSpec::new(&Model::MagicTac.parameters());
    assert_eq!(
        spec.frame_info(spec.native).expect("native").format,
        PixelFormat::Rgb8
    );
    assert_eq!(
        spec.frame_info([64, 64]).expect("small").format,
        PixelFormat::Rgb16
    );
}

#[test]
fn a_reduced_frame_is_as_bright_as_the_full_one_and_is_not_rounded_to_whole_dn() {
    for model in [Model::ViTacTip, Model::MagicTac] {
        let spec = OpticsSpec::new(&model.parameters());
        let full = take(&mut camera(&spec, spec.native), &View::default()).1;
        let (frame, small) = take(&mut camera(&spec, [96, 96]), &View::default());
        let difference = (full.mean_dn() - small.mean_dn()).abs();
        assert!(
            difference < 0.004 * full.mean_dn() + 0.06,
            "{model}: {difference}"
        );
        let whole = frame.samples().filter(|sample| sample % 256 == 0).count();
        assert!(whole * 50 < frame.samples().count(), "{model}: {whole}");
    }
}

#[test]
fn a_picture_does_not_depend_on_those_before_it_or_on_the_thread() {
    for model in Model::ALL {
        let parameters = model.parameters();
        let mut camera = camera(&OpticsSpec::new(&parameters), [60, 70]);
        let depth_mm = parameters.probing.depth_max_mm;
        let views: Vec<View> = (0..6_u32)
            .map(|number| View {
                press: u64::from(number),
                picture: number % 2,
                ..view(contact(
                    &parameters,
                    [f64::from(number), 0.5],
                    depth_mm,
                    [0.2, -0.1],
                ))
            })
            .collect();
        let forwards: Vec<_> = views.iter().map(|view| take(&mut camera, view)).collect();
        let backwards: Vec<_> = views
            .iter()
            .rev()
            .map(|view| take(&mut camera, view))
            .collect();
        assert!(forwards.iter().eq(backwards.iter().rev()), "{model}");
        let elsewhere: Vec<_> = thread::scope(|scope| {
            let threads: Vec<_> = views
                .iter()
                .map(|view| {
                    let mut camera = camera.clone();
                    scope.spawn(move || take(&mut camera, view))
                })
                .collect();
            threads
                .into_iter()
                .map(|thread| thread.join().expect("no panic"))
                .collect()
        });
        assert!(forwards == elsewhere, "{model}");
    }
}

#[test]
fn units_and_seeds_differ() {
    let spec = OpticsSpec::new(&Model::GelSight.parameters());
    let picture = |unit, seed| {
        let mut camera = Camera::new(&spec, [60, 80], unit, seed).expect("small");
        take(&mut camera, &View::default()).0
    };
    assert_eq!(picture(1, 1), picture(1, 1));
    assert_ne!(picture(0, 1), picture(1, 1));
    assert_ne!(picture(1, 1), picture(1, 2));
}

#[test]
fn sizes_beyond_the_sensor_are_refused() {
    let spec = OpticsSpec::new(&Model::MagicTac.parameters());
    for size in [[0, 64], [64, 0], [481, 640], [480, 641]] {
        let error = Camera::new(&spec, size, 0, 0).expect_err("no such frame");
        assert!(matches!(error, OpticsError::Size { .. }), "{error}");
    }
    assert_eq!(
        Camera::new(&spec, [0, 7], 0, 0)
            .expect_err("no columns")
            .to_string(),
        "a frame of 0×7: expected 1×1 up to the sensor's 480×640"
    );
}

#[test]
fn opaque_gels_refuse_light_from_outside_and_leave_the_buffer_as_it_was() {
    for model in [Model::GelSight, Model::GelSightWm] {
        let mut camera = camera(&OpticsSpec::new(&model.parameters()), [30, 40]);
        assert!(!camera.is_transparent());
        let info = camera.frame_info();
        let mut bytes = vec![7; info.byte_len().expect("small")];
        for light in AmbientLight::ALL.into_iter().skip(1) {
            let into = FrameMut::new(info, &mut bytes).expect("its own frame");
            let view = View {
                light,
                ..View::default()
            };
            let error = camera.render(&view, into).expect_err("opaque");
            assert_eq!(error, OpticsError::Opaque { scene: light });
        }
        assert!(bytes.iter().all(|byte| *byte == 7));
    }
}

#[test]
fn a_buffer_for_another_frame_is_refused() {
    let mut camera = camera(&OpticsSpec::new(&Model::GelSight.parameters()), [30, 40]);
    let mut other = camera.frame_info();
    other.format = PixelFormat::Gray16;
    let mut bytes = vec![0; other.byte_len().expect("small")];
    let into = FrameMut::new(other, &mut bytes).expect("its own frame");
    let error = camera
        .render(&View::default(), into)
        .expect_err("another frame");
    assert_eq!(
        error.to_string(),
        "the buffer is for 30×40 gray16, but this camera gives 30×40 rgb16"
    );
}
