//! Uncertainty budgets of one measurand, as tables for readers and programs, and as a page.

mod numbers;
mod template;

pub use template::BudgetTemplate;

use maud::html;
use serde::Serialize;
use taceva_metrology::budget::{Budget, Method, MonteCarloResult, Traceability};
use taceva_results::not_measured;

use crate::contributions;
use crate::html::{Document, drawn};
use crate::number::FormattedValue;
use crate::table::{Align, Cell, Column, Table, Words};

/// Uncertainty budgets of one budget file, with their context.
#[derive(Clone, Debug, PartialEq)]
pub struct BudgetReport {
    /// Budgets, one for each value of the measurand.
    pub budgets: Vec<Budget>,
    /// Sensor of the result that contains the measured figures; `None` without a result.
    pub sensor: Option<String>,
    /// Origins of the samples behind the measured figures, such as `recorded` and `simulated`.
    pub origins: Vec<String>,
    /// Digest of the budget file.
    pub digest: String,
    /// Maximum allowed expanded uncertainty, in the unit of the measurand; `None` if not given.
    pub most: Option<f64>,
}

/// JSON of one budget with the digests of its input files.
#[derive(Serialize)]
struct SealedBudget<'a> {
    #[serde(flatten)]
    budget: &'a Budget,
    #[serde(rename = "most_U")]
    most: Option<f64>,
    passed: Option<bool>,
    sensor: Option<&'a str>,
    digest: &'a str,
    origins: &'a [String],
    not_measured: Option<String>,
}

impl BudgetReport {
    /// True unless an expanded uncertainty exceeds the allowed maximum, or is undefined although there is a maximum.
    pub fn is_passed(&self) -> bool {
        self.budgets.iter().all(|of| self.meets(of) != Some(false))
    }

    fn meets(&self, budget: &Budget) -> Option<bool> {
        let half_width = budget.half_width();
        self.most
            .map(|most| half_width.is_some_and(|half_width| half_width <= most))
    }

    /// Table for readers: one row for each source, then the results.
    pub fn table(&self) -> Table {
        let first = self.budgets.first();
        let unit = first.map_or("", |budget| budget.unit.as_str());
        let measurand = first.map_or("", |budget| budget.measurand.as_str());
        let is_one = self.budgets.len() < 2;
        let at = (!is_one).then(|| Column::new("at").unit(unit));
        let columns = at.into_iter().chain([
            Column::new("source"),
            Column::new("type"),
            Column::new("shape"),
            Column::new("u"),
            Column::new(Words::new("ν").latex("$\\nu$")).align(Align::ByCell),
            Column::new("c"),
            Column::new("contribution").unit(unit),
            Column::new("share").unit("%"),
        ]);
        let mut table = Table::new(format!("Uncertainty budget of {measurand}"), columns);
        for budget in &self.budgets {
            for source in &budget.sources {
                let at = (!is_one).then(|| Cell::from(number(budget.at)));
                table.push(at.into_iter().chain([
                    Cell::text(source.name.as_str()),
                    Cell::text(source.kind.to_string()),
                    Cell::text(source.shape.as_str()),
                    Cell::from(number(Some(source.u))),
                    Cell::from(source.nu.to_string()),
                    Cell::from(number(Some(source.c))),
                    Cell::from(number(Some(source.contribution))),
                    Cell::from(number(source.share.map(|share| 100.0 * share))),
                ]));
            }
        }
        table.note_all(self.notes());
        table
    }

    /// Notes below the table: results, Monte Carlo draws, warnings, and uncovered effects. Omits repeated notes.
    fn notes(&self) -> Vec<String> {
        let mut notes: Vec<String> = Vec::new();
        let mut add = |words: String| {
            if !notes.contains(&words) {
                notes.push(words);
            }
        };
        for budget in &self.budgets {
            let interval = budget.interval_in_words();
            let interval = interval.map_or_else(String::new, |words| format!("; {words}"));
            add(format!("{}{interval}.", budget.statement()));
            add(reading(budget));
            if let Some(found) = &budget.mcm {
                add(draws(found, &budget.unit));
            }
        }
        let certificates = self.budgets.iter().flat_map(|of| &of.traceability);
        certificates.for_each(|of| add(certificate(of)));
        for range in self.budgets.iter().flat_map(Budget::labels_in_words) {
            add(format!(
                "Errors are pooled over samples with labels from {range}."
            ));
        }
        let warnings = self.budgets.iter().flat_map(|of| &of.warnings);
        warnings.for_each(|warning| add(format!("Warning: {warning}.")));
        if self.budgets.iter().any(|of| !of.correlations.is_empty()) {
            add("Shares do not add up to 100 %: sources are correlated.".to_owned());
        }
        let missing = self.budgets.iter().flat_map(|of| &of.missing);
        missing.for_each(|of| add(format!("Missing: {} ({}).", of.source, of.reason)));
        if let Some(words) = self.verdict() {
            add(words);
        }
        self.not_measured().into_iter().for_each(add);
        notes
    }

    /// Verdict against the maximum allowed expanded uncertainty; `None` without this maximum.
    fn verdict(&self) -> Option<String> {
        let size = |of: &Budget| of.half_width().unwrap_or(f64::INFINITY);
        let budgets = self.budgets.iter();
        let widest = budgets.max_by(|one, other| size(one).total_cmp(&size(other)))?;
        let unit = widest.unit.as_str();
        let most = number(Some(self.most?));
        let found = match (self.is_passed(), widest.reservation()) {
            (true, None) => format!("at most {most} {unit}"),
            (true, Some(words)) => {
                format!("at most {most} {unit} for the sources named here; {words}")
            }
            (false, _) => format!("not shown to be at most {most} {unit}"),
        };
        let compared = match (widest.half_width(), widest.method) {
            (None, _) => "U is undefined".to_owned(),
            (half, Method::FirstOrder) => format!("{} {unit}, k u", number(half)),
            (half, Method::MonteCarlo) => format!(
                "{} {unit}, half-width of the Monte Carlo interval",
                number(half)
            ),
        };
        Some(format!("U is {found}. Compared: {compared}."))
    }

    /// Sealed JSON of one budget, with the schema `taceva.budget/1` and the digests of its input files.
    pub fn json(&self, budget: &Budget) -> String {
        let document = SealedBudget {
            budget,
            most: self.most,
            passed: self.meets(budget),
            sensor: self.sensor.as_deref(),
            digest: &self.digest,
            origins: &self.origins,
            not_measured: self.not_measured(),
        };
        let text = taceva_results::sealed(&document);
        format!("{}\n", text.expect("an object of texts and numbers"))
    }

    /// HTML page with the figure of contributions.
    pub fn page(&self) -> String {
        let table = self.table();
        let lead = html! {
            @if let Some(words) = self.not_measured() { p.badge { (words) } }
            @if let Some(words) = self.verdict() {
                @if self.is_passed() { p.pass { (words) } } @else { p.fail { (words) } }
            }
        };
        let mut document = Document::new(&table.caption, lead);
        let results = html! {
            ul.verdicts { @for budget in &self.budgets { li { (budget.statement()) } "\n" } }
        };
        document.section("result", "Result", results);
        document.section("sources", "Sources", table.html());
        let budgets = (1_usize..).zip(&self.budgets);
        let mut figures = budgets.filter_map(|(number, of)| contributions::draw(of, number));
        let first = figures.next();
        if let Some(first) = first {
            let figures = html! { (drawn(&first)) @for figure in figures { (drawn(&figure)) } };
            document.section("contributions", "Contributions", figures);
        }
        document.finish()
    }

    fn not_measured(&self) -> Option<String> {
        not_measured(self.origins.iter().map(String::as_str))
    }
}

/// Uncorrected reading, its correction, and the combined standard uncertainty.
fn reading(budget: &Budget) -> String {
    let unit = budget.unit.as_str();
    let u = number(Some(budget.u));
    let Some(at) = budget.at else {
        return format!("u = {u} {unit}.");
    };
    let correction = number(Some(budget.value - at));
    format!("Reading {at} {unit}, correction {correction} {unit}, u = {u} {unit}.")
}

/// Certificate of the reference in one line.
fn certificate(of: &Traceability) -> String {
    let until = of.valid_until.as_ref();
    let until = until.map_or_else(String::new, |day| format!(", valid until {day}"));
    format!(
        "Certificate {} of {}, serial {}{until}.",
        of.number, of.laboratory, of.serial
    )
}

/// Monte Carlo result compared with the first-order result.
fn draws(found: &MonteCarloResult, unit: &str) -> String {
    let value =
        FormattedValue::number(found.mean, Some(found.symmetric)).phrase(&format!(" {unit}"));
    let tolerance = FormattedValue::number(found.tolerance, None).value;
    let verdict = match found.validated {
        true => "it confirms the first-order interval",
        false => "it does not confirm the first-order interval",
    };
    format!(
        "Monte Carlo, {} draws of seed {}: {value}; {verdict}, within {tolerance} {unit} and chance.",
        found.draws, found.seed
    )
}

/// Number with four significant digits; a dash if missing.
fn number(value: Option<f64>) -> String {
    value.map_or_else(
        || "–".to_owned(),
        |value| FormattedValue::number(value, None).value,
    )
}
