//! Angles with a period, which estimators learn as sine and cosine.

use taceva_core::{Channel, ChannelError, Channels, Unit};

use crate::training::card::AngleCard;

/// Predicted channels of a model, and the learnt channels of its estimator.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LearntChannels {
    /// Channels that the model predicts.
    pub(crate) asked: Channels,
    /// Channels that the estimator learns.
    pub(crate) learnt: Channels,
    /// Position of each predicted channel, or of its sine and cosine, among the learnt channels.
    sources: Vec<LearntAs>,
}

#[derive(Clone, Debug, PartialEq)]
enum LearntAs {
    /// Channel learnt unchanged, with its index among the learnt channels.
    Itself(usize),
    /// Angle learnt as sine and cosine.
    Angle {
        sine: usize,
        cosine: usize,
        /// Period, in the unit of the angle.
        period: f64,
        /// True for labels between 0 and the period, false for labels centred at 0.
        from_zero: bool,
    },
}

impl LearntChannels {
    /// Learnt channels for the predicted channels `asked`. Each of `angles` is learnt as sine and cosine.
    ///
    /// # Errors
    /// [`ChannelError`] if the name of a sine or cosine channel is too long or used by another channel.
    pub(crate) fn new(
        asked: &Channels,
        angles: &[AngleCard],
    ) -> Result<LearntChannels, ChannelError> {
        let of = |channel: &Channel| {
            let angle = angles.iter().find(|angle| angle.name == channel.name())?;
            Some((angle, channel.period_in_unit()?))
        };
        let mut list = Vec::new();
        for channel in asked {
            match of(channel) {
                None => list.push(*channel),
                Some((angle, _)) => {
                    list.push(Channel::named(&angle.sine(), Unit::One)?);
                    list.push(Channel::named(&angle.cosine(), Unit::One)?);
                }
            }
        }
        let learnt = Channels::new(list)?;
        let at = |name: &str| learnt.position(name).unwrap_or_default();
        let sources = asked.iter().map(|channel| match of(channel) {
            None => LearntAs::Itself(at(channel.name())),
            Some((angle, period)) => LearntAs::Angle {
                sine: at(&angle.sine()),
                cosine: at(&angle.cosine()),
                period,
                from_zero: angle.from_zero,
            },
        });
        Ok(LearntChannels {
            sources: sources.collect(),
            asked: asked.clone(),
            learnt,
        })
    }

    /// Converts labels of the predicted channels to labels of the learnt channels, one row per sample.
    pub(crate) fn labels(&self, values: &[f64]) -> Vec<f64> {
        let mut labels = Vec::new();
        for row in values.chunks_exact(self.asked.len()) {
            let mut own = vec![0.0; self.learnt.len()];
            for (value, source) in row.iter().zip(&self.sources) {
                match source {
                    LearntAs::Itself(at) => own[*at] = *value,
                    LearntAs::Angle {
                        sine,
                        cosine,
                        period,
                        ..
                    } => {
                        let phase = std::f64::consts::TAU * value / period;
                        own[*sine] = phase.sin();
                        own[*cosine] = phase.cos();
                    }
                }
            }
            labels.extend(own);
        }
        labels
    }

    /// Converts values of the learnt channels to values of the predicted channels, one row per sample.
    pub(crate) fn answers(&self, learnt: &[f64]) -> Vec<f64> {
        let rows = learnt.chunks_exact(self.learnt.len());
        let answers = rows.flat_map(|row| {
            self.sources.iter().map(|source| match source {
                LearntAs::Itself(at) => row[*at],
                LearntAs::Angle {
                    sine,
                    cosine,
                    period,
                    from_zero,
                } => angle(row[*sine], row[*cosine], *period, *from_zero),
            })
        });
        answers.collect()
    }

    /// Standard deviations of the predicted channels, computed from deviations and predictions of the learnt channels. For angles, the deviation is a
    /// first-order approximation.
    pub(crate) fn deviations(&self, deviations: &[f64], learnt: &[f64]) -> Vec<f64> {
        let width = self.learnt.len();
        let rows = deviations
            .chunks_exact(width)
            .zip(learnt.chunks_exact(width));
        let found = rows.flat_map(|(own, row)| {
            self.sources.iter().map(|source| match source {
                LearntAs::Itself(at) => own[*at],
                LearntAs::Angle {
                    sine,
                    cosine,
                    period,
                    ..
                } => {
                    let (s, c) = (row[*sine], row[*cosine]);
                    let across = (c * own[*sine]).hypot(s * own[*cosine]);
                    let radians = across / (s * s + c * c).max(f64::MIN_POSITIVE);
                    (radians / std::f64::consts::TAU * period).min(period / 2.0)
                }
            })
        });
        found.collect()
    }

    /// Index of each predicted channel among the learnt channels; `None` for angles.
    pub(crate) fn as_they_are(&self) -> impl Iterator<Item = Option<usize>> {
        self.sources.iter().map(|source| match source {
            LearntAs::Itself(at) => Some(*at),
            LearntAs::Angle { .. } => None,
        })
    }
}

impl AngleCard {
    /// Cards of the angles with a period among `channels`. `values` contains labels, one row per sample.
    pub(crate) fn of_labels(channels: &Channels, values: &[f64]) -> Vec<AngleCard> {
        let width = channels.len();
        let all = channels.iter().enumerate();
        let cards = all.filter_map(|(position, channel)| {
            let period = channel.period_in_unit()?;
            let own = values.iter().skip(position).step_by(width.max(1));
            let phase = |value: &f64| std::f64::consts::TAU * value / period;
            let sine: f64 = own.clone().map(|value| phase(value).sin()).sum();
            let cosine: f64 = own.clone().map(|value| phase(value).cos()).sum();
            let from_zero = own.clone().all(|value| *value >= 0.0);
            Some(AngleCard {
                name: channel.name().to_owned(),
                unit: channel.unit(),
                period: channel.period()?,
                from_zero,
                mean: angle(sine, cosine, period, from_zero),
            })
        });
        cards.collect()
    }

    /// Name of the learnt sine channel.
    pub(crate) fn sine(&self) -> String {
        format!("{}_sin", self.name)
    }

    /// Name of the learnt cosine channel.
    pub(crate) fn cosine(&self) -> String {
        format!("{}_cos", self.name)
    }
}

fn angle(sine: f64, cosine: f64, period: f64, from_zero: bool) -> f64 {
    let angle = sine.atan2(cosine) / std::f64::consts::TAU * period;
    match from_zero && angle < 0.0 {
        true => angle + period,
        false => angle,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channels(period: u16) -> Channels {
        let yaw = Channel::named("yaw", Unit::Degree).and_then(|yaw| yaw.with_period(period));
        Channels::new([Channel::FZ, yaw.expect("an angle")]).expect("distinct")
    }

    #[test]
    fn labels_become_sines_and_cosines_and_answers_angles_again() {
        for (period, values) in [
            (360, [1.0, 179.0, 2.0, -179.0, 3.0, 20.0]),
            (360, [1.0, 359.0, 2.0, 1.0, 3.0, 200.0]),
            (180, [1.0, 89.0, 2.0, -89.0, 3.0, 0.0]),
        ] {
            let channels = channels(period);
            let cards = AngleCard::of_labels(&channels, &values);
            let learnt = LearntChannels::new(&channels, &cards).expect("names");
            let names: Vec<&str> = learnt.learnt.iter().map(Channel::name).collect();
            assert_eq!(names, ["Fz", "yaw_cos", "yaw_sin"]);
            let answers = learnt.answers(&learnt.labels(&values));
            for (answer, value) in answers.iter().zip(values) {
                assert!((answer - value).abs() < 1e-9, "{answers:?}");
            }
        }
    }

    #[test]
    fn the_mean_of_angles_is_that_of_their_directions_and_a_deviation_is_in_degrees() {
        let values = [1.0, 170.0, 2.0, -170.0];
        let channels = channels(360);
        let cards = AngleCard::of_labels(&channels, &values);
        assert!((cards[0].mean.abs() - 180.0).abs() < 1e-9);
        let learnt = LearntChannels::new(&channels, &cards).expect("names");
        let predicted = [5.0, 1.0, 0.0];
        let found = learnt.deviations(&[0.5, 0.3, 0.01], &predicted);
        assert!((found[0] - 0.5).abs() < 1e-12);
        assert!((found[1] - 0.01_f64.to_degrees()).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn an_angle_in_radians_is_learnt_in_its_own_period() {
        let half = Channel::named("yaw", Unit::Radian).and_then(|yaw| yaw.with_period(180));
        let channels = Channels::new([half.expect("an angle")]).expect("one");
        let values = [0.25, 0.5, 3.0];
        let cards = AngleCard::of_labels(&channels, &values);
        assert_eq!((cards[0].unit, cards[0].period), (Unit::Radian, 180));
        let learnt = LearntChannels::new(&channels, &cards).expect("names");
        let labels = learnt.labels(&values);
        assert!((labels[0] - 0.5_f64.cos()).abs() < 1e-12, "{labels:?}");
        assert!((labels[1] - 0.5_f64.sin()).abs() < 1e-12, "{labels:?}");
        for (answer, value) in learnt.answers(&labels).iter().zip(values) {
            assert!((answer - value).abs() < 1e-12, "{answer} for {value}");
        }
        let found = learnt.deviations(&[0.3, 0.02], &[1.0, 0.0]);
        assert!((found[0] - 0.01).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_name_that_leaves_no_room_for_its_sine_is_refused() {
        let long = "a".repeat(Channel::NAME_MAX);
        let channel = Channel::named(&long, Unit::Degree).and_then(|own| own.with_period(360));
        let channels = Channels::new([channel.expect("an angle")]).expect("one");
        let cards = AngleCard::of_labels(&channels, &[1.0]);
        assert!(LearntChannels::new(&channels, &cards).is_err());
    }
}
