//! Tests that a picture with a fault depends only on picture, parameter, seed and sample.

use taceva_core::{Frame, FrameInfo, PixelFormat};
use taceva_dataset::Digest;
use taceva_stress::{FAULTS, Fault, Scope, Stress};

use crate::drawing::{picture, press};

/// Fault with the name `id`.
fn fault(id: &str) -> &'static Fault {
    let mut faults = FAULTS.into_iter();
    faults.find(|fault| fault.id == id).expect("in the list")
}

/// Picture of one row of gray pixels.
fn gray(bytes: Vec<u8>) -> Frame {
    let width = u32::try_from(bytes.len()).expect("short");
    let info = FrameInfo {
        width,
        height: 1,
        format: PixelFormat::Gray8,
    };
    Frame::new(info, bytes).expect("whole")
}

#[test]
fn a_fault_of_parameter_zero_changes_no_byte() {
    let (frame, before) = (press(1.0, 9.0, 3), press(0.5, 4.0, 2));
    for fault in FAULTS {
        let same = Stress::new(fault, 0.0, 7).apply(&frame, "a", Some(&before));
        assert_eq!(same, frame, "{}", fault.id);
    }
}

#[test]
fn every_fault_of_the_strongest_kind_changes_a_picture() {
    let (frame, before) = (press(1.0, 9.0, 3), press(0.5, 4.0, 2));
    for fault in FAULTS {
        let changed = Stress::new(fault, fault.most, 7).apply(&frame, "a", Some(&before));
        assert_eq!(changed.info(), frame.info(), "{}", fault.id);
        assert_ne!(changed, frame, "{}", fault.id);
    }
}

#[test]
fn pictures_of_a_pixel_of_one_colour_and_black_go_through_every_fault() {
    let formats = [
        PixelFormat::Gray8,
        PixelFormat::Gray16,
        PixelFormat::Rgb8,
        PixelFormat::Rgb16,
    ];
    for format in formats {
        for size in [[1, 1], [1, 9], [9, 1], [6, 4]] {
            for light in [0.0, 0.4, 1.0] {
                let frame = picture(size, format, |_, _| light);
                for fault in FAULTS {
                    for parameter in fault.table.into_iter().chain([fault.most]) {
                        let stress = Stress::new(fault, parameter, 1);
                        let changed = stress.apply(&frame, "a", Some(&frame));
                        assert_eq!(changed.info(), frame.info(), "{}", fault.id);
                    }
                }
            }
        }
    }
}

#[test]
fn digests_of_pictures_depend_on_no_order_and_repeat() {
    let frames: Vec<Frame> = (0..6).map(|number| press(0.8, 9.0, number)).collect();
    let digests = |order: &[usize]| {
        let mut found = vec![Vec::new(); frames.len()];
        for &at in order {
            let before = at.checked_sub(1).map(|before| &frames[before]);
            for fault in FAULTS {
                let stress = Stress::new(fault, fault.table[2], 11);
                let changed = stress.apply(&frames[at], &format!("s{at}"), before);
                found[at].push(Digest::of(changed.bytes()).to_string());
            }
        }
        found
    };
    assert_eq!(digests(&[0, 1, 2, 3, 4, 5]), digests(&[5, 2, 0, 4, 3, 1]));
}

#[test]
fn fixed_faults_are_equal_in_all_pictures_and_others_differ() {
    let frame = press(1.0, 9.0, 3);
    for fault in FAULTS {
        let stress = Stress::new(fault, fault.table[4], 5);
        if stress.repeats() {
            continue;
        }
        let [one, other] = ["a", "b"].map(|sample| stress.apply(&frame, sample, None));
        let is_equal = one == other;
        assert_eq!(is_equal, fault.scope != Scope::Each, "{}", fault.id);
    }
}

#[test]
fn another_seed_draws_other_faults() {
    let frame = press(1.0, 9.0, 3);
    for id in ["dead_pixels", "scratches", "tear", "dust", "sensor_noise"] {
        let fault = fault(id);
        let [one, other] =
            [1, 2].map(|seed| Stress::new(fault, fault.table[4], seed).apply(&frame, "a", None));
        assert_ne!(one, other, "{id}");
    }
}

#[test]
fn faults_without_random_numbers_are_equal_for_every_seed() {
    let frame = press(1.0, 9.0, 3);
    for fault in FAULTS {
        let with = |seed| Stress::new(fault, fault.table[4], seed);
        if with(1).repeats() {
            continue;
        }
        let [one, other] = [1, 2].map(|seed| with(seed).apply(&frame, "a", None));
        assert_eq!(one == other, fault.scope == Scope::Fixed, "{}", fault.id);
    }
}

#[test]
fn sixteen_bits_scale_with_the_camera() {
    let eight = picture([6, 4], PixelFormat::Gray8, |x, _| f64::from(x) / 10.0);
    let wide = picture([6, 4], PixelFormat::Gray16, |x, _| f64::from(x) / 10.0);
    for id in ["exposure_low", "defocus", "led_loss", "tear"] {
        let stress = Stress::new(fault(id), 0.3, 1);
        let pairs = [&eight, &wide].map(|frame| stress.apply(frame, "a", None));
        let numbers = pairs[0].samples().zip(pairs[1].samples());
        for (low, high) in numbers {
            let off = f64::from(high) / 257.0 - f64::from(low);
            assert!(off.abs() < 1.5, "{id}: {low} {high}");
        }
    }
}

#[test]
fn light_is_rounded_half_to_even_and_clamped_to_full_scale() {
    let frame = gray(vec![1, 2, 3, 4, 5]);
    let half = Stress::new(fault("exposure_low"), 0.5, 1).apply(&frame, "a", None);
    assert_eq!(half.bytes(), [0, 1, 2, 2, 2]);
    let bright = gray(vec![100, 200]);
    let clipped = Stress::new(fault("exposure_high"), 1.0, 1).apply(&bright, "a", None);
    assert_eq!(clipped.bytes(), [200, 255]);
}

#[test]
fn a_stale_picture_is_the_one_before() {
    let (frame, before) = (press(1.0, 9.0, 3), press(0.5, 4.0, 2));
    let stress = Stress::new(fault("stale_frames"), 0.5, 1);
    let names = (0..200).map(|number| format!("s{number}"));
    let found: Vec<Frame> = names
        .map(|name| stress.apply(&frame, &name, Some(&before)))
        .collect();
    let stale = found.iter().filter(|found| **found == before).count();
    assert!(
        found
            .iter()
            .all(|found| *found == before || *found == frame)
    );
    // Expected: 100, standard deviation 7; the limits are five deviations.
    assert!((65..=135).contains(&stale), "{stale}");
    assert_eq!(stress.apply(&frame, "s1", None), frame);
}

#[test]
fn a_picture_of_twice_the_size_has_the_same_fault_in_shares_of_its_width() {
    let sized = |width: u32| {
        let share = |place: u32| (f64::from(place) + 0.5) / f64::from(width);
        picture([width, width / 3 * 2], PixelFormat::Gray8, |x, y| {
            0.5 + 0.3 * (25.0 * share(x)).sin() * (20.0 * share(y)).cos()
        })
    };
    let frames = [96, 192].map(sized);
    for id in ["defocus", "camera_shift", "led_loss", "tear"] {
        let fault = fault(id);
        let stress = Stress::new(fault, fault.table[4], 5);
        let changes = frames.each_ref().map(|frame| -> Vec<f64> {
            let changed = stress.apply(frame, "a", None);
            let pairs = changed.samples().zip(frame.samples());
            pairs
                .map(|(after, before)| f64::from(after) - f64::from(before))
                .collect()
        });
        let [small, large] = changes;
        let reduced = |at: usize| {
            let first = 2 * (at / 96) * 192 + 2 * (at % 96);
            let four = [first, first + 1, first + 192, first + 193];
            four.map(|place| large[place]).iter().sum::<f64>() / 4.0
        };
        let places = small.iter().enumerate();
        let off: f64 = places.map(|(at, own)| (own - reduced(at)).abs()).sum();
        let all: f64 = small.iter().map(|own| own.abs()).sum();
        assert!(off < 0.2 * all, "{id}: {off} of {all}");
    }
}
