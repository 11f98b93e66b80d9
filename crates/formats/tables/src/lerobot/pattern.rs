//! Path patterns of LeRobot: `data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::shown;
use crate::limits;

/// Path pattern: texts and named fields in sequence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(String),
    /// Named field. A number is padded with zeros to `digits` digits.
    Value {
        name: String,
        digits: usize,
    },
}

/// Value that replaces a named field of a pattern.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value<'a> {
    Number(u64),
    Text(&'a str),
}

impl Pattern {
    /// Parses the pattern `text`. Returns an error message if the text is not a pattern of relative paths.
    pub(super) fn parse(text: &str) -> Result<Pattern, String> {
        let wrong = || {
            format!(
                "`{}` is not a pattern of paths inside the folder",
                shown(text)
            )
        };
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            let (inside, after) = after.split_once('}').ok_or_else(wrong)?;
            let (name, form) = inside.split_once(':').unwrap_or((inside, ""));
            let digits = match form.strip_suffix('d') {
                None if form.is_empty() => 0,
                Some("") => 0,
                Some(width) => match width.strip_prefix('0').and_then(|width| width.parse().ok()) {
                    Some(width) if width <= 20 => width,
                    _ => return Err(wrong()),
                },
                None => return Err(wrong()),
            };
            parts.push(Part::Text(before.to_owned()));
            parts.push(Part::Value {
                name: name.to_owned(),
                digits,
            });
            rest = after;
        }
        parts.push(Part::Text(rest.to_owned()));
        let pattern = Pattern { parts };
        let is_safe = |part: &Part| match part {
            Part::Text(text) => !text.contains(['}', '\\', ':', '\0']),
            Part::Value { .. } => true,
        };
        match pattern.parts.iter().all(is_safe) && is_inside(text) {
            true => Ok(pattern),
            false => Err(wrong()),
        }
    }

    /// Replaces the named fields by `values`, which gives a path. Returns an error message if a field has no value, or the path would lead out of the
    /// folder.
    pub(super) fn fill(&self, values: &[(&str, Value<'_>)]) -> Result<PathBuf, String> {
        let mut path = String::new();
        for part in &self.parts {
            match part {
                Part::Text(text) => path.push_str(text),
                Part::Value { name, digits } => {
                    let value = values.iter().find(|(known, _)| known == name);
                    match value
                        .ok_or_else(|| {
                            format!("unknown field `{}` in a path pattern", shown(name))
                        })?
                        .1
                    {
                        Value::Number(number) => path.push_str(&format!("{number:0digits$}")),
                        Value::Text(text) => path.push_str(text),
                    }
                }
            }
        }
        match is_inside(&path) {
            true => Ok(PathBuf::from(path)),
            false => Err(format!("`{}` leads outside the folder", shown(&path))),
        }
    }

    /// Files in `folder` that match the pattern. Each named field matches a number, and the files are sorted by these numbers.
    pub(super) fn files(&self, folder: &Path) -> Result<Vec<PathBuf>, std::io::Error> {
        let mut found = vec![(Vec::new(), PathBuf::new())];
        for component in self.components() {
            let mut next = Vec::new();
            for (numbers, path) in found {
                for entry in fs::read_dir(folder.join(&path))? {
                    let name = entry?.file_name();
                    let Some(name) = name.to_str() else { continue };
                    if let Some(more) = matches(&component, name) {
                        let mut numbers: Vec<u64> = numbers.clone();
                        numbers.extend(more);
                        next.push((numbers, path.join(name)));
                    }
                    if next.len() > limits::NAMES {
                        return Err(std::io::Error::other(format!(
                            "more than {} files",
                            limits::NAMES
                        )));
                    }
                }
            }
            found = next;
        }
        found.sort();
        Ok(found.into_iter().map(|(_, path)| path).collect())
    }

    /// Texts and fields of each path component, which lies between slashes.
    fn components(&self) -> Vec<Vec<Part>> {
        let mut components = vec![Vec::new()];
        for part in &self.parts {
            let Part::Text(text) = part else {
                components
                    .last_mut()
                    .expect("never empty")
                    .push(part.clone());
                continue;
            };
            for (at, piece) in text.split('/').enumerate() {
                if at > 0 {
                    components.push(Vec::new());
                }
                components
                    .last_mut()
                    .expect("never empty")
                    .push(Part::Text(piece.to_owned()));
            }
        }
        components
    }
}

/// Numbers in the file name `name` at the fields of `component`; `None` if the name does not match.
fn matches(component: &[Part], name: &str) -> Option<Vec<u64>> {
    let mut rest = name;
    let mut numbers = Vec::new();
    for part in component {
        match part {
            Part::Text(text) => rest = rest.strip_prefix(text.as_str())?,
            Part::Value { digits, .. } => {
                let end = rest
                    .find(|letter: char| !letter.is_ascii_digit())
                    .unwrap_or(rest.len());
                if end < (*digits).max(1) {
                    return None;
                }
                numbers.push(rest[..end].parse().ok()?);
                rest = &rest[end..];
            }
        }
    }
    rest.is_empty().then_some(numbers)
}

/// True if a path is relative and never leads upwards.
fn is_inside(path: &str) -> bool {
    let is_name = |part: &str| !part.is_empty() && part != "." && part != "..";
    !path.contains(['\\', '\0']) && path.split('/').all(is_name)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DATA: &str = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet";

    #[test]
    fn names_are_replaced_by_values() {
        let fill = |text: &str| {
            let values = [
                ("chunk_index", Value::Number(2)),
                ("file_index", Value::Number(1234)),
                ("video_key", Value::Text("a.b")),
            ];
            Pattern::parse(text)?
                .fill(&values)
                .map(|path| path.to_string_lossy().into_owned())
        };
        assert_eq!(
            fill(DATA),
            Ok("data/chunk-002/file-1234.parquet".to_owned())
        );
        assert_eq!(
            fill("videos/{video_key}/{file_index}.mp4"),
            Ok("videos/a.b/1234.mp4".to_owned())
        );
        for text in [
            "/data/x",
            "../x",
            "data/{chunk_index:3d}",
            "data/{chunk_index",
            "a//b",
            "data/{chunk_index:05x}",
            "c:/x",
            "",
        ] {
            let problem = fill(text).expect_err(text);
            assert!(problem.contains("is not a pattern of paths"), "{problem}");
        }
        assert!(fill("{total}").expect_err("unknown").contains("`total`"));
        let key = Pattern::parse("videos/{video_key}/x.mp4").expect("a pattern");
        assert!(
            key.fill(&[("video_key", Value::Text("../.."))])
                .expect_err("out")
                .contains("leads out")
        );
    }

    #[test]
    fn files_are_found_in_the_order_of_their_numbers() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in [
            "chunk-000/file-1000.parquet",
            "chunk-000/file-999.parquet",
            "chunk-001/file-000.parquet",
            "chunk-000/file-01.parquet",
            "chunk-000/file-000.parquet.tmp",
            "chunk-x/file-000.parquet",
        ] {
            let path = folder.path().join("data").join(name);
            fs::create_dir_all(path.parent().expect("a parent")).expect("made");
            fs::write(path, "").expect("written");
        }
        let files = Pattern::parse(DATA)
            .expect("a pattern")
            .files(folder.path())
            .expect("listed");
        let expected = [
            "data/chunk-000/file-999.parquet",
            "data/chunk-000/file-1000.parquet",
            "data/chunk-001/file-000.parquet",
        ];
        assert_eq!(files, expected.map(PathBuf::from));
    }
}
