//! Scores and their variants in sequence: the rows of tables.

use taceva_core::Unit;
use taceva_metrics::{Better, Evaluation, Flag, Interval, Score, Standing, Value};

/// One number of a report, or the reason why there is none.
pub(super) struct Line<'a> {
    /// The metric, with the name of the variant: `mae`, `r_spatial.within`.
    pub(super) name: String,
    /// The channel or plane.
    pub(super) channel: &'a str,
    /// The value.
    pub(super) value: &'a Value,
    /// Its unit.
    pub(super) unit: Unit,
    /// Its interval; `None` where the question makes no sense.
    pub(super) interval: Option<&'a Interval>,
    /// The score it belongs to.
    pub(super) score: &'a Score,
    /// Whether it is the score itself and not one of its variants.
    pub(super) is_headline: bool,
}

/// Every score, each followed by its variants that are one number; maps and curves are for JSON.
pub(super) fn lines(evaluation: &Evaluation) -> Vec<Line<'_>> {
    let mut lines = Vec::new();
    for (metric, channel, score) in evaluation.scores() {
        lines.push(Line {
            name: metric.id.to_owned(),
            channel,
            value: &score.value,
            unit: score.unit,
            interval: Some(&score.interval),
            score,
            is_headline: true,
        });
        let numbers = score
            .variants
            .iter()
            .filter(|variant| is_one(&variant.value));
        lines.extend(numbers.map(|variant| Line {
            name: format!("{}.{}", metric.id, variant.name),
            channel,
            value: &variant.value,
            unit: variant.unit,
            interval: variant.interval.as_ref(),
            score,
            is_headline: false,
        }));
    }
    lines
}

/// The lines for people: reference constants are no scores, and are in JSON and CSV only.
pub(super) fn read_lines(evaluation: &Evaluation) -> Vec<Line<'_>> {
    let lines = lines(evaluation).into_iter();
    lines.filter(|line| !line.is_reference()).collect()
}

impl Line<'_> {
    /// The name with the sign of its direction: `mae ↓`.
    pub(super) fn shown_name(&self) -> String {
        Better::named(&self.name)
    }

    /// Whether it is the reference constant of a score, which is no claim of the model.
    pub(super) fn is_reference(&self) -> bool {
        matches!(
            self.name.as_str(),
            "skill.constant" | "sr.of_constant" | "tolerance.of_constant"
        )
    }
}

/// Flags of scores, a line for each flag of a metric: `uniformity Fz: one bin`, `skill Pz Fz: constant is the mean of truth`.
pub(super) fn flags(evaluation: &Evaluation) -> Vec<String> {
    let mut groups: Vec<(&str, &Flag, Vec<&str>)> = Vec::new();
    for (metric, channel, score) in evaluation.scores() {
        for flag in &score.flags {
            let is_same =
                |group: &&mut (&str, &Flag, Vec<&str>)| (group.0, group.1) == (metric.id, flag);
            match groups.iter_mut().find(is_same) {
                Some((_, _, channels)) => channels.push(channel),
                None => groups.push((metric.id, flag, vec![channel])),
            }
        }
    }
    let groups = groups.into_iter();
    groups
        .map(|(id, flag, channels)| format!("{id} {}: {flag}", channels.join(" ")))
        .collect()
}

/// Which scores take no full part in verdicts: `no skill: Pz Fz`, `bounded: r_light Px Py`.
pub(super) fn standings(evaluation: &Evaluation) -> Vec<String> {
    let mut said = Vec::new();
    for standing in Standing::ALL {
        let Some(words) = standing.words() else {
            continue;
        };
        let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
        let of_it = evaluation
            .scores()
            .filter(|(_, _, score)| score.standing == standing && score.value.scalar().is_some());
        for (metric, channel, _) in of_it {
            match groups.last_mut() {
                Some((id, channels)) if *id == metric.id => channels.push(channel),
                _ => groups.push((metric.id, vec![channel])),
            }
        }
        let groups: Vec<String> = groups
            .into_iter()
            .map(|(id, channels)| format!("{id} {}", channels.join(" ")))
            .collect();
        if !groups.is_empty() {
            said.push(format!("{words}: {}", groups.join(", ")));
        }
    }
    said
}

/// The maps, curves and matrices that only JSON holds, a line a metric: `r_spatial Px Py Fz: distance, depth`.
pub(super) fn pictures(evaluation: &Evaluation) -> Vec<String> {
    let mut pictures: Vec<(&str, Vec<&str>, String)> = Vec::new();
    for (metric, channel, score) in evaluation.scores() {
        let many = score
            .variants
            .iter()
            .filter(|variant| !is_one(&variant.value));
        let names: Vec<&str> = many.map(|variant| variant.name.as_ref()).collect();
        let names = names.join(", ");
        match pictures.last_mut() {
            _ if names.is_empty() => {}
            Some((id, channels, same)) if *id == metric.id && *same == names => {
                channels.push(channel);
            }
            _ => pictures.push((metric.id, vec![channel], names)),
        }
    }
    let line = |(id, channels, names): (&str, Vec<&str>, String)| {
        format!("{id} {}: {names}", channels.join(" "))
    };
    pictures.into_iter().map(line).collect()
}

fn is_one(value: &Value) -> bool {
    !matches!(value, Value::Map(_) | Value::Curve(_) | Value::Matrix(_))
}
