//! How far scores go up and down with the seed of the training, apart from intervals by contact point.

use super::glossary::metric_link;
use crate::escape::html;
use crate::figures::names;
use crate::number::{FormattedValue, minus};
use crate::results::{OverSeeds, SeedScore, Study};

/// How many scores there are, and a table a study; `None` where no model was fitted with several seeds.
pub(super) fn section(studies: &[Study]) -> Option<(usize, String)> {
    let (mut count, mut out) = (0, String::new());
    for (study, name) in studies.iter().zip(names(studies)) {
        if let Some(over) = study
            .over_seeds
            .as_ref()
            .filter(|over| !over.scores.is_empty())
        {
            count += over.scores.len();
            out += &table(over, &name);
        }
    }
    (count > 0).then(|| {
        let note = "The 95 % interval is that of the mean over seeds; it shows how much a score varies between trainings, and takes part in no verdict.";
        (count, format!("<p class=\"note\">{note}</p>\n{out}"))
    })
}

fn table(over: &OverSeeds, name: &str) -> String {
    let seeds: Vec<String> = over.seeds.iter().map(ToString::to_string).collect();
    let (name, seeds) = (html(name), seeds.join(", "));
    let mut out = format!(
        "<p class=\"note\">{name}: seeds {seeds}; a seed decides {}. Every other score of this page is of seed {}.</p>\n\
         <div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{name}, over seeds\"><table class=\"sorts\"><caption>{name}, over {} seeds</caption><thead><tr>\
         <th scope=\"col\">metric</th><th scope=\"col\">channel</th><th scope=\"col\">unit</th><th scope=\"col\" class=\"r\">mean</th>\
         <th scope=\"col\" class=\"r\">95 % interval of the mean</th><th scope=\"col\" class=\"r\">standard deviation</th></tr></thead><tbody>\n",
        html(&over.decides),
        over.seeds
            .first()
            .map_or_else(String::new, ToString::to_string),
        over.seeds.len(),
    );
    out.extend(over.scores.iter().map(row));
    out + "</tbody></table></div>\n"
}

fn row(score: &SeedScore) -> String {
    let formatted = FormattedValue::number(score.mean, Some(score.interval));
    let [low, high] = formatted.interval.unwrap_or_default();
    let unit = match score.unit {
        taceva_core::Unit::One => "",
        unit => unit.symbol(),
    };
    format!(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{unit}</td><td class=\"r\" data-v=\"{:?}\">{}</td><td class=\"r\">{} … {}</td><td class=\"r\" data-v=\"{:?}\">{}</td></tr>\n",
        metric_link(&score.metric),
        html(&score.channel),
        score.mean,
        minus(&formatted.value),
        minus(&low),
        minus(&high),
        score.standard_deviation,
        crate::number::numeral(score.standard_deviation),
    )
}
