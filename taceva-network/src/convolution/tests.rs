//! Every pass against a plain implementation in double precision, on every instruction set of the machine.

use taceva_core::Isa;

use super::*;
use crate::machine::Machine;
use crate::panel::Aligned;
use crate::planes::Planes;
use taceva_core::random::Draws;

fn random(length: usize, seed: u64) -> Vec<f32> {
    let draws = Draws::new(seed);
    #[expect(
        clippy::cast_possible_truncation,
        reason = "inputs of single precision"
    )]
    let values = (0..length as u64).map(|at| (draws.unit(at) - 0.5) as f32);
    values.collect()
}

/// Every pair of an output pixel and channel with an input and the weight between: the definition of a convolution.
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

struct Case {
    convolution: Convolution,
    input: Picture,
    batch: usize,
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
        // So many weights that the passes go in rounds.
        case(320, 320, 3, 1, 2, 3, 2),
    ]
}

/// The first relative difference above what sums of `terms` products in single precision explain.
fn assert_close(found: &[f32], expected: &[f64], terms: usize, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (place, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        // Products are below 1/4; rounding errors of a random walk of sums, ten standard deviations of them.
        let bound = 10.0 * f64::from(f32::EPSILON) * terms as f64 / 12.0;
        assert!(
            (f64::from(found) - expected).abs() <= bound,
            "{what} {place}: {found}, expected {expected}"
        );
    }
}

fn machines() -> Vec<(Isa, Machine)> {
    let sets = Isa::available().into_iter();
    sets.map(|isa| (isa, Machine::with(isa).expect("available")))
        .collect()
}

fn batch_of(picture: Picture, border: usize, values: &[f32]) -> Planes {
    let mut planes = Planes::zeros(picture, border, values.len() / picture.len());
    for (position, values) in values.chunks_exact(picture.len()).enumerate() {
        planes.set(position, values);
    }
    planes
}

fn values(planes: &Planes, batch: usize) -> Vec<f32> {
    (0..batch)
        .flat_map(|position| planes.get(position))
        .collect()
}

/// Outputs, gradients of the input and gradients of the weights.
fn passes(case: &Case, machine: Machine) -> [Vec<f32>; 3] {
    let Case {
        convolution,
        input,
        batch,
    } = *case;
    let output = convolution.output(input);
    let pictures = batch_of(
        input,
        convolution.padding() + 1,
        &random(input.len() * batch, 1),
    );
    let mut weights = ConvolutionWeights::zeros(convolution);
    weights.set_plain(&random(weights.values().len(), 2));
    let gradient = batch_of(
        output,
        convolution.padding(),
        &random(output.len() * batch, 3),
    );

    let mut outputs = Planes::zeros(output, 1, batch);
    Forward::new(convolution, pictures.layout(), outputs.layout()).run(
        machine,
        Source {
            weights: &weights,
            input: &pictures,
            first: 0,
            count: batch,
        },
        &mut outputs,
        Epilogue::Raw,
        (&mut vec![(); batch], |(), _: &[f32]| {}),
    );

    let mut weight_gradient = Aligned::zeros(weights.values().len());
    WeightGradient::new(convolution, pictures.layout(), gradient.layout()).run(
        machine,
        &pictures,
        &gradient,
        batch,
        &mut weight_gradient,
    );

    let mut input_gradient = Planes::zeros(input, 1, batch);
    if convolution.inputs % crate::panel::PANEL == 0 {
        let pass = InputGradient::new(convolution, gradient.layout(), input_gradient.layout());
        let mut room = Aligned::zeros(weights.values().len());
        // What lies there is overwritten, and then added to.
        input_gradient.first_mut(batch).fill(9.0);
        for onto in [Onto::Nothing, Onto::Sum] {
            let into = (&mut input_gradient, onto);
            pass.run(machine, &weights, (&gradient, batch), &mut room, into);
        }
    }
    [
        values(&outputs, batch),
        values(&input_gradient, batch),
        plain(convolution, &weight_gradient),
    ]
}

#[test]
fn every_pass_agrees_with_its_definition() {
    for case in cases() {
        let Case {
            convolution,
            input,
            batch,
        } = case;
        let output = convolution.output(input);
        let weights = random(
            convolution.inputs * convolution.outputs * convolution.taps(),
            2,
        );
        let pictures = random(input.len() * batch, 1);
        let gradients = random(output.len() * batch, 3);
        let mut expected = vec![0.0; output.len() * batch];
        let mut input_gradient = vec![0.0; input.len() * batch];
        let mut weight_gradient = vec![0.0; weights.len()];
        for image in 0..batch {
            let (to_image, from_image) = (image * output.len(), image * input.len());
            for_each_product(convolution, input, |to, from, weight| {
                let [number, gradient, factor] = [
                    pictures[from_image + from],
                    gradients[to_image + to],
                    weights[weight],
                ]
                .map(f64::from);
                expected[to_image + to] += number * factor;
                input_gradient[from_image + from] += gradient * factor;
                weight_gradient[weight] += number * gradient;
            });
        }
        for (isa, machine) in machines() {
            let [outputs, inputs, rows] = passes(&case, machine);
            let what = |pass| format!("{isa} {convolution:?} {pass}");
            let terms = convolution.taps() * convolution.inputs;
            assert_close(&outputs, &expected, terms, &what("output"));
            let terms = output.pixels() * batch;
            assert_close(&rows, &weight_gradient, terms, &what("gradient of weights"));
            if convolution.inputs % crate::panel::PANEL == 0 {
                let twice: Vec<f64> = input_gradient.iter().map(|value| 2.0 * value).collect();
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
        let mut fused = Vec::new();
        for (isa, machine) in machines() {
            let with = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                pool.build()
                    .expect("threads")
                    .install(|| bits(passes(&case, machine)))
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
    let output = convolution.output(input);
    let pictures = batch_of(input, 1, &random(input.len() * batch, 1));
    let mut weights = ConvolutionWeights::zeros(convolution);
    weights.set_plain(&random(weights.values().len(), 2));
    let bias = Aligned::of(&random(output.channels, 4));
    let other_values = random(output.len() * batch, 5);
    let other = batch_of(output, 1, &other_values);
    for (isa, machine) in machines() {
        let [raw, ..] = passes(case, machine);
        let pass = |epilogue| {
            let mut outputs = Planes::zeros(output, 1, batch);
            Forward::new(convolution, pictures.layout(), outputs.layout()).run(
                machine,
                Source {
                    weights: &weights,
                    input: &pictures,
                    first: 0,
                    count: batch,
                },
                &mut outputs,
                epilogue,
                (&mut vec![(); batch], |(), _: &[f32]| {}),
            );
            values(&outputs, batch)
        };
        let (plain, relu) = (pass(Epilogue::Bias(&bias)), pass(Epilogue::BiasRelu(&bias)));
        let sum = pass(Epilogue::BiasAddRelu(&bias, other.first(batch)));
        for place in 0..raw.len() {
            let biased = raw[place] + bias[place % output.channels];
            // The bias is where sums begin, so that roundings differ: as many as there are terms.
            assert!((plain[place] - biased).abs() < 2e-6, "{isa}");
            assert_eq!(
                relu[place].to_bits(),
                plain[place].max(0.0).to_bits(),
                "{isa}"
            );
            let both = (plain[place] + other_values[place]).max(0.0);
            assert_eq!(sum[place].to_bits(), both.to_bits(), "{isa}");
        }
    }
}
