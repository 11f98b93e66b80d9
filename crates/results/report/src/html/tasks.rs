//! Scores of tasks, such as slip.

use maud::{Markup, html};

use crate::markup::{heads, scroll};
use crate::names::{names, noun};
use crate::number::numeral;
use crate::results::Study;

/// Number of scores of tasks, and the section with them. `None` if no study has a task.
pub(super) fn section(studies: &[Study]) -> Option<(usize, Markup)> {
    let mut rows: Vec<Markup> = Vec::new();
    let mut notes: Vec<String> = Vec::new();
    for (study, name) in studies.iter().zip(names(studies)) {
        for task in &study.tasks {
            notes.extend(
                task.notes()
                    .map(|note| format!("{name}, {}: {note}.", task.name())),
            );
            for score in task.scores() {
                let number = |value: Option<f64>| value.map_or_else(String::new, numeral);
                let interval = score.interval.map_or_else(String::new, |[low, high]| {
                    format!("{} … {}", numeral(low), numeral(high))
                });
                rows.push(html! {
                    tr {
                        th scope="row" { (name) } td { (task.name()) } td { (score.metric) }
                        td { (number(score.value)) } td { (interval) } td { (number(score.of_constant)) }
                        td { (score.unit) } td { (score.n) } td { (score.clusters) }
                    } "\n"
                });
            }
        }
    }
    let columns = [
        noun(studies),
        "task",
        "score",
        "value",
        "95 % interval",
        "best constant",
        "unit",
        "n",
        "clusters",
    ];
    let table = html! {
        table.sorts {
            thead { tr { (heads(columns)) } }
            tbody { @for row in &rows { (row) } }
        }
    };
    let body = html! {
        p.note { "Intervals are over clusters that the model has not seen. A score is of use if it is better than the best constant prediction." } "\n"
        (scroll("Scores of tasks", &table))
        @for note in &notes { p.note { (note) } "\n" }
    };
    (!rows.is_empty()).then_some((rows.len(), body))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_score_stands_beside_its_interval_and_the_best_constant() {
        let task = r#"{"name": "slip", "notes": ["model lda"], "scores": [
            {"metric": "f1", "variant": null, "estimate": {"value": 0.91, "ci95": [0.85, 0.95], "n": 440, "clusters": 40, "of_constant": 0.62}},
            {"metric": "f1", "variant": "no_slip", "estimate": {"value": 0.5, "ci95": null, "n": 440, "clusters": 40, "of_constant": null}}]}"#;
        let study = Study {
            sensor: "drawn".to_owned(),
            tasks: vec![serde_json::from_str(task).expect("a task")],
            ..Study::default()
        };
        let (count, body) = section(&[study]).expect("a task");
        assert_eq!(count, 1);
        let text = body.into_string();
        for part in ["0.91", "0.85 … 0.95", "0.62", "model lda"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(section(&[Study::default()]).is_none());
    }
}
