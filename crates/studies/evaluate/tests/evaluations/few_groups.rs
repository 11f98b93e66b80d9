//! Recordings of few groups: their default split, and the remedy for too few.

use crate::division::{Row, evaluated, method, presses, record, said};

/// Presses whose contact points and units change after `length` rows.
fn grouped(count: usize, length: usize) -> impl Iterator<Item = Row> {
    let rows = presses(count).into_iter().enumerate();
    rows.map(move |(at, row)| Row {
        point: Some(format!("p{}", at / length)),
        unit: Some(format!("u{}", at / length)),
        ..row
    })
}

#[test]
fn each_of_five_points_is_tested_in_its_own_fold_and_scores_have_intervals() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), grouped(60, 12));
    let found = evaluated(&dataset, "ridge", None);
    let split = found.report.provenance.split.as_deref();
    assert_eq!(split, Some("cv:5 by-point"));
    assert!(method(&found).contains("Ends"), "{}", method(&found));
    assert!(!said(&found).contains("too few for intervals"));
}

#[test]
fn too_few_groups_are_counted_beside_a_split_that_scores_all() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("points"), grouped(72, 12));
    let found = said(&evaluated(&dataset, "ridge", Some("by-point")));
    let remedy =
        "scored on 1 contact point, too few for intervals; to score all 6: --split 'cv:5 by-point'";
    assert!(found.contains(remedy), "{found}");
    let unnamed = grouped(72, 12).map(|row| Row { point: None, ..row });
    let dataset = record(&folder.path().join("units"), unnamed);
    let found = said(&evaluated(&dataset, "ridge", Some("by-column:unit_id")));
    let remedy = "scored on 1 group of `unit_id`, too few for intervals; to score all 6: --split 'cv:5 by-column:unit_id'";
    assert!(found.contains(remedy), "{found}");
}

#[test]
fn named_parts_of_a_column_with_few_values_lead_to_contact_points() {
    let folder = tempfile::tempdir().expect("a folder");
    let unnamed = grouped(60, 30).map(|row| Row { point: None, ..row });
    let dataset = record(&folder.path().join("data"), unnamed);
    let split = Some("by-column:unit_id=train:u0;test:u1");
    let found = said(&evaluated(&dataset, "ridge", split));
    let remedy = "scored on 1 group of `unit_id`, too few for intervals, which need 5; for intervals over other groups, name their \
                  column as point_id";
    assert!(found.contains(remedy), "{found}");
}

#[test]
fn folds_count_the_samples_for_which_no_group_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let partly = grouped(72, 12).enumerate().map(|(at, row)| Row {
        point: None,
        unit: row.unit.filter(|_| at % 12 != 5),
        ..row
    });
    let dataset = record(&folder.path().join("data"), partly);
    let found = said(&evaluated(
        &dataset,
        "ridge",
        Some("cv:5 by-column:unit_id"),
    ));
    let counted = "; 6 of 72 samples are left out: no group is named for them; name one in the table, and import the table again";
    assert!(found.contains(counted), "{found}");
}
