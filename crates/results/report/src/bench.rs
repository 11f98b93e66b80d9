//! Benchmarks of models and of decoding as rows.

use taceva_metrics::Better;

use crate::number::{FormattedValue, numeral};
use crate::results::{DecodeBench, DecodeRow, ModelBench, ModelRow, ScaledError};
use crate::table::{Column, Direction, Table};

impl ModelBench {
    /// One row for each model: its times, and the error of each channel with its interval.
    pub fn table(&self) -> Table {
        // Times and errors alike: less is better.
        let lower = |name: String| Column::new(name).direction(Direction::Is(Better::Lower));
        let channels = self.channels();
        let mut columns = vec![Column::new("model")];
        for (name, unit) in [
            ("fit", "s"),
            ("fit", "processor s"),
            ("predict", "s"),
            ("a frame", "ms"),
        ] {
            columns.push(lower(name.to_owned()).unit(unit));
        }
        columns.extend(channels.iter().map(|channel| {
            let mut errors = self.rows.iter().filter_map(|row| row.error(channel));
            Column {
                unit: errors.next().map(|error| error.unit.to_string()),
                ..lower(format!("MAE {channel}"))
            }
        }));
        let recording = &self.recording;
        columns.push(Column::new("front of"));
        let caption = format!("Models on {}, {}", recording.name, recording.sensor);
        let mut table = Table::new(caption, columns);
        for row in &self.rows {
            table.push(row.cells(&channels));
        }
        if self.is_simulated() {
            let source = &recording.source;
            table.note(format!(
                "Nothing here was measured: the samples are {source}."
            ));
        }
        table.note(format!(
            "Fitted on {} samples, scored on {}, split {}; {}, {} of {} cores. Intervals of 95 % by contact point.",
            recording.train, recording.test, recording.split, self.machine.cpu, self.machine.threads, self.machine.cores
        ));
        table.note(
            "front of: channels on which no model takes less processor time to fit without being shown, pair by pair, to be further off.",
        );
        let rows = self.rows.iter();
        for (model, why) in rows.filter_map(|row| Some((&row.model, row.failed.as_ref()?))) {
            table.note(format!("{model}: {why}"));
        }
        table
    }
}

impl ModelRow {
    fn cells(&self, channels: &[&str]) -> Vec<String> {
        let times = [
            Some(self.fit_s),
            self.fit_cpu_s,
            Some(self.predict_s),
            Some(self.latency_s * 1e3),
        ];
        // A model that failed took no time that means anything.
        let time = |time: Option<f64>| match (time, &self.failed) {
            (Some(time), None) => numeral(time),
            (None, _) | (_, Some(_)) => "–".to_owned(),
        };
        let name = format!("{} {}", self.model, self.settings);
        let mut cells = vec![name.trim_end().to_owned()];
        cells.extend(times.map(time));
        let error = |channel: &&str| match self.error(channel) {
            None => "–".to_owned(),
            Some(error) => FormattedValue::number(error.mae, error.ci95).phrase(""),
        };
        cells.extend(channels.iter().map(error));
        let front = self.front_of().filter(|front| !front.is_empty());
        cells.push(front.map_or_else(|| "–".to_owned(), |front| front.join(" ")));
        cells
    }
}

impl DecodeBench {
    /// One row for each scale: the time to decode a frame, the error of each channel, and how much more it is than at full size.
    pub fn table(&self) -> Table {
        let known = self.rows.iter().map(|row| &row.errors);
        let known: &[ScaledError] = known
            .max_by_key(|errors| errors.len())
            .map_or(&[], |all| all);
        let lower = |name: String, unit: String| {
            let column = Column::new(name).unit(unit);
            column.direction(Direction::Is(Better::Lower))
        };
        let mut columns = vec![Column::new("scale"), Column::new("pixels")];
        columns.push(lower("decode".to_owned(), "ms".to_owned()));
        for own in known {
            let error = &own.error;
            let unit = error.unit.to_string();
            columns.push(lower(format!("MAE {}", error.channel), unit.clone()));
            columns.push(lower(format!("change of {}", error.channel), unit));
        }
        let recording = &self.recording;
        let caption = format!(
            "JPEG decoded at a fraction of its size: {}, {}",
            recording.name, recording.sensor
        );
        let mut table = Table::new(caption, columns);
        let channels: Vec<&str> = known.iter().map(|own| own.error.channel.as_str()).collect();
        for row in &self.rows {
            table.push(row.cells(&channels));
        }
        for note in self.notes() {
            table.note(note);
        }
        table
    }

    fn notes(&self) -> Vec<String> {
        let recording = &self.recording;
        let model = format!("{} {}", self.model, self.settings);
        let mut notes = Vec::new();
        if self.is_simulated() {
            let source = &recording.source;
            notes.push(format!(
                "Nothing here was measured: the samples are {source}."
            ));
        }
        notes.extend((!self.note.is_empty()).then(|| self.note.clone()));
        notes.push(format!(
            "{} fitted on {} samples, scored on {}, split {}; {}, decoded on one core of {}. Intervals of 95 % by contact point; a change is paired sample by sample.",
            model.trim_end(), recording.train, recording.test, recording.split, self.machine.cpu, self.machine.cores
        ));
        let failed = self.rows.iter();
        let failed = failed.filter_map(|row| Some((row.scale(), row.failed.as_ref()?)));
        notes.extend(failed.map(|(scale, why)| format!("{scale}: {why}")));
        notes
    }
}

impl DecodeRow {
    fn cells(&self, channels: &[&str]) -> Vec<String> {
        let pixels = format!("{}×{}", self.width, self.height);
        let mut cells = vec![self.scale(), pixels, numeral(self.decode_s * 1e3)];
        let formatted = |value: Option<f64>, ends| {
            value.map_or_else(
                || "–".to_owned(),
                |value| FormattedValue::number(value, ends).phrase(""),
            )
        };
        for channel in channels {
            let own = self.error(channel);
            let error = own.map(|own| &own.error);
            cells.push(formatted(
                error.map(|error| error.mae),
                error.and_then(|error| error.ci95),
            ));
            cells.push(formatted(
                own.and_then(|own| own.change),
                own.and_then(|own| own.change_ci95),
            ));
        }
        cells
    }
}
