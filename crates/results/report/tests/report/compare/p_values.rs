//! Tests of p values: one form in every output.

use super::{errors, of_metric};
use taceva_metrics::{p_value, p_words};

#[test]
fn one_p_value_has_the_same_digits_in_text_table_markdown_and_page() {
    let studies = errors(&[("one", 0.5), ("two", 0.545)]);
    let comparison = of_metric(&studies, "mae");
    let difference = comparison.answers[0].difference.as_ref().expect("a test");
    let p = difference.adjusted_p;
    let words = p_words(p);
    assert!(
        difference.is_shown && words.starts_with("p = 0.0"),
        "{words}"
    );
    let texts = [
        comparison.text(),
        comparison.overview(None),
        comparison.markdown(),
        comparison.page(&studies),
        comparison.table().csv(),
    ];
    for text in &texts {
        let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(joined.contains(&words), "{words}: {joined}");
    }
    let row = comparison.table().rows[0].plain();
    assert_eq!(row[9..11], [p_value(p), p_value(p)]);
    assert!(texts[4].contains(&format!("{p:?}")), "{}", texts[4]);
}

#[test]
fn the_largest_of_several_p_values_is_called_the_largest() {
    let studies = errors(&[("best", 0.5), ("near", 0.545), ("far", 0.9)]);
    let words = &of_metric(&studies, "mae").decisions()[0].words;
    assert!(
        words.starts_with("best, 0.5 N, better than all 2 others (largest p = 0.0"),
        "{words}"
    );
}
