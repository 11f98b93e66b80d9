//! Tail probabilities, and the search for quantiles.

/// Probabilities below and above a point. The smaller probability has full relative accuracy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tails {
    pub(super) below: f64,
    pub(super) above: f64,
}

impl Tails {
    pub(super) fn of_below(below: f64) -> Tails {
        Tails {
            below,
            above: 1.0 - below,
        }
    }

    pub(super) fn of_above(above: f64) -> Tails {
        Tails {
            below: 1.0 - above,
            above,
        }
    }

    pub(super) fn exchanged(self) -> Tails {
        Tails {
            below: self.above,
            above: self.below,
        }
    }
}

/// Positive point at which `tails` gives the probabilities `wanted`, to the last bit. Returns 0 if nothing is below the point, and infinity if
/// nothing is above.
pub(super) fn positive_quantile(wanted: Tails, tails: impl Fn(f64) -> Tails) -> f64 {
    let Tails { below, above } = wanted;
    if below.is_nan() || below < 0.0 || above < 0.0 {
        return f64::NAN;
    }
    if below <= 0.0 || above <= 0.0 {
        return if below <= 0.0 { 0.0 } else { f64::INFINITY };
    }
    least_where(|x| {
        let tails = tails(x);
        if below <= 0.5 {
            tails.below >= below
        } else {
            tails.above <= above
        }
    })
}

/// Least positive number for which `is_reached`, a monotonic condition, is true. Returns infinity if no number reaches the condition.
pub(super) fn least_where(is_reached: impl Fn(f64) -> bool) -> f64 {
    let mut high = 1.0_f64;
    while !is_reached(high) {
        if high > 1e300 {
            return f64::INFINITY;
        }
        high *= 2.0;
    }
    let mut low = high / 2.0;
    while low > 1e-300 && is_reached(low) {
        (low, high) = (low / 2.0, low);
    }
    loop {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            return high;
        }
        match is_reached(middle) {
            true => high = middle,
            false => low = middle,
        }
    }
}
