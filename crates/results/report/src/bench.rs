//! Model benchmarks as table rows.

use taceva_core::counted;
use taceva_metrics::Better;
use taceva_results::not_measured;

use crate::number::{FormattedValue, numeral};
use crate::results::{ModelBench, ModelRow};
use crate::table::{Column, Direction, Table};

impl ModelBench {
    /// Table with one row for each model: its times, and the error of each channel with its interval.
    pub fn table(&self) -> Table {
        // Lower is better for times and errors.
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
        table.note_all(not_measured([recording.source.as_str()]));
        table.note(format!(
            "Fitted on {}, scored on {}, split {}; {}, {} of {}. Intervals of 95 % by contact point.",
            counted(recording.train, "sample"), recording.test, recording.split, self.machine.cpu, self.machine.threads, counted(self.machine.cores, "core")
        ));
        table.note(
            "front of: channels on which a test shows that every model with a faster fit has a larger error.",
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
        // The times of a failed model have no meaning.
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
