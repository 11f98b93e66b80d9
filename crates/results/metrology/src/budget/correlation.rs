//! Correlations of inputs: stated, computed from paired rows, or the worst case.

use super::amount::{Amount, Wanted};
use super::error::{BudgetError, BudgetProblem};
use super::freedom::Freedom;
use super::input::Input;
use super::source::{deviations, unknown};
use super::text::{BudgetText, value};

/// Negative eigenvalues above this bound are taken for rounding errors.
const ROUNDING: f64 = -1e-12;

/// Symmetric matrix of correlation coefficients.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Correlations {
    count: usize,
    r: Vec<f64>,
}

impl Correlations {
    /// Correlations of `inputs`. The signs of `contributions` determine the worst case for unknown correlations.
    pub(super) fn of(
        text: &BudgetText,
        inputs: &[Input],
        contributions: &[f64],
    ) -> Result<Correlations, BudgetError> {
        let count = inputs.len();
        let mut found = Correlations {
            count,
            r: vec![0.0; count * count],
        };
        for at in 0..count {
            found.r[at * count + at] = 1.0;
        }
        found.add_rows(text, inputs)?;
        let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
        let mut stated: Vec<([usize; 2], usize)> = Vec::new();
        for written in &text.written.correlation {
            let pair = &written.get_ref().between;
            let mut place = [0; 2];
            for (name, at) in pair.get_ref().iter().zip(&mut place) {
                let position = names.iter().position(|known| known == name);
                *at = position
                    .ok_or_else(|| text.error(pair, "between", unknown(name, "source", &names)))?;
            }
            place.sort_unstable();
            if let Some((_, other)) = stated.iter().find(|(known, _)| *known == place) {
                let name = place.map(|at| names[at]).join(" and ");
                let problem = BudgetProblem::Twice {
                    name,
                    other: *other,
                };
                return Err(text.error(pair, "between", problem));
            }
            let is_computed = inputs[place[0]].is_read_with(&inputs[place[1]]);
            if place[0] == place[1] || is_computed {
                let reason = match is_computed {
                    true => {
                        "the correlation of these sources is computed from their rows; remove this entry"
                    }
                    false => "one source is named twice, expected two different sources",
                };
                return Err(text.error(pair, "between", BudgetProblem::Keys(reason.to_owned())));
            }
            stated.push((place, text.line(pair)));
            let r = match written.get_ref().r.get_ref() {
                Amount::Text(word) if word == "unknown" => {
                    (contributions[place[0]] * contributions[place[1]]).signum()
                }
                amount => {
                    let r = amount.resolve(Wanted::Share);
                    let r = r.map_err(|problem| text.error(&written.get_ref().r, "r", problem))?;
                    if !(-1.0..=1.0).contains(&r) {
                        let problem = value(r, "a number from -1 to 1, or \"unknown\"");
                        return Err(text.error(&written.get_ref().r, "r", problem));
                    }
                    r
                }
            };
            found.set(place, r);
        }
        let least = found.least_eigenvalue();
        if least < ROUNDING {
            let place = stated.first().map(|(_, line)| *line);
            let problem = BudgetProblem::NotPositive { eigenvalue: least };
            return Err(BudgetError::new(place, "correlation", problem));
        }
        Ok(found)
    }

    /// Computes correlations of inputs with the same `set` key from their rows. Such inputs need equal degrees of freedom.
    fn add_rows(&mut self, text: &BudgetText, inputs: &[Input]) -> Result<(), BudgetError> {
        for second in 0..inputs.len() {
            for first in 0..second {
                let (one, other) = (&inputs[first], &inputs[second]);
                if !one.is_of_set_of(other) {
                    continue;
                }
                let written = &text.written.source[second].get_ref().name;
                let differs = |what: &str| {
                    let [one, other] = [&one.name, &other.name].map(taceva_core::shown);
                    text.error(
                        written,
                        "set",
                        BudgetProblem::Keys(format!(
                            "`{one}` and `{other}` belong to the same set, but differ in their {what}"
                        )),
                    )
                };
                if one.is_read_with(other) {
                    if one.rows.len() != other.rows.len() {
                        return Err(differs("number of rows"));
                    }
                    let (left, right) = (deviations(&one.rows), deviations(&other.rows));
                    let sum =
                        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
                    let scale = (sum(&left, &left) * sum(&right, &right)).sqrt();
                    // Equal rows have no correlation.
                    let r = sum(&left, &right) / scale.max(f64::MIN_POSITIVE);
                    self.set([first, second], r.clamp(-1.0, 1.0));
                }
                if one.freedom != other.freedom {
                    return Err(differs("degrees of freedom"));
                }
            }
        }
        Ok(())
    }

    fn set(&mut self, [row, column]: [usize; 2], r: f64) {
        self.r[row * self.count + column] = r;
        self.r[column * self.count + row] = r;
    }

    pub(super) fn get(&self, row: usize, column: usize) -> f64 {
        self.r[row * self.count + column]
    }

    /// True if the input at index `at` is correlated with another input.
    pub(super) fn is_correlated(&self, at: usize) -> bool {
        (0..self.count).any(|other| other != at && self.get(at, other).abs() > 0.0)
    }

    /// Least eigenvalue of this matrix, by Jacobi rotations.
    fn least_eigenvalue(&self) -> f64 {
        const SWEEPS: usize = 50;
        let n = self.count;
        let mut a = self.r.clone();
        for _ in 0..SWEEPS {
            let mut off = 0.0;
            for p in 0..n {
                for q in p + 1..n {
                    let apq = a[p * n + q];
                    off += apq * apq;
                    if apq.abs() <= 0.0 {
                        continue;
                    }
                    let theta = (a[q * n + q] - a[p * n + p]) / (2.0 * apq);
                    let t = 1.0_f64.copysign(theta) / (theta.abs() + theta.hypot(1.0));
                    let c = 1.0 / t.hypot(1.0);
                    let s = t * c;
                    for k in 0..n {
                        let (kp, kq) = (a[k * n + p], a[k * n + q]);
                        (a[k * n + p], a[k * n + q]) = (c * kp - s * kq, s * kp + c * kq);
                    }
                    for k in 0..n {
                        let (pk, qk) = (a[p * n + k], a[q * n + k]);
                        (a[p * n + k], a[q * n + k]) = (c * pk - s * qk, s * pk + c * qk);
                    }
                }
            }
            if off < 1e-30 {
                break;
            }
        }
        (0..n).map(|at| a[at * n + at]).fold(1.0, f64::min)
    }

    /// Lower triangle L with L Lᵀ equal to this matrix, row by row. A column whose pivot is nearly 0 is 0.
    pub(super) fn factor(&self) -> Vec<f64> {
        let n = self.count;
        let mut lower = vec![0.0; n * n];
        for column in 0..n {
            let dot = |lower: &[f64], row: usize| -> f64 {
                (0..column)
                    .map(|k| lower[row * n + k] * lower[column * n + k])
                    .sum()
            };
            let square = 1.0 - dot(&lower, column);
            if square <= 1e-12 {
                continue;
            }
            lower[column * n + column] = square.sqrt();
            for row in column + 1..n {
                lower[row * n + column] =
                    (self.get(row, column) - dot(&lower, row)) / square.sqrt();
            }
        }
        lower
    }
}

impl Input {
    /// True if both inputs have the same `set` key, so that their values were read together.
    pub(super) fn is_of_set_of(&self, other: &Input) -> bool {
        self.set.is_some() && self.set == other.set
    }

    /// True if both inputs have rows and the same `set` key.
    fn is_read_with(&self, other: &Input) -> bool {
        self.is_of_set_of(other) && !self.rows.is_empty() && !other.rows.is_empty()
    }

    /// True if the input has a finite number of degrees of freedom.
    pub(super) fn is_of_finite_freedom(&self) -> bool {
        matches!(self.freedom, Freedom::Finite(_))
    }
}
