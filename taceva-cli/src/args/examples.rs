//! Examples at the end of each `--help`.

use clap::Command;

/// Examples of each command that takes arguments: the words of the command after `#`, then a command line and its outcome.
const EXAMPLES: &str = include_str!("examples.txt");

/// Adds examples to `command` and its subcommands, before the rest of the closing help.
pub(crate) fn add_examples(command: Command) -> Command {
    below(command, &mut Vec::new())
}

/// Adds examples to `command`, which is called by the words in `path`, and to its subcommands.
fn below(mut command: Command, path: &mut Vec<String>) -> Command {
    let names: Vec<String> = command
        .get_subcommands()
        .map(|sub| sub.get_name().to_owned())
        .collect();
    for name in names {
        command = command.mut_subcommand(&name, |sub| {
            path.push(name.clone());
            let sub = below(sub, path);
            path.pop();
            sub
        });
    }
    let lines = of(&path.join(" "));
    if path.is_empty() || lines.is_empty() {
        return command;
    }
    let mut text = format!("Examples:\n{}", lines.join("\n"));
    if let Some(rest) = command.get_after_help() {
        text.push_str(&format!("\n\n{rest}"));
    }
    command.after_help(text)
}

/// Blocks of examples, each with the words of a command and the lines of its example.
fn blocks() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    let blocks = EXAMPLES.split("# ").filter(|block| !block.is_empty());
    blocks.filter_map(|block| {
        let (words, lines) = block.split_once('\n')?;
        Some((
            words,
            lines.lines().filter(|line| !line.is_empty()).collect(),
        ))
    })
}

/// Example lines of the command with these words; for a command with subcommands, one example of each.
fn of(words: &str) -> Vec<&'static str> {
    if let Some((_, own)) = blocks().find(|(of, _)| *of == words) {
        return own;
    }
    let beginning = format!("{words} ");
    let below = blocks().filter(|(of, _)| of.starts_with(&beginning));
    below
        .flat_map(|(_, lines)| lines.into_iter().take(2))
        .collect()
}

#[cfg(test)]
mod tests {
    use clap::{Command, Parser as _};

    use super::{blocks, of};
    use crate::args::Cli;

    /// Words of a command line before a pipe or a redirection.
    fn words(line: &str) -> Vec<String> {
        let mut words = vec![String::new()];
        let mut quoted = false;
        for letter in line.chars() {
            match letter {
                '"' => quoted = !quoted,
                ' ' if !quoted => words.push(String::new()),
                '|' | '>' if !quoted && words.last().is_some_and(String::is_empty) => break,
                letter => words.last_mut().expect("there is one").push(letter),
            }
        }
        words.retain(|word| !word.is_empty());
        words
    }

    fn leaves(command: &Command, path: &[String], found: &mut Vec<String>) {
        let subs: Vec<&Command> = command.get_subcommands().collect();
        if !path.is_empty() && (subs.is_empty() || path == ["sweep"] || path == ["bundle"]) {
            found.push(path.join(" "));
        }
        for sub in subs {
            let mut below = path.to_vec();
            below.push(sub.get_name().to_owned());
            leaves(sub, &below, found);
        }
    }

    #[test]
    fn each_command_has_two_examples_or_more_and_each_example_is_a_command() {
        let mut found = Vec::new();
        leaves(&Cli::documented(), &[], &mut found);
        for path in &found {
            assert!(of(path).len() >= 4, "{path} has no two examples");
        }
        for (path, lines) in blocks() {
            assert!(
                found.iter().any(|found| found == path),
                "`{path}` is no command"
            );
            for line in lines.iter().step_by(2).map(|line| line.trim()) {
                assert!(
                    line.starts_with(&format!("taceva {path}")),
                    "{line} is no example of {path}"
                );
                let parsed = Cli::try_parse_from(words(line));
                assert!(
                    parsed.is_ok(),
                    "{line}: {}",
                    parsed.expect_err("it was refused")
                );
            }
        }
    }

    #[test]
    fn examples_stand_in_the_help_of_a_command_before_its_other_remarks() {
        let mut command = Cli::documented();
        let help = |command: &mut Command, name: &str| {
            let sub = command.find_subcommand_mut(name).expect("it is a command");
            sub.render_long_help().to_string()
        };
        let accept = help(&mut command, "accept");
        let examples = accept.find("Examples:").expect("they are there");
        assert!(
            examples < accept.find("Limits:").expect("they are there"),
            "{accept}"
        );
        let plugin = help(&mut command, "plugin");
        assert!(
            plugin.contains("taceva plugin new sensor my-camera"),
            "{plugin}"
        );
    }
}
