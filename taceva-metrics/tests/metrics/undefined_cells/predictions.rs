//! Metrics that the paper does not define: values by hand, and reasons for missing values.

use super::*;

#[test]
fn the_noise_equivalent_force_and_the_error_at_zero_come_from_samples_without_contact() {
    // Ten predictions of ±0.01 N: variance 10⁻⁴ × 10 / 9.
    let idle = |count: u32| {
        let samples =
            (0..count).map(|row| pair(&[0.019], &[if row % 2 == 0 { 0.01 } else { -0.01 }]));
        let touched = pair(&[0.02], &[5.0]);
        samples.chain([touched]).collect::<Vec<_>>()
    };
    let evaluation = evaluate("noise_equivalent_force", &["Fz"], &idle(10));
    let score = evaluation
        .score("noise_equivalent_force", "Fz")
        .expect("scored");
    let deviation = (1e-3_f64 / 9.0).sqrt();
    // The noncentrality of 9 degrees of freedom, and a baseline of ten pictures.
    close(
        scalar(&evaluation, "noise_equivalent_force", "Fz"),
        3.575_384_834_044_819 * 1.1_f64.sqrt() * deviation,
    );
    let variant = |name: &str| score.variant(name).and_then(|of| of.value.scalar());
    close(
        variant("known_deviation").expect("a number"),
        3.29 * deviation,
    );
    close(
        variant("critical").expect("a number"),
        1.833_112_932_656_237_2 * 1.1_f64.sqrt() * deviation,
    );
    let few = evaluate("noise_equivalent_force", &["Fz"], &idle(9));
    assert_eq!(
        said(&few, "noise_equivalent_force", "Fz"),
        "fewer than 10 samples"
    );
    let shifted: Vec<Sample> = (0..12)
        .map(|row| pair(&[0.001], &[if row % 2 == 0 { 0.045 } else { 0.025 }]))
        .collect();
    let evaluation = evaluate("zero_error", &["Fz"], &shifted);
    close(scalar(&evaluation, "zero_error", "Fz"), 0.035);
}

#[test]
fn a_gain_and_an_offset_are_no_error_of_linearity() {
    let samples: Vec<Sample> = (0..40)
        .map(|row| {
            at(
                &row.to_string(),
                pair(&[f64::from(row)], &[0.5 + 0.75 * f64::from(row)]),
            )
        })
        .collect();
    let evaluation = evaluate("linearity", &["Fz"], &samples);
    assert_eq!(
        scalar(&evaluation, "linearity", "Fz").to_bits(),
        0.0_f64.to_bits()
    );
    let constant: Vec<Sample> = (0..5).map(|row| pair(&[1.0], &[f64::from(row)])).collect();
    let constant = evaluate("linearity", &["Fz"], &constant);
    assert_eq!(said(&constant, "linearity", "Fz"), "constant truth");
}

#[test]
fn a_force_that_leaks_into_another_is_named() {
    let sample = |row: u32| {
        let (x, z) = (f64::from(row % 5), f64::from(row / 5));
        at(&row.to_string(), pair(&[x, z], &[x + 0.1 * z, z]))
    };
    let samples: Vec<Sample> = (0..25).map(sample).collect();
    let evaluation = evaluate("crosstalk", &["Fx", "Fz"], &samples);
    close(scalar(&evaluation, "crosstalk", "all"), 0.1);
    let matrix = score(&evaluation, "crosstalk", "all")
        .variant("matrix")
        .expect("a matrix");
    let Value::Matrix(matrix) = &matrix.value else {
        panic!("{:?}", matrix.value);
    };
    assert_eq!(matrix.columns, ["Fx", "Fz"]);
    close(matrix.values[0][1].expect("a share"), 0.1);
    let alike: Vec<Sample> = (0..9)
        .map(|row| pair(&[f64::from(row); 2], &[f64::from(row); 2]))
        .collect();
    let alike = evaluate("crosstalk", &["Fx", "Fz"], &alike);
    assert_eq!(
        score(&alike, "crosstalk", "all").flags,
        [Flag::CollinearTruths]
    );
    let one = evaluate("crosstalk", &["Fz"], &samples_of_one());
    assert_eq!(
        said(&one, "crosstalk", "all"),
        "one channel, two are needed"
    );
}

fn samples_of_one() -> Vec<Sample> {
    (0..5).map(|row| pair(&[f64::from(row)], &[0.0])).collect()
}

#[test]
fn errors_that_cancel_over_the_range_show_at_their_levels() {
    let samples: Vec<Sample> = (0..20)
        .map(|row| {
            let (truth, error) = if row % 2 == 0 {
                (0.05, 0.25)
            } else {
                (-0.05, -0.25)
            };
            pair(&[truth], &[truth - error])
        })
        .collect();
    let evaluation = evaluate("bias_level", &["Fz"], &samples);
    close(scalar(&evaluation, "bias_level", "Fz"), 0.25);
    let curve = score(&evaluation, "bias_level", "Fz")
        .variant("curve")
        .expect("a curve");
    let Value::Curve(curve) = &curve.value else {
        panic!("{:?}", curve.value);
    };
    assert_eq!(
        (&curve.x[..], &curve.counts[..]),
        (&[-0.05, 0.05][..], &[10, 10][..])
    );
    let few = evaluate("bias_level", &["Fz"], &samples[..4]);
    assert_eq!(said(&few, "bias_level", "Fz"), "no bin has 5 samples");
    let light = evaluate("bias_level", &["Light"], &samples);
    assert_eq!(
        said(&light, "bias_level", "Light"),
        "no step is defined for lx"
    );
}

#[test]
fn an_error_as_large_as_the_tolerance_is_within_it() {
    // In binary64 0.40 − 0.35 is above 0.05.
    let samples = [
        pair(&[0.40], &[0.35]),
        pair(&[0.40], &[0.349]),
        pair(&[-1.0], &[3.0]),
    ];
    let evaluation = evaluate("tolerance", &["Pz"], &samples);
    assert_eq!(
        scalar(&evaluation, "tolerance", "Pz").to_bits(),
        (1.0_f64 / 3.0).to_bits()
    );
    let curve = score(&evaluation, "tolerance", "Pz")
        .variant("curve")
        .expect("a curve");
    let Value::Curve(curve) = &curve.value else {
        panic!("{:?}", curve.value);
    };
    let shares: Vec<f64> = curve.values.iter().flatten().copied().collect();
    assert_eq!(curve.x, [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0]);
    assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]));
}

#[test]
fn an_error_that_grows_by_a_newton_an_hour_drifts_by_that() {
    let start = 1.7e9;
    let sample = |row: u32| {
        let hours = f64::from(row) * 0.25;
        at(
            &row.to_string(),
            timed(start + 3600.0 * hours, pair(&[hours], &[0.0])),
        )
    };
    let samples: Vec<Sample> = (0..12).map(sample).collect();
    let evaluation = evaluate("drift", &["Fz"], &samples);
    let score = score(&evaluation, "drift", "Fz");
    assert_eq!(
        (score.value.scalar(), score.unit),
        (Some(1.0), Unit::NewtonPerHour)
    );
    assert!(score.interval.ends().is_some());
    let equal = [
        timed(1.0, pair(&[1.0], &[0.0])),
        timed(1.0, pair(&[2.0], &[0.0])),
    ];
    assert_eq!(
        said(&evaluate("drift", &["Fz"], &equal), "drift", "Fz"),
        "equal time stamps"
    );
    assert_eq!(
        said(&evaluate("drift", &["Fz"], &equal[..1]), "drift", "Fz"),
        "fewer than 2 samples"
    );
}
