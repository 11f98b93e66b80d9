//! A benchmark of models as rows.

use crate::listing::Listing;
use crate::number::{Printed, numeral};
use crate::results::{ModelBench, ModelRow};

impl ModelBench {
    /// A row a model: what it takes, and the error of each channel with its interval.
    pub fn listing(&self) -> Listing {
        let channels = self.channels();
        let mut head = ["model", "fit (s)", "predict (s)", "a frame (ms)"]
            .map(str::to_owned)
            .to_vec();
        let unit = |channel: &&str| {
            let mut errors = self.rows.iter().filter_map(|row| row.error(channel));
            errors
                .next()
                .map_or_else(String::new, |error| format!(" ({})", error.unit))
        };
        head.extend(
            channels
                .iter()
                .map(|channel| format!("MAE {channel}{}", unit(channel))),
        );
        let recording = &self.recording;
        let mut listing = Listing {
            caption: format!("Models on {}, {}", recording.name, recording.sensor),
            head,
            rows: self.rows.iter().map(|row| row.cells(&channels)).collect(),
            notes: Vec::new(),
        };
        if self.is_simulated() {
            let source = &recording.source;
            listing.notes.push(format!(
                "Nothing here was measured: the samples are {source}."
            ));
        }
        listing.notes.push(format!(
            "Fitted on {} samples, scored on {}, split {}; {}, {} of {} cores. Intervals of 95 % by contact point.",
            recording.train, recording.test, recording.split, self.machine.cpu, self.machine.threads, self.machine.cores
        ));
        let failed = self
            .rows
            .iter()
            .filter_map(|row| Some((&row.model, row.failed.as_ref()?)));
        listing
            .notes
            .extend(failed.map(|(model, why)| format!("{model}: {why}")));
        listing
    }
}

impl ModelRow {
    fn cells(&self, channels: &[&str]) -> Vec<String> {
        let times = [self.fit_s, self.predict_s, self.latency_s * 1e3];
        // A model that failed took no time that means anything.
        let time = |time: f64| match self.failed {
            Some(_) => "–".to_owned(),
            None => numeral(time),
        };
        let name = format!("{} {}", self.model, self.settings);
        let mut cells = vec![name.trim_end().to_owned()];
        cells.extend(times.map(time));
        let error = |channel: &&str| match self.error(channel) {
            None => "–".to_owned(),
            Some(error) => Printed::number(error.mae, error.ci95).phrase(""),
        };
        cells.extend(channels.iter().map(error));
        cells
    }
}
