//! Detection limit from the least-squares line of predicted over true force of light presses.

use super::sums::LightSums;
use crate::exact::Dyadic;
use crate::score::value::UndefinedReason;
use crate::stats::noncentral::{critical_factor, detection_factor};

/// Least effective number of places for a limit: n² / Σ nᵢ², with nᵢ of n presses at place i.
pub(super) const LEAST_PLACES: u64 = 10;
/// Least effective number of places for a limit, if the jackknife has left out some places.
const LEAST_LEFT: u64 = 3;

/// Detection limit (`value`) and decision threshold (`critical`), N of true force.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    pub(super) value: f64,
    pub(super) critical: f64,
}

impl Limit {
    /// Detection limit from at least ten places. The force of the lightest press is its lower bound. A limit above the heaviest press is an error.
    pub(super) fn of(sums: &LightSums) -> Result<Limit, UndefinedReason> {
        let range = sums.line.range.ok_or(UndefinedReason::NoLightPresses)?;
        let limit = Limit::of_line(sums, LEAST_PLACES)?;
        if limit.value > range.greatest {
            return Err(UndefinedReason::BeyondLightPresses);
        }
        Ok(Limit {
            value: limit.value.max(range.least),
            ..limit
        })
    }

    /// Detection limit without bounds, for a resample of at least three places.
    pub(super) fn resampled(sums: &LightSums) -> Result<Limit, UndefinedReason> {
        Limit::of_line(sums, LEAST_LEFT)
    }

    /// Detection limit by ISO 11843-2, from the line through predicted over true force of n presses.
    ///
    /// The nᵢ presses at place i are alike, so the n presses count as g = n² / Σ nᵢ² independent presses. Below `least` of them, no limit is defined.
    ///
    /// For true forces x and predicted forces y, S_xx = n Σ x² − (Σ x)². S_yy and S_xy are alike, and R = S_xx S_yy − S_xy². The residual
    /// deviation s over the slope b is √(R S_xx) / (n S_xy) × √(g / (g − 2)). R, S_xx and S_xy are exact. Each root and quotient is rounded once.
    fn of_line(sums: &LightSums, least: u64) -> Result<Limit, UndefinedReason> {
        if !sums.places.are_named() {
            return Err(UndefinedReason::NoClusters);
        }
        let n = Dyadic::from(sums.line.n);
        let squares = sums.places.iter().map(|(_, presses)| presses.0);
        let squares = squares.fold(0_u64, |sum, n| sum.saturating_add(n.saturating_mul(n)));
        let have = sums.line.n.saturating_mul(sums.line.n) / squares.max(1);
        if have < least {
            return Err(UndefinedReason::TooFewPlaces { have, least });
        }
        let independent = (&n * &n).over(&Dyadic::from(squares));
        let freedom = independent - 2.0;
        let [x, y, xx, xy, yy] = sums.line.sums.each_ref().map(|sum| sum.to_dyadic());
        let spread_x = &(&n * &xx) - &(&x * &x);
        let spread_y = &(&n * &yy) - &(&y * &y);
        let shared = &(&n * &xy) - &(&x * &y);
        if spread_x.is_zero() {
            return Err(UndefinedReason::ConstantTruth { perfect: false });
        }
        let shared_squared = &shared * &shared;
        let rest = &(&spread_x * &spread_y) - &shared_squared;
        let threshold = critical_factor(freedom);
        // One-sided t test of the slope. Presses exactly on a line leave no uncertainty of the slope.
        let rises = !(shared.is_zero() || shared.is_negative())
            && (rest.is_zero() || shared_squared.root_over(&rest) * freedom.sqrt() > threshold);
        if !rises {
            return Err(UndefinedReason::NoRise);
        }
        let deviation = (&rest * &spread_x).root_over(&(&(&n * &n) * &shared_squared))
            * (independent / freedom).sqrt();
        let leverage = (1.0 + (&x * &x).over(&spread_x)) / independent;
        let deviation = deviation * (1.0 + leverage).sqrt();
        Ok(Limit {
            value: detection_factor(freedom) * deviation,
            critical: threshold * deviation,
        })
    }
}
