//! Shares of the first k places, compared with exact fractions.

use crate::golden::{entries, fraction, positions, same, tasks, torchmetrics, value};
use taceva_tasks::{TaskScore, TopK, Undefined};

/// State of the scores of the golden set, all in one cluster.
fn top_k() -> TopK {
    let golden = tasks();
    let set = &golden["top_k"];
    let mut top_k = TopK::new(["0", "1", "2", "3"]).expect("names");
    let truths = positions(set, "truth");
    for (truth, scores) in truths.iter().zip(entries(set, "scores")) {
        let scores: Vec<f64> = serde_json::from_value(scores.clone()).expect("numbers");
        top_k
            .push("all", &truth.to_string(), &scores)
            .expect("four scores");
    }
    top_k
}

/// Values for the three treatments of equal scores: expected, for and against the true class.
fn values(scores: &[TaskScore], k: u64) -> [Option<f64>; 3] {
    ["", " ties_for", " ties_against"]
        .map(|ties| value(scores, "top_k", Some(&format!("k={k}{ties}"))).ok())
}

#[test]
fn every_exact_fraction_of_places_comes_out_rounded_once() {
    let golden = tasks();
    for k in [1_u64, 2, 3] {
        let exact = &golden["top_k"]["k"][k.to_string()];
        let expected = [
            fraction(&exact["ties expected"]),
            exact["ties for"].as_f64(),
            exact["ties against"].as_f64(),
        ];
        for (found, expected) in values(&top_k().scores(k), k).into_iter().zip(expected) {
            same(found, expected, &format!("k = {k}"));
        }
    }
}

#[test]
fn five_answers_for_one_set_differ_by_their_ties_alone() {
    // scikit-learn lets later classes win a tie, torchmetrics earlier ones.
    let golden = tasks();
    let sklearn = golden["top_k"]["k"]["1"]["sklearn"]
        .as_f64()
        .expect("a share");
    let torch = torchmetrics()["top_k"]["1"].as_f64().expect("a share");
    let [expected, best, worst] =
        values(&top_k().scores(1), 1).map(|value| value.expect("a share"));
    assert!(worst < torch && torch < expected && expected < sklearn && sklearn < best);
}

#[test]
fn as_many_places_as_classes_hold_every_class() {
    for k in [4, 5] {
        for score in top_k().scores(k) {
            assert_eq!(score.estimate.value, Err(Undefined::TooManyPlaces));
        }
    }
    for score in TopK::new(["a", "b"]).expect("names").scores(1) {
        assert_eq!(score.estimate.value, Err(Undefined::Empty));
    }
}

#[test]
fn an_interval_leaves_out_whole_clips() {
    let mut top_k = TopK::new(["a", "b", "c"]).expect("names");
    for clip in 0..6 {
        for frame in 0..10 {
            let scores = match clip == frame {
                true => [0.5, 0.25, 0.25],
                false => [0.25, 0.5, 0.25],
            };
            top_k
                .push(&clip.to_string(), "b", &scores)
                .expect("three scores");
        }
    }
    let estimate = &top_k.scores(1)[0].estimate;
    assert_eq!((estimate.n, estimate.clusters), (60, 6));
    assert_eq!(estimate.value, Ok(0.9));
    // Each clip has one miss, so that no clip moves the share.
    assert_eq!(
        estimate
            .interval
            .standard_error()
            .map(|error| error < 1e-12),
        Some(true)
    );
}
