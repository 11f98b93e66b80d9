//! Expressions over the names of sources: parser, evaluation and exact derivatives.

mod reader;

use std::fmt;

pub use super::dual::Expansion;
use super::dual::Scalar;

/// A formula of `+ - * / ^`, `sqrt sin cos tan exp ln`, numbers and names. Angles are in radians.
///
/// ```
/// use taceva_metrology::budget::Expression;
/// let area = Expression::parse("width * height", &["width", "height"])?;
/// let at = area.expand(&[2.0, 3.0])?;
/// assert_eq!((at.value, at.gradient), (6.0, vec![3.0, 2.0]));
/// assert_eq!(at.hessian, [0.0, 1.0, 1.0, 0.0]);
/// # Ok::<(), taceva_metrology::budget::ExpressionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// Steps of the stack machine, each with its column in the text.
    steps: Vec<(Step, usize)>,
}

/// A syntax error, or an expression without a value at the estimates.
///
/// ```
/// use taceva_metrology::budget::Expression;
/// let error = Expression::parse("a + b", &["a"]).unwrap_err();
/// assert_eq!(error.to_string(), "column 5: `b` is not a source; expected one of `a`");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ExpressionError {
    /// Column, from 1, in characters.
    pub column: usize,
    /// Problem found.
    pub problem: String,
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "column {}: {}", self.column, self.problem)
    }
}

impl std::error::Error for ExpressionError {}

/// One step of the stack machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    Number(f64),
    Input(usize),
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Negate,
    Call(Function),
}

/// Function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Sqrt,
    Sin,
    Cos,
    Tan,
    Exp,
    Ln,
}

impl Expression {
    /// Parses `text`. `names` lists the inputs in order. A name with blanks is written in `'…'`.
    ///
    /// # Errors
    /// [`ExpressionError`] with the column and, for an unknown name, the nearest known name.
    pub fn parse(text: &str, names: &[&str]) -> Result<Expression, ExpressionError> {
        let steps = reader::read(text, names)?;
        Ok(Expression { steps })
    }

    /// Expression from these steps, without a text.
    pub(super) fn of_steps(steps: Vec<Step>) -> Expression {
        let steps = steps.into_iter().map(|step| (step, 0)).collect();
        Expression { steps }
    }

    /// Value and derivatives at `inputs`, in the order of the names.
    ///
    /// # Errors
    /// [`ExpressionError`] with the column of a division by 0, of an overflow, or of a root or logarithm without a value or derivative.
    pub fn expand(&self, inputs: &[f64]) -> Result<Expansion, ExpressionError> {
        let count = inputs.len();
        let dual = |at: usize| Expansion::input(inputs[at], at, count);
        let duals: Vec<Expansion> = (0..count).map(dual).collect();
        let zero = Expansion::input(0.0, count, count);
        self.evaluate(&duals, &zero, &mut Vec::new())
    }

    /// Value at `inputs`; `None` if undefined. `stack` is a buffer reused between calls.
    pub(super) fn value(&self, inputs: &[f64], stack: &mut Vec<f64>) -> Option<f64> {
        self.evaluate(inputs, &0.0, stack).ok()
    }

    fn evaluate<T: Scalar>(
        &self,
        inputs: &[T],
        zero: &T,
        stack: &mut Vec<T>,
    ) -> Result<T, ExpressionError> {
        stack.clear();
        for (step, column) in &self.steps {
            let place = |problem| error(*column, problem);
            let mut pop = || stack.pop().unwrap_or_else(|| zero.clone());
            let result = match *step {
                Step::Number(value) => T::constant(value, zero),
                Step::Input(at) => inputs[at].clone(),
                Step::Call(function) => applied(function, pop()).map_err(place)?,
                Step::Negate => negated(pop()),
                binary => {
                    let right = pop();
                    combined(binary, pop(), right).map_err(place)?
                }
            };
            if !result.value().is_finite() {
                return Err(error(*column, "no finite value at the estimates"));
            }
            stack.push(result);
        }
        Ok(stack.pop().unwrap_or_else(|| zero.clone()))
    }
}

fn error(column: usize, problem: &str) -> ExpressionError {
    ExpressionError {
        column,
        problem: problem.to_owned(),
    }
}

fn negated<T: Scalar>(number: T) -> T {
    let derivatives = [-number.value(), -1.0, 0.0];
    number.chained(derivatives)
}

fn combined<T: Scalar>(step: Step, left: T, right: T) -> Result<T, &'static str> {
    Ok(match step {
        Step::Add => left.plus(&right),
        Step::Subtract => left.plus(&negated(right)),
        Step::Multiply => left.times(&right),
        Step::Divide => {
            let x = right.value();
            if x.abs() <= 0.0 {
                return Err("division by 0 at the estimates");
            }
            let inverse = 1.0 / x;
            left.times(&right.chained([inverse, -inverse * inverse, 2.0 * inverse.powi(3)]))
        }
        _ => return power(left, right),
    })
}

fn power<T: Scalar>(base: T, exponent: T) -> Result<T, &'static str> {
    let (x, n) = (base.value(), exponent.value());
    let is_whole = (n - n.round()).abs() <= 0.0;
    if x < 0.0 && !is_whole {
        return Err("a negative number to a power that is not whole");
    }
    if x.abs() <= 0.0 && n < 0.0 {
        return Err("0 to a negative power at the estimates");
    }
    if exponent.is_constant() || is_whole && x <= 0.0 {
        // n xⁿ⁻¹ is 0 for n = 0 also at 0.
        let term = |factor: f64, n: f64| {
            if factor.abs() <= 0.0 {
                0.0
            } else {
                factor * x.powf(n)
            }
        };
        let derivatives = [x.powf(n), term(n, n - 1.0), term(n * (n - 1.0), n - 2.0)];
        return match derivatives.iter().all(|part| part.is_finite()) {
            true => Ok(base.chained(derivatives)),
            false => Err("no derivative at the estimates"),
        };
    }
    let logarithm = base.chained([x.ln(), 1.0 / x, -1.0 / (x * x)]);
    let value = x.powf(n);
    Ok(exponent.times(&logarithm).chained([value, value, value]))
}

fn applied<T: Scalar>(function: Function, argument: T) -> Result<T, &'static str> {
    let x = argument.value();
    let derivatives = match function {
        Function::Sqrt if x < 0.0 => return Err("root of a negative number"),
        Function::Sqrt if x <= 0.0 && !argument.is_constant() => {
            return Err("the root of 0 has no derivative");
        }
        Function::Sqrt => {
            let root = x.sqrt();
            [root, 0.5 / root, -0.25 / (root * x)]
        }
        Function::Sin => [x.sin(), x.cos(), -x.sin()],
        Function::Cos => [x.cos(), -x.sin(), -x.cos()],
        Function::Tan => {
            let tangent = x.tan();
            let slope = 1.0 + tangent * tangent;
            [tangent, slope, 2.0 * tangent * slope]
        }
        Function::Exp => [x.exp(); 3],
        Function::Ln if x <= 0.0 => return Err("logarithm of a number that is not above 0"),
        Function::Ln => [x.ln(), 1.0 / x, -1.0 / (x * x)],
    };
    Ok(argument.chained(derivatives))
}
