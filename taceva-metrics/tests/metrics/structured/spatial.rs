//! R_spatial: bins of whole nanometres.

use super::*;

#[test]
fn spatial_robustness_is_formed_in_whole_nanometres() {
    let golden = section(
        "r_spatial",
        &[
            "params",
            "recipe",
            "bin",
            "counts_dist",
            "counts_depth",
            "float_trap",
            "nmin1_pop",
            "nmin5_pop",
            "nmin1_sample",
        ],
    );
    let params = &golden["params"];
    check_keys(params, &["n", "seed", "Rm_nm", "Dm_nm", "bins", "scale"]);
    let (reach, deepest) = (signed(&params["Rm_nm"]), signed(&params["Dm_nm"]));
    assert_eq!(
        whole(&params["bins"]),
        100,
        "the definition has a hundred bins"
    );
    let mut random = Random::new(whole(&params["seed"]));
    let samples: Vec<Sample> = (0..usize::try_from(whole(&params["n"])).expect("a count"))
        .map(|row| {
            let (mut x, mut y);
            loop {
                x = random.below(2 * reach + 1) - reach;
                y = random.below(2 * reach + 1) - reach;
                if x * x + y * y <= reach * reach {
                    break;
                }
            }
            let mut depth = random.below(deepest + 1);
            if row % 40 == 0 {
                x = random.below(101) * (reach / 100);
                y = 0;
            }
            if row % 50 == 0 {
                depth = random.below(101) * (deepest / 100);
            }
            let error = (real(&params["scale"]) * random.bell()).abs();
            let place = [x, y, depth].map(|length| Some(millimetres(length)));
            let truth = place.into_iter().chain([Some(0.0)]).collect();
            Sample::default()
                .with_point_id(point(row))
                .with_truth(Readings::new(truth))
                .with_prediction(Readings::new(vec![None, None, None, Some(error)]))
        })
        .collect();
    let footprint = Footprint::disc(millimetres(reach), Some(millimetres(deepest)));
    let facts = SensorFacts::default().with_footprint(Some(footprint.expect("lengths")));
    let channels = [Channel::PX, Channel::PY, Channel::PZ, Channel::FZ];
    let plan = plan(&["r_spatial"], &channels, facts);
    let mut comparison = Comparison::default();
    for (key, n_min, ddof) in [
        ("nmin1_pop", 1, 0),
        ("nmin5_pop", 5, 0),
        ("nmin1_sample", 1, 1),
    ] {
        let expected = &golden[key];
        check_keys(
            expected,
            &[
                "bins_dist",
                "bins_depth",
                "std_dist",
                "std_depth",
                "R",
                "truth_R",
            ],
        );
        let settings = Settings::default().with_n_min(n_min).with_ddof(ddof);
        for (way, evaluation) in in_every_way(&with(&plan, settings), &samples) {
            let what = |name: &str| format!("{key} {name} {way}");
            let of = |name| variant(&evaluation, "r_spatial", "Fz", name);
            let score = evaluation.score("r_spatial", "Fz").expect("a score");
            comparison.bits(&what("R"), score.value.scalar(), exact(&expected["R"]));
            comparison.bits(
                &what("distance"),
                of("std_distance"),
                exact(&expected["std_dist"]),
            );
            comparison.bits(
                &what("depth"),
                of("std_depth"),
                exact(&expected["std_depth"]),
            );
            let bins = [("bins_distance", "bins_dist"), ("bins_depth", "bins_depth")];
            for (name, key) in bins {
                comparison.count(&what(name), score.count(name), whole(&expected[key]));
            }
            for (name, key) in [("distance", "counts_dist"), ("depth", "counts_depth")] {
                let curve = score.variant(name).map(|curve| &curve.value);
                let Some(Finished::Curve(curve)) = curve else {
                    panic!("there is a curve over {name}");
                };
                for (bin, count) in golden[key].as_array().expect("counts").iter().enumerate() {
                    comparison.count(&what(key), curve.counts.get(bin).copied(), whole(count));
                }
            }
        }
    }
    println!("compared {} values of r_spatial", comparison.done());
}
