//! Nested studies and the one-way model.

use taceva_metrology::gauge::{ComponentName, Design, Flag, OneWay};

use super::example::{readings, settings, study_of};
use crate::support::{close, golden, number};

#[test]
fn a_nested_study_has_a_negative_operator_whatever_its_parts_are_called() {
    let golden = golden(include_str!("../../golden/nested.json"));
    let nested = settings(|settings| settings.design = Design::Nested);
    let repeated = readings(1.0);
    let mut unique = repeated.clone();
    for row in &mut unique {
        row.part = format!("{} {}", row.operator, row.part);
    }
    let report = study_of(&repeated).analyse(&nested).expect("a report");
    assert_eq!(
        study_of(&unique).analyse(&nested).expect("a report"),
        report
    );
    let dfs: Vec<u64> = report.table.iter().map(|row| row.df).collect();
    assert_eq!(dfs, [2, 27, 60, 89]);
    for (at, row) in report.table[..3].iter().enumerate() {
        close(
            row.ss,
            number(&golden, &format!("/nested/SS/{at}")),
            1e-13,
            "SS",
        );
        close(
            row.ms.expect("MS"),
            number(&golden, &format!("/nested/MS/{at}")),
            1e-13,
            "MS",
        );
    }
    for (name, key) in [
        (ComponentName::Repeatability, "repeatability"),
        (ComponentName::Part, "part_in_operator"),
        (ComponentName::Operator, "operator"),
    ] {
        let found = report.component(name).expect("a component");
        let expected = number(&golden, &format!("/nested/variance_raw/{key}"));
        close(found.variance_raw.expect("raw"), expected, 1e-12, key);
        close(found.variance, expected.max(0.0), 1e-12, key);
    }
    let is_flagged = |flag: &Flag| {
        matches!(
            flag,
            Flag::NegativeComponent {
                component: ComponentName::Operator,
                ..
            }
        )
    };
    assert!(report.flags.iter().any(is_flagged));
}

#[test]
fn the_one_way_model_of_unequal_groups_has_the_reference_s_components() {
    let golden = golden(include_str!("../../golden/nested.json"));
    let groups: Vec<Vec<f64>> =
        serde_json::from_value(golden["one_way"]["groups"].clone()).expect("groups");
    let found = OneWay::of(groups.iter().map(Vec::as_slice)).expect("a model");
    for (found, key) in [
        (found.mean_square_between, "MS_between"),
        (found.mean_square_within, "MS_within"),
        (found.group_size, "n0/1"),
        (found.within, "within"),
        (found.between, "between"),
        (
            found.between_freedom.expect("freedom"),
            "nu_between_Satterthwaite",
        ),
        (found.mean, "bias"),
    ] {
        close(
            found,
            number(&golden, &format!("/one_way/{key}")),
            1e-13,
            key,
        );
    }
}

#[test]
fn the_mean_of_unequal_groups_counts_the_deviation_of_a_large_group_once() {
    // s_b² Σ n²/n² + MS_w/n. The reference has √(MS_b/n), which covers the mean in 25 of 100 studies of groups of 1, 1, 1, 1 and 100.
    let golden = golden(include_str!("../../golden/nested.json"));
    let groups: Vec<Vec<f64>> =
        serde_json::from_value(golden["one_way"]["groups"].clone()).expect("groups");
    let found = OneWay::of(groups.iter().map(Vec::as_slice)).expect("a model");
    close(
        found.mean_uncertainty,
        0.010_597_909_831_697_425,
        1e-13,
        "unequal",
    );
    let equal = OneWay::of([[1.0, 2.0].as_slice(), &[4.0, 5.0]]).expect("a model");
    let of_squares = (equal.mean_square_between / 4.0).sqrt();
    close(equal.mean_uncertainty, of_squares, 1e-15, "equal");
}

#[test]
fn equal_groups_have_a_negative_component_that_counts_as_zero() {
    let found = OneWay::of([[1.0, 2.0].as_slice(), &[1.0, 2.0]]).expect("a model");
    assert!(found.between_variance_raw < 0.0 && found.between_freedom.is_none());
    assert_eq!((found.between, found.total), (0.0, found.within));
    assert!(OneWay::of([[1.0].as_slice(), &[2.0]]).is_none());
    assert!(OneWay::of([[1.0, 2.0].as_slice()]).is_none());
}
