//! Tests of untouched pictures that differ from the reference.

use taceva_check::CheckReport;
use taceva_core::{Frame, FrameInfo, PixelFormat, PressOutcome, Readings};
use taceva_core::{SilentProgress, Stamp};

use super::streams::{message, says_nothing};
use super::{Recording, readings};

const SIDE: u32 = 32;

/// Picture of a press with `force`. `fault` changes the light at each pixel.
fn picture(number: u32, force: f64, fault: &dyn Fn(u32, u32, f64) -> f64) -> Frame {
    let info = FrameInfo {
        width: SIDE,
        height: SIDE,
        format: PixelFormat::Gray8,
    };
    let bytes = (0..SIDE * SIDE).map(|pixel| {
        let (x, y) = (pixel % SIDE, pixel / SIDE);
        let away = f64::from(x.abs_diff(16)).hypot(f64::from(y.abs_diff(16)));
        let noise = (pixel * 64 + number)
            .wrapping_mul(2_654_435_761)
            .rotate_left(13)
            % 11;
        let light = 130.0 - 45.0 * force * (-away * away / 60.0).exp();
        let light = fault(x, y, light) + f64::from(noise);
        (0..=255_u8)
            .find(|byte| f64::from(*byte) >= light)
            .unwrap_or(255)
    });
    Frame::new(info, bytes.collect()).expect("whole")
}

/// Report on presses, every fourth without contact. The reference was taken before `fault`.
fn after(fault: &dyn Fn(u32, u32, f64) -> f64) -> CheckReport {
    let mut recording = Recording::sound();
    recording.reference = Some(picture(0, 0.0, &|_, _, light| light));
    for (number, sample) in (0..).zip(&mut recording.samples) {
        let force = f64::from(number % 4) * 0.5;
        sample.frame = Some(picture(number, force, fault));
        readings(sample, |channel, value| match channel {
            2 => Some(force),
            _ => Some(value),
        });
    }
    recording.check("")
}

#[test]
fn a_picture_that_was_dimmed_shifted_or_torn_after_the_reference_is_noticed() {
    let lost_lamp = |x: u32, _: u32, light: f64| light * (1.0 - 0.15 * f64::from(x) / 32.0);
    let brighter = |_: u32, _: u32, light: f64| light * 1.15;
    let torn = |x: u32, y: u32, light: f64| if x < 5 && y < 5 { 0.2 * light } else { light };
    let faults: [&dyn Fn(u32, u32, f64) -> f64; 3] = [&lost_lamp, &brighter, &torn];
    for fault in faults {
        let said = after(fault);
        let said = message(&said, "TAC034");
        assert!(
            said.starts_with("50 pictures without contact differ from the reference"),
            "{said}"
        );
    }
    let report = after(&torn);
    assert!(message(&report, "TAC034").contains("in one place"));
    let hint = report
        .findings
        .iter()
        .find(|finding| finding.code == "TAC034");
    assert!(
        hint.expect("found")
            .hint
            .contains("new untouched reference picture")
    );
}

#[test]
fn good_recordings_are_flagged_less_than_once_in_a_hundred() {
    let flagged = (0..100).filter(|seed| {
        // Exposure wanders by a few per mille, as cameras do.
        let wander = 1.0 + 0.002 * f64::from(seed % 7 - 3);
        let report = after(&|_, _, light| light * wander);
        report
            .findings
            .iter()
            .any(|finding| finding.code == "TAC034")
    });
    assert_eq!(flagged.count(), 0);
    says_nothing(&after(&|_, _, light| light), "TAC034");
}

#[test]
fn contacts_whose_force_is_too_small_to_measure_are_no_untouched_pictures() {
    let report = |has_depth: bool| {
        let mut recording = Recording::sound();
        recording.reference = Some(picture(0, 0.0, &|_, _, light| light));
        if has_depth {
            recording.channels[0] = taceva_core::Channel::PZ;
        }
        for (number, sample) in (0_u32..).zip(&mut recording.samples) {
            // Depth, force, and what the picture shows of it. The last fifty are beside the middle of the transducer, but for each fourth.
            let [depth, force, shown] = match (number < 150, number % 4) {
                (true, 0) => [0.0, 0.0, 0.0],
                (true, 1) => [0.4, 1.0, 1.0],
                (false, 0..=2) => [0.2, 0.005, 1.2],
                _ => [0.6, 1.5, 1.5],
            };
            sample.frame = Some(picture(number, shown, &|_, _, light| light));
            readings(sample, |channel, value| match channel {
                0 => Some(depth),
                2 => Some(force),
                _ => Some(value),
            });
        }
        recording.check("")
    };
    says_nothing(&report(true), "TAC034");
    // Without a label of depth nobody knows.
    message(&report(false), "TAC034");
}

#[test]
fn pictures_above_the_gel_and_those_of_unknown_depths_are_untouched() {
    let dimmed = |depth: fn(u32) -> Option<f64>| {
        let mut recording = Recording::sound();
        recording.channels[0] = taceva_core::Channel::PZ;
        recording.reference = Some(picture(0, 0.0, &|_, _, light| light));
        for (number, sample) in (0_u32..).zip(&mut recording.samples) {
            let force = f64::from(number % 4) * 0.5;
            let frame = picture(number, force, &|_, _, light| 0.85 * light);
            sample.frame = Some(frame);
            readings(sample, |channel, value| match channel {
                0 if number.is_multiple_of(4) => depth(number),
                0 => Some(0.5 * force),
                2 => Some(force),
                _ => Some(value),
            });
        }
        let report = recording.check("");
        message(&report, "TAC034").to_owned()
    };
    // Up to 9 mm above the gel; no depth; positions along an axis, which are never 0.
    let depths: [fn(u32) -> Option<f64>; 3] = [
        |number| Some(-0.25 * f64::from(number % 40)),
        |_| None,
        |number| Some(20.0 - 0.25 * f64::from(number % 40)),
    ];
    for depth in depths {
        let said = dimmed(depth);
        assert!(said.starts_with("50 pictures without contact"), "{said}");
    }
}

#[test]
fn light_that_wanders_from_picture_to_picture_is_no_change_and_a_greater_one_is() {
    let wandering = |change: f64| {
        let mut recording = Recording::sound();
        recording.reference = Some(picture(0, 0.0, &|_, _, light| light * 1.01));
        for (number, sample) in (0_u32..).zip(&mut recording.samples) {
            let force = f64::from(number % 4) * 0.5;
            let drawn = number.wrapping_mul(2_654_435_761) >> 16;
            let gain = change * (0.99 + 0.02 * f64::from(drawn) / 65_536.0);
            sample.frame = Some(picture(number, 0.2 * force, &|_, _, light| light * gain));
            readings(sample, |channel, value| match channel {
                2 => Some(force),
                _ => Some(value),
            });
        }
        recording.check("")
    };
    says_nothing(&wandering(1.0), "TAC034");
    let said = wandering(1.06);
    let said = message(&said, "TAC034");
    assert!(said.contains("differ from the reference by"), "{said}");
}

#[test]
fn presses_of_a_board_that_follow_one_another_are_no_contact_and_have_no_rate() {
    use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, Source};
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("data");
    let sound = Recording::sound();
    let facts = RecordingFacts::new(Source::Synthetic, sound.clock, sound.facts);
    let channels = taceva_core::Channels::new(sound.channels).expect("distinct");
    let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, channels)).expect("new");
    recorder
        .append_reference(sound.reference.as_ref().expect("set"))
        .expect("recorded");
    for (number, mut sample) in (0_u32..).zip(sound.samples) {
        // Boards of twenty presses, 0.83 s apart, and a minute to change them.
        let pause = f64::from(number / 20) * 155.0 + if number % 20 > 9 { 95.0 } else { 0.0 };
        sample.stamp = Some(Stamp {
            valid_s: 0.83 * f64::from(number) + pause,
            received_s: None,
        });
        sample.point_id = Some(format!("board {}", number / 20));
        sample.truth = Readings::new(sample.truth.as_slice().to_vec());
        recorder
            .append_press(
                &format!("press {number}"),
                PressOutcome::Complete,
                std::slice::from_ref(&sample),
            )
            .expect("recorded");
    }
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let request = taceva_check::CheckRequest {
        only: vec![
            "TAC008".to_owned(),
            "TAC023".to_owned(),
            "TAC024".to_owned(),
        ],
        split: None,
        seed: 0,
        jobs: std::num::NonZeroUsize::MIN,
    };
    let report = taceva_check::check(&dataset, &request, &SilentProgress).expect("checked");
    assert_eq!(report.findings, []);
}
