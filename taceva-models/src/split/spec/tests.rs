use super::*;

#[test]
fn every_form_reads_and_prints() {
    for (text, formatted) in [
        ("random", "random 70/20/10"),
        ("chronological", "chronological 70/20/10"),
        ("by-point", "by-point 70/20/10"),
        ("by-column:object", "by-column:object 70/20/10"),
        (
            "by-column:repeat=train:1,2;val:3;test:4",
            "by-column:repeat=train:1,2;val:3;test:4",
        ),
        (
            "by-column:repeat=test:2;train:1",
            "by-column:repeat=train:1;test:2",
        ),
        ("by-recording", "by-recording 70/20/10"),
        (
            "by-recording=test:c;train:a,b",
            "by-recording=train:a,b;test:c",
        ),
        (
            "leave-one-recording-out",
            "leave-one-recording-out 70/20/10",
        ),
        ("by-block", "by-block 70/20/10"),
        ("cv:5", "cv:5"),
        ("cv:10 by-point", "cv:10 by-point"),
        ("cv:3 by-column:object", "cv:3 by-column:object"),
        ("loo by-block", "loo by-block"),
        ("declared", "declared"),
        ("all", "all"),
    ] {
        let spec: SplitSpec = text.parse().expect(text);
        assert_eq!(spec.to_string(), formatted);
        assert_eq!(formatted.parse(), Ok(spec));
    }
    let other: SplitSpec = "random 80/10/10".parse().expect("shares");
    assert_eq!(other.to_string(), "random 80/10/10");
}

#[test]
fn a_value_with_the_marks_of_a_split_in_it_stands_behind_backslashes() {
    let text = r"by-recording=train:run\;1,a\,b;test:c\\";
    let spec: SplitSpec = text.parse().expect("a split");
    let SplitKind::ByRecording(parts) = &spec.kind else {
        panic!("{spec:?}");
    };
    let names: Vec<&str> = parts.keys().map(String::as_str).collect();
    assert_eq!(names, ["a,b", "c\\", "run;1"]);
    assert_eq!(spec.to_string().parse(), Ok(spec));
    // Before any other letter, `\` is an ordinary character.
    let plain: SplitSpec = r"by-column:path=train:a\b;test:c".parse().expect("a split");
    let SplitKind::ByColumn(split) = &plain.kind else {
        panic!("{plain:?}");
    };
    assert!(split.parts.contains_key(r"a\b"), "{split:?}");
    assert_eq!(plain.to_string().parse(), Ok(plain));
}

#[test]
fn what_cannot_be_read_says_what_would_be_accepted() {
    let error = "by-pont".parse::<SplitSpec>().expect_err("misspelt");
    assert_eq!(
        error.to_string(),
        "no split is called `by-pont`, did you mean `by-point`?"
    );
    let error = "chronological:80/0/20".parse::<SplitSpec>();
    assert_eq!(
        error.expect_err("a colon").to_string(),
        "no split is called `chronological:80/0/20`, did you mean `chronological 80/0/20`?"
    );
    for text in [
        "by-column:",
        "by-column:a=",
        "by-column:a=train:1",
        "by-column:a=train:1;exam:2",
        "by-column:a=train:1,;test:2",
        "by-column:a=train",
    ] {
        assert!(
            matches!(
                text.parse::<SplitSpec>(),
                Err(SplitError::Assignment { .. })
            ),
            "{text}"
        );
    }
    assert!(matches!(
        "by-column:a=train:1;test:1".parse::<SplitSpec>(),
        Err(SplitError::Twice { .. })
    ));
}

#[test]
fn shares_that_do_not_come_to_a_hundred_are_refused() {
    for (text, sum) in [
        ("by-point 35/20/10", 65.0),
        ("random 70/20/20", 110.0),
        ("35/20/10", 65.0),
    ] {
        let error = text.parse::<SplitSpec>().expect_err(text);
        assert!(
            matches!(error, SplitError::Sum { sum: found, .. } if (found - sum).abs() < 1e-9),
            "{error}"
        );
    }
    for text in ["random 0.7/0.2/0.1", "random 33.3333/33.3333/33.3333"] {
        assert!(text.parse::<SplitSpec>().is_ok(), "{text}");
    }
}

#[test]
fn numbers_of_folds_that_are_none_are_refused() {
    for text in ["cv:1", "cv:0", "cv:-3", "cv:", "cv:five"] {
        let error = text.parse::<SplitSpec>().expect_err(text);
        assert!(matches!(error, SplitError::Folds { .. }), "{error}");
    }
    let error = "cv:5 by-pont".parse::<SplitSpec>().expect_err("misspelt");
    assert_eq!(
        error.to_string(),
        "no split is called `by-pont`, did you mean `by-point`?"
    );
}

#[test]
fn counts_follow_the_largest_remainder() {
    let fractions = Fractions::default();
    assert_eq!(fractions.counts(10), [7, 2, 1]);
    assert_eq!(fractions.counts(457), [320, 91, 46]);
    assert_eq!(fractions.counts(0), [0, 0, 0]);
    let halves = Fractions::new(1.0, 0.0, 1.0).expect("valid");
    assert_eq!(halves.counts(5), [3, 0, 2]);
    assert!(Fractions::new(0.0, 1.0, 1.0).is_err());
    assert!(Fractions::new(f64::NAN, 1.0, 1.0).is_err());
}
