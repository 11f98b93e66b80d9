//! Recordings of synthetic presses, and models that are fitted to them.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, Date, Frame, FrameInfo, PixelFormat, Readings, Sample, SilentProgress,
};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_evaluate::{FitRequest, Work, fit};
use taceva_models::{Model, ModelSettings, Models};

pub(crate) const WIDTH: u32 = 24;
pub(crate) const HEIGHT: u32 = 16;
/// Number of presses of a recording: twelve contact points with five forces each.
pub(crate) const PRESSES: u32 = 60;

pub(crate) const WORK: Work<'static> = Work {
    jobs: NonZeroUsize::MIN,
    progress: &SilentProgress,
    cache: None,
};

/// Draws a picture of `format`. `light` gives the value of each pixel, as a fraction of full scale, from its column and row.
pub(crate) fn picture(
    [width, height]: [u32; 2],
    format: PixelFormat,
    light: impl Fn(u32, u32) -> f64,
) -> Frame {
    let info = FrameInfo {
        width,
        height,
        format,
    };
    let mut bytes = Vec::new();
    for place in 0..width * height {
        let share = light(place % width, place / width);
        for _ in 0..format.samples() {
            let number = (0..=format.full_scale())
                .find(|number| f64::from(*number) >= share * f64::from(format.full_scale()));
            let number = number.unwrap_or(format.full_scale()).to_le_bytes();
            bytes.extend_from_slice(&number[..format.bytes_per_sample()]);
        }
    }
    Frame::new(info, bytes).expect("whole")
}

/// Draws the picture of a press of `force` at the column `place`. `number` selects the pixel noise.
pub(crate) fn press(force: f64, place: f64, number: u32) -> Frame {
    picture([WIDTH, HEIGHT], PixelFormat::Gray8, |x, y| {
        let (across, down) = (f64::from(x) - place, f64::from(y) - 8.0);
        let blob = force * (-(across * across + down * down) / 12.0).exp();
        let noise = (x * 7919 + y * 104_729 + number * 1_299_709) % 5;
        0.3 + f64::from(x) / 300.0 + 0.2 * blob + f64::from(noise) / 500.0
    })
}

/// Creates a recording at `path`. Recordings with different `noise` share no picture.
pub(crate) fn record(path: &Path, noise: u32) -> Dataset {
    record_with(
        path,
        Some(press(0.0, 0.0, 900 + noise)),
        |force, place, number| press(force, place, number * 10 + noise),
    )
}

/// Unit, gel and age of a recording.
pub(crate) struct Age {
    pub(crate) serial: &'static str,
    pub(crate) gel: &'static str,
    pub(crate) presses: Option<u32>,
    pub(crate) recorded_on: Option<Date>,
}

/// Creates a recording. `draw` makes each picture from a force, a position and a number.
pub(crate) fn record_with(
    path: &Path,
    reference: Option<Frame>,
    draw: impl Fn(f64, f64, u32) -> Frame,
) -> Dataset {
    let age = Age {
        serial: "1",
        gel: "1",
        presses: None,
        recorded_on: None,
    };
    record_aged(path, &age, reference, draw)
}

/// Creates a recording as [`record_with`] does, with the unit, the gel and the age `age`.
pub(crate) fn record_aged(
    path: &Path,
    age: &Age,
    reference: Option<Frame>,
    draw: impl Fn(f64, f64, u32) -> Frame,
) -> Dataset {
    let sensor = SensorFacts::new("drawn")
        .with_serial(age.serial)
        .with_gel(age.gel)
        .with_presses_since_gel(age.presses);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor)
        .with_recorded_on(age.recorded_on);
    let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
    let mut recorder = Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new");
    if let Some(reference) = &reference {
        recorder.append_reference(reference).expect("recorded");
    }
    for number in 0..PRESSES {
        let point = number / 5;
        let place = 4.0 + f64::from(point * 7 % 12) * 1.4;
        let force = 0.4 + 0.4 * f64::from(number % 5);
        let sample = Sample::new(format!("s{number:02}"))
            .with_point_id(format!("p{point}"))
            .with_frame(draw(force, place, number))
            .with_truth(Readings::from_values([place / 2.0, force]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

/// Fits the model `model` to `dataset`.
pub(crate) fn fitted(dataset: &Dataset, model: &str, settings: &[&str]) -> Model {
    let request = FitRequest {
        model: Models::builtin().find(model).expect("a model"),
        settings: ModelSettings::parse(settings.iter().copied()).expect("settings"),
        channels: Vec::new(),
        split: Some("by-point".to_owned()),
        seed: 0,
    };
    fit(dataset, &request, None, WORK).expect("fitted").model
}

/// Recording that the returned model has not seen. The model reads differences from the untouched picture.
pub(crate) fn unseen(folder: &Path) -> (Dataset, Model) {
    let seen = record(&folder.join("seen"), 1);
    let model = fitted(&seen, "ridge", &["size=8x8", "difference=true"]);
    (record(&folder.join("unseen"), 2), model)
}
