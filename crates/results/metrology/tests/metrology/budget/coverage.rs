//! Coverage: share of simulated presses whose truth is within the interval of a budget.

use taceva_core::random::Draws;
use taceva_metrology::budget::{Budget, BudgetText, Evidence, Figure, Freedom, Residuals};

/// Standard deviation between places, N. Those of presses and units follow.
const PLACES: f64 = 0.02;
const PRESSES: f64 = 0.025;
const UNITS: f64 = 0.04;

const BUDGET: &str = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"0.5 N\"]\n\
    [[source]]\nname = \"correction\"\nfrom = \"bias\"\n\
    [[source]]\nname = \"place to place\"\nfrom = \"error.between\"\n\
    [[source]]\nname = \"one reading\"\nfrom = \"error.within\"\n";
const UNIT: &str = "[[source]]\nname = \"unit to unit\"\nfrom = \"gauge.json#unit\"\n";

/// Budget from a test of 60 places, pressed twice each, whose residuals have the mean 0.01 N.
fn study(text: &str, draws: Draws) -> Budget {
    let mut residuals = Residuals::default();
    for place in 0..60 {
        let offset = 0.01 + PLACES * draws.of(1).normal(place);
        for press in 0..2 {
            let residual = offset + PRESSES * draws.of(2).normal(2 * place + press);
            residuals.add(&place.to_string(), 0.5 + residual, 0.5);
        }
    }
    let evidence = residuals
        .components()
        .expect("components")
        .feed(Evidence::default())
        .with("gauge.json#unit", Figure::new(UNITS, Freedom::Infinite));
    let text = BudgetText::parse(text).expect("a budget");
    text.budgets(&evidence, None).expect("values").remove(0)
}

/// Share of 10,000 presses at new places that are within the intervals of 100 studies. `units` is the deviation between units, N.
fn share(text: &str, units: f64) -> f64 {
    let mut hits = 0.0;
    for number in 0..100 {
        let draws = Draws::new(number);
        let [low, high] = study(text, draws).interval.expect("an interval");
        for press in 0..100 {
            let normal = |purpose: u64| draws.of(purpose).normal(press);
            let truth = 0.51 + PLACES * normal(3) + PRESSES * normal(4) + units * normal(5);
            hits += if low <= truth && truth <= high {
                1.0
            } else {
                0.0
            };
        }
    }
    hits / 10_000.0
}

#[test]
fn an_interval_of_all_exercised_sources_holds_95_percent_of_presses() {
    let same = share(BUDGET, 0.0);
    assert!((0.93..0.97).contains(&same), "{same}");
    let other = share(&[BUDGET, UNIT].concat(), UNITS);
    assert!((0.93..0.97).contains(&other), "{other}");
}

#[test]
fn another_unit_without_its_source_falls_below_90_percent_and_the_source_is_named() {
    let other = share(BUDGET, UNITS);
    assert!(other < 0.9, "{other}");
    let budget = study(BUDGET, Draws::new(0));
    assert!(budget.missing.iter().any(|of| of.source == "gauge"));
}
