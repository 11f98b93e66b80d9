//! Distances between two clouds, both ways.

use taceva_metrics::{ExactSum, Fraction, NearestPoints};

use crate::quotient::ratio;

/// Distances from the points of one cloud to the nearest point of the other.
pub(super) struct OneWay {
    distances: ExactSum,
    squares: ExactSum,
    /// Number of distances below the threshold τ.
    below: u64,
    /// Number of distances of the threshold τ or below.
    up_to: u64,
    /// Number of points of the first cloud.
    points: u64,
}

impl OneWay {
    /// Distances of `from` to `onto`, in mm. Both clouds have at least one point.
    ///
    /// The search skips points by their distance along x. With n points at equal x, it takes n steps for each point.
    pub(super) fn of(from: &[[f64; 3]], onto: &[[f64; 3]], tau_mm: Option<f64>) -> OneWay {
        let search = NearestPoints::new(onto.iter().copied());
        let mut way = OneWay {
            distances: ExactSum::default(),
            squares: ExactSum::default(),
            below: 0,
            up_to: 0,
            points: from.len() as u64,
        };
        for nearest in from.iter().filter_map(|&point| search.nearest(point)) {
            let distance = nearest.squared.sqrt();
            way.distances.add(distance);
            way.squares.add(nearest.squared);
            way.below += u64::from(tau_mm.is_some_and(|tau| distance < tau));
            way.up_to += u64::from(tau_mm.is_some_and(|tau| distance <= tau));
        }
        way
    }
}

/// Distances from the first cloud to the second, and from the second to the first.
pub(super) struct BothWays(pub(super) [OneWay; 2]);

impl BothWays {
    /// Half the sum of both mean distances, rounded once.
    pub(super) fn half_sum(&self) -> f64 {
        self.sum_of_means(|way| &way.distances).divided(2).to_f64()
    }

    /// Sum of both means of squared distances, rounded once.
    pub(super) fn squared(&self) -> f64 {
        self.sum_of_means(|way| &way.squares).to_f64()
    }

    /// F score of the shares of distances below the threshold τ, rounded once.
    pub(super) fn f_strict(&self) -> f64 {
        self.f_score(|way| way.below)
    }

    /// F score of the shares of distances of at most the threshold τ, rounded once.
    pub(super) fn f_inclusive(&self) -> f64 {
        self.f_score(|way| way.up_to)
    }

    fn sum_of_means(&self, sum: impl Fn(&OneWay) -> &ExactSum) -> Fraction {
        let [one, other] = &self.0;
        let mean = |way: &OneWay| Fraction::of(sum(way).to_dyadic(), way.points);
        mean(one).plus(&mean(other))
    }

    /// F score 2 p r / (p + r) of the shares p and r of `hits` among the points of both clouds; 0 if both are 0.
    fn f_score(&self, hits: impl Fn(&OneWay) -> u64) -> f64 {
        let [one, other] = &self.0;
        let [a, b] = [one, other].map(|way| u128::from(hits(way)));
        let [n, m] = [one, other].map(|way| u128::from(way.points));
        match a * m + b * n {
            0 => 0.0,
            below => ratio(2 * a * b, below),
        }
    }
}
