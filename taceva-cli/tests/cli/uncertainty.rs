//! A model states its uncertainty, and the evaluation tests it.

use std::fs;

use crate::support::Bench;

#[test]
fn a_gaussian_process_writes_its_deviations_and_evaluation_counts_what_lies_within_them() {
    let bench = Bench::new();
    bench.record("data", 64);
    bench.ok("fit data --model gaussian-process --out process.model");
    bench.ok("predict data --with process.model --out found.csv --truth-out truth.csv --deviations-out sure.csv");
    let table = |name: &str| -> Vec<Vec<f64>> {
        let text = fs::read_to_string(bench.path(name)).expect("written");
        let rows = text.lines().skip(1);
        let numbers = |line: &str| {
            line.split(',')
                .filter_map(|cell| cell.parse().ok())
                .collect()
        };
        rows.map(numbers).collect()
    };
    let (found, truth, sure) = (table("found.csv"), table("truth.csv"), table("sure.csv"));
    assert_eq!(sure.len(), found.len());
    let mut inside = 0;
    for ((found, truth), sure) in found.iter().zip(&truth).zip(&sure) {
        assert!(sure[0] > 0.0 && sure[1] > 0.0, "{sure:?}");
        // Px and Fz are last.
        let truth = truth[truth.len() - 2];
        inside += u8::from((found[0] - truth).abs() <= 1.959_964 * sure[0]);
    }
    let share = 100.0 * f64::from(inside) / found.len() as f64;
    let share = format!("Px {share:.1} %");
    let report = bench.json("evaluate data --with process.model --metrics mae");
    let notes = report["provenance"]["notes"].as_array().expect("a list");
    let mut notes = notes.iter().filter_map(|note| note.as_str());
    let note = notes.find(|note| note.starts_with("share of samples within 1.96 predicted"));
    let note = note.expect("deviations are judged");
    assert!(note.contains(&share), "{share} in: {note}");
    assert!(note.contains(&format!("n {}", found.len())), "{note}");
}

#[test]
fn predictions_state_the_distance_of_each_picture_and_scores_leave_it_out() {
    let bench = Bench::new();
    bench.record("data", 64);
    bench.ok("fit data --model ridge --out ridge.model");
    bench.ok("predict data --with ridge.model --out found.csv --truth-out truth.csv");
    let text = fs::read_to_string(bench.path("found.csv")).expect("written");
    let mut lines = text.lines();
    let head = lines.next().expect("a header");
    assert!(head.ends_with(",distance"), "{head}");
    let distances: Vec<f64> = lines
        .map(|line| {
            let (_, distance) = line.rsplit_once(',').expect("cells");
            distance.parse().expect("a number")
        })
        .collect();
    assert!(!distances.is_empty());
    assert!(
        distances
            .iter()
            .all(|distance| (0.0..1e6).contains(distance)),
        "{distances:?}"
    );
    let report = bench.json("score --truth truth.csv --pred found.csv --metrics mae");
    let mae = &report["metrics"]["mae"];
    assert!(
        mae["Fz"]["value"].is_number() && mae["distance"].is_null(),
        "{mae}"
    );
    // A label of this name is scored.
    bench.write("t.csv", "sample,distance\na,1\nb,2\n");
    bench.write("p.csv", "sample,distance\na,1.5\nb,2.5\n");
    let report = bench.json("score --truth t.csv --pred p.csv --metrics mae");
    assert_eq!(report["metrics"]["mae"]["distance"]["value"], 0.5);
}

#[test]
fn deviations_are_not_made_up_for_a_model_that_knows_none() {
    let bench = Bench::new();
    bench.record("data", 64);
    bench.ok("fit data --model ridge --out ridge.model");
    bench.refused(
        "predict data --with ridge.model --out found.csv --deviations-out sure.csv",
        2,
        "estimates no standard deviations",
    );
    bench.refused(
        "predict data --with ridge.model --out found.csv --truth-out found.csv",
        2,
        "name the same file",
    );
    assert!(!bench.path("found.csv").exists());
    let report = bench.json("evaluate data --with ridge.model --metrics mae");
    assert!(!report["provenance"]["notes"].to_string().contains("1.96"));
}
