//! Budgets: worked examples, draws, bad input, residuals.

mod bad_input;
mod certificates;
mod coverage;
mod draws;
mod examples;
mod overlaps;
mod residuals;

use taceva_metrology::budget::{Budget, BudgetText, Evidence, MonteCarlo};

/// Budgets of the budget file `text`, without measured figures.
fn budgets(text: &str) -> Vec<Budget> {
    BudgetText::parse(text)
        .expect("a budget")
        .budgets(&Evidence::default(), None)
        .expect("values")
}

/// First budget of the budget file `text`, with Monte Carlo draws.
fn drawn(text: &str, draws: MonteCarlo) -> Budget {
    let text = BudgetText::parse(text).expect("a budget");
    text.budgets(&Evidence::default(), draws)
        .expect("values")
        .remove(0)
}

/// Error message for the budget file `text`.
fn refusal(text: &str, evidence: &Evidence) -> String {
    let found = BudgetText::parse(text).and_then(|text| text.budgets(evidence, None));
    found.expect_err("refused").to_string()
}

/// Case of `gum.json` whose name begins with `name`.
fn case(name: &str) -> serde_json::Value {
    let golden: serde_json::Value =
        serde_json::from_str(include_str!("../golden/gum.json")).expect("JSON");
    let cases = golden["cases"].as_array().expect("cases");
    let is_it = |case: &&serde_json::Value| {
        case["name"]
            .as_str()
            .is_some_and(|known| known.starts_with(name))
    };
    cases.iter().find(is_it).expect("the case").clone()
}

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found - expected).abs();
    assert!(
        off <= tolerance * expected.abs().max(1e-300),
        "{found} is not {expected}"
    );
}
