//! Measured figures of one channel, from a result and its samples.

use std::path::Path;

use taceva_core::{Date, shown};
use taceva_metrology::budget::{
    BudgetError, BudgetText, Components, Evidence, Figure, Freedom, Missing,
};
use taceva_report::{depth_zero_figure, reference_certificate, residual_components};
use taceva_results::{EvaluationReport, Samples, Score};

use crate::cmd::quantity::unit_of_six;
use crate::cmd::{Usage, results};

/// Names of the figures that are computed from residuals of presses.
const RESIDUALS: [&str; 4] = ["error", "error.between", "error.within", "bias"];
/// Names of the figures that are taken from scores.
const SCORES: [&str; 4] = ["repeatability", "drift", "r_light", "hysteresis"];
/// Name of the figure for the zero of depths, and of its column in the samples.
const ZERO: &str = Samples::ZERO_U;
/// Channels for a template, in order of preference.
const CHANNELS: [&str; 6] = ["Fz", "Fx", "Fy", "Pz", "Px", "Py"];

/// Message for a missing certificate, with the remedy.
fn without_certificate(reason: &str) -> String {
    format!("{reason}; add --certificate CERTIFICATE.toml, or state `U` and `k`")
}

/// Measurand of a budget.
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) unit: String,
}

impl Channel {
    pub(super) fn of(name: &str, unit: &str) -> Channel {
        Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
        }
    }
}

/// Figures of a result that were measured, and figures without a value, each with the reason.
#[derive(Default)]
pub(super) struct Measured {
    pub(super) evidence: Evidence,
    pub(super) origins: Vec<String>,
    pub(super) sensor: Option<String>,
    pub(super) absent: Vec<Missing>,
    /// Day on which certificates must be valid; `None` if unknown.
    pub(super) recorded_on: Option<Date>,
}

impl Measured {
    pub(super) fn without_result() -> Measured {
        let mut measured = Measured::default();
        for figure in RESIDUALS.into_iter().chain(SCORES).chain([ZERO]) {
            measured.lacks(figure, "no result is given; add --results RESULT.json");
        }
        measured.lacks(
            "certificate",
            &without_certificate("the recording has no certificate"),
        );
        measured
    }

    pub(super) fn of_report(found: &Found, channel: &Channel, date: Option<Date>) -> Measured {
        let subject = &found.report.subject;
        let mut measured = Measured {
            sensor: Some(subject.sensor.clone()),
            origins: vec![subject.source.clone()],
            recorded_on: date.or(found.report.provenance.recorded_on),
            ..Measured::default()
        };
        measured.add_residuals(found, channel);
        for figure in SCORES {
            match found.figure(figure, channel) {
                Ok(value) => measured.take(|evidence| evidence.with(figure, value)),
                Err(reason) => measured.lacks(figure, &reason),
            }
        }
        // Only depths have a zero, so other channels do not lack this figure.
        if channel.name == "Pz" {
            match found.zero(channel) {
                Ok(value) => measured.take(|evidence| evidence.with(ZERO, value)),
                Err(reason) => measured.lacks(ZERO, &reason),
            }
        }
        measured.add_certificate(found, channel);
        measured
    }

    /// Replaces the evidence by the result of `change`.
    pub(super) fn take(&mut self, change: impl FnOnce(Evidence) -> Evidence) {
        self.evidence = change(std::mem::take(&mut self.evidence));
    }

    /// Rejects a source that names a figure without a value.
    pub(super) fn check(&self, budget: &BudgetText) -> Result<(), BudgetError> {
        for figure in budget.figures() {
            let is_there = match figure {
                "certificate" => self.evidence.certificate().is_some(),
                _ => self.evidence.figure(figure).is_some(),
            };
            let absent = self.absent.iter().find(|absent| absent.source == figure);
            if let Some(absent) = absent.filter(|_| !is_there) {
                return Err(budget.not_measured(figure, &absent.reason));
            }
        }
        Ok(())
    }

    fn lacks(&mut self, figure: &str, reason: &str) {
        self.absent.push(Missing::new(figure, reason));
    }

    /// Adds the certificate of the reference for the channel, or the reason why the result has no single certificate.
    fn add_certificate(&mut self, found: &Found, channel: &Channel) {
        let stated = &found.report.provenance.traceability;
        match reference_certificate(stated, &channel.name, self.recorded_on) {
            Ok(only) => self.take(|evidence| evidence.with_certificate(only)),
            Err(reason) => self.lacks("certificate", &without_certificate(reason)),
        }
    }

    fn add_residuals(&mut self, found: &Found, channel: &Channel) {
        match found.components(channel, "calibration", "point_id") {
            Ok(mut components) => {
                let note = found.score("mae", channel).ok();
                let note = note.and_then(|score| score.standing.reason());
                let all = [
                    &mut components.rmse,
                    &mut components.between,
                    &mut components.within,
                    &mut components.bias,
                ];
                for figure in all {
                    figure
                        .digest
                        .clone_from(&found.report.provenance.samples_table);
                }
                for figure in [&mut components.rmse, &mut components.within] {
                    figure.note = note.map(str::to_owned);
                }
                self.take(|evidence| components.feed(evidence));
            }
            Err(reason) => RESIDUALS
                .into_iter()
                .for_each(|figure| self.lacks(figure, &reason)),
        }
    }
}

/// The result of one sensor.
pub(super) struct Found {
    report: EvaluationReport,
    /// Message if the samples of the result were not found; `None` if they were found.
    without_samples: Option<String>,
}

/// Reads the result of the single sensor at `path`, with its samples.
pub(super) fn report_of(path: &Path) -> anyhow::Result<Found> {
    let mut found = results::reports(path)?;
    Ok(Found {
        report: results::of_one_sensor(path, found.reports)?,
        without_samples: found.missing.pop(),
    })
}

impl Found {
    /// The channel called `asked`, or without a name the first scored channel of [`CHANNELS`].
    pub(super) fn channel(&self, asked: Option<&str>) -> anyhow::Result<Channel> {
        let scores = || self.report.scores.iter();
        let is_scored = |name: &&str| scores().any(|score| score.channel == *name);
        let known: Vec<&str> = CHANNELS.into_iter().filter(is_scored).collect();
        let found = known
            .iter()
            .find(|name| asked.is_none_or(|asked| asked == **name));
        let unit = found.and_then(|name| unit_of_six(name));
        match (found, unit) {
            (Some(name), Some(unit)) => Ok(Channel::of(name, unit.symbol())),
            _ => Err(Usage::error(format!(
                "--channel {}: the result has no score of this channel, expected one of {}",
                shown(asked.unwrap_or("Fz")),
                known.join(", ")
            ))),
        }
    }

    /// Half of the label that is farthest from 0, to two digits; 1 without labels.
    pub(super) fn middle_of(&self, channel: &Channel) -> f64 {
        let samples = self.report.samples.as_ref();
        let labels = samples.and_then(|samples| samples.channel(&channel.name));
        let truths = labels.into_iter().flat_map(|of| of.truths());
        let farthest = truths.fold(
            0.0_f64,
            |far, truth| if truth.abs() > far.abs() { truth } else { far },
        );
        let half = format!("{:.1e}", farthest / 2.0).parse().unwrap_or(0.0_f64);
        if half.abs() > 0.0 { half } else { 1.0 }
    }

    /// Variance components of the residuals of one part of the protocol, grouped by a column.
    fn components(
        &self,
        channel: &Channel,
        part: &str,
        column: &str,
    ) -> Result<Components, String> {
        residual_components(self.samples()?, &channel.name, part, column)
    }

    /// Samples of the result, or the reason why there are none.
    fn samples(&self) -> Result<&Samples, String> {
        self.report.samples.as_ref().ok_or_else(|| {
            let message = self.without_samples.as_deref();
            let message = message.unwrap_or("the result has no samples");
            format!("{message}; `--samples-out` of evaluate writes them")
        })
    }

    /// Uncertainty of the zeros, the heights from which depths are measured.
    fn zero(&self, channel: &Channel) -> Result<Figure, String> {
        let mut figure = depth_zero_figure(self.samples()?, &channel.name)?;
        let table = &self.report.provenance.samples_table;
        figure.digest.clone_from(table);
        Ok(figure)
    }

    /// Score of the channel. If a variant decides verdicts, the score of this variant.
    fn score(&self, metric: &str, channel: &Channel) -> Result<Score, String> {
        let Some(score) = self.report.score(metric, &channel.name) else {
            let what = format!("metric:{metric}");
            let skip = self.report.skipped.iter().find(|skip| skip.what == what);
            return Err(skip.map_or_else(|| "not scored".to_owned(), |skip| skip.reason.clone()));
        };
        Ok(score.deciding())
    }

    /// Computes the figure called `figure` from a score or from samples.
    fn figure(&self, figure: &str, channel: &Channel) -> Result<Figure, String> {
        match figure {
            "repeatability" => self.repeatability(channel),
            "drift" => {
                let score = self.score("drift", channel)?;
                let slope = Figure::of_drift(number(&score)?);
                Ok(noted(slope, &score))
            }
            "r_light" => self.light(channel),
            _ => Err("no predictions while unloading".to_owned()),
        }
    }

    /// Pooled standard deviation of repeats. Degrees of freedom: samples minus cells, the groups of repeats.
    fn repeatability(&self, channel: &Channel) -> Result<Figure, String> {
        let score = self.score("repeatability", channel)?;
        let mut counts = score.counts.iter();
        let cells = counts.find(|(name, _)| name == "cells_total");
        let freedom = cells.and_then(|(_, cells)| score.n.checked_sub(*cells));
        let freedom = freedom.filter(|freedom| *freedom > 0);
        let freedom = freedom.ok_or_else(|| "the result states no number of repeats".to_owned())?;
        let figure = Figure::new(number(&score)?, Freedom::Finite(freedom as f64));
        Ok(noted(figure, &score))
    }

    /// Standard deviation between light scenes of the mean residual in each scene.
    fn light(&self, channel: &Channel) -> Result<Figure, String> {
        let samples = self.report.samples.as_ref();
        if samples.is_some_and(|samples| !samples.has("protocol")) {
            return Err("the samples name no light sweep".to_owned());
        }
        let mut figure = self.components(channel, "light-sweep", "scene")?.between;
        figure
            .digest
            .clone_from(&self.report.provenance.samples_table);
        Ok(figure)
    }
}

fn number(score: &Score) -> Result<f64, String> {
    let reason = score.value.reason();
    let reason = || reason.unwrap_or_else(|| "not a number".to_owned());
    score.value.number().ok_or_else(reason)
}

/// Adds to the figure the number of samples, and the reason why verdicts exclude the score, if any.
fn noted(mut figure: Figure, score: &Score) -> Figure {
    figure.n = Some(score.n);
    figure.note = score.standing.reason().map(str::to_owned);
    figure
}
