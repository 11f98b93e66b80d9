//! A map for a recording: its draft, with open places filled in by answers.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_dataset::DatasetError;
use taceva_dataset::internal::quoted;
use taceva_import::{ImportError, ImportMap, MapDraft};

use super::{Interview, finish, target};
use crate::args::InitTarget;

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
    let import = format!("taceva import {} --map {}", quoted(folder), quoted(&path));
    let mut next = remarks(&text, &quoted(&path));
    next.push(format!("{import} --explain"));
    next.push(format!("{import} --out my-dataset"));
    next.push("taceva evaluate my-dataset".to_owned());
    finish(&path, &text, &next)
}

/// `line` without its comment; a `#` within quotes begins none.
fn code(line: &str) -> &str {
    let mut is_quoted = false;
    let end = line.char_indices().find(|(_, letter)| {
        is_quoted ^= *letter == '"';
        *letter == '#' && !is_quoted
    });
    end.map_or(line, |(at, _)| &line[..at])
}

/// Sections of a map that hold labels.
const LABELS: [&str; 3] = ["[columns]", "[classes]", "[[matrix]]"];

/// Steps by hand before an import of `map`, which is written to `path`: open places, guesses, labels and contact points.
fn remarks(map: &str, path: &str) -> Vec<String> {
    let lines = || {
        map.lines()
            .filter(|line| !line.trim_start().starts_with('#'))
    };
    let open: usize = lines().map(|line| code(line).matches(OPEN).count()).sum();
    let guesses = lines().filter(|line| line.contains("a guess")).count();
    let mut remarks = Vec::new();
    match open {
        0 => {}
        1 => remarks.push(format!("fill in the place {OPEN} of {path}")),
        _ => remarks.push(format!("fill in the {open} places {OPEN} of {path}")),
    }
    match guesses {
        0 => {}
        1 => remarks.push(format!("check the line with \"a guess\" in {path}")),
        _ => remarks.push(format!(
            "check the {guesses} lines with \"a guess\" in {path}"
        )),
    }
    let mut section = "";
    let has_labels = lines().any(|line| {
        if line.starts_with('[') {
            section = line.trim_end();
            return false;
        }
        LABELS.contains(&section) && !line.trim().is_empty()
    });
    if !has_labels {
        remarks.push(format!(
            "name the labels, of which none was found: under [columns] of {path} write a line such as Fz = {{ from = \"COLUMN\", unit = \"N\" }}"
        ));
    }
    if !lines().any(|line| line.starts_with("point_id")) {
        remarks.push(format!(
            "name the contact points, on which intervals depend: under [ids] of {path} write point_id = \"COLUMN\", a column with one value for each contact"
        ));
    }
    remarks
}

/// `draft` with an answer in each open place of a line that is no comment. With `--yes` places stay open.
fn filled(draft: &str, path: &Path, interview: &mut Interview) -> anyhow::Result<String> {
    if interview.takes_defaults() {
        return Ok(draft.to_owned());
    }
    let mut lines: Vec<String> = draft.lines().map(str::to_owned).collect();
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
        Err(ImportError::Dataset(DatasetError::Text { place, problem }))
            if place.line == Some(at as u64 + 1) =>
        {
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
        let code = code(line);
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
            ("cut", _) => {
                "keep, to read the messages before the cut of the recording, or refuse".to_owned()
            }
            (key, Some(subject)) => format!("{key} of {subject}"),
            (key, None) => key.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Place, remarks};

    #[test]
    fn remarks_count_lines_of_the_map_and_no_comments() {
        let map = "# Replace every \"?\": lines with \"a guess\" may be wrong.\n[columns]\nFz = { from = \"f\", unit = \"?\" }   # a guess\n";
        let contacts = "name the contact points, on which intervals depend: under [ids] of m.toml write point_id = \"COLUMN\", a column with one value for each contact";
        assert_eq!(
            remarks(map, "m.toml"),
            [
                "fill in the place \"?\" of m.toml",
                "check the line with \"a guess\" in m.toml",
                contacts,
            ]
        );
        let twice = map.replace("from = \"f\"", "from = \"?\"");
        assert_eq!(
            remarks(&twice, "m.toml")[0],
            "fill in the 2 places \"?\" of m.toml"
        );
        let bare =
            "[columns]\n# No channels: a, b\n[frame]\ncolumn = \"file\"\n[ids]\npoint_id = \"p\"\n";
        let said = remarks(bare, "m.toml");
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].starts_with("name the labels, of which none was found"),
            "{said:?}"
        );
    }

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
        let cut = question("table = { file = \"a.bag\", cut = \"?\", rows = \"/ft\" }   # 8 rows");
        assert!(cut.is_some_and(|cut| cut.starts_with("keep, to read")));
        assert_eq!(
            question("# Replace every \"?\": an import refuses it"),
            None
        );
        assert_eq!(question("clock = \"unknown\""), None);
    }
}
