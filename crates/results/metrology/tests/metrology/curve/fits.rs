//! Fits, bands, inverse prediction and detection of published examples.

use taceva_metrology::curve::{CovarianceOf, CurveFit, CurveRow, DetectionRisks};

use super::{case, near, number, numbers, rows};

/// Rows, certified estimates and their standard deviations of a data set from NIST.
struct Certified {
    rows: Vec<CurveRow>,
    coefficients: Vec<[f64; 2]>,
    residual_deviation: f64,
}

fn certified(name: &str) -> Certified {
    let path = format!(
        "{}/../../../taceva-models/tests/strd/{name}.dat",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).expect("a data set of the workspace");
    let words = |line: &str| -> Vec<f64> {
        line.split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect()
    };
    let is_estimate = |line: &&str| line.trim_start().starts_with('B') && words(line).len() == 2;
    let estimates = text
        .lines()
        .filter(is_estimate)
        .map(|line| [words(line)[0], words(line)[1]]);
    let deviation = text
        .lines()
        .find(|line| line.trim_start().starts_with("Standard Deviation   "));
    let data = text
        .lines()
        .rev()
        .skip_while(|line| line.trim().is_empty())
        .map(words)
        .take_while(|numbers| numbers.len() == 2);
    Certified {
        rows: data.map(|pair| CurveRow::new(pair[1], pair[0])).collect(),
        coefficients: estimates.collect(),
        residual_deviation: words(deviation.expect("a residual deviation"))[0],
    }
}

#[test]
fn norris_and_pontius_have_their_certified_values() {
    for (name, order, count) in [("Norris", 1, 36), ("Pontius", 2, 40)] {
        let certified = certified(name);
        assert_eq!(
            (certified.rows.len(), certified.coefficients.len()),
            (count, order + 1)
        );
        let fit = CurveFit::of(&certified.rows, order).expect("a fit");
        let covariance = fit.covariance();
        for (at, [value, deviation]) in certified.coefficients.into_iter().enumerate() {
            near(fit.coefficients()[at], value, 1e-10);
            near(covariance[at][at].sqrt(), deviation, 1e-10);
        }
        near(
            fit.residual_deviation(),
            certified.residual_deviation,
            1e-11,
        );
    }
}

#[test]
fn gum_h3_has_the_line_and_the_bands_of_statsmodels() {
    let golden: serde_json::Value =
        serde_json::from_str(include_str!("../../golden/gum.json")).expect("JSON");
    let h3 = &golden["cases"][2];
    let x: Vec<f64> = numbers(&h3["inputs"]["t"])
        .iter()
        .map(|t| t - 20.0)
        .collect();
    let fit = CurveFit::of(&rows(&x, &numbers(&h3["inputs"]["b"])), 1).expect("a line");
    let own = &h3["own_exact_rational"];
    near(fit.coefficients()[0], number(&own["y1"]), 1e-12);
    near(fit.coefficients()[1], number(&own["y2"]), 1e-12);
    let covariance = fit.covariance();
    near(covariance[0][0].sqrt(), number(&own["u(y1)"]), 1e-12);
    near(covariance[1][1].sqrt(), number(&own["u(y2)"]), 1e-12);
    near(
        covariance[0][1] / (covariance[0][0] * covariance[1][1]).sqrt(),
        number(&own["r"]),
        1e-12,
    );
    near(fit.residual_deviation(), number(&own["s"]), 1e-12);
    near(fit.freedom(), 9.0, 1e-15);
    let at_30 = fit.confidence(10.0, 0.95).expect("a band");
    near(at_30.value, number(&own["b(30)"]), 1e-12);
    near(at_30.u, number(&own["u(b30)"]), 1e-12);
    let mean = numbers(&h3["statsmodels"]["mean_ci_95"]);
    near(at_30.low, mean[0], 1e-12);
    near(at_30.high, mean[1], 1e-12);
    let reading = fit.prediction(10.0, 0.95, 1).expect("a band");
    near(reading.u, number(&own["prediction_s_new_reading"]), 1e-12);
    let band = numbers(&own["prediction_band_95_at_30"]);
    near(reading.low, band[0], 1e-12);
    near(reading.high, band[1], 1e-12);
    assert!(fit.prediction(10.0, 0.95, 4).expect("a band").u < reading.u);
}

#[test]
fn a_simultaneous_band_is_wider_by_scheffes_factor() {
    let x: Vec<f64> = (0..20).map(f64::from).collect();
    let y: Vec<f64> = x.iter().map(|x| x + 0.1 * (7.0 * x).sin()).collect();
    let fit = CurveFit::of(&rows(&x, &y), 1).expect("a line");
    let (one, all) = (
        fit.confidence(3.0, 0.95).expect("a band"),
        fit.simultaneous(3.0, 0.95).expect("a band"),
    );
    // √(2 F(2, 18)) of `quantiles.json`.
    near(
        (all.high - all.value) / all.u,
        (2.0_f64 * 3.554_557_145_661_789).sqrt(),
        1e-12,
    );
    assert!(all.high > one.high);
}

#[test]
fn din_32645_has_its_critical_detectable_and_inverse_values() {
    let golden = case("DIN 32645");
    let (x, y) = (
        numbers(&golden["inputs"]["x"]),
        numbers(&golden["inputs"]["y"]),
    );
    let own = &golden["own"];
    let line = CurveFit::of(&rows(&x, &y), 1).expect("a line");
    near(line.coefficients()[1], number(&own["slope"]), 1e-12);
    near(line.coefficients()[0], number(&own["intercept"]), 1e-12);
    near(line.residual_deviation(), number(&own["s"]), 1e-12);
    let strict = DetectionRisks {
        alpha: 0.01,
        beta: 0.01,
        readings: 1,
    };
    let strict = line.detection(strict).expect("limits");
    near(strict.critical, number(&own["critical_.01"]), 1e-9);
    near(
        strict.twice_critical,
        number(&own["detectable_DIN_.01"]),
        1e-9,
    );
    let usual = line.detection(DetectionRisks::default()).expect("limits");
    near(usual.critical, number(&own["critical_.05"]), 1e-9);
    near(
        usual.factor,
        number(&own["delta_noncentral_nu8_.05_.05"]),
        1e-9,
    );
    near(
        usual.detectable,
        number(&own["detectable_ISO_noncentral_.05"]),
        1e-9,
    );
    let inverse = line.invert(3500.0, 0.99, 1).expect("an inverse");
    near(inverse.x, number(&own["inverse_3500"]), 1e-12);
    near(
        inverse.half_width,
        number(&own["inverse_3500_halfwidth_.01"]),
        1e-9,
    );
}

#[test]
fn fiellers_ends_are_where_the_band_of_a_reading_meets_it() {
    let golden = case("DIN 32645");
    let (x, y) = (
        numbers(&golden["inputs"]["x"]),
        numbers(&golden["inputs"]["y"]),
    );
    let line = CurveFit::of(&rows(&x, &y), 1).expect("a line");
    for (reading, count) in [(3500.0, 1), (6900.0, 3), (100.0, 2)] {
        let found = line.invert(reading, 0.95, count).expect("an inverse");
        near(
            line.prediction(found.low, 0.95, count)
                .expect("a band")
                .high,
            reading,
            1e-10,
        );
        near(
            line.prediction(found.high, 0.95, count)
                .expect("a band")
                .low,
            reading,
            1e-10,
        );
        assert!(found.low < found.x && found.x < found.high);
    }
}

#[test]
fn a_slope_of_chance_has_no_inverse_and_no_detection() {
    let noise = [0.3, -0.2, 0.1, -0.4, 0.25, 0.05];
    let line = CurveFit::of(&rows(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &noise), 1).expect("a line");
    let said = line.invert(0.1, 0.95, 1).expect_err("no slope").to_string();
    assert!(
        said.starts_with("the slope is not shown to differ from 0: Fieller's g is "),
        "{said}"
    );
    assert!(line.detection(DetectionRisks::default()).is_err());
    let flat = CurveFit::of(&rows(&[0.0, 1.0, 2.0, 3.0], &[1.0; 4]), 1).expect("a line");
    assert!(flat.invert(1.0, 0.95, 1).is_err());
}

#[test]
fn lack_of_fit_is_seen_where_repeats_scatter_less_than_the_line_misses() {
    let x = [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0];
    let bent: Vec<f64> = x
        .iter()
        .zip([0.01, -0.01].iter().cycle())
        .map(|(x, off)| x * x + off)
        .collect();
    let line = CurveFit::of(&rows(&x, &bent), 1)
        .expect("a line")
        .lack_of_fit()
        .expect("repeats");
    // Σ 2 (±1)² over 2 degrees against 8 · 10⁻⁴ over 4.
    near(line.f, 4.0 / 2e-4, 1e-9);
    assert!(line.p < 1e-6 && line.freedoms.map(f64::to_bits) == [2.0, 4.0].map(f64::to_bits));
    near(line.pure_deviation, 2e-4_f64.sqrt(), 1e-9);
    let parabola = CurveFit::of(&rows(&x, &bent), 2)
        .expect("a parabola")
        .lack_of_fit()
        .expect("repeats");
    assert!(parabola.f < 1e-9 && parabola.p > 0.99, "{parabola:?}");
    let once = CurveFit::of(&rows(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.1]), 1).expect("a line");
    assert_eq!(once.lack_of_fit(), None);
}

#[test]
fn rows_of_one_point_widen_the_band_and_are_named() {
    // Each point has its own offset, so that ten rows are worth one.
    let of_point = |point: u64| {
        let offset = 0.2 * (1.7 * point as f64).sin();
        let x = point as f64 / 10.0;
        (0..10).map(move |repeat| {
            CurveRow::new(x, x + offset + 1e-4 * f64::from(repeat)).of_point(point)
        })
    };
    let rows: Vec<CurveRow> = (0..12).flat_map(of_point).collect();
    let clustered = CurveFit::of(&rows, 1)
        .expect("a line")
        .confidence(0.5, 0.95)
        .expect("a band");
    assert_eq!(clustered.covariance, CovarianceOf::Points { clusters: 12 });
    assert_eq!(clustered.freedom.to_bits(), 11.0_f64.to_bits());
    let independent: Vec<CurveRow> = rows.iter().map(|row| CurveRow::new(row.x, row.y)).collect();
    let plain = CurveFit::of(&independent, 1)
        .expect("a line")
        .confidence(0.5, 0.95)
        .expect("a band");
    assert_eq!(plain.covariance, CovarianceOf::Rows);
    assert!(clustered.u > 2.0 * plain.u, "{} {}", clustered.u, plain.u);
    near(clustered.value, plain.value, 1e-15);
    let inverse = CurveFit::of(&rows, 1)
        .and_then(|line| line.invert(0.5, 0.95, 1))
        .expect("an inverse");
    assert_eq!(inverse.covariance, CovarianceOf::Points { clusters: 12 });
}

#[test]
fn rows_of_one_point_widen_the_coefficients_too() {
    let rows: Vec<CurveRow> = (0..8_u32)
        .flat_map(|point| (0..4_u32).map(move |row| (point, row)))
        .map(|(point, row)| {
            let x = f64::from(point);
            let offset = if point % 3 == 0 { 0.3 } else { -0.1 };
            CurveRow::new(x, 2.0 * x + offset + 1e-3 * f64::from(row)).of_point(point.into())
        })
        .collect();
    let line = CurveFit::of(&rows, 1).expect("a line");
    assert_eq!(
        line.range().map(f64::to_bits),
        [0.0_f64, 7.0].map(f64::to_bits)
    );
    for power in [0, 1] {
        let found = line.coefficient_uncertainty(power).expect("a coefficient");
        assert_eq!(found.covariance, CovarianceOf::Points { clusters: 8 });
        assert_eq!(found.freedom.to_bits(), 7.0_f64.to_bits());
        assert!(
            found.u > 1.5 * line.covariance()[power][power].sqrt(),
            "{found:?}"
        );
    }
    assert_eq!(line.coefficient_uncertainty(2), None);
}

#[test]
fn the_order_of_rows_and_the_numbers_of_points_change_no_bit() {
    let row = |at: u32, turn: u64| {
        let x = f64::from(at % 5) / 3.0;
        let y = 1.7 * x + (f64::from(at) * 12.9898).sin() / 7.0;
        CurveRow::new(x, y).of_point((u64::from(at % 7) + turn) % 7)
    };
    let bands = |rows: &[CurveRow]| {
        let curve = CurveFit::of(rows, 2).expect("a curve");
        let band = curve.confidence(0.4, 0.95).expect("a band");
        let found = [band.value, band.low, band.high, curve.residual_deviation()];
        (found.map(f64::to_bits), band.covariance)
    };
    let rows: Vec<CurveRow> = (0..60).map(|at| row(at, 0)).collect();
    let mut turned: Vec<CurveRow> = (0..60).rev().map(|at| row(at, 3)).collect();
    turned.rotate_left(17);
    assert_eq!(bands(&rows), bands(&turned));
}

#[test]
fn the_jackknife_of_a_mean_is_its_own_variance() {
    // At the mean of x, points of equal size: u² = Σ (offset − mean)²/(G (G − 1)) up to the slope's part.
    let offsets = [0.3, -0.1, -0.2, 0.2, -0.3, 0.1];
    let rows: Vec<CurveRow> = (0_u64..6)
        .zip(offsets)
        .flat_map(|(point, offset)| {
            [-1.0, 1.0].map(|x| CurveRow::new(x, x + offset).of_point(point))
        })
        .collect();
    let band = CurveFit::of(&rows, 1)
        .expect("a line")
        .confidence(0.0, 0.95)
        .expect("a band");
    let squares: f64 = offsets.iter().map(|offset| offset * offset).sum();
    near(band.u, (squares / 30.0).sqrt(), 1e-12);
    assert_eq!(band.covariance, CovarianceOf::Points { clusters: 6 });
}
