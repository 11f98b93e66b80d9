//! Second-order dual numbers: values with their first and second derivatives.

/// Number type for the evaluation of expressions.
pub(super) trait Scalar: Clone {
    /// Constant with zero derivatives, as many as `like` has.
    fn constant(value: f64, like: &Self) -> Self;
    /// Value without derivatives.
    fn value(&self) -> f64;
    fn plus(self, other: &Self) -> Self;
    fn times(self, other: &Self) -> Self;
    /// Applies a function g by the chain rule. `derivatives` are g, g′ and g″ at this value.
    fn chained(self, derivatives: [f64; 3]) -> Self;
    /// True if the number depends on no input.
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

/// Value of an expression with its derivatives, in the unit of the expression, divided by the units of the inputs.
///
/// This type gets no further field: derivatives of third order are not computed.
///
/// ```
/// use taceva_metrology::budget::Expression;
/// let square = Expression::parse("x^2", &["x"])?.expand(&[3.0])?;
/// assert_eq!((square.gradient[0], square.hessian[0]), (6.0, 2.0));
/// # Ok::<(), taceva_metrology::budget::ExpressionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expansion {
    /// Value of the expression.
    pub value: f64,
    /// First derivative with respect to each input.
    pub gradient: Vec<f64>,
    /// Second derivatives with respect to pairs of inputs, row by row.
    pub hessian: Vec<f64>,
}

impl Expansion {
    /// The input at `index` among `count` inputs, with the derivative 1.
    pub(super) fn input(value: f64, index: usize, count: usize) -> Expansion {
        let slope = |at: usize| if at == index { 1.0 } else { 0.0 };
        Expansion {
            value,
            gradient: (0..count).map(slope).collect(),
            hessian: vec![0.0; count * count],
        }
    }
}

impl Scalar for Expansion {
    fn constant(value: f64, like: &Expansion) -> Expansion {
        Expansion {
            value,
            gradient: vec![0.0; like.gradient.len()],
            hessian: vec![0.0; like.hessian.len()],
        }
    }

    fn value(&self) -> f64 {
        self.value
    }

    fn plus(mut self, other: &Expansion) -> Expansion {
        self.value += other.value;
        let pairs = self.gradient.iter_mut().zip(&other.gradient);
        pairs
            .chain(self.hessian.iter_mut().zip(&other.hessian))
            .for_each(|(own, its)| *own += its);
        self
    }

    fn times(mut self, other: &Expansion) -> Expansion {
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

    fn chained(mut self, [value, first, second]: [f64; 3]) -> Expansion {
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
