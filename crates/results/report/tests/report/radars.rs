//! Tests of radars: axes without values, and the least number of axes.

use crate::support;
use taceva_report::{Figure, Study, figures};

/// The radar called `id` of two synthetic studies without the metrics `without`.
fn radar(id: &str, without: &[&str]) -> Option<Figure> {
    let studies: [Study; 2] = [("one", 1.0), ("two", 1.5)].map(|(name, scale)| {
        let mut result = support::results(name, scale);
        let metrics = result["metrics"].as_object_mut().expect("an object");
        metrics.retain(|metric, _| !without.contains(&metric.as_str()));
        support::study(&result)
    });
    let mut drawn = figures(&studies).into_iter();
    drawn.find(|figure| figure.id == id)
}

#[test]
fn axes_on_which_no_result_has_a_value_are_left_out_and_named_in_the_caption() {
    let words = "Axes left out, because no result has a value";
    let whole = radar("radar-accuracy", &[]).expect("a radar");
    assert!(!whole.caption.contains(words) && whole.svg().contains(">SR<"));
    let part = radar("radar-accuracy", &["sr"]).expect("a radar");
    let named = format!("{words}: SR lines and SR dots.");
    assert!(part.caption.contains(&named), "{}", part.caption);
    assert!(!part.svg().contains(">SR<") && part.svg().contains(">MAE<"));
}

#[test]
fn a_radar_of_fewer_than_three_axes_is_not_drawn() {
    assert!(radar("radar-robustness", &["r_light", "repeatability"]).is_some());
    assert!(
        radar(
            "radar-robustness",
            &["r_light", "repeatability", "hysteresis"]
        )
        .is_none()
    );
    // Synthetic studies have uniformity and hysteresis, but no noise.
    assert!(radar("radar-sensor", &[]).is_none());
}
