//! Command line as the user typed it.

use std::ffi::{OsStr, OsString};

use taceva_dataset::internal::shell_word;

/// Words of a command line, beginning with the name of the program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Invocation {
    words: Vec<String>,
}

impl Invocation {
    pub(crate) fn new(words: &[OsString]) -> Invocation {
        let word = |word: &OsString| word.to_string_lossy().into_owned();
        Invocation {
            words: words.iter().map(word).collect(),
        }
    }

    /// Shell-quoted command line of this command, with additional `options` and without the flag `without`.
    pub(crate) fn with(&self, options: &[&OsStr], without: &str) -> String {
        let kept = self.words.iter().filter(|word| *word != without);
        let mut words: Vec<String> = kept.map(|word| shell_word(word)).collect();
        words.extend(
            options
                .iter()
                .map(|word| shell_word(&word.to_string_lossy())),
        );
        words.join(" ")
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::{OsStr, OsString};

    use super::Invocation;

    #[test]
    fn every_word_is_kept_and_quoted_for_a_shell() {
        let typed = [
            "taceva",
            "run",
            "my scene.toml",
            "--rig",
            "it's.toml",
            "--force",
        ];
        let typed: Vec<OsString> = typed.iter().map(OsString::from).collect();
        let options = ["--resume", "--out", "a b"].map(OsStr::new);
        assert_eq!(
            Invocation::new(&typed).with(&options, "--force"),
            r"taceva run 'my scene.toml' --rig 'it'\''s.toml' --resume --out 'a b'"
        );
    }
}
