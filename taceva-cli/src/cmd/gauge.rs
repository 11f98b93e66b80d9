//! `taceva gauge`.

mod factor;
mod response;

use std::num::NonZeroUsize;

use anyhow::anyhow;
use taceva_core::shown;
use taceva_evaluate::read_table;
use taceva_import::CsvTable;
use taceva_metrology::gauge::{Design, GaugeError, GaugeSettings, GaugeStudy, Method};
use taceva_report::{ChannelGauge, GaugeColumns, GaugeStudies};

use super::quantity::Quantity;
use super::{Context, Usage, origin, results};
use crate::args::{Format, Gauge, GaugeMethod};
use crate::{exit, output};
use factor::Factors;
use response::Response;

pub(crate) fn run(args: &Gauge, context: &Context) -> anyhow::Result<u8> {
    output::check_all_free(&args.output.path, args.output.force)?;
    let studies = studies(args, context.jobs)?;
    let written = match args.output.format {
        Format::Csv => studies.numbers(),
        _ => studies.table(),
    };
    results::write(&written, &args.output, || {
        let first = studies.channels.first();
        first.map_or_else(String::new, |of| studies.json(of))
    })?;
    Ok(exit::DONE)
}

/// Computes a gauge study for each channel of the arguments.
pub(crate) fn studies(args: &Gauge, jobs: NonZeroUsize) -> anyhow::Result<GaugeStudies> {
    let tolerance = args.tolerance.as_deref();
    let tolerance = tolerance.map(|written| Quantity::read("--tolerance", written));
    let tolerance = tolerance.transpose()?;
    let (table, digest) = read_table(&args.table, jobs)?;
    let readings = Readings {
        factors: Factors::of(&table, args)?,
        table: &table,
    };
    let responses = response::of(&table, args, tolerance.as_ref())?;
    if args.output.format == Format::Json && responses.len() > 1 {
        let names: Vec<&str> = responses.iter().map(|of| of.channel.as_str()).collect();
        return Err(Usage::error(format!(
            "--format json writes one channel: add --channels with one of {}",
            names.join(", ")
        )));
    }
    let settings = settings(args, tolerance.as_ref());
    let channels = responses.iter().map(|of| readings.study(of, &settings));
    Ok(GaugeStudies {
        columns: GaugeColumns {
            part: args.part.clone(),
            by: args.by.clone(),
            trial: args.trial.clone(),
        },
        channels: channels.collect::<anyhow::Result<_>>()?,
        sources: origin::of(&table)?,
        digest: digest.to_string(),
    })
}

fn settings(args: &Gauge, tolerance: Option<&Quantity>) -> GaugeSettings {
    let mut settings = GaugeSettings::default();
    settings.design = match args.nested {
        true => Design::Nested,
        false => Design::Crossed,
    };
    settings.method = match args.method {
        GaugeMethod::Anova => Method::Anova,
        GaugeMethod::Range => Method::Range,
    };
    settings.pool = args.pool;
    settings.tolerance = tolerance.map(|of| of.value);
    settings.drop_incomplete = args.drop_incomplete;
    settings
}

/// Table of readings with the columns that name parts, operators and trials.
struct Readings<'a> {
    table: &'a CsvTable,
    factors: Factors,
}

impl Readings<'_> {
    /// Computes the study of one channel.
    fn study(&self, of: &Response, settings: &GaugeSettings) -> anyhow::Result<ChannelGauge> {
        let mut study = GaugeStudy::default();
        let mut rows_left_out = 0;
        for row in 0..self.table.rows() {
            let Some(labels) = self.factors.labels(self.table, row) else {
                rows_left_out += 1;
                continue;
            };
            let Some(reading) = of.reading(self.table, row)? else {
                rows_left_out += 1;
                continue;
            };
            study
                .add(&labels.part, &labels.operator, &labels.trial, reading)
                .map_err(|error| {
                    let place = self.table.place(row, of.column()).to_string();
                    anyhow::Error::new(error).context(place)
                })?;
        }
        if study.is_empty() {
            return Err(self.no_reading(of));
        }
        let mut settings = settings.clone();
        settings.are_errors = of.is_error();
        settings.unit = of.unit.map_or("", |unit| unit.symbol()).to_owned();
        let report = study.analyse(&settings);
        Ok(ChannelGauge {
            channel: of.channel.clone(),
            response: of.name(),
            rows_left_out,
            report: report.map_err(|error| self.refused(error, of))?,
        })
    }

    fn no_reading(&self, of: &Response) -> anyhow::Error {
        anyhow!(
            "{}: no row has a reading of channel {} and a label in each of {}; --part, --by and --trial name other columns",
            shown(self.table.path()),
            shown(&of.channel),
            self.factors.names(self.table)
        )
    }

    /// Adds the position of the affected rows in the table to an error.
    fn refused(&self, error: GaugeError, of: &Response) -> anyhow::Error {
        let place = match &error {
            GaugeError::Setting {
                name,
                value,
                expected,
            } => return Usage::error(format!("--{name} {value}: expected {expected}")),
            GaugeError::RangeOfNested => return Usage::error(error.to_string()),
            GaugeError::RepeatedTrial {
                part,
                operator,
                trial,
            } => {
                let is_it = |row: &usize| {
                    let labels = self.factors.labels(self.table, *row);
                    let has_labels = labels.is_some_and(|labels| {
                        *labels.part == **part
                            && *labels.operator == **operator
                            && *labels.trial == **trial
                    });
                    has_labels && matches!(of.reading(self.table, *row), Ok(Some(_)))
                };
                let second = (0..self.table.rows()).filter(is_it).nth(1);
                second.map(|row| self.table.place(row, of.column()).to_string())
            }
            _ => None,
        };
        let place = place.unwrap_or_else(|| {
            format!(
                "{}, channel {}, by {}",
                shown(self.table.path()),
                shown(&of.channel),
                self.factors.names(self.table)
            )
        });
        anyhow::Error::new(error).context(place)
    }
}
