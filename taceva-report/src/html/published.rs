//! Scores beside what was published of the same sensor, where both are defined alike.

use super::glossary::metric_link;
use crate::catalogue::find;
use crate::escape::html;
use crate::number::{minus, spaced, with_interval};
use crate::results::Study;

/// The number of published values, and their table; `None` where no value of these sensors was published under the same definition.
pub(super) fn section(studies: &[Study]) -> Option<(usize, String)> {
    let (mut count, mut rows) = (0, String::new());
    for study in studies.iter().filter(|study| study.source != "published") {
        let Some(sensor) = find(&study.sensor) else {
            continue;
        };
        for score in &study.scores {
            let quantity = (&*score.metric, &*score.channel);
            let alike = sensor.published_alike(quantity, (&score.definition, score.unit));
            let Some(published) = alike.filter(|_| score.value.number().is_some()) else {
                continue;
            };
            count += 1;
            let source = sensor.source(&published.source);
            rows += &format!(
                "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"r\">{}</td><td class=\"r\">{}{}</td><td class=\"wrap long\">{}: {}</td></tr>\n",
                html(&study.sensor),
                metric_link(&score.metric),
                html(&score.channel),
                minus(&html(&with_interval(score))),
                minus(&published.value.to_string()),
                spaced(score.unit),
                html(source.map_or("", |source| &source.text)),
                html(&published.conditions),
            );
        }
    }
    (!rows.is_empty()).then(|| {
        let table = format!(
            "<p class=\"note\">Published numbers are of real sensors and other presses; they stand here where metric, channel, unit and definition are the same, and take part in no verdict.</p>\n\
             <div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Beside published values\"><table class=\"sorts\"><thead><tr><th scope=\"col\">sensor</th><th scope=\"col\">metric</th>\
             <th scope=\"col\">channel</th><th scope=\"col\" class=\"r\">here</th><th scope=\"col\" class=\"r\">published</th><th scope=\"col\">source and conditions</th></tr></thead><tbody>\n{rows}</tbody></table></div>"
        );
        (count, table)
    })
}
