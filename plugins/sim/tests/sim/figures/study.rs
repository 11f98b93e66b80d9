//! Published figures compared with complete runs of the calibration and load-unload phases of the paper's scene. The robot moves, the gel relaxes
//! meanwhile, contact is searched from the air, and a supervisor ends a press at the force limit.

use taceva_protocol::{BuiltinScene, PhaseKind};
use taceva_sim::{Label, Model};

use super::sensitivity::{PUBLISHED, TOLERANCE, sensitivity};
use crate::trial::{Log, Trial};

/// Runs the presses of the phase `kind` in the paper's protocol, with unit 0 of `model`. Returns the trial and its log.
fn records(model: Model, kind: PhaseKind) -> (Trial, Log) {
    let text = BuiltinScene::Paper.text();
    let (protocol, _) = text.split_once("[[study]]").expect("it has studies");
    let key = model.key();
    let study = format!(
        "[[study]]\nname = \"{key}\"\nsensor = {{ driver = \"sim/{key}\", units = [\"0\"] }}\n"
    );
    let mut trial = Trial::new(model, &format!("{protocol}{study}"));
    trial
        .plan
        .presses
        .retain(|press| press.phases.contains(&kind));
    let mut log = Log::default();
    trial.run("0", &mut log, usize::MAX);
    (trial, log)
}

/// Places and forces by press, in the order of reading.
fn labels(trial: &Trial, log: &Log) -> Vec<Vec<Label>> {
    let channels = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"].map(|name| {
        let mut channels = trial.plan.channels.iter();
        channels
            .position(|channel| channel == name)
            .expect("it is recorded")
    });
    let presses = log.records.iter().map(|record| {
        let samples = record.samples.iter().map(|sample| {
            let [x, y, z, fx, fy, fz] =
                channels.map(|channel| sample.truth.get(channel).expect("it was read"));
            Label {
                position_mm: [x, y, z],
                force_n: [fx, fy, fz],
            }
        });
        samples.collect()
    });
    presses.collect()
}

#[test]
fn the_calibration_of_the_paper_s_scene_has_the_published_sensitivities() {
    for (model, published_s, published_u) in PUBLISHED {
        let (trial, log) = records(model, PhaseKind::Calibration);
        let labels = labels(&trial, &log).concat();
        let limited = log.records.iter();
        let limited = limited.filter(|record| record.outcome.is_limited());
        let limited = limited.count();
        let (s, u) = sensitivity(model, &labels);
        println!(
            "{model}: S {s:.3} mm/N ({published_s}), U {u:.3} ({published_u}), {limited} points limited"
        );
        assert!((s / published_s - 1.0).abs() < TOLERANCE, "{model}: {s}");
        assert!((u / published_u - 1.0).abs() < TOLERANCE, "{model}: {u}");
        assert!(limited * 50 < log.records.len(), "{model}: {limited}");
    }
}

/// Mean fraction of the work that a press loses, over presses that no limit ended.
fn loss(trial: &Trial, log: &Log) -> f64 {
    let samples = trial.plan.presses[0].press.samples();
    let losses: Vec<f64> = labels(trial, log)
        .iter()
        .filter(|press| press.len() == samples)
        .map(|press| {
            let work = |branch: &[Label]| -> f64 {
                branch
                    .windows(2)
                    .map(|pair| {
                        let way_mm = pair[1].position_mm[2] - pair[0].position_mm[2];
                        0.5 * way_mm * (pair[0].force_n[2] + pair[1].force_n[2])
                    })
                    .sum()
            };
            let (loading, unloading) = press.split_at(samples / 2);
            1.0 + work(unloading) / work(loading)
        })
        .collect();
    losses.iter().sum::<f64>() / losses.len() as f64
}

#[test]
fn in_the_paper_s_scene_the_dome_alone_shows_a_clear_loop() {
    for model in Model::ALL {
        let (trial, log) = records(model, PhaseKind::LoadUnload);
        let lost = loss(&trial, &log);
        println!("{model}: {:.1} % lost", 100.0 * lost);
        let expected = match model {
            Model::ViTacTip => 0.19..0.28,
            _ => 0.0..0.04,
        };
        assert!(expected.contains(&lost), "{model}: {lost}");
    }
}
