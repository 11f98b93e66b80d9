//! Tables with angles: values that differ by a period are equal.

use super::Tables;
use taceva_core::Unit;
use taceva_evaluate::Period;

#[test]
fn angles_of_tables_that_wrap_are_scored_by_their_period() {
    let truth = "sample,yaw,turn\na,359,1\nb,1,178\nc,-179,90\n";
    let prediction = "sample,yaw,turn\na,1,179\nb,358,1\nc,179,90\n";
    let mut tables = Tables::new(truth, prediction);
    tables.request.periods = vec![
        ("yaw".to_owned(), Period::from(360)),
        ("turn".to_owned(), Period::from(180)),
    ];
    let scored = tables.scored();
    let mae = |channel: &str| {
        let score = scored.report.score("mae", channel).expect("scored");
        score.value.number()
    };
    assert_eq!(mae("yaw"), Some((2.0 + 3.0 + 2.0) / 3.0));
    assert_eq!(mae("turn"), Some((2.0 + 3.0 + 0.0) / 3.0));
}

#[test]
fn an_angle_in_radians_is_scored_in_radians_by_the_period_of_its_unit() {
    let truth = "sample,yaw_rad\na,3.0\nb,0.1\n";
    let prediction = "sample,yaw_rad\na,-3.0\nb,0.2\n";
    for period in ["2pi", "6.283185307179586"] {
        let mut tables = Tables::new(truth, prediction);
        let period = period.parse().expect("a period");
        tables.request.periods = vec![("yaw_rad".to_owned(), period)];
        let scored = tables.scored();
        let score = scored.report.score("mae", "yaw_rad").expect("scored");
        assert_eq!(score.unit.symbol(), "rad");
        let expected = (std::f64::consts::TAU - 6.0 + 0.1) / 2.0;
        let found = score.value.number().expect("a number");
        assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
    }
    let mut tables = Tables::new(truth, prediction);
    tables.request.periods = vec![("yaw_rad".to_owned(), Period::from(360))];
    let refused = tables.refused();
    assert!(refused.contains("write yaw_rad=2pi"), "{refused}");
}

#[test]
fn a_period_of_a_length_or_of_no_column_is_refused() {
    let table = "sample,Pz,yaw\na,1,1\nb,2,2\n";
    for (name, period, expected) in [
        ("Pz", 360, "channel `Pz`: a period of 360 degrees"),
        (
            "roll",
            360,
            "a period is given for `roll`, but the predictions have no such column",
        ),
        (
            "yaw",
            720,
            "expected an angle in deg or rad and a period of 1 to 360 degrees",
        ),
    ] {
        let mut tables = Tables::new(table, table);
        tables.request.periods = vec![(name.to_owned(), Period::from(period))];
        let refused = tables.refused();
        assert!(refused.contains(expected), "{refused}");
    }
}

#[test]
fn an_angle_that_may_be_in_radians_is_warned_of_alike_by_every_way_of_reading() {
    let warning = "yaw: all values lie within ±6.28, as angles in radians do";
    let table = |last: f64| format!("sample,yaw\na,3.0\nb,-0.5\nc,{last}\n");
    let notes = |[truth, prediction]: [f64; 2], unit: Option<Unit>| {
        let mut tables = Tables::new(&table(truth), &table(prediction));
        tables.request.periods = vec![("yaw".to_owned(), Period::from(360))];
        tables.request.units = unit
            .map(|unit| ("yaw".to_owned(), unit))
            .into_iter()
            .collect();
        super::notes(&tables.scored())
    };
    let said = notes([6.2, -3.1], None);
    assert!(said.contains(warning), "{said}");
    assert!(
        said.contains("give --periods yaw=2pi for radians, or --units yaw=deg"),
        "{said}"
    );
    // A value beyond a turn in either table, or a stated unit, leaves no doubt.
    for (last, unit) in [
        ([6.5, 3.0], None),
        ([3.0, -179.0], None),
        ([6.2, -3.1], Some(Unit::Degree)),
    ] {
        let said = notes(last, unit);
        assert!(!said.contains(warning), "{last:?}: {said}");
    }
}

#[test]
fn a_period_in_radians_of_a_column_in_degrees_is_refused_with_both_remedies() {
    let table = "sample,yaw\na,1\nb,2\n";
    let mut tables = Tables::new(table, "sample,yaw\na,1\nb,3\n");
    tables.request.units = vec![("yaw".to_owned(), Unit::Degree)];
    tables.request.periods = vec![("yaw".to_owned(), "6.283".parse().expect("a period"))];
    let refused = tables.refused();
    assert!(
        refused.contains("write yaw=360 for degrees, or --units yaw=rad"),
        "{refused}"
    );
}
