//! The samples that are predicted worst and best, with their pictures, truth and prediction.

use std::collections::BTreeMap;

use super::Report;
use super::base64::base64;
use crate::escape::html;
use crate::figure::{Anchor, Canvas, Figure, Ink, Label, Points, Stroke, middle_cut, short};
use crate::figures::{SIX, names};
use crate::number::numeral;
use crate::results::Study;
use crate::samples::{SampleChannel, Samples};

/// Samples of each kind a study.
const EACH: usize = 6;

/// A sample that is worth a look.
#[derive(Clone, Debug, PartialEq)]
pub struct Pick {
    /// Its id.
    pub id: String,
    /// Its row among the samples.
    pub row: usize,
    /// Whether it is one of the worst, else one of the best.
    pub is_worst: bool,
    /// Its error: the mean over channels of the error as a part of the range of the true values.
    pub error: f64,
}

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

/// The six samples of a study that are predicted worst and the six that are predicted best; fewer of few, none without samples.
pub fn picks(study: &Study) -> Vec<Pick> {
    let Some(samples) = &study.samples else {
        return Vec::new();
    };
    let channels: Vec<(&SampleChannel, f64)> = samples
        .channels()
        .iter()
        .filter_map(|channel| Some((channel, range(channel)?)))
        .collect();
    let error = |row: usize| {
        let errors = channels.iter().filter_map(|(channel, range)| {
            let [truth, prediction] = channel.pair(row)?;
            Some((truth - prediction).abs() / range)
        });
        let (sum, count) =
            errors.fold((0.0, 0.0), |(sum, count), error| (sum + error, count + 1.0));
        (count > 0.0).then(|| sum / count)
    };
    let rows = samples.of_protocol("calibration");
    let mut errors: Vec<(usize, f64)> = rows
        .into_iter()
        .filter_map(|row| Some((row, error(row)?)))
        .collect();
    errors.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let each = EACH.min(errors.len() / 2);
    let pick = |is_worst: bool| {
        move |(row, error): &(usize, f64)| Pick {
            id: samples.word("id", *row).unwrap_or_default().to_owned(),
            row: *row,
            is_worst,
            error: *error,
        }
    };
    let worst = errors[..each].iter().map(pick(true));
    let best = errors[errors.len() - each..].iter().rev().map(pick(false));
    worst.chain(best).collect()
}

/// From the least to the greatest truth of those that are predicted.
fn range(channel: &SampleChannel) -> Option<f64> {
    let pairs = (0..channel.truth.len()).filter_map(|row| channel.pair(row));
    let [low, high] = crate::figure::extent(pairs.map(|[truth, _]| truth))?;
    (high > low).then_some(high - low)
}

pub(super) fn section(report: &Report<'_>) -> Option<String> {
    let pictures: BTreeMap<(usize, &str), &Picture> = report
        .pictures
        .iter()
        .map(|picture| ((picture.study, picture.id.as_str()), picture))
        .collect();
    let names = names(report.studies);
    let mut cards = String::new();
    for (at, study) in report.studies.iter().enumerate() {
        let (Some(samples), picks) = (&study.samples, picks(study)) else {
            continue;
        };
        for pick in picks {
            let picture = pictures.get(&(at, pick.id.as_str())).copied();
            cards += &card(samples, &pick, (at, &names[at]), picture);
        }
    }
    if cards.is_empty() {
        return None;
    }
    let options = names.iter().enumerate();
    let options = options.fold(String::new(), |all, (at, name)| {
        all + &format!("<option value=\"s{at}\">{}</option>", html(name))
    });
    Some(format!(
        "<p class=\"note\">Of the samples that the model has not seen, those with the greatest and the smallest error: the mean over channels of the error as a part of the range of the true values. \
         The circle shows the true place (ring) and the predicted one (dot), with the shear force as a line from each.</p>\n\
         <fieldset><legend>Show</legend><label>sensor <select data-filter=\"tag\"><option value=\"\">all</option>{options}</select></label>\
         <label>samples <select data-filter=\"tag\"><option value=\"\">worst and best</option><option value=\"worst\">worst</option><option value=\"best\">best</option></select></label></fieldset>\n\
         <ul class=\"cards\">\n{cards}</ul>"
    ))
}

fn card(
    samples: &Samples,
    pick: &Pick,
    (at, name): (usize, &str),
    picture: Option<&Picture>,
) -> String {
    let kind = if pick.is_worst { "worst" } else { "best" };
    let mut out = format!(
        "<li class=\"card\" data-tags=\"s{at} {kind}\"><h3>{}: {kind}, sample {}</h3>",
        html(&short(name, 30)),
        html(&middle_cut(&pick.id, 14))
    );
    if let Some(picture) = picture {
        out += &format!(
            "<img alt=\"picture of sample {}\" src=\"data:{};base64,{}\">",
            html(&middle_cut(&pick.id, 40)),
            picture.media_type,
            base64(&picture.bytes)
        );
    }
    out += &place(samples, pick, at);
    out += "<table><thead><tr><th scope=\"col\">channel</th><th scope=\"col\">true</th><th scope=\"col\">predicted</th></tr></thead><tbody>";
    for channel in samples.channels().iter().take(9) {
        if let Some([truth, prediction]) = channel.pair(pick.row) {
            out += &format!(
                "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>",
                html(&short(&channel.name, 16)),
                numeral(truth),
                numeral(prediction)
            );
        }
    }
    out + "</tbody></table></li>\n"
}

/// Truth and prediction seen from above, where both channels of the plane are there.
fn place(samples: &Samples, pick: &Pick, at: usize) -> String {
    let channel = |name: &str| samples.channel(name);
    let pair = |name: &str| channel(name)?.pair(pick.row);
    let (Some([true_x, predicted_x]), Some([true_y, predicted_y])) = (pair(SIX[0]), pair(SIX[1]))
    else {
        return String::new();
    };
    let reach = [SIX[0], SIX[1]]
        .into_iter()
        .filter_map(channel)
        .flat_map(|channel| channel.truth.iter().flatten());
    let predicted = predicted_x.abs().max(predicted_y.abs());
    let reach = reach.fold(predicted.max(1e-9), |most, value| most.max(value.abs()));
    let forces = [SIX[3], SIX[4]]
        .into_iter()
        .filter_map(channel)
        .flat_map(|channel| channel.truth.iter().flatten());
    let force = forces
        .fold(0.0_f64, |most, value| most.max(value.abs()))
        .max(1e-9);
    let (size, middle) = (160.0, 80.0);
    let mut canvas = Canvas::new(size, size);
    let scale = (middle - 12.0) / reach;
    let spot = |x: f64, y: f64| [middle + x * scale, middle - y * scale];
    let ring = (0..=48).map(|step| {
        let angle = f64::from(step) * std::f64::consts::TAU / 48.0;
        spot(reach * angle.cos(), reach * angle.sin())
    });
    canvas.path(ring.collect(), Stroke::thin(Ink::Muted));
    let shear = [pair(SIX[3]), pair(SIX[4])];
    let ends = [spot(true_x, true_y), spot(predicted_x, predicted_y)];
    for (which, (from, ink)) in ends.iter().zip([Ink::Text, Ink::Series(at)]).enumerate() {
        if let [Some(x), Some(y)] = shear {
            let to = [
                from[0] + x[which] / force * 34.0,
                from[1] - y[which] / force * 34.0,
            ];
            canvas.line(
                *from,
                to,
                Stroke {
                    ink,
                    width: 2.0,
                    dash: "",
                },
            );
        }
    }
    let circle = (0..=24).map(|step| {
        let angle = f64::from(step) * std::f64::consts::TAU / 24.0;
        [
            ends[0][0] + 6.0 * angle.cos(),
            ends[0][1] + 6.0 * angle.sin(),
        ]
    });
    canvas.path(
        circle.collect(),
        Stroke {
            ink: Ink::Text,
            width: 1.8,
            dash: "",
        },
    );
    let dot = Points {
        at: vec![ends[1]],
        words: Vec::new(),
    };
    canvas.points(dot, Ink::Series(at), 4.0, 1.0);
    canvas.label(Label::new(
        [size - 2.0, size - 3.0],
        format!("± {} mm", numeral(reach)),
        Anchor::End,
    ));
    let figure = Figure {
        id: format!("place-{at}-{}", pick.row),
        title: "True and predicted place".to_owned(),
        caption: String::new(),
        description: format!(
            "True place ({}, {}) mm, predicted ({}, {}) mm.",
            numeral(true_x),
            numeral(true_y),
            numeral(predicted_x),
            numeral(predicted_y)
        ),
        canvas,
    };
    figure.inline()
}
