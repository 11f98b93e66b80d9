//! Scores of depth maps.

use taceva_metrics::{Interval, UndefinedReason};
use taceva_tasks::Undefined;
use taceva_tasks::depth::{DepthError, DepthMap, DepthState, DepthTask};

use super::cases::{case, close, number, numbers, score, value};

/// Map of one row.
fn row_of(mm: &[f64]) -> DepthMap {
    DepthMap::new(1, mm.len(), mm.to_vec()).expect("a map")
}

/// State with one cluster for each pair of true and predicted one-row map.
fn state_of(task: DepthTask, pairs: &[[&[f64]; 2]]) -> DepthState {
    let mut state = DepthState::new(task);
    for (row, [truth, prediction]) in (1..).zip(pairs) {
        let cluster = format!("press {row}");
        let pushed = state.push(&cluster, row, &row_of(truth), &row_of(prediction));
        pushed.expect("maps of one size");
    }
    state
}

/// A map of the golden case.
fn golden(list: &serde_json::Value) -> DepthMap {
    let rows: Vec<Vec<f64>> = list.as_array().expect("rows").iter().map(numbers).collect();
    DepthMap::new(rows.len(), rows[0].len(), rows.concat()).expect("a map")
}

#[test]
fn a_map_with_an_invalid_pixel_has_the_golden_errors() {
    let case = case("depth", "4x5 map");
    let task = DepthTask::default().with_gate_mm(0.1).expect("a gate");
    let mut state = DepthState::new(task);
    let [truth, prediction] = ["truth", "prediction"].map(|key| golden(&case[key]));
    state.push("a", 1, &truth, &prediction).expect("one size");
    let scores = state.scores();
    for (metric, variant, key) in [
        ("depth_mae", None, "mae"),
        ("depth_rmse", None, "rmse"),
        (
            "depth_rmse",
            Some("in_contact"),
            "rmse_in_contact(truth>0.1)",
        ),
        ("depth_rmse", Some("scaled"), "rmse_after_best_scale"),
        ("depth_bias", None, "bias"),
        ("depth_max", None, "max"),
        ("depth_max", Some("in_contact"), "max"),
        ("contact_iou", None, "iou_at_0.1"),
    ] {
        let found = value(&scores, metric, variant);
        close(found, number(&case, key), 1e-15, key);
    }
    let all = score(&scores, "depth_mae", None);
    assert_eq!(Some(all.estimate.n), case["n_valid"].as_u64());
    assert_eq!(
        score(&scores, "depth_mae", Some("in_contact")).estimate.n,
        6
    );
}

#[test]
fn per_map_is_the_mean_of_the_maps_own_scores() {
    // Errors 0.5 in one pixel, and 0.25, 0.25, 0.25 in three.
    let pairs: [[&[f64]; 2]; 2] = [[&[1.0], &[0.5]], [&[1.0, 1.0, 1.0], &[1.25, 0.75, 1.25]]];
    let scores = state_of(DepthTask::default(), &pairs).scores();
    for (metric, of_pixels, of_maps) in [
        ("depth_mae", 1.25 / 4.0, 0.375),
        ("depth_rmse", (0.4375_f64 / 4.0).sqrt(), 0.375),
        ("depth_bias", 0.25 / 4.0, (0.5 - 0.25 / 3.0) / 2.0),
        ("depth_max", 0.5, 0.375),
    ] {
        close(value(&scores, metric, None), of_pixels, 1e-15, metric);
        close(
            value(&scores, metric, Some("per_map")),
            of_maps,
            1e-15,
            metric,
        );
    }
}

#[test]
fn only_truth_above_the_gate_is_in_contact() {
    let pairs: [[&[f64]; 2]; 1] = [[&[0.02, 0.03, 0.5], &[0.5, 0.53, 0.5]]];
    let scores = state_of(DepthTask::default(), &pairs).scores();
    let contact = score(&scores, "depth_mae", Some("in_contact"));
    assert_eq!(contact.estimate.n, 2);
    close(
        value(&scores, "depth_mae", Some("in_contact")),
        0.25,
        1e-15,
        "mae",
    );
    assert!(contact.definition.ends_with("(above 0.02 mm)"));
    // Contact in both maps: two of three pixels.
    close(value(&scores, "contact_iou", None), 2.0 / 3.0, 1e-15, "iou");
}

#[test]
fn a_perfect_predictor_has_errors_of_exactly_zero_and_an_overlap_of_one() {
    let maps: [[&[f64]; 2]; 2] = [[&[0.1, 0.7, 1e-9], &[0.1, 0.7, 1e-9]], [&[-0.3], &[-0.3]]];
    let scores = state_of(DepthTask::default(), &maps).scores();
    for metric in ["depth_mae", "depth_rmse", "depth_bias", "depth_max"] {
        assert_eq!(
            score(&scores, metric, None).estimate.value,
            Ok(0.0),
            "{metric}"
        );
    }
    assert_eq!(score(&scores, "contact_iou", None).estimate.value, Ok(1.0));
    assert_eq!(
        score(&scores, "depth_rmse", Some("scaled")).estimate.value,
        Ok(0.0)
    );
}

#[test]
fn the_best_factor_makes_a_proportional_prediction_exact() {
    let maps: [[&[f64]; 2]; 2] = [[&[0.5, 1.0], &[0.25, 0.5]], [&[2.0], &[1.0]]];
    let scores = state_of(DepthTask::default(), &maps).scores();
    assert_eq!(
        score(&scores, "depth_rmse", Some("scaled")).estimate.value,
        Ok(0.0)
    );
    // No factor improves a prediction of zero.
    let zero: [[&[f64]; 2]; 1] = [[&[3.0, 4.0], &[0.0, 0.0]]];
    let scores = state_of(DepthTask::default(), &zero).scores();
    let found = value(&scores, "depth_rmse", Some("scaled"));
    close(found, 12.5_f64.sqrt(), 1e-15, "rmse");
}

#[test]
fn the_mean_map_of_training_is_the_constant_to_beat_on_the_same_pixels() {
    let task = DepthTask::default().with_constant(row_of(&[0.25, 0.25, 0.25]));
    // The last pixel is invalid in the prediction, so the constant is not scored there either.
    let pairs: [[&[f64]; 2]; 1] = [[&[0.5, 1.0, 9.0], &[0.5, 0.5, f64::NAN]]];
    let scores = state_of(task, &pairs).scores();
    let of = |metric, variant| score(&scores, metric, variant).estimate.of_constant;
    assert_eq!(of("depth_mae", None), Some(0.5));
    assert_eq!(of("depth_bias", None), Some(0.5));
    assert_eq!(of("depth_max", None), Some(0.75));
    assert_eq!(of("depth_mae", Some("per_map")), Some(0.5));
    assert_eq!(of("contact_iou", None), Some(1.0));
    let without = state_of(DepthTask::default(), &pairs).scores();
    assert_eq!(
        score(&without, "depth_mae", None).estimate.of_constant,
        None
    );
}

#[test]
fn a_greatest_error_has_no_interval_and_the_mean_of_greatest_errors_has_one() {
    let maps = [
        [0.5, 0.25],
        [0.5, 0.3],
        [0.5, 0.35],
        [0.5, 0.2],
        [0.5, 0.15],
    ];
    let pairs: Vec<[&[f64]; 2]> = maps.iter().map(|[t, p]| [slice(t), slice(p)]).collect();
    let scores = state_of(DepthTask::default(), &pairs).scores();
    let none = Interval::Undefined(UndefinedReason::NoInterval);
    assert_eq!(score(&scores, "depth_max", None).estimate.interval, none);
    let per_map = score(&scores, "depth_max", Some("per_map"));
    assert!(per_map.estimate.interval.ends().is_some());
}

/// Slice of one number.
fn slice(number: &f64) -> &[f64] {
    std::slice::from_ref(number)
}

#[test]
fn maps_without_contact_in_both_are_counted_apart() {
    let pairs: [[&[f64]; 2]; 3] = [
        [&[0.5, 0.0], &[0.5, 0.5]],
        [&[0.01, 0.0], &[0.0, 0.02]],
        [&[0.0, 0.0], &[0.5, 0.0]],
    ];
    let state = state_of(DepthTask::default(), &pairs);
    assert_eq!((state.maps(), state.maps_without_contact()), (3, 1));
    let scores = state.scores();
    close(value(&scores, "contact_iou", None), 1.0 / 3.0, 1e-15, "all");
    close(
        value(&scores, "contact_iou", Some("per_map")),
        0.25,
        1e-15,
        "per map",
    );
    assert_eq!(score(&scores, "contact_iou", Some("per_map")).estimate.n, 2);
    let scores = state_of(DepthTask::default(), &pairs[1..2]).scores();
    for variant in [None, Some("per_map")] {
        let found = score(&scores, "contact_iou", variant).estimate.value;
        assert_eq!(found, Err(Undefined::BothEmpty));
    }
    let found = score(&scores, "depth_mae", Some("in_contact"))
        .estimate
        .value;
    assert_eq!(found, Err(Undefined::NoContact));
}

#[test]
fn normals_of_a_slope_are_at_its_angle_to_a_flat_surface() {
    let task = DepthTask::default()
        .with_pixel_mm([0.5, 2.0])
        .expect("a size");
    let mut state = DepthState::new(task);
    // Depth grows by one pixel width along columns: 45 degrees.
    let slope = |column: usize| column as f64 * 0.5;
    let map = |of: &dyn Fn(usize) -> f64| {
        let mm = (0..12).map(|at| of(at % 4));
        DepthMap::new(3, 4, mm.collect()).expect("a map")
    };
    state
        .push("a", 1, &map(&slope), &map(&|_| 0.1))
        .expect("one size");
    let scores = state.scores();
    let normal = score(&scores, "normal_angle", None);
    close(value(&scores, "normal_angle", None), 45.0, 1e-15, "angle");
    assert_eq!((normal.estimate.n, normal.unit), (2, Some("deg")));
    assert_eq!(normal.estimate.of_constant, normal.estimate.value.ok());
}

#[test]
fn normals_next_to_an_invalid_pixel_are_left_out() {
    let task = DepthTask::default()
        .with_pixel_mm([1.0, 1.0])
        .expect("a size");
    let mut state = DepthState::new(task);
    let flat = DepthMap::new(3, 4, vec![0.0; 12]).expect("a map");
    let mut mm = vec![0.0; 12];
    // Row 1, column 3: the right neighbour of the second inner pixel.
    mm[7] = f64::NAN;
    let holed = DepthMap::new(3, 4, mm).expect("a map");
    state.push("a", 1, &flat, &holed).expect("one size");
    assert_eq!(score(&state.scores(), "normal_angle", None).estimate.n, 1);
}

#[test]
fn without_a_size_of_a_pixel_there_is_no_angle_of_normals() {
    let scores = state_of(DepthTask::default(), &[[&[0.5], &[0.5]]]).scores();
    let found = score(&scores, "normal_angle", None).estimate.value;
    assert_eq!(found, Err(Undefined::NoPixelSize));
}

#[test]
fn a_map_of_another_size_is_refused_by_row() {
    let mut state = DepthState::new(DepthTask::default());
    let refused = state.push("a", 8, &row_of(&[0.0; 3]), &row_of(&[0.0; 2]));
    assert_eq!(
        refused.expect_err("another size").to_string(),
        "row 8: the prediction has 1 x 2 pixels, expected 1 x 3 as in the truth"
    );
    let task = DepthTask::default().with_constant(row_of(&[0.0; 4]));
    let pair = row_of(&[0.0; 3]);
    let refused = DepthState::new(task).push("a", 9, &pair, &pair);
    assert_eq!(
        refused.expect_err("another size").to_string(),
        "row 9: the truth has 1 x 3 pixels, expected 1 x 4 as in the mean map of training"
    );
    let refused = DepthMap::new(2, 3, vec![0.0; 5]).expect_err("five pixels");
    assert_eq!(
        refused.to_string(),
        "the map has 5 pixels, expected 2 x 3 = 6"
    );
    assert!(DepthMap::new(0, 3, Vec::new()).is_err());
}

#[test]
fn a_map_without_a_unit_is_refused_and_known_units_become_mm() {
    let refused = DepthMap::in_unit(1, 1, vec![1.0], "");
    let found = String::new();
    assert_eq!(refused, Err(DepthError::Unit { found }));
    assert!(DepthMap::in_unit(1, 1, vec![1.0], "cm").is_err());
    for (unit, expected) in [("mm", 2.0), ("um", 0.002), ("µm", 0.002), ("m", 2000.0)] {
        let map = DepthMap::in_unit(1, 1, vec![2.0], unit).expect("a unit");
        close(map.mm()[0], expected, 1e-15, unit);
    }
}

#[test]
fn maps_that_are_all_invalid_have_no_score_and_are_counted() {
    let state = state_of(DepthTask::default(), &[[&[f64::NAN; 2], &[0.5; 2]]]);
    assert_eq!((state.maps(), state.maps_without_pixel()), (1, 1));
    for score in state.scores() {
        let expected = match score.metric {
            "normal_angle" => Undefined::NoPixelSize,
            _ => Undefined::NoValidPixel,
        };
        assert_eq!(score.estimate.value, Err(expected), "{}", score.metric);
    }
    let empty = DepthState::new(DepthTask::default()).scores();
    let found = score(&empty, "depth_mae", None).estimate.value;
    assert_eq!(found, Err(Undefined::Empty));
}

#[test]
fn negative_depths_are_kept_and_counted() {
    let state = state_of(
        DepthTask::default(),
        &[[&[-0.5, 0.5, 0.0], &[0.0, 0.5, -0.25]]],
    );
    assert_eq!(state.negative_pixels(), 2);
    close(
        value(&state.scores(), "depth_mae", None),
        0.25,
        1e-15,
        "mae",
    );
}

#[test]
fn an_infinite_depth_a_negative_gate_and_a_pixel_of_size_0_are_refused() {
    let refused = DepthMap::new(2, 2, vec![0.0, 0.0, 0.0, f64::INFINITY]);
    let text = refused.expect_err("infinite").to_string();
    assert!(text.starts_with("pixel 1, 1 of the map is inf"), "{text}");
    for gate in [-0.1, f64::NAN] {
        assert!(DepthTask::default().with_gate_mm(gate).is_err());
    }
    for size in [0.0, -1.0, f64::NAN] {
        assert!(DepthTask::default().with_pixel_mm([0.1, size]).is_err());
    }
}

#[test]
fn states_of_other_gates_do_not_merge_and_those_of_one_mean_map_do() {
    let gated = DepthTask::default().with_gate_mm(0.1).expect("a gate");
    let refused = DepthState::new(DepthTask::default()).merge(DepthState::new(gated));
    let text = refused.expect_err("another gate").to_string();
    assert!(
        text.starts_with("states of different depth tasks do not merge: gate 0.02 mm"),
        "{text}"
    );
    // An invalid pixel of the mean map equals itself.
    let task = || DepthTask::default().with_constant(row_of(&[f64::NAN, 0.5]));
    let pairs: [[&[f64]; 2]; 3] = [
        [&[0.5, 0.6], &[0.1, 0.7]],
        [&[0.1, 0.2], &[0.3, 0.3]],
        [&[1.0, 0.0], &[0.9, 0.1]],
    ];
    let whole = state_of(task(), &pairs);
    let merged = state_of(task(), &pairs[..1]).merge(rest_of(task(), &pairs));
    let merged = merged.expect("one task");
    let bytes = |state: &DepthState| serde_json::to_string(state).expect("a state");
    assert_eq!(bytes(&merged), bytes(&whole));
    assert_eq!(merged.scores(), whole.scores());
}

/// State of all pairs but the first, added in reverse order, with the cluster names of [`state_of`].
fn rest_of(task: DepthTask, pairs: &[[&[f64]; 2]]) -> DepthState {
    let mut state = DepthState::new(task);
    for (row, [truth, prediction]) in (1..)
        .zip(pairs)
        .skip(1)
        .collect::<Vec<_>>()
        .into_iter()
        .rev()
    {
        let cluster = format!("press {row}");
        let pushed = state.push(&cluster, row, &row_of(truth), &row_of(prediction));
        pushed.expect("maps of one size");
    }
    state
}
