//! Coverage of the excess for errors that are equal everywhere, and for errors that differ between places.

use super::*;
use taceva_core::random::SplitMix64;

fn gaussian(random: &mut SplitMix64) -> f64 {
    (0..12).map(|_| random.unit()).sum::<f64>() - 6.0
}

/// Absolute errors of `clusters` places, each in one bin of distance and pressed `presses` times through as many bins of depth.
fn sizes(
    random: &mut SplitMix64,
    clusters: usize,
    presses: usize,
    trend: f64,
    spread: f64,
) -> [Vec<Vec<(u8, Moments)>>; 2] {
    let mut distance = Vec::new();
    let mut depth = Vec::new();
    for _ in 0..clusters {
        let own = 1.0 + spread * (2.0 * random.unit() - 1.0);
        let bin = u8::try_from(random.below(60)).expect("small");
        let mut of_distance = Moments::default();
        let mut of_depth = Vec::new();
        for press in 0..presses {
            let level = own * (1.0 + trend * f64::from(bin) / 60.0);
            let size = (level * gaussian(random)).abs();
            of_distance.add(size);
            let step = u8::try_from(10 * press).expect("small");
            of_depth.push((step, std::iter::once(size).collect::<Moments>()));
        }
        distance.push(vec![(bin, of_distance)]);
        depth.push(of_depth);
    }
    [distance, depth]
}

fn excess(clusters: &[Vec<(u8, Moments)>]) -> Excess {
    let clusters = clusters
        .iter()
        .map(|of| of.iter().map(|(bin, moments)| (*bin, moments)));
    let bins = ClusteredBins::of(clusters, 1).expect("finite");
    bins.excess().expect("bins")
}

#[test]
fn errors_that_are_equal_everywhere_are_called_uneven_in_at_most_5_percent_of_repeats() {
    const REPEATS: u64 = 600;
    for (clusters, presses) in [(20, 4), (46, 4), (60, 1), (64, 8)] {
        let (mut shown, mut each) = (0_u32, [0_u32, 0]);
        for repeat in 0..REPEATS {
            let mut random = SplitMix64::new(repeat << 20 | clusters as u64);
            let [distance, depth] = sizes(&mut random, clusters, presses, 0.0, 0.6);
            let mut axes = vec![excess(&distance)];
            if presses > 1 {
                axes.push(excess(&depth));
            }
            for (axis, count) in axes.iter().zip(&mut each) {
                *count += u32::from(axis.ends[0] > 0.0);
            }
            let both = Excess::mean_of(&axes).expect("two");
            shown += u32::from(both.ends[0] > 0.0);
        }
        // Three standard errors of 600 runs at 5 % are 2.7 %.
        assert!(
            f64::from(shown) <= 0.05 * 600.0 + 16.0,
            "{clusters} × {presses}: {shown} of {REPEATS}, {each:?}"
        );
    }
}

#[test]
fn errors_that_grow_with_the_distance_are_called_uneven() {
    let shown = (0..50).filter(|repeat| {
        let mut random = SplitMix64::new(*repeat);
        let [distance, _] = sizes(&mut random, 64, 10, 3.0, 0.0);
        excess(&distance).ends[0] > 0.0
    });
    let shown = shown.count();
    assert!(shown >= 25, "{shown} of 50");
}
