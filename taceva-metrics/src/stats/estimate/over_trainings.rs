//! Adds the variance of a score between trainings to its variance between clusters.

use super::{Estimate, Shape};
use crate::stats::parts::{Part, root_of_squares};
use crate::stats::trainings::TrainingSpread;

impl Estimate {
    /// The same score, with the variance between trainings added to the variance between clusters.
    ///
    /// Let s be the standard error of `spread`, and g′ the derivative of the interval's scale at the value. On this scale, the trainings have the
    /// standard error s |g′| to first order. Both standard errors add as squares, with degrees of freedom by Welch and Satterthwaite. A share of n
    /// effective samples then has n′ effective samples: 1/n′ = 1/n + s² / (p (1 − p)), with p the mean of all trainings. Equal trainings leave the
    /// estimate unchanged.
    ///
    /// ```
    /// use taceva_metrics::{Estimate, Sides, TrainingSpread, by_intervals};
    /// let (a, b) = (Estimate::try_new(0.041, 0.003, 32)?, Estimate::try_new(0.053, 0.004, 32)?);
    /// let spread = TrainingSpread::of_one(&[0.041, 0.049, 0.033]).ok_or("three trainings")?;
    /// let clusters = by_intervals(Sides { a, b })?;
    /// let all = by_intervals(Sides { a: a.over_trainings(spread), b })?;
    /// assert!(clusters.is_shown && !all.is_shown && all.value == clusters.value);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Reference
    /// JCGM 100:2008 (GUM), 5.1.2 and G.4.1.
    #[must_use]
    pub fn over_trainings(self, spread: TrainingSpread) -> Estimate {
        if !spread.varies() {
            return self;
        }
        let value = self.value;
        let between = |slope: f64| Part {
            standard_error: spread.standard_error * slope,
            freedom: spread.freedom,
        };
        let within = |standard_error: f64| Part {
            standard_error,
            freedom: self.freedom,
        };
        let both = |[low, high]: [f64; 2], slope: f64| {
            let trainings = between(slope);
            let steps = [low, high].map(|step| root_of_squares(step, trainings.standard_error));
            let all = within(f64::midpoint(low, high)).with(trainings);
            (steps, all.freedom)
        };
        let (shape, freedom) = match self.shape {
            Shape::Own(steps) => {
                let (steps, freedom) = both(steps, 1.0);
                (Shape::Own(steps), freedom)
            }
            Shape::Logarithm { end, steps } => {
                let (steps, freedom) = both(steps, 1.0 / (value - end).abs());
                (Shape::Logarithm { end, steps }, freedom)
            }
            Shape::Odds { width, steps } => {
                let (steps, freedom) = both(steps, width / (value * (width - value)));
                (Shape::Odds { width, steps }, freedom)
            }
            Shape::Share { samples } => {
                // Trainings that differ have a mean inside of 0..1.
                let binomial = (spread.mean * (1.0 - spread.mean)).max(f64::MIN_POSITIVE);
                let own = within((1.0 / samples).sqrt());
                let all = own.with(between(1.0 / binomial.sqrt()));
                let samples = 1.0 / (all.standard_error * all.standard_error);
                (Shape::Share { samples }, all.freedom)
            }
        };
        Estimate {
            value,
            standard_error: root_of_squares(self.standard_error, spread.standard_error),
            freedom,
            shape,
        }
    }
}
