//! Operator of a rig who answers at the terminal.

use std::io::{BufRead, BufReader, IsTerminal, Read, Stdin};
use std::time::Duration;

use taceva_live::Live;
use taceva_protocol::{Answer, Cancel, Operator, Question};

use taceva_core::shown;

use crate::{progress, stderr};

/// Interactive terminal.
pub(in crate::cmd) struct Terminal<I: Read> {
    input: BufReader<I>,
    say: fn(&str),
    is_stopped: fn() -> bool,
    /// Page, if any, that also shows each question. The first answer is used.
    page: Option<Live>,
}

/// Terminal of this program.
pub(in crate::cmd) type AtTerminal = Terminal<Stdin>;

/// Terminal of this program; `None` if it is not interactive. Questions also appear on `page`.
pub(in crate::cmd) fn terminal(page: Option<Live>) -> Option<AtTerminal> {
    let is_there = std::io::stdin().is_terminal() && std::io::stderr().is_terminal();
    is_there.then(|| Terminal {
        input: BufReader::new(std::io::stdin()),
        say: |words| stderr::say(format_args!("{words}")),
        is_stopped: progress::is_stopped,
        page,
    })
}

/// Text that names the key for each answer.
fn keys(question: &Question) -> String {
    match question {
        Question::Enable { robot, .. } => {
            format!(
                "type {} to let the robot move; q or Esc: stop",
                shown(robot)
            )
        }
        Question::Resume(_) | Question::GoOn => "Enter: continue; q or Esc: stop".to_owned(),
        _ => "Enter: done, hands out of reach; s: skip; q or Esc: stop".to_owned(),
    }
}

impl<I: Read + Waits> Operator for Terminal<I> {
    fn call_to_hold(&mut self, patience_s: f64) {
        progress::without_bar(|| {
            (self.say)(&format!(
                "hold the enabling switch within {patience_s} s; nothing moves until you do"
            ));
        });
    }

    fn warn(&mut self, warning: &str) {
        progress::without_bar(|| (self.say)(&format!("warning: {warning}")));
    }

    fn note(&mut self, finding: &str) {
        progress::without_bar(|| (self.say)(finding));
    }

    fn ask(&mut self, question: &Question, cancel: &Cancel) -> Answer {
        progress::without_bar(|| self.answered(question, cancel))
    }
}

impl<I: Read + Waits> Terminal<I> {
    /// Prints `question` and waits for its answer, under the rules of [`Operator::ask`].
    fn answered(&mut self, question: &Question, cancel: &Cancel) -> Answer {
        let keys = keys(question);
        (self.say)(&format!("{question} ({keys})"));
        let asked = self.page.as_ref().map(|page| page.ask(question));
        loop {
            if let Some(answer) = asked
                .as_ref()
                .and_then(|asked| asked.answer(Duration::ZERO))
            {
                return answer;
            }
            if cancel.is_cancelled() || (self.is_stopped)() {
                return Answer::Stop;
            }
            if self.input.buffer().is_empty() && !self.input.get_ref().has_input() {
                continue;
            }
            let mut line = String::new();
            match self.input.read_line(&mut line) {
                // The terminal was closed.
                Ok(0) | Err(_) => return Answer::Stop,
                Ok(_) => {}
            }
            match answer(question, &line) {
                Some(answer) => return answer,
                None => (self.say)(&keys),
            }
        }
    }
}

/// Parses the answer in `line`; `None` for other text. Only the name of a robot permits its motion.
fn answer(question: &Question, line: &str) -> Option<Answer> {
    let typed = line.trim_end_matches(['\r', '\n']).trim();
    match (question, typed) {
        (_, stop) if stop.contains('\u{1b}') => Some(Answer::Stop),
        (_, "q" | "Q") => Some(Answer::Stop),
        (Question::Enable { robot, .. }, typed) => (typed == robot).then_some(Answer::Done),
        (_, "") => Some(Answer::Done),
        (Question::Resume(_) | Question::GoOn, _) => None,
        (_, "s" | "S") => Some(Answer::Skip),
        _ => None,
    }
}

/// Input for which a caller can wait without reading.
pub(in crate::cmd) trait Waits {
    /// Waits for at most 0.1 s. True if input is available or has ended.
    fn has_input(&self) -> bool;
}

#[cfg(unix)]
impl<I: std::os::fd::AsFd> Waits for I {
    fn has_input(&self) -> bool {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};
        let mut polled = [PollFd::new(self, PollFlags::IN)];
        let tenth = Timespec {
            tv_sec: 0,
            tv_nsec: 100_000_000,
        };
        match poll(&mut polled, Some(&tenth)) {
            Ok(ready) => ready > 0,
            // A signal arrived: the caller checks for it.
            Err(rustix::io::Errno::INTR) => false,
            Err(_) => true,
        }
    }
}

#[cfg(not(unix))]
impl<I> Waits for I {
    fn has_input(&self) -> bool {
        true
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::io::Write;
    use std::os::unix::net::UnixStream;

    use super::*;

    /// The answers to `count` questions if the user types `text` and hangs up.
    fn answers(text: &str, count: usize) -> Vec<Answer> {
        answers_to(&Question::Unit("b".to_owned()), text, count)
    }

    fn answers_to(question: &Question, text: &str, count: usize) -> Vec<Answer> {
        let (mut person, input) = UnixStream::pair().expect("a line");
        person.write_all(text.as_bytes()).expect("typed");
        drop(person);
        let mut terminal = Terminal {
            input: BufReader::new(input),
            say: |_| {},
            is_stopped: || false,
            page: None,
        };
        (0..count)
            .map(|_| terminal.ask(question, &Cancel::new()))
            .collect()
    }

    #[test]
    fn enter_is_done_s_skips_q_and_escape_stop_and_anything_else_is_asked_again() {
        use Answer::{Done, Skip, Stop};
        assert_eq!(answers("\ns\nq\n", 3), [Done, Skip, Stop]);
        assert_eq!(answers("yes\nwhat\n\n", 1), [Done]);
        assert_eq!(answers("\u{1b}\n S \r\n", 2), [Stop, Skip]);
        // Hung up.
        assert_eq!(answers("", 1), [Stop]);
        assert_eq!(answers_to(&Question::GoOn, "s\n\n", 1), [Done]);
    }

    #[test]
    fn a_robot_is_let_move_by_its_whole_name_and_by_nothing_else() {
        use Answer::{Done, Stop};
        let enable = Question::Enable {
            robot: "ufactory/xarm".to_owned(),
            way: "5 mm up".to_owned(),
        };
        // An Enter meant for another question, a part of the name, and no skip.
        let typed = "\ns\nyes\nxarm\n ufactory/xarm \n";
        assert_eq!(answers_to(&enable, typed, 1), [Done]);
        assert_eq!(answers_to(&enable, "\nq\n", 1), [Stop]);
        assert_eq!(answers_to(&enable, "\n", 1), [Stop]);
    }

    #[test]
    fn who_types_nothing_is_not_waited_for_once_the_run_is_cancelled() {
        let (_person, input) = UnixStream::pair().expect("a line");
        let mut terminal = Terminal {
            input: BufReader::new(input),
            say: |_| {},
            is_stopped: || false,
            page: None,
        };
        let cancel = Cancel::new();
        let answer = std::thread::scope(|scope| {
            let asked = scope.spawn(|| terminal.ask(&Question::Light("S1".to_owned()), &cancel));
            cancel.cancel();
            asked.join().expect("no panic")
        });
        assert_eq!(answer, Answer::Stop);
    }
}
