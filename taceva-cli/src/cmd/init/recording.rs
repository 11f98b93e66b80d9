//! A map for a recording: its draft, with open places filled in by answers.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::shown;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::quoted;
use taceva_import::{ImportMap, MapDraft};

use super::{Interview, finish, target};
use crate::args::InitTarget;
use crate::stderr;

/// A place that a draft leaves open.
const OPEN: &str = "\"?\"";

pub(super) fn write(
    folder: &Path,
    args: &InitTarget,
    interview: &mut Interview,
) -> anyhow::Result<u8> {
    let path = target(args, "map.toml")?;
    let draft = MapDraft::of(folder)?;
    let text = filled(draft.text(), &path, interview)?;
    let open = text.matches(OPEN).count();
    let import = format!("taceva import {} --map {}", quoted(folder), quoted(&path));
    let mut next = Vec::new();
    if open > 0 {
        next.push(format!(
            "fill in the {open} places {OPEN} of {}",
            quoted(&path)
        ));
    }
    next.push(format!("{import} --explain"));
    next.push(format!("{import} --out my-dataset"));
    next.push("taceva evaluate my-dataset".to_owned());
    finish(&path, &text, &next)
}

/// `draft` with an answer in each open place of a line that is no comment. With `--yes` places stay open.
fn filled(draft: &str, path: &Path, interview: &mut Interview) -> anyhow::Result<String> {
    if interview.takes_defaults() {
        return Ok(draft.to_owned());
    }
    let mut lines: Vec<String> = draft.lines().map(str::to_owned).collect();
    let guesses = lines.iter().filter(|line| line.contains("a guess")).count();
    if guesses > 0 {
        stderr::write(&format!(
            "{guesses} lines are guesses: read them in {} before you import\n",
            shown(path)
        ));
    }
    let mut earlier: BTreeMap<String, String> = BTreeMap::new();
    for at in 0..lines.len() {
        while let Some(place) = Place::of(&lines[at]) {
            interview.say(&format!("line {}: {}", at + 1, lines[at].trim()));
            let default = earlier.get(&place.kind).cloned();
            let default = default.or_else(|| (place.key == "model").then(|| "unknown".to_owned()));
            let put = |answer: &str| {
                let line = &lines[at];
                format!(
                    "{}{answer:?}{}",
                    &line[..place.at],
                    &line[place.at + OPEN.len()..]
                )
            };
            let check = |answer: &str| {
                let mut tried = lines.clone();
                tried[at] = put(answer);
                refusal(path, &tried.join("\n"), at).map_or(Ok(()), Err)
            };
            let answer = interview.ask(&place.question(), default.as_deref(), check)?;
            lines[at] = put(&answer);
            earlier.insert(place.kind, answer);
        }
    }
    Ok(lines.join("\n") + "\n")
}

/// The reason why an import would refuse line `at` of a map, if it would.
fn refusal(path: &Path, text: &str, at: usize) -> Option<String> {
    match ImportMap::parse(path, text) {
        Err(DatasetError::Toml { place, problem }) if place.line == Some(at as u64 + 1) => {
            // Another place of the same line may still be open.
            (!problem.contains('?')).then_some(problem)
        }
        _ => None,
    }
}

/// An open place of a line: `key = "?"`.
struct Place {
    /// The byte at which it begins.
    at: usize,
    key: String,
    /// The channel or the column at the beginning of the line.
    subject: Option<String>,
    /// Places of one kind likely have one answer: units of forces, units of torques.
    kind: String,
}

impl Place {
    fn of(line: &str) -> Option<Place> {
        let code = line.split('#').next()?;
        let at = code.find(OPEN)?;
        let key = code[..at].trim_end().strip_suffix('=')?.trim_end();
        let key = key.rsplit([' ', '{', ',']).next()?.to_owned();
        let first = code.split('=').next()?.trim().to_owned();
        let subject = (first != key).then_some(first);
        let family = subject.as_deref().and_then(|subject| subject.get(..1));
        let kind = format!("{key} of {}", family.unwrap_or("the recording"));
        Some(Place {
            at,
            key,
            subject,
            kind,
        })
    }

    fn question(&self) -> String {
        let subject = self.subject.as_deref();
        match (self.key.as_str(), subject) {
            ("unit", Some(subject)) => format!("unit of {subject}, such as N, mN, gf, mm or um"),
            ("unit", None) => "unit of these times, such as s, ms, us or ns".to_owned(),
            ("from", Some(subject)) => format!("column that holds {subject}"),
            ("model", None) => "name of the sensor".to_owned(),
            (key, Some(subject)) => format!("{key} of {subject}"),
            (key, None) => key.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Place;

    #[test]
    fn an_open_place_says_its_key_and_its_channel() {
        let question = |line: &str| Place::of(line).map(|place| place.question());
        let unit = question("Fx = { from = \"ft[0]\", unit = \"?\" }   # a guess");
        assert_eq!(
            unit.as_deref(),
            Some("unit of Fx, such as N, mN, gf, mm or um")
        );
        let from = question("Fz = { from = \"?\", unit = \"?\" }   # a, b match equally");
        assert_eq!(from.as_deref(), Some("column that holds Fz"));
        assert_eq!(
            question("model = \"?\"").as_deref(),
            Some("name of the sensor")
        );
        assert_eq!(
            question("# Replace every \"?\": an import refuses it"),
            None
        );
        assert_eq!(question("clock = \"unknown\""), None);
    }
}
