//! Tests of the accuracy of Winograd's passes for various inputs, and of the convolutions that they support.

mod blocks;

use super::*;
use crate::convolution::tests::{Case, Numbers, batch_of, forward, machines, passes, values};
use crate::convolution::{ConvolutionForm, ConvolutionWeights};

/// Largest allowed root mean square error, relative to the root mean square of the results.
const ERROR: f64 = 4e-6;

const PASSES: [&str; 3] = ["output", "gradient of the input", "gradient of the weights"];

fn case(channels: (usize, usize), (height, width): (usize, usize), batch: usize) -> Case {
    let (inputs, outputs) = channels;
    Case {
        convolution: Convolution {
            inputs,
            outputs,
            kernel: 3,
            stride: 1,
        },
        input: Picture {
            height,
            width,
            channels: inputs,
        },
        batch,
    }
}

/// Root mean square error relative to the root mean square of the expected values.
fn error(found: &[f32], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let squares: f64 = expected.iter().map(|value| value * value).sum();
    let differences = found.iter().zip(expected);
    let differences = differences.map(|(found, expected)| (f64::from(*found) - expected).powi(2));
    (differences.sum::<f64>() / squares).sqrt()
}

/// Greatest root mean square error of each pass over all instruction sets.
fn errors(case: &Case, numbers: &Numbers) -> [f64; 3] {
    let expected = case.definition(numbers);
    let mut worst = [0.0_f64; 3];
    for (_, machine) in machines() {
        let found = passes(case, machine, numbers);
        for (worst, (found, expected)) in worst.iter_mut().zip(found.iter().zip(&expected)) {
            let error = error(found, expected);
            // A maximum would let NaN pass.
            *worst = if error <= *worst { *worst } else { error };
        }
    }
    worst
}

fn assert_exact(case: &Case, numbers: &Numbers, what: &str) {
    for (pass, error) in PASSES.into_iter().zip(errors(case, numbers)) {
        assert!(error <= ERROR, "{what} {case:?}: {pass}: {error:e}");
    }
}

#[test]
fn pictures_where_tiles_multiply_less_are_taken_and_no_others() {
    let taken = |kernel, stride, inputs, height, width| {
        let convolution = Convolution {
            inputs,
            outputs: 16,
            kernel,
            stride,
        };
        let input = Picture {
            height,
            width,
            channels: inputs,
        };
        is_for(convolution, convolution.output(input))
    };
    for (height, width) in [
        (2, 3),
        (3, 2),
        (3, 3),
        (4, 4),
        (5, 5),
        (7, 7),
        (2, 8),
        (16, 16),
    ] {
        assert!(taken(3, 1, 16, height, width), "{height} × {width}");
    }
    for (height, width) in [(1, 1), (1, 2), (2, 1), (2, 2), (1, 9), (9, 1), (1, 64)] {
        assert!(!taken(3, 1, 16, height, width), "{height} × {width}");
    }
    assert!(!taken(3, 2, 16, 16, 16), "a stride of 2");
    assert!(!taken(5, 1, 16, 16, 16), "a kernel of 5 × 5");
    assert!(!taken(1, 1, 16, 16, 16), "a kernel of 1 × 1");
    assert!(!taken(3, 1, 1, 16, 16), "one channel");
    assert!(!taken(3, 1, 24, 16, 16), "channels of one panel and a half");
}

#[test]
fn every_size_of_1_to_9_is_exact_also_pictures_smaller_than_a_tile_and_maps_of_1_by_1() {
    for height in 1..=9 {
        for width in 1..=9 {
            let case = case((16, 32), (height, width), 1 + (height + width) % 3);
            assert_exact(&case, &case.numbers(), "a small picture");
        }
    }
}

#[test]
fn a_batch_of_one_is_exact() {
    for (height, width) in [(1, 1), (3, 3), (7, 5), (8, 8)] {
        let case = case((32, 48), (height, width), 1);
        assert_exact(&case, &case.numbers(), "one picture");
    }
}

#[test]
fn many_channels_are_as_exact_as_few() {
    for channels in [64, 512] {
        let case = case((channels, channels), (4, 4), 2);
        for (pass, error) in PASSES.into_iter().zip(errors(&case, &case.numbers())) {
            // The error for many channels stays at that for few channels.
            assert!(
                error <= ERROR / 3.0,
                "{channels} channels: {pass}: {error:e}"
            );
        }
    }
}

#[test]
fn a_convolution_of_one_channel_is_direct_and_exact() {
    let case = case((1, 16), (9, 7), 2);
    let numbers = case.numbers();
    let expected = case.definition(&numbers);
    for (isa, machine) in machines() {
        let found = passes(&case, machine, &numbers);
        // The input gradient of this case is never computed.
        for pass in [0, 2] {
            let error = error(&found[pass], &expected[pass]);
            assert!(error <= ERROR, "{isa}: {}: {error:e}", PASSES[pass]);
        }
    }
}

#[test]
fn constant_saturated_large_and_small_pictures_are_as_exact_as_others() {
    let case = case((64, 32), (9, 6), 3);
    let usual = case.numbers();
    let changed = |change: &dyn Fn(f32) -> f32| {
        let all = |values: &[f32]| values.iter().map(|value| change(*value)).collect();
        Numbers {
            pictures: all(&usual.pictures),
            weights: usual.weights.clone(),
            gradients: all(&usual.gradients),
        }
    };
    let pictures: [(&str, Numbers); 5] = [
        ("constant", changed(&|_| 1.0)),
        (
            "saturated",
            changed(&|value| if value > -0.4 { 255.0 } else { 0.0 }),
        ),
        ("large", changed(&|value| value * 1e4)),
        ("small", changed(&|value| value * 1e-4)),
        ("far from zero", changed(&|value| value + 100.0)),
    ];
    for (what, numbers) in &pictures {
        assert_exact(&case, numbers, what);
    }
}

#[test]
fn scales_that_are_powers_of_two_change_no_digit() {
    let case = case((16, 16), (7, 5), 2);
    let usual = case.numbers();
    let scaled = |factor: f32| Numbers {
        pictures: usual.pictures.iter().map(|value| value * factor).collect(),
        weights: usual.weights.clone(),
        gradients: usual.gradients.iter().map(|value| value * factor).collect(),
    };
    for (isa, machine) in machines() {
        let before = passes(&case, machine, &usual);
        for factor in [2.0_f32.powi(14), 2.0_f32.powi(-14)] {
            let after = passes(&case, machine, &scaled(factor));
            for (pass, (before, after)) in PASSES.iter().zip(before.iter().zip(&after)) {
                // Both factors of the weight gradient scale with `factor`.
                let factor = if *pass == PASSES[2] {
                    factor * factor
                } else {
                    factor
                };
                let same = before.iter().zip(after);
                let mut same = same.map(|(a, b)| (a * factor).to_bits() == b.to_bits());
                assert!(same.all(|same| same), "{isa}: {pass}");
            }
        }
    }
}

#[test]
fn a_weight_or_pixel_that_is_not_finite_is_not_hidden() {
    let case = case((16, 16), (6, 6), 1);
    for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for (isa, machine) in machines() {
            let mut numbers = case.numbers();
            // The middle of the kernel from channel 2 to channel 5.
            numbers.weights[(5 * 16 + 2) * 9 + 4] = wrong;
            let [outputs, inputs, _] = passes(&case, machine, &numbers);
            assert!(
                outputs.chunks_exact(16).all(|pixel| !pixel[5].is_finite()),
                "{isa}: {wrong}"
            );
            assert!(
                inputs.chunks_exact(16).all(|pixel| !pixel[2].is_finite()),
                "{isa}: {wrong}"
            );
            let mut numbers = case.numbers();
            numbers.pictures[0] = wrong;
            let [outputs, _, gradients] = passes(&case, machine, &numbers);
            for values in [outputs, gradients] {
                assert!(
                    values.iter().any(|value| !value.is_finite()),
                    "{isa}: {wrong}"
                );
            }
        }
    }
}

#[test]
fn pictures_do_not_depend_on_those_beside_them() {
    let case = case((32, 48), (9, 5), 21);
    let numbers = case.numbers();
    let mut weights = ConvolutionWeights::zeros(case.convolution);
    weights.set_plain(&numbers.weights);
    for (isa, machine) in machines() {
        let how = (machine, ConvolutionForm::Winograd);
        let all = batch_of(case.input, 1, &numbers.pictures);
        let all = values(&forward(&weights, &all, how), case.batch);
        let pictures = numbers.pictures.chunks_exact(case.input.len());
        for (picture, expected) in pictures.zip(all.chunks_exact(case.output().len())) {
            let alone = batch_of(case.input, 1, picture);
            let alone = values(&forward(&weights, &alone, how), 1);
            let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert!(bits(&alone) == bits(expected), "{isa}");
        }
    }
}
