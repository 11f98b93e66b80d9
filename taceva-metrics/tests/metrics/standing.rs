//! Standing of scores in verdicts.

use std::collections::BTreeMap;

use taceva_metrics::{
    Channel, Channels, Evaluation, Evaluator, Field, FieldSet, Flag, MetricPlan, Rows, Standing,
    Value, catalogue,
};

/// Scores of ten presses at each of eight points, with truths 0 to 0.08 N and one of 2 N. The constant 0 is within 0.05 N of six truths in ten.
fn evaluated(errors: [f64; 2], constant: Option<f64>) -> Evaluation {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let fields = FieldSet::PAIRS.with(Field::Point);
    let constants: BTreeMap<String, f64> = constant
        .map(|constant| ("Fz".to_owned(), constant))
        .into_iter()
        .collect();
    let plan = MetricPlan::new(&catalogue::ALL, channels, fields)
        .with_constants(constants)
        .expect("of its channel");
    let truth = (0..80).map(|row| match row % 10 {
        9 => 2.0,
        at => f64::from(at) / 100.0,
    });
    let truth: Vec<f64> = truth.collect();
    let error = |row: usize| errors[usize::from(row % 10 == row / 10)];
    let prediction: Vec<f64> = (0..80).map(|row| truth[row] + error(row)).collect();
    let points = (0..80).map(|row| (row / 10).to_string());
    let mut evaluator = Evaluator::new(&plan);
    let rows = Rows::new().pairs(Channel::FZ, &truth, &prediction);
    evaluator.update_rows(rows.points(points)).expect("80 rows");
    evaluator.finish().expect("scores")
}

/// Standing of `tolerance`, and the share reached by the constant.
fn tolerance(evaluation: &Evaluation) -> (Standing, Option<f64>) {
    let score = evaluation.score("tolerance", "Fz").expect("a score");
    let of_constant = score.variant("of_constant");
    let of_constant = of_constant.and_then(|variant| variant.value.scalar());
    (score.standing, of_constant)
}

#[test]
fn a_share_within_tolerance_counts_above_what_the_constant_reaches_and_not_below() {
    let near = evaluated([0.001, 0.06], Some(0.0));
    assert_eq!(tolerance(&near), (Standing::Counts, Some(0.6)));
    // Nine of ten errors exceed the tolerance. The constant meets more samples, although the model has a much smaller mean squared error.
    let far = evaluated([0.06, 0.001], Some(0.0));
    assert_eq!(tolerance(&far), (Standing::NotAboveConstant, Some(0.6)));
}

#[test]
fn without_a_constant_that_is_known_a_share_within_tolerance_has_the_standing_of_its_skill() {
    let evaluation = evaluated([0.001, 0.002], None);
    let skill = evaluation.score("skill", "Fz").expect("a score");
    assert!(matches!(skill.value, Value::Scalar(skill) if skill > 0.9));
    assert_eq!(tolerance(&evaluation), (Standing::Counts, None));
}

#[test]
fn what_a_constant_reaches_is_merged_with_that_of_the_same_constant_and_lost_beside_another() {
    let share = |constants: [f64; 2]| {
        let channels = Channels::new([Channel::FZ]).expect("one channel");
        let fields = FieldSet::PAIRS.with(Field::Point);
        let parts = constants.map(|constant| {
            let constants = [("Fz".to_owned(), constant)].into();
            let plan = MetricPlan::new(&catalogue::ALL, channels.clone(), fields);
            let plan = plan.with_constants(constants).expect("of its channel");
            let mut part = Evaluator::new(&plan);
            let points = (0..6).map(|row| row.to_string());
            let rows = Rows::new().pairs(Channel::FZ, [0.25; 6], [0.25; 6]);
            part.update_rows(rows.points(points)).expect("6 rows");
            part
        });
        let [mut one, mut other] = parts;
        one.merge_states(&other.states().expect("states"))
            .expect("of one plan");
        tolerance(&one.finish().expect("scores")).1
    };
    assert_eq!(share([0.25, 0.25]), Some(1.0));
    assert_eq!(share([0.0, 0.0]), Some(0.0));
    assert_eq!(share([0.25, 0.0]), None);
}

/// Scores of six presses at each of `points` points, with predictions within 1 % of a spread of 1 N.
fn of_points(points: usize) -> Evaluation {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let plan = MetricPlan::new(
        &catalogue::ALL,
        channels,
        FieldSet::PAIRS.with(Field::Point),
    );
    let truth: Vec<f64> = (0..6_u32)
        .flat_map(|press| (0..points).map(move |_| f64::from(press) / 6.0))
        .collect();
    let prediction: Vec<f64> = truth
        .iter()
        .enumerate()
        .map(|(row, truth)| truth + if row % 2 == 0 { 0.01 } else { -0.008 })
        .collect();
    let names = (0..truth.len()).map(|row| (row % points).to_string());
    let mut evaluator = Evaluator::new(&plan);
    let rows = Rows::new().pairs(Channel::FZ, &truth, &prediction);
    evaluator.update_rows(rows.points(names)).expect("rows");
    evaluator.finish().expect("scores")
}

#[test]
fn too_few_points_for_an_interval_are_no_verdict_that_there_is_no_skill() {
    let standing = |points, metric| {
        let evaluation = of_points(points);
        let score = evaluation.score(metric, "Fz").expect("a score");
        (score.standing, score.interval.ends().is_some())
    };
    for metric in ["mae", "r2", "skill"] {
        assert_eq!(
            standing(4, metric),
            (Standing::NoInterval, false),
            "{metric}"
        );
        assert_eq!(standing(8, metric), (Standing::Counts, true), "{metric}");
    }
    assert!(!Standing::NoInterval.takes_part());
}

#[test]
fn an_interval_without_width_is_flagged_as_no_certainty() {
    let flags = |errors: [f64; 2]| {
        let truth: Vec<f64> = (0..20).map(f64::from).collect();
        let errors = errors.into_iter().cycle();
        let prediction: Vec<f64> = truth
            .iter()
            .zip(errors)
            .map(|(truth, error)| truth + error)
            .collect();
        let points = (0..20).map(|row| (row / 2).to_string());
        let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one channel");
        let rows = Rows::new().pairs(Channel::FZ, &truth, &prediction);
        evaluator.update_rows(rows.points(points)).expect("rows");
        let evaluation = evaluator.finish().expect("scores");
        ["mae", "r2"].map(|metric| {
            let score = evaluation.score(metric, "Fz").expect("a score");
            let ends = score.interval.ends().expect("ten points");
            (score.flags.contains(&Flag::EqualClusters), ends)
        })
    };
    let [(is_flagged, ends), (of_r2, _)] = flags([0.25, 0.25]);
    assert!(is_flagged && !of_r2);
    assert_eq!(ends.map(f64::to_bits), [0.25_f64.to_bits(); 2]);
    // Two errors at each point: every mean error is the same again.
    let [(is_flagged, _), _] = flags([0.25, -0.5]);
    assert!(is_flagged);
}
