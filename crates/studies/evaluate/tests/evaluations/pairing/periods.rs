//! Tables with angles: values that differ by a period say the same.

use super::Tables;

#[test]
fn angles_of_tables_that_wrap_are_scored_by_their_period() {
    let truth = "sample,yaw,turn\na,359,1\nb,1,178\nc,-179,90\n";
    let prediction = "sample,yaw,turn\na,1,179\nb,358,1\nc,179,90\n";
    let mut tables = Tables::new(truth, prediction);
    tables.request.periods = vec![("yaw".to_owned(), 360), ("turn".to_owned(), 180)];
    let scored = tables.scored();
    let mae = |channel: &str| {
        let score = scored.report.score("mae", channel).expect("scored");
        score.value.number()
    };
    assert_eq!(mae("yaw"), Some((2.0 + 3.0 + 2.0) / 3.0));
    assert_eq!(mae("turn"), Some((2.0 + 3.0 + 0.0) / 3.0));
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
        tables.request.periods = vec![(name.to_owned(), period)];
        let refused = tables.refused();
        assert!(refused.contains(expected), "{refused}");
    }
}
