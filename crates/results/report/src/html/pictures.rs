//! Worst and best predicted samples, with frame, truth and prediction.

use std::collections::BTreeMap;

use maud::{Markup, html};

use super::ReportPage;
use super::data_address::address;
use super::picks::{Pick, picks};
use super::place::Place;
use crate::figure::{middle_cut, short};
use crate::markup::{filter, heads};
use crate::names::names;
use crate::number::{numeral, spaced};
use taceva_results::Samples;

/// Frame of a sample.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Index of the study in the report, from 0.
    pub study: usize,
    /// Sample id.
    pub id: String,
    /// Media type: `image/png` or `image/jpeg`.
    pub media_type: &'static str,
    /// Encoded image.
    pub bytes: Vec<u8>,
}

/// Number of selected samples, and their section with one card each; `None` without samples.
pub(super) fn section(report: &ReportPage<'_>) -> Option<(usize, Markup)> {
    let pictures: BTreeMap<(usize, &str), &Picture> = report
        .pictures
        .iter()
        .map(|picture| ((picture.study, picture.id.as_str()), picture))
        .collect();
    let names = names(report.studies);
    let mut cards: Vec<Markup> = Vec::new();
    for (at, study) in report.studies.iter().enumerate() {
        let (Some(samples), picks) = (&study.samples, picks(study)) else {
            continue;
        };
        let place = Place::of(samples, &picks, at);
        cards.extend(picks.iter().map(|pick| {
            let picture = pictures.get(&(at, pick.id.as_str())).copied();
            card(samples, pick, at, &names[at], picture, place.as_ref())
        }));
    }
    let mut samples = report
        .studies
        .iter()
        .filter_map(|study| study.samples.as_ref());
    let apart = match samples.any(|samples| samples.has(Samples::GROUP)) {
        true => "group of the split",
        false => "contact point",
    };
    let sensors = names.iter().enumerate();
    let sensors = sensors.map(|(at, name)| (format!("s{at}"), name));
    let body = html! {
        p.note {
            "The samples with the greatest and the smallest error among those that the model has not seen, each of a different "
            (apart) ". The error is the mean over channels of |true − predicted| divided by the range of the true values. "
            "Ring: true place. Dot: predicted place. Lines: shear forces. The circle is the same for all samples of a sensor."
        } "\n"
        fieldset {
            legend { "Show" } (filter("sensor", "all", sensors))
            (filter("samples", "worst and best", ["worst", "best"].map(|kind| (kind, kind))))
        } "\n"
        p.note { "A great error may also mean that the picture and the labels of a sample do not belong together: " code { "taceva check" } "." } "\n"
        ul.cards { @for card in &cards { (card) } }
    };
    (!cards.is_empty()).then_some((cards.len(), body))
}

fn card(
    samples: &Samples,
    pick: &Pick,
    at: usize,
    name: &str,
    picture: Option<&Picture>,
    place: Option<&Place>,
) -> Markup {
    let kind = if pick.is_worst { "worst" } else { "best" };
    html! {
        li.card data-tags={ "s" (at) " " (kind) } {
            h3 { (short(name, 30)) ": " (kind) }
            p.error { "error " (numeral(pick.error * 100.0)) " % of the range" }
            p {
                "sample " (middle_cut(&pick.id, 14))
                @if let Some(group) = samples.word(Samples::GROUP, pick.row) { ", group " (middle_cut(group, 10)) }
                @if let Some(point) = samples.word("point_id", pick.row) { ", point " (middle_cut(point, 10)) }
            }
            @if let Some(picture) = picture {
                img alt={ "picture of sample " (middle_cut(&pick.id, 40)) } src=(address(picture.media_type, &picture.bytes));
            }
            @if let Some(place) = place { (place.draw(samples, pick)) }
            table {
                thead { tr { (heads(["channel", "true", "predicted", "error"])) } }
                tbody {
                    @for channel in samples.channels().iter().take(9) {
                        @if let Some([truth, prediction]) = channel.pair(pick.row) {
                            tr {
                                th scope="row" { (short(channel.name, 16)) (spaced(channel.unit())) }
                                td { (numeral(truth)) } td { (numeral(prediction)) } td { (numeral(truth - prediction)) }
                            }
                        }
                    }
                }
            }
        } "\n"
    }
}
