//! Computes the figures of a calibration curve.

use taceva_core::counted;
use taceva_metrology::curve::{
    Band, CurveUndefined, DetectionRisks, Indication, IndicationSummary, ProvingFigures,
};

use super::{CalibrationCurve, CurveFigure, CurveRequest};

impl CalibrationCurve {
    /// Figures requested by `request`. If an inverse prediction or a detection limit is undefined, its remark states the reason.
    ///
    /// # Errors
    /// [`CurveUndefined::Probability`] and [`CurveUndefined::NotPositive`] for an invalid request; the reason why series have no figures.
    pub fn figures(&self, request: &CurveRequest) -> Result<Vec<CurveFigure>, CurveUndefined> {
        let mut figures = self.of_fit();
        for &x in &request.at {
            let (name, band) = match request.is_simultaneous {
                true => ("simultaneous", self.fit.simultaneous(x, request.p)?),
                false => ("confidence", self.fit.confidence(x, request.p)?),
            };
            figures.push(self.of_band(name, x, &band));
        }
        for &x in &request.at {
            let band = self.fit.prediction(x, request.p, request.readings)?;
            figures.push(self.of_band("prediction", x, &band));
        }
        for &y in &request.inverted {
            let figure = CurveFigure {
                at: Some(y),
                ..self.figure("inverse", &self.x.unit)
            };
            figures.push(match self.fit.invert(y, request.p, request.readings) {
                Ok(found) => CurveFigure {
                    value: Some(found.x),
                    ends: Some([found.low, found.high]),
                    remark: self.within(found.x, found.covariance.to_string()),
                    ..figure
                },
                Err(reason) => undefined(figure, reason)?,
            });
        }
        if request.detects {
            let risks = DetectionRisks {
                readings: request.readings,
                ..DetectionRisks::default()
            };
            let found = self.fit.detection(risks);
            for name in ["critical", "detectable"] {
                let figure = self.figure(name, &self.x.unit);
                figures.push(match found {
                    Ok(found) => CurveFigure {
                        value: Some(match name {
                            "critical" => found.critical,
                            _ => found.detectable,
                        }),
                        remark: "independent rows".to_owned(),
                        ..figure
                    },
                    Err(reason) => undefined(figure, reason)?,
                });
            }
        }
        if let Some(series) = &request.proving {
            figures.extend(self.of_proving(&series.figures()?));
        }
        if let Some(readings) = &request.indications {
            figures.extend(self.of_indications(readings, request.indicated_points));
        }
        Ok(figures)
    }

    /// Relative errors at each force. The remark names the row of limits, similar to those of ISO 376, that the errors at this force meet.
    fn of_proving(&self, found: &ProvingFigures) -> Vec<CurveFigure> {
        let mut figures = Vec::new();
        for (at, level) in found.levels.iter().enumerate() {
            let place = format!("like ISO 376: {}", found.standing(at));
            let all = [
                ("proving_b", Some(level.b), ""),
                ("proving_b_prime", level.b_prime, "series X2 is missing"),
                ("proving_f_c", Some(level.f_c), ""),
                ("proving_v", level.v, "series X4' or X6' is missing"),
            ];
            figures.extend(all.map(|(quantity, value, missing)| CurveFigure {
                at: Some(level.force),
                value,
                remark: match value {
                    Some(_) => place.clone(),
                    None => missing.to_owned(),
                },
                ..self.figure(quantity, "%")
            }));
        }
        figures
    }

    /// Statistics of the relative errors of readings at `points` contact points.
    fn of_indications(&self, readings: &[Indication], points: Option<usize>) -> [CurveFigure; 3] {
        let found = IndicationSummary::of(readings);
        let points = points.map_or_else(String::new, |points| {
            format!(" of {}", counted(points, "contact point"))
        });
        let figure = |quantity: &str, value: fn(&IndicationSummary) -> f64| CurveFigure {
            value: found.as_ref().ok().map(value),
            remark: match &found {
                Ok(found) => format!(
                    "like ISO 7500-1, of {}{points}; no class",
                    counted(found.n, "reading")
                ),
                Err(reason) => reason.to_string(),
            },
            ..self.figure(quantity, "%")
        };
        [
            figure("relative_error_median", |of| of.median_abs),
            figure("relative_error_p95", |of| of.p95_abs),
            figure("share_within_class_3", |of| 100.0 * of.share_within_3),
        ]
    }

    /// Coefficients, residual standard deviation, and lack of fit if readings repeat.
    fn of_fit(&self) -> Vec<CurveFigure> {
        let freedom = Some(self.fit.freedom());
        let coefficients = self.fit.coefficients().into_iter().enumerate();
        let mut figures: Vec<CurveFigure> = coefficients
            .map(|(power, value)| {
                let own = self.fit.coefficient_uncertainty(power);
                CurveFigure {
                    value: Some(value),
                    u: own.map(|own| own.u),
                    freedom: own.map(|own| own.freedom),
                    remark: own.map_or_else(String::new, |own| own.covariance.to_string()),
                    ..self.figure(&format!("coefficient_{power}"), &self.unit_of(power))
                }
            })
            .collect();
        figures.push(CurveFigure {
            value: Some(self.fit.residual_deviation()),
            freedom,
            ..self.figure("residual_deviation", &self.y.unit)
        });
        if let Some(test) = self.fit.lack_of_fit() {
            let [above, below] = test.freedoms;
            figures.push(CurveFigure {
                value: Some(test.f),
                remark: format!(
                    "F of {above} and {below} degrees of freedom, for independent rows"
                ),
                ..self.figure("lack_of_fit_f", "1")
            });
            figures.push(CurveFigure {
                value: Some(test.p),
                remark: "independent rows".to_owned(),
                ..self.figure("lack_of_fit_p", "1")
            });
        }
        figures
    }

    fn of_band(&self, name: &str, x: f64, band: &Band) -> CurveFigure {
        CurveFigure {
            at: Some(x),
            value: Some(band.value),
            ends: Some([band.low, band.high]),
            u: Some(band.u),
            freedom: Some(band.freedom),
            remark: self.within(x, band.covariance.to_string()),
            ..self.figure(name, &self.y.unit)
        }
    }

    /// Appends a warning to `remark` if `x` is outside the range of the reference values.
    fn within(&self, x: f64, remark: String) -> String {
        let [low, high] = self.fit.range();
        // The ends themselves are rounded.
        let rounding = 1e-9 * (high - low);
        match low - rounding <= x && x <= high + rounding {
            true => remark,
            false => format!("{remark}; beyond the reference values, {low} to {high}"),
        }
    }

    fn figure(&self, quantity: &str, unit: &str) -> CurveFigure {
        CurveFigure {
            quantity: quantity.to_owned(),
            unit: unit.to_owned(),
            ..CurveFigure::default()
        }
    }

    /// Unit of the polynomial coefficient of x to the power `power`.
    fn unit_of(&self, power: usize) -> String {
        let [x, y] = [&self.x.unit, &self.y.unit];
        let power = match power {
            0 => return y.clone(),
            1 => "",
            2 => "²",
            _ => "³",
        };
        match x.is_empty() || y.is_empty() {
            true => String::new(),
            false => format!("{y}/{x}{power}"),
        }
    }
}

/// Figure without a value, or the error if the request itself is invalid.
fn undefined(figure: CurveFigure, reason: CurveUndefined) -> Result<CurveFigure, CurveUndefined> {
    match reason {
        CurveUndefined::Probability(_) | CurveUndefined::NotPositive { .. } => Err(reason),
        _ => Ok(CurveFigure {
            remark: reason.to_string(),
            ..figure
        }),
    }
}
