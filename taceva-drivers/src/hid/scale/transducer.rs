//! Force transducer that is a scale.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, ErrorKind, ForceTransducer, Interrupt, Newton, Stamp, Tare, Wrench,
};

use super::KEY;
use super::report::{self, Weight, WeightError};
use crate::hid::listener::Listener;
use crate::hid::selection::Selection;
use crate::link::Mailbox;
use crate::zero::{HostZero, READ};

/// Usage page and usage of a scale.
pub(super) const SCALE: (u16, u16) = (0x8d, 0x20);

/// An open scale.
#[derive(Debug)]
pub(super) struct Transducer {
    weights: Arc<Mailbox<Result<Weight, WeightError>>>,
    _listener: Listener,
    zero: HostZero,
    is_running: bool,
    /// Number of the last returned weight in the mailbox.
    last: u64,
    /// Step between forces that the last weight report implies, N; `None` before the first report.
    step_n: Option<f64>,
}

fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

impl Transducer {
    /// Opens the selected scale. Sends nothing to it.
    pub(super) fn open(
        selection: &Selection,
        force_max_n: Option<f64>,
    ) -> Result<Transducer, DriverError> {
        let doing = "open the scale";
        let device = selection
            .open(Some(SCALE))
            .map_err(|error| failed(error.kind(), doing, error))?;
        let weights = Arc::new(Mailbox::default());
        let listener = Listener::start(device, &weights, report::read)
            .map_err(|error| failed(ErrorKind::Internal, doing, error))?;
        Ok(Transducer {
            weights,
            _listener: listener,
            zero: HostZero::new(KEY, force_max_n),
            is_running: false,
            last: 0,
            step_n: None,
        })
    }

    /// Waits for the next weight and returns it as a force, with its arrival time.
    fn next(&mut self, patience: Duration) -> Result<(Wrench, Duration), DriverError> {
        if !self.is_running {
            return Err(failed(
                ErrorKind::InvalidArgument,
                READ,
                "the scale is not started",
            ));
        }
        let seen = self.weights.next(self.last, patience).map_err(|none| {
            none.while_waiting(&KEY, READ, || {
                format!("no weight within {patience:?}: is the scale switched on?")
            })
        })?;
        self.last = seen.number;
        let weight = seen
            .what
            .map_err(|error| failed(error.kind(), READ, error))?;
        self.step_n = Some(weight.step_newtons());
        let force = [Newton(0.0), Newton(0.0), Newton(weight.newtons())];
        let wrench = Wrench {
            force,
            ..Wrench::default()
        };
        self.zero.check(&wrench)?;
        Ok((wrench, seen.at))
    }
}

impl ForceTransducer for Transducer {
    fn axes(&self) -> Axes {
        Axes::NORMAL
    }

    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        if !self.is_running {
            self.last = self.weights.posted();
            self.is_running = true;
        }
        Ok(())
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let (wrench, at) = self.next(deadline.remaining())?;
        Ok((self.zero.taken_off(&wrench)?, Stamp::at(at)))
    }

    fn resolution(&self) -> Option<Newton> {
        self.step_n.map(Newton)
    }

    fn settings(&self) -> BTreeMap<String, String> {
        let step = self.step_n.map(|step_n| format!("{step_n:.6}"));
        let named = step.map(|step| ("step_N".to_owned(), step));
        named.into_iter().collect()
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.is_running = false;
        Ok(())
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(&self.weights) as Arc<dyn Interrupt>)
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for Transducer {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let mut zero = self.zero.clone();
        zero.take(deadline, |patience| Ok(self.next(patience)?.0))?;
        self.zero = zero;
        Ok(())
    }
}
