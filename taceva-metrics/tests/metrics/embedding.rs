//! Guarantees for programs that embed the crate.

use taceva_metrics::{
    Batch, Channel, Channels, Column, Evaluation, Evaluator, FieldSet, InapplicableReason, Labels,
    MetricPlan, Readings, Rows, Sample, SampleSink, UndefinedReason, Unit, Value, catalogue,
};

/// 100 distinct predictions and their truths.
fn drawn() -> (Vec<f64>, Vec<f64>) {
    let truth: Vec<f64> = (0..100).map(|row| f64::from(row) / 10.0).collect();
    let error = |row: u32| f64::from(row * 37 % 101) / 1000.0;
    let prediction = truth.iter().zip(0..).map(|(y, row)| y + error(row));
    let prediction = prediction.collect();
    (truth, prediction)
}

fn said(scores: &Evaluation) -> Vec<String> {
    let scores = scores.scores();
    scores
        .map(|(metric, of, score)| format!("{} {of} {score:?}", metric.id))
        .collect()
}

fn evaluator() -> Evaluator {
    Evaluator::of_channels([Channel::FX, Channel::FZ]).expect("two channels")
}

#[test]
fn a_running_score_is_that_of_the_samples_so_far_and_changes_nothing() {
    let channels = Channels::new([Channel::FZ]).expect("one channel");
    let plan = MetricPlan::new(&catalogue::ALL, channels, FieldSet::PAIRS);
    let (truth, prediction) = drawn();
    let mut asked = Evaluator::new(&plan);
    for row in 0..truth.len() {
        let sample = Sample::default()
            .with_point_id(format!("{}", row / 10))
            .with_truth(Readings::from_values([truth[row]]))
            .with_prediction(Readings::from_values([prediction[row]]));
        asked.accept(&sample).expect("one channel");
        if row == 59 {
            let rows = Rows::new().pairs(Channel::FZ, &truth[..60], &prediction[..60]);
            let mut alone = Evaluator::new(&plan);
            let points = (0..60).map(|row| format!("{}", row / 10));
            alone.update_rows(rows.points(points)).expect("60 rows");
            let running = asked.score().expect("a score");
            assert_eq!(said(&running), said(&alone.finish().expect("a score")));
        }
    }
    let running = said(&asked.score().expect("a score"));
    assert_eq!(running, said(&asked.finish().expect("a score")));
}

#[test]
fn samples_taken_as_independent_give_the_same_in_any_order_and_split() {
    let (truth, prediction) = drawn();
    let mut whole = evaluator().independent_samples();
    whole
        .update_pairs(Channel::FZ, &truth, &prediction)
        .expect("as many");
    let mut back = evaluator().independent_samples();
    let mut front = evaluator().independent_samples();
    front
        .update_pairs(Channel::FZ, &truth[..30], &prediction[..30])
        .expect("as many");
    let (truth, prediction) = (truth[30..].iter().rev(), prediction[30..].iter().rev());
    back.update_pairs(Channel::FZ, truth, prediction)
        .expect("as many");
    back.merge(front).expect("one plan");
    let [whole, parts] = [whole, back].map(|evaluator| evaluator.finish().expect("a score"));
    assert_eq!(said(&whole), said(&parts));
    let method = whole
        .mae(Channel::FZ)
        .and_then(|mae| mae.interval.method())
        .expect("an interval");
    let expected = "jackknife, samples taken as independent, G=";
    assert!(method.starts_with(expected), "{method}");
}

#[test]
fn the_interval_of_named_samples_depends_on_no_other_channel() {
    let (truth, prediction) = drawn();
    let column = |values: &[f64]| Column::full(values.to_vec());
    let score = |channels: Vec<Channel>| {
        let mut evaluator = Evaluator::of_channels(channels.clone()).expect("channels");
        evaluator = evaluator.independent_samples();
        let mut names = Labels::default();
        (0..truth.len()).for_each(|row| names.push(&format!("press {row}")));
        let columns = |values: &[f64]| vec![column(values); channels.len()];
        let (truth, prediction) = (columns(&truth), columns(&prediction));
        let channels = Channels::new(channels).expect("channels");
        let batch = Batch::from_columns(channels, truth, prediction, None);
        let updated = evaluator.update(&batch.with_samples(names));
        updated.expect("its channels");
        let scores = evaluator.finish().expect("scores");
        format!("{:?}", scores.mae(Channel::FZ).expect("scored"))
    };
    let alone = score(vec![Channel::FZ]);
    assert!(alone.contains("Jackknife"), "{alone}");
    assert_eq!(alone, score(vec![Channel::PZ, Channel::FZ]));
}

#[test]
fn many_pairs_are_summed_block_by_block_to_the_same_bits() {
    let truth: Vec<f64> = (0..10_000_u32)
        .map(|row| f64::from(row * 7919 % 10_007) / 1e3)
        .collect();
    let prediction: Vec<f64> = truth.iter().map(|y| y + y.sin() / 10.0).collect();
    let of = |update: &dyn Fn(&mut Evaluator)| {
        let mut evaluator = evaluator();
        update(&mut evaluator);
        said(&evaluator.finish().expect("scores"))
    };
    let at_once = of(&|evaluator| {
        let rows = Rows::new().pairs(Channel::FZ, &truth, &prediction);
        evaluator.update_rows(rows).expect("as many");
    });
    let in_blocks = of(&|evaluator| {
        let updated = evaluator.update_pairs(Channel::FZ, &truth, &prediction);
        updated.expect("as many");
    });
    // The length of a filtered iterator is unknown.
    let of_unknown_length = of(&|evaluator| {
        let (some, others) = (
            truth.iter().filter(|_| true),
            prediction.iter().filter(|_| true),
        );
        let updated = evaluator.update_pairs(Channel::FZ, some, others);
        updated.expect("as many");
    });
    assert_eq!(in_blocks, at_once);
    assert_eq!(of_unknown_length, at_once);
    let mut evaluator = evaluator();
    for channel in [Channel::FZ, Channel::PX] {
        let short = if channel == Channel::FZ {
            9_999
        } else {
            10_000
        };
        let refused = evaluator.update_pairs(channel, &truth, &prediction[..short]);
        refused.expect_err("one is missing, and no such channel");
    }
    assert_eq!(said(&evaluator.finish().expect("scores")), of(&|_| {}));
}

#[test]
fn samples_taken_as_independent_merge_with_no_others() {
    let mut by_sample = evaluator().independent_samples();
    let by_point = evaluator();
    assert!(by_sample.merge(by_point).is_err());
}

#[test]
fn the_mean_of_independent_samples_has_the_textbook_interval() {
    // Errors −1, −2, −3, −4, −5: bias −3, standard error √(2.5 / 5).
    let mut evaluator = evaluator().independent_samples();
    evaluator
        .update_pairs(Channel::FZ, [0.0; 5], (1..=5_u8).map(f64::from))
        .expect("as many");
    let scores = evaluator.finish().expect("a score");
    let bias = scores.bias(Channel::FZ).expect("it is kept");
    let [low, high] = bias.interval.ends().expect("five samples");
    let half = 2.776_445_105 * 0.5_f64.sqrt();
    assert!((low + 3.0 + half).abs() < 1e-8 && (high + 3.0 - half).abs() < 1e-8);
}

#[test]
fn rows_that_do_not_fit_are_refused_and_nothing_is_taken_in() {
    let mut evaluator = evaluator();
    let refused = [
        Rows::new().pairs(Channel::FZ, [0.0, 1.0], [0.0]),
        Rows::new()
            .pairs(Channel::FX, [0.0], [0.0])
            .pairs(Channel::FZ, [0.0, 1.0], [0.0, 1.0]),
        Rows::new()
            .pairs(Channel::FZ, [0.0], [0.0])
            .points(["a", "b"]),
        Rows::new().pairs(Channel::PX, [0.0], [0.0]),
        Rows::new()
            .pairs(Channel::FZ, [0.0], [0.0])
            .pairs(Channel::FZ, [0.0], [0.0]),
    ];
    let errors = refused.map(|rows| {
        let error = evaluator.update_rows(rows);
        error.expect_err("it does not fit").to_string()
    });
    assert_eq!(
        errors,
        [
            "1 estimates and 2 references, expected equal numbers",
            "2 rows of `Fz`, expected 1 as in the first channel",
            "2 rows of contact points, expected 1 as in the first channel",
            "channels Px [mm], expected Fx [N], Fz [N]",
            "channels Fz [N] twice, expected Fx [N], Fz [N]",
        ]
    );
    let scores = evaluator.finish().expect("a score");
    assert_eq!(scores.mae(Channel::FZ).map(|mae| mae.n), Some(0));
}

#[test]
fn a_value_that_is_no_number_is_counted_and_an_absent_one_is_not_there() {
    let mut evaluator = evaluator();
    let truth = [Some(1.0), Some(f64::NAN), None];
    evaluator
        .update_pairs(Channel::FZ, truth, [1.0_f32; 3])
        .expect("as many");
    let scores = evaluator.finish().expect("a score");
    let counted = |channel| scores.mae(channel).map(|mae| (mae.n, mae.n_invalid));
    assert_eq!(counted(Channel::FZ), Some((1, 1)));
    assert_eq!(counted(Channel::FX), Some((0, 0)));
}

#[test]
fn three_pairs_print_in_three_lines_and_every_score_by_the_alternate_form() {
    let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one channel");
    let (truth, prediction) = ([0.25, 0.50, 1.00], [0.50, 0.50, 0.75]);
    evaluator
        .update_pairs(Channel::FZ, truth, prediction)
        .expect("as many");
    let scores = evaluator.finish().expect("scores");
    let short = scores.to_string();
    let lines: Vec<&str> = short.lines().collect();
    assert_eq!(lines.len(), 3, "{short}");
    let cells = |line: &str| -> Vec<String> {
        let cells = line.split("  ").map(str::trim);
        let filled = cells.filter(|cell| !cell.is_empty());
        filled.map(str::to_owned).collect()
    };
    let headings = [
        "channel",
        "mae ↓",
        "rmse ↓",
        "bias →0",
        "r2 ↑",
        "skill ↑",
        "n",
    ];
    assert_eq!(cells(lines[0]), headings);
    let line = cells(lines[1]);
    let values = ["Fz", "0.1667 N", "0.2041 N", "0.000 N", "0.5714"];
    assert_eq!(line[..5], values);
    assert_eq!(line.last().map(String::as_str), Some("3"));
    let long = format!("{scores:#}");
    assert!(long.lines().count() > 10, "{long}");
    assert!(
        long.contains("95% interval") && long.contains("smape"),
        "{long}"
    );
}

#[test]
fn a_value_prints_to_four_digits_or_to_the_decimals_of_a_precision() {
    let third = Value::Scalar(1.0 / 3.0);
    assert_eq!(third.to_string(), "0.3333");
    assert_eq!(format!("{third:.1}"), "0.3");
    assert_eq!(format!("{third:>8}|"), "  0.3333|");
    let empty = Value::Undefined(UndefinedReason::Empty);
    assert_eq!(empty.to_string(), "undefined: empty");
}

#[test]
fn a_value_in_words_fills_its_column_and_no_precision_cuts_it() {
    let empty = Value::Undefined(UndefinedReason::Empty);
    assert_eq!(format!("{empty:>24}|"), "        undefined: empty|");
    assert_eq!(format!("{empty:24}|"), "undefined: empty        |");
    assert_eq!(format!("{empty:.^19.2}|"), ".undefined: empty..|");
    assert_eq!(format!("{empty:>9.1}|"), "undefined: empty|");
    let absent = Value::NotApplicable(InapplicableReason::NotOneNumber);
    assert_eq!(
        format!("{absent:>45}|"),
        "  not applicable: many numbers instead of one|"
    );
}

#[test]
fn a_channel_and_its_array_are_used_again_after_they_were_given_away() {
    let channels = [
        Channel::FZ,
        Channel::named("Rz", Unit::Degree).expect("a name"),
    ];
    let mut evaluator = Evaluator::of_channels(channels).expect("two channels");
    for channel in channels {
        let (truth, prediction) = ([1.0, 2.0], [1.5, 2.5]);
        evaluator
            .update_pairs(channel, truth, prediction)
            .expect("as many");
        let scores = evaluator.score().expect("scores");
        assert_eq!(
            scores.mae(channel).and_then(|mae| mae.value.scalar()),
            Some(0.5)
        );
    }
}
