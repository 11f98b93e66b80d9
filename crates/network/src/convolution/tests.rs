//! Tests that compare every pass with a simple implementation in double precision, on every instruction set of the machine.

mod divided;

use taceva_core::Isa;

use super::*;
use crate::machine::Machine;
use crate::panel::Aligned;
use crate::planes::{Pictures, Planes};
use taceva_core::random::Draws;

pub(crate) fn random(length: usize, seed: u64) -> Vec<f32> {
    let draws = Draws::new(seed);
    #[expect(
        clippy::cast_possible_truncation,
        reason = "inputs of single precision"
    )]
    let values = (0..length as u64).map(|at| (draws.unit(at) - 0.5) as f32);
    values.collect()
}

/// Calls a function for every output pixel and channel, with each input and weight that this output uses. This is the definition of a convolution.
fn for_each_product(
    convolution: Convolution,
    input: Picture,
    mut meet: impl FnMut(usize, usize, usize),
) {
    let output = convolution.output(input);
    let Convolution {
        inputs,
        outputs,
        kernel,
        stride,
    } = convolution;
    for (oy, ox) in (0..output.height).flat_map(|y| (0..output.width).map(move |x| (y, x))) {
        for (ky, kx) in (0..kernel).flat_map(|y| (0..kernel).map(move |x| (y, x))) {
            let (y, x) = (oy * stride + ky, ox * stride + kx);
            let (Some(y), Some(x)) = (y.checked_sub(kernel / 2), x.checked_sub(kernel / 2)) else {
                continue;
            };
            if y >= input.height || x >= input.width {
                continue;
            }
            for from in 0..inputs {
                for to in 0..outputs {
                    meet(
                        (oy * output.width + ox) * outputs + to,
                        (y * input.width + x) * inputs + from,
                        ((to * inputs + from) * kernel + ky) * kernel + kx,
                    );
                }
            }
        }
    }
}

/// Algorithm of the pass, if it supports the shape.
const FORM: ConvolutionForm = ConvolutionForm::Winograd;

/// Test case: a convolution of some pictures.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) convolution: Convolution,
    pub(crate) input: Picture,
    pub(crate) batch: usize,
}

/// Input values of a test case: pictures, weights and output gradients. Channels are the last dimension, except in weights, which have the shape `[outputs,
/// inputs, kernel row, kernel column]`.
pub(crate) struct Numbers {
    pub(crate) pictures: Vec<f32>,
    pub(crate) weights: Vec<f32>,
    pub(crate) gradients: Vec<f32>,
}

impl Case {
    pub(crate) fn output(&self) -> Picture {
        self.convolution.output(self.input)
    }

    /// Random numbers from -½ to ½.
    pub(crate) fn numbers(&self) -> Numbers {
        let Convolution {
            inputs, outputs, ..
        } = self.convolution;
        Numbers {
            pictures: random(self.input.len() * self.batch, 1),
            weights: random(inputs * outputs * self.convolution.taps(), 2),
            gradients: random(self.output().len() * self.batch, 3),
        }
    }

    /// Expected results in double precision: outputs, twice the input gradients, and weight gradients.
    pub(crate) fn definition(&self, numbers: &Numbers) -> [Vec<f64>; 3] {
        let (input, output) = (self.input, self.output());
        let mut outputs = vec![0.0; output.len() * self.batch];
        let mut inputs = vec![0.0; input.len() * self.batch];
        let mut weights = vec![0.0; numbers.weights.len()];
        for image in 0..self.batch {
            let (to_image, from_image) = (image * output.len(), image * input.len());
            for_each_product(self.convolution, input, |to, from, weight| {
                let [number, gradient, factor] = [
                    numbers.pictures[from_image + from],
                    numbers.gradients[to_image + to],
                    numbers.weights[weight],
                ]
                .map(f64::from);
                outputs[to_image + to] += number * factor;
                inputs[from_image + from] += 2.0 * gradient * factor;
                weights[weight] += number * gradient;
            });
        }
        [outputs, inputs, weights]
    }
}

fn cases() -> Vec<Case> {
    let case = |inputs, outputs, kernel, stride, height, width, batch| Case {
        convolution: Convolution {
            inputs,
            outputs,
            kernel,
            stride,
        },
        input: Picture {
            height,
            width,
            channels: inputs,
        },
        batch,
    };
    vec![
        case(3, 64, 7, 2, 13, 10, 2),
        case(1, 16, 5, 2, 8, 9, 3),
        case(16, 48, 3, 1, 7, 5, 2),
        case(32, 16, 3, 2, 9, 8, 5),
        case(16, 80, 3, 2, 8, 7, 2),
        case(64, 32, 1, 2, 8, 7, 2),
        case(16, 16, 5, 1, 4, 6, 1),
        // Enough weights for several rounds.
        case(320, 320, 3, 1, 2, 2, 2),
        // For Winograd's form: partial tiles below and beside, five panels, several pieces, the last not full.
        case(32, 80, 3, 1, 13, 6, 7),
        // Tiles larger than the picture.
        case(16, 16, 3, 1, 3, 2, 1),
        // Enough tiles for several rounds of gradient sums.
        case(96, 96, 3, 1, 17, 17, 4),
    ]
}

/// Asserts that relative differences do not exceed the rounding error of sums of `terms` products in single precision.
fn assert_close(found: &[f32], expected: &[f64], terms: usize, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (place, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        // Products are below 1/4. The bound is ten standard deviations of a random walk of rounding errors.
        let bound = 10.0 * f64::from(f32::EPSILON) * terms as f64 / 12.0;
        assert!(
            (f64::from(found) - expected).abs() <= bound,
            "{what} {place}: {found}, expected {expected}"
        );
    }
}

pub(crate) fn machines() -> Vec<(Isa, Machine)> {
    let sets = Isa::available().into_iter();
    sets.map(|isa| (isa, Machine::with(isa).expect("available")))
        .collect()
}

pub(crate) fn batch_of(picture: Picture, border: usize, values: &[f32]) -> Planes {
    let mut planes = Planes::zeros(picture, border, values.len() / picture.len());
    for (position, values) in values.chunks_exact(picture.len()).enumerate() {
        planes.set(position, values);
    }
    planes
}

pub(crate) fn values(planes: &Planes, batch: usize) -> Vec<f32> {
    (0..batch)
        .flat_map(|position| planes.get(position))
        .collect()
}

/// Outputs, input gradients (written, then added once more) and weight gradients. The input gradient is omitted for a first convolution whose input channels do
/// not fill whole panels.
pub(crate) fn passes(case: &Case, machine: Machine, numbers: &Numbers) -> [Vec<f32>; 3] {
    let Case {
        convolution,
        input,
        batch,
    } = *case;
    let output = case.output();
    let pictures = batch_of(input, convolution.padding() + 1, &numbers.pictures);
    let mut weights = ConvolutionWeights::zeros(convolution);
    weights.set_plain(&numbers.weights);
    let gradient = batch_of(output, convolution.padding(), &numbers.gradients);

    let outputs = forward(&weights, &pictures, (machine, FORM));

    let tiles = TileRooms::default();
    let mut weight_gradient = Aligned::zeros(weights.values().len());
    let pass = WeightGradient::new(convolution, pictures.layout(), gradient.layout(), FORM);
    let rooms = Rooms {
        transformed: &mut Aligned::zeros(pass.transformed_len()),
        tiles: &tiles,
    };
    let into = &mut weight_gradient;
    pass.run(machine, &pictures, &gradient, batch, into, rooms);

    let mut input_gradient = Planes::zeros(input, 1, batch);
    if reads_panels(convolution) {
        let pass = InputGradient::new(
            convolution,
            gradient.layout(),
            input_gradient.layout(),
            FORM,
        );
        let mut room = Aligned::zeros(weights.values().len());
        let mut transformed = Aligned::zeros(pass.transformed_len());
        // Overwrites the old values, then adds to the new.
        input_gradient.first_mut(batch).fill(9.0);
        for onto in [Onto::Nothing, Onto::Sum] {
            let rooms = Rooms {
                transformed: &mut transformed,
                tiles: &tiles,
            };
            let into = GradientTarget::new(&mut input_gradient, onto);
            let pictures = Pictures {
                planes: &gradient,
                count: batch,
            };
            pass.run(machine, &weights, &mut room, pictures, into, rooms);
        }
    }
    [
        values(&outputs, batch),
        values(&input_gradient, batch),
        plain(convolution, &weight_gradient),
    ]
}

/// True if the input gradient is supported.
pub(crate) fn reads_panels(convolution: Convolution) -> bool {
    convolution.inputs.is_multiple_of(crate::panel::PANEL)
}

/// Outputs for the pictures, without bias.
pub(crate) fn forward(
    weights: &ConvolutionWeights,
    pictures: &Planes,
    how: (Machine, ConvolutionForm),
) -> Planes {
    finished(weights, pictures, Epilogue::Raw, how)
}

fn finished(
    weights: &ConvolutionWeights,
    pictures: &Planes,
    epilogue: Epilogue<'_>,
    (machine, form): (Machine, ConvolutionForm),
) -> Planes {
    let (convolution, input) = (weights.convolution(), pictures.layout());
    let batch = pictures.batch();
    let mut outputs = Planes::zeros(convolution.output(input.picture), 1, batch);
    let pass = Forward::new(convolution, input, outputs.layout(), form);
    let mut room = Aligned::zeros(pass.transformed_len());
    let source = Source {
        weights: pass.weights(machine, weights, &mut room),
        input: pictures,
        first: 0,
        count: batch,
    };
    let each = &mut vec![(); batch][..];
    let see = |(): &mut (), _: &[f32]| {};
    let rooms = TileRooms::default();
    let pictures = &mut outputs;
    let target = Target { pictures, epilogue };
    pass.run(machine, source, target, each, see, &rooms);
    outputs
}

#[test]
fn every_pass_agrees_with_its_definition() {
    for case in cases() {
        let convolution = case.convolution;
        let numbers = case.numbers();
        let [expected, twice, weight_gradient] = case.definition(&numbers);
        for (isa, machine) in machines() {
            let [outputs, inputs, rows] = passes(&case, machine, &numbers);
            let what = |pass| format!("{isa} {convolution:?} {pass}");
            let terms = convolution.taps() * convolution.inputs;
            assert_close(&outputs, &expected, terms, &what("output"));
            let terms = case.output().pixels() * case.batch;
            assert_close(&rows, &weight_gradient, terms, &what("gradient of weights"));
            if reads_panels(convolution) {
                let terms = 2 * convolution.taps() * convolution.outputs;
                assert_close(&inputs, &twice, terms, &what("gradient of the input"));
            }
        }
    }
}

#[test]
fn neither_the_number_of_threads_nor_the_width_of_vectors_changes_a_bit() {
    let bits = |values: [Vec<f32>; 3]| {
        values.map(|values| {
            values
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        })
    };
    for case in cases() {
        let numbers = case.numbers();
        let mut fused = Vec::new();
        for (isa, machine) in machines() {
            let with = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                pool.build()
                    .expect("threads")
                    .install(|| bits(passes(&case, machine, &numbers)))
            };
            let alone = with(1);
            for threads in [2, 3] {
                assert!(
                    with(threads) == alone,
                    "{isa} on {threads} threads: {:?}",
                    case.convolution
                );
            }
            if isa != Isa::Portable {
                fused.push(alone);
            }
        }
        assert!(
            fused.windows(2).all(|pair| pair[0] == pair[1]),
            "{:?}",
            case.convolution
        );
    }
}

#[test]
fn epilogues_add_bias_and_pictures_and_cut_at_zero() {
    let case = &cases()[2];
    let Case {
        convolution,
        input,
        batch,
    } = *case;
    let output = case.output();
    let pictures = batch_of(input, 1, &random(input.len() * batch, 1));
    let mut weights = ConvolutionWeights::zeros(convolution);
    weights.set_plain(&random(weights.values().len(), 2));
    let bias = Aligned::of(&random(output.channels, 4));
    let other_values = random(output.len() * batch, 5);
    let other = batch_of(output, 1, &other_values);
    for (isa, machine) in machines() {
        for form in [ConvolutionForm::Direct, ConvolutionForm::Winograd] {
            let pass = |epilogue| {
                let outputs = finished(&weights, &pictures, epilogue, (machine, form));
                values(&outputs, batch)
            };
            let raw = pass(Epilogue::Raw);
            let (plain, relu) = (pass(Epilogue::Bias(&bias)), pass(Epilogue::BiasRelu(&bias)));
            let sum = pass(Epilogue::BiasAddRelu(&bias, other.first(batch)));
            for place in 0..raw.len() {
                let biased = raw[place] + bias[place % output.channels];
                // Direct sums begin with the bias, so they round differently: once per term.
                assert!((plain[place] - biased).abs() < 2e-6, "{isa} {form}");
                assert_eq!(
                    relu[place].to_bits(),
                    plain[place].max(0.0).to_bits(),
                    "{isa} {form}"
                );
                let both = (plain[place] + other_values[place]).max(0.0);
                assert_eq!(sum[place].to_bits(), both.to_bits(), "{isa} {form}");
            }
        }
    }
}
