//! Average-and-range method.

use taceva_metrology::gauge::{ComponentName, Method, RangeConstants};

use super::example::{analyse, file, readings, settings, study_of};
use crate::support::{close, number};

#[test]
fn the_range_method_with_printed_constants_is_aiag_s() {
    let golden = &file()["range"];
    let constants = RangeConstants::new(0.5908, 0.5231, 0.3146);
    let found = study_of(&readings(1.0))
        .range_with(&settings(|_| {}), &constants)
        .expect("an estimate");
    close(found.equipment, number(golden, "/EV"), 1e-14, "EV");
    close(found.appraiser, number(golden, "/AV"), 1e-14, "AV");
    close(found.gauge, number(golden, "/GRR"), 1e-14, "GRR");
    close(found.part, number(golden, "/PV"), 1e-14, "PV");
    close(found.total, number(golden, "/TV"), 1e-14, "TV");
    let ndc = 1.41 * found.part / found.gauge;
    close(ndc, number(golden, "/ndc"), 1e-14, "ndc");
}

#[test]
fn the_range_method_at_full_precision_differs_by_what_aiag_rounds() {
    let report = analyse(|settings| settings.method = Method::Range);
    let golden = &file()["range"];
    for (name, key) in [
        (ComponentName::Repeatability, "/EV"),
        (ComponentName::Reproducibility, "/AV"),
        (ComponentName::Gauge, "/GRR"),
        (ComponentName::Part, "/PV"),
    ] {
        let found = report.component(name).expect("a component");
        close(found.sd, number(golden, key), 1.5e-4, key);
        assert!(
            found.ci95[0] < found.sd && found.sd < found.ci95[1],
            "{key}"
        );
    }
    assert!(report.component(ComponentName::Interaction).is_none() && !report.pooled);
}

#[test]
fn the_mean_range_of_normal_numbers_has_published_values() {
    let golden = &file()["d2_exact"];
    for n in [2, 3, 4, 5, 10] {
        let expected = number(golden, &format!("/{n}"));
        close(1.0 / RangeConstants::of(2, 2, n).k1, expected, 1e-13, "d2");
    }
    // By adaptive quadrature of 1 − Φⁿ − (1 − Φ)ⁿ.
    for (n, expected) in [(100, 5.015_187_272_883_384), (1000, 6.482_871_538_267_036)] {
        close(1.0 / RangeConstants::of(2, 2, n).k1, expected, 1e-7, "d2");
    }
    // d3 of two numbers is √(2 − 4/π), so d2* is √2.
    close(RangeConstants::of(2, 2, 2).k2, 0.5_f64.sqrt(), 1e-13, "d2*");
    // Order statistics of three: E R² = 2 + 3√3/π.
    let three = 2.0 + 3.0 * 3.0_f64.sqrt() / std::f64::consts::PI;
    close(
        RangeConstants::of(3, 2, 2).k3,
        1.0 / three.sqrt(),
        1e-13,
        "d2*",
    );
}
