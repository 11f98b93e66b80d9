//! S and U: rationals rounded once.

use super::*;

#[test]
fn sensitivity_and_uniformity_are_rationals_rounded_once() {
    let golden = section(
        "su",
        &[
            "params",
            "recipe",
            "bin",
            "gated",
            "kept",
            "nonempty",
            "nmin1",
            "nmin5",
            "slope_through_origin",
        ],
    );
    let params = &golden["params"];
    check_keys(
        params,
        &["n", "seed", "R_nm", "G", "z_scale", "F_scale", "gate_N"],
    );
    let half = signed(&params["R_nm"]);
    let bins = signed(&params["G"]);
    let gate = real(&params["gate_N"]);
    let mut random = Random::new(whole(&params["seed"]));
    let samples: Vec<Sample> = (0..usize::try_from(whole(&params["n"])).expect("a count"))
        .map(|row| {
            let mut x = random.below(2 * half + 1) - half;
            let y = random.below(2 * half + 1) - half;
            let z = random.unit() * real(&params["z_scale"]);
            let mut force = random.unit() * real(&params["F_scale"]);
            if row % 97 == 0 {
                x = random.below(bins + 1) * (2 * half / bins) - half;
            }
            if row % 501 == 0 {
                force = 0.02;
            }
            Sample::default()
                .with_point_id(point(row))
                .with_truth(Readings::from_values([
                    millimetres(x),
                    millimetres(y),
                    z,
                    force,
                ]))
        })
        .collect();
    let side = millimetres(half);
    let facts = SensorFacts::default().with_footprint(Some(
        Footprint::rectangle(side, side, None).expect("a length"),
    ));
    let plan = plan(
        &["sensitivity", "uniformity"],
        &[Channel::PX, Channel::PY, Channel::PZ, Channel::FZ],
        facts,
    );
    let settings = Settings::default()
        .with_bins(u32::try_from(bins).expect("few bins"))
        .with_gate(taceva_core::Newton(gate));
    let mut comparison = Comparison::default();
    for (key, n_min) in [("nmin1", 1), ("nmin5", 5)] {
        let expected = &golden[key];
        check_keys(
            expected,
            &["bins_used", "mu", "sigma_pop", "sigma_sample", "U", "truth"],
        );
        for ddof in [0, 1] {
            let settings = settings.with_n_min(n_min).with_ddof(ddof);
            for (way, evaluation) in in_every_way(&with(&plan, settings), &samples) {
                let what = |name: &str| format!("{key} {name} ddof {ddof} {way}");
                let of = |name| variant(&evaluation, "uniformity", "Fz", name);
                let score = evaluation.score("uniformity", "Fz").expect("a score");
                let sigma = if ddof == 0 {
                    "sigma_pop"
                } else {
                    "sigma_sample"
                };
                comparison.bits(&what("mu"), of("mean"), exact(&expected["mu"]));
                comparison.bits(&what(sigma), of("deviation"), exact(&expected[sigma]));
                comparison.count(
                    &what("bins"),
                    score.count("bins_used"),
                    whole(&expected["bins_used"]),
                );
                comparison.count(&what("kept"), Some(score.n), whole(&golden["kept"]));
                comparison.count(
                    &what("gated"),
                    score.count("gated"),
                    whole(&golden["gated"]),
                );
                if ddof == 0 {
                    comparison.bits(&what("U"), score.value.scalar(), exact(&expected["U"]));
                    let five = exact(&golden["nmin5"]["U"]);
                    comparison.bits(&what("U of 5"), of("n_min_5"), five);
                }
                let slope = exact(&golden["slope_through_origin"]["value"]);
                let found = variant(&evaluation, "sensitivity", "Fz", "slope");
                comparison.bits(&what("slope"), found, slope);
                let map = evaluation
                    .score("sensitivity", "Fz")
                    .and_then(|score| score.variant("map"));
                let Some(Finished::Map(map)) = map.map(|map| &map.value) else {
                    panic!("sensitivity has a map");
                };
                let nonempty = map
                    .counts
                    .iter()
                    .flatten()
                    .filter(|count| **count > 0)
                    .count();
                comparison.count(
                    &what("cells"),
                    Some(nonempty as u64),
                    whole(&golden["nonempty"]),
                );
            }
        }
    }
    println!("compared {} values of su", comparison.done());
}
