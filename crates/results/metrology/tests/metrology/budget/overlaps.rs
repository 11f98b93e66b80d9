//! Figures that include other figures. A budget must not count an effect twice.

use taceva_metrology::budget::{Budget, BudgetError, BudgetText, Evidence, Figure, Freedom};

/// Error message for two sources that use the figures `one` and `other`.
pub(super) fn figures(one: &str, other: &str) -> String {
    let found = of_figures(one, other);
    found.expect_err("refused").to_string()
}

fn of_figures(one: &str, other: &str) -> Result<Vec<Budget>, BudgetError> {
    let text = format!(
        "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"a\"\nfrom = \"{one}\"\n[[source]]\nname = \"b\"\nfrom = \"{other}\"\n"
    );
    let known = [
        "error",
        "error.within",
        "error.between",
        "repeatability",
        "zero_u_mm",
        "g.json#repeatability",
        "g.json#reproducibility",
        "g.json#unit",
        "other.json#unit",
    ];
    let with = |evidence: Evidence, name: &&str| {
        evidence.with(name, Figure::new(0.01, Freedom::Finite(9.0)))
    };
    let evidence = known.iter().fold(Evidence::default(), with);
    BudgetText::parse(&text)?.budgets(&evidence, None)
}

#[test]
fn components_of_a_gauge_study_that_differ_and_those_of_two_studies_stand_beside_each_other() {
    for (one, other) in [
        ("g.json#repeatability", "g.json#reproducibility"),
        ("g.json#repeatability", "g.json#unit"),
        ("g.json#reproducibility", "other.json#unit"),
        ("error.within", "g.json#unit"),
        ("zero_u_mm", "g.json#unit"),
    ] {
        assert!(of_figures(one, other).is_ok(), "{one}, {other}");
    }
}

#[test]
fn a_figure_inside_another_one_is_refused_with_both_lines() {
    assert_eq!(
        figures("error", "repeatability"),
        "line 8, `from`: `repeatability` is inside `error` (line 5); remove one of them"
    );
    assert_eq!(
        figures("repeatability", "error.within"),
        "line 5, `from`: `repeatability` is inside `error.within` (line 8); remove one of them"
    );
    assert!(figures("error.between", "error").contains("`error.between` is inside `error`"));
    let unit = figures("g.json#reproducibility", "g.json#unit");
    assert!(
        unit.contains("`g.json#unit` is inside `g.json#reproducibility` (line 5)"),
        "{unit}"
    );
    for outer in ["error", "error.within", "repeatability"] {
        let repeats = figures(outer, "g.json#repeatability");
        let said = format!("`g.json#repeatability` is inside `{outer}`");
        assert!(repeats.contains(&said), "{repeats}");
    }
    assert!(
        figures("error.within", "error.within")
            .contains("`error.within` is used twice, here and in line 5")
    );
}

#[test]
fn the_zero_of_depths_is_inside_residuals_and_repeats_and_is_missing_where_nothing_counts_it() {
    for outer in [
        "error",
        "error.within",
        "error.between",
        "repeatability",
        "g.json#repeatability",
    ] {
        let found = figures("zero_u_mm", outer);
        let said = format!("line 5, `from`: `zero_u_mm` is inside `{outer}` (line 8)");
        assert!(found.contains(&said), "{found}");
    }
    let missing = |one: &str, other: &str| {
        let budgets = of_figures(one, other).expect("a budget");
        let missing = budgets.into_iter().flat_map(|budget| budget.missing);
        let mut zeros = missing.filter(|of| of.source == "zero_u_mm");
        zeros.next().map(|of| of.reason)
    };
    assert_eq!(
        missing("g.json#unit", "other.json#unit").as_deref(),
        Some("zero of depths: measured, but no source of the budget names it")
    );
    assert_eq!(missing("zero_u_mm", "g.json#unit"), None);
    assert_eq!(missing("error.within", "g.json#unit"), None);
}
