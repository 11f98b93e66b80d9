//! Uniformity of the gel's compliance over its surface.

use taceva_core::{Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Intervals, Numbers};
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::evaluate::settings::Settings;
use crate::exact::Dyadic;
use crate::families::clustered_excess::{self, WithEnds};
use crate::families::surface::sums::{NORMAL_ONLY, SurfaceSums, contact};
use crate::families::surface::{SURFACE, SurfaceFormula};
use crate::score::direction::Better;
use crate::score::least::WELL_SAMPLED;
use crate::score::range::Range;
use crate::score::sensor_facts::Fact;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};
use crate::stats::components::ClusteredBins;
use crate::stats::spread::{Bin, Spread};

pub(crate) static UNIFORMITY: Metric = Metric {
    id: "uniformity",
    title: "uniformity of sensitivity",
    symbol: Some("$U$"),
    theme: Theme::Surface,
    better: Better::Higher,
    variants: &[("mean", Better::Described), ("deviation", Better::Lower)],
    unit: ScoreUnit::One,
    range: Range::Ratio,
    definition: "uniformity/2",
    reference: "TacEva, equation (6)",
    documentation: "Uniformity of the sensitivity of the gel: 1 / (1 + σ/|μ|) of the mean sensitivities of the cells of the footprint; 1 \
                    is the same everywhere. With few samples per cell, noise makes a uniform surface look uneven. `debiased` subtracts \
                    this noise, and verdicts use it. A surface that is not shown to differ between places takes part in no verdict. `n_min_5` \
                    omits cells with fewer than five samples, `normal_only` samples with shear; `mean` and `deviation` are μ and σ.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth))
        .with_channels(&["Px", "Py", "Pz", "Fz"])
        .with_least_samples(1),
    facts: &[Fact::Footprint],
    decided_by: Some(DEBIASED),
    chance: Some(1.0),
    formula: Formula(&SurfaceFormula {
        of: &["Px", "Py", "Pz", "Fz"],
        count: SurfaceSums::binned,
        finish: uniformity,
        of_clusters: Some(of_clusters),
        has_map: false,
    }),
    ..Metric::of(&SURFACE)
};

/// Name of the variant that decides verdicts.
const DEBIASED: &str = "debiased";

/// Uniformity 1 / (1 + σ/|μ|) of the compliance over cells of the surface. μ and σ are the mean and standard deviation of the cell means. Only
/// cells with at least `n_min` samples count.
fn uniformity(sums: &SurfaceSums, settings: &Settings) -> Numbers {
    let Settings { n_min, ddof, .. } = *settings;
    if let Err(reason) = contact(sums).and_then(|()| on_surface(sums)) {
        return Numbers::of(Err(reason));
    }
    let bins = |kind: usize| -> Vec<Bin> {
        let cells = sums.cells.values();
        cells.filter_map(|cell| Bin::of(&cell[kind])).collect()
    };
    let (bins, normal) = (bins(0), bins(1));
    let plain = |spread: &Spread| ratio(spread.mean()?, spread.deviation(ddof)?);
    let all = Spread::of(&bins, n_min);
    let debiased = all.mean().and_then(|mean| ratio(mean, all.excess()?));
    Numbers::of(plain(&all))
        .with(DEBIASED, Unit::One, Range::RatioWithEnds, debiased)
        .with(
            "n_min_5",
            Unit::One,
            Range::Ratio,
            plain(&Spread::of(&bins, WELL_SAMPLED)),
        )
        .with(
            NORMAL_ONLY,
            Unit::One,
            Range::Ratio,
            plain(&Spread::of(&normal, n_min)),
        )
        .with("mean", Unit::MillimetrePerNewton, Range::Any, all.mean())
        .with(
            "deviation",
            Unit::MillimetrePerNewton,
            Range::Positive,
            all.deviation(ddof),
        )
}

/// Debiased uniformity and its interval, or the reason why both are undefined.
fn of_clusters(clusters: &[&SurfaceSums], settings: &Settings) -> Intervals {
    let cells = clusters.iter().map(|sums| {
        let cells = sums.cells.iter();
        cells
            .filter(|(_, [all, _])| all.n > 0)
            .map(|(cell, [all, _])| (*cell, all))
    });
    let excess = ClusteredBins::of(cells, settings.n_min).and_then(|bins| bins.excess());
    let with_samples = clusters.iter().filter(|sums| !sums.cells.is_empty());
    clustered_excess::of_mean(
        DEBIASED,
        excess.map(|excess| vec![excess]),
        with_samples.count(),
        |excess| {
            let [low, high] = excess.ends;
            Ok(WithEnds {
                value: ratio(excess.mean, excess.value)?,
                ends: [ratio(excess.mean, high)?, ratio(excess.mean, low)?],
            })
        },
    )
}

fn on_surface(sums: &SurfaceSums) -> Result<(), UndefinedReason> {
    if sums.cells.is_empty() {
        return Err(UndefinedReason::OutsideFootprint);
    }
    Ok(())
}

/// Uniformity |μ| / (|μ| + σ) from the mean μ and standard deviation σ of compliances, rounded once.
fn ratio(mean: f64, deviation: f64) -> Finished {
    if !deviation.is_finite() {
        return Err(UndefinedReason::Overflow);
    }
    let mean = Dyadic::from_f64(mean.abs());
    let total = &mean + &Dyadic::from_f64(deviation);
    if total.is_zero() {
        return Err(UndefinedReason::ZeroMean);
    }
    Ok(mean.over(&total))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_mean_is_the_least_uniform_unless_nothing_varies() {
        assert_eq!(ratio(0.0, 1.0), Ok(0.0));
        assert_eq!(ratio(0.0, 0.0), Err(UndefinedReason::ZeroMean));
        assert_eq!(ratio(-3.0, 0.0), Ok(1.0));
        assert_eq!(ratio(1.0, 3.0), Ok(0.25));
    }
}
