//! Operator and viewer of a run, at the terminal or on a page.

use std::sync::{Arc, Mutex};

use taceva_acquire::Viewer;
use taceva_live::{Live, PageOperator};
use taceva_protocol::Operator;

use super::device_page::OnPage;
use super::operator;
use crate::args::Run;
use crate::stderr;

/// Page and operator of a run, each `None` if absent.
pub(super) struct Attended {
    page: Option<OnPage>,
    operator: Option<Box<Mutex<dyn Operator + Send>>>,
    viewer: Option<Arc<dyn Viewer>>,
}

impl Attended {
    /// Opens the page of `args`. Prints the address even with `--quiet`, because users need it to open the page.
    pub(super) fn open(args: &Run, scene: &str) -> anyhow::Result<Attended> {
        let page = args
            .page
            .then(|| OnPage::open(&format!("run of {scene}"), args.port))
            .transpose()?;
        if let Some(page) = &page {
            stderr::say(format_args!("page: {}", page.url()));
        }
        let live = page.as_ref().map(OnPage::live);
        let operator: Option<Box<Mutex<dyn Operator + Send>>> =
            match (operator::terminal(live.clone()), live) {
                (Some(terminal), _) => Some(Box::new(Mutex::new(terminal))),
                (None, Some(live)) => Some(Box::new(Mutex::new(PageOperator::new(live)))),
                (None, None) => None,
            };
        let viewer = page.as_ref().map(OnPage::viewer);
        Ok(Attended {
            page,
            operator,
            viewer,
        })
    }

    /// Operator who can answer questions; `None` without terminal and page.
    pub(super) fn operator(&self) -> Option<&Mutex<dyn Operator + Send>> {
        self.operator.as_deref()
    }

    /// Viewer that shows the devices on the page; `None` without a page.
    pub(super) fn viewer(&self) -> Option<&Arc<dyn Viewer>> {
        self.viewer.as_ref()
    }

    /// Shows `words` on the page as the result of the run.
    pub(super) fn ended(&self, words: &str) {
        let live: Option<Live> = self.page.as_ref().map(OnPage::live);
        if let Some(live) = live {
            live.ended(words);
        }
    }
}
