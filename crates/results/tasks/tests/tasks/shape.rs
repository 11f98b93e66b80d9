//! Scores of clouds of points.

use taceva_tasks::Undefined;
use taceva_tasks::shape::{ShapeError, ShapeState, ShapeTask};

use super::cases::{case, close, number, points, score, value};

/// State with the golden clouds and τ in mm.
fn golden(tau_mm: f64) -> ShapeState {
    let case = case("depth", "chamfer and F");
    let task = ShapeTask::default().with_tau_mm(tau_mm).expect("tau");
    let mut state = ShapeState::new(task);
    let pushed = state.push("a", 1, &points(&case["P"]), &points(&case["Q"]));
    pushed.expect("two clouds");
    state
}

#[test]
fn four_distances_called_chamfer_are_the_golden_ones_by_name() {
    let case = case("depth", "chamfer and F");
    let scores = golden(0.15).scores();
    for (variant, key, unit) in [
        (None, "chamfer_half_sum(ObjectFolder)", "mm"),
        (Some("sum"), "chamfer_sum", "mm"),
        (Some("squared"), "chamfer_squared_sum", "mm²"),
    ] {
        let found = value(&scores, "chamfer", variant);
        close(found, number(&case, key), 1e-15, key);
        assert_eq!(score(&scores, "chamfer", variant).unit, Some(unit));
    }
}

#[test]
fn the_f_score_at_tau_is_four_sevenths() {
    let case = case("depth", "chamfer and F");
    let scores = golden(0.15).scores();
    for variant in ["fscore_strict", "fscore_inclusive"] {
        let found = score(&scores, "chamfer", Some(variant));
        assert_eq!(found.estimate.value, Ok(4.0 / 7.0));
        assert!(
            found.definition.ends_with("tau 0.15 mm"),
            "{}",
            found.definition
        );
        close(
            4.0 / 7.0,
            number(&case, "F_at_0.15(neuralfeels)"),
            1e-15,
            variant,
        );
    }
}

#[test]
fn a_distance_of_exactly_tau_is_a_hit_of_the_inclusive_score_alone() {
    let task = ShapeTask::default().with_tau_mm(0.5).expect("tau");
    let mut state = ShapeState::new(task);
    state
        .push("a", 1, &[[0.0; 3]], &[[0.0, 0.5, 0.0]])
        .expect("clouds");
    let scores = state.scores();
    let of = |variant| score(&scores, "chamfer", Some(variant)).estimate.value;
    assert_eq!(of("fscore_strict"), Ok(0.0));
    assert_eq!(of("fscore_inclusive"), Ok(1.0));
}

#[test]
fn the_score_is_the_mean_of_pairs_and_needs_no_tau() {
    let mut state = ShapeState::new(ShapeTask::default());
    for (row, off) in [(1, 0.5), (2, 1.5)] {
        state
            .push("a", row, &[[0.0; 3]], &[[off, 0.0, 0.0]])
            .expect("clouds");
    }
    let scores = state.scores();
    assert_eq!(score(&scores, "chamfer", None).estimate.value, Ok(1.0));
    assert_eq!(
        score(&scores, "chamfer", Some("sum")).estimate.value,
        Ok(2.0)
    );
    assert_eq!(
        score(&scores, "chamfer", Some("squared")).estimate.value,
        Ok(2.5)
    );
    let none = score(&scores, "chamfer", Some("fscore_strict"))
        .estimate
        .value;
    assert_eq!(none, Err(Undefined::NoThresholds));
}

#[test]
fn no_cloud_has_no_score() {
    let scores = ShapeState::new(ShapeTask::default()).scores();
    assert_eq!(
        score(&scores, "chamfer", None).estimate.value,
        Err(Undefined::Empty)
    );
}

#[test]
fn a_cloud_without_a_point_is_refused_by_row() {
    let mut state = ShapeState::new(ShapeTask::default());
    let refused = state.push("a", 3, &[], &[[0.0; 3]]);
    assert_eq!(
        refused,
        Err(ShapeError::NoPoint {
            row: 3,
            cloud: "true"
        })
    );
}

#[test]
fn a_coordinate_that_is_not_finite_is_refused_by_row_cloud_and_point() {
    let mut state = ShapeState::new(ShapeTask::default());
    for value in [f64::NAN, f64::INFINITY, -2e9] {
        let refused = state.push("a", 3, &[[0.0; 3]], &[[0.0; 3], [0.0, value, 0.0]]);
        let text = refused.expect_err("no number").to_string();
        assert!(
            text.starts_with("row 3: point 2 of the predicted cloud "),
            "{text}"
        );
    }
    for tau in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(ShapeTask::default().with_tau_mm(tau).is_err());
    }
}

#[test]
fn order_and_merges_do_not_change_a_bit_and_other_taus_do_not_merge() {
    let clouds: Vec<[[f64; 3]; 2]> = (0..20)
        .map(|at| {
            [
                [f64::from(at) * 0.1, 0.2, 0.0],
                [0.3, f64::from(at * 7 % 5), 0.1],
            ]
        })
        .collect();
    let push = |state: &mut ShapeState, at: usize| {
        let [left, right] = [&clouds[at], &clouds[(at * 3 + 1) % 20]];
        let cluster = ["a", "b", "c"][at % 3];
        state.push(cluster, 1, left, right).expect("clouds");
    };
    let new = || ShapeState::new(ShapeTask::default().with_tau_mm(0.3).expect("tau"));
    let [mut whole, mut left, mut right] = [new(), new(), new()];
    (0..20).for_each(|at| push(&mut whole, at));
    (0..20_usize)
        .rev()
        .filter(|at| at % 2 > 0)
        .for_each(|at| push(&mut left, at));
    (0..20_usize)
        .rev()
        .filter(|at| at.is_multiple_of(2))
        .for_each(|at| push(&mut right, at));
    let merged = left.merge(right).expect("one task");
    let bytes = |state: &ShapeState| serde_json::to_string(state).expect("a state");
    assert_eq!(bytes(&merged), bytes(&whole));
    let refused = merged.merge(ShapeState::new(ShapeTask::default()));
    let text = refused.expect_err("another tau").to_string();
    assert!(text.contains("tau 0.3 mm and no tau"), "{text}");
}
