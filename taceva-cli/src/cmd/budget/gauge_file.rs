//! Variance components of gauge studies, for sources such as `gauge.json#unit`.

use std::fs;
use std::path::Path;

use serde::Deserialize;
use taceva_core::{shown, suggestion};
use taceva_metrology::budget::{BudgetError, BudgetText, Figure, Freedom};
use taceva_metrology::gauge::SCHEMA;

use super::evidence::Measured;

/// Fields of the JSON of a gauge study that a budget needs.
#[derive(Deserialize)]
struct Study {
    schema: String,
    unit: String,
    channel: String,
    operators: u32,
    columns: Columns,
    components: Vec<Component>,
    table: Vec<Row>,
    sources: Vec<String>,
}

#[derive(Deserialize)]
struct Columns {
    by: Vec<String>,
}

#[derive(Deserialize)]
struct Component {
    name: String,
    sd: f64,
}

/// Row of the analysis of variance.
#[derive(Deserialize)]
struct Row {
    source: String,
    df: f64,
    ms: Option<f64>,
}

/// Adds the components that sources name, from files in `folder` and below.
pub(super) fn add_components(
    measured: &mut Measured,
    budget: &BudgetText,
    folder: &Path,
) -> Result<(), BudgetError> {
    for figure in budget.figures() {
        let Some((file, component)) = figure.rsplit_once('#') else {
            continue;
        };
        let found = read(&folder.join(file), budget);
        let found = found.and_then(|study| Ok((study.figure(component)?, study.sources)));
        let refused = |reason: String| budget.not_measured(figure, &reason);
        let (value, origins) = found.map_err(refused)?;
        measured.take(|evidence| evidence.with(figure, value));
        for origin in origins {
            if !measured.origins.contains(&origin) {
                measured.origins.push(origin);
            }
        }
    }
    Ok(())
}

fn read(path: &Path, budget: &BudgetText) -> Result<Study, String> {
    let place = shown(path);
    let text = fs::read_to_string(path).map_err(|error| format!("cannot read {place}: {error}"))?;
    let study: Study = serde_json::from_str(&text).map_err(|error| {
        format!("{place}: {error}; expected the JSON of `taceva gauge --format json`")
    })?;
    let expected = [
        ("schema", &study.schema, SCHEMA),
        ("channel", &study.channel, budget.measurand()),
        ("unit", &study.unit, budget.unit()),
    ];
    for (key, found, expected) in expected {
        if found != expected {
            return Err(format!(
                "{place}, {key} `{}`: expected `{}`",
                shown(found),
                shown(expected)
            ));
        }
    }
    Ok(study)
}

impl Study {
    /// Component called `name`. The name of an operator column, such as `unit` for `unit_id`, selects the component of operators.
    fn figure(&self, name: &str) -> Result<Figure, String> {
        let mut columns = self.columns.by.iter();
        let is_operator =
            columns.any(|column| column == name || column.strip_suffix("_id") == Some(name));
        let name = if is_operator { "operator" } else { name };
        let mut components = self.components.iter();
        let found = components.find(|component| component.name == name);
        let found = found.ok_or_else(|| {
            let known: Vec<&str> = self.components.iter().map(|of| of.name.as_str()).collect();
            format!(
                "`{}` is not a component; {}",
                shown(name),
                suggestion(name, &known)
            )
        })?;
        Ok(Figure::new(found.sd, Freedom::Finite(self.freedom(name))))
    }

    /// Degrees of freedom of the component `name`. Repeatability has those of its mean square, operators have them by Satterthwaite, and other
    /// components have the number of operators minus 1.
    fn freedom(&self, name: &str) -> f64 {
        let of_operators = f64::from(self.operators.saturating_sub(1).max(1));
        let row = |names: &[&str]| {
            let mut rows = names.iter();
            rows.find_map(|name| self.table.iter().find(|row| row.source == *name))
        };
        let mean_square = |row: &Row| row.ms.unwrap_or_default();
        match name {
            "repeatability" => row(&["pooled", "repeatability"]).map_or(of_operators, |row| row.df),
            "operator" => {
                // The mean square of operators is compared with the next lower mean square: pooled, interaction, or nested parts.
                let rows = row(&["operator"]).zip(row(&["pooled", "interaction", "part"]));
                let freedom = rows.map(|(own, next)| {
                    let [a, b] = [own, next].map(mean_square);
                    (a - b).max(0.0).powi(2) / (a * a / own.df + b * b / next.df)
                });
                let is_sound = |freedom: &f64| *freedom > 0.0 && freedom.is_finite();
                freedom.filter(is_sound).unwrap_or(of_operators)
            }
            _ => of_operators,
        }
    }
}
