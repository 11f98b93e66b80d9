//! Comments that mark generated passages.

/// Kind of a passage. It determines when the passage is compared with a new run of its command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The command takes seconds: every test run compares the passage.
    Quick,
    /// The command takes minutes: only `renew --check` compares the passage.
    Slow,
    /// The output contains times: the passage is never compared.
    Times,
    /// The command reads recordings: `renew --check` compares the passage if `TACEVA_DATA` names them.
    Data,
}

impl Kind {
    fn of(word: &str) -> Option<Kind> {
        match word {
            "" => Some(Kind::Quick),
            ", slow" => Some(Kind::Slow),
            ", times" => Some(Kind::Times),
            ", data" => Some(Kind::Data),
            _ => None,
        }
    }
}

/// Content of a marking comment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Start of a passage, with its command.
    From {
        /// Kind of the passage, which determines when it is compared.
        kind: Kind,
        /// The command.
        command: String,
    },
    /// End of a passage.
    End,
    /// The next table is handwritten, for this reason.
    ByHand(String),
}

/// An invalid mark.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MarkError {
    /// `from, …:` with an unknown word, or without a command.
    From(String),
    /// `by hand:` without a reason.
    ByHand,
    /// A comment without an end.
    Open,
    /// A passage without `<!-- end -->`.
    NoEnd,
    /// `<!-- end -->` without a passage.
    NoBeginning,
    /// A passage within a passage.
    Nested,
    /// A command with `--` in an inline comment, which renderers show.
    Inline,
}

impl std::fmt::Display for MarkError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            MarkError::From(text) => write!(
                f,
                "`{text}`: expected `from: COMMAND`, or `from, slow:`, `from, times:` or `from, data:`"
            ),
            MarkError::ByHand => f.write_str("`by hand:` without a reason"),
            MarkError::Open => f.write_str("a comment without `-->`"),
            MarkError::NoEnd => f.write_str("`from` without `<!-- end -->`"),
            MarkError::NoBeginning => f.write_str("`<!-- end -->` without `from`"),
            MarkError::Nested => f.write_str("`from` within `from`"),
            MarkError::Inline => f.write_str(
                "a comment within a line cannot hold `--`: renderers show it; put the passage on lines of its own",
            ),
        }
    }
}

impl std::error::Error for MarkError {}

impl Mark {
    /// Parses the text between `<!--` and `-->`; `None` for an ordinary comment.
    ///
    /// # Errors
    /// [`MarkError`] for an invalid mark.
    pub fn read(comment: &str) -> Result<Option<Mark>, MarkError> {
        let text = comment.trim();
        if text == "end" {
            return Ok(Some(Mark::End));
        }
        if let Some(reason) = text.strip_prefix("by hand") {
            let reason = reason.trim_start_matches(':').trim();
            return match reason.is_empty() {
                true => Err(MarkError::ByHand),
                false => Ok(Some(Mark::ByHand(reason.to_owned()))),
            };
        }
        let Some(rest) = text.strip_prefix("from") else {
            return Ok(None);
        };
        let Some((word, command)) = rest.split_once(':') else {
            return Ok(None);
        };
        let command = command.trim().to_owned();
        match Kind::of(word) {
            Some(kind) if !command.is_empty() => Ok(Some(Mark::From { kind, command })),
            _ => Err(MarkError::From(text.to_owned())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_names_its_command_and_when_it_is_compared() {
        let read = |text: &str| Mark::read(text);
        let from = |kind, command: &str| {
            Ok(Some(Mark::From {
                kind,
                command: command.to_owned(),
            }))
        };
        assert_eq!(read(" from: a | b: c "), from(Kind::Quick, "a | b: c"));
        assert_eq!(read("from, slow: a\nb"), from(Kind::Slow, "a\nb"));
        assert_eq!(read("from, times: a"), from(Kind::Times, "a"));
        assert_eq!(read("from, data: a"), from(Kind::Data, "a"));
        assert_eq!(read(" end "), Ok(Some(Mark::End)));
        assert_eq!(
            read("by hand: held by a test"),
            Ok(Some(Mark::ByHand("held by a test".to_owned())))
        );
        assert_eq!(read(" any other comment "), Ok(None));
    }

    #[test]
    fn what_begins_like_a_mark_and_is_none_is_refused() {
        assert!(matches!(
            Mark::read("from, often: a"),
            Err(MarkError::From(_))
        ));
        assert!(matches!(Mark::read("from:  "), Err(MarkError::From(_))));
        assert_eq!(Mark::read("by hand:"), Err(MarkError::ByHand));
    }
}
