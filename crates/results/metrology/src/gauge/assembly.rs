//! Assembles reports from variance components, intervals and remarks.

use taceva_core::whole_count;
use taceva_metrics::Fraction;

use super::anova::{Raw, Squares};
use super::cells::Balanced;
use super::intervals::{Intervals, intervals};
use super::range::estimate;
use super::report::{
    Band, Component, ComponentName, Flag, GaugeReport, IntervalMethod, Ndc, NdcReason, SCHEMA,
};
use super::{Design, GaugeSettings, Method, RangeConstants};

/// Reports on fewer operators than this warn of few degrees of freedom.
const FEW_OPERATORS: usize = 5;
/// Number of standard deviations that AIAG compares with the tolerance.
const SPAN: f64 = 6.0;

/// Estimate of one variance component.
struct Estimate {
    name: ComponentName,
    raw: Option<f64>,
    variance: f64,
    sd: f64,
    /// Share of the total variance, and ratio to the total standard deviation; `None` without variation.
    shares: Option<[f64; 2]>,
}

pub(super) fn assemble(study: &Balanced, settings: &GaugeSettings) -> GaugeReport {
    let squares = Squares::of(study, settings.design);
    let anova = squares.components(study, settings);
    let mut flags = Vec::new();
    if study.operators < FEW_OPERATORS {
        flags.push(Flag::FewOperators {
            operators: study.operators,
        });
    }
    if study.dropped > 0 {
        flags.push(Flag::Dropped {
            parts: study.dropped,
        });
    }
    let is_range = settings.method == Method::Range;
    let estimates = match is_range {
        true => by_range(study),
        false => {
            let of_interaction = anova
                .table
                .iter()
                .find(|row| row.source == super::Source::Interaction)
                .and_then(|row| row.p);
            if let (true, Some(p)) = (anova.is_pooled, of_interaction) {
                flags.push(Flag::Pooled {
                    p,
                    above: settings.pool,
                });
            }
            by_anova(&anova.raw)
        }
    };
    for estimate in &estimates {
        if let Some(variance) = estimate.raw.filter(|raw| *raw < 0.0) {
            flags.push(Flag::NegativeComponent {
                component: estimate.name,
                variance,
            });
        }
    }
    let names: Vec<ComponentName> = estimates.iter().map(|one| one.name).collect();
    let of_name = |name| estimates.iter().find(|one| one.name == name);
    let is_varied = |name| of_name(name).is_some_and(|one| one.variance > 0.0);
    let (total, gauge) = (
        is_varied(ComponentName::Total),
        is_varied(ComponentName::Gauge),
    );
    if !total {
        flags.push(Flag::NoVariation);
    }
    let intervals = intervals(&squares, study, settings, &names);
    let sd = |name| of_name(name).map_or(0.0, |one| one.sd);
    let value = std::f64::consts::SQRT_2 * sd(ComponentName::Part) / sd(ComponentName::Gauge);
    let undefined = match (settings.are_errors, total, gauge) {
        (true, ..) => Some(NdcReason::Errors),
        (false, true, true) => None,
        (false, false, _) => Some(NdcReason::NoVariation),
        (false, true, false) => Some(NdcReason::NoGaugeVariation),
    };
    let components: Vec<Component> = estimates
        .iter()
        .map(|one| component(one, settings, &intervals))
        .collect();
    let is_gauge = |one: &&Component| one.name == ComponentName::Gauge && !settings.are_errors;
    let of_gauge = components.iter().find(is_gauge);
    GaugeReport {
        schema: SCHEMA.to_owned(),
        design: settings.design,
        method: settings.method,
        unit: settings.unit.clone(),
        parts: study.parts,
        operators: study.operators,
        trials: study.trials,
        dropped: study.dropped,
        band: of_gauge.and_then(|one| one.percent_study).map(Band::of),
        band_ci95: of_gauge
            .and_then(|one| one.percent_study_ci95)
            .map(|ends| ends.map(Band::of)),
        table: anova.table,
        pooled: anova.is_pooled && !is_range,
        components,
        tolerance: settings.tolerance,
        ndc: match undefined {
            Some(_) => Ndc {
                value: None,
                floor: None,
                ci95: None,
                undefined,
            },
            None => Ndc {
                value: Some(value),
                floor: Some(whole(value)),
                ci95: Some(intervals.ndc),
                undefined,
            },
        },
        draws: settings.draws,
        seed: settings.seed,
        flags,
    }
}

fn whole(value: f64) -> u64 {
    whole_count(value.floor())
}

/// Components by analysis of variance. Negative estimates become 0.
fn by_anova(raw: &Raw) -> Vec<Estimate> {
    let repeatability = raw.repeatability.at_least_zero();
    let operator = raw.operator.at_least_zero();
    let interaction = raw.interaction.as_ref().map(Fraction::at_least_zero);
    let part = raw.part.at_least_zero();
    let reproducibility = match &interaction {
        Some(interaction) => operator.plus(interaction),
        None => operator.clone(),
    };
    let gauge = reproducibility.plus(&repeatability);
    let total = gauge.plus(&part);
    let estimate = |name, raw: Option<&Fraction>, variance: &Fraction| Estimate {
        name,
        raw: raw.map(Fraction::to_f64),
        variance: variance.to_f64(),
        sd: variance.root(),
        shares: variance
            .over(&total)
            .zip(variance.root_over(&total))
            .map(|(variance, sd)| [variance, sd]),
    };
    let mut all = vec![
        estimate(
            ComponentName::Repeatability,
            Some(&raw.repeatability),
            &repeatability,
        ),
        estimate(ComponentName::Operator, Some(&raw.operator), &operator),
    ];
    if let Some(interaction) = &interaction {
        all.push(estimate(
            ComponentName::Interaction,
            raw.interaction.as_ref(),
            interaction,
        ));
    }
    all.extend([
        estimate(ComponentName::Reproducibility, None, &reproducibility),
        estimate(ComponentName::Gauge, None, &gauge),
        estimate(ComponentName::Part, Some(&raw.part), &part),
        estimate(ComponentName::Total, None, &total),
    ]);
    all
}

/// Components by the range method, which does not separate the interaction.
fn by_range(study: &Balanced) -> Vec<Estimate> {
    let constants = RangeConstants::of(study.parts, study.operators, study.trials);
    let found = estimate(study, &constants);
    let estimate = |name, sd: f64| Estimate {
        name,
        raw: None,
        variance: sd * sd,
        sd,
        shares: (found.total > 0.0).then(|| {
            let share = sd / found.total;
            [share * share, share]
        }),
    };
    vec![
        estimate(ComponentName::Repeatability, found.equipment),
        estimate(ComponentName::Reproducibility, found.appraiser),
        estimate(ComponentName::Gauge, found.gauge),
        estimate(ComponentName::Part, found.part),
        estimate(ComponentName::Total, found.total),
    ]
}

fn component(of: &Estimate, settings: &GaugeSettings, intervals: &Intervals) -> Component {
    let ends = |all: &[(ComponentName, [f64; 2])]| {
        let found = all.iter().find(|(name, _)| *name == of.name);
        found.map_or([0.0; 2], |(_, ends)| *ends)
    };
    let ci95 = ends(&intervals.variances).map(f64::sqrt);
    let shares = ends(&intervals.shares);
    let of_tolerance = |sd: f64| settings.tolerance.map(|width| 100.0 * SPAN * sd / width);
    let is_crossed = settings.design == Design::Crossed;
    Component {
        name: of.name,
        variance_raw: of.raw,
        variance: of.variance,
        sd: of.sd,
        ci95,
        interval: match of.name {
            ComponentName::Repeatability => IntervalMethod::ChiSquare,
            ComponentName::Gauge if is_crossed => IntervalMethod::ModifiedLargeSamples,
            _ => IntervalMethod::Generalized,
        },
        percent_contribution: of.shares.map(|[variance, _]| 100.0 * variance),
        percent_study: of.shares.map(|[_, sd]| 100.0 * sd),
        percent_study_ci95: of.shares.map(|_| shares.map(|share| 100.0 * share)),
        percent_tolerance: of_tolerance(of.sd),
        percent_tolerance_ci95: of_tolerance(ci95[0])
            .zip(of_tolerance(ci95[1]))
            .map(|(low, high)| [low, high]),
    }
}
