//! Table of every number of a stress test, for programs.

use taceva_metrics::{ScoreUnit, catalogue};
use taceva_report::{Cell, Table};
use taceva_stress::{
    ByChannel, CellScore, ErrorDifference, Estimate, FaultReport, SeverityReport, StressReport,
    TimeScore, Unnoticed, Unreached,
};

/// Remark on a fault whose higher severities are not tested.
const NO_SKILL: &str = "no skill is left, so means over severities are lower bounds";

/// Table for programs: one row for each number, in shortest round-trip form.
pub(crate) fn numbers(report: &StressReport) -> Table {
    let columns = [
        "fault",
        "severity",
        "parameter",
        "stimulus",
        "untouched",
        "channel",
        "quantity",
        "value",
        "unit",
        "ci95_low",
        "ci95_high",
        "reason",
        "source",
    ];
    let mut rows = Rows {
        table: Table::new("Errors with faults", columns),
        report,
    };
    for (channel, score) in &report.clean {
        let unit = rows.unit(channel);
        rows.push(&Place::default(), channel, "mae", &score.mae, unit);
        rows.push(&Place::default(), channel, "skill", &score.skill, "1");
        rows.push_metrics(&Place::default(), channel, &score.metrics);
    }
    for (channel, mean) in &report.mean {
        rows.push(&Place::default(), channel, "mD", mean, "1");
    }
    for fault in &report.faults {
        let whole = Place {
            fault: &fault.id,
            ..Place::default()
        };
        for (channel, mean) in &fault.mean {
            rows.push(&whole, channel, "D", mean, "1");
        }
        for (channel, share) in &fault.recovers {
            rows.push(&whole, channel, "recovers", share, "1");
        }
        if let Some(last) = fault.stopped_at {
            rows.push_words(&whole, "", "stopped_at", Some(f64::from(last)), NO_SKILL);
        }
        for (channel, ratio) in fault.relative_error.iter().flatten() {
            rows.push(&whole, channel, "relative_error", ratio, "1");
        }
        for (channel, of) in fault.difference.iter().flatten() {
            rows.push_difference(&whole, channel, of);
        }
        for (channel, severity) in &fault.breaks_at {
            let severity = Estimate::of_known(severity.map(f64::from));
            rows.push(&whole, channel, "breaks_at", &severity, "1");
        }
        rows.push_times(&whole, &fault.times);
        for of in &fault.severities {
            rows.push_check(fault, of);
            let place = Place {
                strength: Some(Strength::of(of)),
                ..whole
            };
            rows.push_times(&place, &of.times);
            let sides = [("stale", Some(&of.stale)), ("fresh", of.fresh.as_ref())];
            for (untouched, scores) in sides {
                for (channel, score) in scores.into_iter().flatten() {
                    let place = Place {
                        fault: &fault.id,
                        strength: Some(Strength::of(of)),
                        untouched,
                    };
                    rows.push_cell(&place, channel, score);
                }
            }
        }
        for of in &fault.unreached {
            rows.push_unreached(&fault.id, of);
        }
    }
    rows.push_notes();
    rows.table
}

/// Fault, strength of the fault and kind of untouched input, to which the numbers of a row belong.
#[derive(Clone, Copy, Default)]
struct Place<'a> {
    fault: &'a str,
    strength: Option<Strength>,
    untouched: &'a str,
}

/// Severity, with its parameter and stimulus.
#[derive(Clone, Copy)]
struct Strength {
    severity: u8,
    parameter: f64,
    stimulus: Option<f64>,
}

impl Strength {
    fn of(severity: &SeverityReport) -> Strength {
        Strength {
            severity: severity.severity,
            parameter: severity.parameter,
            stimulus: severity.stimulus,
        }
    }
}

/// Rows of the table for programs.
struct Rows<'a> {
    table: Table,
    report: &'a StressReport,
}

impl<'a> Rows<'a> {
    fn unit(&self, channel: &str) -> &'a str {
        self.report.units.get(channel).copied().unwrap_or("")
    }

    fn push_cell(&mut self, place: &Place<'_>, channel: &str, score: &CellScore) {
        let unit = self.unit(channel);
        self.push(place, channel, "mae", &score.mae, unit);
        self.push(place, channel, "skill", &score.skill, "1");
        self.push_metrics(place, channel, &score.metrics);
        self.push(place, channel, "degradation", &score.degradation, "1");
        let capped = Estimate::of_known(score.capped);
        self.push(place, channel, "capped", &capped, unit);
        for (quantity, end) in ["least_of_draws", "greatest_of_draws"]
            .into_iter()
            .zip(score.spread.into_iter().flatten())
        {
            self.push(
                place,
                channel,
                quantity,
                &Estimate::of_known(Some(end)),
                "1",
            );
        }
    }

    /// Adds the findings of checks that the fault causes, and a row `unnoticed` for each error that the fault doubles without a finding.
    fn push_check(&mut self, fault: &FaultReport, of: &SeverityReport) {
        let place = Place {
            fault: &fault.id,
            strength: Some(Strength::of(of)),
            untouched: "",
        };
        let report = self.report;
        let reason = match (fault.keeps_inputs(), &report.unnoticed) {
            (true, _) => Some("no picture or signal changes"),
            (false, None) if of.check.is_empty() => Some("no untouched picture"),
            _ => None,
        };
        if let Some(reason) = reason {
            return self.push_words(&place, "", "check", None, reason);
        }
        let found = f64::from(u8::from(!of.check.is_empty()));
        self.push_words(&place, "", "check", Some(found), &of.check.join(" "));
        let is_own =
            |hidden: &&Unnoticed| hidden.fault == fault.id && hidden.severity == of.severity;
        for hidden in report.unnoticed.iter().flatten().filter(is_own) {
            self.push_words(&place, &hidden.channel, "unnoticed", Some(1.0), "");
        }
    }

    /// Adds the error that a fault adds minus the error that it adds to the reference model, with its p value.
    fn push_difference(&mut self, place: &Place<'_>, channel: &str, of: &ErrorDifference) {
        let unit = self.unit(channel);
        let reason = of.reason.as_deref().unwrap_or_default();
        let value = Estimate::of_known(of.value);
        self.push_row(place, channel, "difference", &value, unit, reason);
        self.push_words(place, channel, "difference_p", of.p, reason);
    }

    fn push_metrics(&mut self, place: &Place<'_>, channel: &str, metrics: &ByChannel<Estimate>) {
        for (metric, of) in metrics {
            let unit = match catalogue::find(metric).map(|metric| metric.unit) {
                Some(ScoreUnit::OfChannel) => self.unit(channel),
                _ => "1",
            };
            self.push(place, channel, metric, of, unit);
        }
    }

    fn push_times(&mut self, place: &Place<'_>, times: &ByChannel<TimeScore>) {
        for (metric, of) in times {
            let value = Estimate::of_known(of.value);
            self.push(place, "", metric, &value, of.unit);
        }
    }

    fn push_unreached(&mut self, fault: &str, of: &Unreached) {
        let place = Place {
            fault,
            strength: Some(Strength {
                severity: of.severity,
                parameter: of.parameter,
                stimulus: Some(of.most),
            }),
            untouched: "",
        };
        let reason = format!("a stimulus of {:?} is not possible", of.target);
        self.push_words(&place, "", "unreached", Some(of.most), &reason);
    }

    fn push_notes(&mut self) {
        let report = self.report;
        let whole = report
            .notes
            .iter()
            .map(|words| ("", "note", words.as_str()));
        let own = report.faults.iter();
        let own = own.filter_map(|fault| Some((fault.id.as_str(), "note", fault.note.as_deref()?)));
        let skipped = report.skipped.iter();
        let skipped = skipped.map(|of| (of.fault.as_str(), "skipped", of.reason.as_str()));
        for (fault, quantity, words) in whole.chain(own).chain(skipped) {
            let place = Place {
                fault,
                ..Place::default()
            };
            self.push_words(&place, "", quantity, None, words);
        }
    }

    fn push(
        &mut self,
        place: &Place<'_>,
        channel: &str,
        quantity: &str,
        of: &Estimate,
        unit: &str,
    ) {
        let reason = of.reason.map_or_else(String::new, |of| of.to_string());
        self.push_row(place, channel, quantity, of, unit, &reason);
    }

    /// Adds a row for a number without an interval, or for a missing number, with a remark.
    fn push_words(
        &mut self,
        place: &Place<'_>,
        channel: &str,
        quantity: &str,
        value: Option<f64>,
        words: &str,
    ) {
        let unit = if value.is_some() { "1" } else { "" };
        let number = Estimate::of_known(value);
        self.push_row(place, channel, quantity, &number, unit, words);
    }

    fn push_row(
        &mut self,
        place: &Place<'_>,
        channel: &str,
        quantity: &str,
        of: &Estimate,
        unit: &str,
        reason: &str,
    ) {
        let strength = place.strength;
        let level = strength.map_or_else(String::new, |of| of.severity.to_string());
        self.table.push([
            Cell::text(place.fault),
            Cell::Number(level),
            Cell::exact(strength.map(|of| of.parameter)),
            Cell::exact(strength.and_then(|of| of.stimulus)),
            Cell::text(place.untouched),
            Cell::text(channel),
            Cell::text(quantity),
            Cell::exact(of.value),
            Cell::text(unit),
            Cell::exact(of.ci95.map(|[low, _]| low)),
            Cell::exact(of.ci95.map(|[_, high]| high)),
            Cell::text(reason),
            Cell::text(self.report.subject.source.as_str()),
        ]);
    }
}
