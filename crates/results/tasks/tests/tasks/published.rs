//! Grasp scores of TacBench, with published and correct intervals.

use crate::golden::tasks;
use serde_json::Value;
use taceva_tasks::PublishedShare;

/// Fails unless both numbers agree to ten digits.
fn close(found: f64, expected: &Value, of: &str) {
    let expected = expected.as_f64().expect("a number");
    assert!(
        (found / expected - 1.0).abs() < 1e-10,
        "{of}: {found}, not {expected}"
    );
}

/// Rows of TacBench's grasp task: 1,500 samples in six sets.
fn rows() -> Vec<(String, Value, PublishedShare)> {
    let golden = tasks();
    let rows = golden["tacbench_t4_grasp"].as_object().expect("rows");
    let row = |(model, row): (&String, &Value)| {
        let hits = row["k_of_1500"].as_u64().expect("a count");
        let half_width = row["printed_halfwidth"].as_f64().expect("a number");
        let published = PublishedShare::new(hits, 1500, 6, half_width);
        (model.clone(), row.clone(), published)
    };
    rows.iter().map(row).collect()
}

#[test]
fn tacbench_s_intervals_are_those_of_its_formula() {
    assert_eq!(rows().len(), 5);
    for (model, row, published) in rows() {
        close(published.value(), &row["value"], &model);
        close(published.sd_over_sets(), &row["sd_over_6_sets"], &model);
        let formula = PublishedShare::half_width_of(published.sd_over_sets(), 1500);
        close(formula, &row["printed_halfwidth"], &model);
    }
}

#[test]
fn intervals_over_its_six_sets_are_22_7_times_as_wide() {
    for (model, row, published) in rows() {
        close(
            published.half_width_by_sets(),
            &row["t_halfwidth_6_sets"],
            &model,
        );
        close(published.ratio(), &row["ratio"], &model);
    }
}

#[test]
fn even_independent_samples_would_leave_wider_intervals() {
    for (model, row, published) in rows() {
        let ends = published.if_frames_were_independent().ends();
        let [low, high] = ends.expect("1,500 samples");
        close(low, &row["wilson_iid"][0], &model);
        close(high, &row["wilson_iid"][1], &model);
        assert!(high - low > 10.0 * published.half_width, "{model}");
    }
}
