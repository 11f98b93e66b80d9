//! Splits of several recordings, and of rows that are added later.

use taceva_models::{Part, SplitError, SplitInput, SplitSpec};

fn spec(text: &str) -> SplitSpec {
    text.parse().expect(text)
}

/// Point names `0, 0, 1, 1, …` of `count` rows, from number `first` on.
fn points(first: usize, count: usize) -> Vec<String> {
    (0..count)
        .map(|row| format!("p{}", first + row / 2))
        .collect()
}

#[test]
fn rows_that_come_later_change_no_part_and_a_known_point_keeps_its_own() {
    let before = points(0, 40);
    // Ten rows of known points, then five new points.
    let added = [&points(3, 10)[..], &points(20, 10)].concat();
    let all = [&before[..], &added].concat();
    for text in ["by-point", "random"] {
        for seed in 0..20 {
            let old = SplitInput {
                rows: 40,
                points: Some(&before),
                ..SplitInput::default()
            };
            let old = spec(text).assign(&old, seed).expect("enough points");
            let sections = [40];
            let new = SplitInput {
                rows: 60,
                points: Some(&all),
                sections: &sections,
                ..SplitInput::default()
            };
            let new = spec(text).assign(&new, seed).expect("enough points");
            for part in Part::ALL {
                let kept: Vec<usize> = new
                    .rows(part)
                    .iter()
                    .copied()
                    .filter(|row| *row < 40)
                    .collect();
                assert_eq!(kept, old.rows(part), "{text} {seed} {part}");
            }
            if text == "by-point" {
                for part in Part::ALL {
                    for row in new.rows(part) {
                        let others = (0..60).filter(|other| all[*other] == all[*row]);
                        for other in others {
                            assert!(new.rows(part).contains(&other), "{seed}: {}", all[*row]);
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn each_recording_is_divided_as_it_would_be_alone() {
    let own = points(0, 40);
    let alone = SplitInput {
        rows: 40,
        points: Some(&own),
        ..SplitInput::default()
    };
    let times: Vec<f64> = (0..120_u32).map(|row| f64::from(row % 40)).collect();
    let names: Vec<String> = (0..120).map(|row| format!("r{}", row / 40)).collect();
    let apart: Vec<String> = (0..120)
        .map(|row| format!("r{}/{}", row / 40, own[row % 40]))
        .collect();
    let sections = [40, 80];
    let joined = SplitInput {
        rows: 120,
        points: Some(&apart),
        times_s: Some(&times),
        recordings: Some(&names),
        sections: &sections,
        ..SplitInput::default()
    };
    for text in ["by-point", "random", "chronological"] {
        let alone = SplitInput {
            times_s: Some(&times[..40]),
            ..alone.clone()
        };
        let one = spec(text).assign(&alone, 3).expect("enough");
        let all = spec(text).assign(&joined, 3).expect("enough");
        for part in Part::ALL {
            let expected: Vec<usize> = [0, 40, 80]
                .iter()
                .flat_map(|first| one.rows(part).iter().map(move |row| first + row))
                .collect();
            assert_eq!(all.rows(part), expected, "{text} {part}");
        }
    }
}

#[test]
fn recordings_stay_whole_and_each_can_be_named() {
    let names: Vec<String> = (0..60).map(|row| format!("r{}", row / 10)).collect();
    let sections = [10, 20, 30, 40, 50];
    let input = SplitInput {
        rows: 60,
        recordings: Some(&names),
        sections: &sections,
        ..SplitInput::default()
    };
    let split = spec("by-recording")
        .assign(&input, 1)
        .expect("six recordings");
    for part in Part::ALL {
        assert_eq!(split.rows(part).len() % 10, 0, "{part}");
        assert!(!split.rows(part).is_empty(), "{part}");
    }
    let named = spec("by-recording=train:r0,r1;test:r5")
        .assign(&input, 1)
        .expect("named");
    assert_eq!(
        (named.train.len(), named.test.len(), named.left_out.len()),
        (20, 10, 30)
    );
    let error = spec("by-recording=train:r0;test:r9")
        .assign(&input, 1)
        .expect_err("no r9");
    assert!(
        error
            .to_string()
            .starts_with("split by-recording: no recording is called `r9`")
    );
    let error = spec("by-recording").assign(
        &SplitInput {
            rows: 60,
            ..SplitInput::default()
        },
        1,
    );
    let error = error.expect_err("one recording");
    assert!(
        error.to_string().contains("there is one recording"),
        "{error}"
    );
    assert!(matches!(
        spec("leave-one-recording-out").assign(&input, 1),
        Err(SplitError::ManyFolds { .. })
    ));
}

#[test]
fn a_section_with_fewer_points_than_parts_leaves_parts_empty_where_a_recording_alone_is_refused() {
    let points: Vec<String> = (0..22).map(|row| format!("p{row}")).collect();
    let sections = [20];
    let input = SplitInput {
        rows: 22,
        points: Some(&points),
        sections: &sections,
        ..SplitInput::default()
    };
    let split = spec("by-point").assign(&input, 0).expect("divided");
    let added: Vec<usize> = split
        .train
        .iter()
        .copied()
        .filter(|row| *row >= 20)
        .collect();
    assert!(!added.is_empty(), "most of two new points are learnt from");
}
