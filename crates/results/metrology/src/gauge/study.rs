//! Readings of a gauge study.

use std::collections::BTreeMap;

use super::assembly::assemble;
use super::cells::{Balanced, Names};
use super::range::estimate;
use super::reading::Reading;
use super::{GaugeError, GaugeReport, GaugeSettings, RangeConstants, RangeEstimate};

/// Distinct labels, numbered in order of first use.
#[derive(Clone, Debug, Default)]
struct Labels {
    numbers: BTreeMap<String, usize>,
}

impl Labels {
    fn number(&mut self, label: &str) -> usize {
        if let Some(&number) = self.numbers.get(label) {
            return number;
        }
        let number = self.numbers.len();
        self.numbers.insert(label.to_owned(), number);
        number
    }

    /// Labels in the order of their numbers.
    fn by_number(&self) -> Vec<&str> {
        let mut labels = vec![""; self.numbers.len()];
        for (label, &number) in &self.numbers {
            labels[number] = label;
        }
        labels
    }

    /// Alphabetical rank of each label, in the order of their numbers.
    fn places(&self) -> Vec<usize> {
        let mut places = vec![0; self.numbers.len()];
        for (place, &number) in self.numbers.values().enumerate() {
            places[number] = place;
        }
        places
    }

    fn sorted(&self) -> Vec<&str> {
        self.numbers.keys().map(String::as_str).collect()
    }
}

/// Readings of a gauge study, in any order.
///
/// ```
/// use taceva_metrology::gauge::GaugeStudy;
/// let mut study = GaugeStudy::default();
/// study.add("p1", "A", "1", 0.29)?;
/// let mut other = GaugeStudy::default();
/// other.add("p1", "A", "2", 0.41)?;
/// study.merge(&other);
/// assert_eq!(study.len(), 2);
/// # Ok::<(), taceva_metrology::gauge::GaugeError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct GaugeStudy {
    parts: Labels,
    operators: Labels,
    trials: Labels,
    readings: Vec<Reading>,
}

impl GaugeStudy {
    /// Adds one reading, in the unit of the study.
    ///
    /// # Errors
    /// [`GaugeError::NotFinite`] for NaN or an infinite value.
    pub fn add(
        &mut self,
        part: &str,
        operator: &str,
        trial: &str,
        value: f64,
    ) -> Result<(), GaugeError> {
        if !value.is_finite() {
            return Err(GaugeError::NotFinite {
                part: part.to_owned(),
                operator: operator.to_owned(),
                trial: trial.to_owned(),
                value,
            });
        }
        self.readings.push(Reading {
            part: self.parts.number(part),
            operator: self.operators.number(operator),
            trial: self.trials.number(trial),
            value,
        });
        Ok(())
    }

    /// Adds the readings of `other`.
    pub fn merge(&mut self, other: &GaugeStudy) {
        let renumber = |ours: &mut Labels, theirs: &Labels| -> Vec<usize> {
            let labels = theirs.by_number().into_iter();
            labels.map(|label| ours.number(label)).collect()
        };
        let parts = renumber(&mut self.parts, &other.parts);
        let operators = renumber(&mut self.operators, &other.operators);
        let trials = renumber(&mut self.trials, &other.trials);
        self.readings
            .extend(other.readings.iter().map(|reading| Reading {
                part: parts[reading.part],
                operator: operators[reading.operator],
                trial: trials[reading.trial],
                value: reading.value,
            }));
    }

    /// Number of readings.
    pub fn len(&self) -> usize {
        self.readings.len()
    }

    /// True if there are no readings.
    pub fn is_empty(&self) -> bool {
        self.readings.is_empty()
    }

    /// Computes variance components with their intervals.
    ///
    /// # Errors
    /// [`GaugeError`] for a setting outside its range, an unbalanced study, or fewer than two operators, parts or trials.
    pub fn analyse(&self, settings: &GaugeSettings) -> Result<GaugeReport, GaugeError> {
        settings.check()?;
        Ok(assemble(&self.balanced(settings)?, settings))
    }

    /// Components by the range method with the given constants, such as those of a printed table.
    ///
    /// # Errors
    /// The errors of [`analyse`](GaugeStudy::analyse).
    pub fn range_with(
        &self,
        settings: &GaugeSettings,
        constants: &RangeConstants,
    ) -> Result<RangeEstimate, GaugeError> {
        settings.check()?;
        let balanced = self.balanced(settings)?;
        Ok(estimate(&balanced, constants))
    }

    fn balanced(&self, settings: &GaugeSettings) -> Result<Balanced, GaugeError> {
        let (parts, operators) = (self.parts.places(), self.operators.places());
        let trials = self.trials.places();
        let mut readings: Vec<Reading> = self
            .readings
            .iter()
            .map(|reading| Reading {
                part: parts[reading.part],
                operator: operators[reading.operator],
                trial: trials[reading.trial],
                value: reading.value,
            })
            .collect();
        readings.sort_by_key(|reading| (reading.part, reading.operator, reading.trial));
        let labels = Names {
            parts: &self.parts.sorted(),
            operators: &self.operators.sorted(),
            trials: &self.trials.sorted(),
        };
        Balanced::of(&readings, &labels, settings)
    }
}
