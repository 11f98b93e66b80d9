//! Scores beside what was published of the same sensor, where both are defined alike.

use maud::{Markup, html};

use crate::catalogue::find;
use crate::markup::metric_link;
use crate::markup::{heads, right_heads, scroll};
use crate::number::{minus, spaced, with_interval};
use crate::results::Study;

/// The number of published values, and their table; `None` where no value of these sensors was published under the same definition.
pub(super) fn section(studies: &[Study]) -> Option<(usize, Markup)> {
    let mut rows: Vec<Markup> = Vec::new();
    for study in studies.iter().filter(|study| study.source != "published") {
        let Some(sensor) = find(&study.sensor) else {
            continue;
        };
        for score in &study.scores {
            let (metric, channel) = (&score.metric, &score.channel);
            let alike = sensor.published_alike(metric, channel, &score.definition, score.unit);
            let Some(published) = alike.filter(|_| score.value.number().is_some()) else {
                continue;
            };
            let source = sensor
                .source(&published.source)
                .map_or("", |source| &source.text);
            rows.push(html! {
                tr {
                    th scope="row" { (study.sensor) } td { (metric_link(&score.metric)) } td { (score.channel) }
                    td.r { (minus(&with_interval(score))) }
                    td.r { (minus(&published.value.to_string())) (spaced(score.unit)) }
                    td.wrap.long { (source) ": " (published.conditions) }
                } "\n"
            });
        }
    }
    let note = "Published numbers are of real sensors and other presses; they stand here where metric, channel, unit and definition are the same, and take part in no verdict.";
    let table = html! {
        table.sorts {
            thead { tr { (heads(["sensor", "metric", "channel"])) (right_heads(["here", "published"])) (heads(["source and conditions"])) } }
            tbody { @for row in &rows { (row) } }
        }
    };
    let body = html! { p.note { (note) } "\n" (scroll("Beside published values", &table)) };
    (!rows.is_empty()).then_some((rows.len(), body))
}
