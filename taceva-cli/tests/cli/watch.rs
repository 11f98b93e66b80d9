//! A sensor in use: changes of its untouched pictures, in recordings and live.

use std::fs;

use taceva_core::random::Draws;
use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

use crate::support::Bench;

const SIDE: u32 = 16;

/// Picture at the light level `light` and the force `force`, with the noise of the seed `number`.
fn picture(light: f64, force: f64, number: u64) -> Frame {
    let draws = Draws::new(number);
    let info = FrameInfo {
        width: SIDE,
        height: SIDE,
        format: PixelFormat::Gray8,
    };
    let number_at = |place: u32| {
        let (x, y) = (f64::from(place % SIDE) - 8.0, f64::from(place / SIDE) - 8.0);
        let blob = 60.0 * force * (-(x * x + y * y) / 20.0).exp();
        let value = light + blob + 2.0 * draws.normal(u64::from(place));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to a byte"
        )]
        let byte = value.round().clamp(0.0, 255.0) as u8;
        byte
    };
    Frame::new(info, (0..SIDE * SIDE).map(number_at).collect()).expect("whole")
}

/// Records 40 presses and `rests` untouched pictures.
fn record(bench: &Bench, name: &str, light: f64, rests: u64, first: u64) {
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::FZ]).expect("one");
    let spec = RecordingSpec::new(facts, channels);
    let mut recorder = Recorder::create(&bench.path(name), &spec).expect("begun");
    let reference = picture(100.0, 0.0, 77_777);
    recorder.append_reference(&reference).expect("recorded");
    for number in 0..40_u32 {
        let force = 0.5 + 0.1 * f64::from(number % 8);
        let sample = Sample::new(format!("press-{number}"))
            .with_point_id(format!("p{}", number / 4))
            .with_frame(picture(light, force, first + 90_000 + u64::from(number)))
            .with_truth(Readings::from_values([force]));
        recorder.append(&sample).expect("recorded");
    }
    for number in 0..rests {
        let sample = Sample::new(format!("rest-{number}"))
            .with_point_id("rest".to_owned())
            .with_frame(picture(light, 0.0, first + number))
            .with_truth(Readings::from_values([0.0]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
}

/// Test folder with a calibration recording of 260 untouched pictures, and a model fitted on it.
fn bench() -> Bench {
    let bench = Bench::new();
    record(&bench, "monday", 100.0, 260, 0);
    bench.ok("fit monday --model ridge --set size=8x8 --out m.taceva -q");
    bench
}

#[test]
fn a_recording_with_less_light_has_one_line_with_its_remedy_and_exit_code_1() {
    let bench = bench();
    record(&bench, "same", 100.0, 60, 1000);
    record(&bench, "darker", 92.0, 60, 2000);
    let watched = |name: &str| {
        bench.run(&format!(
            "watch m.taceva --recording {name} --calibration monday"
        ))
    };
    let same = watched("same");
    assert_eq!((same.code, same.out.as_str()), (0, ""), "{}", same.err);
    assert!(
        same.err
            .contains("60 untouched pictures and 40 of contact: no change"),
        "{}",
        same.err
    );
    assert!(
        same.err.contains("smallest changes that are found"),
        "{}",
        same.err
    );
    let darker = watched("darker");
    assert_eq!(darker.code, 1, "{}", darker.err);
    let lines: Vec<&str> = darker.out.lines().collect();
    let brightness = lines
        .iter()
        .find(|line| line.contains("brighter or darker"));
    let brightness = brightness.unwrap_or_else(|| panic!("{}", darker.out));
    assert!(brightness.starts_with("rest-"), "{brightness}");
    assert!(
        brightness.contains("record a new untouched picture"),
        "{brightness}"
    );
}

#[test]
fn after_a_new_untouched_picture_the_limits_are_those_of_the_present_light() {
    let bench = bench();
    record(&bench, "darker", 92.0, 300, 6000);
    let words = "watch m.taceva --recording darker --calibration monday";
    let stale = bench.run(words);
    assert!(stale.out.contains("brighter or darker"), "{}", stale.out);
    let fresh = bench.run(&format!("{words} --fresh"));
    assert!(!fresh.out.contains("untouched"), "{}", fresh.out);
    assert!(
        fresh.err.contains("smallest changes that are found"),
        "{}",
        fresh.err
    );
}

#[test]
fn a_sensor_is_watched_without_a_force_until_its_last_picture() {
    let bench = bench();
    for (folder, light, code) in [("same", 100.0, 0), ("darker", 92.0, 1)] {
        fs::create_dir_all(bench.path(folder)).expect("created");
        for number in 0..40 {
            let frame = picture(light, 0.0, 3000 + number);
            let path = bench.path(&format!("{folder}/{number:03}.png"));
            let gray = image::ExtendedColorType::L8;
            image::save_buffer(path, frame.bytes(), SIDE, SIDE, gray).expect("written");
        }
        let words =
            format!("watch m.taceva --sensor sensor/replay:folder={folder} --calibration monday");
        let ran = bench.run(&words);
        assert_eq!(ran.code, code, "{}{}", ran.out, ran.err);
        assert!(
            ran.err.contains("every picture counts as untouched"),
            "{}",
            ran.err
        );
        assert_eq!(
            ran.out.contains("brighter or darker"),
            code == 1,
            "{}",
            ran.out
        );
        let few = bench.run(&format!("{words} --frames 2"));
        assert!(
            few.err
                .contains("2 untouched pictures and 0 of contact: not enough untouched pictures to decide, expected at least 30"),
            "{}",
            few.err
        );
    }
}

#[test]
fn a_calibration_with_few_untouched_pictures_says_what_it_finds_and_never_that_nothing_changed() {
    let bench = bench();
    record(&bench, "same", 100.0, 300, 1000);
    record(&bench, "darker", 92.0, 300, 2000);
    record(&bench, "some", 100.0, 120, 5000);
    record(&bench, "few", 100.0, 20, 8000);
    let watched = |name: &str, calibration: &str| {
        bench.run(&format!(
            "watch m.taceva --recording {name} --calibration {calibration}"
        ))
    };
    // 100 of 120 pictures set the limits: the change is found against the calibration, not learnt.
    let darker = watched("darker", "some");
    assert_eq!(darker.code, 1, "{}", darker.err);
    assert!(darker.out.contains("brighter or darker"), "{}", darker.out);
    let words = "some: 120 untouched pictures in the calibration, expected 250; smallest changes found, relative to the change by contact: brightness 0.";
    assert!(darker.err.contains(words), "{}", darker.err);
    let same = watched("same", "some");
    assert_eq!((same.code, same.out.as_str()), (0, ""), "{}", same.err);
    for words in ["of contact: no change", "smallest changes that are found"] {
        assert!(same.err.contains(words), "{words}: {}", same.err);
    }
    let same = watched("same", "few");
    assert_eq!((same.code, same.out.as_str()), (1, ""), "{}", same.err);
    for words in [
        "few: 20 untouched pictures in the calibration, expected 250",
        "the first 250 watched pictures set the limits for later changes",
        "not enough untouched pictures to decide if anything changed since the calibration. The calibration has 20, expected at least 100",
    ] {
        assert!(same.err.contains(words), "{words}: {}", same.err);
    }
    // The first pictures of the darker recording set the limits, so its light is hidden.
    let darker = watched("darker", "few");
    assert!(!darker.out.contains("brighter or darker"), "{}", darker.out);
    for ran in [&same, &darker] {
        assert_eq!(ran.code, 1, "{}", ran.err);
        assert!(!ran.err.contains("no change"), "{}", ran.err);
    }
}

#[test]
fn what_cannot_be_watched_is_refused_with_what_to_do() {
    let bench = bench();
    record(&bench, "short", 100.0, 20, 4000);
    bench.refused(
        "watch m.taceva --recording short",
        2,
        "20 untouched pictures with a label, expected at least 280",
    );
    for words in [
        "watch m.taceva",
        "watch m.taceva --sensor sim/gelsight",
        "watch m.taceva --recording short --sensor sim/gelsight",
        "watch m.taceva --recording short --frames 5",
    ] {
        assert_eq!(bench.run(words).code, 2, "{words}");
    }
    let other = bench.run("watch m.taceva --sensor sim/gelsight --calibration monday --frames 5");
    assert_eq!(other.code, 2, "{}", other.err);
    assert!(other.err.contains("calibrate again"), "{}", other.err);
}
