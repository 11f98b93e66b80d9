//! Loading and unloading: branches out of order, disjoint, or missing.

use super::*;

fn loop_at(point: &str, corners: &[(Phase, f64, f64)]) -> Vec<Sample> {
    let sample = |&(phase, depth, force): &(Phase, f64, f64)| {
        at(point, pair(&[1.0, 2.0, depth, force], &[0.0; 4])).with_phase(phase)
    };
    corners.iter().map(sample).collect()
}

#[test]
fn unsorted_branches_are_compared_all_the_same_and_shown_where_they_lie() {
    use Phase::{Load, Unload};
    // A triangle between (0, 0), (0.5, 0.4), (1, 1) and (0.5, 0.2): area 0.1 of 0.45.
    let corners = [
        (Unload, 0.5, 0.2),
        (Load, 1.0, 1.0),
        (Load, 0.0, 0.0),
        (Unload, 1.0, 1.0),
        (Load, 0.5, 0.4),
        (Unload, 0.0, 0.0),
    ];
    let evaluation = evaluate(
        "hysteresis",
        &["Px", "Py", "Pz", "Fz"],
        &loop_at("a", &corners),
    );
    let score = score(&evaluation, "hysteresis", "Fz");
    close(scalar(&evaluation, "hysteresis", "Fz"), 0.1);
    let greatest = score
        .variant("greatest_difference")
        .and_then(|variant| variant.value.scalar());
    close(greatest.expect("a number"), 0.2);
    let Some(Value::Map(map)) = score.variant("map").map(|variant| &variant.value) else {
        panic!("there is a footprint");
    };
    let filled: Vec<(usize, usize)> = (0..20)
        .flat_map(|row| (0..20).map(move |column| (row, column)))
        .filter(|&(row, column)| map.values[row][column].is_some())
        .collect();
    // x = 1 mm and y = 2 mm in cells of 1 mm from −10 mm.
    assert_eq!(filled, [(12, 11)]);
}

#[test]
fn branches_without_overlap_or_depths_say_which_it_is() {
    use Phase::{Load, Unload};
    let said = |corners: &[(Phase, f64, f64)]| {
        let samples = loop_at("a", corners);
        said(
            &evaluate("hysteresis", &["Px", "Py", "Pz", "Fz"], &samples),
            "hysteresis",
            "Fz",
        )
    };
    let short = [(Load, 0.0, 0.0), (Load, 1.0, 1.0), (Unload, 0.5, 0.2)];
    assert_eq!(said(&short), "no point has two depths on both branches");
    let apart = [
        (Load, 0.0, 0.0),
        (Load, 0.2, 0.1),
        (Unload, 0.5, 0.2),
        (Unload, 1.0, 1.0),
    ];
    assert_eq!(said(&apart), "no common range");
    assert_eq!(
        said(&short[..1]),
        "no point has two depths on both branches"
    );
}
