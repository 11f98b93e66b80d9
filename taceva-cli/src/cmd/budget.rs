//! `taceva budget`.

mod evidence;
mod gauge_file;

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use taceva_core::shown;
use taceva_dataset::internal::quoted;
use taceva_metrology::budget::{BudgetText, Certificate, MonteCarlo};
use taceva_report::{BudgetReport, BudgetTemplate};

use super::quantity::Quantity;
use super::{Usage, results};
use crate::args::{Budget, Format};
use crate::{exit, output};
use evidence::{Channel, Measured};

pub(crate) fn run(args: &Budget) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.page.path);
    output::check_all_free(files, args.output.force)?;
    if let Some(result) = &args.template {
        let text = template(args, result)?;
        output::write(args.output.path.as_deref(), |out| {
            out.write_all(text.as_bytes())
        })?;
        return Ok(exit::DONE);
    }
    let report = report(args)?;
    write(&report, args)?;
    Ok(match report.is_passed() {
        true => exit::DONE,
        false => exit::CHECK_FAILED,
    })
}

/// Computes the budgets of the file of sources.
pub(crate) fn report(args: &Budget) -> anyhow::Result<BudgetReport> {
    let Some(path) = &args.sources else {
        return Err(Usage::error("expected BUDGET.toml; --template writes one"));
    };
    let text = read(path)?;
    let place = || shown(path).to_string();
    let budget = BudgetText::parse(&text).with_context(place)?;
    if !budget.has_source() {
        anyhow::bail!(
            "{}: no `[[source]]`, expected one or more; the comments of a template state why a source is left out",
            place()
        );
    }
    let budget = at(budget, args)?;
    let most = args.most.as_deref();
    let most = most.map(|written| amount("--most-U", written, &budget));
    let most = most.transpose()?;
    let channel = Channel::of(budget.measurand(), budget.unit());
    let mut measured = match &args.results {
        Some(result) => Measured::of_report(&evidence::report_of(result)?, &channel, args.date),
        None => Measured::without_result(),
    };
    certify(&mut measured, args, &channel)?;
    let folder = taceva_files::parent_of(path);
    gauge_file::add_components(&mut measured, &budget, folder).with_context(place)?;
    measured.check(&budget).with_context(place)?;
    let draws = (args.draws > 0).then(|| {
        let draws = MonteCarlo::default().with_draws(args.draws);
        draws.with_seed(args.seed)
    });
    let budgets = budget.budgets(&measured.evidence, draws);
    Ok(BudgetReport {
        budgets: budgets.with_context(place)?,
        sensor: measured.sensor,
        origins: measured.origins,
        digest: taceva_files::seal::digest_of_bytes(text.as_bytes()),
        most: most.map(|most| most.value),
    })
}

fn write(report: &BudgetReport, args: &Budget) -> anyhow::Result<()> {
    let written = match args.output.format {
        Format::Csv => report.numbers(),
        _ => report.table(),
    };
    results::write(&written, &args.output, || {
        let first = report.budgets.first();
        first.map_or_else(String::new, |budget| report.json(budget))
    })?;
    if let Some(path) = &args.page.path {
        let page = report.page();
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(())
}

fn read(path: &Path) -> anyhow::Result<String> {
    fs::read_to_string(path).with_context(|| format!("cannot read {}", shown(path)))
}

/// Sets the values of `--at` in the budget. JSON allows only one value.
fn at(budget: BudgetText, args: &Budget) -> anyhow::Result<BudgetText> {
    let asked = args.at.iter();
    let asked = asked.map(|written| amount("--at", written, &budget).map(|found| found.value));
    let asked: Vec<f64> = asked.collect::<anyhow::Result<_>>()?;
    let budget = match asked.is_empty() {
        true => budget,
        false => budget.with_at(asked),
    };
    if let (Format::Json, [first, _, ..]) = (args.output.format, budget.at()) {
        return Err(Usage::error(format!(
            "--format json writes one budget: add --at with one value, such as {first}{}",
            shown(budget.unit())
        )));
    }
    Ok(budget)
}

/// Parses the value of `option`, converted to the unit of the measurand.
fn amount(option: &str, written: &str, budget: &BudgetText) -> anyhow::Result<Quantity> {
    let found = Quantity::read(option, written)?;
    match found.unit.symbol() == budget.unit() {
        true => Ok(found),
        false => Err(Usage::error(format!(
            "{option} {}: {} is in {}, expected an amount in this unit",
            shown(written),
            shown(budget.measurand()),
            shown(budget.unit())
        ))),
    }
}

/// Uses the certificate of `--certificate` instead of the certificate of the result.
fn certify(measured: &mut Measured, args: &Budget, channel: &Channel) -> anyhow::Result<()> {
    let Some(path) = &args.certificate else {
        return Ok(());
    };
    let day = args.date.or(measured.recorded_on);
    let certificate = Certificate::read(&read(path)?, &channel.name, day);
    let certificate = certificate.with_context(|| shown(path).to_string())?;
    measured.take(|evidence| evidence.with_certificate(certificate));
    measured.absent.retain(|of| of.source != "certificate");
    Ok(())
}

/// Text of a file with sources for the figures of a result.
fn template(args: &Budget, result: &Path) -> anyhow::Result<String> {
    let report = evidence::report_of(result)?;
    let channel = report.channel(args.channel.as_deref())?;
    let at = report.middle_of(&channel);
    let mut measured = Measured::of_report(&report, &channel, args.date);
    certify(&mut measured, args, &channel)?;
    let template = BudgetTemplate {
        sensor: measured.sensor.as_deref().unwrap_or("unknown"),
        origin: measured.origins.first().map_or("unknown", String::as_str),
        result: &quoted(result),
        measurand: &channel.name,
        unit: &channel.unit,
        at,
        evidence: &measured.evidence,
        absent: &measured.absent,
    };
    Ok(template.text())
}
