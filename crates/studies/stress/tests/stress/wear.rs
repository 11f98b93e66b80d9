//! Tests of the errors of a model on recordings of one sensor unit.

use std::path::Path;

use taceva_core::{Amount, Date, PixelFormat, Unit};
use taceva_dataset::Dataset;
use taceva_models::Model;
use taceva_stress::{ByChannel, Undefined, WearBy, WearReport, WearRequest, wear};

use crate::drawing::{Age, HEIGHT, WIDTH, WORK, fitted, picture, press, record, record_aged};

/// Model that reads differences from the untouched picture. It is fitted to a recording of its own.
fn model(folder: &Path) -> Model {
    let seen = record(&folder.join("seen"), 1);
    fitted(&seen, "ridge", &["size=8x8", "difference=true"])
}

fn on(day: u64) -> Option<Date> {
    Some(Date::of_unix_s(86_400 * day))
}

/// Age of the gel `1`: its presses, and the date of the recording.
fn age(presses: Option<u32>, recorded_on: Option<Date>) -> Age {
    Age {
        serial: "1",
        gel: "1",
        presses,
        recorded_on,
    }
}

/// Creates a recording whose pictures are multiplied by `light`. Recordings with different `noise` share no picture.
fn worn(folder: &Path, name: &str, age: &Age, light: f64, noise: u32) -> Dataset {
    let draw = |force: f64, place: f64, number: u32| {
        let whole = press(force, place, number * 10 + noise);
        let info = whole.info();
        let bytes = whole.bytes();
        picture([WIDTH, HEIGHT], PixelFormat::Gray8, |x, y| {
            let at = usize::try_from(y * info.width + x).expect("a place");
            light * f64::from(bytes[at]) / 255.0
        })
    };
    let rest = draw(0.0, 0.0, 90);
    record_aged(&folder.join(name), age, Some(rest), draw)
}

/// Recordings after 0, 1000, 2000 and 3000 presses, not in this order. Their pictures become darker with the number of presses.
fn falling(folder: &Path) -> Vec<Dataset> {
    [(3_u32, 0.4), (0, 1.0), (2, 0.6), (1, 0.8)]
        .map(|(thousand, light)| {
            let name = format!("after-{thousand}");
            let age = age(Some(1000 * thousand), None);
            worn(folder, &name, &age, light, 2 + thousand)
        })
        .into()
}

fn limit(value: f64) -> ByChannel<Amount> {
    let unit = Unit::Newton;
    ByChannel::from([("Fz".to_owned(), Amount { value, unit })])
}

fn refused(recordings: &[Dataset], model: &Model, request: &WearRequest) -> String {
    let error = wear(recordings, model, request, WORK).expect_err("refused");
    assert!(error.is_usage(), "{error}");
    error.to_string()
}

fn text(report: &WearReport) -> String {
    serde_json::to_string(report).expect("JSON")
}

#[test]
fn recordings_are_ordered_by_presses_and_a_growing_error_has_a_slope() {
    let folder = tempfile::tempdir().expect("a folder");
    let (model, recordings) = (model(folder.path()), falling(folder.path()));
    let request = WearRequest {
        limits: limit(10.0),
        ..WearRequest::default()
    };
    let report = wear(&recordings, &model, &request, WORK).expect("compared");
    assert_eq!((report.by, report.gels.len()), (WearBy::Presses, 1));
    let gel = &report.gels[0];
    let presses = gel.recordings.iter().map(|of| of.presses_since_gel);
    let expected = [0_u32, 1000, 2000, 3000].map(Some);
    assert_eq!(presses.collect::<Vec<Option<u32>>>(), expected);
    let stimuli = gel.recordings.iter().map(|of| of.stimulus);
    let stimuli: Vec<Option<f64>> = stimuli.collect();
    assert_eq!(stimuli[0], Some(0.0));
    assert!(stimuli.is_sorted(), "{stimuli:?}");
    let force = &gel.channels["Fz"];
    assert!(
        force.slope.value.expect("four recordings") > 0.0,
        "{force:?}"
    );
    assert!(force.slope.ci95.is_some(), "{force:?}");
    let met = force.limit.expect("a limit is stated");
    assert_eq!(met.at.is_some(), met.reason.is_none(), "{met:?}");
    assert!(gel.channels["Px"].limit.is_none());
    assert!(gel.recordings[0].differences.is_empty());
    assert_eq!(gel.recordings[0].source, "synthetic");
    let last = &gel.recordings[3].differences["Fz"];
    assert!(
        last.is_shown && last.value.expect("known") > 0.0,
        "{last:?}"
    );
    let different = force.first_different.as_ref().expect("the last at least");
    assert!(different.contains("after-"), "{different}");
    let said = report.not_measured.as_ref().expect("drawn pictures");
    assert!(said.contains("synthetic"), "{said}");
    // The order in which recordings are named changes no byte.
    let again: Vec<Dataset> = [1, 3, 2, 0]
        .map(|at: usize| Dataset::open(recordings[at].path()).expect("opens"))
        .into();
    let other = wear(&again, &model, &request, WORK).expect("compared");
    assert_eq!(text(&report), text(&other));
}

#[test]
fn recordings_without_presses_are_ordered_by_date_and_two_have_no_slope() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model(folder.path());
    let later = worn(folder.path(), "later", &age(None, on(20_060)), 1.0, 2);
    let first = worn(folder.path(), "first", &age(Some(7), on(20_000)), 1.0, 3);
    let both = [later, first];
    let report = wear(&both, &model, &WearRequest::default(), WORK).expect("compared");
    assert_eq!((report.by, report.step), (WearBy::Date, 30.0));
    let gel = &report.gels[0];
    let days = gel.recordings.iter().map(|of| of.day);
    assert_eq!(
        days.collect::<Vec<Option<Date>>>(),
        [on(20_000), on(20_060)]
    );
    assert!((gel.recordings[1].place - 60.0).abs() < 1e-12);
    let slope = &gel.channels["Fz"].slope;
    assert_eq!(slope.reason, Some(Undefined::TooFewRecordings));
    let by_presses = WearRequest {
        by: Some(WearBy::Presses),
        ..WearRequest::default()
    };
    let said = refused(&both, &model, &by_presses);
    assert!(said.contains("later: no `presses_since_gel`"), "{said}");
    let [later, _] = both;
    let undated = worn(folder.path(), "undated", &age(None, None), 1.0, 4);
    let said = refused(&[later, undated], &model, &WearRequest::default());
    assert!(said.contains("undated: no day: `recorded_on`"), "{said}");
}

#[test]
fn one_recording_the_same_one_twice_and_those_of_two_units_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model(folder.path());
    let request = WearRequest::default();
    let own = worn(folder.path(), "own", &age(Some(0), None), 1.0, 2);
    let said = refused(std::slice::from_ref(&own), &model, &request);
    assert!(
        said.contains("one recording, expected two or more"),
        "{said}"
    );
    let again = Dataset::open(own.path()).expect("opens");
    let other = Age {
        serial: "2",
        ..age(Some(10), None)
    };
    let other = worn(folder.path(), "other", &other, 1.0, 3);
    let said = refused(&[again, other], &model, &request);
    let expected = ["own is of", "serial number `1`", "other of", "with `2`"];
    for words in expected {
        assert!(said.contains(words), "{words}: {said}");
    }
    let again = Dataset::open(own.path()).expect("opens");
    let said = refused(&[own, again], &model, &request);
    assert!(said.contains("are one recording or states"), "{said}");
}

#[test]
fn presses_that_decrease_with_the_same_gel_are_refused_and_another_gel_is_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model(folder.path());
    let request = WearRequest::default();
    let first = worn(folder.path(), "first", &age(Some(900), on(20_000)), 1.0, 2);
    let next = worn(folder.path(), "next", &age(Some(20), on(20_010)), 1.0, 3);
    let said = refused(&[next, first], &model, &request);
    for words in ["presses_since_gel = 900", "next of 2024-10-14 states 20"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let first = Dataset::open(&folder.path().join("first")).expect("opens");
    let renewed = Age {
        gel: "2",
        ..age(Some(20), on(20_010))
    };
    let renewed = worn(folder.path(), "renewed", &renewed, 0.8, 4);
    let report = wear(&[renewed, first], &model, &request, WORK).expect("compared");
    let gels: Vec<&str> = report.gels.iter().map(|of| of.gel.as_str()).collect();
    assert_eq!(
        (gels, report.subject.gel.as_str()),
        (vec!["1", "2"], "several")
    );
    for gel in &report.gels {
        assert_eq!(gel.recordings.len(), 1);
        assert_eq!(gel.channels["Fz"].first_different, None);
        let reason = gel.channels["Fz"].slope.reason;
        assert_eq!(reason, Some(Undefined::TooFewRecordings));
    }
}

#[test]
fn samples_of_the_fit_are_left_out_and_wrong_limits_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = worn(folder.path(), "seen", &age(Some(0), None), 1.0, 1);
    let model = fitted(&seen, "ridge", &["size=8x8"]);
    let both = [
        seen,
        worn(folder.path(), "later", &age(Some(500), None), 1.0, 2),
    ];
    let report = wear(&both, &model, &WearRequest::default(), WORK).expect("compared");
    let [first, later] = &report.gels[0].recordings[..] else {
        panic!("two recordings");
    };
    let part = |of: &taceva_stress::RecordingWear| of.provenance.part.clone();
    assert_eq!(part(first).as_deref(), Some("test"));
    assert_eq!(part(later).as_deref(), Some("all"));
    assert!(first.samples < later.samples);
    // The test part has two of the twelve points.
    let said = report.notes.join(" ");
    assert!(said.contains("seen: No intervals: "), "{said}");
    assert!(!said.contains("later: "), "{said}");
    let with = |name: &str, value: f64, unit: Unit| WearRequest {
        limits: ByChannel::from([(name.to_owned(), Amount { value, unit })]),
        ..WearRequest::default()
    };
    for (request, expected) in [
        (
            with("Fq", 0.1, Unit::Newton),
            "mae.Fq is not scored for this model, expected one of `",
        ),
        (
            with("Fz", 0.1, Unit::Millimetre),
            "mae.Fz has a limit in mm, expected a limit in N",
        ),
        (
            with("Fz", 0.0, Unit::Newton),
            "mae.Fz has the limit 0 N, expected a limit above 0",
        ),
    ] {
        let said = refused(&both, &model, &request);
        assert!(said.starts_with(expected), "{said}");
    }
}

#[test]
fn one_of_several_recordings_of_the_fit_is_refused_and_named_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let new = |name: &str, presses: u32, noise: u32| {
        worn(folder.path(), name, &age(Some(presses), None), 1.0, noise)
    };
    let both = Dataset::joined(vec![new("one", 0, 1), new("other", 10, 2)]).expect("joined");
    let model = fitted(&both, "ridge", &["size=8x8"]);
    let one = Dataset::open(&folder.path().join("one")).expect("opens");
    let said = refused(&[one, new("later", 20, 3)], &model, &WearRequest::default());
    let expected = "one: the model was fitted on this recording and others";
    assert!(said.contains(expected), "{said}");
    assert_eq!(said.matches("one: ").count(), 1, "{said}");
}

#[test]
fn later_recordings_decode_no_picture_of_contact_twice() {
    let folder = tempfile::tempdir().expect("a folder");
    let recordings = falling(folder.path());
    let report = wear(
        &recordings,
        &model(folder.path()),
        &WearRequest::default(),
        WORK,
    )
    .expect("worn");
    let decoded = report.gels[0].recordings.iter();
    let decoded: Vec<u64> = decoded.map(|of| of.provenance.frames_decoded).collect();
    assert_eq!(decoded[1..], [60, 60, 60]);
    assert!(decoded[0] > 60, "{decoded:?}");
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}
