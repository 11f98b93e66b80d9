//! A synthetic recording of taxels, identical to the last bit to the output of `reference.py`.

use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, PressOutcome, Readings, Sample, SignalInfo, Signals, Stamp, Unit,
};
use taceva_dataset::{
    Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source,
};

/// Rows of taxels, taxels in a row and values of a taxel, as in the magnetometers of eFlesh.
pub(crate) const GRID: [u32; 3] = [5, 1, 3];
/// Number of rows without contact.
pub(crate) const REST: u32 = 40;

/// Numbers from −1 to 1: the upper bits of a linear congruential sequence.
pub(crate) struct Draws(pub(crate) u64);

impl Draws {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let upper = u32::try_from(self.0 >> 32).expect("32 bits");
        f64::from(upper) / 2_147_483_648.0 - 1.0
    }
}

/// A force in N and fifteen signals in µT. Each signal is its own quadratic function of the force plus an offset and noise.
#[expect(
    clippy::cast_possible_truncation,
    reason = "signals are kept in single precision"
)]
pub(crate) fn sample(row: u32, draws: &mut Draws) -> (f64, Vec<f32>) {
    let drawn = 5.0 + 5.0 * draws.next();
    let force = if row < REST { 0.0 } else { drawn };
    let values = (0..15_u32).map(|place| {
        let place = f64::from(place);
        let line = (place + 1.0) * force;
        let bend = (7.0 - place) * force * force / 16.0;
        let noise = 2.0 * draws.next();
        (300.0 + line + bend + noise) as f32
    });
    (force, values.collect())
}

/// Records `rows` samples in the folder `path`, 0.01 s apart, in batches of several hundred.
pub(crate) fn record(path: &Path, rows: u32) -> Dataset {
    record_changed(path, rows, |_, values| values)
}

/// Like [`record`], with the signals of each row replaced by `change`.
pub(crate) fn record_changed(
    path: &Path,
    rows: u32,
    change: impl Fn(u32, Vec<f32>) -> Vec<f32>,
) -> Dataset {
    let [height, width, depth] = GRID;
    let info = SignalInfo::new(height, width, depth, Unit::Microtesla).expect("fifteen numbers");
    let spec = SignalsSpec::new(info, ["x", "y", "z"]).expect("three names");
    let facts = RecordingFacts::new(
        Source::Synthetic,
        Clock::Monotonic,
        SensorFacts::new("a drawn skin"),
    );
    let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"))
        .with_signals(spec.with_rest([[0, u64::from(REST) - 1]]));
    let mut recorder = Recorder::create(path, &spec).expect("new");
    let mut draws = Draws(1);
    let samples: Vec<Sample> = (0..rows)
        .map(|row| {
            let (force, values) = sample(row, &mut draws);
            let signals = Signals::new(info, change(row, values)).expect("finite");
            Sample::new(format!("s{row:05}"))
                .with_truth(Readings::from_values([force]))
                .with_stamp(Stamp {
                    valid_s: f64::from(row) / 100.0,
                    received_s: None,
                })
                .with_signals(signals)
        })
        .collect();
    for (number, some) in samples.chunks(900).enumerate() {
        let press = format!("press {number}");
        recorder
            .append_press(&press, PressOutcome::Complete, some)
            .expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}
