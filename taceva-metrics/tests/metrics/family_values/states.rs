//! States and reports: rejected states, and written reports.

use super::*;

#[test]
fn states_of_another_surface_or_other_constants_are_refused() {
    let samples = [pressed(0, [1.0, 1.0, 0.5], 2.0, 0.25)];
    let states = evaluator(&plan(&["uniformity"]), &samples)
        .states()
        .expect("one channel list");
    let other_surface = plan(&["uniformity"]).with_facts(
        facts().with_footprint(Some(Footprint::disc(10.0, Some(1.0)).expect("lengths"))),
    );
    let fewer_bins = plan(&["uniformity"]).with_settings(Settings::default().with_bins(10));
    for plan in [other_surface, fewer_bins.expect("ten bins")] {
        let error = Evaluator::new(&plan)
            .merge_states(&states)
            .expect_err("other parameters");
        assert!(
            error.to_string().starts_with("state with parameters"),
            "{error}"
        );
    }
    let refused = plan(&["uniformity"]).with_settings(Settings::default().with_bins(0));
    assert_eq!(
        refused.expect_err("no bin").to_string(),
        "setting `bins` is 0, expected 1 to 1000"
    );
}

#[test]
fn a_state_with_impossible_content_is_refused_and_changes_nothing() {
    let sample = lit(0, "S1", 100.0, 0.5)
        .with_kind(GratingKind::Line)
        .with_spacing(Nanometre(350_000))
        .with_predicted_spacing(Nanometre(350_000));
    let whole = evaluator(&plan(&METRICS), &[sample])
        .states()
        .expect("the plan's channels");
    let whole = serde_json::to_string(&whole).expect("a state");
    let edits = [
        (r#""counts":[0,0,1]"#, r#""counts":[0,0,0]"#),
        (r#""cells":{"10 10":"#, r#""cells":{"10 20":"#),
        (r#""cells":{"10 10":"#, r#""cells":{"1010":"#),
        (
            r#""cells":{"10 10":{"counts":[1,1]"#,
            r#""cells":{"10 10":{"counts":[0,0]"#,
        ),
        (r#""distance 00":"#, r#""distance 100":"#),
        (r#""distance 00":"#, r#""height 00":"#),
        (r#""S1":{"counts":[1]"#, r#""S1":{"counts":[0]"#),
        (r#""S1":{"counts":[1]"#, r#""S1":{"counts":[1,1]"#),
    ];
    for (from, to) in edits {
        let broken = whole.replacen(from, to, 1);
        assert_ne!(broken, whole, "{from} is in the state {whole}");
        let read: Vec<State> = serde_json::from_str(&broken).expect("JSON of a state");
        let refusals = read.iter().filter(|state| {
            let mut fresh = Evaluator::new(&plan(&METRICS));
            fresh.merge_states(std::slice::from_ref(state)).is_err()
        });
        assert_eq!(refusals.count(), 1, "{to} was taken");
    }
}

#[test]
fn a_report_has_maps_curves_and_variants_as_fields_of_their_metric() {
    let samples: Vec<Sample> = (0..5)
        .map(|point| pressed(point, [1.0, 1.0, 0.5], 2.0, 0.25))
        .collect();
    let two_bins = plan(&METRICS).with_settings(Settings::default().with_bins(2));
    let evaluator = evaluator(&two_bins.expect("two bins"), &samples);
    let evaluation = evaluator.finish().expect("the plan's channels");
    let report = serde_json::to_value(&evaluation).expect("a report");
    let sensitivity = &report["metrics"]["sensitivity"]["Fz"];
    assert_eq!(sensitivity["unit"], "mm/N");
    assert_eq!(sensitivity["slope"]["value"], 0.25);
    assert_eq!(sensitivity["slope"]["ci95"], json!([0.25, 0.25]));
    assert_eq!(
        sensitivity["counts"],
        json!({"gated": 0, "outside": 0, "bins_used": 1})
    );
    assert_eq!(
        sensitivity["map"],
        json!({
            "x_mm": [-12.5, 0.0, 12.5], "y_mm": [-12.5, 0.0, 12.5],
            "values": [[null, null], [null, 0.25]], "counts": [[0, 0], [0, 5]], "unit": "mm/N"
        })
    );
    assert_eq!(
        report["metrics"]["uniformity"]["Fz"]["flags"],
        json!(["one bin"])
    );
    let distance = &report["metrics"]["r_spatial"]["Fz"]["distance"];
    assert_eq!(
        (&distance["x_unit"], &distance["unit"]),
        (&json!("mm"), &json!("N"))
    );
    assert_eq!(distance["values"].as_array().map(Vec::len), Some(100));
    let table = format!("{evaluation:#}");
    assert!(table.contains("sensitivity.slope"), "{table}");
}
