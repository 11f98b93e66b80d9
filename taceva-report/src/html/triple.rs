//! What a sensor sees: its gel untouched, pressed, and what is different.

use super::base64::base64;
use crate::escape::html;
use crate::figures::names;
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
pub(crate) fn cards(studies: &[Study], triples: &[Triple]) -> String {
    let names = names(studies);
    let known = triples
        .iter()
        .filter_map(|triple| Some((names.get(triple.study)?, triple)));
    let cards: String = known.map(|(name, triple)| triple.card(name)).collect();
    match cards.is_empty() {
        true => String::new(),
        false => format!("<ul class=\"triples\">\n{cards}</ul>\n"),
    }
}

impl Triple {
    fn card(&self, name: &str) -> String {
        let name = html(name);
        let gain = match self.gain {
            gain if gain > 1.0 => format!("difference × {gain:.1}"),
            _ => "difference".to_owned(),
        };
        let pictures = [
            (self.untouched.as_deref(), "untouched"),
            (Some(self.pressed.as_slice()), "pressed"),
            (self.difference.as_deref(), gain.as_str()),
        ];
        let pictures = pictures.into_iter().filter_map(|(bytes, word)| {
            Some(format!(
                "<figure><img alt=\"{name}, {word}\" src=\"data:{};base64,{}\"><figcaption>{word}</figcaption></figure>",
                self.media_type,
                base64(bytes?)
            ))
        });
        format!(
            "<li><h3>{name}</h3><div>{}</div><p>{}</p></li>\n",
            pictures.collect::<String>(),
            html(&self.words)
        )
    }
}
