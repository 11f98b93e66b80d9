//! Least squares of a few terms over many pixels. Each press has its own sums, so that a press is left out by subtraction.

use std::iter::Sum;

use super::law::Term;

/// Normal equations of some presses: AᵀA, and Aᵀb of each colour, with the terms A and the changes b of the pictures.
#[derive(Clone)]
pub(crate) struct Squares {
    own: Vec<Vec<f64>>,
    seen: Vec<[f64; 3]>,
}

/// Weight of each term in each colour.
pub(crate) struct Coefficients(Vec<[f64; 3]>);

impl Squares {
    /// Normal equations of one press that changed its picture by `change`.
    pub(crate) fn of(terms: &[Term], change: &[f64]) -> Squares {
        let dot = |one: &Term, other: &Term| one.iter().zip(other).map(|(a, b)| a * b).sum();
        let (pixels, _) = change.as_chunks::<3>();
        let seen = |term: &Term| {
            let mut sums = [0.0; 3];
            for (value, pixel) in term.iter().zip(pixels) {
                for (sum, dn) in sums.iter_mut().zip(pixel) {
                    *sum += value * dn;
                }
            }
            sums
        };
        Squares {
            own: terms
                .iter()
                .map(|one| terms.iter().map(|other| dot(one, other)).collect())
                .collect(),
            seen: terms.iter().map(seen).collect(),
        }
    }

    pub(crate) fn terms(&self) -> usize {
        self.seen.len()
    }

    /// Normal equations without the contribution of `press`.
    pub(crate) fn without(&self, press: &Squares) -> Squares {
        self.combined(press, -1.0)
    }

    fn combined(&self, other: &Squares, sign: f64) -> Squares {
        let rows = self.own.iter().zip(&other.own);
        let seen = self.seen.iter().zip(&other.seen);
        Squares {
            own: rows
                .map(|(one, other)| one.iter().zip(other).map(|(a, b)| a + sign * b).collect())
                .collect(),
            seen: seen
                .map(|(one, other)| [0, 1, 2].map(|colour| one[colour] + sign * other[colour]))
                .collect(),
        }
    }

    /// Solves the equations by Cholesky factorisation.
    pub(crate) fn solve(mut self) -> Result<Coefficients, &'static str> {
        let count = self.terms();
        for pivot in 0..count {
            let root = self.own[pivot][pivot];
            if root <= 0.0 {
                return Err("the terms are linearly dependent for these presses");
            }
            let root = root.sqrt();
            for row in pivot..count {
                self.own[row][pivot] /= root;
            }
            for row in pivot + 1..count {
                for column in pivot + 1..=row {
                    self.own[row][column] -= self.own[row][pivot] * self.own[column][pivot];
                }
            }
        }
        let lower = &self.own;
        let mut solution = self.seen;
        let less = |value: [f64; 3], weight: f64, known: [f64; 3]| {
            [0, 1, 2].map(|colour| value[colour] - weight * known[colour])
        };
        for row in 0..count {
            let own = (0..row).fold(solution[row], |value, k| {
                less(value, lower[row][k], solution[k])
            });
            solution[row] = own.map(|value| value / lower[row][row]);
        }
        for row in (0..count).rev() {
            let own = (row + 1..count).fold(solution[row], |value, k| {
                less(value, lower[k][row], solution[k])
            });
            solution[row] = own.map(|value| value / lower[row][row]);
        }
        Ok(Coefficients(solution))
    }
}

impl<'a> Sum<&'a Squares> for Squares {
    fn sum<I: Iterator<Item = &'a Squares>>(mut parts: I) -> Squares {
        let first = parts.next().cloned().unwrap_or(Squares {
            own: Vec::new(),
            seen: Vec::new(),
        });
        parts.fold(first, |sum, part| sum.combined(part, 1.0))
    }
}

impl Coefficients {
    /// Predicted change of the picture for a press with these terms, three colours per pixel.
    pub(crate) fn draw(&self, terms: &[Term]) -> Vec<f64> {
        let pixels = terms.first().map_or(0, Vec::len);
        let mut change = vec![[0.0; 3]; pixels];
        for (term, weights) in terms.iter().zip(&self.0) {
            for (pixel, value) in change.iter_mut().zip(term) {
                for (dn, weight) in pixel.iter_mut().zip(weights) {
                    *dn += weight * value;
                }
            }
        }
        change.into_flattened()
    }
}
