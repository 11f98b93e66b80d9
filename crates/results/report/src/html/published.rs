//! Scores next to published numbers of the same sensor and definition.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use maud::{Markup, html};
use taceva_core::counted;

use crate::catalogue::find;
use crate::markup::metric_link;
use crate::markup::{heads, right_heads, scroll};
use crate::number::{minus, spaced, with_interval};
use crate::results::Study;

/// Sentence that compares the order of the sensors with the published order. `None` without comparable published scores of two sensors.
pub(super) fn order(studies: &[Study]) -> Option<String> {
    let mut values: BTreeMap<(&str, &str), Vec<[f64; 2]>> = BTreeMap::new();
    for study in studies.iter().filter(|study| study.source != "published") {
        let Some(sensor) = find(&study.sensor) else {
            continue;
        };
        for score in &study.scores {
            let (metric, channel) = (score.metric.as_str(), score.channel.as_str());
            let alike = sensor.published_alike(metric, channel, &score.definition, score.unit);
            if let Some((published, here)) = alike.zip(score.value.number()) {
                let both = [here, published.value];
                values.entry((metric, channel)).or_default().push(both);
            }
        }
    }
    values.retain(|_, both| both.len() > 1);
    let (mut alike, mut reversed) = (0_u32, 0_u32);
    for both in values.values() {
        for (at, one) in both.iter().enumerate() {
            for other in &both[at + 1..] {
                let [here, published] = [0, 1].map(|side| one[side].total_cmp(&other[side]));
                match (here, published) {
                    (Ordering::Equal, _) | (_, Ordering::Equal) => {}
                    _ if here == published => alike += 1,
                    _ => reversed += 1,
                }
            }
        }
    }
    let pairs = alike + reversed;
    (pairs > 0).then(|| {
        let tau = (f64::from(alike) - f64::from(reversed)) / f64::from(pairs);
        format!(
            "The sensors are in the published order in {alike} of {} over {} (Kendall's τ {}): 1 is the same order, 0 no agreement, −1 the reverse.",
            counted(pairs, "pair"),
            counted(values.len(), "score"),
            minus(&format!("{tau:.2}"))
        )
    })
}

/// Number of comparable published values, and their section; `None` without such values.
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
    let note = "Published numbers come from real sensors and other presses. They are listed where metric, channel, unit and definition agree, and are excluded from verdicts.";
    let table = html! {
        table.sorts {
            thead { tr { (heads(["sensor", "metric", "channel"])) (right_heads(["here", "published"])) (heads(["source and conditions"])) } }
            tbody { @for row in &rows { (row) } }
        }
    };
    let body = html! { p.note { (note) } "\n" (scroll("Beside published values", &table)) };
    (!rows.is_empty()).then_some((rows.len(), body))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A study of a published sensor with one error of depth.
    fn study(sensor: &str, value: f64) -> Study {
        let text = format!(
            r#"{{"schema": "taceva.evaluation/1.0", "subject": {{"sensor": "{sensor}", "source": "simulated"}},
               "metrics": {{"mae": {{"Pz": {{"value": {value}, "unit": "mm", "definition": "mae/1"}}}}}}}}"#
        );
        crate::results::unsealed(&text).expect("a result").remove(0)
    }

    #[test]
    fn the_order_of_sensors_is_held_against_the_published_one() {
        // Published: GelSightWM 0.0294 mm, GelSight 0.0325 mm, ViTacTip 0.1781 mm.
        let order_of =
            |values: [(&str, f64); 3]| order(&values.map(|(sensor, value)| study(sensor, value)));
        let same = order_of([("GelSightWM", 0.1), ("GelSight", 0.2), ("ViTacTip", 0.3)]);
        let words = same.expect("three are published");
        assert!(
            words.contains("in 3 of 3 pairs over 1 score (Kendall's τ 1.00)"),
            "{words}"
        );
        let reversed = order_of([("GelSightWM", 0.3), ("GelSight", 0.2), ("ViTacTip", 0.1)]);
        let words = reversed.expect("three are published");
        assert!(words.contains("in 0 of 3 pairs") && words.contains("τ −1.00"));
        // One sensor has no order, and an unpublished sensor is ignored.
        assert_eq!(order(&[study("GelSight", 0.1)]), None);
        assert_eq!(order(&[study("GelSight", 0.1), study("mine", 0.2)]), None);
    }
}
