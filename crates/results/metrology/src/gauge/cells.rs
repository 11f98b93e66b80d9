//! Balanced studies, with the same number of readings in every cell.

use std::collections::{BTreeMap, BTreeSet};

use super::reading::Reading;
use super::{Design, GaugeError, GaugeSettings};

/// Labels of parts, operators and trials, sorted alphabetically.
pub(super) struct Names<'a> {
    pub(super) parts: &'a [&'a str],
    pub(super) operators: &'a [&'a str],
    pub(super) trials: &'a [&'a str],
}

/// Readings of a balanced study.
#[derive(Clone, Debug)]
pub(super) struct Balanced {
    pub(super) operators: usize,
    /// Number of parts: of the study if crossed, of each operator if nested.
    pub(super) parts: usize,
    pub(super) trials: usize,
    /// Number of parts dropped for an incomplete cell.
    pub(super) dropped: usize,
    /// Readings sorted by operator, then part, then trial.
    values: Vec<f64>,
}

/// Readings of one part by one operator.
struct Cell {
    part: usize,
    operator: usize,
    values: Vec<f64>,
}

impl Balanced {
    /// Checks that `readings` are balanced. The readings must be sorted by part, operator and trial.
    pub(super) fn of(
        readings: &[Reading],
        names: &Names<'_>,
        settings: &GaugeSettings,
    ) -> Result<Balanced, GaugeError> {
        let mut cells = cells(readings, names)?;
        if settings.design == Design::Crossed {
            cells = with_empty_cells(cells, names);
        }
        let sizes = cells.iter().map(|cell| cell.values.len());
        let expected = most_frequent(sizes.filter(|size| *size > 0));
        let incomplete = |cell: &&Cell| cell.values.len() != expected;
        let mut dropped = BTreeSet::new();
        if let Some(first) = cells.iter().find(incomplete) {
            if !settings.drop_incomplete {
                return Err(GaugeError::Incomplete {
                    part: names.parts[first.part].to_owned(),
                    operator: names.operators[first.operator].to_owned(),
                    have: first.values.len(),
                    expected,
                });
            }
            let key = |cell: &Cell| key(cell, settings.design);
            dropped = cells.iter().filter(incomplete).map(key).collect();
            cells.retain(|cell| !dropped.contains(&key(cell)));
        }
        cells.sort_by_key(|cell| (cell.operator, cell.part));
        let mut of_operators: BTreeMap<usize, usize> = BTreeMap::new();
        for cell in &cells {
            *of_operators.entry(cell.operator).or_default() += 1;
        }
        let parts = most_frequent(of_operators.values().copied());
        if let Some((&operator, &have)) = of_operators.iter().find(|(_, have)| **have != parts) {
            return Err(GaugeError::UnequalParts {
                operator: names.operators[operator].to_owned(),
                have,
                expected: parts,
            });
        }
        let operators = of_operators.len();
        if operators < 2 && dropped.is_empty() {
            return Err(GaugeError::TooFewOperators { have: operators });
        }
        if parts < 2 {
            return Err(GaugeError::TooFewParts { have: parts });
        }
        if operators < 2 {
            return Err(GaugeError::TooFewOperators { have: operators });
        }
        if expected < 2 {
            return Err(GaugeError::TooFewTrials { have: expected });
        }
        Ok(Balanced {
            operators,
            parts,
            trials: expected,
            dropped: dropped.len(),
            values: cells.into_iter().flat_map(|cell| cell.values).collect(),
        })
    }

    /// Readings of each cell, sorted by operator and then part.
    pub(super) fn cells(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks(self.trials)
    }
}

/// Key of a cell's part. The key includes the operator in a nested study, whose operators have different parts.
fn key(cell: &Cell, design: Design) -> [usize; 2] {
    match design {
        Design::Crossed => [cell.part, 0],
        Design::Nested => [cell.part, cell.operator],
    }
}

fn cells(readings: &[Reading], names: &Names<'_>) -> Result<Vec<Cell>, GaugeError> {
    let mut cells: Vec<Cell> = Vec::new();
    let mut before: Option<[usize; 3]> = None;
    for reading in readings {
        let place = [reading.part, reading.operator, reading.trial];
        if before == Some(place) {
            return Err(GaugeError::RepeatedTrial {
                part: names.parts[reading.part].to_owned(),
                operator: names.operators[reading.operator].to_owned(),
                trial: names.trials[reading.trial].to_owned(),
            });
        }
        before = Some(place);
        match cells.last_mut() {
            Some(cell) if (cell.part, cell.operator) == (reading.part, reading.operator) => {
                cell.values.push(reading.value);
            }
            _ => cells.push(Cell {
                part: reading.part,
                operator: reading.operator,
                values: vec![reading.value],
            }),
        }
    }
    Ok(cells)
}

/// Sorted cells, with an empty cell for each part that an operator did not measure.
fn with_empty_cells(cells: Vec<Cell>, names: &Names<'_>) -> Vec<Cell> {
    let mut all = Vec::with_capacity(names.parts.len() * names.operators.len());
    let mut given = cells.into_iter().peekable();
    for part in 0..names.parts.len() {
        for operator in 0..names.operators.len() {
            let is_given = |cell: &Cell| (cell.part, cell.operator) == (part, operator);
            all.push(given.next_if(is_given).unwrap_or(Cell {
                part,
                operator,
                values: Vec::new(),
            }));
        }
    }
    all
}

/// Most frequent count, the greatest in case of a tie; 0 without counts.
fn most_frequent(counts: impl Iterator<Item = usize>) -> usize {
    let mut frequency: BTreeMap<usize, usize> = BTreeMap::new();
    for count in counts {
        *frequency.entry(count).or_default() += 1;
    }
    let most = frequency
        .into_iter()
        .max_by_key(|&(count, times)| (times, count));
    most.map_or(0, |(count, _)| count)
}
