//! A gripper of two fingers, each of which measures a part of the force: models of one finger and of both side by side.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, DatasetError};
use taceva_evaluate::{
    EvaluateError, FitRequest, ModelChoice, evaluate, evaluate_plan, fit, predict,
};
use taceva_import::{ImportMap, ImportPlan};
use taceva_models::Models;

use crate::taxels::{WORK, evaluated, of, r2, request};

const ROWS: u32 = 90;
const SIDE: u32 = 16;

/// Forces on the two fingers: two independent numbers from 0 to 1.
fn felt(row: u32) -> [f64; 2] {
    [row * 37 % 64, row * 53 % 61].map(|number| f64::from(number) / 64.0)
}

/// Gray frames whose middle is as bright as the force on the finger.
fn pictures(finger: usize) -> Vec<u8> {
    let header = format!(
        "{{'descr': '|u1', 'fortran_order': False, 'shape': ({ROWS}, {SIDE}, {SIDE}), }}\n"
    );
    let length = u16::try_from(header.len()).expect("short");
    let mut bytes = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    bytes.extend(header.into_bytes());
    for row in 0..ROWS {
        for pixel in 0..SIDE * SIDE {
            let (x, y) = (pixel % SIDE, pixel / SIDE);
            let is_middle = x.abs_diff(8) < 4 && y.abs_diff(8) < 4;
            let noise = (pixel + 977 * row)
                .wrapping_mul(2_654_435_761)
                .rotate_left(9)
                % 3;
            let light = 40.0
                + f64::from(noise)
                + if is_middle {
                    180.0 * felt(row)[finger]
                } else {
                    0.0
                };
            let byte = (0..=255_u8).find(|byte| f64::from(*byte) >= light);
            bytes.push(byte.unwrap_or(255));
        }
    }
    bytes
}

/// Recording of a gripper whose force is the sum over both fingers.
fn gripper(folder: &Path) -> Dataset {
    let lab = folder.join("lab");
    std::fs::create_dir(&lab).expect("made");
    let rows = (0..ROWS).map(|row| format!("{},p{row},{row}\n", felt(row)[0] + felt(row)[1]));
    let table = format!("force,press,t\n{}", rows.collect::<String>());
    std::fs::write(lab.join("labels.csv"), table).expect("written");
    let mut map = "map_version = 2\ntable = \"labels.csv\"\n".to_owned();
    for (finger, name) in ["left", "right"].into_iter().enumerate() {
        std::fs::write(lab.join(format!("{name}.npy")), pictures(finger)).expect("written");
        map += &format!(
            "[[frame]]\nname = \"{name}\"\narray = {{ file = \"{name}.npy\" }}\nchannel_order = \"gray\"\nreference = \"unknown\"\n"
        );
    }
    map += "[columns]\nFz = { from = \"force\", unit = \"N\" }\n[ids]\npoint_id = \"press\"\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n\
        [sensor]\nmodel = \"gripper\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";
    let map = ImportMap::parse("map.toml".as_ref(), &map).expect("a map");
    let plan = ImportPlan::new(&lab, &map).expect("planned");
    let target = folder.join("gripper");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(&target).expect("a dataset")
}

fn seen(dataset: &Dataset, view: &str) -> Dataset {
    dataset.seen(view).expect("a view")
}

#[test]
fn one_finger_knows_a_part_of_the_force_and_both_side_by_side_all_of_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = gripper(folder.path());
    let [left, right, both] = ["left", "right", "left+right"].map(|view| {
        let scored = evaluated(&seen(&dataset, view), "ridge", &["size=8x8"]).expect(view);
        assert_eq!(scored.report.provenance.view.as_deref(), Some(view));
        let notes = &scored.report.provenance.notes;
        let said = notes
            .iter()
            .find(|note| note.contains("several pictures (left, right)"));
        assert!(said.is_some_and(|note| note.contains(view)), "{notes:?}");
        r2(&scored)
    });
    assert!(
        left < 0.8 && right < 0.8 && both > 0.98,
        "{left} {right} {both}"
    );
}

#[test]
fn a_view_that_nobody_named_is_asked_for_with_those_that_there_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = gripper(folder.path());
    let asked = |error: EvaluateError| {
        let EvaluateError::Dataset(DatasetError::View {
            asked: None, known, ..
        }) = error
        else {
            panic!("{error}");
        };
        assert_eq!(known, ["left", "right"]);
    };
    asked(evaluated(&dataset, "ridge", &[]).expect_err("which"));
    asked(fit(&dataset, &request("knn", &[]), None, WORK).expect_err("which"));
    let folds = FitRequest {
        split: Some("cv:3".to_owned()),
        ..request("ridge", &[])
    };
    asked(evaluate(&dataset, &of(ModelChoice::Fit(folds)), WORK).expect_err("which"));
    asked(
        evaluate_plan(&dataset, &of(ModelChoice::Fit(request("ridge", &[])))).expect_err("which"),
    );
    // A constant model reads no frame.
    evaluated(&dataset, "baseline", &[]).expect("no picture is read");
}

#[test]
fn a_model_keeps_its_view_and_predicts_no_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = gripper(folder.path());
    let fitted = fit(
        &seen(&dataset, "right"),
        &request("ridge", &["size=8x8"]),
        None,
        WORK,
    );
    let path = folder.path().join("right.model");
    fitted.expect("fitted").model.save(&path).expect("saved");
    let model = Models::builtin().open(&path).expect("a model");
    assert_eq!(model.card().provenance.view.as_deref(), Some("right"));
    let own = predict(&seen(&dataset, "right"), &model, None, WORK).expect("predicted");
    // On its own recording, the default part is the one that the model has not seen.
    assert_eq!((own.part(), own.rows()), ("test", 18));
    for view in ["left", "left+right"] {
        let problem = predict(&seen(&dataset, view), &model, None, WORK).expect_err(view);
        let problem = problem.to_string();
        assert!(
            problem.contains("fitted on the view `right`") && problem.contains(view),
            "{problem}"
        );
    }
    let unnamed = predict(&dataset, &model, None, WORK)
        .expect_err("which")
        .to_string();
    assert!(unnamed.contains("`left`, `right`"), "{unnamed}");
}

#[test]
fn cross_validation_takes_one_view_or_both() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = gripper(folder.path());
    let scores = ["left", "left+right"].map(|view| {
        let folds = FitRequest {
            split: Some("cv:3".to_owned()),
            ..request("ridge", &["size=8x8"])
        };
        let scored =
            evaluate(&seen(&dataset, view), &of(ModelChoice::Fit(folds)), WORK).expect(view);
        assert_eq!(scored.report.provenance.view.as_deref(), Some(view));
        r2(&scored)
    });
    assert!(scores[0] < 0.8 && scores[1] > 0.98, "{scores:?}");
}
