//! Coverage: shares of simulated studies whose intervals contain the truth.

use taceva_core::random::Draws;
use taceva_metrology::gauge::{ComponentName, GaugeStudy};

use super::example::settings;

/// Standard deviations of parts, operators, their interaction and repeats.
const TRUTH: [f64; 4] = [1.0, 0.3, 0.1, 0.2];

/// A study of 8 parts, 6 operators and 2 trials.
fn simulated(draws: Draws) -> GaugeStudy {
    let mut study = GaugeStudy::default();
    for part in 0..8 {
        for operator in 0..6 {
            for trial in 0..2 {
                let cell = 6 * part + operator;
                let counters = [part, operator, cell, 2 * cell + trial];
                let errors = (0..).zip(counters).zip(TRUTH);
                let value: f64 = errors
                    .map(|((purpose, counter), sd)| sd * draws.of(purpose).normal(counter))
                    .sum();
                let [part, operator, trial] =
                    [part, operator, trial].map(|label| label.to_string());
                study.add(&part, &operator, &trial, value).expect("finite");
            }
        }
    }
    study
}

#[test]
fn intervals_hold_the_truth_in_about_95_of_100_studies() {
    const STUDIES: u32 = 400;
    let [part, operator, interaction, repeat] = TRUTH.map(|sd| sd * sd);
    let gauge = operator + interaction + repeat;
    let truth = [
        (ComponentName::Repeatability, repeat),
        (ComponentName::Operator, operator),
        (ComponentName::Gauge, gauge),
        (ComponentName::Part, part),
        (ComponentName::Total, gauge + part),
    ];
    let mut held = [0; 7];
    for at in 0..STUDIES {
        let study = simulated(Draws::new(11).of(u64::from(at)));
        let report = study
            .analyse(&settings(|settings| settings.pool = 1.0))
            .expect("a report");
        let mut holds = |place: usize, [low, high]: [f64; 2], truth: f64| {
            held[place] += u32::from(low <= truth && truth <= high);
        };
        for (place, (name, variance)) in truth.iter().enumerate() {
            let found = report.component(*name).expect("a component");
            holds(place, found.ci95, variance.sqrt());
        }
        let of_gauge = report.component(ComponentName::Gauge).expect("a component");
        let share = 100.0 * (gauge / (gauge + part)).sqrt();
        holds(5, of_gauge.percent_study_ci95.expect("ends"), share);
        holds(
            6,
            report.ndc.ci95.expect("ends"),
            (2.0 * part / gauge).sqrt(),
        );
    }
    // Binomial standard deviation 4.4 of 400; generalized intervals are somewhat too wide.
    for (place, held) in held.into_iter().enumerate() {
        assert!((363..=398).contains(&held), "{place}: {held} of {STUDIES}");
    }
}
