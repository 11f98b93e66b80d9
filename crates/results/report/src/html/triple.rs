//! What a sensor sees: its gel untouched, pressed, and what is different.

use maud::{Markup, html};

use super::data_address::address;
use crate::names::names;
use crate::results::Study;

/// Pictures of one sensor, encoded, all of the same size and in the same scale of brightness.
#[derive(Clone, Debug)]
pub struct Triple {
    /// The position of its study.
    pub study: usize,
    /// What the bytes are: `image/png` or `image/jpeg`.
    pub media_type: &'static str,
    /// The gel that nothing touches; absent where the recording has no picture of it.
    pub untouched: Option<Vec<u8>>,
    /// The gel under a press.
    pub pressed: Vec<u8>,
    /// Pressed less untouched, enlarged, around mid-grey; absent where `untouched` is.
    pub difference: Option<Vec<u8>>,
    /// How many times the difference is enlarged; 1 without one.
    pub gain: f64,
    /// Which press it is: `Fz 1.8 N, Pz 0.98 mm`.
    pub words: String,
}

/// A card a sensor that has pictures; nothing without any.
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
