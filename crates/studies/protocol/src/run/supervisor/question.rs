//! Questions to the operator, and loss of the force while the operator is being asked.

use super::{SharedSupervisor, Supervisor};

/// State of the question that the operator is being asked, if any.
#[derive(Default)]
pub(super) struct StandingQuestion {
    stands: bool,
    /// True if the robot has been halted since the question began, because the force was lost.
    is_halted: bool,
    is_remarked: bool,
}

impl SharedSupervisor {
    /// Calls `ask`, which puts a question to the operator, and returns the answer. The question is open until `ask` returns.
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

    /// Halts the robot because the transducer cannot be read. During a question, only the first call halts it. Returns true if an operator is being
    /// asked and has not been informed yet.
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
