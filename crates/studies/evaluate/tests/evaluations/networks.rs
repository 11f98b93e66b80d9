//! Networks over grids of taxels.

use taceva_core::{
    Channel, Channels, Clock, PressOutcome, Readings, Sample, SignalInfo, Signals, Stamp, Unit,
};
use taceva_dataset::{
    Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source,
};
use taceva_evaluate::fit;
use taceva_models::{ModelSettings, Models};

use crate::taxel_drawing::{Draws, record};
use crate::taxels::{WORK, evaluated, r2_of, request};

/// A skin of 8 × 8 pressure taxels; each sample has a pressure bump of 1 kPa/N at some place.
fn pressed(path: &std::path::Path) -> Dataset {
    let info = SignalInfo::new(8, 8, 1, Unit::Kilopascal).expect("sixty-four");
    let facts = RecordingFacts::new(
        Source::Synthetic,
        Clock::Monotonic,
        SensorFacts::new("a drawn skin"),
    );
    let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
    let spec = RecordingSpec::new(facts, channels)
        .with_signals(SignalsSpec::new(info, ["pressure"]).expect("one name"));
    let mut recorder = Recorder::create(path, &spec).expect("new");
    let mut draws = Draws(2);
    let samples: Vec<Sample> = (0..250_u16)
        .map(|row| {
            let [x, y] = [(); 2].map(|()| 3.5 + 2.5 * draws.next());
            let force = 3.0 + 2.0 * draws.next();
            let values = (0..64_u8).map(|place| {
                let (column, line) = (f64::from(place % 8), f64::from(place / 8));
                let square = (column - x).powi(2) + (line - y).powi(2);
                let pressure = force / (1.0 + square) + 0.02 * draws.next();
                #[expect(clippy::cast_possible_truncation, reason = "signals are single")]
                let pressure = pressure as f32;
                pressure
            });
            let signals = Signals::new(info, values.collect()).expect("finite");
            Sample::new(format!("s{row}"))
                .with_truth(Readings::from_values([x, force]))
                .with_stamp(Stamp {
                    valid_s: f64::from(row),
                    received_s: None,
                })
                .with_signals(signals)
        })
        .collect();
    let recorded = recorder.append_press("press", PressOutcome::Complete, &samples);
    recorded.expect("recorded");
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

#[test]
fn a_network_learns_place_and_force_from_a_grid_and_does_nothing_to_it_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = pressed(&folder.path().join("data"));
    let found = evaluated(&dataset, "cnn", &["epochs=40"]).expect("evaluated");
    let model = found.report.provenance.model.as_ref().expect("a model");
    // Comparisons name a model with a seed that was trained once.
    assert_eq!(model.settings.get("seed").map(String::as_str), Some("1"));
    for channel in ["Px", "Fz"] {
        assert!(
            r2_of(&found, channel) > 0.9,
            "{channel}: {}",
            r2_of(&found, channel)
        );
    }
    let fitted = fit(&dataset, &request("cnn", &["epochs=1"]), None, WORK).expect("fitted");
    let network = fitted.model.card().network.clone().expect("a network");
    assert!(!network.preprocessing.contrast && network.preprocessing.local_mean_px <= 0.0);
    let asked = request("cnn", &["epochs=1", "contrast=true"]);
    let fitted = fit(&dataset, &asked, None, WORK).expect("fitted");
    let network = fitted.model.card().network.clone().expect("a network");
    assert!(network.preprocessing.contrast);
}

#[test]
fn a_preset_asks_nothing_of_frames_where_there_are_none_and_leaves_signals_as_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = pressed(&folder.path().join("data"));
    let none = ModelSettings::parse(["epochs=1"]).expect("a pair");
    let (_, settings) = Models::builtin().asked("fast", none).expect("a preset");
    let words: Vec<String> = settings.words().collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    assert!(words.contains(&"size=up-to-80x60"), "{words:?}");
    let preset = fit(&dataset, &request("cnn", &words), None, WORK).expect("fitted");
    let plain = fit(&dataset, &request("cnn", &["epochs=1"]), None, WORK).expect("fitted");
    let network = |fitted: &taceva_evaluate::Fitted| fitted.model.card().network.clone();
    assert_eq!(network(&preset), network(&plain));
}

#[test]
fn a_grid_that_is_too_narrow_for_a_network_is_refused_with_its_size_and_auto_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), 100);
    let message = evaluated(&dataset, "cnn", &[])
        .expect_err("refused")
        .to_string();
    let said = "a network needs a grid of at least 8×8 places, found 5×1 places of 3 in uT; every other model accepts it";
    assert_eq!(message, said);
    let fitted = fit(&dataset, &request("auto", &[]), None, WORK).expect("fitted");
    let auto = fitted.model.card().auto.clone().expect("a choice");
    let cnn = auto.untried.iter().find(|untried| untried.model == "cnn");
    assert_eq!(cnn.expect("named").reason, said);
}
