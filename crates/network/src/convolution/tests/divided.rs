//! Tests of the division of one picture among threads. Every division gives the same bits as the undivided pass, on every instruction set of the machine.

use super::super::division::Division;
use super::*;
use crate::panel::PANEL;

/// Test case of `batch` pictures with odd sides.
fn case(
    channels: [usize; 2],
    [kernel, stride]: [usize; 2],
    size: [usize; 2],
    batch: usize,
) -> Case {
    Case {
        convolution: Convolution {
            inputs: channels[0],
            outputs: channels[1],
            kernel,
            stride,
        },
        input: Picture {
            height: size[0],
            width: size[1],
            channels: channels[0],
        },
        batch,
    }
}

fn cases() -> Vec<Case> {
    vec![
        // One channel, and a number of panels that is not a multiple of four.
        case([1, 48], [7, 2], [61, 35], 1),
        case([16, 80], [3, 1], [23, 17], 1),
        case([64, 64], [3, 1], [13, 19], 1),
        case([64, 208], [3, 1], [5, 3], 1),
        case([128, 112], [3, 2], [9, 7], 1),
        case([256, 144], [1, 2], [9, 11], 1),
        case([320, 320], [3, 1], [2, 2], 1),
        // A map of 1 × 1.
        case([512, 528], [3, 1], [1, 1], 1),
        // Fewer pictures than threads.
        case([48, 96], [3, 1], [9, 14], 2),
        case([32, 64], [5, 1], [11, 6], 2),
    ]
}

const FORMS: [ConvolutionForm; 2] = [ConvolutionForm::Direct, ConvolutionForm::Winograd];
const THREADS: [usize; 4] = [2, 3, 5, 8];

fn on_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(work)
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn pictures_divided_among_threads_have_the_same_bits_under_every_epilogue_and_fused_isa() {
    for case in cases() {
        let Case {
            convolution, input, ..
        } = case;
        let output = case.output();
        let numbers = case.numbers();
        let pictures = batch_of(input, convolution.padding() + 1, &numbers.pictures);
        let mut weights = ConvolutionWeights::zeros(convolution);
        weights.set_plain(&numbers.weights);
        let bias = Aligned::of(&random(output.channels, 4));
        let other = batch_of(output, 1, &numbers.gradients);
        let epilogues = [
            Epilogue::Raw,
            Epilogue::Bias(&bias),
            Epilogue::BiasRelu(&bias),
            Epilogue::BiasAddRelu(&bias, other.first(case.batch)),
        ];
        for form in FORMS {
            for epilogue in epilogues {
                let mut fused = Vec::new();
                for (isa, machine) in machines() {
                    let with = |threads: usize| {
                        on_threads(threads, || {
                            let how = (machine, form);
                            let outputs = finished(&weights, &pictures, epilogue, how);
                            // Includes borders, which must stay zero.
                            bits(outputs.first(case.batch))
                        })
                    };
                    let alone = with(1);
                    for threads in THREADS {
                        let what = format!("{isa} {form} on {threads} threads: {case:?}");
                        assert!(with(threads) == alone, "{what}");
                    }
                    if isa != Isa::Portable {
                        fused.push(alone);
                    }
                }
                let mut pairs = fused.windows(2);
                assert!(pairs.all(|pair| pair[0] == pair[1]), "{form} {case:?}");
            }
        }
    }
}

#[test]
fn the_cases_are_divided_by_pixels_and_by_panels_in_both_forms() {
    for form in FORMS {
        let divisions = cases().into_iter().flat_map(|case| {
            let output = Planes::zeros(case.output(), 1, 1).layout();
            let input = batch_of(case.input, case.convolution.padding(), &[]).layout();
            let pass = Forward::new(case.convolution, input, output, form);
            let outputs = match (&pass, form) {
                (Forward::Direct(pass), ConvolutionForm::Direct) => {
                    Some(pass.outputs(case.output().channels / PANEL))
                }
                (Forward::Winograd(pass), _) => Some(pass.outputs()),
                // Direct in either form.
                _ => None,
            };
            let each = outputs.map(|outputs| THREADS.map(|threads| outputs.divided(threads)));
            each.into_iter().flatten()
        });
        let divisions: Vec<Division> = divisions.collect();
        let by_pixels = |division: &Division| matches!(division, Division::Pixels(2..));
        let by_panels = |division: &Division| matches!(division, Division::Panels(2..));
        assert!(divisions.iter().any(by_pixels), "{form}: {divisions:?}");
        assert!(divisions.iter().any(by_panels), "{form}: {divisions:?}");
    }
}
