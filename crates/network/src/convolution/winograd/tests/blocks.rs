//! Measures errors by the number of channels per partial sum. The function `channels_at_once` is based on these errors.

use super::super::products::{Products, RunValues, channels_at_once};
use super::super::weights::to_points;
use super::{Case, ConvolutionWeights, Numbers, batch_of, case, error, values};
use crate::convolution::ConvolutionForm;
use crate::convolution::TileRooms;
use crate::convolution::ending::Onto;
use crate::convolution::tests::{forward, machines, passes};
use crate::machine::Machine;
use crate::panel::Aligned;
use crate::planes::Planes;

/// Layers of residual networks that use Winograd's algorithm, for pictures of 64² to 112²: number of channels, and side of the layer's pictures.
const LAYERS: [(usize, usize); 4] = [(64, 16), (128, 8), (256, 4), (512, 4)];

/// Numbers of channels per partial sum. The last number includes all channels.
const BLOCKS: [usize; 5] = [4, 8, 16, 32, 512];

/// Outputs and input gradients, computed with `channels` channels per partial sum.
fn summed(case: &Case, machine: Machine, numbers: &Numbers, channels: usize) -> [Vec<f32>; 2] {
    let mut weights = ConvolutionWeights::zeros(case.convolution);
    weights.set_plain(&numbers.weights);
    let mut exchanged = Aligned::zeros(weights.values().len());
    weights.exchange(machine, &mut exchanged);
    let (input, output) = (case.input, case.output());
    let pictures = batch_of(input, 1, &numbers.pictures);
    let gradients = batch_of(output, 1, &numbers.gradients);
    let run = |read: &Planes, (weights, is_turned): (&[f32], bool), into| {
        let mut written = Planes::zeros(into, 1, case.batch);
        let products = Products {
            channels_at_once: channels,
            ..Products::new(read.layout(), written.layout())
        };
        let mut room = Aligned::zeros(products.transformed_len());
        let inputs = read.layout().picture.channels;
        to_points(machine, weights, inputs, is_turned, &mut room);
        let run_values = RunValues {
            pictures: read.first(case.batch),
            weights: &room,
            output: written.first_mut(case.batch),
        };
        let rule = Onto::Nothing.rule();
        let each = &mut vec![(); case.batch][..];
        let (see, rooms) = (|(): &mut (), _: &[f32]| {}, TileRooms::default());
        products.run(machine, run_values, |_| rule, each, see, &rooms);
        values(&written, case.batch)
    };
    [
        run(&pictures, (weights.values(), false), output),
        run(&gradients, (&exchanged, true), input),
    ]
}

/// Values like those after ReLU: half of them are zero, and none is negative.
fn rectified(mut numbers: Numbers) -> Numbers {
    let pixels = numbers.pictures.iter_mut();
    pixels.for_each(|value| *value = value.max(0.0));
    numbers
}

/// Root mean square errors of outputs and of input gradients for each of `BLOCKS`.
fn errors_by_block(case: &Case, numbers: &Numbers) -> [[f64; 2]; BLOCKS.len()] {
    let [outputs, twice, _] = case.definition(numbers);
    let gradients: Vec<f64> = twice.iter().map(|value| value / 2.0).collect();
    // The fastest machine is enough: all sets with fused multiply-add give the same bits.
    let (_, machine) = machines()[0];
    BLOCKS.map(|channels| {
        let [found, found_gradients] = summed(case, machine, numbers, channels);
        [error(&found, &outputs), error(&found_gradients, &gradients)]
    })
}

#[test]
fn channels_are_summed_by_as_many_as_are_most_exact_and_not_all_in_one_row() {
    for (channels, side) in LAYERS {
        let case = case((channels, channels), (side, side), 2);
        let errors = errors_by_block(&case, &rectified(case.numbers()));
        let chosen = BLOCKS
            .iter()
            .position(|block| *block == channels_at_once(channels));
        let chosen = chosen.expect("one of those that are compared");
        for (pass, what) in ["outputs", "gradients of inputs"].into_iter().enumerate() {
            let errors = errors.map(|errors| errors[pass]);
            let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
            let what = format!("{channels} channels, {what}: {errors:?}");
            // Random draws explain a difference of a tenth.
            assert!(errors[chosen] <= 1.1 * least, "{what}");
            assert!(errors[BLOCKS.len() - 1] >= 1.4 * errors[chosen], "{what}");
        }
    }
}

/// Prints a table of errors: `cargo test -p taceva-network --lib by_block -- --ignored --nocapture`.
#[test]
#[ignore = "prints a table"]
#[expect(clippy::print_stdout, reason = "a table to be read")]
fn errors_by_block_in_a_table() {
    println!("| channels, picture, pass | direct | by {BLOCKS:?} channels |");
    for (channels, side) in LAYERS {
        let case = case((channels, channels), (side, side), 2);
        for (what, numbers) in [
            ("-½ to ½", case.numbers()),
            ("rectified", rectified(case.numbers())),
        ] {
            let (_, machine) = machines()[0];
            let expected = case.definition(&numbers);
            let mut weights = ConvolutionWeights::zeros(case.convolution);
            weights.set_plain(&numbers.weights);
            let pictures = batch_of(case.input, 1, &numbers.pictures);
            let direct = forward(&weights, &pictures, (machine, ConvolutionForm::Direct));
            let direct = error(&values(&direct, case.batch), &expected[0]);
            let blocks = errors_by_block(&case, &numbers);
            let of = |pass: usize| {
                blocks
                    .map(|errors| format!("{:.2e}", errors[pass]))
                    .join(" ")
            };
            println!(
                "| {channels} {side}² {what}: outputs | {direct:.2e} | {} |",
                of(0)
            );
            println!("| gradients of inputs | | {} |", of(1));
            let found = &passes(&case, machine, &numbers)[2];
            let error = error(found, &expected[2]);
            println!("| gradients of weights, whose sums are over tiles | | {error:.2e} |");
        }
    }
}
