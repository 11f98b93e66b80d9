//! `taceva choose`.

use std::fs;
use std::path::Path;
use taceva_core::shown;

use anyhow::Context as _;
use taceva_report::catalogue::Sensor;
use taceva_report::{Need, choose, choose_results, escape_markdown};

use super::{Usage, catalogue, results};
use crate::args::{Choose, Format};
use crate::{exit, output};

pub(crate) fn run(args: &Choose) -> anyhow::Result<u8> {
    let files = args.output.path.iter().chain(&args.page.path);
    output::check_all_free(files, args.output.force)?;
    results::check_distinct(&args.results)?;
    let needs = match &args.needs {
        Some(path) => {
            let text =
                fs::read_to_string(path).with_context(|| format!("cannot read {}", shown(path)))?;
            Need::read(&text).with_context(|| shown(path).to_string())?
        }
        None => {
            let said = args.need.join(",");
            Need::parse(&said).map_err(|error| Usage::error(error.to_string()))?
        }
    };
    let choice = match args.results.is_empty() {
        true => choose(&candidates(args.catalogue.as_deref())?, &needs),
        false => choose_results(&results::read_all_with_faults(&args.results)?, &needs),
    };
    let table = choice.table();
    match args.output.format {
        Format::Text | Format::Md => {
            let rest = |width: Option<usize>| match (args.output.format, width) {
                (Format::Md, _) => {
                    let headline = escape_markdown(&choice.headline());
                    format!("{headline}.\n\n{}", table.markdown())
                }
                (_, Some(width)) => table.text_within(width),
                (_, None) if table.rows.is_empty() => table.text_within(usize::MAX),
                (_, None) => table.text(),
            };
            results::write_values(&choice.values(), rest, &args.output)?;
        }
        _ => results::write(&table, &args.output, || choice.json())?,
    }
    if let Some(path) = &args.page.path {
        let words: Vec<&str> = needs.iter().map(|need| need.words.as_str()).collect();
        let page = choice.page(&words.join(", "));
        output::write(Some(path), |out| out.write_all(page.as_bytes()))?;
    }
    Ok(exit::DONE)
}

/// Sensors of the built-in catalogue, and one candidate for each measured bundle of the catalogue in `folder`.
fn candidates(folder: Option<&Path>) -> anyhow::Result<Vec<Sensor>> {
    let mut sensors = catalogue::sensors(folder)?;
    let measured: Vec<Sensor> = sensors
        .iter()
        .flat_map(Sensor::measured_candidates)
        .collect();
    // A sensor without published facts is represented only by the candidates of its bundles.
    sensors.retain(|sensor| sensor.has_published() || !sensor.has_bundles());
    sensors.extend(measured);
    Ok(sensors)
}
