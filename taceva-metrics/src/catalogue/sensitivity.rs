//! Compliance of the gel. A more compliant gel is not necessarily better, so neither high nor low scores are good.

use taceva_core::{Field, FieldSet, Needs, Unit};

use crate::evaluate::family::Numbers;
use crate::evaluate::metric::{Formula, Metric, ScoreUnit};
use crate::exact::Dyadic;
use crate::families::surface::sums::{NORMAL_ONLY, SurfaceSums, Total, contact};
use crate::families::surface::{SURFACE, SurfaceFormula};
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};

pub(crate) static SENSITIVITY: Metric = Metric {
    id: "sensitivity",
    title: "sensitivity",
    symbol: Some("$S$"),
    theme: Theme::Surface,
    better: Better::Described,
    unit: ScoreUnit::Fixed(Unit::MillimetrePerNewton),
    range: Range::Any,
    definition: "sensitivity/1",
    reference: "TacEva, equation (5)",
    documentation: "Indentation of the gel per newton of normal force: the mean of indentation over force of all samples in contact, \
                    with or without shear. The score is descriptive: a softer gel yields more, but is not better. `slope` is the slope \
                    of indentation over force through the origin, in which light presses weigh less. `normal_only` omits samples \
                    with shear; `map` is the mean in each cell of the footprint.",
    needs: Needs::new(FieldSet::EMPTY.with(Field::Truth))
        .with_channels(&["Pz", "Fz"])
        .with_least_samples(1),
    formula: Formula(&SurfaceFormula {
        of: &["Pz", "Fz"],
        count: |sums| sums.compliance.n,
        finish: |sums, _| sensitivity(sums),
        of_clusters: None,
        has_map: true,
    }),
    ..Metric::of(&SURFACE)
};

/// Mean compliance Δz / F over the samples in contact, mm/N: indentation Δz over normal force F. The variant `slope` is Σ Δz F / Σ F².
fn sensitivity(sums: &SurfaceSums) -> Numbers {
    let unit = Unit::MillimetrePerNewton;
    let slope = contact(sums).map(|()| {
        let forces = sums.force_squares.to_dyadic();
        sums.work.to_dyadic().over(&forces)
    });
    Numbers::of(contact(sums).and_then(|()| mean(&sums.compliance)))
        .with("slope", unit, Range::Any, slope)
        .with(NORMAL_ONLY, unit, Range::Any, mean(&sums.normal))
}

fn mean(total: &Total) -> Finished {
    if total.n == 0 {
        return Err(UndefinedReason::Empty);
    }
    Ok(total.sum.to_dyadic().over(&Dyadic::from(total.n)))
}
