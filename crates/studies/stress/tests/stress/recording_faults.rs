//! Tests of faults of camera files, markers, clocks and labels.

use std::path::Path;
use std::process::Command;

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, Isa, PixelFormat, Readings, Sample, Stamp,
};
use taceva_dataset::{
    Dataset, Digest, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
};
use taceva_models::MarkerTracker;
use taceva_stress::{
    By, FAULTS, Fault, FaultReport, RECORDING_FAULTS, Stress, StressReport, StressRequest, select,
    stress,
};

use crate::drawing::{PRESSES, WORK, fitted, picture, press, record_with, unseen};

/// Fault with the name `id`.
fn fault(id: &str) -> &'static Fault {
    let mut faults = RECORDING_FAULTS.into_iter();
    faults.find(|fault| fault.id == id).expect("in the list")
}

/// Picture of 24 bright dots on a black gel, moved to the right by `right` pixels.
fn dots(right: usize) -> Frame {
    let info = FrameInfo {
        width: 128,
        height: 96,
        format: PixelFormat::Gray8,
    };
    let is_lit =
        |at: usize, count: usize| (6..11).contains(&(at % 16)) && (1..=count).contains(&(at / 16));
    let pixel = |at: usize| match is_lit((at % 128).saturating_sub(right), 6) && is_lit(at / 128, 4)
    {
        true => 255,
        false => 0,
    };
    Frame::new(info, (0..128 * 96).map(pixel).collect()).expect("whole")
}

/// Number of bright pixels in `frame`.
fn lit(frame: &Frame) -> usize {
    frame.bytes().iter().filter(|byte| **byte > 127).count()
}

fn by_parameter(faults: &[&str]) -> StressRequest {
    StressRequest {
        faults: faults.iter().map(|name| (*name).to_owned()).collect(),
        by: By::Parameter,
        ..StressRequest::default()
    }
}

fn of<'r>(report: &'r StressReport, id: &str) -> &'r FaultReport {
    let mut faults = report.faults.iter();
    faults.find(|fault| fault.id == id).expect("tested")
}

/// Creates a recording of presses with a picture every 10 ms.
fn timed(path: &Path) -> Dataset {
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Monotonic, sensor);
    let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
    let mut recorder = Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new");
    let reference = press(0.0, 0.0, 905);
    recorder.append_reference(&reference).expect("recorded");
    for number in 0..PRESSES {
        let place = 4.0 + f64::from(number / 5 * 7 % 12) * 1.4;
        let force = 0.4 + 0.4 * f64::from(number % 5);
        let sample = Sample::new(format!("s{number:02}"))
            .with_point_id(format!("p{}", number / 5))
            .with_stamp(Stamp {
                valid_s: 0.01 * f64::from(number),
                received_s: None,
            })
            .with_frame(press(force, place, number * 10 + 5))
            .with_truth(Readings::from_values([place / 2.0, force]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

#[test]
fn the_list_of_recording_faults_is_apart_from_that_of_pictures() {
    let ids = |name: &str| -> Vec<&'static str> {
        let chosen = select(&[name.to_owned()]).expect("a list");
        chosen.into_iter().map(|fault| fault.id).collect()
    };
    assert_eq!(ids("recording-5"), RECORDING_FAULTS.map(|fault| fault.id));
    assert_eq!(ids("gel-12"), FAULTS.map(|fault| fault.id));
    let known: Vec<&str> = RECORDING_FAULTS.iter().map(|fault| fault.id).collect();
    assert!(FAULTS.iter().all(|fault| !known.contains(&fault.id)));
    for fault in RECORDING_FAULTS {
        assert!(
            fault.table.is_sorted() && fault.table[4] <= fault.most,
            "{}",
            fault.id
        );
    }
}

#[test]
fn pictures_of_every_size_go_through_recording_faults_and_parameter_zero_changes_none() {
    let formats = [
        PixelFormat::Gray8,
        PixelFormat::Gray16,
        PixelFormat::Rgb8,
        PixelFormat::Rgb16,
    ];
    for format in formats {
        for size in [[1, 1], [1, 9], [9, 1], [17, 10]] {
            let frame = picture(size, format, |x, y| f64::from((x * 5 + y * 3) % 7) / 7.0);
            for fault in RECORDING_FAULTS {
                let same = Stress::new(fault, 0.0, 1).apply(&frame, "a", None);
                assert_eq!(same, frame, "{}", fault.id);
                for parameter in fault.table.into_iter().chain([fault.most]) {
                    let changed = Stress::new(fault, parameter, 1).apply(&frame, "a", None);
                    assert_eq!(changed.info(), frame.info(), "{}", fault.id);
                    assert!(!fault.is_of_labels() || changed == frame, "{}", fault.id);
                }
            }
        }
    }
}

#[test]
fn a_compressed_picture_of_one_level_has_the_nearest_step_of_the_table() {
    let info = FrameInfo {
        width: 11,
        height: 9,
        format: PixelFormat::Gray8,
    };
    let flat = Frame::new(info, vec![100; 99]).expect("whole");
    let at = |lost: f64| Stress::new(fault("jpeg"), lost, 1).apply(&flat, "a", None);
    // At a quality of 50 the step of the mean is 16 / 8 levels, and 100 is 14 steps below 128.
    assert_eq!(at(50.0), flat);
    // At a quality of 10 the step is 80 / 8 levels: 98 is three steps below.
    assert!(at(90.0).bytes().iter().all(|byte| *byte == 98));
}

#[test]
fn a_lower_quality_changes_pictures_more_and_keeps_colour() {
    let frame = picture([40, 24], PixelFormat::Rgb8, |x, y| {
        f64::from((x * x + 3 * y) % 61) / 61.0
    });
    let change = |lost: f64| -> u32 {
        let changed = Stress::new(fault("jpeg"), lost, 1).apply(&frame, "a", None);
        let pairs = changed.bytes().iter().zip(frame.bytes());
        pairs
            .map(|(one, other)| u32::from(one.abs_diff(*other)))
            .sum()
    };
    let changes = fault("jpeg").table.map(change);
    assert!(
        changes.is_sorted() && changes[0] > 0 && changes[4] > changes[0],
        "{changes:?}"
    );
    // A gray picture in colour has no colour before and after.
    let gray = Stress::new(fault("jpeg"), 70.0, 1).apply(&frame, "a", None);
    let mut pixels = gray.bytes().chunks_exact(3);
    assert!(pixels.all(|pixel| pixel[0].abs_diff(pixel[2]) <= 1));
}

#[test]
fn light_fades_in_proportion_to_time() {
    let frame = press(1.0, 9.0, 3);
    let mut faults = FAULTS.into_iter();
    let darker = faults
        .find(|fault| fault.id == "exposure_low")
        .expect("in the list");
    let drift = Stress::new(fault("exposure_drift"), 0.4, 1);
    assert_eq!(drift.at(0.0).apply(&frame, "a", None), frame);
    for (share, lost) in [(0.5, 0.2), (1.0, 0.4)] {
        let expected = Stress::new(darker, lost, 1).apply(&frame, "a", None);
        assert_eq!(
            drift.at(share).apply(&frame, "a", None),
            expected,
            "{share}"
        );
    }
    let steady = Stress::new(darker, 0.4, 1);
    assert_eq!(
        steady.at(0.5).apply(&frame, "a", None),
        steady.apply(&frame, "a", None)
    );
}

#[test]
fn lost_markers_are_painted_over_also_where_they_moved() {
    let tracker = MarkerTracker::new(&dots(0)).expect("markers");
    let lost =
        |share: f64| Stress::new(fault("marker_loss"), share, 1).with_markers(Some(&tracker));
    for right in [0, 3] {
        let frame = dots(right);
        assert_eq!(lit(&lost(1.0).apply(&frame, "a", None)), 0, "{right}");
        assert_eq!(
            lit(&lost(0.5).apply(&frame, "a", None)),
            lit(&frame) / 2,
            "{right}"
        );
    }
    let without = Stress::new(fault("marker_loss"), 1.0, 1);
    assert_eq!(without.apply(&dots(0), "a", None), dots(0));
    // Pictures in which no marker is left stay as they are, and nothing panics.
    let black = picture([128, 96], PixelFormat::Gray8, |_, _| 0.0);
    assert_eq!(lost(0.5).apply(&black, "a", None), black);
}

#[test]
fn a_gel_without_markers_skips_their_loss_and_black_pictures_have_finite_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let flat = picture([24, 16], PixelFormat::Gray8, |_, _| 0.5);
    let plain = record_with(
        &folder.path().join("plain"),
        Some(flat),
        |force, place, number| press(force, place, number * 10 + 3),
    );
    let report = stress(&plain, &model, &by_parameter(&["marker_loss"]), WORK).expect("tested");
    assert!(report.faults.is_empty());
    assert_eq!(report.skipped[0].fault, "marker_loss");
    assert!(report.skipped[0].reason.contains("no grid of markers"));

    let moved = record_with(
        &folder.path().join("moved"),
        Some(dots(0)),
        |force, _, number| {
            dots(usize::from(force > 1.0) + usize::try_from(number % 2).expect("small"))
        },
    );
    let model = fitted(&moved, "ridge", &["size=8x8"]);
    let black = record_with(&folder.path().join("black"), Some(dots(0)), |_, _, _| {
        picture([128, 96], PixelFormat::Gray8, |_, _| 0.0)
    });
    let report = stress(&black, &model, &by_parameter(&["marker_loss"]), WORK).expect("tested");
    let severities = &of(&report, "marker_loss").severities;
    assert_eq!(severities.len(), 5);
    for tested in severities {
        let errors = tested.stale.values().filter_map(|score| score.mae.value);
        assert!(errors.clone().count() > 0 && errors.clone().all(f64::is_finite));
    }
}

#[test]
fn without_times_a_drift_and_a_lag_are_skipped_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let wanted = by_parameter(&["exposure_drift", "label_lag", "force_noise"]);
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let skipped: Vec<&str> = report.skipped.iter().map(|of| of.fault.as_str()).collect();
    assert_eq!(skipped, ["exposure_drift", "label_lag"]);
    assert!(
        report
            .skipped
            .iter()
            .all(|of| of.reason.contains("times `t_s`"))
    );
    assert_eq!(report.list.name, "force_noise");
}

#[test]
fn a_late_label_adds_the_change_of_the_label_to_the_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let dataset = timed(&folder.path().join("timed"));
    let wanted = by_parameter(&["label_lag", "exposure_drift"]);
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    assert_eq!(report.list.name, "exposure_drift,label_lag");
    let lag = of(&report, "label_lag");
    let clean = report.clean["Fz"].mae.value.expect("an error");
    // Labels grow by 0.4 N each 10 ms up to the fifth of a contact, which keeps its label.
    for (at, most) in [(0, 0.16), (1, 0.32), (2, 0.56)] {
        let error = lag.severities[at].stale["Fz"].mae.value.expect("an error");
        assert!(
            (error - most).abs() <= clean + 1e-9,
            "{at}: {error} {clean}"
        );
    }
    // No check of pictures can find a fault of labels, so its errors are not named as unnoticed.
    let most = lag.severities[4].stale["Fz"].degradation.value;
    assert!(most.expect("a ratio") > 2.0, "{lag:?}");
    let unnoticed = report.unnoticed.as_ref().expect("there is a reference");
    assert!(unnoticed.iter().all(|of| of.fault != "label_lag"));
    // The place is equal in all pictures of a contact.
    let place = &lag.severities[4].stale["Px"].degradation;
    assert_eq!(place.value, Some(1.0));
    let drift = of(&report, "exposure_drift");
    let stimuli: Vec<f64> = drift
        .severities
        .iter()
        .filter_map(|of| of.stimulus)
        .collect();
    assert!(stimuli.len() == 5 && stimuli.is_sorted(), "{stimuli:?}");
}

#[test]
fn noise_of_labels_of_force_grows_the_error_of_force_alone_and_has_no_stimulus() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let wanted = StressRequest {
        faults: vec!["force_noise".to_owned()],
        ..StressRequest::default()
    };
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let noise = of(&report, "force_noise");
    assert!(noise.note.as_ref().expect("a note").contains("undefined"));
    let errors: Vec<f64> = noise
        .severities
        .iter()
        .map(|of| of.stale["Fz"].mae.value.expect("an error"))
        .collect();
    assert_eq!(errors.len(), 5);
    // The greatest force is 2 N, so that noise of a tenth has a mean size of 0.16 N.
    assert!(errors[4] > 0.1 && errors[4] > errors[0], "{errors:?}");
    for of in &noise.severities {
        assert_eq!(
            (of.stimulus, of.stale["Px"].degradation.value),
            (None, Some(1.0))
        );
        assert!(of.fresh.is_none() && of.check.is_empty());
    }
    let again = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let text = |report: &StressReport| serde_json::to_string(report).expect("JSON");
    assert_eq!(text(&report), text(&again));
}

/// Name of the test that other processes run.
const PRINTED: &str = "recording_faults::bytes_of_recording_faults_are_printed_as_a_digest";

#[test]
#[expect(clippy::print_stdout, reason = "read by the next test")]
fn bytes_of_recording_faults_are_printed_as_a_digest() {
    let tracker = MarkerTracker::new(&dots(0)).expect("markers");
    let coloured = picture([21, 14], PixelFormat::Rgb16, |x, y| {
        f64::from((x * 37 + y * 101) % 97) / 97.0
    });
    let mut bytes = Vec::new();
    for fault in RECORDING_FAULTS {
        for parameter in fault.table {
            let stress = Stress::new(fault, parameter, 5).with_markers(Some(&tracker));
            for frame in [&coloured, &dots(2)] {
                bytes.extend_from_slice(stress.at(0.7).apply(frame, "a", None).bytes());
            }
        }
    }
    println!("digest: {}", Digest::of(&bytes));
}

/// Starts one process for each instruction set, because a process selects its set only once.
#[test]
fn recording_faults_have_the_same_bytes_by_every_instruction_set_of_the_machine() {
    let program = std::env::current_exe().expect("this program");
    let mut digests = Vec::new();
    for isa in Isa::available() {
        let mut command = Command::new(&program);
        command
            .args(["--exact", PRINTED, "--nocapture"])
            .env("TACEVA_ISA", isa.name());
        let output = command.output().expect("this program runs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let digest = text
            .lines()
            .find_map(|line| Some(line.split_once("digest: ")?.1.to_owned()));
        digests.push(digest.unwrap_or_else(|| panic!("{isa}: {text}")));
    }
    digests.dedup();
    assert_eq!(digests.len(), 1, "{digests:?}");
}
