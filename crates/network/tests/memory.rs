//! Tests that too little memory is reported before any computation. They have their own program, because the limit applies to the whole process.

#![cfg(target_os = "linux")]

#[path = "common/draws.rs"]
mod draws;

use draws::{doubles, filled, singles};
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use taceva_network::{
    Architecture, Body, ConvolutionForm, Labels, NetworkError, Picture, PlainLayer, Pooling,
    Recipe, Samples, Trainer,
};

/// Bytes of the transformed weights from 512 channels to 512 at 36 points, with one unused panel after each point of each panel.
const TRANSFORMED: usize = 32 * 36 * (512 + 1) * 16 * 4;

/// Limits the memory of this process to its present size and `beside` more bytes.
fn limit(beside: usize) {
    let state = std::fs::read_to_string("/proc/self/status").expect("Linux has it");
    let size = state.lines().find_map(|line| line.strip_prefix("VmSize:"));
    let kib = size.expect("a size").trim().strip_suffix("kB");
    let kib: u64 = kib.expect("in kB").trim().parse().expect("a number");
    let current = Some(kib * 1024 + beside as u64);
    let maximum = getrlimit(Resource::As).maximum;
    setrlimit(Resource::As, Rlimit { current, maximum }).expect("below the maximum");
}

#[test]
fn transformed_weights_without_room_are_refused_with_their_bytes_and_no_other_form_is_taken() {
    let input = Picture {
        height: 3,
        width: 3,
        channels: 1,
    };
    let layer = PlainLayer {
        channels: 512,
        kernel: 3,
        stride: 1,
    };
    let architecture = Architecture {
        input,
        body: Body::Plain {
            layers: vec![layer; 2],
            pooling: Pooling::Average,
        },
        outputs: 2,
    };
    let network = filled(&architecture, 1);
    let (pictures, labels) = (singles(2, 4 * input.len()), doubles(3, 8));
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Values(&labels),
    };
    let recipe = Recipe {
        batch: 4,
        ..Recipe::default()
    };
    let mut direct = network.predictor_in(ConvolutionForm::Direct);
    let mut transformed = network.predictor();
    let mut found = [0.0; 8];
    // Threads start and allocate before memory is short.
    direct.predict(&pictures, &mut found).expect("room");

    // Leaves memory for other allocations, which are less than a quarter of the weights.
    limit(TRANSFORMED - (2 << 20));
    let short = NetworkError::Memory { bytes: TRANSFORMED };
    assert_eq!(
        transformed.predict(&pictures, &mut found),
        Err(short.clone())
    );
    direct.predict(&pictures, &mut found).expect("room");
    let refused = Trainer::of(network.clone(), &recipe, samples, None);
    assert_eq!(refused.map(|_| ()), Err(short));

    limit(1 << 30);
    transformed.predict(&pictures, &mut found).expect("room");
    let mut trainer = Trainer::of(network, &recipe, samples, None).expect("room");
    trainer.step().expect("finite");
}
