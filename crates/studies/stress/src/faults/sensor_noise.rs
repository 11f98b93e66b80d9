//! Fault of pictures: noise of the camera.

use std::sync::LazyLock;

use taceva_core::single;
use taceva_metrics::distributions::normal;

use crate::canvas::{Canvas, Realisation};
use crate::fault::{Effect, Fault, Scope};

pub(super) static FAULT: Fault = Fault {
    id: "sensor_noise",
    title: "each pixel has Gaussian noise of its own",
    parameter: "standard deviation, share of full scale",
    scope: Scope::Each,
    table: [
        1.0 / 255.0,
        2.0 / 255.0,
        4.0 / 255.0,
        8.0 / 255.0,
        16.0 / 255.0,
    ],
    most: 0.5,
    note: None,
    effect: Effect::Numbers(apply),
};

/// Number of random bits that choose one of the tabulated values of the normal distribution.
const BITS: u32 = 12;
/// Number of tabulated values that one random word of 64 bits chooses.
const LEVELS_A_WORD: usize = 5;

/// Tabulated values of the standard normal distribution. All are equally probable.
static LEVELS: LazyLock<Vec<f32>> = LazyLock::new(|| {
    let count = 1_u16 << BITS;
    let share = |level: u16| (f64::from(level) + 0.5) / f64::from(count);
    let levels = (0..count).map(|level| single(normal::quantile(share(level))));
    levels.collect()
});

fn apply(canvas: &mut Canvas, drawn: &Realisation) {
    let deviation = drawn.parameter * canvas.full();
    let (levels, mask) = (&*LEVELS, (1_u64 << BITS) - 1);
    for (counter, values) in (0_u64..).zip(canvas.values.chunks_mut(LEVELS_A_WORD)) {
        let mut word = drawn.draws.bits(counter);
        for value in values {
            let level = usize::try_from(word & mask).expect("twelve bits");
            *value += deviation * levels[level];
            word >>= BITS;
        }
    }
}
