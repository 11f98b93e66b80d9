//! Tests of a loss of LEDs whose sides are known.

use std::path::Path;

use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
use taceva_dataset::{
    Dataset, Leds, PictureSide, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
};
use taceva_stress::{FAULTS, Stress, StressReport, StressRequest, stress};

use crate::drawing::{HEIGHT, PRESSES, WIDTH, WORK, fitted, picture};

/// Fault that removes half of the light at the edge of the lost LEDs.
fn led_loss() -> Stress<'static> {
    let mut faults = FAULTS.into_iter();
    let fault = faults.find(|fault| fault.id == "led_loss");
    Stress::new(fault.expect("in the list"), 0.5, 1)
}

fn flat(format: PixelFormat) -> Frame {
    let info = FrameInfo {
        width: 3,
        height: 3,
        format,
    };
    Frame::new(info, vec![200; 9 * format.samples()]).expect("whole")
}

#[test]
fn the_colours_of_the_lost_side_dim_from_that_side_and_the_others_keep_their_light() {
    let frame = flat(PixelFormat::Rgb8);
    for (side, [x, y]) in [
        (PictureSide::Left, [0, 1]),
        (PictureSide::Right, [2, 1]),
        (PictureSide::Top, [1, 0]),
        (PictureSide::Bottom, [1, 2]),
    ] {
        let leds = Leds {
            green: Some(side),
            ..Leds::default()
        };
        let changed = led_loss().with_leds(leds).apply(&frame, "a", None);
        let green = |x: usize, y: usize| changed.bytes()[3 * (3 * y + x) + 1];
        let across = [green(x, y), green(1, 1), green(2 - x, 2 - y)];
        assert_eq!(across, [100, 150, 200], "{side:?}");
        for pixel in changed.bytes().chunks(3) {
            assert_eq!([pixel[0], pixel[2]], [200, 200], "{side:?}");
        }
    }
    // One side is lost: left before right, top and bottom.
    let leds = Leds {
        red: Some(PictureSide::Right),
        green: Some(PictureSide::Left),
        blue: Some(PictureSide::Left),
    };
    let changed = led_loss().with_leds(leds).apply(&frame, "a", None);
    assert_eq!(&changed.bytes()[..3], [200, 100, 100]);
}

#[test]
fn all_colours_of_unknown_leds_and_gray_pictures_dim_from_the_left() {
    let leds = Leds {
        red: Some(PictureSide::Top),
        ..Leds::default()
    };
    for (format, leds) in [
        (PixelFormat::Rgb8, Leds::default()),
        (PixelFormat::Gray8, leds),
    ] {
        let frame = flat(format);
        let changed = led_loss().with_leds(leds).apply(&frame, "a", None);
        assert_eq!(changed, led_loss().apply(&frame, "a", None));
        let first = changed.bytes().iter().take(format.samples());
        assert!(first.clone().all(|value| *value == 100), "{format:?}");
    }
}

/// Creates a recording of pictures of `format` by a sensor with `leds`. Recordings with different `noise` share no picture.
fn record(path: &Path, format: PixelFormat, leds: Leds, noise: u32) -> Dataset {
    let draw = |force: f64, number: u32| {
        picture([WIDTH, HEIGHT], format, |x, y| {
            let (across, down) = (f64::from(x) - 12.0, f64::from(y) - 8.0);
            let blob = force * (-(across * across + down * down) / 12.0).exp();
            let speck = (x * 7919 + y * 104_729 + number * 1_299_709) % 5;
            0.4 + 0.2 * blob + f64::from(speck) / 500.0
        })
    };
    let mut sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    sensor.leds = leds;
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::FZ]).expect("one");
    let mut recorder = Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new");
    let untouched = draw(0.0, 900 + noise);
    recorder.append_reference(&untouched).expect("recorded");
    for number in 0..PRESSES {
        let force = 0.4 + 0.4 * f64::from(number % 5);
        let sample = Sample::new(format!("s{number:02}"))
            .with_point_id(format!("p{}", number / 5))
            .with_frame(draw(force, number * 10 + noise))
            .with_truth(Readings::from_values([force]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

/// Stress test with lost LEDs and with a shorter exposure, in pictures of `format`.
fn tested(format: PixelFormat, leds: Leds) -> StressReport {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), format, Leds::default(), 1);
    let model = fitted(&seen, "ridge", &["size=8x8"]);
    let dataset = record(&folder.path().join("unseen"), format, leds, 2);
    let request = StressRequest {
        faults: ["exposure_low", "led_loss"].map(str::to_owned).to_vec(),
        severities: vec![3],
        ..StressRequest::default()
    };
    stress(&dataset, &model, &request, WORK).expect("tested")
}

#[test]
fn leds_of_a_recording_are_lost_by_colour_with_a_note_and_another_digest_of_the_list() {
    let known = tested(
        PixelFormat::Rgb8,
        Leds {
            green: Some(PictureSide::Right),
            ..Leds::default()
        },
    );
    let unknown = tested(PixelFormat::Rgb8, Leds::default());
    let parameter = |report: &StressReport| {
        let lost = &report.faults[1];
        assert_eq!(lost.id, "led_loss");
        lost.severities[0].parameter
    };
    // One of three colours needs three times the loss for the same change.
    let ratio = parameter(&known) / parameter(&unknown);
    assert!((2.0..4.0).contains(&ratio), "{ratio}");
    let note = known.faults[1].note.as_deref().expect("a note");
    assert!(note.contains("`leds` in [sensor]"), "{note}");
    assert!(note.contains("the right side dim"), "{note}");
    assert_eq!(unknown.faults[1].note, None);
    assert_ne!(known.list.digest, unknown.list.digest);
    let dark = |report: &StressReport| {
        let first = report.faults[0].severities.first();
        first.map(|of| (of.parameter, of.stimulus))
    };
    assert_eq!(dark(&known), dark(&unknown));
}

#[test]
fn colours_of_leds_are_skipped_by_name_in_gray_pictures() {
    let leds = Leds {
        red: Some(PictureSide::Left),
        ..Leds::default()
    };
    let report = tested(PixelFormat::Gray8, leds);
    let ids: Vec<&str> = report.faults.iter().map(|of| of.id.as_str()).collect();
    assert_eq!(ids, ["exposure_low"]);
    assert_eq!(report.skipped[0].fault, "led_loss");
    let reason = &report.skipped[0].reason;
    assert!(reason.contains("the pictures are gray"), "{reason}");
}
