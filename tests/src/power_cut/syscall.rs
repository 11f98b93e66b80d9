//! Parser of one line of a system call trace.

use std::collections::HashMap;

/// A completed system call.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Call {
    pub(super) name: String,
    pub(super) arguments: Vec<String>,
    pub(super) result: i64,
    /// Value of `now` in [`Lexer::line`] when the call began.
    pub(super) begun: usize,
}

/// Joins the two lines of a call that another thread interrupted in the trace.
#[derive(Debug, Default)]
pub(super) struct Lexer {
    unfinished: HashMap<String, (String, usize)>,
}

impl Lexer {
    /// Parses `line` and returns the call that it completes; `None` if no call is complete. `now` becomes the start of a call that begins.
    pub(super) fn line(&mut self, line: &str, now: usize) -> Option<Call> {
        let (thread, text) = line.split_once(' ')?;
        let text = text.trim_start();
        if let Some(head) = text.strip_suffix("<unfinished ...>") {
            let head = head.trim_end().to_owned();
            if head.starts_with("close(") {
                // The descriptor is free from here on: another thread may get it before the call's second half.
                return parse(&format!("{head}) = 0"), now);
            }
            self.unfinished.insert(thread.to_owned(), (head, now));
            return None;
        }
        if let Some(resumed) = text.strip_prefix("<... ") {
            let (_, tail) = resumed.split_once(" resumed>")?;
            let (head, begun) = self.unfinished.remove(thread)?;
            return parse(&format!("{head}{tail}"), begun);
        }
        parse(text, now)
    }
}

/// Parses `name(argument, argument) = result …`; `None` for another line.
fn parse(text: &str, begun: usize) -> Option<Call> {
    let (name, rest) = text.split_once('(')?;
    let (arguments, result) = rest.rsplit_once(" = ")?;
    let arguments = arguments.trim_end().strip_suffix(')')?;
    let result = result.split_whitespace().next()?;
    let result = match result.strip_prefix("0x") {
        Some(address) => i64::from_str_radix(address, 16).ok()?,
        None => result.parse().ok()?,
    };
    let is_name = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    name.chars().all(is_name).then(|| Call {
        name: name.to_owned(),
        arguments: split(arguments),
        result,
        begun,
    })
}

/// Splits at commas outside brackets. Strings are hexadecimal, without commas and brackets.
fn split(arguments: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut depth = 0_usize;
    for letter in arguments.chars() {
        match letter {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(String::new());
                continue;
            }
            _ => {}
        }
        if let Some(part) = parts.last_mut() {
            part.push(letter);
        }
    }
    parts.iter().map(|part| part.trim().to_owned()).collect()
}

/// Bytes of all strings in `argument`, concatenated.
pub(super) fn bytes_of(argument: &str) -> Vec<u8> {
    let quoted = argument.split('"').skip(1).step_by(2);
    quoted
        .flat_map(|text| text.split("\\x").skip(1))
        .filter_map(|digits| u8::from_str_radix(digits, 16).ok())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_is_taken_apart() {
        let mut lexer = Lexer::default();
        let line = r#"17  writev(5, [{iov_base="\x41\x42", iov_len=2}, {iov_base="\x43", iov_len=1}], 2) = 3"#;
        let call = lexer.line(line, 4).expect("a call");
        assert_eq!((call.name.as_str(), call.result), ("writev", 3));
        assert_eq!(call.arguments.len(), 3);
        assert_eq!(bytes_of(&call.arguments[1]), b"ABC");
    }

    #[test]
    fn halves_of_two_threads_find_each_other() {
        let mut lexer = Lexer::default();
        assert_eq!(lexer.line("1  fsync(3 <unfinished ...>", 7), None);
        assert_eq!(lexer.line("2  fsync(4 <unfinished ...>", 8), None);
        let first = lexer.line("1  <... fsync resumed>) = 0", 9).expect("whole");
        assert_eq!((first.arguments[0].as_str(), first.begun), ("3", 7));
        let second = lexer.line("2  <... fsync resumed>) = 0", 9).expect("whole");
        assert_eq!((second.arguments[0].as_str(), second.begun), ("4", 8));
    }

    #[test]
    fn a_descriptor_is_free_as_soon_as_its_close_begins() {
        let mut lexer = Lexer::default();
        let close = lexer.line("1  close(5 <unfinished ...>", 3);
        assert_eq!(close.map(|call| call.arguments), Some(vec!["5".to_owned()]));
        assert_eq!(lexer.line("1  <... close resumed>) = 0", 4), None);
    }

    #[test]
    fn what_is_no_call_is_nothing() {
        let mut lexer = Lexer::default();
        for line in [
            "1  +++ exited with 0 +++",
            "1  --- SIGCHLD {} ---",
            "1  exit_group(0) = ?",
        ] {
            assert_eq!(lexer.line(line, 0), None, "{line}");
        }
    }
}
