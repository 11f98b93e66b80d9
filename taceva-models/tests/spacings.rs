//! Spacings of gratings, predicted by a network.

use std::f64::consts::TAU;

use taceva_core::{FeatureShape, Features, Nanometre, SilentProgress};
use taceva_models::{ModelSettings, NetworkEstimator, SpacingOutput};

const SHAPE: FeatureShape = FeatureShape {
    height: 24,
    width: 32,
    depth: 1,
};

/// Spacings of the boards, in mm. A picture has eight pixels per millimetre.
const BOARDS: [f64; 4] = [0.5, 0.75, 1.0, 1.5];

fn nanometres(mm: f64) -> Nanometre {
    Nanometre::from_millimetres(mm).expect("a length")
}

/// Waves across the picture, each board at `presses` places.
#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
fn gratings(boards: &[f64], presses: u32) -> (Features, Vec<Nanometre>) {
    let (mut values, mut spacings) = (Vec::new(), Vec::new());
    for press in 0..presses {
        for &board in boards {
            // The golden ratio spreads any number of phases evenly.
            let phase = TAU * (0.618_034 * f64::from(press) + board).fract();
            for _ in 0..SHAPE.height {
                let row = (0..32_u8).map(|column| {
                    let wave = (TAU * f64::from(column) / (8.0 * board) + phase).sin();
                    (0.5 + 0.1 * wave) as f32
                });
                values.extend(row);
            }
            spacings.push(nanometres(board));
        }
    }
    (
        Features::new(SHAPE, values).expect("whole samples"),
        spacings,
    )
}

fn network(words: &[&str]) -> NetworkEstimator {
    let settings = ModelSettings::parse(words.iter().copied()).expect("well formed");
    NetworkEstimator::cnn(&settings).expect("valid")
}

fn quick() -> NetworkEstimator {
    network(&["epochs=25", "batch=16", "local_mean=0"])
}

fn predicted(boards: &[f64], output: SpacingOutput) -> (Vec<f64>, Vec<f64>) {
    let (pictures, spacings) = gratings(boards, 24);
    let fitted = quick().fit_spacings(&pictures, &spacings, output, &SilentProgress);
    // Phases between those of the training pictures.
    let (unseen, expected) = gratings(&BOARDS, 7);
    let found = fitted.expect("fits").predict(&unseen).expect("lengths");
    let mm = |lengths: Vec<Nanometre>| -> Vec<f64> {
        lengths.into_iter().map(Nanometre::to_millimetres).collect()
    };
    (mm(found), mm(expected))
}

#[test]
fn a_spacing_of_the_training_pictures_is_predicted_at_any_phase() {
    let (found, expected) = predicted(&BOARDS, SpacingOutput::Classes);
    assert_eq!(found, expected);
}

#[test]
fn a_length_is_predicted_near_that_of_the_training_pictures() {
    let (found, expected) = predicted(&BOARDS, SpacingOutput::Length);
    let errors = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
    let mean = errors.sum::<f64>() / 28.0;
    // The boards differ by at least 0.25 mm.
    assert!(mean < 0.06, "{mean}");
}

#[test]
fn of_one_board_nothing_is_to_be_learnt() {
    for output in [SpacingOutput::Classes, SpacingOutput::Length] {
        let (found, _) = predicted(&[0.75], output);
        assert!(found.iter().all(|mm| (mm - 0.75).abs() < 1e-12));
    }
}

#[test]
fn any_number_of_threads_predicts_the_same() {
    let (pictures, spacings) = gratings(&BOARDS, 6);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().expect("threads").install(|| {
            let fitted = network(&["epochs=2"]).fit_spacings(
                &pictures,
                &spacings,
                SpacingOutput::Length,
                &SilentProgress,
            );
            fitted.expect("fits").predict(&pictures).expect("lengths")
        })
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn pictures_without_spacings_and_pictures_of_another_size_are_refused() {
    let (pictures, spacings) = gratings(&BOARDS, 3);
    let fit = |spacings: &[Nanometre]| {
        quick().fit_spacings(&pictures, spacings, SpacingOutput::Classes, &SilentProgress)
    };
    for few in [&spacings[..0], &spacings[1..]] {
        let said = fit(few).expect_err("refused").to_string();
        let expected = format!(
            "12 pictures of gratings and {} spacings, expected equal numbers, at least one",
            few.len()
        );
        assert_eq!(said, expected);
    }
    let other = Features::new(FeatureShape::flat(20), vec![0.5; 20]).expect("whole");
    for fitted in [fit(&spacings), fit(&[spacings[0]; 12])] {
        let said = fitted.expect("fits").predict(&other).expect_err("refused");
        assert_eq!(
            said.to_string(),
            "pictures of 20 features, expected 768 as in the fit"
        );
    }
}
