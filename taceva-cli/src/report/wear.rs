//! Tables of errors over the life of a gel.

use taceva_metrics::elementary::exponential;
use taceva_report::{Cell, Column, Table, main_channels};
use taceva_stress::{ChannelWear, Estimate, GelWear, WearBy, WearReport};

use super::stress::{cell, phrase, short};

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
            let place = match report.by {
                WearBy::Presses => of.presses_since_gel.map(|presses| presses.to_string()),
                WearBy::Date => of.day.map(|day| day.to_string()),
            };
            let numbers = [place, of.stimulus.map(short)];
            let mut cells = vec![
                Cell::text(gel.gel.as_str()),
                Cell::text(of.recording.as_str()),
            ];
            cells.extend(numbers.map(|of| Cell::Number(of.unwrap_or_else(|| NONE.to_owned()))));
            let errors = channels.iter().map(|name| of.mae.get(*name));
            cells.extend(errors.map(|mae| mae.map_or_else(|| Cell::text(NONE), cell)));
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
    table.note_all(report.notes.iter().cloned());
    table.note_all(report.not_measured.as_deref());
    table
}

fn unit<'a>(report: &'a WearReport, channel: &str) -> &'a str {
    report.units.get(channel).copied().unwrap_or("")
}

/// Sentence on an error over the life of a gel: its growth, when it meets its limit, and the first recording that differs.
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
                format!("; unknown when the limit {amount} is met: {reason}")
            }
        });
    }
    let different = match &of.first_different {
        Some(recording) => format!("the first recording with another error is {recording}"),
        None => "no recording is shown to have another error than the first".to_owned(),
    };
    format!("Gel {}, {name}: {words}; {different}.", gel.gel)
}

/// Table for programs: one row for each recording and channel, with the growth of the channel, in shortest round-trip form.
pub(crate) fn numbers(report: &WearReport) -> Table {
    const COLUMNS: &str = "gel recording presses_since_gel day stimulus channel unit mae ci95_low ci95_high difference difference_low \
                           difference_high p slope slope_low slope_high met_at not_before source";
    let mut table = Table::new("Errors over the life of gels", COLUMNS.split(' '));
    let ends =
        |ends: Option<[f64; 2]>| [0_usize, 1].map(|end| Cell::exact(ends.map(|ends| ends[end])));
    for gel in &report.gels {
        for of in &gel.recordings {
            for (channel, mae) in &of.mae {
                let difference = of.differences.get(channel).cloned().unwrap_or_default();
                let growth = gel.channels.get(channel);
                let slope = growth.map(|of| of.slope);
                let limit = growth.and_then(|of| of.limit);
                let presses = of.presses_since_gel.map(|of| of.to_string());
                let day = of.day.map(|day| day.to_string());
                let mut cells = vec![
                    Cell::text(gel.gel.as_str()),
                    Cell::text(of.recording.as_str()),
                    Cell::Number(presses.unwrap_or_default()),
                    Cell::text(day.unwrap_or_default()),
                    Cell::exact(of.stimulus),
                    Cell::text(channel.as_str()),
                    Cell::text(unit(report, channel)),
                    Cell::exact(mae.value),
                ];
                cells.extend(ends(mae.ci95));
                cells.push(Cell::exact(difference.value));
                cells.extend(ends(difference.interval));
                cells.push(Cell::exact(difference.p));
                cells.push(Cell::exact(slope.and_then(|of| of.value)));
                cells.extend(ends(slope.and_then(|of| of.ci95)));
                cells.push(Cell::exact(limit.and_then(|of| of.at)));
                cells.push(Cell::exact(limit.and_then(|of| of.not_before)));
                cells.push(Cell::text(of.source.as_str()));
                table.push(cells);
            }
        }
    }
    table
}
