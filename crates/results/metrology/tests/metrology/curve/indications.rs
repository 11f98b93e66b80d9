//! Figures like those of ISO 7500-1.

use taceva_metrology::budget::two_digits;
use taceva_metrology::curve::{Indication, IndicationLevel, IndicationSummary};

use super::{near, number, numbers};

fn golden() -> serde_json::Value {
    serde_json::from_str(include_str!("../../golden/iso7500.json")).expect("JSON")
}

#[test]
fn hand_made_levels_have_the_golden_figures() {
    for case in golden()["cases"].as_array().expect("cases") {
        let (input, expected) = (&case["in"], &case["out"]);
        let nominal = number(&input["nominal"]);
        let repeats: Vec<Indication> = numbers(&input["inc"])
            .iter()
            .map(|truth| Indication::new(nominal, *truth))
            .collect();
        let mut level = IndicationLevel::new(&repeats);
        level.down = input["dec"]
            .as_f64()
            .map(|truth| Indication::new(nominal, truth));
        level.zeros = input["zero"]
            .as_array()
            .map(|_| numbers(&input["zero"]))
            .unwrap_or_default();
        let found = level.figures(nominal).expect("figures");
        let same = |found: Option<f64>, name: &str| match expected[name].as_f64() {
            Some(expected) => assert!(
                (found.expect("a figure") - expected).abs() < 1e-12,
                "{name}: {expected}"
            ),
            None => assert_eq!(found, None, "{name}"),
        };
        for (q, expected) in found.q.iter().zip(numbers(&expected["q"])) {
            assert!((q - expected).abs() < 1e-12);
        }
        same(Some(found.q_mean), "q_mean");
        same(found.b, "b");
        same(found.v, "v");
        same(found.f_0, "f0");
    }
}

fn level(truths: &[f64]) -> IndicationLevel {
    let repeats: Vec<Indication> = truths
        .iter()
        .map(|truth| Indication::new(100.0, *truth))
        .collect();
    IndicationLevel::new(&repeats)
}

#[test]
fn a_blank_reading_is_no_error_of_zero() {
    let found = level(&[98.0, f64::NAN, 98.0])
        .figures(100.0)
        .expect("figures");
    assert_eq!((found.q.len(), found.b), (2, None));
    near(found.q_mean, 100.0 * 2.0 / 98.0, 1e-14);
    assert!(level(&[f64::NAN; 3]).figures(100.0).is_err());
}

#[test]
fn the_range_is_that_of_all_repeats() {
    near(
        level(&[100.0, 98.0, 100.0])
            .figures(100.0)
            .expect("figures")
            .b
            .expect("three"),
        100.0 * 2.0 / 98.0,
        1e-14,
    );
}

#[test]
fn the_mean_of_three_is_uncertain_by_the_root_of_three() {
    let found = level(&[100.0, 98.0, 100.0])
        .figures(100.0)
        .expect("figures");
    let off = 100.0 * 2.0 / 98.0;
    // s of (off, 0, 0) is off/√3.
    near(
        found.q_mean_u.expect("three"),
        off / 3_f64.sqrt() / 3_f64.sqrt(),
        1e-14,
    );
}

#[test]
fn expanded_uncertainties_are_not_cut_downwards() {
    for (expanded, rounded) in [
        (0.0480, 0.048),
        (0.3 * 0.16, 0.048),
        (0.0475, 0.048),
        (9.96, 10.0),
        (92.48, 92.0),
        (1.049, 1.0),
        (0.0, 0.0),
    ] {
        let found = two_digits(expanded);
        assert!((found - rounded).abs() < 1e-15, "{expanded}: {found}");
        assert!(found >= 0.95 * expanded);
    }
}

#[test]
fn two_repeats_have_no_range() {
    let found = level(&[100.0, 98.0]).figures(100.0).expect("figures");
    assert_eq!(found.b, None);
    assert_eq!(
        found.standing().to_string(),
        "unknown: three repeats, a downward series, zero readings and the resolution are missing"
    );
}

#[test]
fn a_level_beyond_class_3_says_the_figure_the_end_and_a_multiple() {
    let said = level(&[93.0, 94.0, 93.0])
        .figures(100.0)
        .expect("figures")
        .standing()
        .to_string();
    assert_eq!(
        said,
        "none: q = 7.1 %, class 3 ends at 3.00 %; known figures within class 1 x 10, not a class of ISO 7500-1"
    );
    let mut good = level(&[100.1, 100.2, 100.1]);
    (good.down, good.zeros, good.resolution) =
        (Some(Indication::new(100.0, 99.9)), vec![0.01], Some(0.1));
    let said = good.figures(100.0).expect("figures").standing().to_string();
    assert_eq!(
        said,
        "within row 0.5 of limits like those of ISO 7500-1, which is not a class of the standard"
    );
}

#[test]
fn the_default_run_is_beyond_every_row() {
    for (sensor, q) in [
        ("vitactip", "7.2"),
        ("magictac", "4.8"),
        ("gelsight", "10.6"),
        ("gelsightwm", "11.3"),
    ] {
        let of = &golden()["run1"][sensor];
        let median = number(&of["q_spatial"]["median_abs"]);
        let truth = 100.0 / (1.0 + median / 100.0);
        let mut level = level(&[truth; 3]);
        level.zeros = vec![number(&of["f0"]) / 100.0];
        let found = level.figures(1.0).expect("figures");
        near(found.q_mean, median, 1e-12);
        near(found.f_0.expect("zeros"), number(&of["f0"]), 1e-12);
        assert!(
            found.standing().to_string().starts_with("none: f_0 = "),
            "{}",
            found.standing()
        );
        level.zeros.clear();
        let said = level.figures(1.0).expect("figures").standing().to_string();
        assert!(
            said.starts_with(&format!("none: q = {q} %, class 3 ends at 3.00 %")),
            "{said}"
        );
    }
}

#[test]
fn the_share_within_class_3_is_the_figure_that_can_grow() {
    // As many presses within 3 % as the default run has on ViTacTip.
    let of = &golden()["run1"]["vitactip"]["q_spatial"];
    let (n, share) = (number(&of["n"]), number(&of["share_within_3"]));
    let within = (n * share).round();
    let presses: Vec<Indication> = (0_u32..95)
        .map(|at| Indication::new(if f64::from(at) < within { 102.9 } else { 107.0 }, 100.0))
        .chain([Indication::new(f64::NAN, 100.0)])
        .collect();
    let found = IndicationSummary::of(&presses).expect("presses");
    assert_eq!(found.n, 95);
    near(found.share_within_3, share, 1e-15);
}
