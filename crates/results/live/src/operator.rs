//! Operator who answers with the buttons of the page.

use std::time::Duration;

use taceva_protocol::{Answer, Cancel, Operator, Question};

use crate::live::Live;

/// Interval at which a waiting question checks if the run was cancelled.
const LOOK: Duration = Duration::from_millis(100);

/// Operator interface that asks questions on the page only, not at the terminal.
///
/// ```
/// use taceva_live::{Live, PageOperator};
/// use taceva_protocol::{Answer, Cancel, Operator, Question};
///
/// let mut operator = PageOperator::new(Live::new("run"));
/// let cancel = Cancel::new();
/// cancel.cancel();
/// assert_eq!(operator.ask(&Question::Light("S1".to_owned()), &cancel), Answer::Stop);
/// ```
pub struct PageOperator {
    live: Live,
}

impl PageOperator {
    /// Creates an operator who uses the page of `live`.
    pub fn new(live: Live) -> PageOperator {
        PageOperator { live }
    }
}

impl Operator for PageOperator {
    fn note(&mut self, finding: &str) {
        self.live.stage(finding);
    }

    fn ask(&mut self, question: &Question, cancel: &Cancel) -> Answer {
        let asked = self.live.ask(question);
        loop {
            if cancel.is_cancelled() || self.live.is_stopping() {
                return Answer::Stop;
            }
            if let Some(answer) = asked.answer(LOOK) {
                return answer;
            }
        }
    }
}
