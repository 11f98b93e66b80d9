//! Division of recordings whose neighbouring samples resemble each other, and cross-validation.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::{
    Batch, Channel, Channels, Clock, Column, Labels, PressOutcome, Readings, Sample, SignalInfo,
    Signals, Stamp, Unit,
};
use taceva_dataset::{
    Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source,
};
use taceva_evaluate::{
    DataPart, EvaluateRequest, Evaluated, FitRequest, ModelChoice, Resemblance, evaluate,
    evaluate_plan,
};
use taceva_import::CsvTable;
use taceva_metrics::{Evaluator, Standing};
use taceva_models::{ModelSettings, Models};

use crate::taxel_drawing::Draws;
use crate::taxels::WORK;

/// Row of a synthetic recording.
pub(crate) struct Row {
    pub(crate) time_s: Option<f64>,
    pub(crate) force: f64,
    pub(crate) point: Option<String>,
    pub(crate) unit: Option<String>,
    pub(crate) values: Vec<f32>,
}

/// A recording of sixteen taxels and a force.
pub(crate) fn record(path: &Path, rows: impl IntoIterator<Item = Row>) -> Dataset {
    let info = SignalInfo::new(4, 4, 1, Unit::Microtesla).expect("sixteen");
    let facts = RecordingFacts::new(
        Source::Synthetic,
        Clock::Monotonic,
        SensorFacts::new("a drawn skin"),
    );
    let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"))
        .with_signals(SignalsSpec::new(info, ["p"]).expect("one name"));
    let mut recorder = Recorder::create(path, &spec).expect("new");
    let samples: Vec<Sample> = rows
        .into_iter()
        .enumerate()
        .map(|(at, row)| {
            let signals = Signals::new(info, row.values).expect("finite");
            let stamp = row.time_s.map(|valid_s| Stamp {
                valid_s,
                received_s: None,
            });
            Sample::new(format!("s{at:05}"))
                .with_truth(Readings::from_values([row.force]))
                .with_stamp(stamp)
                .with_point_id(row.point)
                .with_unit_id(row.unit)
                .with_signals(signals)
        })
        .collect();
    let recorded = recorder.append_press("press", PressOutcome::Complete, &samples);
    recorded.expect("recorded");
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

/// Force and taxels that are independent random walks at 50 Hz.
pub(crate) fn walks() -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/division/tax.csv");
    let table = CsvTable::read(&path).expect("there");
    let number = |row: usize, column: usize| {
        let number = table.number(row, column).expect("a number");
        number.expect("filled")
    };
    #[expect(clippy::cast_possible_truncation, reason = "signals are single")]
    let row = |row: usize| Row {
        time_s: Some(number(row, 0)),
        force: number(row, 1),
        point: None,
        unit: None,
        values: (2..18).map(|column| number(row, column) as f32).collect(),
    };
    (0..table.rows()).map(row).collect()
}

/// `count` presses of independent forces; the taxels sense the force with some noise.
pub(crate) fn presses(count: usize) -> Vec<Row> {
    let mut draws = Draws(5);
    let mut row = |_| {
        let force = 5.0 + 5.0 * draws.next();
        #[expect(clippy::cast_possible_truncation, reason = "signals are single")]
        let values = (1..17_u8).map(|place| (f64::from(place) * force + draws.next()) as f32);
        Row {
            time_s: None,
            force,
            point: None,
            unit: None,
            values: values.collect(),
        }
    };
    (0..count).map(&mut row).collect()
}

pub(crate) fn request(model: &str, split: Option<&str>) -> EvaluateRequest {
    EvaluateRequest {
        model: ModelChoice::Fit(FitRequest {
            model: Models::builtin().find(model).expect("a model"),
            settings: ModelSettings::parse([]).expect("none"),
            channels: Vec::new(),
            split: split.map(str::to_owned),
            seed: 0,
        }),
        metrics: vec!["r2".to_owned(), "mae".to_owned()],
        part: None,
        sensor: None,
        is_independent: false,
    }
}

pub(crate) fn evaluated(dataset: &Dataset, model: &str, split: Option<&str>) -> Evaluated {
    evaluate(dataset, &request(model, split), WORK).expect("evaluated")
}

pub(crate) fn r2(evaluated: &Evaluated) -> f64 {
    let score = evaluated.report.score("r2", "Fz").expect("scored");
    score.value.number().expect("defined")
}

pub(crate) fn method(evaluated: &Evaluated) -> String {
    let score = evaluated.report.score("mae", "Fz").expect("scored");
    format!("{:?}", score.interval)
}

pub(crate) fn said(evaluated: &Evaluated) -> String {
    evaluated.report.provenance.notes.join("\n")
}

#[test]
fn a_stream_without_points_is_divided_by_blocks_of_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), walks());
    let found = evaluated(&dataset, "knn", None);
    let split = found.report.provenance.split.as_deref().expect("divided");
    assert!(split.ends_with("by-block"), "{split}");
    // scikit-learn: 0.244 by blocks of 90 frames, 0.963 at random.
    assert!(r2(&found) < 0.6, "{}", r2(&found));
    let neighbours = found.report.provenance.neighbours.clone();
    let neighbours = neighbours.expect("said");
    assert!(
        neighbours.contains("blocks of time stay together"),
        "{neighbours}"
    );
    assert!(said(&found).starts_with(&neighbours), "{}", said(&found));
    assert!(method(&found).contains("by group"), "{}", method(&found));
}

#[test]
fn points_of_one_row_each_in_a_stream_are_no_reason_to_divide_at_random() {
    let folder = tempfile::tempdir().expect("a folder");
    let named = walks().into_iter().map(|row| Row {
        point: Some(format!("{:?}", row.time_s)),
        ..row
    });
    let dataset = record(&folder.path().join("data"), named);
    let found = evaluated(&dataset, "knn", None);
    assert!(r2(&found) < 0.6, "{}", r2(&found));
    for split in ["random", "by-point", "cv:5 random"] {
        let random = evaluated(&dataset, "knn", Some(split));
        assert!(r2(&random) > 0.9, "{split}: {}", r2(&random));
        assert!(
            said(&random).contains("the scores are optimistic"),
            "{split}: {}",
            said(&random)
        );
        let score = random.report.score("r2", "Fz").expect("scored");
        assert!(
            score.standing >= Standing::Neighbours,
            "{split}: {:?}",
            score.standing
        );
    }
}

#[test]
fn streams_without_times_or_in_shuffled_order_are_found_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let untimed = walks().into_iter().map(|row| Row {
        time_s: None,
        ..row
    });
    let dataset = record(&folder.path().join("untimed"), untimed);
    let rows = dataset.all_rows();
    assert!(matches!(
        Resemblance::of(&dataset, &rows),
        Resemblance::Alike(_)
    ));
    let mut shuffled = walks();
    let mut draws = Draws(9);
    shuffled.sort_by_cached_key(|_| draws.next().to_bits());
    let dataset = record(&folder.path().join("shuffled"), shuffled);
    assert!(matches!(
        Resemblance::of(&dataset, &rows),
        Resemblance::Alike(_)
    ));
    assert!(r2(&evaluated(&dataset, "knn", None)) < 0.6);
}

#[test]
fn independent_presses_are_points_of_their_own_and_have_intervals() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), presses(120));
    let rows = dataset.all_rows();
    assert_eq!(Resemblance::of(&dataset, &rows), Resemblance::Apart);
    let found = evaluated(&dataset, "ridge", None);
    assert!(
        method(&found).contains("samples taken as independent"),
        "{}",
        method(&found)
    );
    let once = said(&found).matches("counts as one contact point").count();
    assert_eq!(once, 1, "{}", said(&found));
    assert!(said(&found).contains("names no places"), "{}", said(&found));
    assert_eq!(found.report.provenance.neighbours, None);
}

#[test]
fn presses_are_independent_in_every_split_that_makes_no_groups() {
    let folder = tempfile::tempdir().expect("a folder");
    let parts = presses(120).into_iter().zip(0_u8..).map(|(row, at)| Row {
        time_s: Some(3.0 * f64::from(at)),
        unit: Some(if at < 90 { "train" } else { "test" }.to_owned()),
        ..row
    });
    let dataset = record(&folder.path().join("data"), parts);
    for split in [
        "random",
        "chronological",
        "by-column:unit_id=train:train;test:test",
    ] {
        let found = method(&evaluated(&dataset, "ridge", Some(split)));
        assert!(
            found.contains("samples taken as independent"),
            "{split}: {found}"
        );
    }
}

#[test]
fn independent_samples_are_grouped_by_their_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), presses(120));
    let found = evaluated(&dataset, "ridge", None);
    let samples = found.report.samples.as_ref().expect("samples");
    let force = samples.channel("Fz").expect("there");
    let rows = || 0..samples.rows();
    let truth: Column = rows().map(|row| force.truth(row)).collect();
    let prediction: Column = rows().map(|row| force.prediction(row)).collect();
    let mut names = Labels::default();
    rows().for_each(|row| names.push(samples.word("sample", row).expect("a name")));
    let channels = Channels::new([Channel::FZ]).expect("one");
    let batch = Batch::from_columns(channels, vec![truth], vec![prediction], None);
    let mut evaluator = Evaluator::of_channels([Channel::FZ]).expect("one");
    evaluator = evaluator.independent_samples();
    let updated = evaluator.update(&batch.with_samples(names));
    updated.expect("one channel");
    let named = evaluator.finish().expect("scores");
    let named = named.mae(Channel::FZ).expect("scored");
    let score = found.report.score("mae", "Fz").expect("scored");
    let interval = score.interval.as_ref().expect("an interval");
    assert_eq!(interval.ends(), named.interval.ends());
    let model = found.report.provenance.model.as_ref().expect("a model");
    let chosen = model.chosen_by.as_deref();
    assert_eq!(chosen, Some("strength on the validation part"));
}

#[test]
fn each_sample_is_predicted_once_by_a_model_that_has_not_seen_its_group() {
    let folder = tempfile::tempdir().expect("a folder");
    let grouped = presses(120).into_iter().enumerate().map(|(at, row)| Row {
        point: Some(format!("p{}", at / 4)),
        unit: Some(format!("u{}", at / 20)),
        ..row
    });
    let dataset = record(&folder.path().join("data"), grouped);
    for (split, expected) in [
        (None, "cv:5 by-point"),
        (Some("cv:3"), "cv:3 by-point"),
        (Some("cv:4 by-column:unit_id"), "cv:4 by-column:unit_id"),
        (Some("loo by-column:unit_id"), "loo by-column:unit_id"),
        (Some("cv:10 random"), "cv:10 random"),
    ] {
        let found = evaluated(&dataset, "ridge", split);
        assert_eq!(found.report.provenance.split.as_deref(), Some(expected));
        let samples = found.report.samples.as_ref().expect("samples");
        assert_eq!(samples.rows(), 120);
        let force = samples.channel("Fz").expect("there");
        assert!(
            (0..120).all(|row| force.prediction(row).is_some()),
            "{expected}"
        );
        let mut seen = BTreeMap::new();
        for row in 0..120 {
            *seen.entry(samples.word("sample", row)).or_insert(0) += 1;
        }
        assert!(seen.values().all(|count| *count == 1), "{expected}");
        assert!(r2(&found) > 0.99, "{expected}: {}", r2(&found));
    }
    // The same seed gives the same bits.
    let [one, other] = [(); 2].map(|()| evaluated(&dataset, "ridge", Some("cv:5")));
    assert_eq!(one.report, other.report);
}

#[test]
fn fewer_groups_than_folds_and_parts_of_folds_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let grouped = presses(60).into_iter().enumerate().map(|(at, row)| Row {
        unit: Some(format!("u{}", at / 20)),
        ..row
    });
    let dataset = record(&folder.path().join("data"), grouped);
    let refused = |split: &str, part: Option<DataPart>| {
        let request = EvaluateRequest {
            part,
            ..request("ridge", Some(split))
        };
        let error = evaluate(&dataset, &request, WORK)
            .expect_err("refused")
            .to_string();
        let planned = evaluate_plan(&dataset, &request).expect_err("refused");
        assert_eq!(error, planned.to_string());
        error
    };
    let few = refused("cv:5 by-column:unit_id", None);
    assert!(
        few.contains("5 folds, but the recording has 3 groups"),
        "{few}"
    );
    let part = refused("cv:3 by-column:unit_id", Some(DataPart::Test));
    assert!(part.contains("scores every sample"), "{part}");
    let points = refused("cv:3 by-point", None);
    assert!(points.contains("names no `point_id`"), "{points}");
    assert!(points.contains("under [ids] of the map"), "{points}");
    for split in ["cv:3 by-column:clip", "by-column:clip"] {
        let column = refused(split, None);
        assert!(
            column.contains("no column `clip`, expected one of"),
            "{column}"
        );
        assert!(column.contains("unit_id"), "{column}");
    }
    let near = refused("by-column:unit_ld", None);
    assert!(near.contains("did you mean `unit_id`?"), "{near}");
    assert!(refused("random 35/20/10", None).contains("adds up to 65"));
    // A part belongs to one division, which is then the default.
    let request = EvaluateRequest {
        part: Some(DataPart::Test),
        ..request("ridge", None)
    };
    let found = evaluate(&dataset, &request, WORK).expect("evaluated");
    assert_eq!(
        found.report.provenance.split.as_deref(),
        Some("random 70/20/10")
    );
}

#[test]
fn a_fold_of_all_samples_of_a_class_is_scored_as_any_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let classes = presses(60).into_iter().enumerate().map(|(at, row)| Row {
        force: f64::from(u32::from(at >= 40)),
        unit: Some(format!("u{}", at / 20)),
        ..row
    });
    let dataset = record(&folder.path().join("data"), classes);
    let found = evaluated(&dataset, "ridge", Some("loo by-column:unit_id"));
    let samples = found.report.samples.as_ref().expect("samples");
    assert_eq!(samples.rows(), 60);
}

#[test]
fn a_gap_stands_between_blocks_that_are_learnt_from_and_tested_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), walks());
    let found = evaluated(&dataset, "baseline", Some("by-block 70/10/20"));
    let manifest = found.manifest;
    assert!(manifest.is_none_or(|manifest| manifest.counts.left_out > 0));
    let counts = &found.report.provenance.samples;
    assert!(counts["left_out"] > 0, "{counts:?}");
    assert!(counts["test"] >= 90, "{counts:?}");
}
