//! The paper's calibration protocol on the bench: uniformly drawn points with four depths each, every depth pressed without and with shear.

use taceva_sim::random::{Purpose, Random};
use taceva_sim::{Bench, Label, Model, Press};

pub(crate) const POINTS: u64 = 800;
pub(crate) const SEEDS: [u64; 3] = [1, 2, 3];
const DEPTHS: u64 = 4;

/// Labels of one run: unit 0, with rig noise and draws of `seed`.
pub(crate) fn labels(model: Model, seed: u64) -> Vec<Label> {
    let bench = Bench::new(model.parameters(), 0, seed);
    let mut labels = Vec::new();
    for press in presses(model, seed) {
        let contact = bench.press(&press).expect("draws lie within the limits");
        labels.push(bench.label(&press, &contact));
    }
    labels
}

/// Presses of one run.
pub(crate) fn presses(model: Model, seed: u64) -> Vec<Press> {
    let parameters = model.parameters();
    let (outline, probing) = (parameters.outline(), parameters.probing);
    let random = Random::new(seed);
    let mut presses = Vec::new();
    for point in 0..POINTS {
        let draws = random.stream(Purpose::Draws, point);
        let place_mm = outline.place(draws.uniform(0), draws.uniform(1));
        for depth in 0..DEPTHS {
            let index = 2 + 3 * depth;
            let depth_mm = draws.between(index, probing.depth_min_mm, probing.depth_max_mm);
            let shear = [1, 2].map(|axis| {
                draws.between(index + axis, -probing.shear_max_mm, probing.shear_max_mm)
            });
            for (sheared, shear_mm) in [[0.0; 2], shear].into_iter().enumerate() {
                presses.push(Press {
                    id: 2 * (DEPTHS * point + depth) + sheared as u64,
                    point,
                    place_mm,
                    depth_mm,
                    shear_mm,
                    ..Press::default()
                });
            }
        }
    }
    presses
}
