//! Gauge studies: AIAG's worked example, also read as a nested study, intervals and errors.

mod coverage;
mod exactness;
mod example;
mod nested;
mod range;
mod refusals;
mod text;

use serde_json::Value;
use taceva_metrology::gauge::{Band, ComponentName, Flag, GaugeReport, Source};

use crate::support::{close, number};
use example::{analyse, file};

const NAMES: [(ComponentName, &str); 7] = [
    (ComponentName::Repeatability, "repeatability"),
    (ComponentName::Operator, "operator"),
    (ComponentName::Interaction, "interaction"),
    (ComponentName::Reproducibility, "reproducibility"),
    (ComponentName::Gauge, "grr"),
    (ComponentName::Part, "part"),
    (ComponentName::Total, "total"),
];

fn holds_the_components(report: &GaugeReport, golden: &Value) {
    for (name, key) in NAMES {
        let found = report.component(name).expect("a component");
        close(
            found.variance,
            number(golden, &format!("/variance/{key}")),
            1e-13,
            key,
        );
        close(found.sd, number(golden, &format!("/sd/{key}")), 1e-13, key);
        let study = found.percent_study.expect("a share");
        close(
            study,
            number(golden, &format!("/percent_study/{key}")),
            1e-13,
            key,
        );
        if let Some(raw) = golden["variance_raw"][key].as_f64() {
            close(found.variance_raw.expect("raw"), raw, 1e-12, key);
        }
        if let Some(contribution) = golden["percent_contribution"][key].as_f64() {
            close(
                found.percent_contribution.expect("a share"),
                contribution,
                1e-13,
                key,
            );
        }
    }
    close(
        report.ndc.value.expect("ndc"),
        number(golden, "/ndc_sqrt2"),
        1e-13,
        "ndc",
    );
    assert_eq!(report.ndc.floor, golden["ndc_truncated"].as_u64());
}

#[test]
fn the_worked_example_has_aiag_s_table() {
    let (report, file) = (analyse(|_| {}), file());
    let rows = [
        (Source::Operator, "o"),
        (Source::Part, "p"),
        (Source::Interaction, "i"),
        (Source::Repeatability, "e"),
        (Source::Total, "total"),
    ];
    for (source, key) in rows {
        let row = report
            .table
            .iter()
            .find(|row| row.source == source)
            .expect("a row");
        let golden = &file["anova_exact"][key];
        assert_eq!(Some(row.df), golden["df"].as_u64());
        close(row.ss, number(golden, "/SS"), 2e-14, key);
        if let Some(ms) = golden["MS"].as_f64() {
            close(row.ms.expect("a mean square"), ms, 2e-14, key);
        }
    }
    let interaction = &report.table[2];
    close(
        interaction.f.expect("F"),
        number(&file, "/F_interaction"),
        1e-13,
        "F",
    );
    close(
        interaction.p.expect("p"),
        number(&file, "/p_interaction"),
        1e-13,
        "p",
    );
    close(
        report.table[0].f.expect("F"),
        number(&file, "/pooled/F_operator"),
        1e-13,
        "F",
    );
    close(
        report.table[1].f.expect("F"),
        number(&file, "/pooled/F_part"),
        1e-13,
        "F",
    );
}

#[test]
fn the_worked_example_pooled_has_aiag_s_components() {
    let report = analyse(|_| {});
    assert!(report.pooled);
    holds_the_components(&report, &file()["pooled"]);
    assert_eq!(report.band, Some(Band::Conditional));
}

#[test]
fn without_pooling_a_negative_interaction_is_shown_and_counted_as_zero() {
    let report = analyse(|settings| settings.pool = 1.0);
    assert!(!report.pooled);
    holds_the_components(&report, &file()["not_pooled"]);
    let flagged = report.flags.iter().any(|flag| {
        matches!(flag, Flag::NegativeComponent { component: ComponentName::Interaction, variance } if *variance < 0.0)
    });
    assert!(flagged, "{:?}", report.flags);
}

#[test]
fn intervals_are_those_of_the_reference() {
    let report = analyse(|settings| settings.draws = 200_000);
    let file = file();
    let ends = |key: &str| [0, 1].map(|end| number(&file, &format!("/intervals_95/{key}/{end}")));
    let of = |name| report.component(name).expect("a component");
    let both = |found: [f64; 2], expected: [f64; 2], relative, name| {
        close(found[0], expected[0], relative, name);
        close(found[1], expected[1], relative, name);
    };
    let squared = |name| of(name).ci95.map(|end| end * end);
    let chi = ends("repeatability_variance_chi2");
    both(
        squared(ComponentName::Repeatability),
        chi,
        1e-13,
        "repeatability",
    );
    both(
        squared(ComponentName::Gauge),
        ends("gamma_grr_MLS"),
        1e-12,
        "gauge",
    );
    let share = of(ComponentName::Gauge).percent_study_ci95.expect("ends");
    both(share, ends("percent_study_grr_GPQ"), 0.01, "share");
    both(report.ndc.ci95.expect("ends"), ends("ndc_GPQ"), 0.01, "ndc");
    assert_eq!(
        report.band_ci95,
        Some([Band::Conditional, Band::Unacceptable])
    );
}

#[test]
fn intervals_depend_on_the_seed_alone() {
    let one = analyse(|settings| settings.seed = 3);
    assert_eq!(one, analyse(|settings| settings.seed = 3));
    assert_ne!(one.ndc.ci95, analyse(|settings| settings.seed = 4).ndc.ci95);
}

#[test]
fn fewer_than_five_operators_are_said_with_their_degrees_of_freedom() {
    let report = analyse(|_| {});
    let text: Vec<String> = report.flags.iter().map(Flag::to_string).collect();
    let expected = "reproducibility has only 2 degrees of freedom, from 3 operators";
    assert!(text.iter().any(|line| line == expected), "{text:?}");
}

#[test]
fn a_tolerance_gives_six_deviations_over_it() {
    let report = analyse(|settings| settings.tolerance = Some(4.0));
    let gauge = report.component(ComponentName::Gauge).expect("a component");
    close(
        gauge.percent_tolerance.expect("a share"),
        150.0 * gauge.sd,
        1e-14,
        "tolerance",
    );
    let ends = gauge.percent_tolerance_ci95.expect("ends");
    close(ends[1], 150.0 * gauge.ci95[1], 1e-14, "tolerance");
}
