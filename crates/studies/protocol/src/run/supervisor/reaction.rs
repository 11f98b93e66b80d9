//! Reaction time of a guard, from an exceeded limit to a sent halt.

use taceva_core::whole_size;

/// Time to send a halt, in s.
const SEND_S: f64 = 0.001;
/// Share of reactions that are at most as late as the stated reaction time. One in a thousand may be later.
const SOONER: f64 = 0.999;

/// Ages of readings on arrival at the supervisor.
#[derive(Clone, Debug, Default)]
pub(super) struct Lateness {
    ages_s: Vec<f64>,
    /// Times of measurement of the first and the last reading, in s; `None` before the first reading.
    span_s: Option<[f64; 2]>,
}

impl Lateness {
    pub(super) fn add(&mut self, valid_s: f64, age_s: f64) {
        self.ages_s.push(age_s);
        let first_s = self.span_s.map_or(valid_s, |[first_s, _]| first_s);
        self.span_s = Some([first_s, valid_s]);
    }

    /// Reaction time, in s: the mean period of readings, the age of a late reading, and the time to send a halt. `None` for fewer than two readings.
    pub(super) fn reaction_s(mut self) -> Option<f64> {
        let [first_s, last_s] = self.span_s?;
        let periods = self
            .ages_s
            .len()
            .checked_sub(1)
            .filter(|count| *count > 0)?;
        let periods = u32::try_from(periods).map_or(f64::INFINITY, f64::from);
        let period_s = (last_s - first_s) / periods;
        self.ages_s.sort_by(f64::total_cmp);
        let place = whole_size((SOONER * periods).ceil());
        let age_s = self.ages_s.get(place).or(self.ages_s.last())?;
        Some(period_s + age_s + SEND_S)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reaction_is_a_period_the_latest_of_400_readings_and_the_way_of_a_halt() {
        let mut lateness = Lateness::default();
        for number in 0..400 {
            let age_s = if number == 123 { 0.04 } else { 0.002 };
            lateness.add(f64::from(number) * 0.005, age_s);
        }
        let reaction_s = lateness.reaction_s().expect("readings");
        assert!((reaction_s - 0.046).abs() < 1e-9, "{reaction_s}");
        assert_eq!(Lateness::default().reaction_s(), None);
    }

    #[test]
    fn one_of_two_thousand_is_not_counted() {
        let mut lateness = Lateness::default();
        for number in 0..2_000 {
            let age_s = if number == 123 { 0.04 } else { 0.002 };
            lateness.add(f64::from(number) * 0.001, age_s);
        }
        let reaction_s = lateness.reaction_s().expect("readings");
        assert!((reaction_s - 0.004).abs() < 1e-9, "{reaction_s}");
    }
}
