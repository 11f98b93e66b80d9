//! Invalid input of curves gives a named reason, never a number.

use taceva_metrology::curve::{
    CurveFit, CurveRow, CurveUndefined, DetectionRisks, Indication, IndicationLevel, ProvingSeries,
    Standing,
};

use super::rows;

#[test]
fn equal_x_have_no_curve() {
    let found = CurveFit::of(&rows(&[1.0; 5], &[1.0, 2.0, 3.0, 4.0, 5.0]), 1);
    assert_eq!(found.expect_err("undefined"), CurveUndefined::EqualX);
}

#[test]
fn as_few_rows_as_coefficients_have_no_curve() {
    for order in 1..=3 {
        let x: Vec<f64> = (0..=order).map(|at| at as f64).collect();
        let found = CurveFit::of(&rows(&x, &x), order).expect_err("undefined");
        assert_eq!(
            found,
            CurveUndefined::TooFewRows {
                have: order + 1,
                least: order + 2
            }
        );
    }
    let found = CurveFit::of(&rows(&[0.0, 0.0, 1.0, 1.0], &[1.0; 4]), 2).expect_err("undefined");
    assert_eq!(found, CurveUndefined::TooFewX { have: 2, least: 3 });
}

#[test]
fn numbers_orders_and_probabilities_out_of_range_are_said() {
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    assert_eq!(
        CurveFit::of(&rows(&x, &x), 4).expect_err("undefined"),
        CurveUndefined::Order(4)
    );
    assert_eq!(
        CurveFit::of(&rows(&x, &x), 0).expect_err("undefined"),
        CurveUndefined::Order(0)
    );
    let wrong = [0.0, f64::NAN, 2.0, 3.0, 4.0];
    assert_eq!(
        CurveFit::of(&rows(&x, &wrong), 1).expect_err("undefined"),
        CurveUndefined::NotFinite { row: 2 }
    );
    let line = CurveFit::of(&rows(&x, &[0.0, 1.1, 2.0, 2.9, 4.0]), 1).expect("a line");
    assert!(line.confidence(1.0, 1.0).is_err() && line.prediction(1.0, 0.0, 1).is_err());
    assert!(line.prediction(1.0, 0.95, 0).is_err() && line.invert(1.0, f64::NAN, 1).is_err());
    let risks = DetectionRisks {
        alpha: 0.6,
        ..DetectionRisks::default()
    };
    assert_eq!(
        line.detection(risks).expect_err("undefined"),
        CurveUndefined::Probability(0.6)
    );
    let bent = CurveFit::of(
        &[CurveRow::new(5.0, 1.0)]
            .into_iter()
            .chain(rows(&x, &x))
            .collect::<Vec<_>>(),
        2,
    );
    let bent = bent.expect("a parabola");
    assert_eq!(
        bent.invert(1.0, 0.95, 1).expect_err("undefined"),
        CurveUndefined::NotALine(2)
    );
    assert_eq!(
        bent.detection(DetectionRisks::default())
            .expect_err("undefined"),
        CurveUndefined::NotALine(2)
    );
}

fn series() -> ProvingSeries {
    let mut series = ProvingSeries::new(&[1.0, 2.0, 3.0, 4.0]);
    let x = series.forces.clone();
    (series.x1, series.x3, series.x5) = (x.clone(), x.clone(), x);
    series
}

#[test]
fn negative_inputs_of_a_class_are_said_by_name() {
    let mut negative = series();
    negative.forces[1] = -2.0;
    assert_eq!(
        negative.figures().expect_err("undefined").to_string(),
        "force -2 is found, expected a number above 0"
    );
    let mut negative = series();
    negative.x5[3] = -4.0;
    assert_eq!(
        negative.figures().expect_err("undefined").to_string(),
        "reading -4 is found, expected a number above 0"
    );
    let mut negative = series();
    negative.resolution = Some(0.0);
    assert!(negative.figures().is_err());
    let level = IndicationLevel::new(&[Indication::new(1.0, 1.0)]);
    assert_eq!(
        level.figures(-1.0).expect_err("undefined").to_string(),
        "full scale -1 is found, expected a number above 0"
    );
}

#[test]
fn missing_series_are_named_and_the_class_is_unknown() {
    let found = series().figures().expect("figures");
    assert_eq!(found.levels[0].b_prime, None);
    assert_eq!(found.levels[0].v, None);
    let place = found.standing(0);
    assert_eq!(
        place,
        Standing::Unknown {
            missing: vec![
                "X2",
                "zero readings",
                "X4' and X6'",
                "creep readings",
                "the resolution"
            ]
        }
    );
    assert_eq!(
        place.to_string(),
        "unknown: X2, zero readings, X4' and X6', creep readings and the resolution are missing"
    );
    let mut short = series();
    short.x2 = vec![1.0];
    assert_eq!(
        short.figures().expect_err("undefined").to_string(),
        "series X2 has 1 level, expected 4"
    );
    let mut none = series();
    none.x5.clear();
    assert_eq!(
        none.figures().expect_err("undefined"),
        CurveUndefined::MissingSeries("X5")
    );
}
