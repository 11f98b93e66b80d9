//! Tests of every check: a recording that triggers the check, and a recording that must not.

mod angles;
mod certificates;
mod doubles;
mod forces;
mod joins;
mod lab;
mod lag;
mod local_times;
mod neighbours;
mod remedies;
mod rest;
mod single_files;
mod stamps;
mod streams;
mod tasks;
#[path = "../../../../studies/evaluate/tests/evaluations/taxel_drawing.rs"]
mod taxel_drawing;
mod taxels;
mod touch_clips;
mod views;
mod zeros;

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_check::{CheckReport, CheckRequest, Severity, check};
use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample, SilentProgress,
    Stamp, Unit,
};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

/// Recording without defects, sample by sample, to which tests add defects.
struct Recording {
    facts: SensorFacts,
    clock: Clock,
    channels: Vec<Channel>,
    reference: Option<Frame>,
    samples: Vec<Sample>,
}

const SAMPLES: u32 = 200;

impl Recording {
    fn sound() -> Recording {
        let samples = (0..SAMPLES).map(|number| {
            let force = 0.1 + f64::from(number % 4) * 0.4;
            Sample::new(format!("s{number:02}"))
                .with_point_id(format!("p{}", number / 4))
                .with_stamp(Stamp {
                    valid_s: 0.031 * f64::from(number),
                    received_s: None,
                })
                .with_frame(picture(number, force))
                .with_truth(Readings::from_values([
                    0.05 * f64::from(number),
                    0.05 * f64::from(number % 7) + 0.01,
                    force,
                ]))
        });
        Recording {
            facts: SensorFacts::new("drawn")
                .with_serial("1")
                .with_gel("2")
                .with_opaque(true),
            clock: Clock::Monotonic,
            channels: vec![Channel::PX, Channel::FX, Channel::FZ],
            reference: Some(picture(0, 0.0)),
            samples: samples.collect(),
        }
    }

    fn check(self, request: &str) -> CheckReport {
        self.check_beside(request, None)
    }

    /// Report on the recording, with the session table `sessions` beside it.
    fn check_beside(self, request: &str, sessions: Option<&str>) -> CheckReport {
        let folder = tempfile::tempdir().expect("a folder");
        let dataset = self.write(&folder.path().join("data"));
        if let Some(sessions) = sessions {
            let table = folder.path().join("data.sessions.csv");
            std::fs::write(table, sessions).expect("written");
        }
        let request = CheckRequest {
            only: Vec::new(),
            split: (!request.is_empty()).then(|| request.to_owned()),
            seed: 0,
            jobs: NonZeroUsize::MIN,
        };
        check(&dataset, &request, &SilentProgress).expect("checked")
    }

    fn write(self, path: &Path) -> Dataset {
        let facts = RecordingFacts::new(Source::Synthetic, self.clock, self.facts);
        let channels = Channels::new(self.channels).expect("distinct");
        let spec = RecordingSpec::new(facts, channels);
        let mut recorder = Recorder::create(path, &spec).expect("new");
        if let Some(reference) = &self.reference {
            recorder.append_reference(reference).expect("recorded");
        }
        self.samples.iter().for_each(|sample| {
            recorder.append(sample).expect("recorded");
        });
        recorder.close().expect("closed");
        Dataset::open(path).expect("a dataset")
    }
}

/// Picture that is darker under a greater force, with red as the brightest colour.
fn picture(number: u32, force: f64) -> Frame {
    let info = FrameInfo {
        width: 8,
        height: 8,
        format: PixelFormat::Rgb8,
    };
    let byte = |value: f64| {
        (0..=255_u8)
            .find(|byte| f64::from(*byte) >= value)
            .unwrap_or(255)
    };
    let bytes = (0..64_u32).flat_map(|pixel| {
        let light =
            90.0 + f64::from(
                (pixel * 64 + number)
                    .wrapping_mul(2_654_435_761)
                    .rotate_left(13)
                    % 11,
            ) - 40.0 * force;
        [byte(light + 60.0), byte(light + 20.0), byte(light)]
    });
    Frame::new(info, bytes.collect()).expect("whole")
}

fn codes(report: &CheckReport) -> Vec<(&'static str, Severity)> {
    report
        .findings
        .iter()
        .map(|finding| (finding.code, finding.severity))
        .collect()
}

#[track_caller]
fn found(recording: Recording, code: &str, severity: Severity) {
    let codes = codes(&recording.check(""));
    assert!(codes.contains(&(code, severity)), "{code} not in {codes:?}");
}

fn readings(sample: &mut Sample, change: impl Fn(usize, f64) -> Option<f64>) {
    let values = sample.truth.as_slice().iter().enumerate();
    sample.truth = Readings::new(
        values
            .map(|(channel, value)| change(channel, value.expect("set")))
            .collect(),
    );
}

#[test]
fn a_sound_recording_has_only_its_rate_to_note() {
    let report = Recording::sound().check("");
    assert_eq!(
        codes(&report),
        [("TAC008", Severity::Note)],
        "{:#?}",
        report.findings
    );
    assert_eq!((report.samples, report.frames_decoded), (200, 200));
    assert!(
        report.findings[0].message.starts_with("32.2581 Hz"),
        "{}",
        report.findings[0].message
    );
}

#[test]
fn forces_in_millinewton_are_suspected() {
    let mut recording = Recording::sound();
    recording
        .samples
        .iter_mut()
        .for_each(|sample| readings(sample, |_, value| Some(value * 1000.0)));
    found(recording, "TAC001", Severity::Warning);
}

#[test]
fn repeated_frames_are_counted() {
    let mut recording = Recording::sound();
    recording.samples[9].frame = recording.samples[8].frame.clone();
    found(recording, "TAC002", Severity::Warning);
}

#[test]
fn swapped_colours_are_noticed_with_and_without_a_reference() {
    for with_reference in [true, false] {
        let mut recording = Recording::sound();
        if !with_reference {
            recording.reference = None;
        }
        for sample in recording.samples.iter_mut().take(5) {
            let frame = sample.frame.take().expect("set");
            let swapped = frame
                .bytes()
                .chunks(3)
                .flat_map(|pixel| [pixel[2], pixel[1], pixel[0]])
                .collect();
            sample.frame = Some(Frame::new(frame.info(), swapped).expect("whole"));
        }
        found(recording, "TAC003", Severity::Warning);
    }
}

#[test]
fn full_pixels_are_noticed_and_binarised_pictures_are_distinguished() {
    let brighter = |byte: u8| byte.saturating_mul(2);
    let black_and_white = |byte: u8| if byte > 100 { 255 } else { 0 };
    let levels: [(&dyn Fn(u8) -> u8, Severity); 2] = [
        (&brighter, Severity::Warning),
        (&black_and_white, Severity::Note),
    ];
    for (level, severity) in levels {
        let mut recording = Recording::sound();
        for sample in &mut recording.samples {
            let frame = sample.frame.take().expect("set");
            let bytes = frame.bytes().iter().map(|byte| level(*byte)).collect();
            sample.frame = Some(Frame::new(frame.info(), bytes).expect("whole"));
        }
        found(recording, "TAC004", severity);
    }
}

#[test]
fn forces_that_are_exactly_zero_are_placeholders() {
    let mut recording = Recording::sound();
    readings(&mut recording.samples[3], |channel, value| {
        Some(if channel == 0 { value } else { 0.0 })
    });
    found(recording, "TAC005", Severity::Warning);
}

#[test]
fn a_reference_taken_while_pressed_is_noticed() {
    let mut recording = Recording::sound();
    recording.reference = Some(picture(0, 1.5));
    found(recording, "TAC006", Severity::Warning);
}

#[test]
fn points_on_both_sides_of_a_split_leak_and_copies_are_an_error() {
    let report = Recording::sound().check("random");
    assert!(
        codes(&report).contains(&("TAC007", Severity::Warning)),
        "{:?}",
        codes(&report)
    );
    assert!(
        !codes(&Recording::sound().check("by-point"))
            .iter()
            .any(|(code, _)| *code == "TAC007")
    );

    let mut recording = Recording::sound();
    let frame = recording.samples[0].frame.clone();
    recording
        .samples
        .iter_mut()
        .for_each(|sample| sample.frame = frame.clone());
    assert_eq!(recording.check("by-point").worst(), Some(Severity::Error));
}

#[test]
fn a_channel_that_never_changes_is_noticed() {
    let mut recording = Recording::sound();
    recording.samples.iter_mut().for_each(|sample| {
        readings(sample, |channel, value| {
            Some(if channel == 0 { 2.5 } else { value })
        })
    });
    found(recording, "TAC009", Severity::Warning);
}

#[test]
fn too_few_points_are_noticed() {
    let mut recording = Recording::sound();
    for (number, sample) in recording.samples.iter_mut().enumerate() {
        sample.point_id = Some(format!("p{}", number / 50));
    }
    found(recording, "TAC010", Severity::Warning);
}

#[test]
fn ten_points_that_evaluate_scores_in_folds_are_not_few() {
    let mut recording = Recording::sound();
    for (number, sample) in recording.samples.iter_mut().enumerate() {
        sample.point_id = Some(format!("p{}", number / 20));
    }
    let few = |report: &CheckReport| codes(report).iter().any(|(code, _)| *code == "TAC010");
    assert!(!few(&recording.check("")));
    let mut unnamed = Recording::sound();
    for sample in &mut unnamed.samples {
        sample.point_id = None;
    }
    // Blocks of time are tested in folds, too.
    assert!(!few(&unnamed.check("")));
}

#[test]
fn samples_without_a_label_or_a_frame_are_counted() {
    let mut recording = Recording::sound();
    readings(&mut recording.samples[3], |channel, value| {
        (channel != 1).then_some(value)
    });
    recording.samples[4].frame = None;
    let report = recording.check("");
    let messages: Vec<&str> = report
        .findings
        .iter()
        .filter(|finding| finding.code == "TAC011")
        .map(|finding| finding.message.as_str())
        .collect();
    assert_eq!(
        messages,
        [
            "1 of 200 samples have no Fx",
            "1 of 200 samples have no frame"
        ]
    );
}

#[test]
fn facts_that_nobody_wrote_down_are_listed() {
    let mut recording = Recording::sound();
    recording.facts.gel = "unknown".into();
    recording.clock = Clock::Unknown;
    recording.reference = None;
    let report = recording.check("");
    let finding = report
        .findings
        .iter()
        .find(|finding| finding.code == "TAC012")
        .expect("found");
    assert_eq!(finding.message, "unknown: gel, clock, reference frame");
}

#[test]
fn checks_that_need_frames_are_skipped_by_name_where_there_are_none() {
    let mut recording = Recording::sound();
    recording.reference = None;
    recording
        .samples
        .iter_mut()
        .for_each(|sample| sample.frame = None);
    recording.channels[0] = Channel::named("grid_x", Unit::One).expect("a plain name");
    // Canonical order puts the extra channel last.
    recording.samples.iter_mut().for_each(|sample| {
        let values: Vec<Option<f64>> = sample.truth.as_slice().to_vec();
        sample.truth = Readings::new(vec![values[1], values[2], values[0]]);
    });
    let report = recording.check("");
    let skipped: Vec<&str> = report
        .skipped
        .iter()
        .map(|skipped| skipped.what.as_str())
        .collect();
    assert_eq!(
        skipped,
        [
            "check:TAC003",
            "check:TAC004",
            "check:TAC006",
            "check:TAC020",
            "check:TAC019",
            "check:TAC027",
            "check:TAC034",
            "check:TAC035"
        ]
    );
    assert_eq!(report.frames_decoded, 0);
}
