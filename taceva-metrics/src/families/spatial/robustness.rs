//! Variation of errors with distance from the sensor's axis and with depth.

use taceva_core::{Field, FieldSet, Needs, Unit};

use super::sums::SpatialSums;
use crate::evaluate::family::{Intervals, Numbers, midpoint};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::evaluate::settings::Settings;
use crate::exact::moments::Moments;
use crate::exact::sorted_map::SortedMap;
use crate::families::clustered_excess::{self, WithEnds};
use crate::families::spatial::KIND;
use crate::score::direction::Better;
use crate::score::least::WELL_SAMPLED;
use crate::score::range::Range;
use crate::score::sensor_facts::Fact;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::components::{ClusteredBins, Excess};
use crate::stats::spread::{Bin, Spread};

pub(crate) static R_SPATIAL: Metric = Metric {
    id: "r_spatial",
    title: "spatial robustness",
    symbol: Some("$R_{\\mathrm{spatial}}$"),
    theme: Theme::Robustness,
    better: Better::Lower,
    variants: &[("noise_floor", Better::Described)],
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "r_spatial/2",
    reference: "TacEva, equation (7)",
    documentation: "Variation of the mean absolute error between places: the mean of two standard deviations (over n): of the means of a hundred bins \
                    of distance from the axis, and of the means of a hundred bins of depth. Bins without samples do \
                    not count. Bins with few samples differ by chance; `noise_floor` is \
                    the size of that difference. `excess` is the variation beyond chance if samples of one contact point are dependent; \
                    verdicts use it. A score takes part in them only if its excess is shown to exceed 0. `n_min_5` omits bins with fewer \
                    than five samples. `smooth` uses the rolling mean that plots show. `within` is the other reading of the paper: the \
                    mean of the deviations within the bins.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth).with(Field::Prediction))
        .with_channels(&["Px", "Py", "Pz"])
        .with_least_samples(1),
    facts: &[Fact::Footprint, Fact::DepthMax],
    reads_unbounded: true,
    decided_by: Some(EXCESS),
    chance: Some(0.0),
    ..Metric::of(&KIND)
};

/// Name of the variant that decides verdicts: the variation of errors beyond chance.
pub(super) const EXCESS: &str = "excess";

/// Mean of two standard deviations: of the bin means over distance, and of the bin means over depth. Their divisor follows `settings.ddof`. All
/// variants except `std_distance` and `std_depth` are such means too.
pub(super) fn robustness(sums: &SpatialSums, settings: &Settings, unit: Unit) -> Numbers {
    if sums.n == 0 {
        let outside = sums.outside > 0;
        return Numbers::of(Err(if outside {
            UndefinedReason::OutsideFootprint
        } else {
            UndefinedReason::Empty
        }));
    }
    let bins = [&sums.distance, &sums.depth].map(|bins| -> Vec<Bin> {
        let bins = bins.values();
        bins.filter_map(Bin::of).collect()
    });
    let spread = |n_min: u64| [0, 1].map(|axis: usize| Spread::of(&bins[axis], n_min));
    let both = |spreads: &[Spread; 2], of: &dyn Fn(&Spread) -> Finished| {
        Ok(midpoint(of(&spreads[0])?, of(&spreads[1])?))
    };
    let deviation = |spread: &Spread| spread.deviation(settings.ddof);
    let paper = spread(settings.n_min);
    let smooth = [&bins[0], &bins[1]].map(|bins| {
        let means = smoothed(bins, settings);
        let least = settings.n_min;
        let deviation = means.deviation(u64::from(settings.ddof));
        deviation.ok_or(UndefinedReason::NoBin { least })
    });
    let [smooth_distance, smooth_depth] = smooth;
    let smooth = smooth_distance.and_then(|distance| Ok(midpoint(distance, smooth_depth?)));
    Numbers::of(both(&paper, &deviation))
        .with("std_distance", unit, Range::Positive, deviation(&paper[0]))
        .with("std_depth", unit, Range::Positive, deviation(&paper[1]))
        .with(
            "within",
            unit,
            Range::Positive,
            both(&paper, &Spread::within),
        )
        .with(
            "noise_floor",
            unit,
            Range::Positive,
            both(&paper, &Spread::noise_floor),
        )
        .with(
            EXCESS,
            unit,
            Range::NotNegative,
            both(&paper, &Spread::excess),
        )
        .with("smooth", unit, Range::Positive, smooth)
        .with(
            "n_min_5",
            unit,
            Range::Positive,
            both(&spread(WELL_SAMPLED), &deviation),
        )
}

/// Variation of errors beyond chance, with its interval, as a mean over the channels and over distance and depth. Each channel has the sums of
/// every contact point.
pub(super) fn of_clusters(channels: &[Vec<&SpatialSums>], settings: &Settings) -> Intervals {
    type Axis = fn(&SpatialSums) -> &SortedMap<u8, Moments>;
    let axes: [Axis; 2] = [|sums| &sums.distance, |sums| &sums.depth];
    let excess = |clusters: &Vec<&SpatialSums>, axis: Axis| {
        let of_cluster = clusters.iter().map(|sums| {
            let bins = axis(sums).iter();
            bins.map(|(bin, moments)| (*bin, moments))
        });
        ClusteredBins::of(of_cluster, settings.n_min)?.excess()
    };
    let all: Result<Vec<Excess>, UndefinedReason> = channels
        .iter()
        .flat_map(|clusters| axes.map(|axis| excess(clusters, axis)))
        .collect();
    let clusters = channels.iter().map(|clusters| {
        let with_samples = clusters.iter().filter(|sums| sums.n > 0);
        with_samples.count()
    });
    let clusters = clusters.min().unwrap_or_default();
    clustered_excess::of_mean(EXCESS, all, clusters, |excess| {
        Ok(WithEnds {
            value: excess.value,
            ends: excess.ends,
        })
    })
}

/// Moments of the rolling means over the bins with enough samples. Each mean is centred on a bin and rounded once. Near both ends it covers fewer
/// bins.
fn smoothed(bins: &[Bin], settings: &Settings) -> Moments {
    let bins = bins.iter().filter(|bin| bin.has(settings.n_min));
    let means: Vec<f64> = bins.map(|bin| bin.mean).collect();
    let reach = settings.smoothing_window as usize / 2;
    let windows = (0..means.len()).map(|centre| {
        let window = &means[centre.saturating_sub(reach)..means.len().min(centre + reach + 1)];
        window.iter().copied().collect::<Moments>()
    });
    windows.filter_map(|window| window.mean()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rolling_mean_is_cut_off_at_the_ends() {
        let bin = |mean: f64| Bin::of(&std::iter::once(mean).collect());
        let bins: Vec<Bin> = [0.0, 3.0, 6.0].into_iter().filter_map(bin).collect();
        let settings = Settings {
            smoothing_window: 3,
            ..Settings::default()
        };
        let means = smoothed(&bins, &settings);
        // 1.5, 3, 4.5
        assert_eq!(
            (means.n, means.mean(), means.variance(0)),
            (3, Some(3.0), Some(1.5))
        );
    }
}
