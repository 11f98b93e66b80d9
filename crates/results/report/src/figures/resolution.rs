//! Success rate of gratings over the tolerance.

use taceva_core::Unit;

use crate::figure::{Figure, directed};
use crate::results::Study;
use taceva_results::Value;

use super::levels::levels;
use super::overlay::{Line, Sheet, Ways, Words, draw as overlay};

pub(super) fn draw(studies: &[Study], room: Option<f64>) -> Option<Figure> {
    let mut sheets = Vec::new();
    for (kind, title) in [("line", "Lines"), ("dot", "Dots")] {
        let mut lines = Vec::new();
        for (study, at) in studies.iter().zip(0..) {
            let variant = study
                .score("sr", kind)
                .and_then(|score| score.variant("curve"));
            if let Some(Value::Curve(curve)) = variant.map(|variant| &variant.value) {
                lines.push(Line {
                    study: at,
                    levels: levels(curve),
                });
            }
        }
        if !lines.is_empty() {
            sheets.push(Sheet {
                title: title.to_owned(),
                x: "tolerance ε (mm)".to_owned(),
                y: directed("share within ε", "sr"),
                y_unit: Unit::One,
                least: Some([0.0, 1.0]),
                ways: Ways::Straight,
                lines,
            });
        }
    }
    let words = Words {
        id: "resolution",
        title: "Spatial resolution: SR(ε)",
        caption:
            "Share of presses of gratings whose spacing is predicted to within ε; at 0 exactly."
                .to_owned(),
        description: format!(
            "Success rate over tolerance for gratings of lines and dots of {}.",
            crate::names::all(studies)
        ),
    };
    overlay(&sheets, studies, 2, words, room)
}
