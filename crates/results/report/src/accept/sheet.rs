//! Data sheet of a sensor unit on one page: limits, findings, and pass or fail.

mod rows;

use std::collections::BTreeSet;

use maud::{Markup, html};
use serde_json::{Value, json};
use taceva_metrics::Better;
use taceva_metrology::conformity::{Limits, Word};

use super::{LimitCheck, LimitsFile, ProcessRisk, process};
use crate::html::{Document, Triple, badge, triples};
use crate::markup::{glossary, terms};
use crate::number::numeral;
use crate::results::Study;
use crate::short_digests::short_digests;
use crate::table::{Cell, Column, Table};
use taceva_results::{SampleChannel, not_measured};

/// Schema of an acceptance as JSON. Version 1.1 adds the better direction of each finding, and 1.2 the number of trainings in its interval. Version
/// 1.3 adds uncertainty, probability of conformity, acceptance limit, rule, verdict, risks among units of one process, certificates and accepted
/// edits.
pub const ACCEPTANCE_SCHEMA: &str = "taceva.acceptance/1.3";

/// Findings for one sensor unit, with the facts of its data sheet.
#[derive(Clone, Copy, Debug)]
pub struct Acceptance<'a> {
    /// Checked limits.
    pub limits: &'a LimitsFile,
    /// Results of the tested sensor.
    pub study: &'a Study,
    /// One finding for each limit.
    pub findings: &'a [LimitCheck],
    /// Date of the test: `2026-11-22`; `None` if not given.
    pub date: Option<&'a str>,
    /// Frames of the sensor, if available.
    pub pictures: Option<&'a Triple>,
}

impl Acceptance<'_> {
    /// True if every limit is met.
    pub fn is_passed(&self) -> bool {
        self.findings.iter().all(|finding| finding.is_kept)
    }

    /// True if the sensor fails: without rules, if a limit is not met; with rules, if a finding is a fail or a conditional fail.
    fn is_failed(&self) -> bool {
        let is_fail = |word: Word| matches!(word, Word::Fail | Word::ConditionalFail);
        let mut findings = self.findings.iter();
        match self.limits.is_by_rules() {
            true => findings.any(|finding| is_fail(finding.verdict)),
            false => !self.is_passed(),
        }
    }

    /// Table with one row for each limit.
    pub fn table(&self) -> Table {
        let (verdict, counts) = match (self.is_passed(), self.is_failed()) {
            (true, _) => ("passed", String::new()),
            (false, true) => ("failed", String::new()),
            (false, false) => ("not accepted", format!(": {}", self.open_limits())),
        };
        let name = match self.limits.name.as_str() {
            "" => String::new(),
            name => format!(" by {name}"),
        };
        let date = self
            .date
            .map_or_else(String::new, |date| format!(", {date}"));
        let caption = format!(
            "{}, serial {}: {verdict}{name}{date}{counts}",
            self.study.sensor,
            self.serial()
        );
        let columns = [Column::of_metrics()].into_iter();
        let mut table = Table::new(caption, columns.chain(self.columns()));
        for finding in self.findings {
            table.push(self.row(finding));
        }
        if let Some(line) = self.study.traceability() {
            table.note(line.to_owned());
        }
        table.note_all(self.variant_notes());
        let notes = self.edits_note().into_iter().chain(self.rule_notes());
        table.note_all(notes.chain(process::notes(self.findings)));
        let trainings = self.findings.iter().map(|finding| finding.trainings);
        if let Some(trainings) = trainings.max().filter(|trainings| *trainings > 0) {
            table.note(format!(
                "The model was trained {trainings} times; intervals of scores that differ between trainings include the variance between trainings."
            ));
        }
        table.note_all(not_measured([self.study.source.as_str()]));
        table
    }

    /// Table for programs. The last column has the rule of each limit if rules decide on the limits.
    pub fn numbers(&self) -> Table {
        let mut table = self.table();
        if self.limits.is_by_rules() {
            table.columns.push(Column::new("rule"));
            for (row, finding) in table.rows.iter_mut().zip(self.findings) {
                row.cells.push(Cell::text(finding.rule()));
            }
        }
        table
    }

    /// JSON of [`ACCEPTANCE_SCHEMA`].
    pub fn json(&self) -> String {
        let is_by_rules = self.limits.is_by_rules();
        let finding = |finding: &LimitCheck| {
            let decision = finding.decision.as_ref();
            let acceptance = decision.and_then(|decision| decision.acceptance.as_ref());
            json!({
                "metric": finding.limit.metric,
                "better": Better::of(&finding.limit.metric).map(Better::name),
                "channel": finding.limit.channel,
                "unit": finding.limit.unit,
                "most": finding.limit.most,
                "least": finding.limit.least,
                "value": finding.value,
                "ci95": finding.ends,
                "trainings": finding.trainings,
                "n": finding.n,
                "u": decision.and_then(|of| of.standard_uncertainty),
                "nu": decision.and_then(|of| of.freedom),
                "k": decision.and_then(|of| of.coverage_factor),
                "U": decision.and_then(|of| of.expanded_uncertainty),
                "conformance_probability": decision.and_then(|of| of.conformance_probability),
                "acceptance_limit": acceptance.map(ends_json),
                "process": finding.process.as_ref().map(process_json),
                "rule": is_by_rules.then_some(finding.limit.decided_by),
                "verdict": finding.verdict,
                "kept": finding.is_kept,
                "standing": finding.standing.words(),
                "reason": finding.reason,
            })
        };
        let findings: Vec<_> = self.findings.iter().map(finding).collect();
        let whole = json!({
            "schema": ACCEPTANCE_SCHEMA,
            "date": self.date,
            "subject": {"sensor": self.study.sensor, "serial": self.serial(), "gel": self.study.gel, "source": self.study.source},
            "traceability": self.study.traceability(),
            "edits": self.study.edits,
            "conditional_pass_counts": self.limits.counts_conditional_passes(),
            "passed": self.is_passed(),
            "findings": findings,
        });
        format!("{whole:#}\n")
    }

    /// Data sheet on one page, as HTML.
    pub fn page(&self) -> String {
        let studies = std::slice::from_ref(self.study);
        let lead = html! { (badge(studies)) (self.verdict()) };
        let mut document = Document::new(&format!("Data sheet: {}", self.study.sensor), lead);
        let pictures = self.pictures.map(std::slice::from_ref).unwrap_or_default();
        let unit = html! { (self.unit()) (triples(studies, pictures)) };
        document.section("unit", "Unit", unit);
        document.section("limits", "Limits", self.table().html_with_links());
        if self.limits.is_by_rules() {
            let uncertainties = self.uncertainties().html_with_links();
            document.section("uncertainties", "Uncertainties", uncertainties);
        }
        let named = self
            .findings
            .iter()
            .map(|finding| finding.limit.metric.as_str());
        document.section("sheet-glossary", "What the metrics mean", glossary(named));
        document.finish()
    }

    fn verdict(&self) -> Markup {
        let broken = self.findings.iter().filter(|finding| !finding.is_kept);
        let words = match self.words_but_pass(|_| true) {
            words if words.is_empty() => words,
            words => format!(" ({words})"),
        };
        html! {
            @match (broken.count(), self.limits.is_by_rules(), self.is_failed()) {
                (0, ..) => p.pass { "PASS: every limit is met" (words) "." },
                (broken, false, _) => p.fail { "FAIL: " (broken) " of " (self.findings.len()) " limits are not met." },
                (_, true, false) => p.fail { "not accepted: " (self.open_limits()) "." },
                (broken, true, true) => p.fail { "FAIL: " (broken) " of " (self.findings.len()) " limits are not passed" (words) "." },
            }
        }
    }

    /// Counts of the decisions on limits that are not met, such as `1 conditional pass, 2 undecided`.
    fn open_limits(&self) -> String {
        self.words_but_pass(|finding| !finding.is_kept)
    }

    /// Number of findings with each word except pass, such as `1 conditional pass, 2 fail`. Includes only findings accepted by `counts`. Empty
    /// without rules.
    fn words_but_pass(&self, counts: fn(&LimitCheck) -> bool) -> String {
        let others = [
            Word::ConditionalPass,
            Word::ConditionalFail,
            Word::Fail,
            Word::Undecided,
        ];
        let words = others.iter().filter_map(|word| {
            let found = self.findings.iter().filter(|of| counts(of));
            let count = found.filter(|of| of.verdict == *word).count();
            (count > 0 && self.limits.is_by_rules()).then(|| format!("{count} {word}"))
        });
        let words: Vec<String> = words.collect();
        words.join(", ")
    }

    /// Serial number of the tested unit. From several numbers joined by commas, keeps the numbers that samples name.
    fn serial(&self) -> String {
        let serial = &self.study.serial;
        let known: Vec<&str> = serial.split(", ").collect();
        let Some(samples) = &self.study.samples else {
            return serial.clone();
        };
        let named = (0..samples.rows()).filter_map(|row| samples.word("unit_id", row));
        let named: BTreeSet<&str> = named.collect();
        let are_serials = named.iter().all(|unit| known.contains(unit));
        if named.is_empty() || !are_serials {
            return serial.clone();
        }
        let tested = known.into_iter().filter(|unit| named.contains(*unit));
        Vec::from_iter(tested).join(", ")
    }

    /// Tested unit and test date.
    fn unit(&self) -> Markup {
        let study = self.study;
        let mut entries = vec![
            ("sensor", study.sensor.clone()),
            ("serial", self.serial()),
            ("gel", short_digests(&study.gel)),
        ];
        entries.extend(self.date.map(|date| ("date", date.to_owned())));
        entries.push(("samples", study.source.clone()));
        let ranges = ranges(study);
        if !ranges.is_empty() {
            entries.push(("ranges tried", ranges));
        }
        let wanted = [
            "laboratory",
            "operator",
            "dataset",
            "split",
            "seed",
            "part",
            "taceva",
        ];
        let known = study
            .provenance
            .iter()
            .filter(|(name, _)| wanted.contains(&name.as_str()));
        entries.extend(
            study
                .made
                .model
                .iter()
                .map(|model| ("model", model.clone())),
        );
        entries.extend(known.map(|(name, text)| (name.as_str(), short_digests(text))));
        html! { dl.two { (terms(entries)) } "\n" }
    }
}

fn ends_json(limits: &Limits) -> Value {
    json!({"least": limits.least(), "most": limits.most()})
}

fn process_json(process: &Result<ProcessRisk, String>) -> Value {
    match process {
        Ok(process) => json!({
            "units": process.units,
            "consumer_risk": process.risk.consumer,
            "producer_risk": process.risk.producer,
            "acceptance_limit": process.acceptance.as_ref().map(ends_json),
        }),
        Err(reason) => json!({"undefined": reason}),
    }
}

/// Range of the true values of each channel, if samples are available: `Pz 0 … 1.2 mm`.
fn ranges(study: &Study) -> String {
    let range = |channel: SampleChannel<'_>| {
        let truth = channel.truths();
        let [low, high] = crate::figure::extent(truth)?;
        let unit = crate::number::spaced(channel.unit());
        Some(format!(
            "{} {} … {}{unit}",
            channel.name,
            numeral(low),
            numeral(high)
        ))
    };
    let channels = study.samples.iter().flat_map(|samples| samples.channels());
    let ranges: Vec<String> = channels.filter_map(range).collect();
    ranges.join("; ")
}

#[cfg(test)]
mod tests;
