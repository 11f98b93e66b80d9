//! Tests of the monitor of a sensor in use: changes of untouched pictures, and pictures of contact unlike the training pictures.

use std::path::Path;

use taceva_core::random::Draws;
use taceva_core::{Channel, Channels, Clock, Frame, PixelFormat, Readings, Sample};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_stress::{Alarm, Change, Monitor, watch};

use crate::drawing::{HEIGHT, WIDTH, WORK, fitted, picture, press, record, record_with};

/// Change of pictures by contact in these tests, a fraction of full scale.
const CONTACT: f64 = 0.05;
/// Number of untouched pictures that the monitor needs before it can find changes.
const LEARNT: u64 = 250;

/// Untouched picture with the brightness `light`. `number` selects the noise.
fn rest(light: f64, number: u64) -> Frame {
    let draws = Draws::new(number);
    picture([WIDTH, HEIGHT], PixelFormat::Gray8, |x, y| {
        let noise = draws.normal(u64::from(y * WIDTH + x));
        light + f64::from(x) / 300.0 + 0.01 * noise
    })
}

/// Monitor that has set its limits from untouched pictures.
fn learnt() -> Monitor {
    let mut monitor = Monitor::new(rest(0.3, 9999), CONTACT).expect("a monitor");
    for number in 0..LEARNT {
        assert_eq!(monitor.missing() as u64, LEARNT - number);
        assert_eq!(monitor.smallest(), None);
        assert!(passes(&mut monitor, &rest(0.3, number)).is_empty());
    }
    assert_eq!(monitor.missing(), 0);
    monitor
}

fn passes(monitor: &mut Monitor, frame: &Frame) -> Vec<Alarm> {
    monitor.untouched(frame).expect("of the same kind")
}

/// Records presses, then `count` untouched pictures with the brightness `light`.
fn record_rest(path: &Path, light: f64, count: u64, first: u64) -> Dataset {
    record_rests(path, count, |number| rest(light, first + number))
}

/// Records presses, then `count` untouched pictures.
fn record_rests(path: &Path, count: u64, untouched: impl Fn(u64) -> Frame) -> Dataset {
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
    let mut recorder = Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new");
    recorder
        .append_reference(&rest(0.3, 9999))
        .expect("recorded");
    for number in 0..5 {
        let sample = Sample::new(format!("press-{number}"))
            .with_point_id(format!("p{number}"))
            .with_frame(press(1.0, 8.0, number))
            .with_truth(Readings::from_values([4.0, 1.0]));
        recorder.append(&sample).expect("recorded");
    }
    for number in 0..count {
        let sample = Sample::new(format!("rest-{number}"))
            .with_point_id("rest".to_owned())
            .with_frame(untouched(number))
            .with_truth(Readings::from_values([0.0, 0.0]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

#[test]
fn a_thousand_untouched_pictures_raise_no_alarm_and_a_change_of_light_one() {
    let mut monitor = learnt();
    for number in 0..1000 {
        let found = passes(&mut monitor, &rest(0.3, 1000 + number));
        assert!(found.is_empty(), "{number}: {found:?}");
    }
    let [level, pattern, detail, _] = monitor.smallest().expect("limits");
    assert!(level < 0.2 && pattern < 0.2 && detail < 0.2);
    let mut found = Vec::new();
    for number in 0..200 {
        found.extend(passes(
            &mut monitor,
            &rest(0.3 - 0.5 * CONTACT, 3000 + number),
        ));
    }
    let [alarm] = found.as_slice() else {
        panic!("one line for one change: {found:?}");
    };
    assert_eq!(alarm.change, Change::Brightness);
    assert!(alarm.picture <= LEARNT + 1030, "{alarm}");
    let said = alarm.to_string();
    assert!(said.contains("become brighter or darker, by 0."), "{said}");
    assert!(said.contains("record a new untouched picture"), "{said}");
    assert_eq!(monitor.pictures(), [LEARNT + 1200, 0]);
    assert_eq!(monitor.found().len(), 1);
}

#[test]
fn a_change_before_the_first_picture_is_a_difference_from_the_reference() {
    let mut monitor = Monitor::new(rest(0.3, 9999), CONTACT).expect("a monitor");
    let mut found = Vec::new();
    for number in 0..LEARNT {
        found.extend(passes(&mut monitor, &rest(0.3 + 2.0 * CONTACT, number)));
    }
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].change, Change::Reference);
    assert!((found[0].strength - 2.0).abs() < 0.4, "{}", found[0]);
}

#[test]
fn repeated_pictures_are_a_change_if_none_was_repeated_before() {
    let mut monitor = learnt();
    let found: Vec<Alarm> = (0..30)
        .flat_map(|number| passes(&mut monitor, &rest(0.3, 1000 + number / 2)))
        .collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].change, Change::Repeats);
    assert!(found[0].picture < LEARNT + 10, "after three: {}", found[0]);
    // A camera that is read too often repeats pictures from the beginning.
    let mut monitor = Monitor::new(rest(0.3, 9999), CONTACT).expect("a monitor");
    for number in 0..2 * LEARNT {
        let found = passes(&mut monitor, &rest(0.3, number / 2));
        assert!(found.is_empty(), "{number}: {found:?}");
    }
}

#[test]
fn pictures_of_contact_unlike_the_training_pictures_are_a_change() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), 1);
    let model = fitted(&seen, "ridge", &["size=8x8", "difference=true"]);
    let monitor = Monitor::of(&seen).expect("a monitor");
    let mut monitor = monitor.with_model(model, &seen).expect("of the same kind");
    let touched = |monitor: &mut Monitor, frame: &Frame| -> Vec<Alarm> {
        monitor.touched(frame).expect("of the same kind")
    };
    for number in 0..60 {
        let force = 0.4 + 0.4 * f64::from(number % 5);
        let place = 4.0 + f64::from(number / 5 * 7 % 12) * 1.4;
        let found = touched(&mut monitor, &press(force, place, 10 * number + 1));
        assert!(found.is_empty(), "{number}: {found:?}");
    }
    let mut found = Vec::new();
    for number in 0..30 {
        found.extend(touched(&mut monitor, &rest(0.7, number)));
    }
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].change, Change::Contact);
    assert!(found[0].to_string().contains("calibrate again"));
    assert_eq!(monitor.pictures(), [0, 90]);
}

#[test]
fn a_recording_is_watched_with_what_the_calibration_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let monday = record_rest(&path("monday"), 0.3, 300, 0);
    let mut monitor = Monitor::of(&monday).expect("a monitor");
    assert!(monitor.learn_from(&monday, WORK).expect("read"));
    assert_eq!(monitor.missing(), 0);
    for (name, light, expected) in [("same", 0.3, false), ("darker", 0.28, true)] {
        let recording = record_rest(&path(name), light, 40, 5000);
        let mut monitor = monitor.clone();
        let mut found = Vec::new();
        watch(&recording, &mut monitor, WORK, &mut |sample, alarm| {
            found.push((sample.to_owned(), alarm.change));
        })
        .expect("watched");
        assert_eq!(monitor.pictures(), [40, 5]);
        assert_eq!(!found.is_empty(), expected, "{name}: {found:?}");
        assert!(
            found.iter().all(|(sample, _)| sample.starts_with("rest-")),
            "{found:?}"
        );
    }
    // Without untouched pictures of the calibration, the first pictures of the recording are learnt.
    let few = record_rest(&path("few"), 0.3, 20, 8000);
    let mut monitor = Monitor::of(&few).expect("a monitor");
    assert!(!monitor.learn_from(&few, WORK).expect("read"));
    let refused = watch(&few, &mut monitor, WORK, &mut |_, _| {});
    let said = refused.expect_err("too few").to_string();
    assert!(
        said.contains("20 untouched pictures with a label, expected at least 280"),
        "{said}"
    );
    watch(&monday, &mut monitor, WORK, &mut |_, alarm| {
        panic!("{alarm}")
    })
    .expect("watched");
}

#[test]
fn a_calibration_with_120_untouched_pictures_sets_the_limits_and_one_with_fewer_decides_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let some = record_rest(&path("some"), 0.3, 120, 0);
    let mut monitor = Monitor::of(&some).expect("a monitor");
    assert_eq!(monitor.calibration_pictures(), None);
    assert!(monitor.learn_from(&some, WORK).expect("read"));
    assert_eq!(monitor.calibration_pictures(), Some(120));
    assert_eq!((monitor.missing(), monitor.pictures()), (0, [0, 0]));
    let smallest = monitor.smallest().expect("limits");
    assert!(smallest.iter().all(|least| *least < 1.0), "{smallest:?}");
    for number in 0..30 {
        assert!(!monitor.is_decided());
        assert!(passes(&mut monitor, &rest(0.3, 5000 + number)).is_empty());
    }
    assert!(monitor.is_decided());
    let mut found = Vec::new();
    for number in 0..30 {
        found.extend(passes(&mut monitor, &rest(0.28, 6000 + number)));
    }
    let found: Vec<Change> = found.into_iter().map(|alarm| alarm.change).collect();
    assert!(found.contains(&Change::Brightness), "{found:?}");
    // The first watched pictures set the limits, in whatever light.
    let few = record_rest(&path("few"), 0.3, 99, 8000);
    let mut monitor = Monitor::of(&few).expect("a monitor");
    assert!(!monitor.learn_from(&few, WORK).expect("read"));
    assert_eq!(monitor.missing(), Monitor::PICTURES);
    let darker = record_rest(&path("darker"), 0.28, 300, 9000);
    let watched = watch(&darker, &mut monitor, WORK, &mut |_, _| {});
    watched.expect("watched");
    assert!(!monitor.is_decided(), "{:?}", monitor.found());
}

#[test]
fn repeats_in_the_calibration_are_no_change() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let calibration = record_rests(&path("read twice"), 600, |number| rest(0.3, number / 2));
    let mut monitor = Monitor::of(&calibration).expect("a monitor");
    assert!(monitor.learn_from(&calibration, WORK).expect("read"));
    for number in 0..30 {
        let found = passes(&mut monitor, &rest(0.3, 5000 + number / 2));
        assert!(found.is_empty(), "{number}: {found:?}");
    }
}

#[test]
fn a_monitor_refuses_what_it_cannot_compare() {
    for contact in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Monitor::new(rest(0.3, 1), contact);
        let said = refused.expect_err("no unit").to_string();
        assert!(said.contains("expected a share of full scale"), "{said}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let bare = record_with(&path("bare"), None, press);
    let said = Monitor::of(&bare).expect_err("no reference").to_string();
    assert!(said.contains("the recording has no reference"), "{said}");
    let still = record_with(&path("still"), Some(press(0.0, 0.0, 1)), |_, _, _| {
        press(0.0, 0.0, 1)
    });
    let said = Monitor::of(&still).expect_err("no contact").to_string();
    assert!(said.contains("no picture of contact differs"), "{said}");
    let mut monitor = Monitor::new(rest(0.3, 1), CONTACT).expect("a monitor");
    let wide = picture([48, HEIGHT], PixelFormat::Gray8, |_, _| 0.3);
    for refused in [monitor.untouched(&wide), monitor.touched(&wide)] {
        let said = refused.expect_err("another size").to_string();
        assert!(
            said.contains("48") && said.contains("calibrate again"),
            "{said}"
        );
    }
    assert_eq!(monitor.pictures(), [0, 0]);
}
