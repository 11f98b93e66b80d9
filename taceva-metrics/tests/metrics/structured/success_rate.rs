//! SR: counts of whole nanometres.

use super::*;

fn spacing_sample(row: usize, truth: Nanometre, predicted: Nanometre) -> Sample {
    Sample::default()
        .with_point_id(point(row))
        .with_kind(GratingKind::Line)
        .with_spacing(truth)
        .with_predicted_spacing(predicted)
}

/// Success rate of `samples` with `tolerance`, for every order and split of the samples.
fn success_rates(samples: &[Sample], tolerance: Nanometre) -> Vec<(&'static str, Evaluation)> {
    let plan = plan(&["sr"], &[], SensorFacts::default());
    let settings = Settings::default().with_resolution_tolerance(tolerance);
    in_every_way(&with(&plan, settings), samples)
}

#[test]
fn success_rates_are_the_counts_of_whole_nanometres() {
    let golden = section(
        "sr",
        &[
            "params",
            "tick_nm",
            "recipe",
            "counts_k0_to_k20",
            "n",
            "float_trap",
            "float_counts_on_recipe",
            "continuous",
            "continuous_rule",
        ],
    );
    let params = &golden["params"];
    check_keys(params, &["n", "seed", "tick_nm", "lo", "hi"]);
    let (tick, low, high) = (
        signed(&params["tick_nm"]),
        signed(&params["lo"]),
        signed(&params["hi"]),
    );
    let n = whole(&params["n"]);
    let mut random = Random::new(whole(&params["seed"]));
    let samples: Vec<Sample> = (0..usize::try_from(n).expect("a count"))
        .map(|row| {
            let level = low + random.below(high - low + 1);
            let error = random.below(7);
            let predicted = (level + error - 3).clamp(low, high);
            spacing_sample(row, Nanometre(level * tick), Nanometre(predicted * tick))
        })
        .collect();
    let mut comparison = Comparison::default();
    let counts = golden["counts_k0_to_k20"].as_array().expect("counts");
    for (k, count) in (0..).zip(counts) {
        let share = whole(count) as f64 / n as f64;
        for (way, evaluation) in success_rates(&samples, Nanometre(k * tick)) {
            comparison.bits(
                &format!("SR({k}) {way}"),
                value(&evaluation, "sr", "line"),
                share,
            );
            comparison.count("n", evaluation.score("sr", "line").map(|score| score.n), n);
            let curve = evaluation
                .score("sr", "line")
                .and_then(|score| score.variant("curve"));
            let Some(Finished::Curve(curve)) = curve.map(|curve| &curve.value) else {
                panic!("a success rate has a curve");
            };
            if tick == 50_000 {
                let at = usize::try_from(k).expect("a level");
                comparison.count("curve", curve.counts.get(at).copied(), whole(count));
            }
        }
    }
    for case in golden["float_trap"]["first"].as_array().expect("cases") {
        let [a, b, k] = [0, 1, 2].map(|at| signed(&case[at]));
        let sample = spacing_sample(0, Nanometre(a * tick), Nanometre(b * tick));
        let expected = if (a - b).abs() <= k { 1.0 } else { 0.0 };
        for (way, evaluation) in success_rates(&[sample], Nanometre(k * tick)) {
            comparison.bits(
                &format!("{case} {way}"),
                value(&evaluation, "sr", "line"),
                expected,
            );
        }
    }
    for case in golden["continuous"].as_array().expect("cases") {
        check_keys(case, &["r_mm", "rhat_mm", "eps_mm", "in"]);
        let length = |key: &str| text(&case[key]).parse::<Nanometre>().expect("a length");
        let sample = spacing_sample(0, length("r_mm"), length("rhat_mm"));
        let expected = if case["in"].as_bool().expect("yes or no") {
            1.0
        } else {
            0.0
        };
        for (way, evaluation) in success_rates(&[sample], length("eps_mm")) {
            comparison.bits(
                &format!("{case} {way}"),
                value(&evaluation, "sr", "line"),
                expected,
            );
        }
    }
    println!("compared {} values of sr", comparison.done());
}
