//! Handle of an open device: closed once, with calls allowed from any thread.

#![expect(
    unsafe_code,
    reason = "a device is opened and closed through the plugin's functions"
)]

use std::ffi::c_void;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use taceva_abi as abi;
use taceva_core::{
    DriverError, DriverKey, DriverKind, ErrorKind, Facts, Hertz, Interrupt, SampleTiming,
};

use super::bench::PluginBench;
use super::rig::RigHandle;
use crate::call::{ArgList, Failure, Table, call, pending_call, table};
use crate::library::Entry;

/// Handle of an open device, shared by its owner and by interrupt and halt handles.
pub struct Handle {
    raw: *mut c_void,
    calls: abi::DeviceCalls,
    driver: DriverKey,
    /// True until the device is closed. Interrupts lock the flag for reading, the close call for writing.
    is_open: RwLock<bool>,
    /// True after a panic of the plugin. Afterwards only closing is safe.
    is_dead: AtomicBool,
    /// Dropped last, so the rig and its library outlive the handle.
    _rig: Arc<RigHandle>,
}

// SAFETY: the interface allows calls from any thread, one at a time. The owner makes them through `&mut` of its device. Only `interrupt` and `halt`
// ([any]) bypass it, and the lock keeps them from running during `close`.
unsafe impl Send for Handle {}
// SAFETY: as above.
unsafe impl Sync for Handle {}

/// An opened device with the function table of its kind. Dropping it closes the device.
pub struct Opened<T> {
    /// Owner of the device.
    pub handle: Owned,
    /// Function table for the kind of the device.
    pub calls: T,
}

/// Sole owner of a handle.
pub struct Owned(Arc<Handle>);

/// Kind of device, with its function table and facts.
pub(crate) trait PluginDevice: Sized {
    /// Kind of device.
    const KIND: DriverKind;
    /// Function table of an open device.
    type Calls: Table;
    /// Facts that a library states about a device of this kind.
    type Facts;

    /// Extracts the facts of this kind; `None` for another kind.
    fn facts(facts: &Facts) -> Option<&Self::Facts>;

    /// Creates the device from its table and `facts`. Fails if the table lacks a required function.
    fn new(opened: Opened<Self::Calls>, facts: &Self::Facts) -> Result<Self, DriverError>;
}

/// Opens the driver of `entry` in `rig`.
pub fn open<T: Table>(
    rig: &Arc<RigHandle>,
    entry: &Entry,
    list: &ArgList,
) -> Result<Opened<T>, DriverError> {
    const DOING: &str = "open the device";
    let driver = entry.provided.key();
    let refused = |failure: Failure| failure.of(driver, DOING);
    let lacks = |what: &str| {
        let why = format!("its `{what}` is NULL");
        refused(Failure::new(ErrorKind::Unsupported, why))
    };
    let open = entry.factory.and_then(|factory| factory.open);
    let open = open.ok_or_else(|| lacks("open"))?;
    let mut device = abi::Device {
        handle: std::ptr::null_mut(),
        calls: std::ptr::null(),
    };
    let args = list.args();
    let _under_way = pending_call::begin(DOING);
    // SAFETY: [any], with arguments, a rig of the same plugin, a place for the device and an error that outlive the call.
    call(|error| unsafe {
        open(
            entry.number,
            &raw const args,
            rig.raw(),
            &raw mut device,
            error,
        )
    })
    .map_err(refused)?;
    // SAFETY: after a success, the interface specifies the table of the opened kind, which begins with the table of every device.
    let calls = unsafe { table::<DeviceTable>(device.calls.cast()) }.map_err(refused)?;
    if device.handle.is_null() {
        let why = "it was opened, but its handle is NULL";
        return Err(refused(Failure::new(ErrorKind::Abi, why)));
    }
    let calls = calls.0;
    if calls.close.is_none() {
        return Err(lacks("close"));
    }
    let handle = Owned(Arc::new(Handle {
        raw: device.handle,
        calls,
        driver: driver.clone(),
        is_open: RwLock::new(true),
        is_dead: AtomicBool::new(false),
        _rig: Arc::clone(rig),
    }));
    // SAFETY: as above. From here on, a failure drops `handle`, which closes the device.
    let calls = unsafe { table::<T>(device.calls.cast()) }.map_err(refused)?;
    Ok(Opened { handle, calls })
}

/// Common first part of the tables of all kinds.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct DeviceTable(abi::DeviceCalls);

// SAFETY: it is `repr(C)` inside, begins with `size: u32`, and holds only numbers and optional functions.
unsafe impl Table for DeviceTable {
    const NAME: &'static str = "taceva_device_calls";
}

impl Handle {
    /// Minor version of the interface that the library was built for.
    pub(crate) fn minor(&self) -> u32 {
        self._rig.minor()
    }

    pub(crate) fn driver(&self) -> &DriverKey {
        &self.driver
    }

    /// Check of sample times against a declared `rate`. Disabled on a simulated bench, which has its own clock. Called while the device is opened.
    pub(crate) fn timing(&self, rate: Option<Hertz>) -> SampleTiming {
        match PluginBench::of(&self._rig, "") {
            Some(_) => SampleTiming::unchecked(),
            None => SampleTiming::of(rate),
        }
    }

    /// Calls the device. Fails without a call if the plugin panicked in an earlier call of this device. Records a panic of this call.
    pub fn call(
        &self,
        doing: &'static str,
        run: impl FnOnce(*mut c_void, &mut abi::Error) -> abi::Status,
    ) -> Result<(), DriverError> {
        if self.is_dead.load(Ordering::Acquire) {
            let why =
                "the plugin panicked in this device before, so the device is no longer called";
            return Err(Failure::new(ErrorKind::Panicked, why).of(&self.driver, doing));
        }
        let _under_way = pending_call::begin(doing);
        call(|error| run(self.raw, error)).map_err(|failure| {
            if failure.kind() == ErrorKind::Panicked {
                self.is_dead.store(true, Ordering::Release);
            }
            failure.of(&self.driver, doing)
        })
    }

    /// Calls a function from any thread; `None` if the device is closed or has panicked.
    pub(crate) fn call_beside<R>(&self, run: impl FnOnce(*mut c_void) -> R) -> Option<R> {
        // If the lock is not available for reading, the device is being closed.
        let is_open = self.is_open.try_read().ok()?;
        (*is_open && !self.is_dead.load(Ordering::Acquire)).then(|| run(self.raw))
    }

    /// True if the device has an extension table `id`.
    pub fn extension_is_there(&self, id: &str) -> bool {
        self.calls.extension.is_some_and(|extension| {
            // SAFETY: [owner & open]: only the owner calls this.
            let found = unsafe { extension(self.raw, abi::Text::from(id)) };
            !found.is_null()
        })
    }

    /// Extension table `id`; `None` if the device lacks it.
    pub(crate) fn extension<T: Table>(
        &self,
        id: &'static str,
        doing: &'static str,
    ) -> Result<Option<T>, DriverError> {
        let Some(extension) = self.calls.extension else {
            return Ok(None);
        };
        // SAFETY: [owner & open]: only the owner calls this, while it opens the device.
        let found = unsafe { extension(self.raw, abi::Text::from(id)) };
        if found.is_null() {
            return Ok(None);
        }
        // SAFETY: the interface specifies this table for this id.
        let read = unsafe { table::<T>(found) };
        read.map(Some)
            .map_err(|failure| failure.of(&self.driver, doing))
    }
}

impl Owned {
    /// Shares the handle, which may outlive the device.
    pub(crate) fn share(&self) -> Arc<Handle> {
        Arc::clone(&self.0)
    }

    /// Handle that interrupts a pending call; `None` if the device has no `interrupt`.
    pub fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        let interrupt = self.0.calls.interrupt?;
        Some(Arc::new(Interrupter {
            handle: self.share(),
            interrupt,
        }))
    }

    /// Creates the error of the operation `doing` with the cause `why`, which the host detected.
    pub(crate) fn failed(
        &self,
        kind: ErrorKind,
        doing: &'static str,
        why: impl Into<String>,
    ) -> DriverError {
        Failure::new(kind, why).of(&self.0.driver, doing)
    }

    /// Function of the extension table `id`. If the device lacks it, the error quotes the declaration `says`, which promises the function.
    pub(crate) fn ability<T: Table, F>(
        &self,
        id: &'static str,
        doing: &'static str,
        says: &str,
        function: impl FnOnce(T) -> Option<F>,
    ) -> Result<F, DriverError> {
        let found = self.extension::<T>(id, doing)?.and_then(function);
        found.ok_or_else(|| {
            let why = format!("{says}, but has no `{id}`");
            self.failed(ErrorKind::Abi, doing, why)
        })
    }

    /// Unwraps a required function of the table. `name` appears in the error.
    pub fn needs<F>(&self, function: Option<F>, name: &'static str) -> Result<F, DriverError> {
        function.ok_or_else(|| {
            let why = format!("its `{name}` is NULL");
            self.failed(ErrorKind::Unsupported, "open the device", why)
        })
    }
}

impl std::ops::Deref for Owned {
    type Target = Handle;

    fn deref(&self) -> &Handle {
        &self.0
    }
}

impl Drop for Owned {
    fn drop(&mut self) {
        let mut is_open = (self.0.is_open)
            .write()
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(close) = self.0.calls.close.filter(|_| *is_open) {
            let _under_way = pending_call::begin("close the device");
            // SAFETY: [owner & open], the last call: `is_open` is true only once, and the lock excludes interrupts.
            unsafe { close(self.0.raw) };
        }
        *is_open = false;
    }
}

/// Handle that interrupts the pending call of a device.
struct Interrupter {
    handle: Arc<Handle>,
    interrupt: unsafe extern "C" fn(*mut c_void),
}

impl Interrupt for Interrupter {
    fn interrupt(&self) {
        self.handle.call_beside(|raw| {
            // SAFETY: [any & open]: `call_beside` keeps the device open meanwhile.
            unsafe { (self.interrupt)(raw) };
        });
    }
}
