//! Studies and settings that are rejected.

use taceva_metrology::gauge::{
    Design, Flag, GaugeError, GaugeReport, GaugeSettings, GaugeStudy, Method, NdcReason,
};

use super::example::{Row, analyse, readings, settings, study_of};

/// Start of an error message, and the change of settings that causes the error.
type Change = (&'static str, fn(&mut GaugeSettings));

/// Error for the worked example with only the readings for which `is_left` is true.
fn refusal(is_left: impl Fn(&Row) -> bool) -> GaugeError {
    let kept: Vec<_> = readings(1.0).into_iter().filter(is_left).collect();
    let refused = study_of(&kept).analyse(&settings(|_| {}));
    refused.expect_err("too little")
}

#[test]
fn one_operator_is_too_few() {
    assert_eq!(
        refusal(|row| row.operator == "A"),
        GaugeError::TooFewOperators { have: 1 }
    );
}

#[test]
fn one_part_is_too_few() {
    assert_eq!(
        refusal(|row| row.part == "part 3"),
        GaugeError::TooFewParts { have: 1 }
    );
}

#[test]
fn one_trial_is_too_few() {
    assert_eq!(
        refusal(|row| row.trial == "0"),
        GaugeError::TooFewTrials { have: 1 }
    );
}

#[test]
fn no_reading_is_too_few() {
    assert_eq!(refusal(|_| false), GaugeError::TooFewOperators { have: 0 });
}

#[test]
fn a_reading_that_is_nan_is_refused_by_cell() {
    for value in [f64::NAN, f64::INFINITY] {
        let refused = GaugeStudy::default()
            .add("p4", "B", "2", value)
            .expect_err("NaN");
        let text = refused.to_string();
        assert!(
            text.starts_with("part p4, operator B, trial 2: the reading is"),
            "{text}"
        );
    }
}

#[test]
fn unequal_cells_are_refused_by_the_first_and_dropped_as_whole_parts_if_wanted() {
    let is_left = |row: &Row| {
        !(row.part == "part 7" && row.operator == "B" && row.trial == "2"
            || row.part == "part 2" && row.operator == "C")
    };
    let error = refusal(is_left);
    assert_eq!(
        error.to_string(),
        "part part 2, operator C: 0 readings, expected 3 as in most cells; `--drop-incomplete` leaves such parts out"
    );
    let kept: Vec<_> = readings(1.0).into_iter().filter(is_left).collect();
    let dropping = settings(|settings| settings.drop_incomplete = true);
    let report = study_of(&kept).analyse(&dropping).expect("a report");
    assert_eq!((report.parts, report.dropped), (8, 2));
    assert!(report.flags.contains(&Flag::Dropped { parts: 2 }));
    let whole: Vec<_> = readings(1.0);
    let whole = whole
        .into_iter()
        .filter(|row| row.part != "part 7" && row.part != "part 2");
    let expected = study_of(&whole.collect::<Vec<_>>())
        .analyse(&dropping)
        .expect("a report");
    assert_eq!(report.table, expected.table);
}

#[test]
fn two_readings_of_one_trial_are_refused() {
    let mut all = readings(1.0);
    all.push(all[5].clone());
    let refused = study_of(&all).analyse(&settings(|_| {}));
    assert!(
        matches!(refused, Err(GaugeError::RepeatedTrial { .. })),
        "{refused:?}"
    );
}

#[test]
fn one_value_everywhere_has_components_of_zero_and_no_ndc() {
    let mut all = readings(1.0);
    all.iter_mut().for_each(|row| row.value = 0.1);
    for method in [Method::Anova, Method::Range] {
        let report = study_of(&all).analyse(&settings(|settings| settings.method = method));
        let report = report.expect("a report");
        for one in &report.components {
            assert_eq!((one.variance, one.sd, one.ci95), (0.0, 0.0, [0.0; 2]));
            assert_eq!(one.percent_study, None);
        }
        assert_eq!(report.ndc.value, None);
        assert_eq!(report.ndc.undefined, Some(NdcReason::NoVariation));
        assert!(report.flags.contains(&Flag::NoVariation) && report.band.is_none());
        let text = serde_json::to_string(&report).expect("finite numbers");
        assert_eq!(
            serde_json::from_str::<GaugeReport>(&text).expect("read"),
            report
        );
    }
}

#[test]
fn a_gauge_without_variation_has_no_ndc() {
    let mut all = readings(1.0);
    for row in &mut all {
        row.value = row.part.len() as f64 + f64::from(row.part.as_bytes()[5]);
    }
    let report = study_of(&all).analyse(&settings(|_| {})).expect("a report");
    assert_eq!(report.ndc.undefined, Some(NdcReason::NoGaugeVariation));
}

#[test]
fn settings_outside_their_range_are_refused_by_name() {
    let changes: [Change; 4] = [
        ("pool", |settings| settings.pool = f64::NAN),
        ("tolerance", |settings| settings.tolerance = Some(0.0)),
        ("draws", |settings| settings.draws = 10),
        ("the range method", |settings| {
            settings.design = Design::Nested;
            settings.method = Method::Range;
        }),
    ];
    for (name, change) in changes {
        let refused = study_of(&readings(1.0)).analyse(&settings(change));
        let text = refused.expect_err("refused").to_string();
        assert!(text.starts_with(name), "{text}");
    }
}

#[test]
fn errors_have_components_but_neither_categories_nor_a_band() {
    let report = analyse(|settings| settings.are_errors = true);
    let readings = analyse(|_| {});
    assert_eq!(report.components, readings.components);
    assert_eq!(report.ndc.undefined, Some(NdcReason::Errors));
    assert_eq!((report.ndc.value, report.ndc.ci95), (None, None));
    assert_eq!((report.band, report.band_ci95), (None, None));
    assert!(readings.band.is_some() && readings.ndc.value.is_some());
}
