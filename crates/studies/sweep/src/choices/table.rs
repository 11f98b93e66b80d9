//! Table of the choices for each channel.

use taceva_metrics::Repeats;
use taceva_report::{Cell, Column, FormattedValue, Table};

use super::{Choice, ends, number};
use crate::analysis::Group;

/// Configurations with a result that has no validation error, each once.
fn without_validation(groups: &[Group<'_>]) -> Vec<String> {
    let mut silent: Vec<String> = Vec::new();
    for group in groups {
        let mut results = group.results.iter();
        let is_silent = results.any(|(_, result)| result.validation.is_empty());
        if is_silent && !silent.contains(&group.configuration) {
            silent.push(group.configuration.clone());
        }
    }
    silent
}

/// Name of the quantity that `channel` measures; empty for an unknown channel.
fn question(channel: &str) -> &'static str {
    match channel {
        "Pz" => "depth",
        "Px" | "Py" => "position in the plane",
        "Fz" => "normal force",
        "Fx" | "Fy" => "shear force",
        _ => "",
    }
}

/// One row for each choice: the configuration, its validation error, and its score on the test part.
pub(crate) fn table(groups: &[Group<'_>], choices: &[Choice]) -> Table {
    let columns = [
        "recording",
        "split",
        "question",
        "channel",
        "chosen",
        "among",
        "validation RMSE",
        "test MAE",
        "95 % over seeds",
        "seeds",
        "MAE of one seed",
        "95 % over contact points",
        "unit",
    ];
    let mut table = Table::new(
        "Best configuration for each question",
        columns.map(Column::new),
    );
    for choice in choices {
        let group = &groups[choice.chosen];
        let values = group.values("mae", &choice.channel);
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let over_seeds =
            Repeats::of(&values).map(|repeats| repeats.within([0.0, f64::MAX]).interval);
        let (first_seed, first) = match group.results.first() {
            Some((seed, result)) => (*seed, result.score("mae", &choice.channel)),
            None => (0, None),
        };
        let of_first = first.and_then(|score| score.value.number());
        let over_points = first.and_then(|score| {
            let interval = score.interval.as_ref()?.ends()?;
            Some(ends(score.value.number()?, interval))
        });
        let of_first = of_first.map_or_else(
            || "none".to_owned(),
            |value| {
                format!(
                    "{} (seed {first_seed})",
                    FormattedValue::number(value, None).value
                )
            },
        );
        table.push([
            Cell::text(group.dataset),
            Cell::text(group.split.unwrap_or("as recorded")),
            Cell::text(question(&choice.channel)),
            Cell::text(choice.channel.as_str()),
            Cell::text(group.configuration.as_str()),
            Cell::Number(choice.among.to_string()),
            number(choice.rmse),
            if values.is_empty() {
                Cell::text("none")
            } else {
                number(mean)
            },
            Cell::text(over_seeds.map_or_else(
                || "none: one seed".to_owned(),
                |interval| ends(mean, interval),
            )),
            Cell::Number(values.len().to_string()),
            Cell::text(of_first),
            Cell::text(over_points.unwrap_or_else(|| "none: too few contact points".to_owned())),
            Cell::text(choice.unit.as_str()),
        ]);
    }
    table.note("Chosen by the least root mean square error, mean over seeds, on validation parts or in cross-validation within the \
        training part; models that report neither are excluded. Choices use no test part: the test error is that of the chosen \
        configuration.");
    let silent = without_validation(groups);
    if !silent.is_empty() {
        table.note(format!(
            "Excluded, because they report no such error: {}.",
            silent.join("; ")
        ));
    }
    table.note("Test MAE is the mean over seeds. The interval over seeds shows how that mean varies with other divisions and random \
        numbers on the same recording. The interval over contact points shows how the MAE of one seed varies with other \
        presses and the same training. Do not add the two intervals.");
    table
}
