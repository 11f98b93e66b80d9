//! Uncertainty of a reading of each measured or simulated sensor, computed from residuals of the samples.

use maud::{Markup, html};
use taceva_core::{Unit, shown};
use taceva_metrology::budget::{Budget, BudgetText, Components, Evidence, Figure, MonteCarlo};
use taceva_results::Samples;

use super::drawn;
use crate::budget_source::{BETWEEN, BIAS, BudgetSource, CERTIFICATE, WITHIN};
use crate::contributions;
use crate::escape::toml_string as quoted;
use crate::names::names;
use crate::reference::reference_certificate;
use crate::residuals::residual_components;
use crate::results::Study;

/// Phase of the protocol that gives residuals, and the column that groups them.
const PLACES: [&str; 2] = ["calibration", "point_id"];
/// Phase of the protocol with several light scenes, and the column of the scene.
const LIGHTS: [&str; 2] = ["light-sweep", "scene"];
/// Sources of the budget, in addition to the certificate.
const SOURCES: [BudgetSource; 3] = [BETWEEN, WITHIN, BIAS];
/// Command that writes a budget file.
const TEMPLATE: &str = "taceva budget --template RESULT.json > budget.toml";

/// Section with the budget of each sensor, or the reason for a missing budget. `None` if all samples are synthetic or published.
pub(super) fn section(studies: &[Study]) -> Option<Markup> {
    let named = (1_usize..).zip(studies.iter().zip(names(studies)));
    let shown = named.filter(|(_, (study, _))| has_rows(study));
    let entries: Vec<Markup> = shown
        .map(|(number, (study, name))| entry(study, &name, number))
        .collect();
    let body = html! {
        p { "Expanded uncertainty of one reading, by the residuals of the samples of this result." } "\n"
        @for entry in &entries { (entry) }
        p.note { "A file of these sources, to which others can be added: " code { (TEMPLATE) } "." } "\n"
    };
    (!entries.is_empty()).then_some(body)
}

/// True unless the samples of a study are synthetic or published.
fn has_rows(study: &Study) -> bool {
    !["synthetic", "published"].contains(&study.source.as_str())
}

fn entry(study: &Study, name: &str, number: usize) -> Markup {
    let budget = match budget(study) {
        Ok(budget) => budget,
        Err(reason) => {
            return html! { p { strong { (name) } ": no uncertainty budget (" (reason) ")." } "\n" };
        }
    };
    let figure = contributions::draw(&budget, number).map(|mut figure| {
        figure.title = format!("{name}: {}", figure.title);
        figure
    });
    html! {
        p {
            strong { (name) }
            @if study.is_simulated() { " (simulated)" }
            ": " (budget.statement()) "."
        } "\n"
        @for warning in &budget.warnings { p.note { "Warning: " (warning) "." } "\n" }
        @if let Some(figure) = &figure { (drawn(figure)) }
        @if !budget.missing.is_empty() {
            p { "Effects that this budget of " (name) " does not cover:" } "\n"
            ul { @for of in &budget.missing { li { (of.source) ": " (of.reason) } "\n" } }
        }
    }
}

/// Budget of the default channel at the median of its labels, or the reason why there is no budget.
fn budget(study: &Study) -> Result<Budget, String> {
    let Some(samples) = &study.samples else {
        let remedy = "`--samples-out` of evaluate writes them beside the result";
        return Err(format!("its samples are not known; {remedy}"));
    };
    let channel = Measurand::of(study, samples)?;
    let name = channel.name.as_str();
    let [part, column] = PLACES;
    let components = residual_components(samples, name, part, column);
    let components = components.map_err(|reason| format!("{}: {reason}", shown(name)))?;
    let at = middle(samples, name, part);
    let day = study.stated("recorded_on").and_then(|day| day.parse().ok());
    let certificate = reference_certificate(&study.references, name, day);
    let text = BudgetText::parse(&channel.sources(at, certificate.is_ok()));
    let without = certificate.as_ref().err().copied();
    let evidence = evidence(study, samples, name, components);
    let evidence = match certificate {
        Ok(certificate) => evidence.with_certificate(certificate),
        Err(_) => evidence,
    };
    let budgets = text.and_then(|text| text.budgets(&evidence, None::<MonteCarlo>));
    // Omits the line of the error, because the reader does not see the text.
    let budgets = budgets.map_err(|error| format!("{}: {}", shown(name), error.problem))?;
    let first = budgets.into_iter().next();
    let mut first = first.ok_or_else(|| "its labels have no median".to_owned())?;
    for of in &mut first.missing {
        if let Some(reason) = without.filter(|_| of.source == "certificate") {
            of.reason = format!("reference: {reason}");
        }
    }
    Ok(first)
}

/// Channel for which a budget is made.
struct Measurand {
    name: String,
    unit: Unit,
}

impl Measurand {
    /// Fz if predicted, otherwise the first force, otherwise the first predicted channel.
    fn of(study: &Study, samples: &Samples) -> Result<Measurand, String> {
        let channels = samples.channels().into_iter();
        let predicted = channels.filter(|channel| channel.is_predicted());
        let mut all: Vec<Measurand> = predicted
            .filter_map(|channel| {
                let mut scores = study.scores.iter();
                let score = scores.find(|of| of.metric == "mae" && of.channel == channel.name)?;
                Some(Measurand {
                    name: channel.name.to_owned(),
                    unit: score.unit,
                })
            })
            .collect();
        let force = || all.iter().position(|of| of.unit == Unit::Newton);
        let normal = all.iter().position(|of| of.name == "Fz").or_else(force);
        match all.is_empty() {
            true => Err("its samples have no predicted channel with an MAE".to_owned()),
            false => Ok(all.swap_remove(normal.unwrap_or_default())),
        }
    }

    /// Text of the budget file, as `taceva budget` reads it.
    fn sources(&self, at: f64, is_certified: bool) -> String {
        let symbol = self.unit.symbol();
        let value = match self.unit {
            Unit::One => format!("{at:?}"),
            _ => quoted(&format!("{at} {symbol}")),
        };
        let mut text = format!(
            "budget_version = 1\nmeasurand = {}\nunit = {}\nat = [{value}]\n",
            quoted(&self.name),
            quoted(symbol)
        );
        let certificate = is_certified.then_some(CERTIFICATE);
        for source in SOURCES.into_iter().chain(certificate) {
            text += &source.text();
        }
        text
    }
}

/// Median of the labels of one phase of the protocol, rounded to two digits.
fn middle(samples: &Samples, channel: &str, part: &str) -> f64 {
    let labels = samples.channel(channel);
    let rows = samples.of_protocol(part).into_iter();
    let mut truths: Vec<f64> = rows
        .filter_map(|row| Some(labels.as_ref()?.pair(row)?[0]))
        .collect();
    truths.sort_unstable_by(f64::total_cmp);
    let median = truths.get(truths.len() / 2).copied().unwrap_or_default();
    format!("{median:.1e}").parse().unwrap_or(median)
}

/// Figures measured from residuals: `components`, drift, and the variation between light scenes, if known.
fn evidence(
    study: &Study,
    samples: &Samples,
    channel: &str,
    mut components: Components,
) -> Evidence {
    let mae = study.score("mae", channel);
    let note = mae.and_then(|score| score.deciding().standing.reason());
    components.within.note = note.map(str::to_owned);
    let mut evidence = components.feed(Evidence::default());
    let drift = study.score("drift", channel);
    if let Some(slope) = drift.and_then(|score| score.deciding().value.number()) {
        evidence = evidence.with("drift", Figure::of_drift(slope));
    }
    let [part, column] = LIGHTS;
    if samples.has("protocol")
        && let Ok(of_lights) = residual_components(samples, channel, part, column)
    {
        evidence = evidence.with("r_light", of_lights.between);
    }
    evidence
}
