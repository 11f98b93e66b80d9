//! Choices as table rows, JSON and a page.

use std::collections::BTreeMap;

use maud::html;
use serde_json::json;
use taceva_core::{by_count, counted};

use super::{Candidate, Choice, Property, Step};
use crate::html::Document;
use crate::names::listed;
use crate::number::{fixed, numeral};
use crate::table::{Column, Direction, Table};

/// Schema of a choice as JSON. Version 1.1 adds `open`: sensors with an unknown value for a hard need. 1.2 adds the better direction of each step.
/// 1.3 adds place and tie of each ranked sensor. 1.4 adds intervals and significant differences. 1.5 adds sensors with limits from the catalogue.
/// 1.6 adds `unplaced`: sensors without a value for a ranking need. 1.7 adds `other_definitions`: sensors with values of another definition only.
/// 1.7 also adds the part or the goods of each value. 1.8 adds `apart`: sensors that were measured on other samples or with other faults. 1.9 adds
/// inexact values that decide a hard need.
pub const CHOICE_SCHEMA: &str = "taceva.choice/1.9";

/// Greatest number of names in a sentence.
const SHOWN: usize = 6;

impl Choice {
    /// Table with one row for each sensor, need and value, from the best sensor to the excluded sensors.
    pub fn table(&self) -> Table {
        let columns = [
            Column::new("place"),
            Column::new("sensor"),
            Column::new("need"),
            Column::new("looked at").direction(Direction::OfRows),
            Column::new("number"),
            Column::new("95 % interval"),
        ];
        let is_ranking = self.is_ranking();
        let shares = ["share of the best", "mean share"].map(Column::new);
        let shares = shares.into_iter().filter(|_| is_ranking);
        let mut table = Table::new(self.headline(), columns.into_iter().chain(shares));
        for ((at, candidate), place) in self.ranked.iter().enumerate().zip(self.places()) {
            let place = match self.is_tied(at) {
                true => format!("{place} (tie)"),
                false => place.to_string(),
            };
            for (number, step) in candidate.steps.iter().enumerate() {
                let is_first = number == 0;
                let once = |text: String| if is_first { text } else { String::new() };
                let mut cells = vec![
                    once(place.clone()),
                    once(candidate.name.clone()),
                    step.need.clone(),
                    step.property.to_string(),
                    shown(step),
                    step.interval.map_or_else(String::new, |[low, high]| {
                        format!("{} … {}", numeral(low), numeral(high))
                    }),
                ];
                if is_ranking {
                    let share = step.share.map_or_else(String::new, |share| fixed(share, 2));
                    cells.extend([share, once(fixed(candidate.share, 2))]);
                }
                table.push_directed(Some(step.property.better()), cells);
            }
        }
        for candidate in &self.ranked {
            let unsure = candidate.steps.iter().filter(|step| step.is_unsure);
            for step in unsure {
                table.note(format!(
                    "Met by the value only: `{}` by {}, because the interval of its {} crosses the bound.",
                    step.need, candidate.name, step.property
                ));
            }
        }
        self.note_parts(&mut table);
        let ranked = self.ranked.iter();
        let mut steps = ranked.flat_map(|candidate| &candidate.steps);
        if steps.any(|step| step.property.is_of_both_axes()) {
            table.note(
                "MAE of Pxy or Fxy is the mean of both axes. The mean distance in the plane is up to twice as large.",
            );
        }
        if !self.limits_of_catalogue.is_empty() {
            table.note(format!(
                "Greatest depth and force are from the catalogue, not from these results: {}.",
                self.limits_of_catalogue.join(", ")
            ));
        }
        let tested = self.tested().into_iter();
        table.note_all(tested.map(|sentence| format!("Tests: {sentence}.")));
        if self.simulated {
            table.note("Simulated samples: these numbers were not measured.");
        }
        table.note_all(self.spread.as_deref());
        for (word, all) in [
            ("open", &self.open),
            ("dropped", &self.dropped),
            ("not ranked", &self.barred),
            ("not ranked", &self.apart),
        ] {
            let reasons = taceva_core::distinct(all.iter().map(|of| of.reason.as_str()));
            for reason in reasons {
                let alike = all.iter().filter(|of| of.reason == reason);
                let names: Vec<String> = alike.map(|of| of.name.clone()).collect();
                table.note(format!("{}: {word}, because {reason}.", first(&names)));
            }
        }
        let mut reasons: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for unplaced in &self.unplaced {
            let names = reasons.entry(&unplaced.reason).or_default();
            names.push(unplaced.name.clone());
        }
        for (reason, names) in reasons {
            table.note(format!("Not ranked, {reason}: {}.", first(&names)));
        }
        for other in &self.other_definitions {
            table.note(format!("{}: {}.", other.name, other.reason));
        }
        if !self.unknown.is_empty() || !self.other_definitions.is_empty() {
            let known = self.ranked.len() + self.others.len();
            let others = self.other_definitions.len();
            let others = match others {
                0 => String::new(),
                _ => format!(
                    ", {others} {} a number of another definition only",
                    by_count(others, "has", "have")
                ),
            };
            let none = match self.unknown.is_empty() {
                true => String::new(),
                false => format!("; no number is known for: {}", first(&self.unknown)),
            };
            table.note(format!(
                "{known} of {} {} a requested number{others}{none}.",
                counted(self.considered(), "sensor"),
                by_count(known, "has", "have"),
            ));
        }
        table
    }

    /// True if at least one need ranks the sensors.
    fn is_ranking(&self) -> bool {
        let all = self.ranked.iter().chain(&self.others);
        let mut steps = all.flat_map(|candidate| &candidate.steps);
        steps.any(|step| !step.is_bound)
    }

    /// Notes on the values of the sensors: tested depths and forces of published errors, variants, measured parts of sizes, and goods of prices.
    fn note_parts(&self, table: &mut Table) {
        let all = || self.ranked.iter().chain(&self.others);
        let is_error = |step: &Step| matches!(step.property, Property::Error(_));
        let errors = all().filter_map(|candidate| {
            let mut steps = candidate.steps.iter().filter(|step| is_error(step));
            let tested = steps.find_map(|step| step.part.as_ref())?;
            Some(format!("{} {tested}", candidate.name))
        });
        let errors: Vec<String> = errors.collect();
        if !errors.is_empty() {
            table.note(format!(
                "Published errors are means over presses up to these depths and forces, and do not apply beyond: {}.",
                errors.join("; ")
            ));
        }
        let is_named = |step: &Step| {
            use Property::{Price, Size, Width};
            matches!(step.property, Size | Width | Price(_))
        };
        let steps = all().flat_map(|candidate| &candidate.steps);
        let steps = steps.filter(|step| !is_error(step) && !is_named(step));
        let variants =
            steps.filter_map(|step| Some(format!("{}: {}.", step.property, step.part.as_ref()?)));
        table.note_all(taceva_core::distinct(variants));
        for candidate in &self.ranked {
            for step in candidate.steps.iter().filter(|step| is_named(step)) {
                if let Some(part) = &step.part {
                    table.note(format!("{}, {}: {part}.", candidate.name, step.property));
                }
            }
        }
        let mut steps = all().flat_map(|candidate| &candidate.steps);
        if steps.any(|step| matches!(step.property, Property::Price(_))) {
            table.note("Prices are in the currency of their source and not converted. Only prices of ready sensors are compared with a bound.");
        }
        let currencies = self.other_currencies.iter();
        let currencies: Vec<String> = currencies
            .map(|(currency, count)| format!("{} in {currency}", counted(*count, "sensor")))
            .collect();
        if !currencies.is_empty() {
            table.note(format!(
                "Not compared with the bound, because the price has another currency: {}. Choose again with a bound in that currency.",
                listed(&currencies)
            ));
        }
        let mut steps = all().flat_map(|candidate| &candidate.steps);
        if steps.any(|step| step.property == Property::Width) {
            table.note("The middle dimension is the median of width, depth and height, because sources order them differently; a diameter counts twice.");
        }
    }

    /// Sentence with the result of the choice.
    pub fn headline(&self) -> String {
        match self.ranked.as_slice() {
            [] if !self.unplaced.is_empty() => {
                let names: Vec<String> = self.unplaced.iter().map(|of| of.name.clone()).collect();
                let others = match self.barred.is_empty() {
                    true => "",
                    false => "; others are excluded",
                };
                format!(
                    "No sensor is ranked: a number for a ranking need is unknown for {}{others}",
                    first(&names)
                )
            }
            [] if !self.apart.is_empty() => {
                let names: Vec<String> = self.apart.iter().map(|of| of.name.clone()).collect();
                format!(
                    "No sensor is ranked: {} were measured on different samples, by different definitions or with different faults",
                    first(&names)
                )
            }
            [] => "No sensor meets every need, as far as is known".to_owned(),
            [best] if !self.unplaced.is_empty() => {
                format!(
                    "Only {} is ranked; for others a number is unknown",
                    best.name
                )
            }
            [best] if !self.apart.is_empty() => {
                format!(
                    "Only {} is ranked; others were measured on other samples or with other faults",
                    best.name
                )
            }
            [best] if !self.barred.is_empty() => {
                format!("Only {} is ranked; others are excluded", best.name)
            }
            [best] => format!("Only {} meets every need, as far as is known", best.name),
            several => self.leaders().unwrap_or_else(|| {
                let names = several.iter().map(|candidate| candidate.name.clone());
                let names: Vec<String> = names.collect();
                format!(
                    "{} meet every need, as far as is known, and no need ranks them",
                    listed(&names)
                )
            }),
        }
    }

    /// JSON of [`CHOICE_SCHEMA`].
    pub fn json(&self) -> String {
        let step = |step: &Step| {
            json!({
                "need": step.need,
                "looked_at": step.property.to_string(),
                "better": step.property.better().name(),
                "value": step.value,
                "inexact": step.inexact,
                "unit": step.property.unit(),
                "ci95": step.interval,
                "standing": step.standing.words(),
                "met_by_value_alone": step.is_unsure,
                "share": step.share,
                "part": step.part,
            })
        };
        let places = self.places();
        let candidate = |(at, candidate): (usize, &Candidate)| {
            let steps: Vec<_> = candidate.steps.iter().map(step).collect();
            json!({"name": candidate.name, "place": places.get(at), "tied": self.is_tied(at), "share": candidate.share, "steps": steps})
        };
        let ranked: Vec<_> = self.ranked.iter().enumerate().map(candidate).collect();
        let evidence = self.evidence.as_ref().map(|all| {
            let all = all.iter();
            all.map(|of| json!({"better": of.better, "than": of.than, "looked_at": of.property.to_string(), "p_holm": of.p}))
                .collect::<Vec<_>>()
        });
        let whole = json!({"schema": CHOICE_SCHEMA, "ranked": ranked, "open": self.open, "dropped": self.dropped, "barred": self.barred, "unplaced": self.unplaced, "apart": self.apart, "other_definitions": self.other_definitions, "unknown": self.unknown, "evidence": evidence, "simulated": self.simulated, "limits_of_catalogue": self.limits_of_catalogue});
        format!("{whole:#}\n")
    }

    /// HTML page of the choice for `needs`.
    pub fn page(&self, needs: &str) -> String {
        let lead = html! { p.lead { "Needs: " (needs) } };
        let mut document = Document::new("Which sensor?", lead);
        let answer = html! { p { strong { (self.headline()) "." } } };
        document.section("answer", "Answer", answer);
        let mut table = self.table();
        "Every number considered".clone_into(&mut table.caption);
        document.section("steps", "How sensors were ranked", table.html());
        document.finish()
    }
}

/// The first [`SHOWN`] names, and the number of further names.
fn first(names: &[String]) -> String {
    match names.len().checked_sub(SHOWN) {
        Some(others) if others > 1 => format!(
            "{} and {others} others (`--format json` names all)",
            names[..SHOWN].join(", ")
        ),
        _ => listed(names),
    }
}

fn shown(step: &Step) -> String {
    let inexact = step.inexact.as_deref().unwrap_or("not known");
    let number = step
        .value
        .map_or_else(|| inexact.to_owned(), |value| step.property.shown(value));
    match step.standing.phrase().filter(|_| step.value.is_some()) {
        Some(words) => format!("{number}, {words}"),
        None => number,
    }
}
