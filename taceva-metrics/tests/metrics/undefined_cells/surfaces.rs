//! Surfaces of units, registered to each other.

use super::*;

fn surface(unit: &str, named: bool, place: impl Fn(f64, f64) -> [f64; 3]) -> Vec<Sample> {
    let sample = |number: u32| {
        let (x, y) = (f64::from(number % 7) - 3.0, f64::from(number / 7) - 3.0);
        Sample::default()
            .with_unit_id(unit.to_owned())
            .with_point_id(named.then(|| number.to_string()))
            .with_truth(Readings::from_values(place(x, y)))
    };
    (0..49).map(sample).collect()
}

fn dome(x: f64, y: f64) -> [f64; 3] {
    [x, y, -0.1 * x * x - 0.05 * y * y + 0.02 * x * y]
}

#[test]
fn a_surface_that_was_only_moved_has_no_gap() {
    let (sine, cosine) = (0.6, 0.8);
    let moved = |x: f64, y: f64| {
        let [x, y, z] = dome(x, y);
        [cosine * x - sine * y + 0.5, sine * x + cosine * y, z - 1.0]
    };
    let samples = [surface("a", true, dome), surface("b", true, moved)].concat();
    let evaluation = evaluate("inter_sensor", &["Px", "Py", "surface_z"], &samples);
    assert!(scalar(&evaluation, "inter_sensor", "surface_z") < 1e-13);
    let score = score(&evaluation, "inter_sensor", "surface_z");
    assert_eq!(score.count("pairs_by_point_id"), Some(1));
    assert!(score.interval.ends().is_some());
}

#[test]
fn surfaces_without_shared_points_are_laid_onto_each_other_step_by_step() {
    let moved = |x: f64, y: f64| {
        let [x, y, z] = dome(x, y);
        [x + 0.1, y - 0.1, z + 0.5]
    };
    let samples = [surface("a", false, dome), surface("b", false, moved)].concat();
    let evaluation = evaluate("inter_sensor", &["Px", "Py", "surface_z"], &samples);
    assert!(scalar(&evaluation, "inter_sensor", "surface_z") < 1e-13);
    let score = score(&evaluation, "inter_sensor", "surface_z");
    assert_eq!(score.count("pairs_by_point_id"), Some(0));
    assert_eq!(score.count("pairs_unsettled"), Some(0));
}

#[test]
fn a_single_unit_or_a_line_of_points_has_no_gap_to_measure() {
    let channels = ["Px", "Py", "surface_z"];
    let one = evaluate("inter_sensor", &channels, &surface("a", true, dome));
    assert_eq!(
        said(&one, "inter_sensor", "surface_z"),
        "one unit, two are needed"
    );
    let line = |x: f64, _: f64| [x, 0.0, 0.0];
    let lines = [surface("a", false, line), surface("b", false, line)].concat();
    let lines = evaluate("inter_sensor", &channels, &lines);
    assert_eq!(
        said(&lines, "inter_sensor", "surface_z"),
        "points on one line do not determine a rotation"
    );
}
