//! Compares results of several seeds with published numbers of the same sensors. Marks numbers that are at least as good, and computes rank
//! correlations.
//!
//! ```text
//! cargo run --release -p taceva-report --example beside_published -- runs/*/results.json
//! ```
//!
//! The seed of a result comes from its provenance; several files may share a seed. A cell has the mean over seeds, the range over seeds in brackets, and the
//! published number. τ is Kendall's rank correlation of the sensors in a row with the published order: the mean over seeds, and the range in brackets. A pair
//! of sensors with overlapping 95 % intervals counts half.

use std::collections::BTreeMap;
use std::error::Error;
use std::io::Write as _;

use taceva_metrics::Better;
use taceva_report::{FormattedValue, Study, Table, catalogue};

const METRICS: [&str; 3] = ["mae", "r2", "smape"];
const CHANNELS: [&str; 4] = ["Pxy", "Pz", "Fxy", "Fz"];

/// Approximate width of the interval of an error, and of a rank correlation. Numbers are rounded to a twentieth of the width.
const ERROR: f64 = 0.01;
const TAU: f64 = 0.4;

/// Published number of a sensor, and our value with one seed.
#[derive(Clone, Copy, Debug)]
struct Number {
    published: f64,
    found: f64,
    ends: Option<[f64; 2]>,
}

/// Studies of each seed, by sensor name.
type Seeds = BTreeMap<u64, BTreeMap<String, Study>>;

fn main() -> Result<(), Box<dyn Error>> {
    let texts: Result<Vec<(String, String)>, Box<dyn Error>> = std::env::args()
        .skip(1)
        .map(|path| match std::fs::read_to_string(&path) {
            Ok(text) => Ok((path, text)),
            Err(error) => Err(format!("cannot read {path}: {error}").into()),
        })
        .collect();
    std::io::stdout().write_all(tables(&texts?)?.as_bytes())?;
    Ok(())
}

/// Returns one table for each metric. `texts` contains the name and the content of each result file.
fn tables(texts: &[(String, String)]) -> Result<String, String> {
    let mut seeds = Seeds::new();
    for (file, text) in texts {
        for study in Study::read(text).map_err(|error| format!("{file}: {error}"))? {
            let seed = seed(&study).ok_or_else(|| format!("{file}: no seed in its provenance"))?;
            let sensor = study.sensor.clone();
            if seeds
                .entry(seed)
                .or_default()
                .insert(sensor.clone(), study)
                .is_some()
            {
                return Err(format!("{file}: {sensor} with seed {seed} occurs twice"));
            }
        }
    }
    let mut sensors: Vec<&BTreeMap<String, Study>> = seeds.values().collect();
    let first = sensors
        .pop()
        .ok_or("expected files that `run` or `evaluate` wrote")?;
    if !sensors.iter().all(|other| other.keys().eq(first.keys())) {
        return Err("every seed needs results of the same sensors".to_owned());
    }
    let tables = METRICS.map(|metric| table(metric, &seeds));
    Ok(tables.map(|table| table.markdown()).join("\n"))
}

fn seed(study: &Study) -> Option<u64> {
    let mut entries = study.provenance.iter();
    let (_, text) = entries.find(|(name, _)| name == "seed")?;
    text.parse().ok()
}

/// Table of one metric, with one row for each channel.
fn table(metric: &str, seeds: &Seeds) -> Table {
    let names: Vec<&str> = seeds.values().next().map_or_else(Vec::new, |studies| {
        studies.keys().map(String::as_str).collect()
    });
    let head = [&[metric], &names[..], &["τ"]].concat();
    let mut table = Table::new(metric, head);
    let mut good = [0, 0];
    for channel in CHANNELS {
        let number = |name: &str, study: &Study| number(name, study, metric, channel);
        let rows = seeds.values().map(|studies| {
            studies
                .iter()
                .map(|(name, study)| number(name, study))
                .collect()
        });
        let rows: Vec<Vec<Option<Number>>> = rows.collect();
        let mut cells = vec![channel.to_owned()];
        for sensor in 0..names.len() {
            let numbers: Option<Vec<Number>> = rows.iter().map(|row| row[sensor]).collect();
            let Some(numbers) = numbers else {
                cells.push("–".to_owned());
                continue;
            };
            let (cell, is_good) = cell(&numbers, better(metric));
            good[0] += usize::from(is_good);
            good[1] += 1;
            cells.push(cell);
        }
        let taus = rows.iter().map(|row| {
            let row: Vec<Number> = row.iter().copied().flatten().collect();
            tau(&row)
        });
        let taus: Option<Vec<f64>> = taus.collect();
        cells.push(taus.map_or_else(|| "–".to_owned(), |taus| spread(&taus, TAU)));
        table.push(cells);
    }
    let count = seeds.len();
    table.note(format!(
        "{} of {} means over {count} seeds are at least as good as published",
        good[0], good[1]
    ));
    table
}

fn better(metric: &str) -> Better {
    taceva_metrics::catalogue::find(metric).map_or(Better::Described, |metric| metric.better)
}

fn number(name: &str, study: &Study, metric: &str, channel: &str) -> Option<Number> {
    let score = study.score(metric, channel)?;
    Some(Number {
        published: catalogue::find(name)?.result(metric, channel)?.value,
        found: score.value.number()?,
        ends: score.interval.as_ref().and_then(|interval| interval.ends()),
    })
}

/// Cell with the value of a sensor over all seeds, and true if the mean is at least as good as the published number.
fn cell(numbers: &[Number], better: Better) -> (String, bool) {
    let found: Vec<f64> = numbers.iter().map(|number| number.found).collect();
    let (mean, published) = (mean(&found), numbers[0].published);
    let (is_good, sign) = match better {
        Better::Higher if mean >= published => (true, "≥"),
        Better::Higher => (false, "<"),
        _ if mean <= published => (true, "≤"),
        _ => (false, ">"),
    };
    let text = format!(
        "{} {sign} {}",
        spread(&found, ERROR),
        short(published, ERROR)
    );
    (text, is_good)
}

/// Mean of `values`, and their range if there are several, rounded to a twentieth of `width`.
fn spread(values: &[f64], width: f64) -> String {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [mean, least, greatest] = [mean(values), least, greatest].map(|value| short(value, width));
    match values.len() {
        1 => mean,
        _ => format!("{mean} ({least} … {greatest})"),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn short(value: f64, width: f64) -> String {
    FormattedValue::number(value, Some([value - width / 2.0, value + width / 2.0])).value
}

/// Kendall's rank correlation of our values with published numbers; `None` for fewer than two sensors.
///
/// Σ wₚ sₚ / Σ wₚ over the pairs p of sensors. s is 1 for the same order, −1 for the opposite order, and 0 if two numbers are equal. w is ½ if our
/// intervals overlap, else 1.
fn tau(row: &[Number]) -> Option<f64> {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (position, left) in row.iter().enumerate() {
        for right in &row[position + 1..] {
            let order = |left: f64, right: f64| left.total_cmp(&right) as i8;
            let sign = order(left.published, right.published) * order(left.found, right.found);
            let weight = if overlap(left, right) { 0.5 } else { 1.0 };
            sum += weight * f64::from(sign);
            weights += weight;
        }
    }
    (weights > 0.0).then(|| sum / weights)
}

fn overlap(left: &Number, right: &Number) -> bool {
    match (left.ends, right.ends) {
        (Some([low, high]), Some([other_low, other_high])) => {
            low <= other_high && other_low <= high
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(numbers: [(f64, f64, f64); 4]) -> Vec<Number> {
        let number = |(published, found, half): (f64, f64, f64)| Number {
            published,
            found,
            ends: Some([found - half, found + half]),
        };
        numbers.map(number).to_vec()
    }

    #[test]
    fn the_same_order_is_one_the_opposite_minus_one_and_overlapping_pairs_count_half() {
        let close =
            |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found}");
        let far = row([
            (1.0, 10.0, 0.1),
            (2.0, 20.0, 0.1),
            (3.0, 30.0, 0.1),
            (4.0, 40.0, 0.1),
        ]);
        close(tau(&far).expect("pairs"), 1.0);
        let opposite = row([
            (4.0, 10.0, 0.1),
            (3.0, 20.0, 0.1),
            (2.0, 30.0, 0.1),
            (1.0, 40.0, 0.1),
        ]);
        close(tau(&opposite).expect("pairs"), -1.0);
        // The last two are swapped: 5 pairs against 1 by plain counts ...
        let swapped = [
            (1.0, 10.0, 0.1),
            (2.0, 20.0, 0.1),
            (4.0, 30.0, 0.1),
            (3.0, 31.0, 0.1),
        ];
        close(tau(&row(swapped)).expect("pairs"), 4.0 / 6.0);
        // ... and 5 against ½ if their intervals overlap.
        let overlapping = swapped.map(|(published, found, _)| (published, found, 1.0));
        close(tau(&row(overlapping)).expect("pairs"), 4.5 / 5.5);
        assert!(tau(&far[..1]).is_none());
    }

    /// A result with one seed. The mean absolute error of Fz of each of four sensors is the published error times its factor.
    fn result(seed: u64, factors: [f64; 4]) -> (String, String) {
        result_of("ViTacTip", seed, factors)
    }

    /// Same as [`result`], with the name `last` for the last sensor.
    fn result_of(last: &str, seed: u64, factors: [f64; 4]) -> (String, String) {
        let names = ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"];
        let studies = names.iter().zip(factors).map(|(name, factor)| {
            let sensor = catalogue::find(name).expect("of the catalogue");
            let value = sensor.result("mae", "Fz").expect("published").value * factor;
            let name = if *name == "ViTacTip" { last } else { name };
            format!(
                r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "{name}"}}, "provenance": {{"seed": {seed}}},
                "metrics": {{"mae": {{"Fz": {{"value": {value}, "unit": "N", "n": 640, "n_invalid": 0, "ci95": [{value}, {value}],
                "method": "jackknife by point_id, G=80", "definition": "mae/1"}}}}}}}}"#
            )
        });
        let studies: Vec<String> = studies.collect();
        let text = format!(
            r#"{{"schema": "taceva.run/1.0", "studies": [{}]}}"#,
            studies.join(", ")
        );
        let sealed = taceva_files::seal::json::seal(&text).expect("an object");
        (format!("{seed}.json"), sealed)
    }

    #[test]
    fn the_mean_over_seeds_is_what_must_be_as_good_as_published() {
        // The means of 0.9 and 1.2 are worse, of 0.7 and 1.2 better.
        let tables = tables(&[
            result(1, [0.9, 0.7, 1.0, 1.5]),
            result(2, [1.2, 1.2, 1.0, 1.5]),
        ]);
        let tables = tables.expect("two seeds of the same sensors");
        assert!(
            tables.contains("2 of 4 means over 2 seeds are at least as good as published"),
            "{tables}"
        );
        let row = tables
            .lines()
            .find(|line| line.starts_with("| Fz"))
            .expect("a row");
        assert!(
            row.contains("> 0.0361") && row.contains("≤ 0.0269") && row.contains("≤ 0.0544"),
            "{row}"
        );
        // Published order, best first: ViTacTip, GelSightWM, GelSight, MagicTac. With seed 2, only GelSightWM and GelSight keep it.
        assert!(row.contains("0.83 (0.67 … 1.00)"), "{row}");
    }

    #[test]
    fn a_seed_that_is_there_twice_or_lacks_a_sensor_is_refused() {
        let one = result(1, [1.0; 4]);
        let twice = tables(&[one.clone(), one.clone()]).expect_err("twice");
        assert_eq!(twice, "1.json: GelSight with seed 1 occurs twice");
        let lacking = result_of("another", 1, [1.0; 4]);
        let lacking = tables(&[lacking, result(2, [1.0; 4])]).expect_err("another sensor");
        assert_eq!(lacking, "every seed needs results of the same sensors");
        assert!(tables(&[]).is_err());
    }
}
