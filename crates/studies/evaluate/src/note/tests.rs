use taceva_core::Unit;
use taceva_results::{Score, Value, Variant};

use super::*;

#[test]
fn the_note_says_what_the_clusters_are_and_how_many_there_are_of_both() {
    let note = |recordings, points| {
        let note = Note::Clusters {
            recordings,
            points,
            least: 5,
        };
        note.to_string()
    };
    let few = note(3, 24);
    assert!(few.contains("24 contact points of 3 recordings"), "{few}");
    assert!(few.contains("by contact point do not show"), "{few}");
    let enough = note(5, 40);
    assert!(
        enough.contains("(5 recordings with 40 contact points)"),
        "{enough}"
    );
    assert!(enough.contains("5 are few") && enough.contains("4 degrees of freedom"));
    assert!(!note(12, 99).contains("few"));
}

#[test]
fn a_column_of_unit_one_is_named_with_the_channel_that_it_may_be() {
    let note = Note::UnitOfOne(vec!["Fz_N".to_owned(), "grip".to_owned()]);
    assert_eq!(
        note.to_string(),
        "Fz_N: not one of Px Py Pz Fx Fy Fz; scored as a channel with the unit 1; rename it Fz, or give --units Fz_N=N; \
         grip: not one of Px Py Pz Fx Fy Fz; scored as a channel with the unit 1; to state its unit, give --units grip=UNIT"
    );
}

#[test]
fn an_angle_that_may_be_in_radians_is_named_with_both_remedies() {
    let note = |period| {
        let channel = "yaw".to_owned();
        Note::LikelyRadians { channel, period }.to_string()
    };
    assert_eq!(
        note(360),
        "yaw: all values lie within ±6.28, as angles in radians do, but are scored as degrees with a period of 360, because no unit is \
         stated; give --periods yaw=2pi for radians, or --units yaw=deg for degrees"
    );
    assert!(note(90).contains("--periods yaw=0.5pi"), "{}", note(90));
}

#[test]
fn depths_state_the_uncertainty_of_their_zero_and_how_many_have_none() {
    let note = |without| {
        let note = Note::DepthZeros {
            recording: Some("lab".to_owned()),
            median_mm: 0.004_4,
            most_mm: 0.012,
            without,
            of: 480,
        };
        note.to_string()
    };
    assert_eq!(
        note(0),
        "lab: Pz counts from the surface of the gel, fitted for each press: standard uncertainty 0.004 mm (median), at most 0.012 mm"
    );
    let some = note(3);
    assert!(
        some.ends_with(
            "; 3 of 480 samples count from the first reading in contact, with unknown uncertainty"
        ),
        "{some}"
    );
}

#[test]
fn a_detection_limit_names_the_presses_that_it_stands_on_or_the_reason_that_there_is_none() {
    let score = |metric: &str, value: Option<f64>| {
        let mut score = Score::of_number(metric, "Fz", value.unwrap_or_default(), Unit::Newton);
        if value.is_none() {
            score.value = Value::Undefined("no light press".to_owned());
        }
        score
    };
    let said = |scores: &[Score]| Detection::of(scores).map(|detection| detection.to_string());
    let noise = score("noise_equivalent_force", Some(0.04));
    let only_noise = said(std::slice::from_ref(&noise)).expect("a note");
    assert!(
        only_noise.starts_with("detection limit: not verified; noise_equivalent_force uses")
            && only_noise.ends_with("ten places or more would verify a limit"),
        "{only_noise}"
    );
    let none = said(&[noise.clone(), score("detection_limit", None)]).expect("a note");
    assert!(
        none.starts_with("detection limit: not verified (no light press); ")
            && !none.contains("would verify"),
        "{none}"
    );
    let mut limit = score("detection_limit", Some(0.0812));
    limit.n = 24;
    limit.counts.push(("places".to_owned(), 12));
    let forces = [("least_force", 0.021), ("greatest_force", 0.199)];
    limit.variants = forces
        .map(|(name, force)| Variant {
            name: name.to_owned(),
            value: Value::Number(force),
            unit: Unit::Newton,
            interval: None,
        })
        .to_vec();
    assert_eq!(
        said(&[noise, limit]).expect("a note"),
        "detection limit: 0.081 N of Fz, from 24 samples of light presses (0.021 N to 0.199 N) at 12 places; it is not verified for other \
         forces, places and days"
    );
    assert_eq!(said(&[score("mae", Some(0.1))]), None);
}

#[test]
fn separated_neighbours_are_kept_together_by_the_column_of_their_groups() {
    let note = |column: Option<&str>| {
        let found = Neighbours {
            channel: "Fz".to_owned(),
            resemblance: 0.99,
            lag: 5,
            order: SampleOrder::Table,
            column: column.map(str::to_owned),
        };
        let division = Division::Separated {
            beside: 662,
            of: 696,
        };
        Note::Neighbours { found, division }.to_string()
    };
    let by_object = note(Some("object"));
    assert!(
        by_object.ends_with("--split 'cv:5 by-column:object'"),
        "{by_object}"
    );
    assert!(note(None).ends_with("--split 'cv:5 by-block'"));
}
