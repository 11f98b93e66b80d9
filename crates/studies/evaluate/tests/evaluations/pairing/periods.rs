//! Tables with angles: values that differ by a period are equal.

use super::Tables;
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
