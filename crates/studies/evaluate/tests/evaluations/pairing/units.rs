//! Predictions in another unit than the truth.

use std::fmt::Write as _;

use super::Tables;

/// Notes on forces in N at twenty contact points. `predict` computes a prediction from the row number and the truth.
fn notes(predict: impl Fn(u32, f64) -> f64) -> Vec<String> {
    let mut truth = "id,point_id,Fz\n".to_owned();
    let mut prediction = "id,Fz\n".to_owned();
    for row in 0..200_u32 {
        let force = 0.1 + f64::from(row * 7 % 50) * 0.1;
        let _ = writeln!(truth, "{row},p{},{force}", row % 20);
        let _ = writeln!(prediction, "{row},{}", predict(row, force));
    }
    let mut tables = Tables::new(&truth, &prediction);
    tables.request.metrics = vec!["linearity".to_owned()];
    tables.scored().report.provenance.notes
}

#[test]
fn forces_in_another_unit_are_noted_with_the_unit_to_write() {
    let noise = |row: u32| f64::from(row * 13 % 11) * 0.01;
    let small = notes(|row, force| (force + noise(row)) / 1000.0);
    let expected = "Fz: predictions follow the truth at about a thousandth of its size, as numbers in m and mm do; write the truth and \
                    the predictions of Fz in N";
    assert!(small.iter().any(|note| note == expected), "{small:?}");
    let great = notes(|row, force| (force + noise(row)) * 1000.0);
    let is_noted = |note: &String| note.contains("about a thousand times its size");
    assert!(great.iter().any(is_noted), "{great:?}");
}

#[test]
fn ordinary_forces_and_predictions_near_zero_or_near_the_mean_have_no_note() {
    let ordinary = notes(|row, force| 0.9 * force + f64::from(row % 7) * 0.05);
    let near_zero = notes(|row, force| force * (f64::from(row * 13 % 17) - 8.0) / 4000.0);
    let near_mean = notes(|row, force| 2.5 + 0.001 * force + f64::from(row * 13 % 11) * 1e-5);
    for notes in [ordinary, near_zero, near_mean] {
        let is_noted = |note: &String| note.contains("predictions follow the truth");
        assert!(!notes.iter().any(is_noted), "{notes:?}");
    }
}
