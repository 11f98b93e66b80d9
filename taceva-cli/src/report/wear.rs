//! Tables of errors over the life of a gel.

use taceva_metrics::elementary::exponential;
use taceva_report::{Cell, Column, Table};
use taceva_stress::{
    ChannelWear, Estimate, GelWear, LimitMet, RecordingWear, WearBy, WearDifference, WearReport,
};

use super::stress::{cell, main_channels, phrase, short};

const NONE: &str = "–";

/// Table for readers: a row for each recording, with the errors of the main channels.
pub(crate) fn table(report: &WearReport) -> Table {
    let channels = main_channels(&report.units);
    let place = match report.by {
        WearBy::Presses => "presses",
        WearBy::Date => "day",
    };
    let mut columns = ["gel", "recording", place, "stimulus"]
        .map(Column::new)
        .to_vec();
    let heads = channels.iter();
    columns.extend(heads.map(|name| Column::new(*name).unit(unit(report, name))));
    let caption = format!(
        "Mean absolute errors of recordings of {}, serial number {}, with 95 % intervals",
        report.subject.sensor, report.subject.serial
    );
    let mut table = Table::new(caption, columns);
    for gel in &report.gels {
        for of in &gel.recordings {
            let place = match (report.by, of.day) {
                (WearBy::Date, Some(day)) => day.to_string(),
                _ => short(of.place),
            };
            let mut cells = vec![
                Cell::text(gel.gel.as_str()),
                Cell::text(of.recording.as_str()),
                Cell::Number(place),
                Cell::Number(of.stimulus.map_or_else(|| NONE.to_owned(), short)),
            ];
            let errors = channels.iter().map(|name| {
                let mae = of.mae.get(*name);
                mae.map_or_else(|| Cell::text(NONE), cell)
            });
            cells.extend(errors);
            table.push(cells);
        }
    }
    for gel in &report.gels {
        for (name, of) in &gel.channels {
            if of.limit.is_some() || channels.contains(&name.as_str()) {
                table.note(growth(report, gel, name, of));
            }
        }
    }
    let recordings = report.gels.iter().flat_map(|gel| &gel.recordings);
    for of in recordings.filter(|of| of.untouched != "reference") {
        table.note(format!(
            "{} has no untouched picture; its change is measured from: {}.",
            of.recording, of.untouched
        ));
    }
    if let Some(words) = &report.not_measured {
        table.note(words.clone());
    }
    table
}

fn unit<'a>(report: &'a WearReport, channel: &str) -> &'a str {
    report.units.get(channel).copied().unwrap_or("")
}

/// Growth of an error, its limit and its first difference, in one sentence.
fn growth(report: &WearReport, gel: &GelWear, name: &str, of: &ChannelWear) -> String {
    let (step, axis) = (report.step, report.by.unit());
    let mut words = match of.slope.value {
        Some(slope) => {
            let factor = Estimate {
                value: Some(exponential(slope)),
                ci95: of.slope.ci95.map(|ends| ends.map(exponential)),
                reason: of.slope.reason,
            };
            let factor = phrase(&factor, "");
            format!("in {step} {axis} the error is multiplied by {factor}")
        }
        None => format!("no growth is stated: {}", phrase(&of.slope, "")),
    };
    if let Some(limit) = &of.limit {
        let amount = format!("{} {}", limit.limit, unit(report, name));
        words.push_str(&match (limit.at, limit.not_before) {
            (Some(at), Some(bound)) => format!(
                "; the limit {amount} is met at {} {axis}, and not before {} (one-sided 95 %)",
                short(at),
                short(bound)
            ),
            _ => {
                let reason = limit.reason.map(|of| of.to_string()).unwrap_or_default();
                format!("; no place is stated at which the limit {amount} is met: {reason}")
            }
        });
    }
    let different = match &of.first_different {
        Some(recording) => format!("the first that differs is {recording}"),
        None => "no recording is shown to differ from the first".to_owned(),
    };
    format!("Gel {}, {name}: {words}; {different}.", gel.gel)
}

/// Table for programs: one row for each number, in shortest round-trip form.
pub(crate) fn numbers(report: &WearReport) -> Table {
    let columns = [
        "gel",
        "recording",
        "presses_since_gel",
        "day",
        "channel",
        "quantity",
        "value",
        "unit",
        "low",
        "high",
        "reason",
        "source",
    ];
    let mut rows = Rows {
        table: Table::new("Errors over the life of gels", columns),
        source: &report.subject.source,
    };
    for gel in &report.gels {
        for of in &gel.recordings {
            let whole = Place {
                gel: &gel.gel,
                recording: Some(of),
                channel: "",
            };
            let stimulus = Estimate::of_known(of.stimulus);
            rows.push(&whole, "stimulus", &Number::of(&stimulus), "1");
            for (channel, mae) in &of.mae {
                let unit = unit(report, channel);
                let place = Place { channel, ..whole };
                rows.push(&place, "mae", &Number::of(mae), unit);
                if let Some(difference) = of.differences.get(channel) {
                    rows.push(
                        &place,
                        "difference",
                        &Number::of_difference(difference),
                        unit,
                    );
                    let p = Estimate::of_known(difference.p);
                    rows.push(&place, "p", &Number::of(&p), "1");
                }
            }
        }
        for (channel, of) in &gel.channels {
            let place = Place {
                gel: &gel.gel,
                recording: None,
                channel,
            };
            let per_step = format!("1/({} {})", report.step, report.by.unit());
            rows.push(&place, "slope", &Number::of(&of.slope), &per_step);
            if let Some(limit) = &of.limit {
                let unit = report.by.unit();
                rows.push(&place, "met_at", &Number::of_limit(limit), unit);
            }
        }
    }
    rows.table
}

/// Gel, recording and channel of a number.
#[derive(Clone, Copy)]
struct Place<'a> {
    gel: &'a str,
    recording: Option<&'a RecordingWear>,
    channel: &'a str,
}

/// A number with the ends of its interval, or the reason for an absent one.
struct Number {
    value: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    reason: String,
}

impl Number {
    fn of(of: &Estimate) -> Number {
        Number {
            value: of.value,
            low: of.ci95.map(|[low, _]| low),
            high: of.ci95.map(|[_, high]| high),
            reason: of.reason.map(|of| of.to_string()).unwrap_or_default(),
        }
    }

    fn of_difference(of: &WearDifference) -> Number {
        Number {
            value: of.value,
            low: of.interval.map(|[low, _]| low),
            high: of.interval.map(|[_, high]| high),
            reason: of.reason.clone().unwrap_or_default(),
        }
    }

    fn of_limit(of: &LimitMet) -> Number {
        Number {
            value: of.at,
            low: of.not_before,
            high: None,
            reason: of.reason.map(|of| of.to_string()).unwrap_or_default(),
        }
    }
}

/// Rows of the table for programs.
struct Rows<'a> {
    table: Table,
    source: &'a str,
}

impl Rows<'_> {
    fn push(&mut self, place: &Place<'_>, quantity: &str, of: &Number, unit: &str) {
        let number = |value: Option<f64>| {
            Cell::Number(value.map_or_else(String::new, |value| format!("{value:?}")))
        };
        let recording = place.recording;
        let presses = recording.and_then(|of| of.presses_since_gel);
        let day = recording.and_then(|of| of.day);
        self.table.push([
            Cell::text(place.gel),
            Cell::text(recording.map_or("", |of| of.recording.as_str())),
            Cell::Number(presses.map_or_else(String::new, |of| of.to_string())),
            Cell::text(day.map_or_else(String::new, |of| of.to_string())),
            Cell::text(place.channel),
            Cell::text(quantity),
            number(of.value),
            Cell::text(unit),
            number(of.low),
            number(of.high),
            Cell::text(of.reason.as_str()),
            Cell::text(self.source),
        ]);
    }
}
