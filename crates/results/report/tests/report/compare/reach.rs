//! Tests of comparisons whose groups are too few to show any difference.

use super::of_metric;
use super::pairs::sampled_at;
use taceva_report::{Layout, Study};

fn studies(points: u32) -> [Study; 2] {
    [
        sampled_at(points, "a", 0.0, 0.25),
        sampled_at(points, "b", 0.0, 0.5),
    ]
}

#[test]
fn five_groups_are_said_to_show_no_difference_in_every_format() {
    let studies = studies(5);
    let comparison = of_metric(&studies, "mae");
    let reason = "5 groups cannot show a difference: the smallest possible p is 0.0625; 6 groups or more can";
    let words = comparison.answers[0].words(&comparison.names);
    assert!(words.ends_with(&format!("; {reason}")), "{words}");
    let decision = &comparison.decisions()[0].words;
    assert!(decision.ends_with(&format!("; {reason}")), "{decision}");
    for form in [
        comparison.overview(Some(100)),
        comparison.text(),
        comparison.markdown(),
        comparison.json(),
        comparison.table().csv(),
        comparison.table().latex(Layout::Float),
        comparison.page(&studies),
    ] {
        let form: Vec<&str> = form.split_whitespace().collect();
        let form = form.join(" ");
        assert!(form.contains("5 groups cannot show a difference"), "{form}");
    }
}

#[test]
fn six_groups_can_show_a_difference_and_say_nothing() {
    let comparison = of_metric(&studies(6), "mae");
    assert_eq!(comparison.answers[0].better(), Some(0));
    assert!(!comparison.text().contains("groups cannot"));
}
