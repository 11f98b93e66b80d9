//! Tests of instruments and certificates of a recording, in its journal, its header and in joined recordings.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::{
    Certificate, Channel, Channels, Clock, Coverage, Date, Instrument, Readings, Sample,
    Traceability,
};
use taceva_dataset::{
    Dataset, DatasetError, Leds, PictureSide, Recorder, RecordingFacts, RecordingSpec, SensorFacts,
    Source,
};

/// Transducer whose certificate has the number `number`.
fn traced(number: &str) -> Traceability {
    let day = |text: &str| text.parse().expect("a day");
    let amount = |text: &str| text.parse().expect("an amount");
    let coverage = Coverage::Probability {
        p: 0.95,
        dof: Some(9.0),
    };
    let mut certificate = Certificate::new(number, "a \"b\"", day("2026-05-12"), "42", coverage);
    certificate.valid_until = Some(day("2027-05-12"));
    certificate.expanded.insert("Fz".to_owned(), amount("3 mN"));
    certificate.relative.insert("Fx".to_owned(), 0.001);
    let range = [amount("50 mN"), amount("50 N")];
    certificate.range.insert("Fz".to_owned(), range);
    let stated = |other: &str, coefficient| taceva_core::StatedCorrelation {
        between: ["Fx".to_owned(), other.to_owned()],
        coefficient,
    };
    certificate.correlation = vec![stated("Fz", Some(0.5)), stated("Fy", None)];
    certificate.temperature = Some("23 ± 2 C".to_owned());
    let force = Traceability::new(Instrument::Force);
    let force = force.with_driver("ati/netft", Some("42".to_owned()));
    force.with_certificate(certificate).expect("accepted")
}

fn spec(number: &str) -> RecordingSpec {
    let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("gel"));
    let robot = Traceability::new(Instrument::Robot);
    let facts = facts.with_traceability(vec![traced(number), robot]);
    RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"))
}

/// Date `number` days after 1970-01-01.
fn day(number: u64) -> Date {
    Date::of_unix_s(86_400 * number)
}

/// Specification of a recording that begins or continues on day `number`.
fn spec_on(number: u64) -> RecordingSpec {
    let mut spec = spec("D-K-1");
    spec.facts.recorded_on = Some(day(number));
    spec
}

fn sample(name: &str, force: f64) -> Sample {
    Sample::new(name).with_truth(Readings::from_values([force]))
}

fn record(path: &Path, number: &str, force: f64) -> Dataset {
    let mut recorder = Recorder::create(path, &spec(number)).expect("created");
    recorder.append(&sample("1", force)).expect("recorded");
    recorder.close().expect("closed");
    Dataset::open(path).expect("opens")
}

#[test]
fn a_recording_keeps_its_instruments_and_their_certificates() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("set"), "D-K-1", 0.5);
    let robot = Traceability::new(Instrument::Robot);
    assert_eq!(dataset.header().traceability, [traced("D-K-1"), robot]);
    let text = std::fs::read_to_string(folder.path().join("set/dataset.toml")).expect("read");
    assert!(
        text.contains("[[traceability]]\ninstrument = \"force\"\n"),
        "{text}"
    );
    assert!(text.contains("issued = \"2026-05-12\""), "{text}");
}

#[test]
fn an_interrupted_recording_goes_on_with_its_certificate_and_with_no_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec("D-K-1")).expect("created");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    drop(recorder);
    let other = Recorder::open(&path, &spec("D-K-2")).map(drop);
    let message = other.expect_err("another certificate").to_string();
    let remedy = format!("`taceva capture {} --close`", path.display());
    assert!(
        message.contains("another certificate") && message.contains(&remedy),
        "{message}"
    );
    let mut replaced = spec("D-K-2");
    replaced.facts.traceability[0].serial = Some("43".to_owned());
    let other = Recorder::open(&path, &replaced).map(drop);
    let message = other.expect_err("another transducer").to_string();
    assert!(
        message.contains("another serial number") && !message.contains("--close"),
        "{message}"
    );
    let recorder = Recorder::open(&path, &spec("D-K-1")).expect("goes on");
    let header = recorder.close().expect("closed");
    assert_eq!(header.traceability[0], traced("D-K-1"));
}

#[test]
fn a_recording_of_a_build_that_kept_no_instruments_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut before = spec("D-K-1");
    before.facts.traceability.clear();
    drop(Recorder::create(&path, &before).expect("created"));
    let mut recorder = Recorder::open(&path, &spec("D-K-1")).expect("goes on");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    let header = recorder.close().expect("closed");
    assert!(header.traceability.is_empty());
}

#[test]
fn a_recording_that_goes_on_the_next_day_keeps_the_day_on_which_it_began() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec_on(20_779)).expect("created");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    drop(recorder);
    let recorder = Recorder::open(&path, &spec_on(20_780)).expect("goes on");
    recorder.close().expect("closed");
    let header = Dataset::open(&path).expect("opens").header().clone();
    let [first, last] = [20_779, 20_780].map(day);
    assert_eq!(header.recorded_on, Some(first));
    assert_eq!(header.recorded_until, Some(last));
    assert_eq!(header.days(&[]), Some(first..=last));
}

#[test]
fn a_recording_that_a_close_alone_ends_keeps_the_days_of_all_its_sessions() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec_on(20_779)).expect("created");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    drop(recorder);
    for _ in 0..2 {
        drop(Recorder::open(&path, &spec_on(20_781)).expect("goes on"));
    }
    let later = folder.path().join("set.later.toml");
    assert!(later.exists());
    let closed = Recorder::resume(&path).expect("goes on").close();
    assert_eq!(closed.expect("closed").recorded_until, Some(day(20_781)));
    assert!(!later.exists(), "the header has it");
}

#[test]
fn warnings_of_devices_stand_in_the_header_once_whichever_session_gave_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let warn = |words: &[&str]| {
        let words: Vec<String> = words.iter().map(|&word| word.to_owned()).collect();
        taceva_dataset::add_device_warnings(&path, &words).expect("written");
    };
    // Left by another recording of this name, which was deleted.
    warn(&["low pass 3 of the box"]);
    let mut recorder = Recorder::create(&path, &spec("D-K-1")).expect("created");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    warn(&["low pass 8 of the box", "speed slider at 50 %"]);
    drop(recorder);
    warn(&["low pass 8 of the box"]);
    let header = Recorder::resume(&path).expect("goes on").close();
    let warnings = header.expect("closed").warnings;
    assert_eq!(warnings, ["low pass 8 of the box", "speed slider at 50 %"]);
    let read = Dataset::open(&path).expect("opens");
    assert_eq!(read.header().warnings, warnings);
}

#[test]
fn a_drift_that_differs_in_each_session_is_a_setting_of_the_last_and_refuses_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let measure = |ppm: &str| {
        let measured = BTreeMap::from([("sensor_clock_drift_ppm".to_owned(), ppm.to_owned())]);
        taceva_dataset::add_measured_settings(&path, &measured).expect("written");
    };
    let mut stated = spec("D-K-1");
    let exposure = ("exposure_ms".to_owned(), "15".to_owned());
    stated.facts.settings = BTreeMap::from([exposure.clone()]);
    let mut recorder = Recorder::create(&path, &stated).expect("created");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    measure("41.30");
    drop(recorder);
    let recorder = Recorder::open(&path, &stated).expect("goes on");
    taceva_dataset::add_measured_settings(&path, &BTreeMap::new()).expect("nothing to write");
    measure("-12.00");
    let header = recorder.close().expect("closed");
    let drift = ("sensor_clock_drift_ppm".to_owned(), "-12.00".to_owned());
    assert_eq!(header.settings, BTreeMap::from([exposure, drift]));
    let read = Dataset::open(&path).expect("opens");
    assert_eq!(read.header().settings, header.settings);
}

#[test]
fn a_recording_is_resumed_with_the_leds_that_it_began_with_and_with_no_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let lit = |leds: Option<&str>| {
        let mut spec = spec("D-K-1");
        let leds = leds.map(|leds| ("led".to_owned(), leds.to_owned()));
        spec.facts.settings = BTreeMap::from_iter(leds);
        spec
    };
    let mut recorder = Recorder::create(&path, &lit(Some("15,0,15"))).expect("created");
    recorder.append(&sample("1", 0.5)).expect("recorded");
    drop(recorder);
    for (leds, found) in [
        (Some("15,15,15"), "`15,15,15`"),
        (None, "not stated by the device"),
    ] {
        let refused = Recorder::open(&path, &lit(leds)).expect_err("other LEDs");
        let refused = refused.to_string();
        let expected = format!("the setting `led` is {found}, expected `15,0,15`");
        assert!(refused.contains(&expected), "{refused}");
    }
    let resumed = Recorder::open(&path, &lit(Some("15,0,15"))).expect("the same LEDs");
    assert!(resumed.has("1"));
}

#[test]
fn joined_recordings_keep_the_first_and_the_last_of_their_days() {
    let folder = tempfile::tempdir().expect("a folder");
    let on = |name: &str, begun: Option<u64>, force: f64| {
        let path = folder.path().join(name);
        let spec = begun.map_or_else(|| spec("D-K-1"), spec_on);
        let mut recorder = Recorder::create(&path, &spec).expect("created");
        recorder.append(&sample("1", force)).expect("recorded");
        recorder.close().expect("closed");
        Dataset::open(&path).expect("opens")
    };
    let recordings = vec![
        on("two", Some(20_780), 0.5),
        on("one", Some(20_779), 0.6),
        on("three", Some(20_785), 0.7),
        on("unknown", None, 0.8),
    ];
    let joined = Dataset::joined(recordings).expect("alike");
    let header = joined.header();
    assert_eq!(
        (header.recorded_on, header.recorded_until),
        (Some(day(20_779)), Some(day(20_785)))
    );
    let same = vec![on("a", Some(20_779), 0.5), on("b", Some(20_779), 0.6)];
    let joined = Dataset::joined(same).expect("alike");
    assert_eq!(joined.header().recorded_until, None);
}

/// Dataset of one sample with the pressing force `force`, N, of a sensor whose facts are changed by `change`.
fn recorded(path: &Path, force: f64, change: impl FnOnce(&mut SensorFacts)) -> Dataset {
    let mut spec = spec("D-K-1");
    change(&mut spec.facts.sensor);
    let mut recorder = Recorder::create(path, &spec).expect("created");
    recorder.append(&sample("1", force)).expect("recorded");
    recorder.close().expect("closed");
    Dataset::open(path).expect("opens")
}

#[test]
fn joined_recordings_state_the_presses_on_their_gel_only_if_they_agree() {
    let folder = tempfile::tempdir().expect("a folder");
    let after = |name: &str, presses: u32, force: f64| {
        recorded(&folder.path().join(name), force, |sensor| {
            sensor.presses_since_gel = Some(presses);
        })
    };
    let presses = |recordings| {
        let joined = Dataset::joined(recordings).expect("alike");
        joined.header().sensor.presses_since_gel
    };
    let (new, worn) = (after("new", 0, 0.5), after("worn", 5000, 0.6));
    assert_eq!(worn.header().sensor.presses_since_gel, Some(5000));
    assert_eq!(presses(vec![new, worn]), None);
    let same = vec![after("a", 70, 0.5), after("b", 70, 0.6)];
    assert_eq!(presses(same), Some(70));
}

#[test]
fn joined_recordings_state_the_sides_of_their_leds_only_if_they_agree() {
    let folder = tempfile::tempdir().expect("a folder");
    let lit = |name: &str, red: PictureSide, force: f64| {
        recorded(&folder.path().join(name), force, |sensor| {
            sensor.leds.red = Some(red)
        })
    };
    let leds = |recordings| {
        let joined = Dataset::joined(recordings).expect("alike");
        joined.header().sensor.leds
    };
    let same = vec![
        lit("a", PictureSide::Left, 0.5),
        lit("b", PictureSide::Left, 0.6),
    ];
    assert_eq!(leds(same).red, Some(PictureSide::Left));
    let turned = vec![
        lit("c", PictureSide::Left, 0.5),
        lit("d", PictureSide::Top, 0.6),
    ];
    assert_eq!(leds(turned), Leds::default());
}

#[test]
fn joined_recordings_name_the_certificates_of_both_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let one = record(&folder.path().join("one"), "D-K-1", 0.5);
    let two = record(&folder.path().join("two"), "D-K-2", 0.6);
    let three = record(&folder.path().join("three"), "D-K-2", 0.7);
    let joined = Dataset::joined(vec![one, two, three]).expect("alike");
    let robot = Traceability::new(Instrument::Robot);
    let expected = [traced("D-K-1"), robot, traced("D-K-2")];
    assert_eq!(joined.header().traceability, expected);
}

#[test]
fn a_certificate_of_one_of_joined_recordings_does_not_cover_the_labels_of_the_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let certified = record(&folder.path().join("one"), "D-K-1", 0.5);
    let path = folder.path().join("two");
    let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("gel"));
    let channels = Channels::new([Channel::FZ]).expect("one");
    let mut recorder =
        Recorder::create(&path, &RecordingSpec::new(facts, channels)).expect("created");
    recorder.append(&sample("1", 0.6)).expect("recorded");
    recorder.close().expect("closed");
    let plain = Dataset::open(&path).expect("opens");
    let joined = Dataset::joined(vec![plain, certified]).expect("alike");
    let of_force = joined.header().traceability.iter();
    let of_force = of_force.filter(|of| of.instrument == Instrument::Force);
    let stated: Vec<bool> = of_force.map(|of| of.certificate.is_some()).collect();
    assert_eq!(stated, [true, false]);
}

#[test]
fn a_header_whose_certificate_is_of_another_instrument_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    drop(record(&path, "D-K-1", 0.5));
    let header = path.join("dataset.toml");
    let text = std::fs::read_to_string(&header).expect("read");
    let (body, _) = text.split_once("\n[seal]").expect("sealed");
    let wrong = body.replacen("instrument = \"force\"", "instrument = \"robot\"", 1);
    let sealed = taceva_files::seal::toml_text::seal(&wrong).expect("TOML");
    std::fs::write(&header, sealed).expect("written");
    let refused = Dataset::open(&path).map(drop);
    assert!(
        matches!(&refused, Err(error @ DatasetError::Text { .. }) if error.to_string().contains("a channel of the robot")),
        "{refused:?}"
    );
}
