//! Figures 8a to 8c of the TacEva study: radar charts of its quantities, averaged over positions and forces. A mark identifies values at or below
//! their noise floor.

use taceva_metrics::{Better, Standing};

use super::radar::{Spoke, draw_spokes};
use crate::figure::Figure;
use crate::names::listed;
use crate::results::Study;

/// A quantity of the TacEva study: the mean of a metric over channels.
struct Quantity {
    name: &'static str,
    metric: &'static str,
    channels: &'static [&'static str],
    better: Better,
}

const POSITION: &[&str] = &["Pxy", "Pz"];
const FORCE: &[&str] = &["Fxy", "Fz"];

const fn low(
    name: &'static str,
    metric: &'static str,
    channels: &'static [&'static str],
) -> Quantity {
    Quantity {
        name,
        metric,
        channels,
        better: Better::Lower,
    }
}

const fn high(
    name: &'static str,
    metric: &'static str,
    channels: &'static [&'static str],
) -> Quantity {
    Quantity {
        better: Better::Higher,
        ..low(name, metric, channels)
    }
}

pub(super) fn accuracy(studies: &[Study]) -> Option<Figure> {
    let quantities = [
        low("MAE position", "mae", POSITION),
        low("MAE force", "mae", FORCE),
        high("R² position", "r2", POSITION),
        high("R² force", "r2", FORCE),
        high("SR lines", "sr", &["line"]),
        high("SR dots", "sr", &["dot"]),
    ];
    draw(studies, &quantities, "Figure 8a: accuracy")
}

pub(super) fn intrinsic(studies: &[Study]) -> Option<Figure> {
    let quantities = [
        high("sensitivity S", "sensitivity", &["Fz"]),
        high("uniformity U", "uniformity", &["Fz"]),
        high("field of view", "intrinsic", &["field_of_view"]),
        high("frame rate", "intrinsic", &["frame_rate"]),
    ];
    draw(studies, &quantities, "Figure 8b: the sensors")
}

pub(super) fn robustness(studies: &[Study]) -> Option<Figure> {
    let quantities = [
        low("spatial position", "r_spatial", POSITION),
        low("spatial force", "r_spatial", FORCE),
        high("lighting position", "r_light", POSITION),
        high("lighting force", "r_light", FORCE),
        low("repeatability position", "repeatability", POSITION),
        low("repeatability force", "repeatability", FORCE),
        low("hysteresis area", "hysteresis", &["Fz"]),
    ];
    draw(studies, &quantities, "Figure 8c: robustness")
}

fn draw(studies: &[Study], quantities: &[Quantity], title: &str) -> Option<Figure> {
    if studies.len() < 2 {
        return None;
    }
    let names = crate::names::names(studies);
    let spokes: Vec<Spoke> = quantities.iter().map(|of| of.spoke(studies)).collect();
    let floor = quantities.iter().flat_map(|quantity| {
        let named = names.iter().zip(studies);
        let named = named.filter(|(_, study)| quantity.is_at_floor(study));
        named.map(|(name, _)| format!("{} of {name}", quantity.name))
    });
    let floor: Vec<String> = floor.collect();
    let floor = match floor.is_empty() {
        true => String::new(),
        false => format!(
            " † Not above chance, so that it supports no claim: {}.",
            listed(&floor)
        ),
    };
    let caption = format!(
        "The quantities that the study prints, even if they support no claim. Positions are the mean of Pxy and Pz, forces that of Fxy and Fz. Each axis shows a share of the best sensor: value / best if more is better (↑), best / value if less is better (↓).{floor}"
    );
    draw_spokes(studies, &spokes, title, caption)
}

impl Quantity {
    /// Mean over the channels; `None` unless each channel has a value.
    fn value(&self, study: &Study) -> Option<f64> {
        let values = self.channels.iter().map(|channel| {
            let score = study.score(self.metric, channel)?;
            score.value.number()
        });
        let values: Option<Vec<f64>> = values.collect();
        let values = values.filter(|values| !values.is_empty())?;
        let count = values.iter().fold(0.0, |count, _| count + 1.0);
        Some(values.iter().sum::<f64>() / count)
    }

    /// True if the score of a channel is at or below its noise floor.
    fn is_at_floor(&self, study: &Study) -> bool {
        let mut channels = self.channels.iter();
        channels.any(|channel| {
            let score = study.score(self.metric, channel);
            score.is_some_and(|score| score.standing == Standing::NotAboveNoiseFloor)
        })
    }

    fn spoke(&self, studies: &[Study]) -> Spoke {
        let mark = match studies.iter().any(|study| self.is_at_floor(study)) {
            true => "†",
            false => "",
        };
        Spoke {
            name: format!("{}{mark}", self.name),
            better: self.better,
            values: studies.iter().map(|study| self.value(study)).collect(),
        }
    }
}
