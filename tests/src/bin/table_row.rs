//! A row of a Markdown table from the output of `evaluate --format csv`, for passages of documents.
//!
//! ```text
//! taceva evaluate recording --format csv | table_row 'ridge' r2:Fx r2:Fz mae:Fz
//! table_row 'ridge' r2:Fx r2:Fz -- seed-0.csv seed-1.csv …
//! table_row 'seed 1' GelSight/r2:Fz < run/scores.csv
//! ```
//!
//! For one file of scores, a cell has the value, its unit, its interval and its standing; for several files, the median and the quartiles.

#![expect(clippy::print_stdout, reason = "a program says what it found")]

use std::env;
use std::fs;
use std::io::{self, Read as _};

use anyhow::{Context as _, bail, ensure};
use taceva_core::Unit;
use taceva_metrics::Standing;
use taceva_report::{FormattedValue, spaced};

/// A score from a table of scores.
#[derive(Clone, Debug)]
struct Score {
    value: f64,
    ends: Option<[f64; 2]>,
    unit: Unit,
    standing: String,
}

fn main() -> anyhow::Result<()> {
    let mut words = env::args().skip(1);
    let name = words.next().context("expected the first cell of the row")?;
    let words: Vec<String> = words.collect();
    let (cells, files) = match words.iter().position(|word| word == "--") {
        Some(at) => (&words[..at], &words[at + 1..]),
        None => (&words[..], &[][..]),
    };
    ensure!(!cells.is_empty(), "expected METRIC:CHANNEL after the name");
    let tables = match files {
        [] => {
            let mut table = String::new();
            io::stdin().read_to_string(&mut table)?;
            vec![table]
        }
        files => {
            let read = |file: &String| fs::read_to_string(file).with_context(|| file.clone());
            files.iter().map(read).collect::<anyhow::Result<_>>()?
        }
    };
    print!("| {name} |");
    for cell in cells {
        let scores = tables.iter().map(|table| score(table, cell));
        let scores = scores.collect::<anyhow::Result<Vec<Score>>>()?;
        match &scores[..] {
            [score] => print!(" {} |", with_standing(score)),
            scores => print!(" {} |", quartiles(scores)),
        }
    }
    println!();
    Ok(())
}

/// Score named by `cell` in a table of scores: `METRIC:CHANNEL`, or `SENSOR/METRIC:CHANNEL` for the table of a run.
fn score(table: &str, cell: &str) -> anyhow::Result<Score> {
    let (sensor, named) = match cell.split_once('/') {
        Some((sensor, named)) => (Some(sensor), named),
        None => (None, cell),
    };
    let (metric, channel) = named
        .split_once(':')
        .with_context(|| format!("`{cell}`: expected METRIC:CHANNEL"))?;
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let header = reader.headers()?.clone();
    let column = |name: &str| {
        let column = header.iter().position(|column| column == name);
        column.with_context(|| format!("no column `{name}`: expected the table of `--format csv`"))
    };
    let [of_metric, of_channel, value, low, high, unit, standing] = [
        column("metric")?,
        column("channel")?,
        column("value")?,
        column("ci95_low")?,
        column("ci95_high")?,
        column("unit")?,
        column("standing")?,
    ];
    for row in reader.records() {
        let row = row?;
        let is_other = match sensor {
            Some(sensor) => &row[column("sensor")?] != sensor,
            None => false,
        };
        if is_other || &row[of_metric] != metric || &row[of_channel] != channel {
            continue;
        }
        let ends = row[low].parse().ok().zip(row[high].parse().ok());
        let unit = &row[unit];
        return Ok(Score {
            value: row[value].parse().context("a value that is not a number")?,
            ends: ends.map(|(low, high)| [low, high]),
            unit: Unit::from_symbol(unit).with_context(|| format!("`{unit}`: no unit"))?,
            standing: row[standing].to_owned(),
        });
    }
    bail!("no score `{cell}`")
}

/// Score as text: `0.91 N (0.69 … 1.20)`, and the reason if verdicts exclude it.
fn with_standing(score: &Score) -> String {
    let printed = FormattedValue::number(score.value, score.ends).phrase(&spaced(score.unit));
    match &*score.standing {
        "" => printed,
        standing => {
            let phrase = Standing::from_words(standing).and_then(Standing::phrase);
            format!("{printed}, {}", phrase.unwrap_or(standing))
        }
    }
}

/// `0.780 [0.739, 0.828]`: the median of the values and their quartiles, by linear interpolation.
fn quartiles(scores: &[Score]) -> String {
    let mut values: Vec<f64> = scores.iter().map(|score| score.value).collect();
    values.sort_by(f64::total_cmp);
    // Counted in quarters of a step between two values, so that quartiles are whole numbers.
    let at = |quarter: usize| {
        let place = quarter * (values.len() - 1);
        let (below, rest) = (values[place / 4], place % 4);
        let above = values[(place / 4 + 1).min(values.len() - 1)];
        let share = [0.0, 0.25, 0.5, 0.75][rest];
        below + share * (above - below)
    };
    format!("{:.3} [{:.3}, {:.3}]", at(2), at(1), at(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "metric,channel,value,unit,ci95_low,ci95_high,standing\n\
                         mae,Fx,0.5,N,0.4,0.7,\nr2,Fx,0.25,1,-0.5,0.75,no skill\n";

    #[test]
    fn a_cell_has_unit_interval_and_what_bars_it() {
        let cell = |metric| with_standing(&score(TABLE, metric).expect("a score"));
        assert_eq!(cell("mae:Fx"), "0.50 N (0.40 … 0.70)");
        assert_eq!(
            cell("r2:Fx"),
            "0.25 (-0.50 … 0.75), not better than predicting the mean"
        );
        assert!(score(TABLE, "mae:Fy").is_err());
    }

    #[test]
    fn quartiles_lie_between_values() {
        let score = score(TABLE, "mae:Fx").expect("a score");
        let scores: Vec<Score> = [4.0, 1.0, 2.0, 3.0]
            .map(|value| Score {
                value,
                ..score.clone()
            })
            .to_vec();
        assert_eq!(quartiles(&scores), "2.500 [1.750, 3.250]");
    }
}
