//! Refused definitions, samples and merges.

use serde::Serialize;
use serde::de::DeserializeOwned;
use taceva_tasks::{Classes, Probabilities, Ranking, TaskError, TopK};

/// Text of the error of `result`.
fn refusal<T>(result: Result<T, TaskError>) -> String {
    match result {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    }
}

fn slip() -> Classes {
    Classes::new(["no_slip", "slip"], Some("slip")).expect("names")
}

#[test]
fn a_class_that_is_not_among_the_names_is_refused_with_row_and_nearest_name() {
    let mut slip = slip();
    slip.push("stroke", "slip", "slip").expect("names");
    let text = refusal(slip.push("stroke", "no_silp", "slip"));
    assert_eq!(
        text,
        "row 2: the truth is \"no_silp\", expected a class of the task; did you mean \"no_slip\"?"
    );
    let text = refusal(slip.push("stroke", "slip", "gripping"));
    assert_eq!(
        text,
        "row 2: the prediction is \"gripping\", expected a class of the task"
    );
    let mut top_k = TopK::new(["a", "b"]).expect("names");
    let text = refusal(top_k.push("clip", "c", &[0.5, 0.5]));
    assert!(text.starts_with("row 1: the truth is \"c\""), "{text}");
    // Nothing was added.
    assert_eq!(slip.n(), 1);
}

#[test]
fn a_position_beyond_the_names_is_refused_with_its_row() {
    let text = refusal(slip().push_positions("stroke", &[0, 1], &[1, 2]));
    assert_eq!(
        text,
        "row 2: the prediction is position 2, expected less than 2"
    );
    let text = refusal(slip().push_positions("stroke", &[0, 1], &[1]));
    assert_eq!(
        text,
        "the prediction has 1 row, expected 2, as many as truths"
    );
}

#[test]
fn the_same_name_twice_is_refused() {
    let text = refusal(Classes::new(["slip", "no_slip", "slip"], None));
    assert_eq!(
        text,
        "names: \"slip\" occurs twice, expected each name once"
    );
    assert_eq!(
        refusal(TopK::new(["a", "a"])),
        "names: \"a\" occurs twice, expected each name once"
    );
    assert_eq!(
        refusal(TopK::new(["a"])),
        "the task has 1 name, expected two or more"
    );
}

#[test]
fn a_positive_class_that_is_not_among_the_names_is_refused_with_the_nearest_name() {
    let expected = "positive is \"Slipp\", expected a class of the task; did you mean \"slip\"?";
    assert_eq!(
        refusal(Classes::new(["no_slip", "slip"], Some("Slipp"))),
        expected
    );
    assert_eq!(
        refusal(Probabilities::new(["no_slip", "slip"], Some("Slipp"))),
        expected
    );
}

#[test]
fn a_score_that_is_not_finite_is_refused_with_its_row() {
    let mut ranking = Ranking::default();
    let text = refusal(ranking.push_rows("clip", &[0.5, f64::NAN], &[true, false]));
    assert_eq!(text, "row 2: the score is NaN, expected a finite number");
    let text = refusal(ranking.push("clip", f64::INFINITY, true));
    assert_eq!(text, "row 1: the score is inf, expected a finite number");
    assert_eq!(ranking, Ranking::default());
    let mut top_k = TopK::new(["a", "b"]).expect("names");
    let text = refusal(top_k.push("clip", "a", &[0.5, f64::NAN]));
    assert_eq!(
        text,
        "row 1: the score of \"b\" is NaN, expected a finite number"
    );
    let mut probabilities = Probabilities::new(["a", "b"], None).expect("names");
    let text = refusal(probabilities.push("clip", "a", &[f64::NEG_INFINITY, 0.5]));
    assert_eq!(
        text,
        "row 1: the score of \"a\" is -inf, expected a finite number"
    );
}

#[test]
fn scores_for_some_classes_only_are_refused_with_the_first_missing_class() {
    let mut top_k = TopK::new(["a", "b", "c"]).expect("names");
    let text = refusal(top_k.push("clip", "a", &[0.5]));
    let expected = "row 1: 1 score for 3 classes, none of \"b\"; give one score for each class";
    assert_eq!(text, expected);
    let mut probabilities = Probabilities::new(["a", "b", "c"], None).expect("names");
    assert_eq!(refusal(probabilities.push("clip", "a", &[0.5])), expected);
    let text = refusal(top_k.push("clip", "a", &[0.5; 4]));
    assert_eq!(
        text,
        "row 1: 4 scores for 3 classes; give one score for each class"
    );
}

#[test]
fn states_of_other_names_or_another_positive_class_do_not_merge() {
    let other_names = Classes::new(["no_slip", "Slip"], Some("Slip")).expect("names");
    let text = refusal(slip().merge(other_names));
    assert_eq!(
        text,
        "states of different names do not merge: no_slip, slip and no_slip, Slip; score both parts with the same names"
    );
    let other_positive = Classes::new(["no_slip", "slip"], None).expect("names");
    let text = refusal(slip().merge(other_positive));
    assert!(
        text.starts_with("states of different positive do not merge: slip and none"),
        "{text}"
    );
    let [first, other] = [["a", "b"], ["b", "a"]].map(|names| TopK::new(names).expect("names"));
    assert!(refusal(first.merge(other)).contains("names"));
    // Equal only when joined by commas.
    let [first, other] =
        [["a, b", "c"], ["a", "b, c"]].map(|names| TopK::new(names).expect("names"));
    assert!(refusal(first.merge(other)).contains("names"));
    let [first, other] =
        [Some("none"), None].map(|positive| Classes::new(["none", "slip"], positive));
    let text = refusal(first.expect("names").merge(other.expect("names")));
    assert!(text.contains("positive"), "{text}");
}

#[test]
fn control_characters_of_a_class_are_escaped() {
    let text = refusal(slip().push("stroke", "sl\u{1b}ip", "slip"));
    assert!(text.contains("sl\\u{1b}ip"), "{text}");
}

/// Error message for the JSON text of `state` after `part` replaces `whole`.
fn damage<S: Serialize + DeserializeOwned>(state: &S, whole: &str, part: &str) -> String {
    let text = serde_json::to_string(state).expect("JSON");
    assert!(text.contains(whole), "{text}");
    match serde_json::from_str::<S>(&text.replace(whole, part)) {
        Ok(_) => panic!("accepted: {part}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn stored_states_that_no_samples_give_are_refused() {
    let mut slip = slip();
    slip.push("stroke", "slip", "no_slip").expect("names");
    assert!(damage(&slip, "1>0", "1>2").contains("position 2"));
    assert!(damage(&slip, "1>0", "1-0").contains("the cell \"1-0\""));
    assert!(damage(&slip, "\"1>0\":1", "\"1>0\":0").contains("a count of 0"));
    assert!(damage(&slip, ":1}", ":18446744073709551615}").contains("2^53"));
    let mut top_k = TopK::new(["a", "b"]).expect("names");
    top_k.push("clip", "b", &[0.75, 0.25]).expect("scores");
    assert!(damage(&top_k, "1+1", "1+0").contains("which no samples give"));
    assert!(damage(&top_k, "1+1", "1+2").contains("1 sample on the places 2 to 3 of 2"));
    let mut ranking = Ranking::default();
    ranking.push("clip", 0.3, true).expect("a score");
    assert!(damage(&ranking, "false", "true").contains("the level"));
    let mut probabilities = Probabilities::new(["a", "b"], Some("b")).expect("names");
    probabilities
        .push("clip", "b", &[0.75, 0.25])
        .expect("scores");
    assert!(damage(&probabilities, "\"n\":1", "\"n\":2").contains("which no samples give"));
}
