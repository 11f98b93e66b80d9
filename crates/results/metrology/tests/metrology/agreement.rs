//! Agreement of two peak flow meters, from data of Bland and Altman.

use serde_json::Value;
use taceva_metrology::agreement::{Agreement, Pair};

use crate::support::{case, close, number};

fn meters() -> (Value, Vec<Pair>) {
    let case = case("Bland and Altman 1986");
    let column = |key: &str| -> Vec<f64> {
        serde_json::from_value(case["inputs"][key].clone()).expect("numbers")
    };
    let pairs = column("large").into_iter().zip(column("mini"));
    let pairs = pairs.map(|(one, other)| Pair::new(one, other)).collect();
    (case, pairs)
}

#[test]
fn two_peak_flow_meters_agree_as_published() {
    let (case, pairs) = meters();
    let found = Agreement::of(&pairs).expect("17 pairs");
    let own = &case["own"];
    assert_eq!((found.n, found.freedom), (17, 16.0));
    close(found.bias, number(own, "/mean"), 1e-15, "bias");
    close(found.sd, number(own, "/sd"), 1e-15, "sd");
    for end in [0, 1] {
        let at = |key: &str| number(own, &format!("/{key}/{end}"));
        close(found.limits[end], at("limits_1.96"), 1e-14, "limits");
        close(found.bias_ci95[end], at("ci_mean"), 1e-14, "bias");
        let low = found.bias - 2.0 * found.sd;
        let high = found.bias + 2.0 * found.sd;
        close(
            [low, high][end],
            at("limits_2sd"),
            1e-14,
            "published limits",
        );
        close(
            found.lower_ci95[end],
            at("exact_lower_limit_ci"),
            1e-12,
            "lower",
        );
    }
}

#[test]
fn exchanged_methods_have_mirrored_limits() {
    let (_, pairs) = meters();
    let exchanged: Vec<Pair> = pairs
        .iter()
        .map(|pair| Pair::new(pair.other, pair.one))
        .collect();
    let (one, other) = (Agreement::of(&pairs), Agreement::of(&exchanged));
    let (one, other) = (one.expect("pairs"), other.expect("pairs"));
    for (left, right) in [
        (one.limits[0], other.limits[1]),
        (one.lower_ci95[0], other.upper_ci95[1]),
        (one.lower_ci95[1], other.upper_ci95[0]),
        (one.bias_ci95[0], other.bias_ci95[1]),
    ] {
        assert_eq!(left.to_bits(), (-right).to_bits());
    }
}

#[test]
fn a_slope_of_the_differences_is_that_of_least_squares() {
    // Means 1, 2, 3, 4 and differences 0, 1, 1, 2: slope 0.6, residuals −0.1, 0.3, −0.3, 0.1.
    let pairs = [[1.0, 0.0], [2.0, 1.0], [3.0, 1.0], [4.0, 2.0]];
    let pairs = pairs.map(|[mean, off]| Pair::new(mean + off / 2.0, mean - off / 2.0));
    let found = Agreement::of(&pairs)
        .and_then(|found| found.proportional)
        .expect("a slope");
    close(found.slope, 0.6, 1e-15, "slope");
    close(
        found.standard_error,
        0.02_f64.sqrt(),
        1e-15,
        "standard error",
    );
    // Two degrees of freedom: P(|T| > t) = 1 − t / √(2 + t²), and t² = 18.
    close(found.p, 1.0 - (18.0_f64 / 20.0).sqrt(), 1e-13, "p");
}

#[test]
fn clusters_of_one_pair_and_more_have_fewer_degrees_of_freedom() {
    let clusters: [&[Pair]; 3] = [
        &[0.0, 0.1].map(|value| Pair::new(value, 0.0)),
        &[1.0, 1.1, 1.2].map(|value| Pair::new(value, 0.0)),
        &[Pair::new(0.5, 0.0)],
    ];
    let found = Agreement::of_clusters(clusters).expect("three clusters");
    let all: Vec<Pair> = clusters.concat();
    let independent = Agreement::of(&all).expect("six pairs");
    assert_eq!((found.n, found.clusters), (6, Some(3)));
    close(found.bias, independent.bias, 1e-15, "bias");
    assert!(found.freedom < 3.0 && independent.freedom > 4.0);
    let width = |of: &Agreement| of.upper_ci95[1] - of.lower_ci95[0];
    assert!(width(&found) > width(&independent));
}

#[test]
fn too_few_pairs_and_numbers_that_are_none_have_no_agreement() {
    assert_eq!(Agreement::of(&[]), None);
    let pairs = [Pair::new(1.0, f64::NAN), Pair::new(1.0, 2.0)];
    assert_eq!(Agreement::of(&pairs), None);
    assert_eq!(Agreement::of_clusters([pairs.as_slice(), &pairs]), None);
    assert_eq!(
        Agreement::of_clusters([[Pair::new(1.0, 2.0)].as_slice()]),
        None
    );
}

#[test]
fn pairs_of_one_difference_agree_without_width() {
    let pairs = [1.0, 2.0, 3.0].map(|value| Pair::new(value, value));
    let found = Agreement::of(&pairs).expect("three pairs");
    assert_eq!(
        (found.sd, found.limits, found.upper_ci95),
        (0.0, [0.0; 2], [0.0; 2])
    );
    assert_eq!(found.proportional.map(|slope| slope.p), Some(1.0));
}
