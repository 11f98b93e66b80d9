//! Converts sources of the budget file, with their measured figures, to inputs of the model.

mod keys;
mod measurement;
mod table;

use taceva_core::{shown, suggestion};
use taceva_metrics::ExactSum;
use toml::Spanned;

use super::amount::{Amount, Wanted};
use super::error::{BudgetError, BudgetProblem};
use super::evidence::Evidence;
use super::freedom::Freedom;
use super::input::{Enters, Input};
use super::schema::WrittenSource;
use super::shape::Shape;
use super::text::{BudgetText, value};

/// Converts one source table to an input.
pub(super) struct Reader<'a> {
    pub(super) text: &'a BudgetText,
    pub(super) evidence: &'a Evidence,
    /// Value of the measurand, in its unit.
    pub(super) at: f64,
}

/// Estimate, shape and degrees of freedom of a source.
struct Numbers {
    value: f64,
    shape: Shape,
    freedom: Freedom,
    is_statistical: bool,
}

impl Numbers {
    fn normal(u: f64, freedom: Freedom) -> Numbers {
        Numbers {
            value: 0.0,
            shape: Shape::Normal { u },
            freedom,
            is_statistical: false,
        }
    }

    fn statistical(value: f64, u: f64, freedom: Freedom) -> Numbers {
        Numbers {
            value,
            shape: Shape::Student { u },
            freedom,
            is_statistical: true,
        }
    }
}

impl Reader<'_> {
    /// Inputs of all sources, in the order of the budget file.
    pub(super) fn inputs(&self) -> Result<Vec<Input>, BudgetError> {
        let mut inputs: Vec<Input> = Vec::new();
        for written in &self.text.written.source {
            let input = self.input(written.get_ref())?;
            if let Some(first) = inputs.iter().find(|first| first.name == input.name) {
                let problem = BudgetProblem::Twice {
                    name: input.name,
                    other: first.line,
                };
                return Err(self.text.error(&written.get_ref().name, "name", problem));
            }
            inputs.push(input);
        }
        Ok(inputs)
    }

    fn input(&self, of: &WrittenSource) -> Result<Input, BudgetError> {
        self.check_keys(of)?;
        let enters = self.enters(of)?;
        let wanted = match enters {
            Enters::Absolute => self.text.wanted(),
            Enters::Relative => Wanted::Share,
            Enters::Cosine => Wanted::Angle,
        };
        let stated = self.freedom(of)?;
        let figure = self.figure(of)?;
        let mut numbers = match &of.from {
            Some(from) => self.measured(of, from, figure)?,
            None => self.stated_numbers(of, wanted, stated)?,
        };
        if let Some(value) = &of.value {
            numbers.value = self.amount(value, "value", wanted)?;
        }
        Ok(Input {
            name: of.name.get_ref().clone(),
            line: self.text.line(&of.name),
            is_statistical: numbers.is_statistical,
            shape: numbers.shape,
            value: numbers.value,
            u: numbers.shape.standard_uncertainty(),
            freedom: numbers.freedom,
            enters,
            from: owned(of.from.as_ref()),
            set: owned(of.set.as_ref()),
            rows: owned(of.rows.as_ref()).unwrap_or_default(),
            covers: owned(of.covers.as_ref()),
            figure: figure.cloned(),
        })
    }

    fn enters(&self, of: &WrittenSource) -> Result<Enters, BudgetError> {
        let Some(written) = &of.enters else {
            return Ok(Enters::Absolute);
        };
        let name = written.get_ref();
        if self.text.written.expression.is_some() {
            let problem = BudgetProblem::Keys(
                "the `expression` already states how the source enters; remove `enters`".to_owned(),
            );
            return Err(self.text.error(written, "enters", problem));
        }
        let found = Enters::NAMES.into_iter().find(|(known, _)| known == name);
        let names = Enters::NAMES.map(|(known, _)| known);
        found.map(|(_, enters)| enters).ok_or_else(|| {
            self.text
                .error(written, "enters", unknown(name, "way to enter", &names))
        })
    }

    fn amount(&self, of: &Spanned<Amount>, key: &str, wanted: Wanted) -> Result<f64, BudgetError> {
        let found = of.get_ref().resolve(wanted);
        found.map_err(|problem| self.text.error(of, key, problem))
    }

    /// Converts an amount that must not be negative.
    fn width(&self, of: &Spanned<Amount>, key: &str, wanted: Wanted) -> Result<f64, BudgetError> {
        let found = self.amount(of, key, wanted)?;
        let problem = || self.text.error(of, key, value(found, "0 or more"));
        (found >= 0.0).then_some(found).ok_or_else(problem)
    }

    /// Reads a number, and rejects a number outside `range`.
    fn number(&self, of: &Spanned<f64>, key: &str, range: &Range) -> Result<f64, BudgetError> {
        let found = *of.get_ref();
        let problem = || self.text.error(of, key, value(found, range.words));
        (range.holds)(found).then_some(found).ok_or_else(problem)
    }

    fn freedom(&self, of: &WrittenSource) -> Result<Freedom, BudgetError> {
        if let Some(dof) = &of.dof {
            let number = self.number(dof, "dof", &DOF)?;
            return Ok(match number.is_infinite() {
                true => Freedom::Infinite,
                false => Freedom::Finite(number),
            });
        }
        match &of.reliability {
            Some(of) => {
                let share = self.width(of, "reliability", Wanted::Share)?;
                Ok(Freedom::of_reliability(share))
            }
            None => Ok(Freedom::Infinite),
        }
    }
}

/// Accepted range of a number.
struct Range {
    holds: fn(f64) -> bool,
    words: &'static str,
}

impl Range {
    const fn new(words: &'static str, holds: fn(f64) -> bool) -> Range {
        Range { holds, words }
    }
}

const DOF: Range = Range::new("a number above 0, or inf", |dof| dof > 0.0);
const FACTOR: Range = Range::new("a number above 0", |k| k > 0.0 && k.is_finite());
const PROBABILITY: Range = Range::new("a number between 0 and 1", |p| p > 0.0 && p < 1.0);
const SHARE: Range = Range::new("a number from 0 to 1", |beta| (0.0..=1.0).contains(&beta));
const HOURS: Range = Range::new("0 or more", |hours| hours >= 0.0 && hours.is_finite());
const READINGS: Range = Range::new("1 or more", |n| n >= 1.0 && n.is_finite());

fn owned<T: Clone>(of: Option<&Spanned<T>>) -> Option<T> {
    of.map(|of| of.get_ref().clone())
}

/// Deviation of each row from the mean of all rows, computed from exact sums.
pub(super) fn deviations(rows: &[f64]) -> Vec<f64> {
    let n = rows.len() as f64;
    let sum: ExactSum = rows.iter().copied().collect();
    let deviation = |row: &f64| {
        let mut scaled = ExactSum::default();
        scaled.add_product(n, *row);
        scaled.subtract(&sum);
        scaled.to_f64() / n
    };
    rows.iter().map(deviation).collect()
}

pub(super) fn unknown(name: &str, kind: &'static str, known: &[&str]) -> BudgetProblem {
    BudgetProblem::UnknownName {
        name: shown(name).to_string(),
        kind,
        suggestion: suggestion(name, known),
    }
}
