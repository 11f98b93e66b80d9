//! Figures like those of ISO 376.

use taceva_metrology::curve::{ProvingSeries, Standing};

use super::{case, near, number, numbers};

fn series() -> ProvingSeries {
    let inputs = &case("ISO 376")["inputs"];
    let of = |name: &str| numbers(&inputs[name]);
    let pair = |name: &str| [number(&inputs[name][0]), number(&inputs[name][1])];
    let mut series = ProvingSeries::new(&of("F"));
    (series.x1, series.x2, series.x3) = (of("X1"), of("X2"), of("X3"));
    (series.x4, series.x5, series.x6) = (of("X4'"), of("X5"), of("X6'"));
    (series.zeros, series.creep) = (Some(pair("zero")), Some(pair("creep 30 s, 300 s")));
    series.resolution = Some(number(&inputs["resolution"]));
    // The golden figures are over the greatest force.
    series.full_scale = Some(1.0);
    series
}

#[test]
fn made_up_readings_have_the_golden_figures() {
    let own = case("ISO 376")["own"].clone();
    let found = series().figures().expect("figures");
    for (at, level) in found.levels.iter().enumerate() {
        near(level.mean, number(&own["Xr"][at]), 1e-14);
        near(level.b, number(&own["b"][at]), 1e-10);
        near(level.b_prime.expect("X2"), number(&own["b'"][at]), 1e-10);
        let v = number(&own["v"][at]);
        assert!((level.v.expect("X4'") - v).abs() < 1e-11, "{v}");
        // The cubic cancels ten digits of f_c.
        assert!(
            (level.f_c - number(&own["fc"][at])).abs() < 1e-11,
            "{}",
            level.f_c
        );
        near(level.w_rotation, number(&own["w_rep"][at]), 1e-10);
    }
    near(found.f_0.expect("zeros"), number(&own["f0"]), 1e-12);
    near(found.c.expect("creep"), number(&own["c"]), 1e-9);
}

#[test]
fn levels_are_within_the_rows_of_the_golden_classes_and_no_class_is_given() {
    let own = case("ISO 376")["own"].clone();
    let found = series().figures().expect("figures");
    for at in 0..found.levels.len() {
        let Standing::Within { row, .. } = found.standing(at) else {
            panic!("{}", found.standing(at));
        };
        assert_eq!(Some(row), own["class"][at].as_str());
    }
    assert_eq!(
        found.standing(0).to_string(),
        "within row 1 of limits like those of ISO 376, which is not a class of the standard"
    );
}

#[test]
fn a_sensor_far_beyond_says_the_figure_the_end_and_a_multiple() {
    let golden: serde_json::Value =
        serde_json::from_str(include_str!("../../golden/bench_run1.json")).expect("JSON");
    let said = [
        ("vitactip", "4.1", 50),
        ("magictac", "4.0", 50),
        ("gelsight", "2.0", 50),
        ("gelsightwm", "2.2", 50),
    ];
    for (sensor, percent, multiple) in said {
        let b_prime = number(&golden[sensor]["ISO-like % (Fz >= 20 % FS)"]["b' median,max"][0]);
        let mut series = ProvingSeries::new(&[1.0, 2.0, 3.0, 4.0]);
        series.x1 = series.forces.clone();
        // |X2 − X1| is b' of their mean.
        let share = b_prime / 100.0;
        series.x2 = series
            .x1
            .iter()
            .map(|x| x * (1.0 + share / 2.0) / (1.0 - share / 2.0))
            .collect();
        (series.x3, series.x5) = (series.x1.clone(), series.x1.clone());
        let found = series.figures().expect("figures");
        near(found.levels[0].b_prime.expect("X2"), b_prime, 1e-12);
        let multiple = if b_prime <= 2.0 { 20 } else { multiple };
        assert_eq!(
            found.standing(0).to_string(),
            format!(
                "none: b' = {percent} %, class 2 ends at 0.20 %; known figures within class 1 x {multiple}, not a class of ISO 376"
            )
        );
    }
}

#[test]
fn a_figure_beyond_200_times_class_1_has_no_multiple() {
    let mut series = ProvingSeries::new(&[1.0, 2.0, 3.0, 4.0]);
    series.x1 = series.forces.clone();
    (series.x3, series.x5) = (
        series.x1.clone(),
        series.x1.iter().map(|x| 2.0 * x).collect(),
    );
    let said = series.figures().expect("figures").standing(1).to_string();
    assert_eq!(
        said,
        "none: b = 75.0 %, class 2 ends at 0.40 %; beyond class 1 x 200, not a class of ISO 376"
    );
}

#[test]
fn a_coarse_resolution_excludes_rows() {
    let mut series = series();
    // 0.2/0.0004 = 500, the least of row 2.
    series.resolution = Some(0.0004);
    let place = series.figures().expect("figures").standing(0).to_string();
    assert_eq!(
        place,
        "within row 2 of limits like those of ISO 376, which is not a class of the standard"
    );
    series.resolution = Some(0.01);
    let place = series.figures().expect("figures").standing(0).to_string();
    assert_eq!(
        place,
        "unknown: a force of 500 resolutions or more is missing"
    );
}

#[test]
fn an_unknown_resolution_leaves_the_place_unknown() {
    let mut series = series();
    series.resolution = None;
    let place = series.figures().expect("figures").standing(0).to_string();
    assert_eq!(place, "unknown: the resolution is missing");
}

#[test]
fn a_multiple_holds_all_figures_only_if_none_is_missing() {
    let mut series = series();
    series.x2.iter_mut().for_each(|x| *x *= 1.02);
    let place = series.figures().expect("figures").standing(0).to_string();
    assert!(place.contains("; within class 1 x "), "{place}");
    series.creep = None;
    let place = series.figures().expect("figures").standing(0).to_string();
    assert!(
        place.contains("; known figures within class 1 x "),
        "{place}"
    );
}

#[test]
fn relative_uncertainty_is_the_root_of_its_eight_terms() {
    let found = series().figures().expect("figures");
    let of = found.levels[0];
    let terms = [
        1e-4,
        of.w_rotation,
        of.b_prime.expect("X2") / 100.0 / 3_f64.sqrt(),
        1e-4 / (0.2 * 6_f64.sqrt()),
        found.c.expect("creep") / 100.0 / 3_f64.sqrt(),
        found.f_0.expect("zeros") / 100.0,
        2e-5,
        of.f_c / 100.0,
    ];
    let expected = terms.iter().map(|term| term * term).sum::<f64>().sqrt();
    near(found.relative_uncertainty(0, 1e-4, 2e-5), expected, 1e-14);
}
