//! Sources that use a measured figure or the certificate.

use taceva_core::shown;
use toml::Spanned;

use super::{HOURS, Numbers, READINGS, Reader, unknown};
use crate::budget::error::{BudgetError, BudgetProblem};
use crate::budget::evidence::Figure;
use crate::budget::freedom::Freedom;
use crate::budget::schema::WrittenSource;
use crate::budget::shape::Shape;
use crate::budget::text::value;

impl Reader<'_> {
    /// Measured figure that the source uses; `None` without `from`, and for the certificate.
    pub(super) fn figure(&self, of: &WrittenSource) -> Result<Option<&Figure>, BudgetError> {
        let Some(from) = of
            .from
            .as_ref()
            .filter(|from| from.get_ref() != "certificate")
        else {
            return Ok(None);
        };
        let name = from.get_ref();
        let known: Vec<&str> = self.evidence.names().chain(["certificate"]).collect();
        let missing = || {
            self.text
                .error(from, "from", unknown(name, "measured figure here", &known))
        };
        self.evidence.figure(name).map(Some).ok_or_else(missing)
    }

    pub(super) fn measured(
        &self,
        of: &WrittenSource,
        from: &Spanned<String>,
        figure: Option<&Figure>,
    ) -> Result<Numbers, BudgetError> {
        let Some(figure) = figure else {
            return self.certificate(from);
        };
        let is_sound = figure.u >= 0.0 && figure.u.is_finite() && figure.value.is_finite();
        if !is_sound {
            return Err(self.text.error(
                from,
                "from",
                value(figure.u, "a figure whose u is finite and 0 or more"),
            ));
        }
        if from.get_ref() == "drift" {
            let Some(hours) = &of.hours else {
                let problem = BudgetProblem::Keys(
                    "`from = \"drift\"` needs `hours`, the time since calibration".to_owned(),
                );
                return Err(self.text.error(from, "hours", problem));
            };
            let hours = self.number(hours, "hours", &HOURS)?;
            let half_width = figure.value.abs() * hours;
            return Ok(Numbers {
                shape: Shape::Rectangular { half_width },
                ..Numbers::normal(0.0, Freedom::Infinite)
            });
        }
        let readings = self.readings(of)?;
        Ok(Numbers::statistical(
            figure.value,
            figure.u / readings.sqrt(),
            figure.freedom,
        ))
    }

    pub(super) fn readings(&self, of: &WrittenSource) -> Result<f64, BudgetError> {
        match &of.readings {
            Some(readings) => self.number(readings, "readings", &READINGS),
            None => Ok(1.0),
        }
    }

    fn certificate(&self, from: &Spanned<String>) -> Result<Numbers, BudgetError> {
        let error = |problem| self.text.error(from, "from", problem);
        let Some(certificate) = self.evidence.certificate() else {
            let problem =
                "the recording has no certificate; state it in the rig file, or `U` and `k` here";
            return Err(error(BudgetProblem::Keys(problem.to_owned())));
        };
        let own = shown(&certificate.serial);
        let other = certificate.instrument_serial.as_ref();
        if let Some(serial) = other.filter(|serial| **serial != certificate.serial) {
            return Err(error(BudgetProblem::Certificate(format!(
                "the certificate is for serial number `{own}`, but the instrument has `{}`",
                shown(serial)
            ))));
        }
        let is_of_reading = certificate.range.is_some() || certificate.relative > 0.0;
        if self.text.at.is_empty() && is_of_reading {
            let problem = "the certificate depends on the reading, so the key `at` is needed, such as `at = [\"1 N\"]`";
            return Err(error(BudgetProblem::Keys(problem.to_owned())));
        }
        let (at, unit) = (self.at, &self.text.unit);
        let outside = |[low, high]: &[f64; 2]| !(*low <= at && at <= *high);
        if let Some([low, high]) = certificate.range.filter(outside) {
            return Err(error(BudgetProblem::Certificate(format!(
                "{at} {unit} is outside the certificate's range, {low} to {high} {unit}"
            ))));
        }
        let u = certificate.standard_uncertainty(self.at);
        let u = u.filter(|u| {
            u.is_finite() && certificate.absolute >= 0.0 && certificate.relative >= 0.0
        });
        let Some(u) = u else {
            return Err(error(BudgetProblem::Value {
                found: format!("U = {}, {}", certificate.absolute, certificate.coverage),
                expected: "U of 0 or more, with k above 0 or p between 0 and 1".to_owned(),
            }));
        };
        Ok(Numbers::normal(u, certificate.freedom()))
    }
}
