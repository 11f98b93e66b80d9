//! Faults of sensors, as a section of a page and as a page.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::{Document, badge, drawn};
use crate::faults::{FaultResult, FaultScores, NEVER};
use crate::names::{listed, names};
use crate::number::FormattedValue;
use crate::results::Study;

/// HTML page of one result of `taceva stress`, with the same content as the section in the page of a run.
pub fn fault_page(result: FaultResult) -> String {
    let studies = [Study::of_faults(result)];
    let title = format!("{}: errors with faults", studies[0].sensor);
    let mut document = Document::new(&title, badge(&studies));
    document.section("faults", "Faults", section(&studies).unwrap_or_default());
    document.finish()
}

/// Section with the faults of each sensor; `None` if no sensor was tested with faults.
pub(super) fn section(studies: &[Study]) -> Option<Markup> {
    let named = (1_usize..).zip(studies.iter().zip(names(studies)));
    let entries = named.filter_map(|(number, (study, name))| {
        let result = study.faults.as_ref()?;
        Some(entry(result, &name, number))
    });
    let entries: Vec<Markup> = entries.collect();
    let results = studies.iter().filter_map(|study| study.faults.as_ref());
    let inputs: BTreeSet<&str> = results.map(FaultResult::inputs).collect();
    let inputs: Vec<&str> = inputs.into_iter().collect();
    let body = html! {
        p { "Errors of the same presses with faults of their " (inputs.join(" or ")) ". The model was not fitted again." } "\n"
        @for entry in &entries { (entry) }
    };
    (!entries.is_empty()).then_some(body)
}

fn entry(result: &FaultResult, name: &str, number: usize) -> Markup {
    let mut figure = result.figure();
    figure.id = format!("faults-{number}");
    let own = result.faults.iter();
    let own = own.filter_map(|fault| Some(format!("{}: {}", fault.id, fault.note.as_ref()?)));
    let skipped = result.skipped.iter();
    let skipped = skipped.map(|of| format!("Skipped: {}: {}", of.fault, of.reason));
    html! {
        (drawn(&figure))
        p { strong { (name) } ": mean degradation over all faults: " (means(result)) "." } "\n"
        @if let Some(words) = unnoticed(result) { p { (words) } "\n" }
        ul { @for fault in result.scored() { li { (fault.id) ": " (skill_end(fault, result)) (verdicts(fault, result)) "." } "\n" } }
        @for of in &result.failed { p.note { "Failed: " (of.fault) ": " (of.reason) "." } "\n" }
        @for words in own.chain(skipped) { p.note { (words) "." } "\n" }
        @for words in &result.notes { p.note { (words) } "\n" }
    }
}

/// Mean degradation of each main channel: `Fz 3.2 (2.1 … 4.9)`.
fn means(result: &FaultResult) -> String {
    let known = result.main_channels().into_iter().map(|channel| {
        let mean = result.degradation(channel);
        let mean = mean.map(|(value, ends)| FormattedValue::number(value, ends).phrase(""));
        format!("{channel} {}", mean.unwrap_or_else(|| "unknown".to_owned()))
    });
    known.collect::<Vec<_>>().join(", ")
}

/// Sentence on errors that at least double while no check finds the fault; `None` if the recording has no untouched picture for the check.
fn unnoticed(result: &FaultResult) -> Option<String> {
    let main = result.main_channels();
    let hidden = result.unnoticed.as_ref()?.iter();
    let hidden = hidden.filter(|of| main.contains(&of.channel.as_str()));
    let hidden = hidden.map(|of| format!("{} {} {}", of.fault, of.severity, of.channel));
    let hidden: Vec<String> = hidden.collect();
    let inputs = result.inputs();
    Some(match hidden.is_empty() {
        true => {
            format!("Every fault that at least doubles an error is found by a check of {inputs}.")
        }
        false => format!(
            "Errors at least doubled by a fault that no check of {inputs} finds (fault, severity, channel): {}.",
            listed(&hidden)
        ),
    })
}

/// First tested severity of `fault` without shown skill, by channel.
fn skill_end(fault: &FaultScores, result: &FaultResult) -> String {
    let channels = result.main_channels().into_iter();
    let ends = channels.filter_map(|channel| {
        let end = match fault.breaks_at.get(channel)? {
            None => "is unknown".to_owned(),
            Some(NEVER) => "stays at every tested severity".to_owned(),
            Some(severity) => format!("is no longer shown at severity {severity}"),
        };
        Some(format!("skill of {channel} {end}"))
    });
    ends.collect::<Vec<_>>().join(", ")
}

/// Main channels to which the fault adds significantly less or more error than to the same channels of the reference model; empty without such
/// channels.
fn verdicts(fault: &FaultScores, result: &FaultResult) -> String {
    let sides = [("less", true), ("more", false)].into_iter();
    let words = sides.map(|(side, is_less)| {
        let channels = result.main_channels().into_iter().filter(|channel| {
            let known = fault.difference.get(*channel);
            known.is_some_and(|of| of.is_shown && of.value.is_some_and(|of| (of < 0.0) == is_less))
        });
        let channels: Vec<String> = channels.map(str::to_owned).collect();
        match channels.is_empty() {
            true => String::new(),
            false => format!(
                "; the fault adds {side} error to {} than to the same channels of the reference model",
                listed(&channels)
            ),
        }
    });
    words.collect()
}
