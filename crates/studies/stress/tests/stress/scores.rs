//! Tests of the scores of models on recordings with faults.

use std::num::NonZeroUsize;

use taceva_core::{Channel, Channels, Clock, PixelFormat, Readings, Sample, counted};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_evaluate::{EvaluateRequest, ModelChoice, Work, evaluate};
use taceva_stress::{
    By, ByChannel, Estimate, FaultReport, NEVER, StressReport, StressRequest, Undefined, Unnoticed,
    stress, stress_plan,
};

use crate::drawing::{
    HEIGHT, PRESSES, WIDTH, WORK, fitted, picture, press, record, record_with, unseen,
};

fn by_parameter(faults: &[&str]) -> StressRequest {
    StressRequest {
        faults: faults.iter().map(|name| (*name).to_owned()).collect(),
        by: By::Parameter,
        ..StressRequest::default()
    }
}

fn fault<'r>(report: &'r StressReport, id: &str) -> &'r FaultReport {
    let mut faults = report.faults.iter();
    faults.find(|fault| fault.id == id).expect("tested")
}

#[test]
fn a_fault_that_changes_no_pixel_has_a_degradation_of_exactly_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    // 0.3 % of 24 pixels: the weight of a neighbour is below the last place of a number.
    let report = stress(&dataset, &model, &by_parameter(&["defocus"]), WORK).expect("tested");
    let first = &fault(&report, "defocus").severities[0];
    assert_eq!(first.stimulus, Some(0.0));
    for score in first.stale.values() {
        assert_eq!(score.degradation.value, Some(1.0));
        assert_eq!(score.degradation.ci95, Some([1.0, 1.0]));
    }
}

#[test]
fn several_draws_of_places_have_their_mean_and_their_spread() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let of_draws = |draws: u32| {
        let request = StressRequest {
            severities: vec![3],
            draws,
            ..by_parameter(&["exposure_low", "tear"])
        };
        stress(&dataset, &model, &request, WORK).expect("tested")
    };
    let (one, four) = (of_draws(1), of_draws(4));
    assert_eq!((one.draws, four.draws), (1, 4));
    assert_ne!(one.list.digest, four.list.digest);
    // Lost light has no places.
    let dark = |report: &StressReport| fault(report, "exposure_low").severities[0].stale.clone();
    assert_eq!(dark(&one), dark(&four));
    let torn = |report: &StressReport| fault(report, "tear").severities[0].clone();
    let (single, several) = (torn(&one), torn(&four));
    assert_ne!(single.stimulus, several.stimulus);
    for (channel, score) in &several.stale {
        let [least, most] = score.spread.expect("four draws");
        let mean = score.degradation.value.expect("a ratio");
        assert!(least < mean && mean < most, "{channel}: {score:?}");
        let first = &single.stale[channel];
        assert_eq!(first.spread, None);
        let first = first.degradation.value.expect("a ratio");
        let tolerance = 1e-9 * first;
        assert!(
            (least - tolerance..=most + tolerance).contains(&first),
            "{channel}: the first draw is one of them"
        );
        assert!(score.mae.value.expect("a mean") > 0.0);
    }
    let said = four.notes.join(" ");
    assert!(
        said.contains("tear: means over 4 draws of places"),
        "{said}"
    );
}

#[test]
fn a_constant_model_breaks_at_the_first_severity_of_every_fault_and_never_degrades() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), 1);
    let model = fitted(&seen, "baseline", &["size=8x8"]);
    let dataset = record(&folder.path().join("unseen"), 2);
    let report = stress(&dataset, &model, &by_parameter(&["gel-12"]), WORK).expect("tested");
    assert_eq!(report.list.name, "gel-12/1");
    for fault in &report.faults {
        assert!(
            fault.breaks_at.values().all(|at| *at == Some(1)),
            "{fault:?}"
        );
        assert!(
            report
                .clean
                .values()
                .all(|of| of.skill.is_above_zero() == Some(false))
        );
        assert!(fault.mean.values().all(|mean| mean.value == Some(1.0)));
        let mut shares = fault.recovers.values();
        assert!(shares.all(|of| of.reason == Some(Undefined::NoFreshReference)));
    }
}

#[test]
fn errors_without_a_fault_are_those_of_an_evaluation() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let report = stress(&dataset, &model, &by_parameter(&["dust"]), WORK).expect("tested");
    let request = EvaluateRequest {
        model: ModelChoice::Fitted(Box::new(model)),
        metrics: vec!["mae".to_owned()],
        part: None,
        sensor: None,
        is_independent: false,
    };
    let evaluated = evaluate(&dataset, &request, WORK)
        .expect("evaluated")
        .report;
    for (channel, clean) in &report.clean {
        let mut scores = evaluated.scores.iter();
        let mae = scores.find(|of| of.metric == "mae" && of.channel == *channel);
        let expected = mae.and_then(|of| of.value.number()).expect("a score");
        let found = clean.mae.value.expect("a score");
        assert!(
            (found / expected - 1.0).abs() < 0.05,
            "{channel}: {found} {expected}"
        );
    }
    assert!(report.clean["Fz"].skill.value.expect("a score") > 0.5);
}

#[test]
fn metrics_on_request_stand_in_every_cell_and_change_no_other_number() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let plain = StressRequest {
        severities: vec![1, 4],
        draws: 3,
        ..by_parameter(&["exposure_low", "tear"])
    };
    let asked = StressRequest {
        metrics: ["rmse", "mae", "r2"].map(str::to_owned).to_vec(),
        ..plain.clone()
    };
    let tested = |request: &StressRequest| stress(&dataset, &model, request, WORK).expect("tested");
    let mut report = tested(&asked);
    let check = |metrics: &ByChannel<Estimate>, mae: Estimate| {
        let names: Vec<&String> = metrics.keys().collect();
        assert_eq!(names, ["r2", "rmse"]);
        let value = |name: &str| metrics[name].value.expect("a score");
        // The variance of the forces, twelve of each of 0.4, 0.8, 1.2, 1.6 and 2.0 N, is 0.32.
        let unexplained = 0.32 * (1.0 - value("r2"));
        let ratio = unexplained / (value("rmse") * value("rmse"));
        assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
        assert!(value("rmse") >= mae.value.expect("a score"));
    };
    check(&report.clean["Fz"].metrics, report.clean["Fz"].mae);
    for of in report.faults.iter().flat_map(|fault| &fault.severities) {
        for side in [Some(&of.stale), of.fresh.as_ref()].into_iter().flatten() {
            check(&side["Fz"].metrics, side["Fz"].mae);
        }
    }
    let clean = report.clean.values_mut();
    clean.for_each(|score| score.metrics.clear());
    let faults = report.faults.iter_mut();
    for of in faults.flat_map(|fault| &mut fault.severities) {
        let fresh = of.fresh.iter_mut().flatten();
        let both = of.stale.iter_mut().chain(fresh);
        both.for_each(|(_, score)| score.metrics.clear());
    }
    let text = |report: &StressReport| serde_json::to_string(report).expect("JSON");
    assert_eq!(text(&report), text(&tested(&plain)));
}

#[test]
fn a_metric_of_planes_has_a_note_where_no_plane_is_scored() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        metrics: ["mae_euclid", "bias"].map(str::to_owned).to_vec(),
        ..by_parameter(&["dust"])
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    let notes = report.notes.join(" ");
    let note = "No scored channel or plane has mae_euclid.";
    assert!(notes.contains(note), "{notes}");
}

#[test]
fn a_new_untouched_picture_removes_most_of_the_error_of_lost_light() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        severities: vec![3, 4, 5],
        ..by_parameter(&["exposure_low", "sensor_noise"])
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    let dark = fault(&report, "exposure_low");
    let third = &dark.severities[0];
    let ratio = |of: &taceva_stress::CellScore| of.degradation.value.expect("a ratio");
    let fresh = third.fresh.as_ref().expect("the model reads differences");
    assert!(ratio(&third.stale["Fz"]) > 2.0, "{third:?}");
    assert!(ratio(&fresh["Fz"]) < ratio(&third.stale["Fz"]), "{third:?}");
    assert!(dark.recovers["Fz"].value.expect("a share") > 0.1);
    assert!(third.check.contains(&"TAC034"), "{third:?}");
    // Noise is drawn for each picture, so no untouched picture has it too.
    let noise = fault(&report, "sensor_noise");
    assert!(noise.severities.iter().all(|of| of.fresh.is_none()));
    let reason = noise.recovers["Fz"].reason;
    assert_eq!(reason, Some(Undefined::NoFreshReference));
    let unnoticed = report.unnoticed.as_ref().expect("there is a reference");
    let is_dark = |of: &Unnoticed| of.fault == "exposure_low";
    assert!(!unnoticed.iter().any(is_dark), "{unnoticed:?}");
    for of in &report.faults {
        for tested in &of.severities {
            for (channel, score) in &tested.stale {
                let is_named = |found: &Unnoticed| {
                    found.fault == of.id
                        && found.severity == tested.severity
                        && found.channel == *channel
                };
                let expected = ratio(score) >= 2.0 && tested.check.is_empty();
                assert_eq!(unnoticed.iter().any(is_named), expected, "{tested:?}");
            }
        }
    }
}

#[test]
fn a_note_names_the_faults_whose_places_are_one_draw() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = |faults: &[&str]| StressRequest {
        severities: vec![1],
        seed: 7,
        ..by_parameter(faults)
    };
    let wanted = request(&["exposure_low", "sensor_noise", "tear", "dust"]);
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let expected = "tear, dust: one draw of places, by seed 7;";
    assert!(report.notes[0].starts_with(expected), "{:?}", report.notes);
    let wanted = request(&["exposure_low", "sensor_noise"]);
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}

#[test]
fn a_note_counts_clusters_that_are_too_few_for_intervals() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), 1);
    // The test part has two of the twelve points.
    let model = fitted(&seen, "ridge", &["size=8x8"]);
    let report = stress(&seen, &model, &by_parameter(&["defocus"]), WORK).expect("tested");
    let clusters = report.samples / 5;
    assert!(clusters < 5, "{clusters}");
    let expected = format!(
        "No intervals: {}, 5 are needed",
        counted(clusters, "cluster")
    );
    assert!(report.notes[0].starts_with(&expected), "{:?}", report.notes);
    let mean = &report.faults[0].mean["Fz"];
    assert_eq!(mean.reason, Some(Undefined::TooFewClusters));
}

#[test]
fn a_note_counts_the_samples_with_a_label_where_others_have_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
    let path = folder.path().join("partial");
    let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, channels)).expect("new");
    let reference = press(0.0, 0.0, 903);
    recorder.append_reference(&reference).expect("recorded");
    for number in 0..6_u32 {
        let force = 0.4 + 0.3 * f64::from(number);
        let labels = vec![Some(2.0 + force), (number < 2).then_some(force)];
        let sample = Sample::new(format!("s{number}"))
            .with_point_id(format!("p{number}"))
            .with_frame(press(force, 4.0 + 2.0 * force, 10 * number + 3))
            .with_truth(Readings::new(labels));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let report = stress(&dataset, &model, &by_parameter(&["exposure_low"]), WORK).expect("tested");
    let expected = "Not every sample has a label; scored samples: Fz 2 of 6.";
    let last = report.notes.last().map(String::as_str);
    assert_eq!(last, Some(expected), "{:?}", report.notes);
}

#[test]
fn a_fault_of_all_pictures_does_not_count_as_contact_that_hides_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = unseen(folder.path());
    let draw = |force: f64, place: f64, _: u32| {
        picture([WIDTH, HEIGHT], PixelFormat::Gray8, |x, y| {
            let (across, down) = (f64::from(x) - place, f64::from(y) - 8.0);
            0.45 + 0.2 * force * (-(across * across + down * down) / 12.0).exp()
        })
    };
    let rest = draw(0.0, 0.0, 0);
    let dataset = record_with(&folder.path().join("bright"), Some(rest), draw);
    let request = StressRequest {
        severities: vec![1],
        ..by_parameter(&["exposure_low"])
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    // The loss is 0.012 of full scale. A third of the change by contact is 0.011, or 0.015 if the loss counted as contact.
    assert_eq!(report.faults[0].severities[0].check, ["TAC034"]);
}

#[test]
fn errors_grow_until_no_skill_is_left_and_capped_ones_stay_below_the_constant() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let report = stress(&dataset, &model, &by_parameter(&["exposure_low"]), WORK).expect("tested");
    let dark = fault(&report, "exposure_low");
    let broken = dark.breaks_at["Fz"].expect("known");
    assert!((1..NEVER).contains(&broken), "{broken}");
    let constant = report.clean["Fz"].constant.expect("known");
    for of in &dark.severities {
        let score = &of.stale["Fz"];
        let capped = score.capped.expect("known");
        assert!(capped <= constant && Some(capped) <= score.mae.value);
        let [low, high] = score.degradation.ci95.expect("twelve points");
        let value = score.degradation.value.expect("a ratio");
        assert!(low <= value && value <= high);
    }
    let mean = dark.mean["Fz"].value.expect("a mean");
    assert!(mean > 1.0 && report.mean["Fz"].value == Some(mean));
}

#[test]
fn pictures_are_decoded_once_for_all_cells_and_jobs_change_no_byte() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = StressRequest {
        severities: vec![2, 3],
        ..StressRequest::default()
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    let decoded = report.provenance.frames_decoded;
    assert!(decoded <= u64::from(PRESSES) + 33, "{decoded}");
    assert!(decoded >= u64::from(PRESSES), "{decoded}");
    let work = Work {
        jobs: NonZeroUsize::new(16).expect("sixteen"),
        ..WORK
    };
    let other = stress(&dataset, &model, &request, work).expect("tested");
    let text = |report: &StressReport| serde_json::to_string(report).expect("JSON");
    assert_eq!(text(&report), text(&other));
    let said = report.not_measured.expect("drawn pictures");
    assert!(said.contains("synthetic"), "{said}");
}

#[test]
fn equal_and_black_pictures_have_no_stimulus_and_no_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    let flat = |light: f64| picture([24, 16], PixelFormat::Gray8, |_, _| light);
    for (name, light) in [("black", 0.0), ("gray", 0.5)] {
        let path = folder.path().join(name);
        let dataset = record_with(&path, Some(flat(light)), |_, _, _| flat(light));
        let seen = record(&folder.path().join(format!("seen-{name}")), 1);
        let model = fitted(&seen, "ridge", &["size=8x8"]);
        let report = stress(&dataset, &model, &by_parameter(&["gel-12"]), WORK).expect("tested");
        assert_eq!(report.contact, None);
        for fault in &report.faults {
            assert_eq!(fault.severities.len(), 5, "{}", fault.id);
            assert!(fault.severities.iter().all(|of| of.stimulus.is_none()));
            let mut means = fault.mean.values().filter_map(|mean| mean.value);
            assert!(means.all(f64::is_finite), "{}", fault.id);
        }
    }
}

#[test]
fn a_plan_names_faults_and_frames_and_reads_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = unseen(folder.path());
    let request = by_parameter(&["tear", "stale_frames"]);
    let plan = stress_plan(&dataset, &model, &request, &[]).expect("planned");
    let text = plan.to_string();
    assert!(text.contains("60 frames of the part `all`"), "{text}");
    assert!(text.contains("fault    tear: a disc"), "{text}");
    assert!(
        text.contains("10 cells; also with 5 untouched pictures"),
        "{text}"
    );
    assert!(text.contains("synthetic"), "{text}");
}
