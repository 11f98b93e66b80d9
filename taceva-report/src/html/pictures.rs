//! The samples that are predicted worst and best, with their pictures, truth and prediction.

use std::collections::BTreeMap;

use super::Report;
use super::base64::base64;
use super::picks::{Pick, picks};
use super::place::Place;
use crate::escape::html;
use crate::figure::{middle_cut, short};
use crate::figures::names;
use crate::number::{numeral, spaced};
use crate::samples::Samples;

/// The picture of a sample.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The position of its study.
    pub study: usize,
    /// The id of the sample.
    pub id: String,
    /// What the bytes are: `image/png` or `image/jpeg`.
    pub media_type: &'static str,
    /// The encoded picture.
    pub bytes: Vec<u8>,
}

/// A card a sample, and how many there are.
pub(super) fn section(report: &Report<'_>) -> Option<(usize, String)> {
    let pictures: BTreeMap<(usize, &str), &Picture> = report
        .pictures
        .iter()
        .map(|picture| ((picture.study, picture.id.as_str()), picture))
        .collect();
    let names = names(report.studies);
    let (mut count, mut cards) = (0, String::new());
    for (at, study) in report.studies.iter().enumerate() {
        let (Some(samples), picks) = (&study.samples, picks(study)) else {
            continue;
        };
        let place = Place::of(samples, &picks, at);
        count += picks.len();
        for pick in picks {
            let picture = pictures.get(&(at, pick.id.as_str())).copied();
            cards += &card(samples, &pick, (at, &names[at]), (picture, place.as_ref()));
        }
    }
    if cards.is_empty() {
        return None;
    }
    let options = names.iter().enumerate();
    let options = options.fold(String::new(), |all, (at, name)| {
        all + &format!("<option value=\"s{at}\">{}</option>", html(name))
    });
    let body = format!(
        "<p class=\"note\">Of the samples that the model has not seen, those with the greatest and the smallest error, each of another contact point. The error is the mean over channels of |true − predicted| as a part of the range of the true values. \
         The circle is the same for all samples of a sensor; in it the true place (ring) and the predicted one (dot), with the shear force as a line from each.</p>\n\
         <fieldset><legend>Show</legend><label>sensor <select data-filter=\"tag\"><option value=\"\">all</option>{options}</select></label>\
         <label>samples <select data-filter=\"tag\"><option value=\"\">worst and best</option><option value=\"worst\">worst</option><option value=\"best\">best</option></select></label></fieldset>\n\
         <ul class=\"cards\">\n{cards}</ul>"
    );
    Some((count, body))
}

fn card(
    samples: &Samples,
    pick: &Pick,
    (at, name): (usize, &str),
    (picture, place): (Option<&Picture>, Option<&Place>),
) -> String {
    let kind = if pick.is_worst { "worst" } else { "best" };
    let point = samples.word("point_id", pick.row);
    let point = point.map_or_else(String::new, |point| {
        format!(", point {}", middle_cut(point, 10))
    });
    let mut out = format!(
        "<li class=\"card\" data-tags=\"s{at} {kind}\"><h3>{}: {kind}</h3><p class=\"error\">error {} % of the range</p><p>sample {}{}</p>",
        html(&short(name, 30)),
        numeral(pick.error * 100.0),
        html(&middle_cut(&pick.id, 14)),
        html(&point)
    );
    if let Some(picture) = picture {
        out += &format!(
            "<img alt=\"picture of sample {}\" src=\"data:{};base64,{}\">",
            html(&middle_cut(&pick.id, 40)),
            picture.media_type,
            base64(&picture.bytes)
        );
    }
    out += &place.map_or_else(String::new, |place| place.draw(samples, pick));
    out += "<table><thead><tr><th scope=\"col\">channel</th><th scope=\"col\">true</th><th scope=\"col\">predicted</th><th scope=\"col\">error</th></tr></thead><tbody>";
    for channel in samples.channels().iter().take(9) {
        if let Some([truth, prediction]) = channel.pair(pick.row) {
            out += &format!(
                "<tr><th scope=\"row\">{}{}</th><td>{}</td><td>{}</td><td>{}</td></tr>",
                html(&short(&channel.name, 16)),
                spaced(channel.unit()),
                numeral(truth),
                numeral(prediction),
                numeral(truth - prediction)
            );
        }
    }
    out + "</tbody></table></li>\n"
}
