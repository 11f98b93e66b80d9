//! Aligns the surfaces of every pair of sensor units and measures their gap.

use super::gap::Gap;
use super::surfaces::{Cloud, SurfaceClouds};
use crate::exact::{Dyadic, ExactSum};
use crate::geometry::{Motion, Point, Registration, register_clouds};
use crate::score::matrix::Matrix;
use crate::score::value::{Finished, UndefinedReason};

/// Gaps between the surfaces of all pairs of sensor units.
pub(super) struct UnitGaps {
    units: Vec<String>,
    pairs: Vec<UnitPair>,
}

/// Gap between two units, given by their indices in the order of names.
struct UnitPair {
    units: [usize; 2],
    gap: Result<Gap, UndefinedReason>,
    by_point: bool,
    settled: bool,
}

impl UnitGaps {
    /// Aligns the surface of each unit with the surface of every unit before it in the order of names, and measures the gap.
    ///
    /// # Errors
    /// [`UndefinedReason`] if there are no samples, or only one unit.
    pub(super) fn of(sums: &SurfaceClouds) -> Result<UnitGaps, UndefinedReason> {
        let clouds = sums.by_unit();
        match clouds.len() {
            0 => return Err(UndefinedReason::Empty),
            1 => return Err(UndefinedReason::OneUnit),
            _ => {}
        }
        let mut pairs = Vec::new();
        for (first, (_, onto)) in clouds.iter().enumerate() {
            for (second, (_, from)) in clouds.iter().enumerate().skip(first + 1) {
                pairs.push(compare([first, second], onto, from));
            }
        }
        let units = clouds.iter().map(|(unit, _)| (*unit).to_owned()).collect();
        Ok(UnitGaps { units, pairs })
    }

    /// Mean of `number` over the pairs with a gap, rounded once.
    ///
    /// # Errors
    /// The reason of the first pair, if no pair has a gap.
    pub(super) fn mean(&self, number: fn(&Gap) -> f64) -> Finished {
        let gaps: Vec<&Gap> = self
            .pairs
            .iter()
            .filter_map(|pair| pair.gap.as_ref().ok())
            .collect();
        let sum: ExactSum = gaps.iter().map(|gap| number(gap)).collect();
        match self.pairs.iter().find_map(|pair| pair.gap.err()) {
            Some(reason) if gaps.is_empty() => Err(reason),
            _ => Ok(sum.to_dyadic().over(&Dyadic::from(self.valid()))),
        }
    }

    /// Matrix of the gaps, mm, with a row and a column for each unit. A gap is the mean of both directions.
    pub(super) fn matrix(&self) -> Matrix {
        let mut values = vec![vec![None; self.units.len()]; self.units.len()];
        for pair in &self.pairs {
            let [first, second] = pair.units;
            let gap = pair.gap.as_ref().ok().map(Gap::both);
            (values[first][second], values[second][first]) = (gap, gap);
        }
        Matrix {
            rows: self.units.clone(),
            columns: self.units.clone(),
            values,
        }
    }

    /// Number of units.
    pub(super) fn units(&self) -> u64 {
        self.units.iter().fold(0, |count, _| count + 1)
    }

    /// Number of pairs of units.
    pub(super) fn total(&self) -> u64 {
        self.count(|_| true)
    }

    /// Number of pairs of units whose gap is defined.
    pub(super) fn valid(&self) -> u64 {
        self.count(|pair| pair.gap.is_ok())
    }

    /// Number of pairs of units that were aligned by contact points with equal names.
    pub(super) fn by_point(&self) -> u64 {
        self.count(|pair| pair.by_point)
    }

    /// Number of pairs of units whose alignment had not converged after the last step.
    pub(super) fn unsettled(&self) -> u64 {
        self.count(|pair| !pair.settled)
    }

    fn count(&self, counts: fn(&UnitPair) -> bool) -> u64 {
        let pairs = self.pairs.iter().filter(|pair| counts(pair));
        pairs.fold(0, |count, _| count + 1)
    }
}

/// Aligns the surface `from` with the surface `onto` and measures their gap.
fn compare(units: [usize; 2], onto: &Cloud, from: &Cloud) -> UnitPair {
    let [shared_from, shared_onto] = shared_points(from, onto);
    let by_point = shared_from.len() >= 3;
    let registration = if by_point {
        Motion::between(&shared_from, &shared_onto).map(|motion| Registration {
            motion,
            settled: true,
        })
    } else {
        register_clouds(&from.points, &onto.points)
    };
    let gap = match &registration {
        Some(registration) => {
            let moved = from
                .points
                .iter()
                .map(|&point| registration.motion.apply(point));
            Gap::between(&onto.points, &moved.collect::<Vec<_>>())
        }
        None => Err(UndefinedReason::OpenTurn),
    };
    UnitPair {
        units,
        gap,
        by_point,
        settled: registration.is_some_and(|registration| registration.settled),
    }
}

/// Points of both clouds at their common contact points, in the same order.
fn shared_points(from: &Cloud, onto: &Cloud) -> [Vec<Point>; 2] {
    let located = from.locations.iter().zip(&from.points);
    let (from, onto) = located
        .filter_map(|(location, &point)| {
            let at = onto.locations.binary_search(location).ok()?;
            Some((point, onto.points[at]))
        })
        .unzip();
    [from, onto]
}
