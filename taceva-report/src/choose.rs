//! Which sensor for a task: hard needs drop, soft ones rank, and every step shows the numbers that decided.

mod need;
mod property;
mod render;
mod words;

pub use need::{Bound, Need, NeedError};
pub use property::Property;
pub use render::CHOICE_SCHEMA;

use crate::catalogue::Sensor;

/// A shortlist and how it came about.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Those that remain, the best first.
    pub ranked: Vec<Candidate>,
    /// Those that a need dropped.
    pub dropped: Vec<Dropped>,
    /// Those of which not a single number is known that a need asks for.
    pub unknown: Vec<String>,
}

/// A sensor that meets every hard need, as far as is known.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// What it is called.
    pub name: String,
    /// The mean over soft needs of its share of the best; 1 where nothing ranks.
    pub share: f64,
    /// Every number that was looked at.
    pub steps: Vec<Step>,
}

/// One number of one sensor against one need.
#[derive(Clone, Debug)]
pub struct Step {
    /// The need as it was said.
    pub need: String,
    /// What was looked at: `MAE Fxy`.
    pub property: Property,
    /// The number; none if it is not known.
    pub value: Option<f64>,
    /// Its share of the best of those that remain; none for hard needs and unknown numbers.
    pub share: Option<f64>,
}

/// A sensor that a hard need dropped.
#[derive(Clone, Debug)]
pub struct Dropped {
    /// What it is called.
    pub name: String,
    /// The need that it does not meet, with the number that decided.
    pub reason: String,
}

/// Chooses among `sensors` for `needs`.
///
/// A hard need drops every sensor whose number is known not to meet it. A soft need ranks those that remain: a sensor has the share of
/// the best that its number has, the mean over the numbers of the need; a number that is not known counts as a share of 0, since it
/// recommends nothing. The rank is the mean over soft needs; equals stay in the order of their names.
///
/// ```
/// use taceva_report::{Need, catalogue, choose};
/// let choice = choose(&catalogue::all(), &Need::parse("accurate shear")?);
/// assert_eq!(choice.ranked[0].name, "ViTacTip");
/// # Ok::<(), taceva_report::NeedError>(())
/// ```
pub fn choose(sensors: &[Sensor], needs: &[Need]) -> Choice {
    let mut choice = Choice {
        ranked: Vec::new(),
        dropped: Vec::new(),
        unknown: Vec::new(),
    };
    let mut remaining: Vec<&Sensor> = Vec::new();
    for sensor in sensors {
        let mut properties = needs.iter().flat_map(Need::properties);
        if !properties.any(|property| property.of(sensor).is_some()) {
            choice.unknown.push(sensor.name.clone());
        } else if let Some(reason) = unmet(sensor, needs) {
            choice.dropped.push(Dropped {
                name: sensor.name.clone(),
                reason,
            });
        } else {
            remaining.push(sensor);
        }
    }
    choice.ranked = remaining
        .iter()
        .map(|sensor| candidate(sensor, &remaining, needs))
        .collect();
    let by_share = |left: &Candidate, right: &Candidate| right.share.total_cmp(&left.share);
    choice.ranked.sort_by(by_share);
    choice
}

/// The first hard need that `sensor` is known not to meet.
fn unmet(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let bounds = needs
        .iter()
        .flat_map(|need| need.bounds.iter().map(move |bound| (need, bound)));
    let mut failed = bounds.filter_map(|(need, bound)| {
        let value = bound.property.of(sensor)?;
        (!bound.holds(value)).then(|| {
            format!(
                "`{}` needs {bound}, and its {} is {}",
                need.words,
                bound.property,
                bound.property.shown(value)
            )
        })
    });
    failed.next()
}

fn candidate(sensor: &Sensor, remaining: &[&Sensor], needs: &[Need]) -> Candidate {
    let (mut steps, mut shares) = (Vec::new(), Vec::new());
    for need in needs {
        for bound in &need.bounds {
            steps.push(Step {
                need: need.words.clone(),
                property: bound.property,
                value: bound.property.of(sensor),
                share: None,
            });
        }
        let mut of_need = Vec::new();
        for property in &need.ranks {
            let value = property.of(sensor);
            let share = value.and_then(|value| property.share(value, remaining));
            of_need.push(share.unwrap_or(0.0));
            steps.push(Step {
                need: need.words.clone(),
                property: *property,
                value,
                share,
            });
        }
        shares.extend(mean(&of_need));
    }
    Candidate {
        name: sensor.name.clone(),
        share: mean(&shares).unwrap_or(1.0),
        steps,
    }
}

fn mean(values: &[f64]) -> Option<f64> {
    let count = values.iter().fold(0.0, |count, _| count + 1.0);
    (count > 0.0).then(|| values.iter().sum::<f64>() / count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    fn ranked(needs: &str) -> Vec<String> {
        let needs = Need::parse(needs).unwrap_or_else(|error| panic!("{error}"));
        let choice = choose(&catalogue::all(), &needs);
        choice
            .ranked
            .into_iter()
            .map(|candidate| candidate.name)
            .collect()
    }

    #[test]
    fn the_guidance_of_the_study_comes_out() {
        for (needs, expected) in [
            ("deep contact, normal force", "ViTacTip"),
            ("soft contact, normal force", "ViTacTip"),
            ("shallow contact, depth", "GelSight"),
            ("firm contact, depth", "GelSight"),
            ("shallow contact, planar, fast", "MagicTac"),
            ("firm contact, planar, fast", "MagicTac"),
            ("accurate shear", "ViTacTip"),
            ("no shear", "GelSightWM"),
        ] {
            assert_eq!(ranked(needs)[0], expected, "{needs}");
        }
        assert_eq!(
            ranked("accurate shear, ambient light"),
            ["GelSight", "GelSightWM"]
        );
    }

    #[test]
    fn what_no_sensor_meets_says_who_fails_by_which_number() {
        let needs =
            Need::parse("shear, force <= 1 N, ambient light, rate >= 50 Hz, localisation 0.3 mm")
                .expect("needs");
        let choice = choose(&catalogue::all(), &needs);
        assert!(choice.ranked.is_empty());
        let gelsight = choice
            .dropped
            .iter()
            .find(|dropped| dropped.name == "GelSight")
            .expect("dropped");
        assert_eq!(
            gelsight.reason,
            "`rate >= 50 Hz` needs frame rate ≥ 50 Hz, and its frame rate is 25 Hz"
        );
        assert!(choice.unknown.contains(&"DIGIT".to_owned()));
    }
}
