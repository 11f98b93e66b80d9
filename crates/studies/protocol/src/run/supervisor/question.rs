//! Questions to the operator, and a force that is lost while one stands.

use super::{SharedSupervisor, Supervisor};

/// State of the question that stands, if any.
#[derive(Default)]
pub(super) struct StandingQuestion {
    stands: bool,
    /// True if the robot was halted for a lost force since the question began.
    is_halted: bool,
    is_remarked: bool,
}

impl SharedSupervisor {
    /// Result of `ask`, which puts a question to the operator. The question stands until `ask` returns.
    pub(crate) fn during_question<T>(&self, ask: impl FnOnce() -> T) -> T {
        self.lock().asks(true);
        let answer = ask();
        self.lock().asks(false);
        answer
    }
}

impl Supervisor {
    /// Marks the begin or the end of a question to the operator. The robot is halted before a question begins.
    pub fn asks(&mut self, stands: bool) {
        self.question = StandingQuestion {
            stands,
            ..StandingQuestion::default()
        };
    }

    /// True while a question to the operator stands.
    pub fn is_asking(&self) -> bool {
        self.question.stands
    }

    /// Halts because the transducer cannot be read: at each call, but once for each question. Returns true if the operator at a question does
    /// not know it yet.
    pub fn lose_force(&mut self) -> bool {
        if !(self.question.stands && self.question.is_halted) {
            // A halt that fails is repeated.
            self.question.is_halted = self.halt.halt().is_ok();
        }
        let is_news = self.question.stands && !self.question.is_remarked;
        self.question.is_remarked |= is_news;
        is_news
    }
}
