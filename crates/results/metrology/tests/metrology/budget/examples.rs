//! Worked examples of annex H of the GUM.

use taceva_metrology::budget::{Budget, Freedom, Method};

use super::{budgets, case, near, number};

pub(super) const END_GAUGE: &str = r#"
budget_version = 1
measurand = "l"
unit = "nm"
coverage = 0.99
expression = "l_s + d0 + d1 + d2 - l_s * (delta_alpha * (theta_bar + Delta) + alpha_s * delta_theta)"

[[source]]
name = "l_s"
value = 50000623.0
u = 25
dof = 18
[[source]]
name = "d0"
value = 215
u = 5.8
dof = 24
[[source]]
name = "d1"
u = 3.9
dof = 5
[[source]]
name = "d2"
u = 6.7
dof = 8
[[source]]
name = "alpha_s"
value = 11.5e-6
half_width = 2e-6
shape = "rectangular"
[[source]]
name = "delta_alpha"
half_width = 1e-6
reliability = "10 %"
[[source]]
name = "delta_theta"
half_width = 0.05
dof = 2
[[source]]
name = "theta_bar"
value = -0.1
u = 0.2
[[source]]
name = "Delta"
half_width = 0.5
shape = "arcsine"
"#;

#[test]
fn h1_the_end_gauge_has_the_uncertainty_of_the_gum() {
    let budget = budgets(END_GAUGE).remove(0);
    let golden = case("GUM H.1");
    let own = &golden["own_40_digits"];
    near(budget.value, number(&own["value"]), 1e-12);
    near(budget.u, number(&own["u"]), 1e-12);
    let nu = budget.nu_eff.number().expect("finite");
    near(nu, number(&own["nu"]), 1e-12);
    near(budget.k.expect("k"), number(&golden["k99_nu16"]), 1e-12);
    near(
        budget.expanded.expect("U"),
        number(&golden["U99_nu_truncated"]),
        1e-12,
    );
    near(
        budget.second_order_u,
        number(&golden["u_second_order_GUM_terms"]),
        1e-12,
    );
}

#[test]
fn h1_prints_16_7_degrees_and_takes_the_factor_of_16() {
    let budget = budgets(END_GAUGE).remove(0);
    let text = budget.to_string();
    assert!(
        text.contains("l = 50000838 nm, U = 92 nm (k = 2.921, p = 99 %, nu_eff 16.7)"),
        "{text}"
    );
    assert_eq!(budget.rounded(), Some(92.0));
}

#[test]
fn shares_add_up_to_one_without_correlation() {
    let budget = budgets(END_GAUGE).remove(0);
    let sum: f64 = budget
        .sources
        .iter()
        .filter_map(|source| source.share)
        .sum();
    near(sum, 1.0, 1e-14);
    assert!(budget.correlations.is_empty() && budget.missing.is_empty());
}

/// Budget of a quotient of example H.2.
fn impedance(expression: &str, set: &str) -> Budget {
    let golden = case("GUM H.2");
    let mut text = format!(
        "budget_version = 1\nmeasurand = \"Z\"\nunit = \"ohm\"\nexpression = \"{expression}\"\n"
    );
    for name in ["V", "I", "phi"] {
        let rows = &golden["inputs"][name];
        text.push_str(&format!(
            "[[source]]\nname = \"{name}\"\nrows = {rows}\n{set}\n"
        ));
    }
    budgets(&text).remove(0)
}

#[test]
fn h2_rows_read_together_are_one_component_of_four_degrees() {
    let golden = case("GUM H.2");
    let together = |expression| impedance(expression, "set = \"cycle\"");
    let [r, x, z] = ["V * cos(phi) / I", "V * sin(phi) / I", "V / I"].map(together);
    for (budget, name) in [(&r, "R"), (&x, "X"), (&z, "Z")] {
        let own = &golden["own_40_digits"][name];
        near(budget.value, number(&own[0]), 1e-12);
        near(budget.u, number(&own[1]), 1e-12);
        near(budget.nu_eff.number().expect("finite"), 4.0, 1e-12);
    }
    for (one, other, name) in [(&r, &x, "r(R,X)"), (&r, &z, "r(R,Z)"), (&x, &z, "r(X,Z)")] {
        let found = one.correlation_with(other).expect("uncertain");
        near(found, number(&golden["own_40_digits"][name]), 1e-12);
    }
    assert_eq!(r.correlations.len(), 3);
    assert!(r.to_string().contains("shares do not add up to 100 %"));
}

#[test]
fn h2_without_the_set_is_almost_three_times_as_uncertain() {
    let golden = case("GUM H.2");
    for (expression, name) in [
        ("V * cos(phi) / I", "R"),
        ("V * sin(phi) / I", "X"),
        ("V / I", "Z"),
    ] {
        let apart = impedance(expression, "");
        near(
            apart.u,
            number(&golden["u_if_correlation_is_ignored"][name]),
            1e-12,
        );
    }
}

#[test]
fn h3_a_correction_of_a_line_has_the_freedom_of_the_line() {
    let golden = case("GUM H.3");
    let own = &golden["own_exact_rational"];
    let text = format!(
        "budget_version = 1\nmeasurand = \"b\"\nunit = \"degC\"\nexpression = \"y1 + y2 * (30 - 20)\"\n\
         [[source]]\nname = \"y1\"\nvalue = {}\nu = {}\ndof = 9\nset = \"line\"\n\
         [[source]]\nname = \"y2\"\nvalue = {}\nu = {}\ndof = 9\nset = \"line\"\n\
         [[correlation]]\nbetween = [\"y1\", \"y2\"]\nr = {}\n",
        own["y1"], own["u(y1)"], own["y2"], own["u(y2)"], own["r"]
    );
    let budget = budgets(&text).remove(0);
    near(budget.value, number(&own["b(30)"]), 1e-12);
    near(budget.u, number(&own["u(b30)"]), 1e-12);
    near(budget.nu_eff.number().expect("finite"), 9.0, 1e-12);
}

#[test]
fn correlated_sources_of_finite_freedom_have_no_effective_one() {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n\
        [[source]]\nname = \"a\"\ns = \"3 mN\"\ndof = 4\n[[source]]\nname = \"b\"\ns = \"4 mN\"\ndof = 9\n\
        [[correlation]]\nbetween = [\"a\", \"b\"]\nr = 0.5\n";
    let budget = budgets(text).remove(0);
    assert_eq!(budget.nu_eff.number(), None);
    assert_eq!(
        (budget.k, budget.expanded, budget.interval),
        (None, None, None)
    );
    // √(9 + 16 + 2 · 0.5 · 12) mN.
    near(budget.u, 0.001 * 37_f64.sqrt(), 1e-14);
    assert!(
        budget
            .warnings
            .iter()
            .any(|warning| warning.ends_with("ask for Monte Carlo draws"))
    );
    let with = super::drawn(text, taceva_metrology::budget::MonteCarlo::default());
    assert_eq!(with.method, Method::MonteCarlo);
    let [low, high] = with.interval.expect("of the draws");
    assert!(low < 0.99 && high > 1.01, "{low} {high}");
}

#[test]
fn x_plus_x_has_the_freedom_of_two_x() {
    let text = |expression: &str| {
        format!(
            "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"{expression}\"\n[[source]]\nname = \"x\"\nu = 1\ndof = 5\n"
        )
    };
    let [sum, product] = ["x + x", "2 * x"].map(|expression| budgets(&text(expression)).remove(0));
    assert_eq!(
        (sum.u.to_bits(), sum.nu_eff),
        (product.u.to_bits(), product.nu_eff)
    );
    near(sum.nu_eff.number().expect("finite"), 5.0, 1e-14);
}

#[test]
fn an_unused_correlated_source_changes_nothing() {
    let text = |rest: &str| {
        format!(
            "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"a * b\"\n[[source]]\nname = \"a\"\nvalue = 2\nu = 1\n[[source]]\nname = \"b\"\nvalue = 3\nu = 1\n{rest}"
        )
    };
    let plain = budgets(&text("")).remove(0);
    let more = budgets(&text("[[source]]\nname = \"c\"\nu = 5\ndof = 3\n[[correlation]]\nbetween = [\"a\", \"c\"]\nr = 0.9\n")).remove(0);
    assert_eq!(
        (plain.u.to_bits(), plain.nu_eff),
        (more.u.to_bits(), more.nu_eff)
    );
    assert_eq!(more.nu_eff, Freedom::Infinite);
}

#[test]
fn an_unknown_correlation_has_the_worst_sign() {
    let text = |expression: &str| {
        format!(
            "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"{expression}\"\n[[source]]\nname = \"a\"\nu = 3\n[[source]]\nname = \"b\"\nu = 4\n[[correlation]]\nbetween = [\"a\", \"b\"]\nr = \"unknown\"\n"
        )
    };
    for expression in ["a + b", "a - b"] {
        near(budgets(&text(expression)).remove(0).u, 7.0, 1e-14);
    }
}

#[test]
fn the_default_model_has_shares_angles_and_corrections() {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"2 N\", \"4 N\"]\n\
        [[source]]\nname = \"zero\"\nvalue = \"10 mN\"\nu = \"3 mN\"\n\
        [[source]]\nname = \"gain\"\nU = \"1 %\"\nk = 2\nenters = \"relative\"\n\
        [[source]]\nname = \"tilt\"\nhalf_width = \"1 deg\"\nenters = \"cosine\"\n";
    for (budget, at) in budgets(text).iter().zip([2.0, 4.0]) {
        near(budget.value, at + 0.01, 1e-14);
        near(budget.u, (0.003_f64).hypot(0.005 * at), 1e-12);
        assert_eq!(budget.sources[2].contribution.to_bits(), 0.0_f64.to_bits());
        // −ŷ u²/√2 of the tilt is seen by the second order alone.
        assert!(budget.second_order_u > budget.u);
    }
}

#[test]
fn expanded_uncertainties_by_probability_use_students_factor() {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"a\"\nU = \"29.207816224251 mN\"\np = 0.99\ndof = 16\n";
    near(budgets(text)[0].u, 0.01, 1e-12);
}

#[test]
fn a_budget_is_the_same_after_json() {
    let budget = budgets(END_GAUGE).remove(0);
    let text = serde_json::to_string(&budget).expect("JSON");
    assert!(
        text.starts_with(r#"{"schema":"taceva.budget/1","measurand":"l""#),
        "{text}"
    );
    assert!(text.contains(r#""nu":"infinite""#), "{text}");
    let back: Budget = serde_json::from_str(&text).expect("a budget");
    assert_eq!(back, budget);
}
