//! Sentences of the methods paragraph on the devices of measured recordings.

use crate::devices::devices;
use crate::names::{listed, names};
use crate::results::Study;

/// Sentences on the devices of measured recordings. Studies with the same devices share a sentence.
pub(super) fn equipment(studies: &[Study]) -> String {
    let mut shared: Vec<(String, Vec<String>)> = Vec::new();
    for (study, name) in studies.iter().zip(names(studies)) {
        let devices = devices(study).into_iter().map(|device| {
            let facts = device.facts.iter().map(|fact| fact.words.as_str());
            let facts: Vec<&str> = facts.collect();
            let (kind, facts) = (device.kind, facts.join("; "));
            format!("the {} ({facts}) {}", kind.name, kind.work)
        });
        let text = devices.collect::<Vec<_>>().join("; ");
        match shared.iter_mut().find(|(known, _)| *known == text) {
            _ if text.is_empty() => {}
            Some((_, of)) => of.push(name),
            None => shared.push((text, vec![name])),
        }
    }
    let sentence = |(text, of): (String, Vec<String>)| match of.len() == studies.len() {
        true => format!(" Devices: {text}."),
        false => format!(" Devices of {}: {text}.", listed(&of)),
    };
    shared.into_iter().map(sentence).collect()
}
