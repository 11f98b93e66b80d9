//! Propagation of distributions by random draws, JCGM 101.

use serde::{Deserialize, Serialize};
use taceva_core::random::{Draws, open_unit};
use taceva_core::{whole_count, whole_size};

use super::correlation::Correlations;
use super::digits::tolerance;
use super::expression::Expression;
use super::freedom::Freedom;
use super::input::Input;
use taceva_metrics::distributions::{chi_square, normal};

/// Number of draws in a block.
const BLOCK: u64 = 10_000;
/// Least number of blocks before drawing may stop early.
const LEAST_BLOCKS: usize = 10;
/// Stream numbers: an input's index, plus this offset for correlated normal numbers, or plus `FACTOR` for Student factors.
const JOINT: u64 = 1 << 32;
const FACTOR: u64 = 1 << 33;

/// Request for a Monte Carlo check of a budget.
///
/// Draws are computed in blocks of 10⁴. Each draw depends only on seed, source and counter.
///
/// ```
/// use taceva_metrology::budget::MonteCarlo;
/// let all = MonteCarlo::default().with_draws(200_000).with_seed(7).to_the_end();
/// assert_eq!(all.seed, 7);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct MonteCarlo {
    /// Greatest number of draws, rounded up to whole blocks.
    pub draws: u64,
    /// Seed of the random draws.
    pub seed: u64,
    /// True to stop drawing once two digits of the standard uncertainty are stable, JCGM 101, 7.9.
    pub is_adaptive: bool,
}

impl Default for MonteCarlo {
    fn default() -> MonteCarlo {
        MonteCarlo {
            draws: 1_000_000,
            seed: 1,
            is_adaptive: true,
        }
    }
}

impl MonteCarlo {
    /// The same request with another greatest number of draws.
    #[must_use]
    pub fn with_draws(self, draws: u64) -> MonteCarlo {
        MonteCarlo { draws, ..self }
    }

    /// The same request with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> MonteCarlo {
        MonteCarlo { seed, ..self }
    }

    /// The same request with all draws, without stopping early.
    #[must_use]
    pub fn to_the_end(self) -> MonteCarlo {
        MonteCarlo {
            is_adaptive: false,
            ..self
        }
    }
}

/// Result of the draws, in the unit of the measurand.
///
/// ```
/// # use taceva_metrology::budget::{BudgetText, Evidence, MonteCarlo};
/// # let text = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"lamp\"\nhalf_width = \"10 mN\"\n";
/// let budget = &BudgetText::parse(text)?.budgets(&Evidence::default(), Some(MonteCarlo::default()))?[0];
/// let high = budget.mcm.as_ref().map(|drawn| drawn.symmetric[1]);
/// // 95 % of a rectangle of ±10 mN.
/// assert!(high.is_some_and(|high| (high - 1.0095).abs() < 2e-4));
/// # Ok::<(), taceva_metrology::budget::BudgetError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct MonteCarloResult {
    /// Number of draws.
    pub draws: u64,
    /// Seed of the random draws.
    pub seed: u64,
    /// Mean of the draws.
    pub mean: f64,
    /// Standard deviation of the draws.
    pub u: f64,
    /// Shortest interval that contains the share of draws given by the coverage probability.
    pub shortest: [f64; 2],
    /// Interval with equal probabilities in both tails.
    pub symmetric: [f64; 2],
    /// Standard errors of both ends of the symmetric interval.
    pub end_errors: [f64; 2],
    /// True if the first-order and symmetric intervals agree within the tolerance and twice the standard errors of the ends.
    pub validated: bool,
    /// Half a unit in the last place of `u` rounded to two digits.
    pub tolerance: f64,
    /// True if drawing stopped early because the results were stable.
    pub is_stable: bool,
}

/// Model with its inputs and their joint distribution.
pub(super) struct Sampler<'a> {
    pub(super) expression: &'a Expression,
    pub(super) inputs: &'a [Input],
    /// Values of the constants, which follow the inputs in the expression.
    pub(super) constants: &'a [f64],
    pub(super) correlations: &'a Correlations,
    pub(super) coverage: f64,
}

impl Sampler<'_> {
    /// Runs the model on random draws; `None` if a draw has no value. `estimate` is the model's value at the estimates of the inputs.
    pub(super) fn run(&self, request: MonteCarlo, estimate: f64) -> Option<MonteCarloResult> {
        // A block holds 100 values beyond its interval, JCGM 101, 7.9.4.
        let tails = (100.0 / (1.0 - self.coverage)).ceil().min(1e7);
        let block = BLOCK.max(whole_count(tails));
        let blocks = request.draws.div_ceil(block).max(2);
        let mut all: Vec<f64> = Vec::new();
        let mut stable = Stability::default();
        let mut is_stable = false;
        for number in 0..blocks {
            let mut values = self.block(request.seed, number * block..(number + 1) * block)?;
            values.sort_unstable_by(f64::total_cmp);
            let of_block = Summary::of(&values, self.coverage, estimate);
            stable.add(&of_block);
            all.append(&mut values);
            if request.is_adaptive && stable.is_reached() {
                is_stable = true;
                break;
            }
        }
        // A stable sort merges the blocks, which are sorted already.
        all.sort_by(f64::total_cmp);
        let Summary { mean, u, symmetric } = Summary::of(&all, self.coverage, estimate);
        Some(MonteCarloResult {
            draws: all.len() as u64,
            seed: request.seed,
            mean,
            u,
            shortest: shortest(&all, self.coverage),
            symmetric,
            end_errors: [2, 3].map(|which| stable.standard_error(which)),
            validated: false,
            tolerance: tolerance(u),
            is_stable,
        })
    }

    fn block(&self, seed: u64, counters: std::ops::Range<u64>) -> Option<Vec<f64>> {
        let draws = Draws::new(seed);
        let count = self.inputs.len() as u64;
        let of_inputs: Vec<Draws> = (0..count).map(|at| draws.of(at)).collect();
        let joint = Joint::of(self, draws);
        let mut stack = Vec::new();
        let mut values: Vec<f64> = Vec::new();
        let mut point: Vec<f64> = self.inputs.iter().map(|input| input.value).collect();
        point.extend(self.constants);
        let mut drawn = Vec::with_capacity(self.inputs.len());
        for counter in counters {
            drawn.clear();
            let own = self.inputs.iter().zip(&of_inputs);
            drawn.extend(own.map(|(input, draws)| match joint.is_of_it(input) {
                true => 0.0,
                false => input.shape.draw(input.freedom, *draws, counter),
            }));
            joint.draw(counter, &mut drawn);
            for ((at, input), off) in point.iter_mut().zip(self.inputs).zip(&drawn) {
                *at = input.value + off;
            }
            values.push(self.expression.value(&point, &mut stack)?);
        }
        Some(values)
    }
}

/// Inputs with a joint draw: correlated inputs, and inputs of one set.
struct Joint<'a> {
    inputs: &'a [Input],
    members: Vec<usize>,
    lower: Vec<f64>,
    normals: Vec<Draws>,
    /// Random streams of the Student factors, one for each input with a joint draw. Inputs of one set share a stream.
    factors: Vec<Draws>,
}

impl<'a> Joint<'a> {
    fn of(sampler: &Sampler<'a>, draws: Draws) -> Joint<'a> {
        let inputs = sampler.inputs;
        let is_member =
            |at: &usize| sampler.correlations.is_correlated(*at) || inputs[*at].set.is_some();
        let members: Vec<usize> = (0..inputs.len()).filter(is_member).collect();
        let first = |at: usize| (0..at).find(|first| inputs[*first].is_of_set_of(&inputs[at]));
        let factor = |at: &usize| draws.of(FACTOR + first(*at).unwrap_or(*at) as u64);
        let normal = |at: usize| draws.of(JOINT + at as u64);
        Joint {
            inputs,
            lower: sampler.correlations.factor(),
            normals: (0..inputs.len()).map(normal).collect(),
            factors: members.iter().map(factor).collect(),
            members,
        }
    }

    fn is_of_it(&self, input: &Input) -> bool {
        let mut members = self.members.iter();
        members.any(|at| std::ptr::eq(&raw const self.inputs[*at], input))
    }

    fn draw(&self, counter: u64, drawn: &mut [f64]) {
        let count = self.inputs.len();
        let normal = |at: usize| normal::quantile(open_unit(self.normals[at].bits(counter)));
        for (at, factor) in self.members.iter().zip(&self.factors) {
            let row = &self.lower[at * count..(at + 1) * count];
            let parts = self.members.iter().filter(|other| row[**other].abs() > 0.0);
            let sum: f64 = parts.map(|other| row[*other] * normal(*other)).sum();
            let input = &self.inputs[*at];
            let scale = match input.freedom {
                Freedom::Finite(number) => {
                    (number / chi_square::draw(*factor, counter, number)).sqrt()
                }
                _ => 1.0,
            };
            drawn[*at] = input.u * scale * sum;
        }
    }
}

/// Mean, standard deviation and symmetric interval of sorted values.
struct Summary {
    mean: f64,
    u: f64,
    symmetric: [f64; 2],
}

impl Summary {
    fn of(sorted: &[f64], coverage: f64, near: f64) -> Summary {
        let n = sorted.len() as f64;
        let off = sorted.iter().map(|value| value - near).sum::<f64>() / n;
        let mean = near + off;
        let squares: f64 = sorted
            .iter()
            .map(|value| (value - mean) * (value - mean))
            .sum();
        let width = width(sorted.len(), coverage);
        let first = (sorted.len() - width).div_ceil(2).max(1);
        Summary {
            mean,
            u: (squares / (n - 1.0)).sqrt(),
            symmetric: [
                sorted[first - 1],
                sorted[(first - 1 + width).min(sorted.len() - 1)],
            ],
        }
    }
}

/// Number of sorted values that a coverage interval spans, JCGM 101, 7.7.2.
fn width(count: usize, coverage: f64) -> usize {
    whole_size(coverage * count as f64 + 0.5).min(count.saturating_sub(1))
}

fn shortest(sorted: &[f64], coverage: f64) -> [f64; 2] {
    let ends = sorted.iter().zip(&sorted[width(sorted.len(), coverage)..]);
    let widest = [f64::NEG_INFINITY, f64::INFINITY];
    ends.fold(widest, |best, (low, high)| {
        match high - low < best[1] - best[0] {
            true => [*low, *high],
            false => best,
        }
    })
}

/// Results of each block: mean, standard uncertainty, lower and upper interval end.
#[derive(Default)]
struct Stability {
    results: Vec<[f64; 4]>,
}

impl Stability {
    fn add(&mut self, block: &Summary) {
        let [low, high] = block.symmetric;
        self.results.push([block.mean, block.u, low, high]);
    }

    /// True from [`LEAST_BLOCKS`] blocks on, if twice the standard error of each result is at most half the last place of u.
    fn is_reached(&self) -> bool {
        let limit = tolerance(self.mean(1));
        self.results.len() >= LEAST_BLOCKS
            && (0..4).all(|which| 2.0 * self.standard_error(which) <= limit)
    }

    fn mean(&self, which: usize) -> f64 {
        let sum: f64 = self.results.iter().map(|result| result[which]).sum();
        sum / self.results.len() as f64
    }

    /// Standard error of the mean over blocks of the result at index `which`, for at least two blocks.
    fn standard_error(&self, which: usize) -> f64 {
        let (h, mean) = (self.results.len() as f64, self.mean(which));
        let offs = self.results.iter().map(|result| result[which] - mean);
        let squares: f64 = offs.map(|off| off * off).sum();
        (squares / (h * (h - 1.0))).sqrt()
    }
}
