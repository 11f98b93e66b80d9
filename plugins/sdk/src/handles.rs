//! Open devices, rigs and fitted models, which the host addresses by handles.
//!
//! A handle is a number and never an address. Calls reject closed and unknown handles without dereferencing them.

use std::any::Any;
use std::collections::BTreeMap;
use std::ffi::c_void;
use std::ptr::without_provenance_mut;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock, TryLockError};

use taceva_core::{ErrorKind, Halt, Interrupt};

use crate::failure::Failure;
use crate::guard::caught;

type Thing = Arc<dyn Any + Send + Sync>;

static OPEN: RwLock<BTreeMap<usize, Thing>> = RwLock::new(BTreeMap::new());
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// Stores `thing` and returns its handle, which is valid until [`close`].
pub(crate) fn keep(thing: impl Any + Send + Sync) -> *mut c_void {
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let mut open = OPEN.write().unwrap_or_else(PoisonError::into_inner);
    open.insert(number, Arc::new(thing));
    without_provenance_mut(number)
}

/// Finds the object of a handle. Fails if the handle is closed or unknown, or if the object has another type than `T`.
pub(crate) fn find<T: Any + Send + Sync>(handle: *const c_void) -> Result<Arc<T>, Failure> {
    let open = OPEN.read().unwrap_or_else(PoisonError::into_inner);
    let thing = open.get(&handle.addr()).map(Arc::clone);
    drop(open);
    thing
        .and_then(|thing| thing.downcast().ok())
        .ok_or_else(|| Failure::argument("the handle is closed or of another kind"))
}

/// Removes a handle and drops its object. If another thread still uses the object, the object is dropped when that use ends.
pub(crate) fn close(handle: *const c_void) {
    let mut open = OPEN.write().unwrap_or_else(PoisonError::into_inner);
    let thing = open.remove(&handle.addr());
    drop(open);
    // A panic of the drop is ignored: the device is gone all the same.
    drop(caught(|| drop(thing)));
}

/// Open device with the objects that interrupt and halt it. A panic of the device makes the handle unusable.
pub(crate) struct Handle<T> {
    is_dead: AtomicBool,
    device: Mutex<T>,
    /// Interrupts a call in progress without locking the device; `None` if the device has no interrupt handle.
    pub(crate) interrupt: Option<Arc<dyn Interrupt>>,
    pub(crate) halt: Option<Arc<dyn Halt>>,
}

impl<T> Handle<T> {
    pub(crate) fn new(device: T) -> Handle<T> {
        Handle {
            is_dead: AtomicBool::new(false),
            device: Mutex::new(device),
            interrupt: None,
            halt: None,
        }
    }

    /// Sets the object that interrupts calls in progress.
    pub(crate) fn interrupted_by(self, interrupt: Option<Arc<dyn Interrupt>>) -> Handle<T> {
        Handle { interrupt, ..self }
    }

    /// Sets the object that halts motions.
    pub(crate) fn halted_by(self, halt: Arc<dyn Halt>) -> Handle<T> {
        let halt = Some(halt);
        Handle { halt, ..self }
    }

    /// Runs `work` with exclusive access to the device. A panic of `work` makes only this handle unusable.
    pub(crate) fn call<R>(
        &self,
        work: impl FnOnce(&mut T) -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        if self.is_dead.load(Ordering::Acquire) {
            return Err(Failure::new(
                ErrorKind::Panicked,
                "an earlier call panicked: close the device",
            ));
        }
        let mut device = match self.device.try_lock() {
            Ok(device) => device,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => {
                return Err(Failure::new(
                    ErrorKind::Busy,
                    "another call on the device is in progress",
                ));
            }
        };
        caught(|| work(&mut device)).unwrap_or_else(|panicked| {
            self.is_dead.store(true, Ordering::Release);
            Err(panicked)
        })
    }
}
