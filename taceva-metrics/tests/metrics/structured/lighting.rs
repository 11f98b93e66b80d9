//! R_light: one rational of four numbers.

use super::*;

#[test]
fn robustness_to_lighting_is_one_rational_of_four_numbers() {
    let golden = section("r_light", &[]);
    let plan = plan(&["r_light"], &[Channel::FZ], SensorFacts::default());
    let mut comparison = Comparison::default();
    for case in golden.as_array().expect("cases") {
        check_keys(
            case,
            &["Ic", "Io", "MAEc", "MAEo", "dec", "status", "R", "R_plus"],
        );
        let sample = |row: usize, scene: &str, intensity: &str, error: &str| {
            Sample::default()
                .with_point_id(point(row))
                .with_scene_id(scene.to_owned())
                .with_intensity(exact(&case[intensity]))
                .with_truth(Readings::from_values([0.0]))
                .with_prediction(Readings::from_values([exact(&case[error])]))
        };
        let samples: Vec<Sample> = (0..6)
            .flat_map(|row| {
                [
                    sample(row, "normal", "Io", "MAEo"),
                    sample(row, "S1", "Ic", "MAEc"),
                ]
            })
            .collect();
        for (way, evaluation) in in_every_way(&plan, &samples) {
            let what = format!("{} {way}", case["dec"]);
            let score = evaluation.score("r_light", "Fz").expect("a score");
            let expected = match text(&case["status"]) {
                "ok" => {
                    comparison.bits(&what, score.value.scalar(), exact(&case["R"]));
                    let plus = text(&case["R_plus"]).parse().expect("a number");
                    let found = variant(&evaluation, "r_light", "Fz", "plus");
                    comparison.bits(&format!("plus of {what}"), found, plus);
                    let own = variant(&evaluation, "r_light", "Fz", "scene:S1");
                    comparison.bits(&format!("scene of {what}"), own, exact(&case["R"]));
                    continue;
                }
                "undefined_no_change" => UndefinedReason::NoChange,
                "undefined_zero_intensity" => UndefinedReason::ZeroIntensity,
                "undefined_zero_baseline_mae" => UndefinedReason::ZeroBaseline,
                other => panic!("status `{other}` is not known to this reader"),
            };
            assert!(case["R"].is_null() && case["R_plus"].is_null());
            assert_eq!(score.value, Finished::Undefined(expected), "{what}");
            comparison.count(&what, Some(score.n), 12);
        }
    }
    println!("compared {} values of r_light", comparison.done());
}
