//! Shows predictions of a fitted model for a running camera: over the picture of a page and on the terminal, with a final summary.

use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use taceva_acquire::{Latencies, LiveModel, Prediction, PredictionCounts};
use taceva_core::{Channel, Frame, Unit, by_count, counted, shown};
use taceva_drivers::MonotonicClock;
use taceva_live::{Live, Overlay, PredictedFrames, PredictedValue};

use super::Context;

/// Target for the delay between the stamp of a picture and its display, ms.
const SOON_MS: usize = 100;
/// Share of pictures that should meet the target.
const MOST: f64 = 0.95;

/// Reads the model at `path`, before any device is opened.
pub(super) fn read_model(path: &Path, context: &Context) -> anyhow::Result<LiveModel> {
    Ok(LiveModel::new(context.models()?.open(path)?, path)?)
}

/// Receiver of predictions that shows them on a page and on the terminal.
pub(super) struct LivePredictions<'a> {
    model: &'a LiveModel,
    page: Live,
    /// Newest prediction as text.
    latest: Mutex<String>,
    /// Latencies, ms, from the stamp of a frame until its picture was sent to a browser.
    sent: Arc<Mutex<Latencies>>,
}

impl<'a> LivePredictions<'a> {
    /// Shows predictions of `model` on `page`, with the name of the model.
    pub(super) fn new(model: &'a LiveModel, page: Live, context: &Context) -> LivePredictions<'a> {
        let words = by(model);
        page.predictor(&words);
        let sent: Arc<Mutex<Latencies>> = Arc::default();
        let heard = Arc::clone(&sent);
        page.on_sent(move |stamp_s| {
            lock(&heard).add(MonotonicClock.now_s() - stamp_s);
        });
        context.say(format_args!("predicted, not measured, by {words}"));
        if !model.knows_distance() {
            context.say(format_args!(
                "{} has no record of its training pictures (fitted by an earlier TacEva, or on fewer than 20 samples): unfamiliar pictures are not marked; fit the model again",
                shown(model.path())
            ));
        }
        LivePredictions {
            model,
            page,
            latest: Mutex::default(),
            sent,
        }
    }

    pub(super) fn show(&self, frame: &Frame, prediction: &Prediction, counts: &PredictionCounts) {
        let channels = self.model.channels().iter().zip(&prediction.values);
        let values = channels.clone().map(|(channel, value)| {
            PredictedValue::new(channel.name(), *value, channel.unit().symbol())
        });
        let overlay = Overlay::new(prediction.stamp_s, values.collect());
        let overlay = match (prediction.distance, prediction.is_outside()) {
            (Some(distance), Some(outside)) => overlay.with_distance(distance, outside),
            _ => overlay,
        };
        self.page.predicted(frame, overlay);
        let frames = PredictedFrames::new(counts.seen, counts.dropped, counts.outside);
        self.page.predicted_frames(frames);
        *lock(&self.latest) = in_words(channels, prediction);
    }

    /// Newest prediction as text: `predicted Fz 1.25 N, Pz 0.412 mm`.
    pub(super) fn line(&self) -> String {
        lock(&self.latest).clone()
    }

    /// Prints the statistics of the frames, also after an error.
    pub(super) fn summarise(&self, counts: &PredictionCounts, context: &Context) {
        for line in summary(self.model, counts, &lock(&self.sent)) {
            context.say(format_args!("{line}"));
        }
    }
}

/// Name of the model with digest and file: `ridge sha256:0123456789ab (presses.taceva)`.
fn by(model: &LiveModel) -> String {
    let digest = model.digest().to_string();
    let short = digest.get(..19).unwrap_or(&digest);
    format!("{} {short} ({})", model.name(), shown(model.path()))
}

fn in_words<'c>(
    channels: impl Iterator<Item = (&'c Channel, &'c f64)>,
    prediction: &Prediction,
) -> String {
    let values: Vec<String> = channels
        .map(|(channel, value)| {
            let name = shown(channel.name());
            match channel.unit() {
                Unit::Newton => format!("{name} {value:.2} N"),
                Unit::One => format!("{name} {value:.3}"),
                unit => format!("{name} {value:.3} {unit}"),
            }
        })
        .collect();
    let outside = match (prediction.is_outside(), prediction.distance) {
        (Some(true), Some(distance)) => {
            format!(", unlike the training pictures: distance {distance:.1}, limit 1")
        }
        _ => String::new(),
    };
    format!("predicted {}{outside}", values.join(", "))
}

fn summary(model: &LiveModel, counts: &PredictionCounts, sent: &Latencies) -> Vec<String> {
    let mut lines = vec![format!(
        "predictions by {}: {} seen, {} shown, {} dropped for newer frames",
        by(model),
        counted(counts.seen, "frame"),
        counts.predicted,
        counts.dropped
    )];
    if counts.latencies.count() > 0 {
        lines.push(format!("predicted {}", soon(&counts.latencies)));
    }
    match sent.count() {
        0 => lines.push("no picture was sent to a browser".to_owned()),
        count => lines.push(format!(
            "{} {} sent to a browser, {}",
            counted(count, "picture"),
            by_count(count, "was", "were"),
            soon(sent)
        )),
    }
    let share = |outside: u64| 100.0 * outside as f64 / counts.predicted.max(1) as f64;
    lines.push(match counts.outside {
        Some(outside) => format!(
            "{outside} of {} ({:.1} %) were unlike the training pictures",
            counts.predicted,
            share(outside)
        ),
        None => "the number of pictures unlike the training pictures is unknown".to_owned(),
    });
    lines
}

/// Latencies as text: `95 % within 43 ms of their stamps, 99.8 % within 100 ms`.
fn soon(latencies: &Latencies) -> String {
    let within = latencies.within_ms(MOST);
    let within = within.map_or_else(|| "2 s or longer".to_owned(), |ms| format!("{ms} ms"));
    let share = 100.0 * latencies.share_within(SOON_MS).unwrap_or_default();
    format!(
        "{:.0} % within {within} of their stamps, {share:.1} % within {SOON_MS} ms",
        100.0 * MOST
    )
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
