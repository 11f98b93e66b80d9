//! Starts a child, and sends orders to it.

use std::fmt;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use taceva_core::shown;

use rustix::pipe::{PipeFlags, pipe_with};

use super::error::ChildError;
use super::exit_status::{ENDING, Fate};
use super::keeper::{Kept, keep};
use super::life::Life;
use super::log::listen;
use super::main_hook::{CHILD_ARGUMENT, can_be_child};
use super::printed_lines::PrintedLines;
use super::quarantine::{Quarantine, Quarantined};
use super::sandbox::Isolation;
use super::socket::{Caller, Socket};
use super::spec::{ChildSpec, Ended};
use super::usage::Usage;
use super::wire::{Greeting, Hello, Order, OrderAnswer};
use crate::library::{Level, Log};
use crate::manifest::Sha256Digest;
use crate::python::{arguments as python_arguments, own};
use crate::wire_version::WIRE;

/// The running executable, even if its path now names another file.
const THIS_PROGRAM: &str = "/proc/self/exe";

/// Running child. The child ends after its last device is closed and the last owner of this value is dropped.
pub struct Child {
    process: u32,
    isolation: Isolation,
    life: Arc<Life>,
    orders: Mutex<Caller>,
    log: Option<Arc<Log>>,
    keeper: Option<JoinHandle<()>>,
    listener: Option<JoinHandle<()>>,
}

impl Child {
    /// Starts a child and waits until it has confined itself and loaded its plugin.
    ///
    /// # Errors
    /// [`ChildError`] if the child does not start, or refuses to serve.
    pub fn start(spec: ChildSpec) -> Result<Arc<Child>, ChildError> {
        let ChildSpec {
            plugin,
            program,
            arguments,
            files,
            confinement,
            patience,
            ended,
            loads,
            log,
            quarantine,
        } = spec;
        refuse_quarantined(&plugin, quarantine.as_ref())?;
        let failed = |why: &dyn fmt::Display| ChildError::Start {
            plugin: plugin.clone(),
            why: why.to_string(),
        };
        // A program that runs in an interpreter starts that interpreter again.
        let within = own().filter(|_| program.is_none() && !can_be_child());
        let (program, arguments) = match within {
            Some((interpreter, child)) => (Some(interpreter.clone()), python_arguments(child)),
            None => (program, arguments),
        };
        if program.is_none() && !can_be_child() {
            let why = "the `main` of this program does not begin with `main_if_child`, and `ChildSpec::program` is not set";
            return Err(failed(&why));
        }
        let (orders, theirs) = Socket::pair().map_err(|error| failed(&error))?;
        let (printed, output) = pipe_with(PipeFlags::CLOEXEC).map_err(|error| failed(&error))?;
        let also_output = output.try_clone().map_err(|error| failed(&error))?;
        let mut command = Command::new(program.unwrap_or_else(|| PathBuf::from(THIS_PROGRAM)));
        // An interpreter finds its environment by its program name.
        if arguments.is_empty() {
            command.arg0("taceva-plugin");
        }
        command
            .args(&arguments)
            .arg(CHILD_ARGUMENT)
            .arg(&plugin)
            .env_clear()
            .current_dir("/")
            // Terminal signals such as SIGINT go to the host only.
            .process_group(0)
            .stdin(Stdio::from(theirs))
            .stdout(Stdio::from(output))
            .stderr(Stdio::from(also_output));
        let ended = when_ended(plugin.clone(), quarantine, ended);
        let log = log.map(Arc::new);
        let heard = log
            .clone()
            .map(|log| Ok((log, Socket::pair()?)))
            .transpose();
        let heard = heard.map_err(|error: rustix::io::Errno| failed(&error))?;
        let lines = log.clone().map(PrintedLines::new).transpose();
        let lines = lines.map_err(|error| failed(&error))?;
        let Kept {
            process,
            watch,
            keeper,
        } = keep(command, printed, lines, ended).map_err(|error| failed(&error))?;
        let mut child = Child {
            process,
            isolation: Isolation::default(),
            life: Arc::new(Life {
                plugin: plugin.clone(),
                watch,
                patience,
            }),
            orders: Mutex::new(Caller::from(orders)),
            log,
            keeper: Some(keeper),
            listener: None,
        };
        let hello = Hello {
            wire: WIRE,
            parent: std::process::id(),
            confinement,
            is_heard: heard.is_some(),
            loads,
        };
        let mut files = files;
        if let Some((log, (ours, theirs))) = heard {
            files.push(theirs);
            let log: Log = Box::new(move |level, target: &str, message: &str| {
                log(level, target, message);
            });
            let listener = listen(ours, log, Arc::clone(&child.life.watch));
            child.listener = Some(listener.map_err(|error| failed(&error))?);
        }
        let greeting = child.greet(&hello, &files);
        // The log listener sees the child's end only after the host closes its copies of the sockets.
        drop(files);
        child.isolation = greeting?;
        Ok(Arc::new(child))
    }

    fn greet(&self, hello: &Hello, files: &[OwnedFd]) -> Result<Isolation, ChildError> {
        let files: Vec<_> = files.iter().map(AsFd::as_fd).collect();
        let Life {
            plugin,
            watch,
            patience,
        } = &*self.life;
        let call = watch.begin("start", patience.start);
        let greeting = self.orders().ask(hello, &files);
        watch.end(call);
        match greeting.map_err(|error| self.life.lost(error))? {
            Greeting::Ready { isolation } => Ok(isolation),
            Greeting::Refused { failure } => Err(ChildError::Refused {
                plugin: plugin.clone(),
                kind: failure.kind,
                why: super::plain::plain(&failure.cause.unwrap_or(failure.doing)),
            }),
        }
    }

    /// Process number.
    pub fn process(&self) -> u32 {
        self.process
    }

    /// Isolation in force.
    pub fn isolation(&self) -> &Isolation {
        &self.isolation
    }

    /// Fate of the child; `None` while it runs.
    pub fn fate(&self) -> Option<Fate> {
        self.life.watch.fate()
    }

    /// Sends an order and waits for its answer.
    pub(crate) fn order(
        &self,
        order: &Order,
        files: &[BorrowedFd<'_>],
        doing: &str,
    ) -> Result<OrderAnswer, ChildError> {
        // Lock before the timeout starts: another order may be pending.
        let mut orders = self.orders();
        let call = self.life.watch.begin(doing, self.life.patience.open);
        let answer = orders.ask(order, files);
        self.life.watch.end(call);
        answer.map_err(|error| self.life.lost(error))
    }

    fn orders(&self) -> MutexGuard<'_, Caller> {
        self.orders.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes a line of the host to the log of the plugin.
    pub(crate) fn tell(&self, level: Level, message: &str) {
        if let Some(log) = &self.log {
            log(level, "host", message);
        }
    }

    pub(crate) fn life(&self) -> &Arc<Life> {
        &self.life
    }
}

/// Rejects a library in quarantine.
fn refuse_quarantined(
    plugin: &str,
    quarantine: Option<&(Quarantine, Sha256Digest)>,
) -> Result<(), ChildError> {
    let Some((quarantine, digest)) = quarantine else {
        return Ok(());
    };
    let plugin = plugin.to_owned();
    match quarantine.get(*digest) {
        Ok(None) => Ok(()),
        Ok(Some(entry)) => Err(ChildError::Quarantined {
            plugin,
            reason: entry.reason,
        }),
        Err(error) => Err(ChildError::Start {
            plugin,
            why: format!("{}: {error}", shown(&quarantine.folder())),
        }),
    }
}

/// Creates the callback for the end of a child: puts a crashed library into quarantine, then calls `on_end`.
fn when_ended(
    plugin: String,
    quarantine: Option<(Quarantine, Sha256Digest)>,
    on_end: Option<Ended>,
) -> impl FnOnce(&Fate, Usage) + Send + 'static {
    move |fate, usage| {
        if let Some((quarantine, digest)) = quarantine.filter(|_| fate.is_its_own_fault()) {
            let entry = Quarantined::new(digest, &plugin, &fate.to_string());
            // A failed write is ignored: it only allows another start, and the devices have already reported the cause.
            let _ = quarantine.put(&entry);
        }
        if let Some(on_end) = on_end {
            on_end(fate, usage);
        }
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        let Life {
            watch, patience, ..
        } = &*self.life;
        watch.expect_end();
        let call = watch.begin(ENDING, patience.end);
        // The child answers by ending. If the child is gone, the order fails.
        let _ = self.orders().ask::<OrderAnswer>(&Order::Shutdown {}, &[]);
        if let Some(keeper) = self.keeper.take() {
            // A panic of the keeper is ignored.
            let _ = keeper.join();
        }
        if let Some(listener) = self.listener.take() {
            // A panic is ignored. Joining ensures that the last log lines are read.
            let _ = listener.join();
        }
        watch.end(call);
    }
}

impl fmt::Debug for Child {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Child")
            .field("plugin", &self.life.plugin)
            .field("process", &self.process)
            .field("isolation", &self.isolation)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_never_asked_whether_it_is_a_child_is_not_started_as_one() {
        let error = Child::start(ChildSpec::new("org.example.x", Vec::new())).expect_err("refused");
        assert!(error.to_string().contains("main_if_child"), "{error}");
    }
}
