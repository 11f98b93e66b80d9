//! Tests that predictions are independent of threads, of other samples and of the order of training samples.

use super::case::{bits, cases, predict};

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for case in cases().filter(|case| !case.deeper) {
        let (training, held, test) = (
            case.recording(80, 11),
            case.recording(30, 12),
            case.recording(70, 13),
        );
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("threads").install(|| {
                let fit = case.fitted(&training, Some(&held));
                bits(&predict(&fit.regressor, &test.features))
            })
        };
        let alone = with(1);
        for threads in [2, 5] {
            assert!(with(threads) == alone, "{} with {threads}", case.name);
        }
    }
}

#[test]
fn a_sample_is_predicted_alone_as_among_others() {
    for case in cases().filter(|case| !case.deeper) {
        let (training, test) = (case.recording(40, 14), case.recording(33, 15));
        let regressor = case.fitted(&training, None).regressor;
        let together = predict(&regressor, &test.features);
        for (sample, expected) in together.chunks_exact(2).enumerate() {
            let alone = predict(&regressor, &test.features.select(&[sample]));
            assert_eq!(bits(&alone), bits(expected), "{} at {sample}", case.name);
        }
    }
}

#[test]
fn the_order_of_training_samples_does_not_matter_where_nothing_is_drawn() {
    for case in cases() {
        let (training, held, test) = (
            case.recording(80, 18),
            case.recording(30, 19),
            case.recording(40, 20),
        );
        let rows: Vec<usize> = (0..80).map(|row| (row * 7 + 3) % 80).collect();
        let permuted = training.select(&rows);
        let Some(tolerance) = case.order else {
            continue;
        };
        let expected = predict(
            &case.fitted(&training, Some(&held)).regressor,
            &test.features,
        );
        let found = predict(
            &case.fitted(&permuted, Some(&held)).regressor,
            &test.features,
        );
        let largest = expected
            .iter()
            .fold(0.0_f64, |most, value| most.max(value.abs()));
        let pairs = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
        let moved = pairs.fold(0.0, f64::max) / largest;
        assert!(moved < tolerance, "{}: {moved}", case.name);
    }
}
