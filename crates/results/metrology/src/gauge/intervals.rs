//! 95 % confidence intervals of variance components and of their ratios.
//!
//! The intervals use the mean squares of the full model even for a pooled interaction, because intervals after a test are too short.

use taceva_core::random::Draws;
use taceva_core::whole_size;
use taceva_metrics::distributions::chi_square;

use super::GaugeSettings;
use super::anova::{Square, Squares, count, real};
use super::cells::Balanced;
use super::report::ComponentName;

/// Probability beyond each end of an interval.
const TAIL: f64 = 0.025;

/// Lower and upper end of an interval.
pub(super) type Ends = [f64; 2];

/// Mean square and its weight in a linear combination.
#[derive(Clone, Copy, Debug)]
struct Term {
    weight: f64,
    mean_square: f64,
    freedom: f64,
}

/// Interval of a variance with `freedom` degrees of freedom.
fn of_variance(variance: f64, freedom: f64) -> Ends {
    let end = |share| freedom * variance / chi_square::quantile(share, freedom);
    [end(1.0 - TAIL), end(TAIL)]
}

/// Interval of a sum of mean squares with positive weights, by the modified large-sample method.
///
/// # Reference
/// Graybill and Wang, Confidence intervals on nonnegative linear combinations of variances, JASA 75 (1980).
fn of_sum(terms: &[Term]) -> Ends {
    let (mut sum, mut below, mut above) = (0.0, 0.0, 0.0);
    for term in terms {
        let part = term.weight * term.mean_square;
        sum += part;
        let [low, high] = of_variance(part, term.freedom);
        below += (part - low) * (part - low);
        above += (high - part) * (high - part);
    }
    [(sum - below.sqrt()).max(0.0), sum + above.sqrt()]
}

/// Draws of one component or ratio.
pub(super) struct Drawn {
    values: Vec<f64>,
}

impl Drawn {
    /// Quantiles of both tails, with linear interpolation.
    fn ends(mut self) -> Ends {
        self.values.sort_by(f64::total_cmp);
        let last = self.values.len() - 1;
        let at = |share: f64| {
            let place = share * real(count(last));
            let low = whole_size(place).min(last);
            let (one, next) = (self.values[low], self.values[(low + 1).min(last)]);
            // Equal ends may be infinite.
            match next > one {
                true => one + (place - real(count(low))) * (next - one),
                false => one,
            }
        };
        [at(TAIL), at(1.0 - TAIL)]
    }
}

/// Confidence intervals of all variance components and ratios of a report.
pub(super) struct Intervals {
    /// Interval of the variance of each component.
    pub(super) variances: Vec<(ComponentName, Ends)>,
    /// Interval of the ratio of each component's standard deviation to the total.
    pub(super) shares: Vec<(ComponentName, Ends)>,
    pub(super) ndc: Ends,
}

/// Variance components of one draw.
struct Pivot {
    repeatability: f64,
    operator: f64,
    interaction: f64,
    reproducibility: f64,
    gauge: f64,
    part: f64,
}

impl Pivot {
    fn of(&self, name: ComponentName) -> f64 {
        match name {
            ComponentName::Repeatability => self.repeatability,
            ComponentName::Operator => self.operator,
            ComponentName::Interaction => self.interaction,
            ComponentName::Reproducibility => self.reproducibility,
            ComponentName::Gauge => self.gauge,
            ComponentName::Part => self.part,
            ComponentName::Total => self.gauge + self.part,
        }
    }
}

/// Mean squares of a study, each divided by a draw of χ² / ν.
///
/// # Reference
/// Weerahandi, Generalized confidence intervals, JASA 88 (1993); Hamada and Weerahandi, Journal of Quality Technology 32 (2000).
struct Pivots {
    squares: [Option<Term>; 4],
    draws: [Draws; 4],
    parts: f64,
    operators: f64,
    trials: f64,
}

fn term(square: &Square) -> Term {
    Term {
        weight: 1.0,
        mean_square: square.mean().to_f64(),
        freedom: real(square.df),
    }
}

impl Pivots {
    fn at(&self, counter: u64) -> Pivot {
        let drawn = |at: usize| {
            self.squares[at].map(|term| {
                let draw = chi_square::draw(self.draws[at], counter, term.freedom);
                term.freedom * term.mean_square / draw
            })
        };
        let [o, p, e] = [0, 1, 3].map(|at| drawn(at).unwrap_or_default());
        let r = self.trials;
        let of_operators = self.parts * r;
        match drawn(2) {
            Some(i) => {
                let sum = (o + (self.parts - 1.0) * i) / of_operators;
                Pivot {
                    repeatability: e,
                    operator: ((o - i) / of_operators).max(0.0),
                    interaction: ((i - e) / r).max(0.0),
                    reproducibility: (sum - e / r).max(0.0),
                    gauge: sum + (r - 1.0) * e / r,
                    part: ((p - i) / (self.operators * r)).max(0.0),
                }
            }
            None => {
                let operator = ((o - p) / of_operators).max(0.0);
                Pivot {
                    repeatability: e,
                    operator,
                    interaction: 0.0,
                    reproducibility: operator,
                    gauge: operator + e,
                    part: ((p - e) / r).max(0.0),
                }
            }
        }
    }
}

/// Intervals of the components `names`.
pub(super) fn intervals(
    squares: &Squares,
    study: &Balanced,
    settings: &GaugeSettings,
    names: &[ComponentName],
) -> Intervals {
    let interaction = squares.interaction.as_ref();
    let seed = Draws::new(settings.seed);
    let pivots = Pivots {
        squares: [
            Some(term(&squares.operator)),
            Some(term(&squares.part)),
            interaction.map(term),
            Some(term(&squares.repeatability)),
        ],
        draws: [0, 1, 2, 3].map(|source| seed.of(source)),
        parts: real(count(study.parts)),
        operators: real(count(study.operators)),
        trials: real(count(study.trials)),
    };
    let draws: Vec<Pivot> = (0..u64::from(settings.draws))
        .map(|at| pivots.at(at))
        .collect();
    let ends = |of: &dyn Fn(&Pivot) -> f64| {
        let values = draws.iter().map(of).collect();
        Drawn { values }.ends()
    };
    let error = term(&squares.repeatability);
    let variance = |name: ComponentName| match (name, interaction) {
        (ComponentName::Repeatability, _) => of_variance(error.mean_square, error.freedom),
        (ComponentName::Gauge, Some(interaction)) => {
            let (p, r) = (pivots.parts, pivots.trials);
            let weighted = |square: &Square, weight| Term {
                weight,
                ..term(square)
            };
            of_sum(&[
                weighted(&squares.operator, 1.0 / (p * r)),
                weighted(interaction, (p - 1.0) / (p * r)),
                weighted(&squares.repeatability, (r - 1.0) / r),
            ])
        }
        _ => ends(&|pivot| pivot.of(name)),
    };
    let share = |name: ComponentName| {
        ends(&|pivot| {
            let total = pivot.of(ComponentName::Total);
            match total > 0.0 {
                true => (pivot.of(name) / total).sqrt(),
                false => 0.0,
            }
        })
    };
    Intervals {
        variances: names.iter().map(|&name| (name, variance(name))).collect(),
        shares: names.iter().map(|&name| (name, share(name))).collect(),
        ndc: ends(&|pivot| match pivot.gauge > 0.0 {
            true => (2.0 * pivot.part / pivot.gauge).sqrt(),
            false => 0.0,
        }),
    }
}
