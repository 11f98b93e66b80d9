//! Numbers with their first and second derivatives: dual numbers of second order.

/// A number that an expression is evaluated with.
pub(super) trait Scalar: Clone {
    /// A constant beside `like`.
    fn constant(value: f64, like: &Self) -> Self;
    /// The number itself.
    fn value(&self) -> f64;
    fn plus(self, other: &Self) -> Self;
    fn times(self, other: &Self) -> Self;
    /// g(self) by g, g′ and g″ there.
    fn chained(self, derivatives: [f64; 3]) -> Self;
    /// True if it depends on no input.
    fn is_constant(&self) -> bool;
}

impl Scalar for f64 {
    fn constant(value: f64, _: &f64) -> f64 {
        value
    }
    fn value(&self) -> f64 {
        *self
    }
    fn plus(self, other: &f64) -> f64 {
        self + other
    }
    fn times(self, other: &f64) -> f64 {
        self * other
    }
    fn chained(self, [value, ..]: [f64; 3]) -> f64 {
        value
    }
    fn is_constant(&self) -> bool {
        false
    }
}

/// A value with its gradient and its Hessian, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dual {
    pub(super) value: f64,
    pub(super) gradient: Vec<f64>,
    pub(super) hessian: Vec<f64>,
}

impl Dual {
    /// Input `index` of `count`.
    pub(super) fn input(value: f64, index: usize, count: usize) -> Dual {
        let mut gradient = vec![0.0; count];
        if let Some(own) = gradient.get_mut(index) {
            *own = 1.0;
        }
        Dual {
            value,
            gradient,
            hessian: vec![0.0; count * count],
        }
    }
}

impl Scalar for Dual {
    fn constant(value: f64, like: &Dual) -> Dual {
        Dual {
            value,
            gradient: vec![0.0; like.gradient.len()],
            hessian: vec![0.0; like.hessian.len()],
        }
    }

    fn value(&self) -> f64 {
        self.value
    }

    fn plus(mut self, other: &Dual) -> Dual {
        self.value += other.value;
        let pairs = self.gradient.iter_mut().zip(&other.gradient);
        pairs
            .chain(self.hessian.iter_mut().zip(&other.hessian))
            .for_each(|(own, its)| *own += its);
        self
    }

    fn times(mut self, other: &Dual) -> Dual {
        let count = self.gradient.len();
        for row in 0..count {
            for column in 0..count {
                let at = row * count + column;
                self.hessian[at] = self.hessian[at] * other.value
                    + other.hessian[at] * self.value
                    + self.gradient[row] * other.gradient[column]
                    + self.gradient[column] * other.gradient[row];
            }
        }
        let pairs = self.gradient.iter_mut().zip(&other.gradient);
        pairs.for_each(|(own, its)| *own = *own * other.value + its * self.value);
        self.value *= other.value;
        self
    }

    fn chained(mut self, [value, first, second]: [f64; 3]) -> Dual {
        let count = self.gradient.len();
        for row in 0..count {
            for column in 0..count {
                let at = row * count + column;
                let curved = second * self.gradient[row] * self.gradient[column];
                self.hessian[at] = first * self.hessian[at] + curved;
            }
        }
        self.gradient.iter_mut().for_each(|slope| *slope *= first);
        self.value = value;
        self
    }

    fn is_constant(&self) -> bool {
        self.gradient
            .iter()
            .chain(&self.hessian)
            .all(|part| part.abs() <= 0.0)
    }
}
