//! Frames of a sensor: gel untouched, pressed, and their difference.

use maud::{Markup, html};

use super::data_address::address;
use crate::names::names;
use crate::results::Study;

/// Encoded frames of one sensor, equal in size and brightness scale.
#[derive(Clone, Debug)]
pub struct Triple {
    /// Index of the study in the report, from 0.
    pub study: usize,
    /// Media type: `image/png` or `image/jpeg`.
    pub media_type: &'static str,
    /// Untouched gel; `None` if the recording has no such frame.
    pub untouched: Option<Vec<u8>>,
    /// Gel during a press.
    pub pressed: Vec<u8>,
    /// Amplified difference, pressed minus untouched, around mid-grey; `None` without `untouched`.
    pub difference: Option<Vec<u8>>,
    /// Amplification of the difference; 1 without a difference.
    pub gain: f64,
    /// Description of the press: `Fz 1.8 N, Pz 0.98 mm`.
    pub words: String,
}

/// Cards of all sensors with frames, one card each; empty without frames.
pub(crate) fn cards(studies: &[Study], triples: &[Triple]) -> Markup {
    let names = names(studies);
    let known = triples
        .iter()
        .filter_map(|triple| Some((names.get(triple.study)?, triple)));
    let cards: Vec<Markup> = known.map(|(name, triple)| triple.card(name)).collect();
    html! { @if !cards.is_empty() { ul.triples { @for card in &cards { (card) } } "\n" } }
}

impl Triple {
    fn card(&self, name: &str) -> Markup {
        let gain = match self.gain {
            gain if gain > 1.0 => format!("difference × {gain:.1}"),
            _ => "difference".to_owned(),
        };
        let pictures = [
            (self.untouched.as_deref(), "untouched"),
            (Some(self.pressed.as_slice()), "pressed"),
            (self.difference.as_deref(), gain.as_str()),
        ];
        html! {
            li {
                h3 { (name) }
                div {
                    @for (bytes, word) in pictures {
                        @if let Some(bytes) = bytes {
                            figure { img alt={ (name) ", " (word) } src=(address(self.media_type, bytes)); figcaption { (word) } }
                        }
                    }
                }
                p { (self.words) }
            } "\n"
        }
    }
}
