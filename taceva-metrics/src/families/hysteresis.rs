//! Hysteresis: share of the work of loading that unloading does not recover.

mod branches;
mod loops;
mod press;

use taceva_core::{Field, FieldSet, Needs, Unit};

use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::families::hysteresis::loops::KIND;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;

pub(crate) static HYSTERESIS: Metric = Metric {
    id: "hysteresis",
    title: "hysteresis area",
    symbol: Some("hysteresis"),
    theme: Theme::Robustness,
    better: Better::Lower,
    variants: &[("signed_area", Better::NearZero)],
    unit: ScoreUnit::Fixed(Unit::NewtonMillimetre),
    range: Range::Positive,
    definition: "hysteresis/1",
    reference: "TacEva, project page",
    documentation: "Area between the curves of force over depth of loading and unloading, averaged over points; 1 N mm is 1 mJ. At each \
                    point, the branches are sorted by depth, forces at equal depths averaged, and the depths that both reach compared. \
                    Both branches are interpolated linearly; where they cross, the area is split. `signed_area` counts stretches as \
                    negative where the force of unloading is greater. `ratio` is the area over the work of loading. \
                    `greatest_difference` is the greatest distance of the branches as a share of full scale, the greatest force of \
                    loading. `map` is the area by place.",
    needs: Needs::new(
        FieldSet::EMPTY
            .with(Field::Truth)
            .with(Field::Phase)
            .with(Field::Point),
    )
    .with_channels(&["Pz", "Fz"])
    .with_least_samples(4),
    ..Metric::of(&KIND)
};
