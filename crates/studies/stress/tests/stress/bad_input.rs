//! Requests that are refused by name.

use taceva_core::{Channel, Channels, Clock, PixelFormat, Readings, Sample};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_evaluate::DataPart;
use taceva_models::Model;
use taceva_stress::{FAULTS, StressRequest, select, stress};

use crate::drawing::{WORK, fitted, picture, record, record_with, unseen};

/// Words of the refusal, which is a wrong request.
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
    assert!(said.contains("only the bench knows its gel"), "{said}");
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
