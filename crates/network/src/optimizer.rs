//! Optimisers, which update the weights.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use taceva_core::single;

use crate::machine::Machine;
use crate::panel::{Aligned, PANEL};
use crate::simd::{Job, Vector};
use crate::update::Update;

/// Update rule for the weights. Weight decay applies to every parameter, as by default in PyTorch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Optimizer {
    /// Stochastic gradient descent. For weight w, gradient g, velocity v and learning rate r: v ← momentum · v + g + weight_decay · w, w ← w − r · v.
    Sgd {
        /// Factor of the previous velocity, at least 0 and below 1.
        momentum: f64,
        /// Factor of the weight decay; 0 for no decay.
        weight_decay: f64,
    },
    /// Adam with decoupled weight decay.
    ///
    /// # Reference
    /// I. Loshchilov, F. Hutter, "Decoupled weight decay regularization", ICLR 2019.
    AdamW {
        /// Factors β₁ and β₂ of the previous means of gradient and squared gradient, each at least 0 and below 1.
        betas: (f64, f64),
        /// Addend to the root of the mean squared gradient.
        epsilon: f64,
        /// Factor of the weight decay; 0 for no decay.
        weight_decay: f64,
    },
}

impl Optimizer {
    /// AdamW with PyTorch's default settings.
    pub const ADAM_W: Optimizer = Optimizer::AdamW {
        betas: (0.9, 0.999),
        epsilon: 1e-8,
        weight_decay: 1e-2,
    };

    /// Number of state vectors per parameter.
    pub(crate) const fn moments(self) -> usize {
        match self {
            Optimizer::Sgd { .. } => 1,
            Optimizer::AdamW { .. } => 2,
        }
    }
}

/// State of an optimiser.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    /// Velocity, or means of gradient and squared gradient, of each parameter by slot. Empty before the first update of a parameter.
    pub(crate) moments: Vec<Vec<Aligned>>,
}

impl Memory {
    pub(crate) fn new(slots: usize) -> Memory {
        let moments = vec![Vec::new(); slots];
        Memory { moments }
    }
}

/// One optimiser step for all parameters.
pub(crate) struct Descent<'a> {
    pub(crate) machine: Machine,
    pub(crate) optimizer: Optimizer,
    pub(crate) rate: f64,
    /// Number of steps, including the present step.
    pub(crate) steps: u64,
    pub(crate) memory: &'a mut Memory,
    /// True if a parameter has become infinite or NaN.
    pub(crate) is_broken: bool,
}

/// Number of values per task of a thread.
const CHUNK: usize = 1 << 14;

impl Update for Descent<'_> {
    fn update(&mut self, slot: usize, values: &mut [f32], gradient: &[f32]) {
        let moments = &mut self.memory.moments[slot];
        if moments.is_empty() {
            *moments = vec![Aligned::zeros(values.len()); self.optimizer.moments()];
        }
        let (first, second) = moments.split_at_mut(1);
        let machine = self.machine;
        let values = values.par_chunks_mut(CHUNK);
        let pairs = values
            .zip(gradient.par_chunks(CHUNK))
            .zip(first[0].par_chunks_mut(CHUNK));
        let is_whole = match (Rule::new(self.optimizer, self.rate, self.steps), second) {
            (Rule::Adam(rule), [second]) => pairs
                .zip(second.par_chunks_mut(CHUNK))
                .map(|(((values, gradient), mean), square)| {
                    machine.run(AdamChunk {
                        rule,
                        values,
                        gradient,
                        mean,
                        square,
                    })
                })
                .reduce(|| true, |a, b| a & b),
            (Rule::Momentum(rule), _) => pairs
                .map(|((values, gradient), velocity)| {
                    machine.run(MomentumChunk {
                        rule,
                        values,
                        gradient,
                        velocity,
                    })
                })
                .reduce(|| true, |a, b| a & b),
            (Rule::Adam(_), _) => unreachable!("two moments are kept"),
        };
        self.is_broken |= !is_whole;
    }
}

/// Coefficients of one optimiser step.
#[derive(Clone, Copy, Debug)]
pub enum Rule {
    /// Coefficients of [`Optimizer::Sgd`].
    Momentum(Momentum),
    /// Coefficients of [`Optimizer::AdamW`].
    Adam(Adam),
}

/// Step of a weight w with gradient g and velocity v: v ← `momentum` · v + g + `decay` · w, w ← w − `rate` · v.
#[derive(Clone, Copy, Debug)]
pub struct Momentum {
    /// Factor of the previous velocity.
    pub momentum: f32,
    /// Factor of the weight decay.
    pub decay: f32,
    /// Learning rate.
    pub rate: f32,
}

/// Step of a weight w with gradient g, mean gradient m and mean squared gradient s: m ← β₁ · m + `news.0` · g, s ← β₂ · s + `news.1` · g², w ← `keep`
/// · w − `step` · m / (√s · `correction` + `epsilon`).
#[derive(Clone, Copy, Debug)]
pub struct Adam {
    /// Factor of the present weights.
    pub keep: f32,
    /// Factors of the previous means, β₁ and β₂.
    pub betas: (f32, f32),
    /// Factors of the newest gradient and of its square.
    pub news: (f32, f32),
    /// Bias correction 1 / √(1 − β₂ⁿ) at step n.
    pub correction: f32,
    /// Addend to the root of the mean squared gradient.
    pub epsilon: f32,
    /// Step size at step n: learning rate / (1 − β₁ⁿ).
    pub step: f32,
}

impl Rule {
    /// Coefficients of step `steps`, counted from 1, for the learning rate `rate`.
    pub fn new(optimizer: Optimizer, rate: f64, steps: u64) -> Rule {
        match optimizer {
            Optimizer::Sgd {
                momentum,
                weight_decay,
            } => Rule::Momentum(Momentum {
                momentum: single(momentum),
                decay: single(weight_decay),
                rate: single(rate),
            }),
            Optimizer::AdamW {
                betas,
                epsilon,
                weight_decay,
            } => {
                let left = |beta: f64| 1.0 - (steps as f64 * beta.ln()).exp();
                Rule::Adam(Adam {
                    keep: single(1.0 - rate * weight_decay),
                    betas: (single(betas.0), single(betas.1)),
                    news: (single(1.0 - betas.0), single(1.0 - betas.1)),
                    correction: single(1.0 / left(betas.1).sqrt()),
                    epsilon: single(epsilon),
                    step: single(rate / left(betas.0)),
                })
            }
        }
    }
}

impl Momentum {
    #[inline(always)]
    fn apply(self, value: &mut f32, gradient: f32, velocity: &mut f32) {
        *velocity = self.momentum * *velocity + (gradient + self.decay * *value);
        *value -= self.rate * *velocity;
    }
}

impl Adam {
    #[inline(always)]
    fn apply(self, value: &mut f32, gradient: f32, mean: &mut f32, square: &mut f32) {
        *mean = self.betas.0 * *mean + self.news.0 * gradient;
        *square = self.betas.1 * *square + self.news.1 * (gradient * gradient);
        let root = square.sqrt() * self.correction + self.epsilon;
        *value = *value * self.keep - self.step * (*mean / root);
    }
}

struct MomentumChunk<'a> {
    rule: Momentum,
    values: &'a mut [f32],
    gradient: &'a [f32],
    velocity: &'a mut [f32],
}

impl Job for MomentumChunk<'_> {
    /// True if all updated values are finite.
    type Output = bool;

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) -> bool {
        let mut check = [0.0_f32; PANEL];
        let values = self
            .values
            .chunks_mut(PANEL)
            .zip(self.gradient.chunks(PANEL));
        for ((values, gradient), velocity) in values.zip(self.velocity.chunks_mut(PANEL)) {
            let places = values
                .iter_mut()
                .zip(gradient)
                .zip(velocity)
                .zip(&mut check);
            for (((value, gradient), velocity), check) in places {
                self.rule.apply(value, *gradient, velocity);
                // Adds zero for a finite value, otherwise NaN.
                *check += *value * 0.0;
            }
        }
        check.iter().all(|check| !check.is_nan())
    }
}

struct AdamChunk<'a> {
    rule: Adam,
    values: &'a mut [f32],
    gradient: &'a [f32],
    mean: &'a mut [f32],
    square: &'a mut [f32],
}

impl Job for AdamChunk<'_> {
    /// True if all updated values are finite.
    type Output = bool;

    #[inline(always)]
    fn run<V: Vector>(self, _proof: V::Proof) -> bool {
        let mut check = [0.0_f32; PANEL];
        let values = self
            .values
            .chunks_mut(PANEL)
            .zip(self.gradient.chunks(PANEL));
        let moments = self
            .mean
            .chunks_mut(PANEL)
            .zip(self.square.chunks_mut(PANEL));
        for ((values, gradient), (mean, square)) in values.zip(moments) {
            let places = values
                .iter_mut()
                .zip(gradient)
                .zip(mean)
                .zip(square)
                .zip(&mut check);
            for ((((value, gradient), mean), square), check) in places {
                self.rule.apply(value, *gradient, mean, square);
                *check += *value * 0.0;
            }
        }
        check.iter().all(|check| !check.is_nan())
    }
}
