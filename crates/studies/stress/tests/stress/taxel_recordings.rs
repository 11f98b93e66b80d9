//! Tests with recordings of taxels with faults.

use taceva_core::Frame;
use taceva_stress::{
    By, ByChannel, CellScore, FaultReport, OtherFaults, PictureFault, Stress, StressReport,
    StressRequest, TAXEL_FAULTS, TimeScore, WearRequest, stress, stress_beside, stress_plan,
    usual_list, wear,
};

use crate::drawing::{WORK, fitted, record as record_pictures, unseen};
use crate::taxel_drawing::{Drawn, WHOLE, fault, record, skin};

fn request(faults: &[&str]) -> StressRequest {
    StressRequest {
        faults: faults.iter().map(|name| (*name).to_owned()).collect(),
        ..StressRequest::default()
    }
}

fn of<'r>(report: &'r StressReport, id: &str) -> &'r FaultReport {
    let mut faults = report.faults.iter();
    faults.find(|fault| fault.id == id).expect("tested")
}

#[test]
fn a_model_of_signals_is_tested_with_faults_of_taxels_by_parameter_and_states_their_stimulus() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &[]);
    assert_eq!(usual_list(&model), "taxel-3");
    let wanted = StressRequest {
        draws: 5,
        ..request(&[usual_list(&model)])
    };
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    assert_eq!(report.list.name, "taxel-3/1");
    assert_eq!((report.by, report.input), (By::Parameter, "signals"));
    assert_eq!((report.untouched, report.contact_unit), ("reference", "uT"));
    assert!(report.contact.expect("known") > 0.1);
    assert_eq!(report.provenance.frames_decoded, 0);
    assert_eq!(report.samples, 70);
    assert!(report.unnoticed.is_some());
    for known in TAXEL_FAULTS {
        let found = of(&report, known.id);
        let parameters = found.severities.iter().map(|of| of.parameter);
        assert!(parameters.eq(known.table), "{}", known.id);
        assert!(found.note.is_some());
        let stimuli = found
            .severities
            .iter()
            .map(|of| of.stimulus.expect("known"));
        assert!(stimuli.is_sorted(), "{}", known.id);
        let errors = found.severities.iter().map(|of| of.stale["Fz"].mae.value);
        assert!(errors.flatten().all(f64::is_finite));
        // The model reads no untouched signals.
        assert!(found.severities.iter().all(|of| of.fresh.is_none()));
    }
    for id in ["taxel_dead", "taxel_gain"] {
        let last = of(&report, id).severities.last().expect("the fifth");
        assert!(last.stimulus.expect("known") > 0.5, "{id}");
        let score = &last.stale["Fz"];
        assert!(score.degradation.value.expect("a ratio") > 1.0, "{id}");
        assert!(score.spread.is_some(), "{id}");
    }
    // A gain of 1.4 or 0.6 changes each number by 40 %.
    let last = of(&report, "taxel_gain").severities.last().expect("last");
    let changed = last.stimulus.expect("known") * report.contact.expect("known");
    assert!((120.0..150.0).contains(&changed), "{changed}");
    let again = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let text = |report: &StressReport| serde_json::to_string(report).expect("JSON");
    assert_eq!(text(&report), text(&again));
}

#[test]
fn untouched_signals_from_after_the_fault_remove_errors_of_dead_taxels() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &["difference=true"]);
    let wanted = StressRequest {
        draws: 5,
        severities: vec![5],
        ..request(&["taxel_dead"])
    };
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let found = &of(&report, "taxel_dead").severities[0];
    let fresh = found.fresh.as_ref().expect("the model subtracts the rest");
    let error = |score: &CellScore| score.mae.value.expect("an error");
    assert!(error(&fresh["Fz"]) < 0.5 * error(&found.stale["Fz"]));
}

#[test]
fn a_taxel_that_is_dead_in_every_row_is_found_by_the_check_of_stuck_taxels() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &[]);
    let report = stress(&dataset, &model, &request(&["taxel-3"]), WORK).expect("tested");
    for found in &of(&report, "taxel_dead").severities {
        let is_dead = found.stimulus.expect("known") > 0.0;
        assert_eq!(found.check.contains(&"TAC016"), is_dead, "{found:?}");
    }
    for found in &of(&report, "taxel_gain").severities {
        assert!(found.check.is_empty(), "{found:?}");
    }
}

#[test]
fn without_times_or_a_known_change_by_contact_faults_are_skipped_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, model) = skin(folder.path(), &[]);
    let untimed = Drawn {
        step_s: None,
        has_rest: false,
        ..WHOLE
    };
    let dataset = record(&folder.path().join("untimed"), 3, &untimed);
    let wanted = request(&["taxel-3", "dropped_frames"]);
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    // The sample of the least force takes the place of untouched rows.
    assert_eq!(report.untouched, "least load");
    let skipped = report.skipped.iter();
    let skipped: Vec<(&str, &str)> = skipped
        .map(|of| (of.fault.as_str(), of.reason.as_str()))
        .collect();
    assert_eq!(
        skipped,
        [
            (
                "taxel_drift",
                "expected the times `t_s` of all samples, with a first and a last one"
            ),
            (
                "dropped_frames",
                "no metric of time: expected the times `t_s` of a stream, at most 1 s apart"
            ),
        ]
    );
    let slow = Drawn {
        step_s: Some(2.0),
        ..WHOLE
    };
    let slow = record(&folder.path().join("slow"), 4, &slow);
    let report = stress(&slow, &model, &wanted, WORK).expect("tested");
    assert_eq!(report.skipped.len(), 1, "{:?}", report.skipped);
    assert_eq!(report.skipped[0].fault, "dropped_frames");
    // Nothing tells untouched rows from those of contact.
    let unknown = Drawn {
        has_rest: false,
        has_force: false,
        ..WHOLE
    };
    let unknown = record(&folder.path().join("unknown"), 5, &unknown);
    let report = stress(&unknown, &model, &request(&["taxel-3"]), WORK).expect("tested");
    assert_eq!((report.untouched, report.contact), ("none", None));
    assert_eq!(report.skipped[0].fault, "taxel_drift");
    let expected = "the change by contact is unknown: expected rows without contact";
    assert!(report.skipped[0].reason.starts_with(expected));
    let stimulus = of(&report, "taxel_gain").severities[0].stimulus;
    assert_eq!(stimulus, None);
}

#[test]
fn a_fault_of_another_input_than_that_of_the_model_is_skipped_by_name() {
    /// Fault of a plugin that changes no picture.
    struct Nothing;
    impl PictureFault for Nothing {
        fn name(&self) -> &str {
            "nothing"
        }
        fn key(&self) -> &str {
            "org.example/nothing"
        }
        fn apply(&self, frame: &Frame, _: u8, _: &str) -> Result<Frame, String> {
            Ok(frame.clone())
        }
    }
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &[]);
    let others = OtherFaults {
        foreign: &[&Nothing],
        ..OtherFaults::default()
    };
    let wanted = request(&["tear", "force_noise", "taxel_gain"]);
    let report = stress_beside(&dataset, &model, &wanted, others, WORK).expect("tested");
    assert_eq!(report.list.name, "force_noise,taxel_gain");
    for (skipped, name) in report.skipped.iter().zip(["tear", "nothing"]) {
        assert_eq!(skipped.fault, name);
        assert_eq!(
            skipped.reason,
            "the model reads signals, and the fault changes pictures"
        );
    }
    assert_eq!(report.skipped.len(), 2);

    let folder = tempfile::tempdir().expect("a folder");
    let (pictures, model) = unseen(folder.path());
    let wanted = StressRequest {
        by: By::Parameter,
        ..request(&["dust", "taxel_gain"])
    };
    let report = stress(&pictures, &model, &wanted, WORK).expect("tested");
    assert_eq!(report.list.name, "dust");
    assert_eq!((report.input, report.contact_unit), ("frame", "1"));
    assert_eq!(report.skipped[0].fault, "taxel_gain");
    assert_eq!(
        report.skipped[0].reason,
        "the recording has no signals of taxels"
    );
}

#[test]
fn left_out_rows_change_metrics_of_time_and_no_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &[]);
    let both = request(&["taxel_gain", "dropped_frames"]);
    let report = stress(&dataset, &model, &both, WORK).expect("tested");
    let found = of(&report, "dropped_frames");
    let value = |times: &ByChannel<TimeScore>, name: &str| times[name].value.expect("known");
    assert!((value(&found.times, "frame_rate") - 100.0).abs() < 1e-6);
    assert_eq!(found.times["dropped"].value, Some(0.0));
    assert_eq!(found.times["frame_rate"].unit, "Hz");
    assert_eq!(found.times.len(), 3);
    // A quarter of the rows is left out: most intervals are still of one step.
    let fourth = &found.severities[3];
    assert!((value(&fourth.times, "frame_rate") - 100.0).abs() < 1e-6);
    assert!(value(&fourth.times, "dropped") > 0.05);
    assert!(found.severities.iter().all(|of| of.stale.is_empty()));
    assert!(found.mean.is_empty() && found.breaks_at.is_empty());
    assert!(found.keeps_inputs());
    let alone = stress(&dataset, &model, &request(&["taxel_gain"]), WORK).expect("tested");
    assert_eq!(report.mean, alone.mean);

    let left_out = |seed: u64| -> Vec<u32> {
        let stress = Stress::new(fault("dropped_frames"), 0.5, seed);
        let rows = 0..200_u32;
        rows.filter(|row| stress.leaves_out(&format!("s{row}")))
            .collect()
    };
    // Expected: 100, standard deviation 7; the limits are five deviations.
    assert!((65..=135).contains(&left_out(1).len()));
    assert_eq!(left_out(1), left_out(1));
    assert_ne!(left_out(1), left_out(2));
}

#[test]
fn severities_above_the_end_of_skill_are_left_out_for_taxels_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = record(&folder.path().join("seen"), 1, &WHOLE);
    let model = fitted(&seen, "baseline", &[]);
    let dataset = record(&folder.path().join("unseen"), 2, &WHOLE);
    let wanted = StressRequest {
        stops_at_no_skill: true,
        ..request(&["taxel_gain"])
    };
    let report = stress(&dataset, &model, &wanted, WORK).expect("tested");
    let found = of(&report, "taxel_gain");
    assert_eq!((found.stopped_at, found.severities.len()), (Some(1), 1));
    // A constant prediction does not depend on the signals.
    let ratio = found.severities[0].stale["Fz"].degradation.value;
    assert_eq!(ratio, Some(1.0));
    assert_eq!(found.breaks_at["Fz"], Some(1));
}

#[test]
fn recordings_without_the_input_of_the_model_and_wear_of_taxels_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &[]);
    let pictures = record_pictures(&folder.path().join("pictures"), 5);
    let said = stress(&pictures, &model, &request(&["taxel-3"]), WORK).expect_err("refused");
    assert!(said.is_usage(), "{said}");
    let expected = "the recording has no signals, which the model reads";
    assert!(said.to_string().contains(expected), "{said}");
    let of_pictures = fitted(&pictures, "ridge", &["size=8x8"]);
    let said = stress(&dataset, &of_pictures, &request(&["gel-12"]), WORK).expect_err("refused");
    assert!(said.to_string().contains("has no pictures"), "{said}");
    let recordings = [dataset];
    let said = wear(&recordings, &model, &WearRequest::default(), WORK).expect_err("refused");
    let expected = "the model reads signals, expected a model that reads pictures";
    assert!(said.to_string().contains(expected), "{said}");
}

#[test]
fn the_plan_reads_signals_and_names_skipped_faults() {
    let folder = tempfile::tempdir().expect("a folder");
    let (dataset, model) = skin(folder.path(), &[]);
    let wanted = request(&["taxel_gain", "tear"]);
    let plan = stress_plan(&dataset, &model, &wanted, &[]).expect("planned");
    let text = plan.to_string();
    assert!(text.contains("the signals of 70 samples"), "{text}");
    assert!(!text.contains("decode"), "{text}");
    assert!(text.contains("taxel_gain: each number"), "{text}");
    assert!(text.contains("tear: the model reads signals"), "{text}");
}
