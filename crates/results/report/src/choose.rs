//! Which sensor for a task: hard needs drop, soft ones rank, and every step shows the numbers that decided.

mod evidence;
mod need;
mod place;
mod property;
mod render;
mod words;

pub use evidence::{Evidence, choose_results};
pub use need::{Bound, Need, NeedError};
pub use property::Property;
pub use render::CHOICE_SCHEMA;

use taceva_metrics::Standing;

use crate::catalogue::{Kind, Sensor};

/// A shortlist and how it came about.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Those that remain, the best first.
    pub ranked: Vec<Candidate>,
    /// Those that would remain, but of which it is not known whether they meet a hard need; in the order of their names.
    pub open: Vec<Open>,
    /// Those that a need dropped.
    pub dropped: Vec<Dropped>,
    /// Those that are not ranked, because a number that a need uses takes no part in verdicts.
    pub barred: Vec<Dropped>,
    /// Sensors of which no number that a need asks for is known.
    pub unknown: Vec<String>,
    /// The differences between ranked sensors that tests show; `None` where nothing was tested, as with published numbers.
    pub evidence: Option<Vec<Evidence>>,
    /// A sentence on those errors, among the numbers that rank, whose labels differ in spread between the sensors.
    pub spread: Option<String>,
    /// Whether samples behind the numbers are simulated.
    pub simulated: bool,
    /// Sensors whose greatest depth or force a need asks for; both are taken from the catalogue, not from their results.
    pub limits_of_catalogue: Vec<String>,
}

/// A sensor that meets every hard need, as far as is known.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Its name.
    pub name: String,
    /// The mean over soft needs of its share of the best; 1 where nothing ranks.
    pub share: f64,
    /// Every number that was used.
    pub steps: Vec<Step>,
}

/// One number of one sensor against one need.
#[derive(Clone, Debug)]
pub struct Step {
    /// The need as it was given.
    pub need: String,
    /// The property: `MAE Fxy`.
    pub property: Property,
    /// The number; none if it is not known.
    pub value: Option<f64>,
    /// Its interval of 95 %, if there is one.
    pub interval: Option<[f64; 2]>,
    /// Whether the number takes part in verdicts, and if not, why.
    pub standing: Standing,
    /// Its share of the best of those that remain; none for hard needs and unknown numbers.
    pub share: Option<f64>,
    /// Whether the need is a hard one, which does not rank.
    pub is_bound: bool,
    /// Whether the interval of the number reaches beyond the bound of a hard need, which the number itself meets.
    pub is_unsure: bool,
}

/// A sensor of which a hard need asks what is not known.
#[derive(Clone, Debug)]
pub struct Open {
    /// Its name.
    pub name: String,
    /// The need, and what is not known.
    pub reason: String,
}

/// A sensor that is not ranked.
#[derive(Clone, Debug)]
pub struct Dropped {
    /// Its name.
    pub name: String,
    /// The need that it does not meet, with the number that decided, or why its number takes no part.
    pub reason: String,
}

/// Chooses among `sensors` for `needs`.
///
/// A hard need drops every sensor whose number is known not to meet it, and sets those apart of which that number is not known: what nobody
/// knows recommends nothing. A sensor is not ranked if a need uses a score of it that takes no part in verdicts. Studies of sensors are no sensors. A soft need ranks those that remain: a sensor has the share of
/// the best that its number has, the mean over the numbers of the need; a number that is not known counts as a share of 0, since it
/// recommends nothing. The rank is the mean over soft needs; equals share a place, and stay in the order of their names.
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
        open: Vec::new(),
        dropped: Vec::new(),
        barred: Vec::new(),
        unknown: Vec::new(),
        evidence: None,
        spread: None,
        simulated: false,
        limits_of_catalogue: Vec::new(),
    };
    let mut remaining: Vec<&Sensor> = Vec::new();
    for sensor in sensors.iter().filter(|entry| entry.kind == Kind::Sensor) {
        let mut properties = needs.iter().flat_map(Need::properties);
        if !properties.any(|property| property.of(sensor).is_some()) {
            choice.unknown.push(sensor.name.clone());
        } else if let Some(reason) = barred(sensor, needs) {
            choice.barred.push(Dropped {
                name: sensor.name.clone(),
                reason,
            });
        } else if let Some(reason) = unmet(sensor, needs) {
            choice.dropped.push(Dropped {
                name: sensor.name.clone(),
                reason,
            });
        } else if let Some(reason) = unproven(sensor, needs) {
            choice.open.push(Open {
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

/// The first number of `sensor` that a need uses and that takes no part in verdicts.
fn barred(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let properties = needs
        .iter()
        .flat_map(|need| need.properties().map(move |property| (need, property)));
    let mut barred = properties.filter_map(|(need, property)| {
        let reason = property.standing(sensor).reason()?;
        Some(format!("`{}` looks at {property}: {reason}", need.words))
    });
    barred.next()
}

/// The first hard need that `sensor` is known not to meet.
fn unmet(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let bounds = needs
        .iter()
        .flat_map(|need| need.bounds.iter().map(move |bound| (need, bound)));
    let mut failed = bounds.filter_map(|(need, bound)| {
        let value = bound.property.of(sensor)?;
        (!bound.property.is_reached() && !bound.holds(value)).then(|| {
            let ends = bound.property.interval(sensor);
            let is_unsure = ends.is_some_and(|ends| ends.into_iter().any(|end| bound.holds(end)));
            let unsure = match is_unsure {
                true => ", by the value alone: its interval reaches across",
                false => "",
            };
            format!(
                "`{}` needs {bound}, and its {} is {}{unsure}",
                need.words,
                bound.property,
                bound.property.shown(value)
            )
        })
    });
    failed.next()
}

/// The first hard need of which it is not known whether `sensor` meets it.
fn unproven(sensor: &Sensor, needs: &[Need]) -> Option<String> {
    let bounds = needs
        .iter()
        .flat_map(|need| need.bounds.iter().map(move |bound| (need, bound)));
    let mut unproven = bounds.filter_map(|(need, bound)| {
        let property = bound.property;
        let reason = match property.of(sensor) {
            None => "is not known".to_owned(),
            Some(value) if property.is_reached() && !bound.holds(value) => format!(
                "that was tried is {}, which need not be its limit",
                property.shown(value)
            ),
            Some(_) => return None,
        };
        Some(format!("`{}` needs {bound}, and its {property} {reason}", need.words))
    });
    unproven.next()
}

fn candidate(sensor: &Sensor, remaining: &[&Sensor], needs: &[Need]) -> Candidate {
    let (mut steps, mut shares) = (Vec::new(), Vec::new());
    for need in needs {
        for bound in &need.bounds {
            steps.push(Step {
                need: need.words.clone(),
                property: bound.property,
                value: bound.property.of(sensor),
                interval: bound.property.interval(sensor),
                standing: bound.property.standing(sensor),
                share: None,
                is_bound: true,
                is_unsure: bound
                    .property
                    .interval(sensor)
                    .is_some_and(|ends| !ends.into_iter().all(|end| bound.holds(end))),
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
                interval: property.interval(sensor),
                standing: property.standing(sensor),
                share,
                is_bound: false,
                is_unsure: false,
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

    /// The names of the four sensors of the study, ranked for `needs`.
    fn ranked(needs: &str) -> Vec<String> {
        let needs = Need::parse(needs).unwrap_or_else(|error| panic!("{error}"));
        let of_study = ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"];
        let of_study = of_study.map(|name| catalogue::find(name).expect("there"));
        let choice = choose(&of_study, &needs);
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
    fn results_of_a_sensor_are_held_to_what_it_is_known_to_stand() {
        let named = |name: &str| {
            let study = crate::Study {
                sensor: name.to_owned(),
                scores: catalogue::find("ViTacTip")
                    .expect("there")
                    .as_study()
                    .scores,
                ..crate::Study::default()
            };
            Sensor::of_study(&study)
        };
        let needs = Need::parse("normal force, force 1 N").expect("needs");
        let choice = choose(
            &[named("ViTacTip"), named("MagicTac"), named("mine")],
            &needs,
        );
        let names: Vec<&str> = choice
            .ranked
            .iter()
            .map(|candidate| candidate.name.as_str())
            .collect();
        assert_eq!(names, ["MagicTac"]);
        let [tried, mine] = choice.open.as_slice() else {
            panic!("{:?}", choice.open);
        };
        let reason = "its greatest normal force that was tried is 0.7 N, which need not be its limit";
        assert!(tried.reason.contains(reason), "{tried:?}");
        assert_eq!(mine.name, "mine");
        assert!(mine.reason.contains("not known"), "{mine:?}");
    }

    #[test]
    fn what_a_real_sensor_stands_is_not_known_of_a_simulated_one_and_said_to_be_of_the_catalogue() {
        let study = |source: &str| crate::Study {
            sensor: "MagicTac".to_owned(),
            source: source.to_owned(),
            scores: catalogue::find("MagicTac")
                .expect("there")
                .as_study()
                .scores,
            ..crate::Study::default()
        };
        let needs = Need::parse("normal force, force 1 N, even surface").expect("needs");
        let simulated = choose_results(&[study("simulated")], &needs);
        assert_eq!(simulated.open.len(), 1, "{simulated:?}");
        assert!(simulated.limits_of_catalogue.is_empty());
        let mut measured = study("recorded");
        measured.scores.retain(|score| score.metric != "uniformity");
        let measured = choose_results(&[measured], &needs).table().text();
        let limits =
            "Greatest depth and force are of the catalogue, not of these results: MagicTac.";
        assert!(measured.contains(limits), "{measured}");
        let unknown = "Counted as a share of 0, since it is not known: uniformity of MagicTac.";
        assert!(measured.contains(unknown), "{measured}");
    }

    #[test]
    fn no_study_of_sensors_is_ever_chosen_or_set_aside() {
        let choice = choose(&catalogue::all(), &Need::parse("fast").expect("a need"));
        let listed = format!("{choice:?}");
        for study in ["Eval", "Sparsh", "TacEva", "VT-Review", "PBR-Design"] {
            assert!(!listed.contains(&format!("\"{study}\"")), "{study}");
        }
    }

    #[test]
    fn numbers_have_the_digits_that_people_read() {
        let shown = |value: f64| Property::Error("Fz").shown(value);
        assert_eq!(shown(0.031_415_926_535_897_9), "0.03142 N");
        assert_eq!(shown(25.0), "25 N");
        assert_eq!(shown(0.0361), "0.0361 N");
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
        assert!(choice.unknown.contains(&"GelForce".to_owned()));
        let digit = choice.open.iter().find(|open| open.name == "DIGIT");
        let reason = &digit.expect("its rate is known, and no more").reason;
        assert!(
            reason.contains("greatest normal force is not known"),
            "{reason}"
        );
    }
}
