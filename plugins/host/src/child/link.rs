//! Connection to one device of a child.

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

/// Connection to one open device: its call queue and its urgent channel. Dropping the link closes the device.
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

    /// Calls an operation that has a deadline.
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

    /// Calls an operation without a deadline, passing `files`.
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

    /// Sets the lighting scene of a lighting device or of a sensor.
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

    /// Extracts and checks the expected reply. Kills a child that sends another type of answer.
    fn reply<R: Reply>(&self, answer: Answer, doing: &'static str) -> Result<R, DriverError> {
        let Some(reply) = R::from_answer(answer) else {
            let error = self.child.life().broke("an answer to another call");
            return Err(error.of(&self.driver, doing));
        };
        reply.check().map_err(|why| self.fault(doing, why))?;
        Ok(reply)
    }

    /// Kills a child that broke a rule, and returns the error.
    pub(super) fn broke(&self, what: &str) -> DriverError {
        let error = self.child.life().broke(what);
        error.of(&self.driver, "open the device")
    }

    /// Error of this device with kind [`ErrorKind::DeviceFault`] and cause `why`, for the operation `doing`.
    pub(super) fn fault(&self, doing: &'static str, why: impl fmt::Display) -> DriverError {
        DriverError::new(ErrorKind::DeviceFault, &self.driver, doing).because(why.to_string())
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        self.urgent.is_closed.store(true, Ordering::Release);
        let after = self.child.life().patience.close;
        // A dead child has closed everything. A hanging child is killed, and the host reports that.
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

/// Channel for interrupts and halts, which bypass the call queue. The channel does not keep the child running.
struct UrgentLink {
    life: Arc<Life>,
    driver: DriverKey,
    /// Duplicate of the urgent socket, for sending interrupts without waiting.
    bell: Option<OwnedFd>,
    questions: Mutex<Caller>,
    pending: Mutex<Option<CallId>>,
    is_closed: AtomicBool,
}

impl UrgentLink {
    fn set_pending(&self, call: Option<CallId>) {
        *self.pending.lock().unwrap_or_else(PoisonError::into_inner) = call;
    }

    /// Shortens the timeout of the pending call to the timeout of urgent messages.
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
            // The child's urgent thread hangs and no longer reads.
            Err(LinkError::Breach(_)) => {
                let what = "it no longer accepts interrupts".to_owned();
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
                let error = self.life.broke("an answer to another call");
                Err(error.of(&self.driver, doing))
            }
            // The device was closed meanwhile.
            Err(LinkError::Closed) if self.is_closed.load(Ordering::Acquire) => Ok(()),
            Err(error) => Err(self.life.lost(error).of(&self.driver, doing)),
        }
    }
}
