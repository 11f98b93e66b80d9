//! Tests of requests that are refused, and of recordings that lack data for a fault or a score.

use std::path::Path;

use taceva_core::{Channel, Channels, Clock, PixelFormat, Readings, Sample, Stamp};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_evaluate::DataPart;
use taceva_models::Model;
use taceva_stress::{By, FAULTS, StressRequest, Undefined, select, stress};

use crate::drawing::{PRESSES, WORK, fitted, picture, press, record, record_with, unseen};

fn by_parameter(faults: &[&str]) -> StressRequest {
    StressRequest {
        faults: faults.iter().map(|name| (*name).to_owned()).collect(),
        by: By::Parameter,
        ..StressRequest::default()
    }
}

/// Creates a recording without an untouched picture. Its only label is `label` of the force. Recordings with different `noise` share no picture.
fn labelled(path: &Path, channel: Channel, noise: u32, label: fn(f64) -> f64) -> Dataset {
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([channel]).expect("one");
    let mut recorder = Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new");
    for number in 0..PRESSES {
        let force = 0.4 + 0.4 * f64::from(number % 5);
        let sample = Sample::new(format!("s{number:02}"))
            .with_point_id(format!("p{}", number / 5))
            .with_frame(press(force, 9.0, 10 * number + noise))
            .with_truth(Readings::from_values([label(force)]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

/// Message of the error of a stress test, which must be an error of usage.
fn refused(dataset: &Dataset, model: &Model, request: &StressRequest) -> String {
    let error = stress(dataset, model, request, WORK).expect_err("refused");
    assert!(error.is_usage(), "{error}");
    error.to_string()
}

#[test]
fn faults_of_a_gel_have_the_names_of_the_bench() {
    let names = taceva_sim::GelFault::ALL.map(taceva_sim::GelFault::name);
    assert_eq!(taceva_stress::GEL_FAULTS, names);
}

#[test]
fn a_misspelt_fault_is_refused_with_the_nearest_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = |name: &str| StressRequest {
        faults: vec!["tear".to_owned(), name.to_owned()],
        ..StressRequest::default()
    };
    let said = refused(&dataset, &model, &request("defocsu"));
    assert_eq!(said, "fault `defocsu`: unknown, did you mean `defocus`?");
    let said = refused(&dataset, &model, &request("gel_softening"));
    assert!(
        said.contains("only the simulated bench has this fault of the gel"),
        "{said}"
    );
    let said = refused(&dataset, &model, &request("gel_rust"));
    assert!(
        said.contains("expected one of `gel-12`, `defocus`"),
        "{said}"
    );
    let none = StressRequest {
        faults: Vec::new(),
        ..StressRequest::default()
    };
    assert!(refused(&dataset, &model, &none).contains("no fault is named"));
}

#[test]
fn names_of_faults_may_have_spaces_around_them_and_all_is_every_fault() {
    let ids = |names: &[&str]| -> Vec<&'static str> {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let chosen = select(&names).expect("known names");
        chosen.into_iter().map(|fault| fault.id).collect()
    };
    assert_eq!(ids(&["dust", " tear "]), ["tear", "dust"]);
    assert_eq!(ids(&["all"]), ids(&["gel-12"]));
    assert_eq!(ids(&["all"]).len(), FAULTS.len());
}

#[test]
fn severities_outside_of_one_to_five_or_out_of_order_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    for severities in [vec![], vec![0], vec![1, 6], vec![3, 1], vec![2, 2]] {
        let request = StressRequest {
            severities,
            ..StressRequest::default()
        };
        let said = refused(&dataset, &model, &request);
        assert!(said.contains("expected numbers from 1 to 5"), "{said}");
    }
}

#[test]
fn a_metric_that_no_cell_has_is_refused_with_the_nearest_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    for (name, expected) in [
        ("rmsee", "did you mean `rmse`?"),
        ("sensitivity", "expected one of `mae`, `skill`, `rmse`"),
    ] {
        let request = StressRequest {
            metrics: vec!["r2".to_owned(), name.to_owned()],
            ..StressRequest::default()
        };
        let said = refused(&dataset, &model, &request);
        let expected = format!("metric `{name}`: not computed for faults, {expected}");
        assert!(said.starts_with(&expected), "{said}");
    }
}

#[test]
fn no_draw_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        draws: 0,
        ..StressRequest::default()
    };
    let said = refused(&dataset, &model, &request);
    assert!(
        said.contains("draws: found 0, expected at least 1"),
        "{said}"
    );
}

#[test]
fn samples_that_the_model_was_fitted_on_are_refused_and_its_test_part_is_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), 1);
    let model = fitted(&seen, "ridge", &["size=8x8"]);
    let request = |part| StressRequest {
        faults: vec!["dust".to_owned()],
        severities: vec![1],
        part,
        ..StressRequest::default()
    };
    for part in [DataPart::All, DataPart::Train, DataPart::Validation] {
        let said = refused(&seen, &model, &request(Some(part)));
        let expected = format!("part `{}`: the model was fitted on these", part.name());
        assert!(said.contains(&expected), "{said}");
    }
    let report = stress(&seen, &model, &request(None), WORK).expect("its test part");
    assert_eq!(report.provenance.part.as_deref(), Some("test"));
    assert!(report.samples < 60);
}

#[test]
fn severity_by_stimulus_needs_contact_that_is_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let flat = || picture([24, 16], PixelFormat::Gray8, |_, _| 0.5);
    let dataset = record_with(&folder.path().join("flat"), Some(flat()), |_, _, _| flat());
    let said = refused(&dataset, &model, &StressRequest::default());
    assert!(said.contains("use --by parameter"), "{said}");
}

#[test]
fn a_recording_without_pictures_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::FZ]).expect("one");
    let spec = RecordingSpec::new(facts, channels);
    let path = folder.path().join("labels");
    let mut recorder = Recorder::create(&path, &spec).expect("new");
    for number in 0..6_u32 {
        let sample = Sample::new(format!("s{number}"));
        let sample = sample.with_truth(Readings::from_values([f64::from(number)]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let said = refused(&dataset, &model, &StressRequest::default());
    let expected = "the recording has no pictures, expected a recording with pictures";
    assert!(said.ends_with(expected), "{said}");
}

#[test]
fn several_recordings_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let one = record(&folder.path().join("one"), 3);
    let other = record(&folder.path().join("other"), 4);
    let both = Dataset::joined(vec![one, other]).expect("joined");
    let said = refused(&both, &model, &StressRequest::default());
    assert!(said.contains("several recordings, expected one"), "{said}");
}

#[test]
fn recordings_of_one_pixel_and_of_sixteen_bits_have_finite_errors_with_every_fault() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, size, format) in [
        ("pixel", [1, 1], PixelFormat::Gray16),
        ("gray", [3, 2], PixelFormat::Gray16),
        ("colour", [3, 2], PixelFormat::Rgb16),
    ] {
        let drawn = |name: &str, noise: u32| {
            let draw = |force: f64, _: f64, number: u32| {
                picture(size, format, |x, y| {
                    let bits = (x * 7919 + y * 104_729 + (10 * number + noise) * 1_299_709) % 97;
                    0.3 + 0.1 * force + f64::from(bits) / 5000.0
                })
            };
            let rest = draw(0.0, 0.0, 90);
            record_with(&folder.path().join(name), Some(rest), draw)
        };
        let model = fitted(&drawn(&format!("{name} seen"), 1), "ridge", &["size=1x1"]);
        let dataset = drawn(name, 2);
        let report = stress(&dataset, &model, &by_parameter(&["gel-12"]), WORK).expect("tested");
        assert!(report.skipped.is_empty(), "{name}: no fault needs colour");
        assert_eq!(report.faults.len(), FAULTS.len());
        for fault in &report.faults {
            assert_eq!(fault.severities.len(), 5, "{name}: {}", fault.id);
            for score in fault.severities.iter().flat_map(|of| of.stale.values()) {
                let error = score.mae.value.expect("an error");
                assert!(error.is_finite(), "{name}: {}", fault.id);
            }
        }
    }
}

#[test]
fn a_model_without_an_error_keeps_its_errors_with_faults_and_has_no_degradation() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn =
        |name: &str, noise| labelled(&folder.path().join(name), Channel::FZ, noise, |_| 1.0);
    let model = fitted(&drawn("seen", 1), "baseline", &["size=8x8"]);
    let dataset = drawn("unseen", 2);
    let report = stress(&dataset, &model, &by_parameter(&["force_noise"]), WORK).expect("tested");
    assert_eq!(report.clean["Fz"].mae.value, Some(0.0));
    let noise = &report.faults[0];
    assert_eq!(noise.severities.len(), 5);
    for of in &noise.severities {
        let score = &of.stale["Fz"];
        assert!(score.mae.value.expect("an error") > 0.0, "{of:?}");
        assert_eq!(score.degradation.value, None);
        assert_eq!(score.degradation.reason, Some(Undefined::ZeroBaseline));
    }
    assert_eq!(noise.mean["Fz"].reason, Some(Undefined::ZeroBaseline));
    assert_eq!(report.mean["Fz"].reason, Some(Undefined::ZeroBaseline));
}

#[test]
fn without_an_untouched_picture_that_of_the_least_load_takes_its_place_and_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn =
        |name: &str, noise| labelled(&folder.path().join(name), Channel::FZ, noise, |force| force);
    let model = fitted(&drawn("seen", 1), "ridge", &["size=8x8"]);
    let request = StressRequest {
        faults: vec!["exposure_low".to_owned()],
        ..StressRequest::default()
    };
    let report = stress(&drawn("unseen", 2), &model, &request, WORK).expect("tested");
    assert_eq!(report.untouched, "least load");
    assert!(report.contact.is_some_and(|contact| contact > 0.0));
    let tested = &report.faults[0].severities;
    assert!(!tested.is_empty());
    for of in tested {
        assert!(of.stimulus.is_some_and(|stimulus| stimulus > 0.0), "{of:?}");
        assert!(!of.check.contains(&"TAC034"), "{of:?}");
    }
    // Nobody knows what a check of untouched pictures would find.
    assert_eq!(report.unnoticed, None);
}

#[test]
fn without_an_untouched_picture_and_a_load_the_stimulus_is_undefined() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn =
        |name: &str, noise| labelled(&folder.path().join(name), Channel::PX, noise, |force| force);
    let model = fitted(&drawn("seen", 1), "ridge", &["size=8x8"]);
    let dataset = drawn("unseen", 2);
    let report = stress(&dataset, &model, &by_parameter(&["exposure_low"]), WORK).expect("tested");
    assert_eq!((report.untouched, report.contact), ("none", None));
    let severities = report.faults[0].severities.iter();
    assert!(severities.clone().all(|of| of.stimulus.is_none()));
    let mut errors = severities.map(|of| of.stale["Px"].mae.value);
    assert!(errors.all(|error| error.is_some_and(f64::is_finite)));
    let said = refused(&dataset, &model, &StressRequest::default());
    assert!(said.contains("use --by parameter"), "{said}");
}

#[test]
fn presses_that_are_seconds_apart_skip_a_lag_and_a_single_picture_skips_the_one_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let drawn = |name: &str, count: u32| {
        let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
        let facts = RecordingFacts::new(Source::Synthetic, Clock::Monotonic, sensor);
        let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
        let spec = RecordingSpec::new(facts, channels);
        let path = folder.path().join(name);
        let mut recorder = Recorder::create(&path, &spec).expect("new");
        let reference = press(0.0, 0.0, 903);
        recorder.append_reference(&reference).expect("recorded");
        for number in 0..count {
            let force = 0.4 + 0.2 * f64::from(number);
            let sample = Sample::new(format!("s{number}"))
                .with_point_id("p".to_owned())
                .with_stamp(Stamp {
                    valid_s: 2.0 * f64::from(number),
                    received_s: None,
                })
                .with_frame(press(force, 9.0, 10 * number + 3))
                .with_truth(Readings::from_values([4.5, force]));
            recorder.append(&sample).expect("recorded");
        }
        recorder.close().expect("closed");
        Dataset::open(&path).expect("a dataset")
    };
    let request = by_parameter(&["dust", "stale_frames", "label_lag"]);
    for (name, count, expected) in [
        ("presses", 6, vec!["label_lag"]),
        ("one", 1, vec!["stale_frames", "label_lag"]),
    ] {
        let report = stress(&drawn(name, count), &model, &request, WORK).expect("tested");
        let skipped: Vec<&str> = report.skipped.iter().map(|of| of.fault.as_str()).collect();
        assert_eq!(skipped, expected, "{name}");
        let lag = report.skipped.last().map(|of| of.reason.as_str());
        assert!(
            lag.is_some_and(|reason| reason.contains("within 1 s")),
            "{lag:?}"
        );
        assert!(
            report.faults.iter().any(|fault| fault.id == "dust"),
            "{name}"
        );
    }
}
