//! Tests that `TACEVA_ISA` and the number of threads change no bit of a training or prediction, if the instruction set has fused multiply-add.

use std::process::Command;

use crate::common::tiles::{picture, same_size};
use crate::draws::{doubles, filled, singles};
use taceva_network::{Architecture, ConvolutionForm, Depth, Isa, Labels, Recipe, Samples, Trainer};

/// FNV-1a hash of numbers.
fn digest(numbers: impl Iterator<Item = u64>) -> u64 {
    numbers.fold(0xcbf2_9ce4_8422_2325, |digest, number| {
        (digest ^ number).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Digest of the bits of predictions for one picture of odd sizes, in every form, on 1, 2 and 3 threads.
fn predicted() -> [u64; 3] {
    let input = picture(51, 45, 1);
    let network = filled(&Architecture::residual(Depth::Ten, input, 3), 9);
    let alone = singles(3, input.len());
    ConvolutionForm::ALL.map(|form| {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("threads").install(|| {
                let mut found = [0.0; 3];
                let mut predictor = network.predictor_in(form);
                predictor.predict(&alone, &mut found).expect("finite");
                digest(found.iter().map(|value| value.to_bits()))
            })
        };
        let one = with(1);
        assert_eq!([with(2), with(3)], [one; 2], "{form}");
        one
    })
}

/// Prints a digest of all weights of two trainings in every form, on 1, 2 and 3 threads.
#[test]
#[ignore = "run for each instruction set by the other test"]
#[expect(clippy::print_stdout, reason = "read by the other test")]
fn digests() {
    println!("instructions: {}", Isa::detect());
    let input = picture(21, 18, 1);
    let (pictures, labels) = (singles(3, 12 * input.len()), doubles(4, 24));
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Values(&labels),
    };
    let recipe = Recipe {
        epochs: 2,
        batch: 5,
        ..Recipe::default()
    };
    for predicted in predicted() {
        println!("digest of a prediction {predicted:016x}");
    }
    let residual = Architecture::residual(Depth::Ten, input, 2);
    for architecture in [residual, same_size(input, [16, 48, 80])] {
        for form in ConvolutionForm::ALL {
            let with = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                pool.build().expect("threads").install(|| {
                    let trainer = Trainer::new(&architecture, &recipe, samples, Some(samples));
                    let trainer = trainer.expect("a training").in_form(form).expect("room");
                    let trained = trainer.run().expect("finite");
                    let tensors = trained.network.tensors();
                    let values = tensors.iter().flat_map(|tensor| &tensor.values);
                    (
                        digest(values.map(|value| u64::from(value.to_bits()))),
                        trained.state,
                    )
                })
            };
            let alone = with(1);
            for threads in [2, 3] {
                assert!(with(threads) == alone, "{form} on {threads} threads");
            }
            println!("digest {form} {:016x}", alone.0);
        }
    }
}

#[test]
fn trainings_and_predictions_have_the_same_bits_under_every_fused_taceva_isa_and_on_1_2_or_3_threads()
 {
    let program = std::env::current_exe().expect("this program");
    let sets = Isa::available();
    let runs = sets.into_iter().map(|isa| {
        let mut command = Command::new(&program);
        command.args([
            "--exact",
            "instructions::digests",
            "--ignored",
            "--nocapture",
        ]);
        let output = command.env("TACEVA_ISA", isa.name()).output();
        let output = output.expect("this program runs");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{isa}: {text}");
        // Output of the test harness may precede it.
        assert!(text.contains(&format!("instructions: {isa}")), "{text}");
        let lines = text.lines().filter(|line| line.contains("digest "));
        let digests: Vec<String> = lines.map(str::to_owned).collect();
        assert_eq!(digests.len(), 9, "{isa}: {text}");
        (isa, digests)
    });
    let fused: Vec<_> = runs.filter(|(isa, _)| *isa != Isa::Portable).collect();
    for pair in fused.windows(2) {
        assert_eq!(pair[0].1, pair[1].1, "{} and {}", pair[0].0, pair[1].0);
    }
    for (isa, digests) in &fused {
        let [
            direct,
            mixed,
            winograd,
            trained_direct,
            _,
            trained_winograd,
            ..,
        ] = &digests[..]
        else {
            panic!("{isa}: {digests:?}");
        };
        let predicted = [(direct, mixed), (mixed, winograd), (winograd, direct)];
        for (one, other) in [&predicted[..], &[(trained_direct, trained_winograd)]].concat() {
            assert_ne!(one, other, "{isa}: forms round differently");
        }
    }
}
