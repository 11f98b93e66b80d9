//! Radar charts of several sensors. A radius is the ratio to the best value of the axis; missing values leave gaps.

use taceva_metrics::{Better, Standing};

use super::radar_web::{Rim, WIDTH, outline, web};
use crate::figure::{Canvas, Figure};
use crate::names::{listed, noun};
use crate::results::{PUBLISHED, Study};
use taceva_results::Score;

/// Axis of a radar chart.
struct Axis {
    metric: &'static str,
    channel: &'static str,
    /// Drawn variant of the metric; empty for the score itself.
    variant: &'static str,
    name: &'static str,
    better: Better,
}

/// Axis of a score that is better when lower.
const fn low(metric: &'static str, channel: &'static str, name: &'static str) -> Axis {
    Axis {
        metric,
        channel,
        variant: "",
        name,
        better: Better::Lower,
    }
}

/// Axis of a score that is better when higher.
const fn high(metric: &'static str, channel: &'static str, name: &'static str) -> Axis {
    Axis {
        better: Better::Higher,
        ..low(metric, channel, name)
    }
}

const ACCURACY: [Axis; 6] = [
    low("mae", "Pxy", "MAE Pxy"),
    low("mae", "Pz", "MAE Pz"),
    high("sr", "line", "SR lines"),
    high("sr", "dot", "SR dots"),
    low("mae", "Fz", "MAE Fz"),
    low("mae", "Fxy", "MAE Fxy"),
];
/// Axes of sensor properties. Excludes scores without a better direction, such as frame rate, because the rim means "best".
const SENSOR: [Axis; 4] = [
    high("uniformity", "Fz", "uniformity U"),
    Axis {
        variant: "ratio",
        ..low("hysteresis", "Fz", "hysteresis ratio")
    },
    low("noise_equivalent_force", "Fz", "noise as force"),
    high("signal_to_repeatability", "Fz", "signal to repeats"),
];
const ROBUSTNESS: [Axis; 7] = [
    low("r_spatial", "Pz", "spatial Pz"),
    low("r_spatial", "Fz", "spatial Fz"),
    high("r_light", "Pz", "lighting Pz"),
    high("r_light", "Fz", "lighting Fz"),
    low("repeatability", "Pz", "repeatability Pz"),
    low("repeatability", "Fz", "repeatability Fz"),
    Axis {
        variant: "ratio",
        ..low("hysteresis", "Fz", "hysteresis ratio")
    },
];

/// Least number of axes of a radar. Fewer axes enclose no area.
const FEWEST_AXES: usize = 3;

/// Radar charts of accuracy, sensor and robustness; empty for a single study.
pub(super) fn draw(studies: &[Study]) -> Vec<Option<Figure>> {
    if studies.len() < 2 {
        return Vec::new();
    }
    let title = format!("The {}s at a glance", noun(studies));
    vec![
        one(studies, &ACCURACY, "radar-accuracy", "Accuracy at a glance"),
        one(studies, &SENSOR, "radar-sensor", &title),
        one(
            studies,
            &ROBUSTNESS,
            "radar-robustness",
            "Robustness at a glance",
        ),
    ]
}

/// Radar of the axes on which a study has a value; `None` for fewer than three such axes, or if verdicts exclude all values.
fn one(studies: &[Study], axes: &[Axis], id: &str, title: &str) -> Option<Figure> {
    let names = crate::names::names(studies);
    let deciding: Vec<Study> = studies.iter().map(Study::deciding).collect();
    let studies = deciding.as_slice();
    let (axes, empty): (Vec<&Axis>, Vec<&Axis>) =
        axes.iter().partition(|axis| axis.has_value(studies));
    if axes.len() < FEWEST_AXES {
        return None;
    }
    let shares: Vec<Vec<Option<(f64, f64)>>> =
        axes.iter().map(|axis| axis.shares(studies)).collect();
    if shares.iter().all(|axis| axis.iter().all(Option::is_none)) {
        return None;
    }
    let is_drawn = |at: &usize| shares.iter().any(|axis| axis[*at].is_some());
    let drawn: Vec<usize> = (0..studies.len()).filter(is_drawn).collect();
    let mut canvas = Canvas::new(WIDTH, 400.0);
    let legend = drawn.iter().map(|&at| (at, names[at].clone()));
    let legend: Vec<(usize, String)> = legend.collect();
    canvas.legend([12.0, 18.0], &legend);
    let centre = [WIDTH / 2.0, 226.0];
    let of_axes = axes.iter().map(|axis| Rim {
        name: axis.name,
        better: axis.better,
    });
    let of_axes: Vec<Rim<'_>> = of_axes.collect();
    web(&of_axes, centre, &mut canvas);
    for &at in &drawn {
        let of_one: Vec<Option<(f64, f64)>> = shares.iter().map(|axis| axis[at]).collect();
        outline(&of_one, &of_axes, centre, at, &names[at], &mut canvas);
    }
    let barred: Vec<Barred> = axes.iter().flat_map(|axis| axis.barred(studies)).collect();
    let of_drawn = barred.iter().filter(|barred| drawn.contains(&barred.study));
    let open = shares.iter().map(|axis| {
        let gaps = drawn.iter().filter(|&&at| axis[at].is_none());
        gaps.count()
    });
    let gaps = open.sum::<usize>().saturating_sub(of_drawn.count());
    let barred: Vec<String> = barred
        .iter()
        .map(|barred| {
            format!(
                "{} of {} ({})",
                barred.axis, names[barred.study], barred.reason
            )
        })
        .collect();
    let gaps = match gaps {
        0 => String::new(),
        1 => " One value is missing and left open.".to_owned(),
        _ => format!(" {gaps} values are missing and left open."),
    };
    let barred = match barred.is_empty() {
        true => String::new(),
        false => format!(
            " Not drawn, because they are excluded from verdicts: {}.",
            barred.join("; ")
        ),
    };
    Some(Figure {
        id: id.to_owned(),
        title: title.to_owned(),
        caption: format!(
            "Each axis shows a share of the best {} shown: value / best if more is better (↑), best / value if less is better (↓). The rim is the best value, even if no test shows a difference.{}{gaps}{barred}{}{}",
            noun(studies),
            left_out(&empty),
            without_value(studies, &axes),
            unproven(studies, &axes)
        ),
        description: format!(
            "A radar of {} for {}.",
            axes.iter()
                .map(|axis| axis.name)
                .collect::<Vec<_>>()
                .join(", "),
            listed(&legend.into_iter().map(|(_, name)| name).collect::<Vec<_>>())
        ),
        canvas,
    })
}

/// Value that is not drawn, because verdicts exclude its score.
struct Barred {
    axis: &'static str,
    study: usize,
    reason: &'static str,
}

/// Sentence on the `empty` axes, on which no study has a value; empty if there are none.
fn left_out(empty: &[&Axis]) -> String {
    let names: Vec<String> = empty.iter().map(|axis| axis.name.to_owned()).collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(
            " Axes left out, because no result has a value: {}.",
            listed(&names)
        ),
    }
}

/// Sentence with the number of studies without a value on any axis; empty if there are none.
fn without_value(studies: &[Study], axes: &[&Axis]) -> String {
    let has_none = |study: &&Study| {
        let mut scores = axes
            .iter()
            .map(|axis| study.score(axis.metric, axis.channel));
        scores.all(|score| score.is_none_or(|score| score.value.number().is_none()))
    };
    match studies.iter().filter(has_none).count() {
        0 => String::new(),
        1 => " One more result has none of these values.".to_owned(),
        more => format!(" {more} more results have none of these values."),
    }
}

/// Caption remarks on published values and unknown skill.
fn unproven(studies: &[Study], axes: &[&Axis]) -> String {
    let drawn = |study| axes.iter().filter_map(move |axis| axis.drawn(study));
    let any = |of: fn(&Score) -> bool| studies.iter().flat_map(drawn).any(of);
    let mut out = String::new();
    if any(|score| score.definition == PUBLISHED) {
        out += " Differences between published values were not tested.";
    }
    if any(|score| score.standing == Standing::SkillUnknown) {
        out += " Some models were not tested against predicting the mean.";
    }
    out
}

/// Ratio to the best value, and the value itself, for each of `values`; `None` for an absent or negative value.
pub(super) fn shares(values: &[Option<f64>], better: Better) -> Vec<Option<(f64, f64)>> {
    // A share of a negative number has no meaning.
    let values = values
        .iter()
        .map(|value| value.filter(|value| *value >= 0.0));
    let values: Vec<Option<f64>> = values.collect();
    let known = || values.iter().flatten().copied();
    let best = match better {
        Better::Higher => known().fold(0.0, f64::max),
        _ => known().fold(f64::INFINITY, f64::min),
    };
    let share = |value: f64| match better {
        Better::Higher if best > 0.0 => value / best,
        Better::Higher => 1.0,
        _ if value > best => best / value,
        _ => 1.0,
    };
    values
        .iter()
        .map(|value| value.map(|value| (share(value), value)))
        .collect()
}

impl Axis {
    /// Value of `score` on this axis; `None` if the score or its variant has no number.
    fn value(&self, score: &Score) -> Option<f64> {
        match self.variant {
            "" => score.value.number(),
            variant => score.variant(variant)?.value.number(),
        }
    }

    /// True if a study has a value on this axis, even if verdicts exclude it.
    fn has_value(&self, studies: &[Study]) -> bool {
        let mut scores = studies
            .iter()
            .filter_map(|study| study.score(self.metric, self.channel));
        scores.any(|score| self.value(score).is_some())
    }

    /// Score of `study` for this axis.
    fn drawn<'a>(&self, study: &'a Study) -> Option<&'a Score> {
        let score = study.score(self.metric, self.channel)?;
        (score.value.number().is_some() && self.without_place(score).is_none()).then_some(score)
    }

    /// Values that are not drawn because verdicts exclude them: `spatial Pz of GelSightWM (not above chance)`.
    fn barred(&self, studies: &[Study]) -> Vec<Barred> {
        let of_one = |(at, study): (usize, &Study)| {
            let score = study.score(self.metric, self.channel)?;
            let reason = self.without_place(score)?;
            Some(Barred {
                axis: self.name,
                study: at,
                reason,
            })
        };
        studies.iter().enumerate().filter_map(of_one).collect()
    }

    /// Reason why `score` is not drawn: its standing, or a missing interval. A drawn position is a verdict. Published values need no interval.
    fn without_place(&self, score: &Score) -> Option<&'static str> {
        score.value.number()?;
        let interval = match self.variant {
            "" => score.interval.as_ref(),
            variant => score.variant(variant)?.interval.as_ref(),
        };
        let is_published = score.definition == PUBLISHED;
        let is_unsure =
            || !is_published && interval.is_some_and(|interval| interval.ends().is_none());
        let barred = score
            .standing
            .phrase()
            .filter(|_| !score.standing.takes_part());
        barred.or_else(|| is_unsure().then_some("no interval"))
    }

    /// Ratio to the best value, and value, of each study.
    fn shares(&self, studies: &[Study]) -> Vec<Option<(f64, f64)>> {
        let values: Vec<Option<f64>> = studies
            .iter()
            .map(|study| {
                let found = study.score(self.metric, self.channel);
                let found = found.filter(|score| self.without_place(score).is_none());
                found.and_then(|score| self.value(score))
            })
            .collect();
        shares(&values, self.better)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_metrics::catalogue;

    #[test]
    fn no_axis_is_of_a_metric_that_is_neither_good_nor_bad() {
        for axis in ACCURACY.iter().chain(&SENSOR).chain(&ROBUSTNESS) {
            let metric = catalogue::find(axis.metric).expect("a known metric");
            assert_eq!(metric.better, axis.better, "{}", axis.name);
        }
    }
}
