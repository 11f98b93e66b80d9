//! Tables of the errors of a model on inputs with faults.

mod numbers;
mod remarks;

use taceva_core::counted;
use taceva_metrics::p_words;
use taceva_report::{Cell, Column, FormattedValue, Table, main_channels};
use taceva_stress::{By, Estimate, FaultReport, NEVER, StressReport, Undefined};

pub(crate) use self::numbers::numbers;
use self::remarks::{missed_targets, other_metrics, reference_tests, unshown_skill};

/// Table for readers with one row for each fault and severity: ratios of the error with the fault to the error without the fault.
pub(crate) fn table(report: &StressReport) -> Table {
    let channels = main_channels(&report.clean);
    let mut columns = vec![
        Column::new("fault"),
        Column::new("severity"),
        Column::new("parameter"),
        Column::new("stimulus"),
    ];
    columns.extend(channels.iter().map(|name| Column::new(*name)));
    columns.push(Column::new("check finds"));
    let mut table = Table::new(caption(report), columns);
    for fault in &report.faults {
        for of in &fault.severities {
            let mut cells = vec![
                Cell::text(fault.id.as_str()),
                Cell::Number(of.severity.to_string()),
                Cell::Number(short(of.parameter)),
                Cell::Number(of.stimulus.map_or_else(|| "–".to_owned(), short)),
            ];
            let ratios = channels.iter().map(|name| {
                let score = of.stale.get(*name);
                score.map_or_else(|| Cell::text("–"), |score| cell(&score.degradation))
            });
            cells.extend(ratios);
            let is_checked = report.unnoticed.is_some() && !fault.keeps_inputs();
            cells.push(Cell::text(match is_checked || !of.check.is_empty() {
                true => of.check.join(" "),
                false => "–".to_owned(),
            }));
            table.push(cells);
        }
    }
    table.note_all(notes(report, &channels));
    table
}

fn caption(report: &StressReport) -> String {
    let by = match report.by {
        By::Stimulus => "stimulus",
        By::Parameter => "parameter",
    };
    let cells = report.faults.iter().flat_map(|fault| &fault.severities);
    let mut scores = cells.flat_map(|of| of.stale.values());
    let intervals = match scores.any(|score| score.degradation.ci95.is_some()) {
        true => ", with 95 % intervals",
        false => "",
    };
    format!(
        "Mean absolute errors with faults, divided by the errors without faults{intervals}: faults {}, severity by {by}, seed {}{}, {} samples of the part {}",
        report.list.name,
        report.seed,
        match report.draws {
            1 => String::new(),
            draws => format!(", {draws} draws of places"),
        },
        report.samples,
        report.provenance.part.as_deref().unwrap_or("all")
    )
}

/// Remarks below the table, as complete sentences.
fn notes(report: &StressReport, channels: &[&str]) -> Vec<String> {
    let mut notes = Vec::new();
    let inputs = match report.input {
        "signals" => "signals",
        _ => "pictures",
    };
    let clean = channels.iter().filter_map(|name| {
        let mae = phrase(&report.clean.get(*name)?.mae, report.units.get(*name)?);
        Some(format!("{name} {mae}"))
    });
    let clean: Vec<String> = clean.collect();
    notes.push(format!("Error without a fault: {}.", clean.join(", ")));
    let skills = channels
        .iter()
        .filter_map(|name| Some((*name, report.clean.get(*name)?.skill)));
    notes.extend(unshown_skill(report.samples, skills));
    let faults = report.faults.iter();
    notes.extend(faults.map(|fault| of_fault(report, fault, channels)));
    notes.extend(other_metrics(report));
    notes.extend(reference_tests(report, channels));
    let mean = by_channel(channels, |name| Some(phrase(report.mean.get(name)?, "")));
    let is_bound = report.faults.iter().any(|fault| fault.stopped_at.is_some());
    let bound = if is_bound { "≥ " } else { "" };
    notes.push(format!("Mean degradation over all faults: {bound}{mean}."));
    if let Some(unnoticed) = &report.unnoticed {
        let main = unnoticed
            .iter()
            .filter(|of| channels.contains(&of.channel.as_str()));
        let names: Vec<String> = main
            .map(|of| format!("{} {} {}", of.fault, of.severity, of.channel))
            .collect();
        let names = match names.is_empty() {
            true => "none".to_owned(),
            false => names.join(", "),
        };
        notes.push(format!(
            "Errors at least doubled by a fault that no check of {inputs} finds (fault, severity, channel): {names}."
        ));
    }
    notes.extend(missed_targets(report));
    notes.extend(report.faults.iter().filter_map(|fault| {
        let words = fault.note.as_ref()?;
        Some(format!("{}: {words}.", fault.id))
    }));
    if report.untouched != "reference" {
        notes.push(format!(
            "The recording has no untouched {inputs}; changes by faults and contact are measured from: {}. {}.",
            report.untouched,
            match report.input {
                "signals" => "`rest` under [signals] of a map names rows without contact",
                _ => "`reference` under [frame] of a map names a picture without contact",
            }
        ));
    }
    if report.left_out > 0 {
        let left_out = counted(report.left_out, "sample");
        notes.push(format!("{left_out} left out, without a picture."));
    }
    let skipped = report.skipped.iter();
    notes.extend(skipped.map(|of| format!("Skipped: {}: {}.", of.fault, of.reason)));
    notes.extend(report.notes.iter().cloned());
    notes.extend(report.not_measured.clone());
    notes
}

/// Summary of a fault on one line.
fn of_fault(report: &StressReport, fault: &FaultReport, channels: &[&str]) -> String {
    if !fault.times.is_empty() {
        return of_times(fault);
    }
    let breaks = by_channel(channels, |name| {
        match report.clean.get(name)?.skill.is_above_zero() {
            Some(false) => Some("no skill even without the fault".to_owned()),
            _ => Some(skill_end(fault, *fault.breaks_at.get(name)?)),
        }
    });
    let recovers = by_channel(channels, |name| {
        let share = fault.recovers.get(name)?;
        match share.value {
            Some(value) => Some(format!("{:.0} %", 100.0 * value)),
            None => Some(format!("– ({})", share.reason?)),
        }
    });
    let mut line = format!("{}: skill ends at severity: {breaks}", fault.id);
    let tested = fault.severities.iter().map(|of| of.severity.to_string());
    let tested: Vec<String> = tested.collect();
    if !tested.is_empty() {
        let mean = by_channel(channels, |name| Some(phrase(fault.mean.get(name)?, "")));
        let bound = if fault.stopped_at.is_some() {
            "≥ "
        } else {
            ""
        };
        line.push_str(&format!(
            "; mean degradation D over severity {}: {bound}{mean}",
            tested.join(", ")
        ));
    }
    if let Some(last) = fault.stopped_at {
        line.push_str(&format!(
            "; no skill is left at severity {last}, so higher ones are not tested"
        ));
    }
    line.push_str(&spread(fault, channels));
    if let Some(relative) = &fault.relative_error {
        let relative = by_channel(channels, |name| Some(phrase(relative.get(name)?, "")));
        line.push_str(&format!(
            "; added error relative to the reference model: {relative}"
        ));
    }
    line.push_str(&verdicts(report, fault, channels));
    let renewed = match report.input {
        "signals" => "new untouched signals remove",
        _ => "a new untouched picture removes",
    };
    line.push_str(&match common_reason(fault) {
        Some(reason) => format!("; the error that {renewed} is unknown: {reason}"),
        None => format!("; share of the excess error that {renewed}: {recovers}"),
    });
    for of in &fault.unreached {
        line.push_str(&format!(
            "; severity {} is not possible: the stimulus is {} at the nearest parameter, {}, expected {}",
            of.severity,
            short(of.most),
            short(of.parameter),
            of.target
        ));
    }
    line.push('.');
    line
}

/// Text for the channels in which the fault adds significantly less or more error than to the reference model; empty if there are none.
fn verdicts(report: &StressReport, fault: &FaultReport, channels: &[&str]) -> String {
    let sides = [("less", true), ("more", false)].into_iter();
    let words = sides.map(|(side, is_less)| {
        let shown = by_channel(channels, |name| {
            let of = fault.difference.as_ref()?.get(name)?;
            let value = of.value.filter(|value| of.is_shown && (*value < 0.0) == is_less)?;
            let unit = report.units.get(name)?;
            let size = FormattedValue::number(value, of.interval).phrase(&format!(" {unit}"));
            Some(format!("{size}, {}", p_words(of.p?)))
        });
        match shown.is_empty() {
            true => shown,
            false => format!(
                "; the fault is shown to add {side} error than to the reference model (mean over severities): {shown}"
            ),
        }
    });
    words.collect()
}

/// Metrics of time without a fault and at each severity, on one line.
fn of_times(fault: &FaultReport) -> String {
    let metrics = fault.times.iter().map(|(metric, clean)| {
        let value = |of: Option<f64>| of.map_or_else(|| "–".to_owned(), short);
        let severities = fault.severities.iter().map(|of| {
            let known = of.times.get(metric).and_then(|of| of.value);
            format!("{} at severity {}", value(known), of.severity)
        });
        let severities: Vec<String> = severities.collect();
        let unit = match clean.unit {
            "1" => String::new(),
            unit => format!(" {unit}"),
        };
        format!(
            "{metric} {}{unit} without the fault, {}",
            value(clean.value),
            severities.join(", ")
        )
    });
    let metrics: Vec<String> = metrics.collect();
    format!("{}: {}.", fault.id, metrics.join("; "))
}

/// Spread of the degradation between draws, at the highest tested severity; empty for one draw.
fn spread(fault: &FaultReport, channels: &[&str]) -> String {
    let Some(last) = fault.severities.last() else {
        return String::new();
    };
    let ends = channels.iter().filter_map(|name| {
        let [least, most] = last.stale.get(*name)?.spread?;
        Some(format!("{name} {} to {}", short(least), short(most)))
    });
    let ends: Vec<String> = ends.collect();
    match ends.is_empty() {
        true => ends.concat(),
        false => format!(
            "; single draws of severity {}: {}",
            last.severity,
            ends.join(", ")
        ),
    }
}

/// Reason why no channel states the share of the error that a new untouched input removes; `None` if a channel does or the reasons differ.
fn common_reason(fault: &FaultReport) -> Option<Undefined> {
    let reason = fault.recovers.values().next()?.reason?;
    let mut shares = fault.recovers.values();
    let is_common = shares.all(|of| of.value.is_none() && of.reason == Some(reason));
    is_common.then_some(reason)
}

/// Text on the severity at which skill ends, or on the tested severities that bound this severity.
fn skill_end(fault: &FaultReport, breaks_at: Option<u8>) -> String {
    let tested = fault.severities.iter().map(|of| of.severity);
    let last = fault.severities.last().map(|of| of.severity);
    match (breaks_at, last) {
        (None, _) => "unknown".to_owned(),
        (Some(NEVER), Some(last)) if last + 1 < NEVER => format!("not up to {last}"),
        (Some(NEVER), _) => "never".to_owned(),
        (Some(severity), _) => match tested.filter(|of| *of < severity).max() {
            Some(before) if before + 1 < severity => format!("between {before} and {severity}"),
            None if severity > 1 => format!("{severity} or below"),
            _ => severity.to_string(),
        },
    }
}

/// Channels for which `words` returns text, each with this text: `Fz 3, Pxy never`.
fn by_channel(channels: &[&str], words: impl Fn(&str) -> Option<String>) -> String {
    let known = channels
        .iter()
        .filter_map(|name| Some(format!("{name} {}", words(name)?)));
    known.collect::<Vec<String>>().join(", ")
}

/// Number as text, with the digits that reports show.
pub(super) fn short(number: f64) -> String {
    FormattedValue::number(number, None).value
}

fn formatted(of: &Estimate) -> FormattedValue {
    match of.value {
        Some(value) => FormattedValue::number(value, of.ci95),
        None => FormattedValue {
            reason: of.reason.map(|reason| reason.to_string()),
            ..FormattedValue::default()
        },
    }
}

pub(super) fn phrase(of: &Estimate, unit: &str) -> String {
    let unit = match unit {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    formatted(of).phrase(&unit)
}

pub(super) fn cell(of: &Estimate) -> Cell {
    Cell::Estimate(taceva_report::Estimate {
        formatted: formatted(of),
        ..taceva_report::Estimate::default()
    })
}
