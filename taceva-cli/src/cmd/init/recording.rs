//! Map for a recording: a draft whose open places are filled in by answers.

use std::collections::BTreeMap;
use std::path::Path;

use taceva_dataset::DatasetError;
use taceva_dataset::internal::quoted;
use taceva_import::internal::{OPEN, code, open_places};
use taceva_import::{ImportError, ImportMap, MapDraft, UnpackedArchive};

use super::{Interview, finish, target};
use crate::args::InitTarget;
use crate::cmd::Usage;
use crate::cmd::import::folder_of;
use crate::output;

pub(super) fn write(
    source: &Path,
    args: &InitTarget,
    interview: &mut Interview,
) -> anyhow::Result<u8> {
    let path = target(args, "map.toml")?;
    if UnpackedArchive::is_archive(source) {
        return Err(Usage::error(format!(
            "{0} is an archive: `taceva import {0} --draft --out {1}` writes its map",
            quoted(source),
            quoted(&path)
        )));
    }
    let draft = MapDraft::of(source)?;
    let mut lines: Vec<String> = draft.text().lines().map(str::to_owned).collect();
    let answered = fill(&mut lines, &path, interview);
    let text = lines.join("\n") + "\n";
    if let Err(error) = answered {
        if text != draft.text() {
            output::write(Some(&path), |out| out.write_all(text.as_bytes()))?;
            interview.say(&format!(
                "{} has the answers so far: fill in the rest there, or begin again with --force",
                quoted(&path)
            ));
        }
        return Err(error);
    }
    let folder = quoted(folder_of(source));
    let import = format!("taceva import {folder} --map {}", quoted(&path));
    let mut next = remarks(&text, &quoted(&path));
    next.push(format!("{import} --explain"));
    next.push(format!("{import} --out my-dataset"));
    next.push("taceva check my-dataset".to_owned());
    next.push(match has_labels(&text) {
        true => "taceva evaluate my-dataset".to_owned(),
        false => "taceva predict my-dataset --with MODEL --out predictions.csv".to_owned(),
    });
    finish(&path, &text, &next)
}

/// Sections of a map that contain labels.
const LABELS: [&str; 3] = ["[columns]", "[classes]", "[[matrix]]"];

/// Beginning of the draft's comment on pictures that no row names.
const NOT_JOINED: &str = "# No pictures match the rows of the table. ";

/// Beginning of the draft's comment on columns that are not channels.
const NO_CHANNELS: &str = "# No channels: ";

/// Lines of `map` other than comments.
fn live(map: &str) -> impl Iterator<Item = &str> {
    let lines = map.lines();
    lines.filter(|line| !line.trim_start().starts_with('#'))
}

/// True if a section of `map` has labels.
fn has_labels(map: &str) -> bool {
    let mut section = "";
    live(map).any(|line| {
        if line.starts_with('[') {
            section = line.trim_end();
            return false;
        }
        LABELS.contains(&section) && !line.trim().is_empty()
    })
}

/// Manual steps before an import with `map`, which is written to `path`. They concern pictures, open places, guesses, labels and contacts.
fn remarks(map: &str, path: &str) -> Vec<String> {
    let guesses = live(map).filter(|line| line.contains("a guess")).count();
    let mut remarks = Vec::new();
    if let Some(found) = map.lines().find_map(|line| line.strip_prefix(NOT_JOINED)) {
        remarks.push(format!("no row of {path} has a picture. {found}"));
    }
    match open_places(map) {
        0 => {}
        1 => remarks.push(format!("fill in the place {OPEN} of {path}")),
        open => remarks.push(format!("fill in the {open} places {OPEN} of {path}")),
    }
    match guesses {
        0 => {}
        1 => remarks.push(format!("check the line with \"a guess\" in {path}")),
        _ => remarks.push(format!(
            "check the {guesses} lines with \"a guess\" in {path}"
        )),
    }
    if !has_labels(map) {
        remarks.push(format!(
            "name the labels (the draft found none): under [columns] of {path} write a line such as Fz = {{ from = \"COLUMN\", unit = \"N\" }}"
        ));
    }
    if !live(map).any(|line| line.starts_with("point_id")) {
        let offered = map.lines();
        let offered = offered.filter_map(|line| line.strip_prefix("# point_id = "));
        let offered: Vec<&str> = offered.map(|line| code(line).trim_end()).collect();
        let offered = match offered.is_empty() {
            true => String::new(),
            false => format!(" (the draft offers {})", offered.join(" and ")),
        };
        remarks.push(format!(
            "if several rows show one contact, such as the frames of a grasp or the repeats of a press, name the contacts: under [ids] of \
             {path} write point_id = \"COLUMN\"{offered}. Intervals then count contacts, and no contact is in both the training and the test part"
        ));
    }
    remarks
}

/// Reason why a draft excludes `column` from the channels; `None` if `column` is not in `excluded`.
fn reason_against<'e>(excluded: &'e str, column: &str) -> Option<&'e str> {
    let named = format!("{column} (");
    let mut places = excluded.match_indices(named.as_str());
    let (at, _) = places.find(|(at, _)| *at == 0 || excluded[..*at].ends_with(", "))?;
    excluded[at + named.len()..].split(')').next()
}

/// Replaces the comment of `line` by the remark that the user named the value. `why` is a reason against the value.
fn named(line: &str, why: Option<&str>) -> String {
    let code = code(line).trim_end();
    match why {
        None if code == line.trim_end() => line.to_owned(),
        None => format!("{code}   # named by you"),
        Some(why) => format!("{code}   # named by you, though {why}"),
    }
}

/// Answer that leaves a channel out of the map.
const LEFT_OUT: &str = "none";

/// Fills each open place of the draft with an answer, except in comments. With `--yes`, places without a default remain open.
///
/// # Errors
/// The errors of [`Interview::ask`]; `lines` contain the earlier answers.
fn fill(lines: &mut [String], path: &Path, interview: &mut Interview) -> anyhow::Result<()> {
    if interview.takes_defaults() {
        for line in lines {
            if line == "model = \"?\"" {
                "model = \"unknown\"".clone_into(line);
            }
        }
        return Ok(());
    }
    let excluded = lines.iter().find_map(|line| line.strip_prefix(NO_CHANNELS));
    let excluded = excluded.unwrap_or_default().to_owned();
    let mut earlier: BTreeMap<String, String> = BTreeMap::new();
    for at in 0..lines.len() {
        while let Some(place) = Place::of(&lines[at]) {
            interview.say(&format!("line {}: {}", at + 1, explained(&lines[at..])));
            let is_channel = place.is_channel();
            let default = match (is_channel, place.key.as_str()) {
                (true, _) => Some(LEFT_OUT.to_owned()),
                (false, "model") => Some("unknown".to_owned()),
                (false, _) => earlier.get(&place.kind).cloned(),
            };
            let put = |answer: &str| {
                let line = &lines[at];
                format!(
                    "{}{answer:?}{}",
                    &line[..place.at],
                    &line[place.at + OPEN.len()..]
                )
            };
            let check = |answer: &str| {
                let mut tried = lines.to_vec();
                tried[at] = put(answer);
                refusal(path, &tried.join("\n"), at).map_or(Ok(()), Err)
            };
            let answer = interview.ask(&place.question(), default.as_deref(), check)?;
            if is_channel && answer == LEFT_OUT {
                lines[at] = format!("# Left out: {}", lines[at]);
                continue;
            }
            lines[at] = put(&answer);
            let why = reason_against(&excluded, &answer).filter(|_| is_channel);
            if let Some(why) = why {
                interview.say(&format!(
                    "the draft does not treat {answer:?} as a channel: {why}"
                ));
            }
            // The comment explained why the place was open.
            if is_channel || place.subject.is_none() {
                lines[at] = named(&lines[at], why);
            }
            earlier.insert(place.kind, answer);
        }
    }
    Ok(())
}

/// The first of `lines`, with the following comment lines that continue its comment.
fn explained(lines: &[String]) -> String {
    let is_more = |line: &&String| line.starts_with("# ") && !line.starts_with("# or: ");
    let more = lines.iter().skip(1).take_while(is_more);
    let first = lines.first().into_iter();
    let all: Vec<&str> = first.chain(more).map(|line| line.trim()).collect();
    all.join("\n")
}

/// Reason why an import would reject line `at` of a map; `None` if the line is valid.
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

/// Open place of a line: `key = "?"`.
struct Place {
    /// Byte offset of the place in the line.
    at: usize,
    key: String,
    /// Channel or column at the beginning of the line, if any.
    subject: Option<String>,
    /// Kind of the place, such as the unit of a force. Places of one kind likely have the same answer.
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

    /// True if the place is the column of a channel.
    fn is_channel(&self) -> bool {
        self.key == "from" && self.subject.is_some()
    }

    fn question(&self) -> String {
        let subject = self.subject.as_deref();
        match (self.key.as_str(), subject) {
            ("unit", Some(subject)) => format!("unit of {subject}, such as {}", units(subject)),
            ("unit", None) => "unit of these times, such as s, ms, us or ns".to_owned(),
            ("from", Some(subject)) => {
                format!("column with {subject}, or {LEFT_OUT} to leave it out")
            }
            ("model", None) => "name of the sensor".to_owned(),
            ("cut", _) => "keep, to read a truncated recording up to its end, or refuse".to_owned(),
            (key, Some(subject)) => format!("{key} of {subject}"),
            (key, None) => key.to_owned(),
        }
    }
}

/// Common units of the channel `subject`, by the name of the channel.
fn units(subject: &str) -> &'static str {
    match subject {
        "Px" | "Py" | "Pz" => "mm, um or m",
        "Fx" | "Fy" | "Fz" => "N, mN or gf",
        "Tx" | "Ty" | "Tz" => "Nm, mNm or Nmm",
        _ => "N, Nm, mm, um or deg",
    }
}

#[cfg(test)]
mod tests {
    use super::{Place, explained, has_labels, named, reason_against, remarks};

    #[test]
    fn remarks_count_lines_of_the_map_and_no_comments() {
        let map = "# Replace every \"?\": lines with \"a guess\" may be wrong.\n[columns]\nFz = { from = \"f\", unit = \"?\" }   # a guess\n";
        let said = remarks(map, "m.toml");
        assert_eq!(
            said[..2],
            [
                "fill in the place \"?\" of m.toml",
                "check the line with \"a guess\" in m.toml",
            ]
        );
        assert!(
            said[2].starts_with("if several rows show one contact") && !said[2].contains("offers"),
            "{said:?}"
        );
        let twice = map.replace("from = \"f\"", "from = \"?\"");
        assert_eq!(
            remarks(&twice, "m.toml")[0],
            "fill in the 2 places \"?\" of m.toml"
        );
        let offering =
            format!("{map}# point_id = \"group\"   # only\n# point_id = \"@object\"   # only\n");
        let said = remarks(&offering, "m.toml");
        let offered = "(the draft offers \"group\" and \"@object\")";
        assert!(said[2].contains(offered), "{said:?}");
        let bare =
            "[columns]\n# No channels: a, b\n[frame]\ncolumn = \"file\"\n[ids]\npoint_id = \"p\"\n";
        let said = remarks(bare, "m.toml");
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].starts_with("name the labels (the draft found none)"),
            "{said:?}"
        );
    }

    #[test]
    fn pictures_that_no_line_joins_come_first_and_labels_decide_the_last_command() {
        let map = "# No pictures match the rows of the table. Not joined: 3 pictures cam/gel_*.png; the table has 2 rows.\n[columns]\nFz = { from = \"f\", unit = \"?\" }\n";
        let said = remarks(map, "m.toml");
        assert_eq!(
            said[0],
            "no row of m.toml has a picture. Not joined: 3 pictures cam/gel_*.png; the table has 2 rows."
        );
        assert!(has_labels(map));
        assert!(!has_labels(
            "[columns]\n# No channels: a (counts up by one)\n[time]\nclock = \"unknown\"\n"
        ));
    }

    #[test]
    fn an_answer_replaces_the_comment_of_the_draft_and_a_column_that_is_no_channel_keeps_the_reason()
     {
        let excluded = "seq (counts up by one), set (`set` means commanded, not measured)";
        let why = reason_against(excluded, "set");
        assert_eq!(why, Some("`set` means commanded, not measured"));
        assert_eq!(reason_against(excluded, "et"), None);
        let line =
            "Fz = { from = \"set\", unit = \"?\" }   # \"a\", \"b\" match equally by a guess";
        assert_eq!(
            named(line, why),
            "Fz = { from = \"set\", unit = \"?\" }   # named by you, though `set` means commanded, not measured"
        );
        assert_eq!(
            named(line, None),
            "Fz = { from = \"set\", unit = \"?\" }   # named by you"
        );
        assert_eq!(named("model = \"gel\"", None), "model = \"gel\"");
    }

    #[test]
    fn a_comment_that_goes_on_below_its_line_is_explained_whole() {
        let lines = ["index = \"?\"   # write", "# table = x", "# or: y", "z"].map(str::to_owned);
        assert_eq!(explained(&lines), "index = \"?\"   # write\n# table = x");
    }

    #[test]
    fn an_open_place_says_its_key_and_its_channel() {
        let question = |line: &str| Place::of(line).map(|place| place.question());
        let unit = question("Fx = { from = \"ft[0]\", unit = \"?\" }   # a guess");
        assert_eq!(unit.as_deref(), Some("unit of Fx, such as N, mN or gf"));
        let unit = question("Tx = { from = \"ft[3]\", unit = \"?\" }");
        assert_eq!(unit.as_deref(), Some("unit of Tx, such as Nm, mNm or Nmm"));
        let from = question("Fz = { from = \"?\", unit = \"?\" }   # a, b match equally");
        let asked = "column with Fz, or none to leave it out";
        assert_eq!(from.as_deref(), Some(asked));
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
