//! Synthetic recordings of taxels.

use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, Readings, Sample, SignalInfo, Signals, Stamp, Unit, single,
};
use taceva_dataset::{
    Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source,
};
use taceva_models::Model;
use taceva_stress::{Fault, TAXEL_FAULTS, TIME_FAULTS};

use crate::drawing::{PRESSES, fitted};

/// Number of rows without contact at the beginning of a recording.
const REST: u32 = 10;
/// Number of rows of taxels, of taxels in a row, and of channels of a taxel.
const GRID: [u32; 3] = [4, 5, 2];

/// Fault with the name `id`.
pub(crate) fn fault(id: &str) -> &'static Fault {
    let mut faults = TAXEL_FAULTS.into_iter().chain(TIME_FAULTS);
    faults.find(|fault| fault.id == id).expect("in the list")
}

/// Signals of all taxels. `number` gives each value from its index.
pub(crate) fn signals(number: impl Fn(u32) -> f32) -> Signals {
    let [rows, columns, channels] = GRID;
    let info = SignalInfo::new(rows, columns, channels, Unit::Microtesla).expect("a grid");
    let numbers = (0..rows * columns * channels).map(number);
    Signals::new(info, numbers.collect()).expect("whole")
}

/// Signals of a press, in µT. Each axis of a taxel has its own offset and gain.
pub(crate) fn pressed(force: f64, place: f64, noise: u32) -> Signals {
    let [_, columns, channels] = GRID;
    signals(|position| {
        let (taxel, channel) = (position / channels, f64::from(position % channels));
        let across = 2.0 + 4.0 * f64::from(taxel % columns) - place;
        let down = 1.0 + f64::from(taxel / columns) / 4.0;
        let response = (channel + 1.0) * 10.0 * force * down * (-across * across / 60.0).exp();
        let flicker = f64::from((position * 7919 + noise * 104_729) % 7) / 50.0;
        single(300.0 + 20.0 * channel + response + flicker)
    })
}

/// Options of a synthetic recording.
pub(crate) struct Drawn {
    /// Time between two rows, s.
    pub(crate) step_s: Option<f64>,
    /// True if the recording declares its rows without contact.
    pub(crate) has_rest: bool,
    /// True if the recording has labels of the force and of the position, false for the position only.
    pub(crate) has_force: bool,
}

pub(crate) const WHOLE: Drawn = Drawn {
    step_s: Some(0.01),
    has_rest: true,
    has_force: true,
};

/// Creates a recording of taxels: rows without contact, then twelve contact points with five forces each.
pub(crate) fn record(path: &Path, noise: u32, of: &Drawn) -> Dataset {
    let info = pressed(0.0, 0.0, 0).info();
    let taxels = SignalsSpec::new(info, ["x", "z"]).expect("two names");
    let rest = of.has_rest.then_some([0, u64::from(REST) - 1]);
    let clock = match of.step_s {
        Some(_) => Clock::Monotonic,
        None => Clock::Unknown,
    };
    let sensor = SensorFacts::new("drawn skin")
        .with_serial("1")
        .with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, clock, sensor);
    let count = if of.has_force { 2 } else { 1 };
    let channels = [Channel::PX, Channel::FZ].into_iter().take(count);
    let channels = Channels::new(channels).expect("distinct");
    let spec = RecordingSpec::new(facts, channels).with_signals(taxels.with_rest(rest));
    let mut recorder = Recorder::create(path, &spec).expect("new");
    for number in 0..REST + PRESSES {
        let (point, force) = match number.checked_sub(REST) {
            None => (20, 0.0),
            Some(press) => (press / 5, 0.4 + 0.4 * f64::from(press % 5)),
        };
        let place = 4.0 + f64::from(point * 7 % 12) * 1.4;
        let stamp = of.step_s.map(|step| Stamp {
            valid_s: step * f64::from(number),
            received_s: None,
        });
        let sample = Sample::new(format!("s{number:02}"))
            .with_point_id(format!("p{point}"))
            .with_stamp(stamp)
            .with_signals(pressed(force, place, number * 10 + noise))
            .with_truth(Readings::from_values(
                [place / 2.0, force].into_iter().take(count),
            ));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

/// Recording that the returned model has not seen, and a model of signals.
pub(crate) fn skin(folder: &Path, settings: &[&str]) -> (Dataset, Model) {
    let seen = record(&folder.join("seen"), 1, &WHOLE);
    let model = fitted(&seen, "ridge", settings);
    (record(&folder.join("unseen"), 2, &WHOLE), model)
}
