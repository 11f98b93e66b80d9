//! Computes budgets from a parsed budget file and its measured figures.

use super::correlation::Correlations;
use super::error::{BudgetError, BudgetProblem};
use super::evidence::Evidence;
use super::expression::{Expansion, Expression, ExpressionError, Function, Step};
use super::freedom::{Freedom, Undefined};
use super::input::{Enters, Input};
use super::monte_carlo::{MonteCarlo, MonteCarloResult, Sampler};
use super::overlap;
use super::propagation::{Combined, combine, contributions};
use super::report::{
    BUDGET_SCHEMA, Budget, Correlation, Method, NOT_TRACEABLE, Source, Traceability,
};
use super::source::Reader;
use super::text::BudgetText;
use taceva_metrics::distributions::student_t;

impl BudgetText {
    /// Computes one budget for each value of `at`, or a single budget for an expression without `at`.
    ///
    /// Without an expression, a reading y is corrected to y·cos(tilt)·Π(1 + δ_relative) + Σ δ_absolute, where δ is the estimate of a source.
    ///
    /// # Errors
    /// [`BudgetError`] with line, key and expectation: invalid numbers, unknown names, figures counted twice, contradicting correlations, a value
    /// outside the certificate's range, an expression without a value.
    ///
    /// # Reference
    /// GUM 5 and annex G; JCGM 101:2008 for the draws.
    pub fn budgets(
        &self,
        evidence: &Evidence,
        draws: impl Into<Option<MonteCarlo>>,
    ) -> Result<Vec<Budget>, BudgetError> {
        let draws = draws.into();
        let budget = |at: Option<f64>| self.budget(evidence, at, draws);
        match self.at.as_slice() {
            [] => Ok(vec![budget(None)?]),
            all => all.iter().map(|at| budget(Some(*at))).collect(),
        }
    }

    fn budget(
        &self,
        evidence: &Evidence,
        at: Option<f64>,
        draws: Option<MonteCarlo>,
    ) -> Result<Budget, BudgetError> {
        let reader = Reader {
            text: self,
            evidence,
            at: at.unwrap_or_default(),
        };
        let inputs = reader.inputs()?;
        overlap::check(&inputs)?;
        let expression = self.model(&inputs, at)?;
        let constants: Vec<f64> = at.into_iter().collect();
        let own = inputs.iter().map(|input| input.value);
        let estimates: Vec<f64> = own.chain(constants.clone()).collect();
        let expansion = expression.expand(&estimates);
        let expansion = expansion.map_err(|error| self.of_expression(error))?;
        let correlations = Correlations::of(self, &inputs, &contributions(&inputs, &expansion))?;
        let combined = combine(&inputs, &expansion, &correlations);
        let factor = |number: f64| {
            student_t::quantile(f64::midpoint(1.0, self.coverage), number.floor().max(1.0))
        };
        let k = combined.freedom.number().map(factor);
        let expanded = match combined.freedom {
            Freedom::Undefined(Undefined::NoUncertainty) => Some(0.0),
            _ => k.map(|k| k * combined.u),
        };
        let sampler = Sampler {
            expression: &expression,
            inputs: &inputs,
            constants: &constants,
            correlations: &correlations,
            coverage: self.coverage,
        };
        let mut budget = Budget {
            schema: BUDGET_SCHEMA.to_owned(),
            measurand: self.written.measurand.get_ref().clone(),
            at,
            unit: self.unit.clone(),
            value: expansion.value,
            u: combined.u,
            second_order_u: combined.second_order_u,
            nu_eff: combined.freedom,
            k,
            p: self.coverage,
            expanded,
            interval: expanded.map(|half| [expansion.value - half, expansion.value + half]),
            method: Method::FirstOrder,
            sources: sources(&inputs, &expansion, combined.u),
            correlations: stated(&inputs, &correlations),
            mcm: None,
            missing: Vec::new(),
            traceability: evidence.certificate().map(|of| Traceability {
                number: of.number.clone(),
                laboratory: of.laboratory.clone(),
                serial: of.serial.clone(),
                valid_until: of.valid_until.clone(),
                recorded_on: of.recorded_on.clone(),
            }),
            warnings: Vec::new(),
        };
        if self.written.expression.is_none() {
            budget.missing = overlap::missing(&inputs, evidence);
            if evidence.certificate().is_none() {
                budget.warn(NOT_TRACEABLE);
            }
        }
        let expiry = evidence.certificate().and_then(|of| of.expiry());
        budget.warnings.extend(expiry);
        let notes = inputs.iter().filter_map(Input::note);
        budget.warnings.extend(notes);
        let beyond = budget.beyond_labels();
        budget.warnings.extend(beyond);
        let drawn = draws
            .filter(|_| combined.u > 0.0)
            .map(|request| sampler.run(request, expansion.value));
        match drawn {
            Some(Some(result)) => budget.take_draws(result, &inputs, &combined, &correlations),
            Some(None) => budget.warn(
                "no Monte Carlo result: a draw is outside the domain of the expression; state narrower sources",
            ),
            None => {}
        }
        if let Freedom::Undefined(reason) = budget.nu_eff {
            let remedy = match (reason, budget.method) {
                (Undefined::NoUncertainty, _) => "U is 0",
                (_, Method::FirstOrder) => "ask for Monte Carlo draws",
                (_, Method::MonteCarlo) => "the interval is taken from the Monte Carlo draws",
            };
            budget.warn(format!("nu_eff is undefined: {reason}; {remedy}"));
        }
        Ok(budget)
    }

    /// Expression of the budget file, or the default product and sum. Its names are the sources, then the measurand.
    fn model(&self, inputs: &[Input], at: Option<f64>) -> Result<Expression, BudgetError> {
        if let Some(written) = &self.written.expression {
            let mut names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
            names.extend(at.map(|_| self.written.measurand.get_ref().as_str()));
            return Expression::parse(written.get_ref(), &names)
                .map_err(|error| self.of_expression(error));
        }
        let mut steps = vec![Step::Input(inputs.len())];
        for order in [Enters::Cosine, Enters::Relative, Enters::Absolute] {
            for at in (0..inputs.len()).filter(|at| inputs[*at].enters == order) {
                let input = Step::Input(at);
                steps.extend(match order {
                    Enters::Cosine => vec![input, Step::Call(Function::Cos), Step::Multiply],
                    Enters::Relative => vec![Step::Number(1.0), input, Step::Add, Step::Multiply],
                    Enters::Absolute => vec![input, Step::Add],
                });
            }
        }
        Ok(Expression::of_steps(steps))
    }

    fn of_expression(&self, error: ExpressionError) -> BudgetError {
        let written = self.written.expression.as_ref();
        let place = written.map(|written| self.line(written));
        BudgetError::new(place, "expression", BudgetProblem::Expression(error))
    }
}

fn sources(inputs: &[Input], expansion: &Expansion, u: f64) -> Vec<Source> {
    let slopes = inputs.iter().zip(&expansion.gradient);
    slopes
        .map(|(input, c)| Source {
            name: input.name.clone(),
            kind: if input.is_statistical { 'A' } else { 'B' },
            shape: input.shape.name().to_owned(),
            value: input.value,
            u: input.u,
            nu: input.freedom,
            c: *c,
            contribution: c * input.u,
            share: (u > 0.0).then(|| (c * input.u / u).powi(2)),
            from: input.from.clone(),
            n: input.n(),
            clusters: input.figure.as_ref().and_then(|of| of.clusters),
            labels: input.figure.as_ref().and_then(|of| of.labels),
            digest: input.figure.as_ref().and_then(|of| of.digest.clone()),
        })
        .collect()
}

fn stated(inputs: &[Input], correlations: &Correlations) -> Vec<Correlation> {
    let pairs = (0..inputs.len()).flat_map(|second| (0..second).map(move |first| [first, second]));
    let found = pairs.map(|[first, second]| Correlation {
        between: [inputs[first].name.clone(), inputs[second].name.clone()],
        r: correlations.get(first, second),
    });
    found.filter(|of| of.r.abs() > 0.0).collect()
}

impl Budget {
    fn warn(&mut self, warning: impl Into<String>) {
        self.warnings.push(warning.into());
    }

    /// Stores the Monte Carlo result. Its interval replaces the first-order interval unless the two agree.
    fn take_draws(
        &mut self,
        mut drawn: MonteCarloResult,
        inputs: &[Input],
        combined: &Combined,
        r: &Correlations,
    ) {
        let tolerance = drawn.tolerance;
        drawn.validated = self.interval.is_some_and(|own| {
            let ends = own.into_iter().zip(drawn.symmetric).zip(drawn.end_errors);
            // Chance alone must not refute a result of first order.
            ends.into_iter()
                .all(|((own, end), error)| (own - end).abs() <= tolerance + 2.0 * error)
        });
        let heavy = inputs.iter().find(|input| {
            let is_heavy = matches!(input.freedom, Freedom::Finite(number) if number <= 2.0);
            is_heavy && input.u > 0.0 && (input.shape.is_bell() || input.set.is_some())
        });
        if let Some(input) = heavy {
            self.warn(format!(
                "the standard deviation of the draws does not converge: `{}` has {} degrees of freedom, expected more than 2",
                input.name, input.freedom
            ));
        }
        let bent =
            (0..inputs.len()).find(|at| r.is_correlated(*at) && !inputs[*at].shape.is_bell());
        if let Some(at) = bent {
            self.warn(format!(
                "`{}` is correlated, so its draws are normal and not {}",
                inputs[at].name,
                inputs[at].shape.name()
            ));
        }
        if !drawn.validated {
            self.interval = Some(drawn.symmetric);
            self.method = Method::MonteCarlo;
            if self.k.is_some() {
                self.warn(format!(
                    "the interval is taken from the Monte Carlo draws: {}",
                    reason(&drawn, inputs, combined)
                ));
            }
        }
        self.mcm = Some(drawn);
    }
}

/// Reason why the first-order interval is not confirmed.
fn reason(drawn: &MonteCarloResult, inputs: &[Input], combined: &Combined) -> String {
    let missed = 1.0 - combined.u / drawn.u;
    let is_curved = combined.second_order_u > combined.u * 1.01;
    match combined.greatest_term.filter(|_| is_curved) {
        Some([one, other]) => {
            let term = match one == other {
                true => format!("curvature of {}", inputs[one].name),
                false => format!(
                    "interaction of {} and {}",
                    inputs[one].name, inputs[other].name
                ),
            };
            format!("linear terms miss {:.0} % of u: {term}", missed * 100.0)
        }
        None => "the distribution of the value is neither normal nor Student's".to_owned(),
    }
}
