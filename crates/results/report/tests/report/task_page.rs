//! Tests of the page of the scores of tasks.

use taceva_report::{Picture, task_page};
use taceva_tasks::{Classes, Ranking, TaskReport, TaskScores, WorstSample};

fn report_of(task: TaskScores) -> TaskReport {
    let mut report = TaskReport::new("0.2.0", "by `sample`");
    report.tasks.push(task);
    report
}

/// Task of classes over 5 clips. `counts` has true classes, predicted classes and numbers of samples.
fn classes(names: &[&str], counts: &[(&str, &str, usize)]) -> TaskScores {
    let mut classes = Classes::new(names.iter().copied(), None).expect("names");
    for (truth, predicted, count) in counts {
        for number in 0..*count {
            let clip = format!("clip {}", number % 5);
            classes.push(&clip, truth, predicted).expect("a class");
        }
    }
    TaskScores::new("cloth", "class", "clip").of_classes(&classes)
}

#[test]
fn a_matrix_of_few_classes_has_counts_and_shares_of_its_rows() {
    let counts = [
        ("felt", "felt", 15),
        ("felt", "wool", 5),
        ("wool", "wool", 20),
    ];
    let page = task_page(
        "Cloth",
        &report_of(classes(&["felt", "wool"], &counts)),
        &[],
    );
    for words in [
        "felt as felt: 15 of 20 (75 %)",
        "felt as wool: 5 of 20 (25 %)",
        "wool as wool: 20 of 20 (100 %)",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(page.contains("40 samples of 5 clusters by clip"), "{page}");
    assert!(!page.contains("most confused"), "{page}");
}

#[test]
fn many_classes_have_their_twenty_most_confused_pairs_in_the_place_of_a_matrix() {
    let names: Vec<String> = (0..30).map(|class| format!("c{class:02}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut counts = vec![("c00", "c01", 7)];
    for pair in names.windows(2).skip(1) {
        counts.push((pair[0], pair[1], 1));
    }
    let page = task_page("Many", &report_of(classes(&names, &counts)), &[]);
    assert!(
        page.contains("the 20 most confused of 29 pairs of 30 classes"),
        "{page}"
    );
    let first = page.find("<td").expect("a cell of the scores");
    let rows = page[first..].matches("c00").count();
    assert!(rows >= 1, "{page}");
    assert!(!page.contains("figure-confusion"), "{page}");
}

#[test]
fn a_curve_has_steps_and_the_line_of_the_prevalence() {
    let mut ranking = Ranking::default();
    let rows = [0.1, 0.4, 0.35, 0.8];
    ranking
        .push_rows("stroke 1", &rows, &[false, false, true, true])
        .expect("finite");
    let points: Vec<[f64; 2]> = ranking
        .curve()
        .iter()
        .map(|point| [point.recall, point.precision])
        .collect();
    assert_eq!(
        points,
        [[0.5, 1.0], [0.5, 0.5], [1.0, 2.0 / 3.0], [1.0, 0.5]]
    );
    let mut task = TaskScores::new("slip", "event", "stroke");
    task.scores = ranking.scores();
    task.evidence.curve = ranking.curve();
    task.evidence.prevalence = ranking.prevalence();
    let page = task_page("Slip", &report_of(task), &[]);
    assert!(page.contains("prevalence 0.5: all positive"), "{page}");
    let mut none = TaskScores::new("slip", "event", "stroke");
    none.scores = ranking.scores();
    let page = task_page("Slip", &report_of(none), &[]);
    assert!(!page.contains("prevalence"), "{page}");
}

#[test]
fn the_greatest_errors_come_first_with_their_pictures_and_hostile_names_are_text() {
    let mut task = TaskScores::new("shape", "depth", "press");
    for (row, sample, error) in [(0, "near", 0.25), (1, "<b>far", 2.0), (2, "middle", 1.0)] {
        let worst = WorstSample::new(row, sample, "press 1", error, "mm");
        task.evidence.add_worst(worst);
    }
    let picture = |id: &str| Picture {
        study: 0,
        id: id.to_owned(),
        media_type: "image/png",
        bytes: vec![1, 2, 3],
    };
    let page = task_page(
        "Shape",
        &report_of(task),
        &[picture("near"), picture("<b>far")],
    );
    let place = |words: &str| {
        page.find(words)
            .unwrap_or_else(|| panic!("{words}: {page}"))
    };
    assert!(place("&lt;b&gt;far") < place("middle"), "{page}");
    assert!(!page.contains("<b>far"), "{page}");
    assert_eq!(page.matches("data:image/png;base64,").count(), 2);
}
