//! Guarantees of every split for any recording.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use taceva_models::{
    Fractions, Part, Split, SplitBlocks, SplitCounts, SplitError, SplitInput, SplitKind,
    SplitManifest, SplitSpec,
};

fn spec(text: &str) -> SplitSpec {
    text.parse().expect(text)
}

fn names(numbers: &[u8]) -> Vec<String> {
    numbers.iter().map(|number| format!("p{number}")).collect()
}

fn all_rows(split: &Split) -> Vec<usize> {
    let mut rows: Vec<usize> = Part::ALL
        .into_iter()
        .flat_map(|part| split.rows(part).to_vec())
        .chain(split.left_out.iter().copied())
        .collect();
    rows.sort_unstable();
    rows
}

proptest! {
    #[test]
    fn parts_are_disjoint_cover_everything_and_come_in_order(
        points in prop::collection::vec(0_u8..12, 3..80),
        seed: u64,
    ) {
        let points = names(&points);
        let times: Vec<f64> = (0..points.len()).map(|row| ((row * 37) % 11) as f64).collect();
        let input = SplitInput {
            rows: points.len(),
            points: Some(&points),
            times_s: Some(&times),
            columns: BTreeMap::from([("object", points.as_slice())]),
            ..SplitInput::default()
        };
        for text in ["random", "chronological", "by-point", "by-column:object"] {
            match spec(text).assign(&input, seed) {
                Ok(split) => {
                    prop_assert_eq!(all_rows(&split), (0..points.len()).collect::<Vec<_>>());
                    for part in Part::ALL {
                        prop_assert!(!split.rows(part).is_empty());
                        prop_assert!(split.rows(part).is_sorted());
                    }
                    prop_assert_eq!(&split, &spec(text).assign(&input, seed).expect("again"));
                }
                Err(error) => {
                    let clusters = points.iter().collect::<BTreeSet<_>>().len();
                    let few = matches!(error, SplitError::Few { found, .. } if found == clusters);
                    prop_assert!(few && clusters < 3, "{}", error);
                }
            }
        }
    }

    #[test]
    fn clusters_stay_whole(points in prop::collection::vec(0_u8..9, 30..80), seed: u64) {
        let points = names(&points);
        let input = SplitInput { rows: points.len(), points: Some(&points), ..SplitInput::default() };
        let split = spec("by-point").assign(&input, seed).expect("enough points");
        let mut part_of = BTreeMap::new();
        for part in Part::ALL {
            for &row in split.rows(part) {
                prop_assert_eq!(*part_of.entry(&points[row]).or_insert(part), part);
            }
        }
    }

    #[test]
    fn where_each_sample_is_a_point_by_point_is_random(rows in 3_usize..60, seed: u64) {
        let points: Vec<String> = (0..rows).map(|row| format!("p{}", (row * 17) % 61)).collect();
        let input = SplitInput { rows, points: Some(&points), ..SplitInput::default() };
        let random = spec("random").assign(&input, seed).expect("enough samples");
        let by_point = spec("by-point").assign(&input, seed).expect("enough points");
        prop_assert!(by_point.note.as_deref().is_some_and(|note| note.contains("by-point equals random")));
        prop_assert_eq!(by_point, Split { note: by_point_note(), ..random });
    }

    #[test]
    fn names_of_points_do_not_matter(points in prop::collection::vec(0_u8..9, 30..80), seed: u64) {
        let first = names(&points);
        let second: Vec<String> = points.iter().map(|number| format!("q{}", 9 - number)).collect();
        let assign = |points: &[String]| {
            let input = SplitInput { rows: points.len(), points: Some(points), ..SplitInput::default() };
            spec("by-point").assign(&input, seed)
        };
        prop_assert_eq!(assign(&first), assign(&second));
    }
}

fn by_point_note() -> Option<String> {
    Some("every sample is its own contact point: by-point equals random".into())
}

#[test]
fn a_seed_gives_the_same_parts_for_ever() {
    let input = SplitInput {
        rows: 10,
        ..SplitInput::default()
    };
    let split = spec("random").assign(&input, 7).expect("enough samples");
    // Values from an independent implementation. A change of the generator or the shuffle would change every published split.
    assert_eq!(
        (split.train, split.validation, split.test),
        (vec![0, 1, 3, 4, 5, 8, 9], vec![2, 6], vec![7])
    );
}

#[test]
fn seeds_differ() {
    let input = SplitInput {
        rows: 100,
        ..SplitInput::default()
    };
    let test = |seed| {
        spec("random")
            .assign(&input, seed)
            .expect("enough samples")
            .test
    };
    assert_ne!(test(1), test(2));
}

#[test]
fn chronological_splits_by_time_and_ties_by_row() {
    let times = [5.0, 1.0, 1.0, 0.0, -0.0, 9.0, 7.0, 7.0, 8.0, 2.0];
    let input = SplitInput {
        rows: 10,
        times_s: Some(&times),
        ..SplitInput::default()
    };
    let split = spec("chronological").assign(&input, 0).expect("times");
    assert_eq!(split.train, [0, 1, 2, 3, 4, 6, 9]);
    assert_eq!(split.validation, [7, 8]);
    assert_eq!(split.test, [5]);
    let untimed = SplitInput {
        times_s: None,
        ..input
    };
    assert_eq!(
        spec("chronological").assign(&untimed, 0),
        Err(SplitError::NoTimes)
    );
}

#[test]
fn assigned_values_go_where_they_are_sent_and_others_are_counted() {
    let repeats = ["1", "2", "3", "1", "2", "9"].map(String::from);
    let input = SplitInput {
        rows: 6,
        columns: BTreeMap::from([("repeat", repeats.as_slice())]),
        ..SplitInput::default()
    };
    let split = spec("by-column:repeat=train:1;val:3;test:2")
        .assign(&input, 0)
        .expect("values");
    assert_eq!(
        (&split.train[..], &split.validation[..]),
        (&[0, 3][..], &[2][..])
    );
    assert_eq!(
        (&split.test[..], &split.left_out[..]),
        (&[1, 4][..], &[5][..])
    );
    assert_eq!(
        split.note.as_deref(),
        Some(
            "1 of 6 samples is left out: its `repeat` is assigned to no part; name a part for every value of `repeat` in --split"
        )
    );
    let split = spec("by-column:repeat=train:1;test:2")
        .assign(&input, 0)
        .expect("values");
    assert!(split.validation.is_empty());
    let error = spec("by-column:repaet=train:1;test:2")
        .assign(&input, 0)
        .expect_err("no column");
    assert_eq!(
        error.to_string(),
        "split by-column: no column `repaet`, did you mean `repeat`?"
    );
    let error = spec("by-column:repeat=train:1;test:7")
        .assign(&input, 0)
        .expect_err("no value");
    assert_eq!(
        error.to_string(),
        "split by-column: no sample has `repeat` = `7`, expected one of 1, 2, 3, 9"
    );
}

#[test]
fn declared_parts_are_taken_as_they_are() {
    let parts = ["train", "test", "val", "validation", "train"].map(String::from);
    let input = SplitInput {
        rows: 5,
        parts: Some(&parts),
        ..SplitInput::default()
    };
    let split = spec("declared").assign(&input, 0).expect("parts");
    assert_eq!(
        (&split.train[..], &split.validation[..]),
        (&[0, 4][..], &[2, 3][..])
    );
    let parts = ["train", "exam"].map(String::from);
    let input = SplitInput {
        rows: 2,
        parts: Some(&parts),
        ..SplitInput::default()
    };
    let error = spec("declared").assign(&input, 0).expect_err("no part");
    assert_eq!(
        error.to_string(),
        "row 1: part `exam`, expected train, val, validation or test"
    );
    let parts = ["train", "train"].map(String::from);
    let input = SplitInput {
        parts: Some(&parts),
        ..input
    };
    assert_eq!(
        spec("declared").assign(&input, 0),
        Err(SplitError::Empty { part: Part::Test })
    );
}

#[test]
fn a_part_without_a_share_stays_empty() {
    let spec = SplitSpec {
        kind: SplitKind::Random,
        fractions: Fractions::new(8.0, 0.0, 2.0).expect("shares"),
    };
    let input = SplitInput {
        rows: 5,
        ..SplitInput::default()
    };
    let split = spec.assign(&input, 1).expect("enough samples");
    let counts = SplitCounts::of(&split);
    assert_eq!((counts.train, counts.validation, counts.test), (4, 0, 1));
    assert_eq!(spec.to_string(), "random 80/0/20");
}

#[test]
fn too_few_clusters_are_refused() {
    let points = ["a", "a", "b", "b"].map(String::from);
    let input = SplitInput {
        rows: 4,
        points: Some(&points),
        ..SplitInput::default()
    };
    let error = spec("by-point").assign(&input, 0).expect_err("two points");
    assert_eq!(
        error.to_string(),
        "2 points are too few for one in each part"
    );
    let short = SplitInput { rows: 5, ..input };
    let error = spec("by-point")
        .assign(&short, 0)
        .expect_err("another length");
    assert_eq!(error.to_string(), "points: 4 values for 5 samples");
}

#[test]
fn a_manifest_holds_the_ids_and_comes_back_from_json() {
    let ids: Vec<String> = (0..10).map(|row| format!("press {row}")).collect();
    let input = SplitInput {
        rows: 10,
        ..SplitInput::default()
    };
    let spec = spec("random");
    let split = spec.assign(&input, 3).expect("enough samples");
    let manifest = SplitManifest::new(&spec, 3, &split, &ids).expect("an id a row");
    assert_eq!(manifest.split, "random 70/20/10");
    assert_eq!(manifest.test, [format!("press {}", split.test[0])]);
    let text = serde_json::to_string(&manifest).expect("plain data");
    assert_eq!(
        serde_json::from_str::<SplitManifest>(&text).expect("same"),
        manifest
    );
    assert!(SplitManifest::new(&spec, 3, &split, &ids[1..]).is_err());
}

/// Folds of 40 rows in 20 points, and the names of the points.
fn folds_of_points(text: &str, points: &[String]) -> Result<Vec<Split>, SplitError> {
    let input = SplitInput {
        rows: points.len(),
        points: Some(points),
        ..SplitInput::default()
    };
    let SplitKind::Folds(folds) = spec(text).kind else {
        panic!("{text} is not a cross-validation");
    };
    Ok(folds.folds(&input, Fractions::default(), 3)?.splits)
}

#[test]
fn folds_test_on_each_sample_once_and_never_share_a_point() {
    let points: Vec<String> = (0..40).map(|row| format!("p{}", row / 2)).collect();
    for (text, count) in [
        ("cv:5", 5),
        ("cv:7 by-point", 7),
        ("loo by-point", 20),
        ("cv:20", 20),
    ] {
        let folds = folds_of_points(text, &points).expect("enough points");
        assert_eq!(folds.len(), count);
        let mut tested: Vec<usize> = folds.iter().flat_map(|fold| fold.test.clone()).collect();
        tested.sort_unstable();
        assert_eq!(tested, (0..40).collect::<Vec<_>>(), "{text}");
        for fold in &folds {
            assert!(
                !fold.train.is_empty() && !fold.validation.is_empty(),
                "{text}"
            );
            assert_eq!(
                fold.train.len() + fold.validation.len() + fold.test.len(),
                40
            );
            for row in &fold.test {
                // The other row of the same point.
                assert!(fold.test.contains(&(row ^ 1)), "{text}");
            }
            for row in &fold.validation {
                assert!(fold.validation.contains(&(row ^ 1)), "{text}");
            }
        }
        assert_eq!(folds_of_points(text, &points), Ok(folds));
    }
}

#[test]
fn more_folds_than_groups_are_refused_with_both_numbers() {
    let points: Vec<String> = (0..8).map(|row| format!("p{}", row / 2)).collect();
    let error = folds_of_points("cv:5 by-point", &points).expect_err("four points");
    assert_eq!(
        error.to_string(),
        "5 folds, but the recording has 4 groups (by-point); use fewer folds or another --split"
    );
    assert!(folds_of_points("cv:4", &points).is_ok());
    let one = vec!["p".to_owned(); 8];
    assert!(matches!(
        folds_of_points("loo", &one),
        Err(SplitError::FewGroups { groups: 1, .. })
    ));
}

#[test]
fn blocks_of_different_parts_keep_a_gap_between_them_whose_samples_a_note_counts() {
    let names: Vec<String> = (0..100).map(|row| format!("block {}", row / 10)).collect();
    let places: Vec<usize> = (0..100).collect();
    let input = SplitInput {
        rows: 100,
        blocks: Some(SplitBlocks {
            names: &names,
            places: &places,
            gap: 3,
        }),
        ..SplitInput::default()
    };
    let SplitKind::Folds(folds) = spec("cv:5 by-block").kind else {
        panic!("no cross-validation");
    };
    let folds = folds
        .folds(&input, Fractions::default(), 1)
        .expect("ten blocks");
    let one = spec("by-block").assign(&input, 1).expect("ten blocks");
    for split in folds.splits.iter().chain([&one]) {
        assert!(!split.train.is_empty() && !split.left_out.is_empty());
        for test in &split.test {
            let near = |row: &&usize| row.abs_diff(*test) <= 3;
            assert!(!split.train.iter().any(|row| near(&row)));
            assert!(!split.validation.iter().any(|row| near(&row)));
        }
        for held in &split.validation {
            assert!(!split.train.iter().any(|row| row.abs_diff(*held) <= 3));
        }
    }
    let (unused, note) = (one.left_out.len(), one.note.unwrap_or_default());
    let said = format!(
        "{unused} of 100 samples are left out: they lie within 3 samples of a validation or test block, "
    );
    assert!(note.starts_with(&said), "{note}");
    let without = SplitInput {
        rows: 100,
        ..SplitInput::default()
    };
    assert_eq!(
        spec("by-block").assign(&without, 1),
        Err(SplitError::NoBlocks)
    );
}
