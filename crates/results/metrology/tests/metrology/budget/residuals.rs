//! One-way components of residuals, and budgets that use the components.

use taceva_metrology::budget::{BudgetText, Components, Evidence, Figure, Freedom, Residuals};

use super::{near, number};

fn groups() -> [(&'static str, Vec<f64>); 5] {
    [
        ("a", vec![0.012, -0.02, 0.005]),
        ("b", vec![0.031, 0.04]),
        ("c", vec![-0.015, -0.022, -0.01, -0.018]),
        ("d", vec![0.002]),
        ("e", vec![0.025, 0.019, 0.03]),
    ]
}

fn components() -> Components {
    let mut residuals = Residuals::default();
    for (point, values) in groups() {
        values
            .iter()
            .for_each(|value| residuals.add(point, *value, 0.0));
    }
    residuals.components().expect("components")
}

#[test]
fn unequal_points_have_the_components_of_the_one_way_model() {
    let found = components();
    near(
        found.mean_square_between,
        0.001_232_251_602_564_102_5,
        1e-13,
    );
    near(found.mean_square_within, 9.298_958_333_333_334e-5, 1e-13);
    near(found.n0, 2.5, 1e-15);
    near(found.within.u, 0.009_643_110_666_861_255, 1e-13);
    near(found.between.u, 0.021_347_243_561_928_73, 1e-13);
    near(
        found.between.freedom.number().expect("finite"),
        3.409_365_938_091_475_4,
        1e-12,
    );
    near(found.bias.value, 0.006_076_923_076_923_077, 1e-13);
    // √(MS_b/n) of the reference, 0.009736, holds for points of one size alone.
    near(found.bias.u, 0.010_597_909_831_697_425, 1e-13);
    assert_eq!((found.within.n, found.within.clusters), (Some(13), Some(5)));
    assert!(!found.is_negative);
}

#[test]
fn order_and_parts_of_rows_change_no_bit() {
    let mut parts = [Residuals::default(), Residuals::default()];
    let rows = groups()
        .into_iter()
        .flat_map(|(point, values)| values.into_iter().map(move |value| (point, value)));
    let rows: Vec<(&str, f64)> = rows.collect();
    for (at, (point, value)) in rows.iter().rev().enumerate() {
        parts[at % 2].add(point, *value, 0.0);
    }
    let [mut whole, other] = parts;
    whole.merge(&other);
    assert_eq!(whole.components().expect("components"), components());
}

#[test]
fn a_large_common_offset_does_not_swallow_the_spread() {
    let mut residuals = Residuals::default();
    for (point, values) in [("a", [1.0, 2.0]), ("b", [4.0, 5.0])] {
        values
            .iter()
            .for_each(|value| residuals.add(point, 4e9 + value, 0.0));
    }
    let found = residuals.components().expect("components");
    near(found.mean_square_within, 0.5, 1e-13);
    near(found.mean_square_between, 9.0, 1e-13);
}

#[test]
fn rows_that_are_no_numbers_are_counted_and_left_out() {
    let mut residuals = Residuals::default();
    for truth in [1.0, f64::NAN, f64::INFINITY] {
        residuals.add("a", truth, 0.0);
    }
    assert_eq!(residuals.n_invalid(), 2);
    assert!(residuals.components().is_err());
}

const DEFAULT_RUN: &str = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"0.5 N\"]\n\
    [[source]]\nname = \"transducer\"\nU = \"3 mN\"\nk = 2\n\
    [[source]]\nname = \"place to place\"\nfrom = \"error.between\"\n\
    [[source]]\nname = \"one reading\"\nfrom = \"error.within\"\nreadings = 1\n";

#[test]
fn the_default_run_has_the_budgets_of_the_prototype() {
    let golden: serde_json::Value =
        serde_json::from_str(include_str!("../../golden/bench_run1.json")).expect("JSON");
    for sensor in ["vitactip", "magictac", "gelsight", "gelsightwm"] {
        let of = &golden[sensor];
        let parts = &of["spatial Fz"];
        let (n, g) = (number(&parts["n"]), number(&parts["points"]));
        let figure = |which: &str, freedom: f64| {
            Figure::new(number(&parts[which]), Freedom::Finite(freedom))
        };
        // The prototype gives `between` G − 1 degrees of freedom.
        let evidence = Evidence::default()
            .with("error.between", figure("between", g - 1.0))
            .with("error.within", figure("within", n - g));
        let text = BudgetText::parse(DEFAULT_RUN).expect("a budget");
        let budget = text.budgets(&evidence, None).expect("values").remove(0);
        let expected = &of["budget"];
        near(budget.u, number(&expected["u"]), 1e-12);
        near(
            budget.nu_eff.number().expect("finite"),
            number(&expected["nu"]),
            1e-12,
        );
        near(budget.expanded.expect("U"), number(&expected["U"]), 1e-11);
        let shares = ["transducer (assumed U=3 mN,k=2)", "between", "within"];
        for (source, share) in budget.sources.iter().zip(shares) {
            near(
                source.share.expect("a share"),
                number(&expected["share"][share]),
                1e-12,
            );
        }
    }
}

#[test]
fn effects_that_no_source_covers_are_named() {
    let text = BudgetText::parse(&format!(
        "{DEFAULT_RUN}[[source]]\nname = \"lamp\"\nhalf_width = \"10 mN\"\ncovers = \"r_light\"\n"
    ));
    let evidence = components()
        .feed(Evidence::default())
        .with("hysteresis", Figure::new(0.01, Freedom::Infinite));
    let budget = text
        .and_then(|text| text.budgets(&evidence, None))
        .expect("values")
        .remove(0);
    let missing: Vec<String> = budget
        .missing
        .iter()
        .map(|of| format!("{}: {}", of.source, of.reason))
        .collect();
    assert_eq!(
        missing,
        [
            "hysteresis: unloading: measured, but no source of the budget names it",
            "gauge: other units: not in this recording",
            "drift: other days: not in this recording",
            "bias: mean residual: measured, but no source of the budget names it",
            "certificate: reference: the recording has no certificate",
        ]
    );
    assert!(
        budget.to_string().starts_with("warning: not traceable"),
        "{budget}"
    );
}

#[test]
fn a_measured_bias_that_nothing_corrects_is_named() {
    let named = |sources: &str| {
        let text = format!("budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n{sources}");
        let text = BudgetText::parse(&text).expect("a budget");
        let evidence = components().feed(Evidence::default());
        let budget = text.budgets(&evidence, None).expect("values").remove(0);
        budget.missing.iter().any(|of| of.source == "bias")
    };
    let between = "[[source]]\nname = \"places\"\nfrom = \"error.between\"\n";
    let bias = "[[source]]\nname = \"correction\"\nfrom = \"bias\"\n";
    assert!(named(between));
    assert!(!named(&[between, bias].concat()));
    assert!(!named("[[source]]\nname = \"all\"\nfrom = \"error\"\n"));
}

#[test]
fn the_mean_of_readings_lowers_no_difference_between_places() {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"places\"\nfrom = \"error.between\"\nreadings = 4\n";
    let evidence = components().feed(Evidence::default());
    let refused = super::refusal(text, &evidence);
    assert!(
        refused.contains("`error.between` is the same in every reading of a place"),
        "{refused}"
    );
    let units = text.replace("error.between", "g.json#unit");
    let refused = super::refusal(&units, &evidence);
    assert!(
        refused.contains("`g.json#unit` is the same in every reading of a place"),
        "{refused}"
    );
    let repeats = text.replace("error.between", "g.json#repeatability");
    let evidence = evidence.with(
        "g.json#repeatability",
        Figure::new(0.02, Freedom::Finite(9.0)),
    );
    let budgets = BudgetText::parse(&repeats).and_then(|text| text.budgets(&evidence, None));
    assert!((budgets.expect("a budget")[0].u - 0.01).abs() < 1e-15);
}

#[test]
fn rows_of_a_point_are_not_all_degrees_of_freedom_of_the_root_mean_square() {
    // Ten points of ten equal rows each know the root mean square as ten rows do.
    let mut residuals = Residuals::default();
    for point in 0..10_u32 {
        for row in 0..10_u32 {
            let truth = f64::from(point * point) + 1e-6 * f64::from(row % 2);
            residuals.add(&point.to_string(), truth, 0.0);
        }
    }
    let found = residuals.components().expect("components");
    let freedom = found.rmse.freedom.number().expect("finite");
    assert!((freedom - 9.0).abs() < 1e-6, "{freedom}");
}

#[test]
fn a_drift_is_a_rectangle_of_slope_times_hours_and_a_mean_has_its_root() {
    let text = BudgetText::parse(
        "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"days\"\nfrom = \"drift\"\nhours = 8\n\
         [[source]]\nname = \"four\"\nfrom = \"repeatability\"\nreadings = 4\n[[source]]\nname = \"unit\"\nfrom = \"gauge.json#unit\"\n",
    )
    .expect("a budget");
    let evidence = Evidence::default()
        .with("drift", Figure::of_drift(-0.002))
        .with("repeatability", Figure::new(0.01, Freedom::Finite(9.0)))
        .with(
            "gauge.json#unit",
            Figure::new(0.02, Freedom::Finite(3.0)).of_digest("abc"),
        );
    let budget = text.budgets(&evidence, None).expect("values").remove(0);
    near(budget.sources[0].u, 0.016 / 3_f64.sqrt(), 1e-14);
    near(budget.sources[1].u, 0.005, 1e-14);
    assert_eq!(budget.sources[2].digest.as_deref(), Some("abc"));
    assert!(
        !budget
            .missing
            .iter()
            .any(|of| of.source == "gauge" || of.source == "drift")
    );
}
