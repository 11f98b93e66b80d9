//! Sources with numbers in their table.

use taceva_core::{Coverage, shown};
use taceva_metrics::ExactSum;
use toml::Spanned;

use super::{FACTOR, Numbers, PROBABILITY, Reader, SHARE, deviations, unknown};
use crate::budget::amount::Wanted;
use crate::budget::certificate::factor;
use crate::budget::error::{BudgetError, BudgetProblem};
use crate::budget::freedom::Freedom;
use crate::budget::schema::WrittenSource;
use crate::budget::shape::Shape;
use crate::budget::text::value;

const SHAPES: [&str; 5] = [
    "rectangular",
    "triangular",
    "arcsine",
    "trapezoid",
    "curvilinear_trapezoid",
];

impl Reader<'_> {
    /// Numbers stated in the source's table.
    pub(super) fn stated_numbers(
        &self,
        of: &WrittenSource,
        wanted: Wanted,
        freedom: Freedom,
    ) -> Result<Numbers, BudgetError> {
        if let Some(u) = &of.u {
            return Ok(Numbers::normal(self.width(u, "u", wanted)?, freedom));
        }
        if let Some(expanded) = &of.expanded {
            let coverage = match (&of.k, &of.p) {
                (Some(k), _) => Coverage::Factor(self.number(k, "k", &FACTOR)?),
                (None, p) => {
                    let p = p.as_ref().map(|p| self.number(p, "p", &PROBABILITY));
                    let p = p.transpose()?.unwrap_or_default();
                    let dof = freedom.number();
                    Coverage::Probability { p, dof }
                }
            };
            let expanded = self.width(expanded, "U", wanted)?;
            let u = expanded / factor(coverage).unwrap_or(1.0);
            return Ok(Numbers::normal(u, freedom));
        }
        if let Some(s) = &of.s {
            let u = self.width(s, "s", wanted)? / self.readings(of)?.sqrt();
            return Ok(Numbers::statistical(0.0, u, freedom));
        }
        if let Some(rows) = &of.rows {
            return self.of_rows(rows);
        }
        let Some(half_width) = &of.half_width else {
            return Ok(Numbers::normal(0.0, freedom));
        };
        let shape = self.shape(of, self.width(half_width, "half_width", wanted)?, wanted)?;
        Ok(Numbers {
            shape,
            ..Numbers::normal(0.0, freedom)
        })
    }

    /// Mean of n rows with the standard deviation s: u = s/√n, with n − 1 degrees of freedom.
    fn of_rows(&self, rows: &Spanned<Vec<f64>>) -> Result<Numbers, BudgetError> {
        let values = rows.get_ref();
        if values.len() < 2 || values.iter().any(|value| !value.is_finite()) {
            let problem = BudgetProblem::Keys("`rows` needs two finite numbers or more".to_owned());
            return Err(self.text.error(rows, "rows", problem));
        }
        let n = values.len() as f64;
        let mean = values.iter().copied().collect::<ExactSum>().to_f64() / n;
        let squares: f64 = deviations(values).iter().map(|off| off * off).sum();
        let u = (squares / (n * (n - 1.0))).sqrt();
        Ok(Numbers::statistical(mean, u, Freedom::Finite(n - 1.0)))
    }

    fn shape(
        &self,
        of: &WrittenSource,
        half_width: f64,
        wanted: Wanted,
    ) -> Result<Shape, BudgetError> {
        let Some(shape) = &of.shape else {
            return Ok(Shape::Rectangular { half_width });
        };
        let missing = |key: &str| {
            let problem = BudgetProblem::Keys(format!(
                "`{}` needs the key `{key}`",
                shown(shape.get_ref())
            ));
            self.text.error(shape, key, problem)
        };
        match shape.get_ref().as_str() {
            "rectangular" => Ok(Shape::Rectangular { half_width }),
            "triangular" => Ok(Shape::Triangular { half_width }),
            "arcsine" => Ok(Shape::Arcsine { half_width }),
            "trapezoid" => {
                let beta = of.beta.as_ref().ok_or_else(|| missing("beta"))?;
                let beta = self.number(beta, "beta", &SHARE)?;
                Ok(Shape::Trapezoid { half_width, beta })
            }
            "curvilinear_trapezoid" => {
                let limits = of.limits.as_ref().ok_or_else(|| missing("limits"))?;
                let found = self.width(limits, "limits", wanted)?;
                if found > half_width {
                    let problem = value(found, &format!("at most the half-width, {half_width}"));
                    return Err(self.text.error(limits, "limits", problem));
                }
                Ok(Shape::CurvilinearTrapezoid {
                    half_width,
                    limits: found,
                })
            }
            other => Err(self
                .text
                .error(shape, "shape", unknown(other, "shape", &SHAPES))),
        }
    }
}
