//! Questions at the terminal, and answers to them.

use std::io;

use super::Usage;
use super::answers::Answers;
use crate::args::InitTarget;
use crate::progress::is_stopped;
use crate::stderr;

/// Asks questions on standard error and reads answers from standard input.
pub(super) struct Interview<R = Answers> {
    answers: R,
    takes_defaults: bool,
}

impl Interview {
    /// Creates an interview that reads from standard input. With `--yes`, asks nothing.
    pub(super) fn new(args: &InitTarget) -> Interview {
        Interview {
            answers: Answers::default(),
            takes_defaults: args.yes,
        }
    }
}

impl<R: Iterator<Item = io::Result<String>>> Interview<R> {
    /// Prints a line that explains the next questions.
    pub(super) fn say(&self, words: &str) {
        if !self.takes_defaults {
            stderr::write(&format!("{words}\n"));
        }
    }

    /// True if defaults replace all questions.
    pub(super) fn takes_defaults(&self) -> bool {
        self.takes_defaults
    }

    /// Asks `question` until `check` accepts the answer. An empty line selects the default.
    ///
    /// # Errors
    /// [`Usage`] if the answers end, also by a signal, or for a question without default with `--yes`.
    pub(super) fn ask(
        &mut self,
        question: &str,
        default: Option<&str>,
        check: impl Fn(&str) -> Result<(), String>,
    ) -> anyhow::Result<String> {
        if self.takes_defaults {
            return default.map(str::to_owned).ok_or_else(|| {
                Usage::error(format!(
                    "no default for: {question}; run the command without --yes"
                ))
            });
        }
        loop {
            let offered = default.map_or_else(String::new, |default| format!(" [{default}]"));
            stderr::write(&format!("{question}{offered}: "));
            let Some(line) = self.answers.next() else {
                stderr::write("\n");
                let ended = match is_stopped() {
                    true => "stopped",
                    false => "standard input ended",
                };
                let remedy = default.map_or("", |_| "; --yes takes defaults");
                return Err(Usage::error(format!(
                    "{ended} before an answer to: {question}{remedy}"
                )));
            };
            let line = line?;
            let typed = line.trim();
            let answer = match (typed, default) {
                ("", Some(default)) => default,
                ("", None) => {
                    stderr::write("an answer is needed here\n");
                    continue;
                }
                (typed, _) => typed,
            };
            match check(answer) {
                Ok(()) => return Ok(answer.to_owned()),
                Err(problem) => stderr::write(&format!("{problem}\n")),
            }
        }
    }

    /// Asks `question` until the answer is one of `choices`.
    ///
    /// # Errors
    /// The errors of [`Interview::ask`].
    pub(super) fn choose(
        &mut self,
        question: &str,
        choices: &[impl AsRef<str>],
        default: Option<&str>,
    ) -> anyhow::Result<String> {
        let words: Vec<&str> = choices.iter().map(AsRef::as_ref).collect();
        let known = words.join(", ");
        let check = |answer: &str| match words.contains(&answer) {
            true => Ok(()),
            false => Err(format!("expected one of {known}")),
        };
        self.ask(&format!("{question} ({known})"), default, check)
    }

    /// Asks for a number within `[least, most]`.
    ///
    /// # Errors
    /// The errors of [`Interview::ask`].
    pub(super) fn number(
        &mut self,
        question: &str,
        default: Option<&str>,
        [least, most]: [f64; 2],
    ) -> anyhow::Result<f64> {
        let read = |answer: &str| {
            answer
                .parse::<f64>()
                .ok()
                .filter(|n| (least..=most).contains(n))
        };
        let check = |answer: &str| match read(answer) {
            Some(_) => Ok(()),
            None => Err(format!("expected a number from {least} to {most}")),
        };
        let answer = self.ask(question, default, check)?;
        read(&answer)
            .ok_or_else(|| Usage::error(format!("{question}: {answer} is not a valid answer")))
    }

    /// Asks for a whole number within `[least, most]`.
    ///
    /// # Errors
    /// The errors of [`Interview::ask`].
    pub(super) fn count(
        &mut self,
        question: &str,
        default: &str,
        [least, most]: [u32; 2],
    ) -> anyhow::Result<u32> {
        let read = |answer: &str| {
            answer
                .parse::<u32>()
                .ok()
                .filter(|n| (least..=most).contains(n))
        };
        let check = |answer: &str| match read(answer) {
            Some(_) => Ok(()),
            None => Err(format!("expected a whole number from {least} to {most}")),
        };
        let answer = self.ask(question, Some(default), check)?;
        read(&answer)
            .ok_or_else(|| Usage::error(format!("{question}: {answer} is not a valid answer")))
    }
}

#[cfg(test)]
mod tests {
    use std::io::{BufRead, Lines};

    use super::Interview;

    fn interview(answers: &'static str, takes_defaults: bool) -> Interview<Lines<&'static [u8]>> {
        Interview {
            answers: answers.as_bytes().lines(),
            takes_defaults,
        }
    }

    #[test]
    fn a_refused_answer_is_asked_for_again_and_an_empty_one_is_the_default() {
        let mut asked = interview("many\n0\n\n", false);
        assert_eq!(
            asked.count("points", "200", [1, 999]).expect("the third"),
            200
        );
        let mut asked = interview("both\nrig\n", false);
        let chosen = asked
            .choose("which", &["scene", "rig"], None)
            .expect("the second");
        assert_eq!(chosen, "rig");
    }

    #[test]
    fn answers_that_end_and_questions_without_default_are_refused() {
        let ended = interview("", false).number("depth", None, [0.0, 1.0]);
        let ended = ended.expect_err("no answer").to_string();
        assert!(ended.ends_with("answer to: depth"), "{ended}");
        let ended = interview("", false).number("depth", Some("0.5"), [0.0, 1.0]);
        let ended = ended.expect_err("no answer").to_string();
        assert!(ended.ends_with("depth; --yes takes defaults"), "{ended}");
        let unasked = interview("", true).number("depth", None, [0.0, 1.0]);
        assert!(
            unasked
                .expect_err("no default")
                .to_string()
                .contains("--yes")
        );
        let taken = interview("", true).number("depth", Some("0.5"), [0.0, 1.0]);
        assert!((taken.expect("the default") - 0.5).abs() < 1e-12);
    }
}
