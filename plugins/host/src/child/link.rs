//! The connection to one device of a child.

use std::fmt;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Halt, Interrupt};

use super::exit_status::{CLOSING, Fate};
use super::life::Life;
use super::reply::Reply;
use super::socket::{Caller, LinkError, Socket, send_now};
use super::start::Child;
use super::watch::CallId;
use super::wire::{Answer, Call, Urgent};

/// The connection to one open device: its calls, and what goes round them. Dropping it closes the device.
pub(crate) struct Link {
    child: Arc<Child>,
    driver: DriverKey,
    calls: Caller,
    urgent: Arc<UrgentLink>,
}

impl Link {
    pub(crate) fn new(child: Arc<Child>, driver: DriverKey, calls: Socket, urgent: Socket) -> Link {
        let urgent = UrgentLink {
            life: Arc::clone(child.life()),
            driver: driver.clone(),
            bell: urgent.as_fd().try_clone_to_owned().ok(),
            questions: Mutex::new(Caller::from(urgent)),
            pending: Mutex::new(None),
            is_closed: AtomicBool::new(false),
        };
        Link {
            child,
            driver,
            calls: Caller::from(calls),
            urgent: Arc::new(urgent),
        }
    }

    pub(super) fn driver(&self) -> &DriverKey {
        &self.driver
    }

    pub(super) fn interrupt_handle(&self) -> Arc<dyn Interrupt> {
        Arc::clone(&self.urgent) as Arc<dyn Interrupt>
    }

    pub(super) fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::clone(&self.urgent) as Arc<dyn Halt>
    }

    /// Asks for an operation that has a deadline.
    pub(super) fn ask<R: Reply>(
        &mut self,
        call: &Call,
        doing: &'static str,
        deadline: Deadline,
    ) -> Result<R, DriverError> {
        let grace = self.child.life().patience.grace;
        let after = deadline.remaining().saturating_add(grace);
        let answer = self.call(call, &[], doing, after)?;
        self.reply(answer, doing)
    }

    /// Asks for an operation that has none, with files beside it.
    pub(super) fn ask_without_deadline<R: Reply>(
        &mut self,
        call: &Call,
        files: &[BorrowedFd<'_>],
        doing: &'static str,
    ) -> Result<R, DriverError> {
        let after = self.child.life().patience.open;
        let answer = self.call(call, files, doing, after)?;
        self.reply(answer, doing)
    }

    /// Asks the device, which may be a sensor too, to set a scene.
    pub(super) fn set_light(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError> {
        let scene = scene.to_owned();
        self.ask(&Call::Light { scene, deadline }, "set the light", deadline)
    }

    fn call(
        &mut self,
        call: &Call,
        files: &[BorrowedFd<'_>],
        doing: &'static str,
        after: Duration,
    ) -> Result<Answer, DriverError> {
        let life = Arc::clone(self.child.life());
        let id = life.watch.begin(doing, after);
        self.urgent.set_pending(Some(id));
        let answer = self.calls.ask(call, files);
        self.urgent.set_pending(None);
        life.watch.end(id);
        match answer {
            Ok(Answer::Failed { failure }) => Err(failure.to_error(&self.driver)),
            Ok(answer) => Ok(answer),
            Err(error) => Err(life.lost(error).of(&self.driver, doing)),
        }
    }

    /// What was asked for, if it is that and a reading; a child that answers something else is ended.
    fn reply<R: Reply>(&self, answer: Answer, doing: &'static str) -> Result<R, DriverError> {
        let Some(reply) = R::from_answer(answer) else {
            let error = self.child.life().broke("the answer to another question");
            return Err(error.of(&self.driver, doing));
        };
        reply.check().map_err(|why| self.fault(doing, why))?;
        Ok(reply)
    }

    /// Ends a child that broke a rule.
    pub(super) fn broke(&self, what: &str) -> DriverError {
        let error = self.child.life().broke(what);
        error.of(&self.driver, "open the device")
    }

    /// A fault of the device: it gave something that is no reading.
    pub(super) fn fault(&self, doing: &'static str, why: impl fmt::Display) -> DriverError {
        DriverError::new(ErrorKind::DeviceFault, &self.driver, doing).because(why.to_string())
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        self.urgent.is_closed.store(true, Ordering::Release);
        let after = self.child.life().patience.close;
        // A child that is gone has closed everything; one that hangs is ended, which its host tells.
        let _ = self.call(&Call::Close {}, &[], CLOSING, after);
    }
}

impl fmt::Debug for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Link")
            .field("driver", &self.driver)
            .field("child", &self.child)
            .finish_non_exhaustive()
    }
}

/// What goes round the calls of a device. It keeps no child alive.
struct UrgentLink {
    life: Arc<Life>,
    driver: DriverKey,
    /// The same socket, for what is not answered and must not wait.
    bell: Option<OwnedFd>,
    questions: Mutex<Caller>,
    pending: Mutex<Option<CallId>>,
    is_closed: AtomicBool,
}

impl UrgentLink {
    fn set_pending(&self, call: Option<CallId>) {
        *self.pending.lock().unwrap_or_else(PoisonError::into_inner) = call;
    }

    /// Gives a pending call no longer than it may take to end.
    fn hasten(&self) {
        let pending = *self.pending.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(call) = pending {
            self.life.watch.hasten(call, self.life.patience.urgent);
        }
    }
}

impl Interrupt for UrgentLink {
    fn interrupt(&self) {
        let Some(bell) = &self.bell else {
            return;
        };
        if self.is_closed.load(Ordering::Acquire) {
            return;
        }
        match send_now(bell.as_fd(), &(0_u32, Urgent::Interrupt {})) {
            Ok(()) => self.hasten(),
            // It reads nothing any more: its thread for what is urgent hangs.
            Err(LinkError::Breach(_)) => {
                let what = "interrupts are not taken any more".to_owned();
                self.life.watch.condemn(Fate::Breach { what });
            }
            Err(LinkError::Closed | LinkError::Unsendable(_)) => {}
        }
    }
}

impl Halt for UrgentLink {
    fn halt(&self) -> Result<(), DriverError> {
        if self.is_closed.load(Ordering::Acquire) {
            return Ok(());
        }
        let doing = "halt";
        let id = self.life.watch.begin(doing, self.life.patience.urgent);
        let answer = self
            .questions
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .ask(&Urgent::Halt {}, &[]);
        self.life.watch.end(id);
        match answer {
            Ok(Answer::Done {}) => {
                self.hasten();
                Ok(())
            }
            Ok(Answer::Failed { failure }) => Err(failure.to_error(&self.driver)),
            Ok(_) => {
                let error = self.life.broke("the answer to another question");
                Err(error.of(&self.driver, doing))
            }
            // Nothing is left to stop.
            Err(LinkError::Closed) if self.is_closed.load(Ordering::Acquire) => Ok(()),
            Err(error) => Err(self.life.lost(error).of(&self.driver, doing)),
        }
    }
}
