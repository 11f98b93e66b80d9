//! Detection limit of the normal force, from light presses.

mod limit;
mod sums;

use taceva_core::{Batch, Channel, Field, FieldSet, Needs, Unit};

use crate::evaluate::family::{Details, FamilyKind, Numbers, Output, erased};
use crate::evaluate::metric::{Metric, ScoreUnit};
use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::families::channelwise::{ByChannel, Channelwise, each_pair};
use crate::families::idle::GATE_N;
use crate::score::direction::Better;
use crate::score::range::Range;
use crate::score::theme::Theme;
use crate::score::value::{Finished, UndefinedReason};
use crate::score::{Count, Parameter};
use limit::{LEAST_PLACES, Limit};
use sums::{LightSums, Presses};

/// Greatest normal force of a light press, N: ten times the least force of contact.
const LIGHT_N: f64 = 0.2;

pub(crate) static DETECTION_LIMIT: Metric = Metric {
    id: "detection_limit",
    title: "detection limit of light presses",
    symbol: Some("$F_{\\mathrm{D}}$"),
    theme: Theme::Detail,
    better: Better::Lower,
    variants: &[
        ("least_force", Better::Described),
        ("greatest_force", Better::Described),
    ],
    unit: ScoreUnit::OfChannel,
    range: Range::Positive,
    definition: "detection_limit/1",
    reference: "ISO 11843-2, linear calibration, with one prediction for each press; Currie 1995, Pure and Applied Chemistry 67",
    documentation: "Least normal force that is distinguished from none with 5 % of false alarms and 5 % of misses, from light presses: those of \
                    0.02 N to 0.2 N of true Fz. It is δ (s / b) √(1 + (1 + x̄² / v) / g). A line of slope b fits predictions to true \
                    forces of mean x̄ and variance v; s is the standard deviation of predictions about it. Presses of one place count as \
                    alike: n presses, nᵢ of them at place i, are worth g = n² / Σ nᵢ² independent ones. s is estimated with g − 2 degrees \
                    of freedom, so δ is the factor of the noncentral t distribution, not 3.29. It applies to forces from `least_force` to \
                    `greatest_force`: it is never below the former, and undefined above the latter, for fewer than ten places, or if predictions do \
                    not rise with the force. `critical` is the force that zero exceeds in 5 % of cases. The \
                    interval leaves out one place at a time, above 64 places one of 32 groups of places; the interval is missing if a limit reaches \
                    down to the lightest press. Untouched pictures do not enter: see noise_equivalent_force.",
    needs: Needs::new(
        FieldSet::EMPTY
            .with(Field::Truth)
            .with(Field::Prediction)
            .with(Field::Point),
    )
    .with_channels(&["Fz"])
    .with_least_samples(LEAST_PLACES),
    forces_only: true,
    constants,
    ..Metric::of(&KIND)
};

/// Family of metrics computed from light presses, with a true force of 0.02 N to 0.2 N.
pub(crate) static KIND: FamilyKind = FamilyKind::new("taceva.light-presses/1", |plan| {
    erased(ByChannel::new(LightPresses, plan))
});

fn constants(_: Unit) -> Vec<Parameter> {
    let constant = |name, value| Parameter { name, value };
    vec![constant("gate", GATE_N), constant("light", LIGHT_N)]
}

/// Collects predicted and true forces of light presses.
pub(crate) struct LightPresses;

impl Channelwise for LightPresses {
    type Sums = LightSums;

    fn takes(&self, channel: &Channel) -> bool {
        channel.name() == "Fz" && channel.unit() == Unit::Newton
    }

    fn deposit(
        &mut self,
        sums: &mut LightSums,
        batch: &Batch,
        position: usize,
        rows: Option<&[u32]>,
    ) {
        let mut places = sums.places.of_batch(batch);
        each_pair(batch, position, rows, |row, pair| {
            if !pair.is_valid() {
                sums.n_invalid += 1;
            } else if (GATE_N..=LIGHT_N).contains(&pair.reference) {
                sums.line.add(pair);
                places.at(row, 0).merge(&Presses(1));
            }
        });
    }

    fn to_record(&self, sums: &LightSums) -> Record {
        sums.to_record()
    }

    fn read_record(&self, record: &Record) -> Result<LightSums, String> {
        LightSums::read_record(record)
    }

    fn count(&self, sums: &LightSums) -> u64 {
        sums.line.n
    }

    fn invalid(&self, sums: &LightSums) -> u64 {
        sums.n_invalid
    }

    fn numbers(&self, _metric: &Metric, output: &Output, sums: &LightSums) -> Numbers {
        let range = sums.line.range.ok_or(UndefinedReason::NoLightPresses);
        let limit = Limit::of(sums);
        numbers(limit, limit.map(|limit| limit.value), output.unit)
            .with(
                "least_force",
                output.unit,
                Range::Positive,
                range.map(|range| range.least),
            )
            .with(
                "greatest_force",
                output.unit,
                Range::Positive,
                range.map(|range| range.greatest),
            )
    }

    fn resampled(&self, _metric: &Metric, output: &Output, sums: &LightSums) -> Numbers {
        let none = Err(UndefinedReason::NoInterval);
        let limit = Limit::resampled(sums);
        let lightest = sums.line.range.map_or(0.0, |range| range.least);
        let value = limit.and_then(|limit| match limit.value < lightest {
            true => Err(UndefinedReason::AtLightestPress),
            false => Ok(limit.value),
        });
        let numbers = numbers(limit, value, output.unit);
        ["least_force", "greatest_force"]
            .into_iter()
            .fold(numbers, |numbers, name| {
                numbers.with(name, output.unit, Range::Positive, none)
            })
    }

    fn details(&self, _metric: &Metric, _output: &Output, parts: &[&LightSums]) -> Details {
        let places = parts.iter().map(|sums| sums.places.len()).max();
        Details {
            counts: vec![Count {
                name: "places",
                value: places.map_or(0, |places| places as u64),
            }],
            ..Details::default()
        }
    }
}

fn numbers(limit: Result<Limit, UndefinedReason>, value: Finished, unit: Unit) -> Numbers {
    Numbers::of(value).with(
        "critical",
        unit,
        Range::Positive,
        limit.map(|limit| limit.critical),
    )
}
