//! Monte Carlo method of JCGM 101.

use taceva_metrology::budget::{Method, MonteCarlo};

use super::examples::END_GAUGE;
use super::{case, drawn, near, number};

fn all() -> MonteCarlo {
    MonteCarlo::default().to_the_end()
}

/// Text of a sum of rectangular sources with these standard uncertainties.
fn rectangles(uncertainties: &[f64]) -> String {
    let names: Vec<String> = (0..uncertainties.len())
        .map(|at| format!("x{at}"))
        .collect();
    let mut text = format!(
        "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"{}\"\n",
        names.join(" + ")
    );
    for (name, u) in names.iter().zip(uncertainties) {
        let half_width = u * 3_f64.sqrt();
        text.push_str(&format!(
            "[[source]]\nname = \"{name}\"\nhalf_width = {half_width:?}\n"
        ));
    }
    text
}

fn pair(of: &serde_json::Value) -> [f64; 2] {
    [number(&of[0]), number(&of[1])]
}

/// Asserts that an interval end is `expected` within four standard errors of a quantile with this density.
fn within(found: f64, expected: f64, draws: u64, density: f64) {
    let error = (0.025_f64 * 0.975 / draws as f64).sqrt() / density;
    assert!(
        (found - expected).abs() < 4.0 * error,
        "{found} is not {expected} ± {error}"
    );
}

#[test]
fn four_rectangles_have_the_interval_of_irwin_and_hall() {
    let golden = case("JCGM 101 9.2.3");
    let budget = drawn(&rectangles(&[1.0; 4]), all());
    near(budget.expanded.expect("U"), number(&golden["GUF_k"]), 1e-12);
    let found = budget.mcm.expect("draws");
    for (end, sign) in found.symmetric.into_iter().zip([-1.0, 1.0]) {
        // Density (4a − x)³ / (6 (2a)⁴) of the outermost piece.
        let a = 3_f64.sqrt();
        let x = number(&golden["exact"]);
        within(
            end,
            sign * x,
            found.draws,
            (4.0 * a - x).powi(3) / (6.0 * (2.0 * a).powi(4)),
        );
    }
    near(found.u, 2.0, 4.0 / (2.0 * found.draws as f64).sqrt());
}

#[test]
fn one_rectangle_ten_times_as_wide_makes_the_interval_17_0() {
    let golden = case("JCGM 101 9.2.4");
    let budget = drawn(&rectangles(&[1.0, 1.0, 1.0, 10.0]), all());
    near(budget.expanded.expect("U"), number(&golden["GUF"]), 1e-12);
    let found = budget.mcm.as_ref().expect("draws");
    for (end, sign) in found.symmetric.into_iter().zip([-1.0, 1.0]) {
        within(
            end,
            sign * number(&golden["exact"]),
            found.draws,
            0.5 / (10.0 * 3_f64.sqrt()) * 0.5,
        );
    }
    assert!(!found.validated && budget.method == Method::MonteCarlo);
    let said = "the interval is taken from the Monte Carlo draws: the distribution of the value is neither normal nor Student's";
    assert!(
        budget.warnings.iter().any(|warning| warning == said),
        "{:?}",
        budget.warnings
    );
    // First order has U = 19.9 N with k = 1.960.
    let stated = "y = 0 N, U = 17 N (half-width of the Monte Carlo interval, p = 95 %)";
    assert_eq!(budget.statement(), stated);
    assert_eq!(budget.rounded(), Some(17.0));
}

const MASS: &str = r#"
budget_version = 1
measurand = "dm"
unit = "mg"
expression = "(m_R + dm_R) * (1 + (rho_a - 1.2) * (1 / rho_W - 1 / rho_R)) - 100000"
[[source]]
name = "m_R"
value = 100000.000
u = 0.050
[[source]]
name = "dm_R"
value = 1.234
u = 0.020
[[source]]
name = "rho_a"
value = 1.20
half_width = 0.10
[[source]]
name = "rho_W"
value = 8000
half_width = 1000
[[source]]
name = "rho_R"
value = 8000
half_width = 50
"#;

#[test]
fn the_mass_of_9_3_misses_29_percent_of_its_uncertainty_in_first_order() {
    let golden = case("JCGM 101 9.3");
    let budget = drawn(MASS, all());
    near(budget.u, 0.0029_f64.sqrt(), 1e-12);
    // The golden derivatives are of differences.
    near(budget.u, number(&golden["first_order"]["u"]), 1e-9);
    // The golden terms have 100 g in the place of 100.001234 g.
    near(
        budget.second_order_u,
        number(&golden["second_order"]["u"]),
        2e-5,
    );
    let found = budget.mcm.as_ref().expect("draws");
    let of_numpy = &golden["MCM_2e6_seed_12345"];
    let error = found.u / (found.draws as f64).sqrt();
    assert!((found.mean - 1.234).abs() < 4.0 * error, "{}", found.mean);
    near(found.u, number(&of_numpy["u"]), 0.004);
    for (end, expected) in found
        .symmetric
        .into_iter()
        .zip(pair(&of_numpy["symmetric95"]))
    {
        assert!((end - expected).abs() < 1e-3, "{end} is not {expected}");
    }
    // The place of the shortest interval is uncertain, since its width hardly changes with it: in twenty runs of numpy of 2 · 10⁶ draws its low
    // end has the mean 1.0846 and the standard deviation 0.0008. The golden run, 1.0828, is the lowest of all.
    let shortest = pair(&of_numpy["shortest95"]);
    near(
        found.shortest[1] - found.shortest[0],
        shortest[1] - shortest[0],
        0.005,
    );
    assert!(
        (found.shortest[0] - 1.0846).abs() < 0.004,
        "{:?}",
        found.shortest
    );
    assert!(!found.validated);
    let said = "the interval is taken from the Monte Carlo draws: linear terms miss 29 % of u: interaction of rho_a and rho_W";
    assert!(
        budget.warnings.iter().any(|warning| warning == said),
        "{:?}",
        budget.warnings
    );
}

#[test]
fn the_gauge_block_of_9_5_has_838_and_36_nm() {
    // JCGM 101 takes d0, d1 and d2 to one digit, and the limits of both differences as inexactly known.
    let text = END_GAUGE
        .replace("u = 5.8", "u = 6")
        .replace("u = 3.9", "u = 4")
        .replace("u = 6.7", "u = 7");
    let golden = &case("JCGM 101 9.5")["MCM_2e6"];
    let budget = drawn(&text, all());
    let found = budget.mcm.as_ref().expect("draws");
    let error = found.u / (found.draws as f64).sqrt();
    // Theirs are of 2 · 10⁶ draws.
    let both = error * 1.5_f64.sqrt();
    assert!(
        (found.mean - 5e7 - number(&golden["mean"])).abs() < 4.0 * both,
        "{}",
        found.mean
    );
    near(found.u, number(&golden["u"]), 0.005);
    // Twenty runs of numpy of 2 · 10⁶ draws have a low end of mean 744.3 and standard deviation 0.6.
    let shortest = pair(&golden["shortest99"]).map(|end| end + 5e7);
    near(
        found.shortest[1] - found.shortest[0],
        shortest[1] - shortest[0],
        0.008,
    );
    assert!(
        (found.shortest[0] - 5e7 - 744.3).abs() < 3.0,
        "{:?}",
        found.shortest
    );
}

#[test]
fn a_curvilinear_trapezoid_has_its_own_uncertainty() {
    let text = "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"x\"\n[[source]]\nname = \"x\"\nhalf_width = 1\nlimits = 0.5\nshape = \"curvilinear_trapezoid\"\n";
    let budget = drawn(text, all());
    near(budget.u, (1.0_f64 / 3.0 + 0.25 / 9.0).sqrt(), 1e-14);
    near(budget.mcm.expect("draws").u, budget.u, 3e-3);
}

#[test]
fn every_shape_is_drawn_with_its_standard_uncertainty() {
    for (shape, u) in [
        ("rectangular", 1.0 / 3_f64.sqrt()),
        ("triangular", 1.0 / 6_f64.sqrt()),
        ("arcsine", 1.0 / 2_f64.sqrt()),
        ("trapezoid\"\nbeta = \"", (1.25_f64 / 6.0).sqrt()),
    ] {
        let shape = shape.replace("beta = \"", "beta = 0.5 #");
        let text = format!(
            "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"x\"\n[[source]]\nname = \"x\"\nhalf_width = 1\nshape = \"{shape}\"\n"
        );
        let budget = drawn(&text, all());
        near(budget.u, u, 1e-14);
        near(budget.mcm.expect("draws").u, u, 3e-3);
    }
}

#[test]
fn the_mean_of_five_readings_is_drawn_by_student() {
    let text = "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"x\"\n[[source]]\nname = \"x\"\nrows = [1.0, 2.0, 3.0, 4.0, 5.0]\n";
    let budget = drawn(text, all());
    let found = budget.mcm.as_ref().expect("draws");
    // u = √(2.5/5) and t of 4 degrees, whose standard deviation is √2.
    near(found.u, (0.5_f64 * 2.0).sqrt(), 0.02);
    assert!(found.validated, "{found:?} {:?}", budget.interval);
}

#[test]
fn sources_of_one_set_are_drawn_together() {
    let text = "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"a - b\"\n\
        [[source]]\nname = \"a\"\nrows = [1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 4.0, 5.0, 2.0, 3.0]\nset = \"s\"\n\
        [[source]]\nname = \"b\"\nrows = [1.1, 2.0, 3.1, 4.2, 5.0, 7.1, 4.0, 5.0, 2.2, 3.0]\nset = \"s\"\n";
    let budget = drawn(text, all());
    let found = budget.mcm.as_ref().expect("draws");
    assert!(found.validated, "{found:?} {:?}", budget.interval);
    near(found.u, budget.u * (9.0_f64 / 7.0).sqrt(), 0.01);
}

#[test]
fn the_draws_end_once_two_digits_are_stable() {
    let budget = drawn(END_GAUGE, MonteCarlo::default().with_draws(2_000_000));
    let found = budget.mcm.expect("draws");
    assert!(
        found.is_stable && found.draws < 1_000_000,
        "{}",
        found.draws
    );
}

#[test]
fn the_same_seed_gives_the_same_draws_and_another_one_does_not() {
    let some = MonteCarlo::default().with_draws(20_000).to_the_end();
    let [first, again, other] =
        [some, some, some.with_seed(2)].map(|request| drawn(MASS, request).mcm.expect("draws"));
    assert_eq!(first, again);
    assert!((first.mean - other.mean).abs() > 0.0);
}

#[test]
fn chance_does_not_refute_a_normal_value() {
    // Half of the last place of u is 0.5 % of it here, less than the standard error of an end.
    let text = "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"x\"\n[[source]]\nname = \"x\"\nu = 9.9\n";
    for seed in 1..=10 {
        let request = MonteCarlo::default().with_draws(100_000).with_seed(seed);
        let budget = drawn(text, request);
        let found = budget.mcm.as_ref().expect("draws");
        assert!(found.validated, "{seed}: {found:?} {:?}", budget.interval);
        assert!(
            found
                .end_errors
                .iter()
                .all(|error| *error > 0.02 && *error < 0.2)
        );
    }
}

#[test]
fn draws_beyond_the_domain_are_said() {
    let text = "budget_version = 1\nmeasurand = \"y\"\nunit = \"N\"\nexpression = \"sqrt(x)\"\n[[source]]\nname = \"x\"\nvalue = 1\nu = 1\n";
    let budget = drawn(text, all());
    assert!(budget.mcm.is_none());
    assert!(
        budget.warnings[0].contains("is outside the domain"),
        "{:?}",
        budget.warnings
    );
}
