//! Questions to the operator, and loss of the force while the operator is being asked.

use super::{SharedSupervisor, Supervisor};

/// State of the question that the operator is being asked, if any.
#[derive(Default)]
pub(super) struct StandingQuestion {
    stands: bool,
    /// True if the robot has been halted for a lost force since the question began.
    is_halted: bool,
    is_remarked: bool,
}

impl SharedSupervisor {
    /// Calls `ask`, which asks the operator a question, and returns its result. The question is active until `ask` returns.
    pub(crate) fn during_question<T>(&self, ask: impl FnOnce() -> T) -> T {
        self.lock().asks(true);
        let answer = ask();
        self.lock().asks(false);
        answer
    }
}

impl Supervisor {
    /// Marks the start or the end of a question to the operator. The robot must be halted before a question starts.
    pub fn asks(&mut self, stands: bool) {
        self.question = StandingQuestion {
            stands,
            ..StandingQuestion::default()
        };
    }

    /// True while the operator is being asked a question.
    pub fn is_asking(&self) -> bool {
        self.question.stands
    }

    /// Halts because the transducer cannot be read: at every call, but only once during a question. Returns true if the operator who is being asked has not
    /// been informed yet.
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
