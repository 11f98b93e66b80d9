//! Generated passages of a document: search and replacement.

use std::ops::Range;

use super::mark::{Kind, Mark, MarkError};

const OPEN: &str = "<!--";
const CLOSE: &str = "-->";

/// A generated passage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Passage {
    /// Kind of the passage, which determines when it is compared.
    pub kind: Kind,
    /// Command of the passage.
    pub command: String,
    /// Byte range of the passage in the text, between the comments.
    pub range: Range<usize>,
    /// Line of its first comment, from 1.
    pub line: usize,
}

/// A mark with the byte range of its comment.
struct Placed {
    mark: Mark,
    range: Range<usize>,
}

/// Byte ranges of fenced blocks. Comments in such a block mark no passage.
fn fences(text: &str) -> Vec<Range<usize>> {
    let (mut found, mut open, mut at) = (Vec::new(), None, 0);
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with("```") {
            match open.take() {
                Some(start) => found.push(start..at + line.len()),
                None => open = Some(at),
            }
        }
        at += line.len();
    }
    found
}

/// Line number of byte `at`, from 1.
fn line_of(text: &str, at: usize) -> usize {
    text[..at].matches('\n').count() + 1
}

/// Every mark of `text`, in order.
fn marks(text: &str) -> Result<Vec<Placed>, (usize, MarkError)> {
    let fences = fences(text);
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(start) = text[at..].find(OPEN).map(|start| at + start) {
        let is_shown =
            text[..start].ends_with('`') || fences.iter().any(|fence| fence.contains(&start));
        let inside = start + OPEN.len();
        if is_shown {
            at = inside;
            continue;
        }
        let wrong = |error| (line_of(text, start), error);
        let length = text[inside..]
            .find(CLOSE)
            .ok_or(MarkError::Open)
            .map_err(wrong)?;
        let end = inside + length + CLOSE.len();
        if let Some(mark) = Mark::read(&text[inside..inside + length]).map_err(wrong)? {
            found.push(Placed {
                mark,
                range: start..end,
            });
        }
        at = end;
    }
    Ok(found)
}

impl Passage {
    /// Every passage of `text`, in order.
    ///
    /// # Errors
    /// Line number and [`MarkError`] of the first invalid mark.
    pub fn all(text: &str) -> Result<Vec<Passage>, (usize, MarkError)> {
        let mut found = Vec::new();
        let mut begun: Option<(Kind, String, Range<usize>)> = None;
        for Placed { mark, range } in marks(text)? {
            let line = line_of(text, range.start);
            match (mark, begun.take()) {
                (Mark::From { kind, command }, None) => begun = Some((kind, command, range)),
                (Mark::From { .. }, Some(_)) => return Err((line, MarkError::Nested)),
                (Mark::End, Some((_, command, from)))
                    if command.contains("--") && !text[from.end..].starts_with('\n') =>
                {
                    return Err((line, MarkError::Inline));
                }
                (Mark::End, Some((kind, command, from))) => found.push(Passage {
                    kind,
                    command,
                    range: from.end..range.start,
                    line: line_of(text, from.start),
                }),
                (Mark::End, None) => return Err((line, MarkError::NoBeginning)),
                (Mark::ByHand(_), before) => begun = before,
            }
        }
        match begun {
            Some((.., from)) => Err((line_of(text, from.start), MarkError::NoEnd)),
            None => Ok(found),
        }
    }

    /// Text of the passage in `text`.
    pub fn content<'a>(&self, text: &'a str) -> &'a str {
        &text[self.range.clone()]
    }

    /// New text of the passage after its command printed `output`. A passage within a sentence is one word. In a fence, the output is unchanged;
    /// elsewhere it is on separate lines.
    pub fn renewed(&self, text: &str, output: &str) -> String {
        let old = self.content(text);
        let lines: Vec<&str> = output.trim_end().lines().map(str::trim_end).collect();
        let body = lines.join("\n");
        if !old.starts_with('\n') {
            return body;
        }
        let fence = old.lines().find(|line| !line.trim().is_empty());
        match fence.filter(|line| line.starts_with("```")) {
            Some(fence) => format!("\n{fence}\n{body}\n```\n"),
            None => format!("\n\n{body}\n\n"),
        }
    }
}

/// Line numbers, from 1, of tables with numbers that have neither a command nor a reason.
///
/// # Errors
/// As [`Passage::all`].
pub fn unexplained_tables(text: &str) -> Result<Vec<usize>, (usize, MarkError)> {
    let passages = Passage::all(text)?;
    let placed = marks(text)?;
    let by_hand: Vec<usize> = placed
        .into_iter()
        .filter(|placed| matches!(placed.mark, Mark::ByHand(_)))
        .map(|placed| placed.range.end)
        .collect();
    let fences = fences(text);
    let (mut found, mut at) = (Vec::new(), 0);
    let mut table: Option<(usize, bool)> = None;
    for line in text.split_inclusive('\n').chain(["\n"]) {
        let is_fenced = fences.iter().any(|fence| fence.contains(&at));
        let is_row = line.starts_with('|') && !is_fenced;
        match (&mut table, is_row) {
            (None, true) => table = Some((at, false)),
            (Some((_, has_numbers)), true) => *has_numbers |= has_number(line),
            (Some((start, has_numbers)), false) => {
                let (start, has_numbers) = (*start, *has_numbers);
                let is_written = passages
                    .iter()
                    .any(|passage| passage.range.contains(&start));
                // The reason must stand directly before the table.
                let is_excused = by_hand
                    .iter()
                    .any(|end| *end <= start && text[*end..start].trim().is_empty());
                if has_numbers && !is_written && !is_excused {
                    found.push(line_of(text, start));
                }
                table = None;
            }
            (None, false) => {}
        }
        at += line.len();
    }
    Ok(found)
}

/// True if a table row has a cell with only a number, perhaps with a unit or an interval: `0.73`, `3.2×`, `0.29 s`, but not `size=32` or a
/// version.
fn has_number(row: &str) -> bool {
    row.trim().trim_matches('|').split('|').skip(1).any(|cell| {
        let cell = cell
            .trim()
            .trim_matches(['*', '≈', '<', '>', '-', '−', ' ']);
        let number: String = cell
            .chars()
            .take_while(|letter| letter.is_ascii_digit() || *letter == '.')
            .collect();
        number.parse::<f64>().is_ok() && !cell[number.len()..].starts_with(char::is_alphabetic)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# A\n\nIt takes <!-- from, times: time it -->2 s<!-- end --> or so.\n\n<!-- from: print it -->\n\n| a | b |\n|---|---|\n| c | 1.5 |\n\n<!-- end -->\n\n\
        <!-- from, slow: show it -->\n```text\nold\n```\n<!-- end -->\n\n```\n<!-- from: an example -->\n```\nand `<!-- end -->` too\n";

    #[test]
    fn passages_are_found_in_sentences_between_lines_and_around_fences_and_not_within() {
        let found = Passage::all(TEXT).expect("marks");
        let shown: Vec<(&str, usize, Kind)> = found
            .iter()
            .map(|passage| (passage.command.as_str(), passage.line, passage.kind))
            .collect();
        assert_eq!(
            shown,
            [
                ("time it", 3, Kind::Times),
                ("print it", 5, Kind::Quick),
                ("show it", 13, Kind::Slow)
            ]
        );
        assert_eq!(found[0].content(TEXT), "2 s");
    }

    #[test]
    fn what_a_command_prints_takes_the_form_of_what_it_replaces() {
        let found = Passage::all(TEXT).expect("marks");
        assert_eq!(found[0].renewed(TEXT, "3 s\n"), "3 s");
        assert_eq!(
            found[1].renewed(TEXT, "| x |  \n| y |\n\n"),
            "\n\n| x |\n| y |\n\n"
        );
        assert_eq!(found[2].renewed(TEXT, "new\n"), "\n```text\nnew\n```\n");
        for passage in &found {
            let content = passage.content(TEXT);
            let output = content.replace("```text\n", "").replace("```", "");
            assert_eq!(
                passage.renewed(TEXT, output.trim()),
                content,
                "{}",
                passage.command
            );
        }
    }

    #[test]
    fn marks_that_do_not_pair_are_named_with_their_line() {
        let wrong = |text: &str| Passage::all(text).expect_err("it is wrong");
        assert_eq!(wrong("a\n<!-- from: x -->\nb\n"), (2, MarkError::NoEnd));
        assert_eq!(wrong("\n\n<!-- end -->\n"), (3, MarkError::NoBeginning));
        assert_eq!(
            wrong("<!-- from: x -->\n<!-- from: y -->\n<!-- end -->\n"),
            (2, MarkError::Nested)
        );
        assert_eq!(wrong("<!-- from: x"), (1, MarkError::Open));
        assert_eq!(
            wrong("a <!-- from: x --y -->1<!-- end -->\n"),
            (1, MarkError::Inline)
        );
    }

    #[test]
    fn a_table_of_numbers_needs_a_command_or_a_reason() {
        let table = "| a | b |\n|---|---|\n| c | 1.5 mm |\n";
        let lines = |text: String| unexplained_tables(&text).expect("marks");
        assert_eq!(lines(format!("x\n\n{table}\n")), [3]);
        assert!(lines(format!("<!-- from: x -->\n\n{table}\n<!-- end -->\n")).is_empty());
        assert!(lines(format!("<!-- by hand: held by a test -->\n\n{table}\n")).is_empty());
        assert!(lines(format!("```\n{table}```\n")).is_empty());
        let words =
            "| key | meaning |\n|---|---|\n| size=32 | 32 pixels a side |\n| v | version1 |\n";
        assert!(lines("| key | default |\n|---|---|\n| a | none |\n".to_owned()).is_empty());
        assert_eq!(lines(words.to_owned()), [1], "`32 pixels` is a number");
    }
}
