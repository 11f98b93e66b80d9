//! An open device: its handle, closed once, and what may be called on it from any thread.

#![expect(
    unsafe_code,
    reason = "a device is opened and closed through the plugin's functions"
)]

use std::ffi::c_void;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

use taceva_abi as abi;
use taceva_core::{DriverError, DriverKey, DriverKind, ErrorKind, Facts, Interrupt};

use super::bench::PluginBench;
use super::rig::RigHandle;
use crate::call::{ArgList, Failure, Table, call, pending_call, table};
use crate::library::Entry;

/// An open device, shared by its owner and by whoever may interrupt or halt it.
pub struct Handle {
    raw: *mut c_void,
    calls: abi::DeviceCalls,
    driver: DriverKey,
    /// Held for reading by whoever interrupts, for writing by whoever closes.
    is_open: RwLock<bool>,
    /// After a panic of the plugin nothing but closing is safe.
    is_dead: AtomicBool,
    /// Last: the rig, and through it the library, outlives the handle.
    _rig: Arc<RigHandle>,
}

// SAFETY: the interface allows calls from whichever thread, one at a time: the owner makes them through `&mut` of its device, and only
// `interrupt` and `halt` ([any]) go past it, kept from `close` by the lock.
unsafe impl Send for Handle {}
// SAFETY: as above.
unsafe impl Sync for Handle {}

/// A device that was opened, with the table of its kind. Dropping it closes the device.
pub struct Opened<T> {
    /// The device itself.
    pub handle: Owned,
    /// The functions of its kind.
    pub calls: T,
}

/// The one owner of a handle.
pub struct Owned(Arc<Handle>);

/// A kind of device as the tables of a library have it.
pub(crate) trait PluginDevice: Sized {
    /// Its name.
    const KIND: DriverKind;
    /// The table of an open one.
    type Calls: Table;
    /// What a library says of it.
    type Facts;

    /// What is said of this kind, if `facts` are of it.
    fn facts(facts: &Facts) -> Option<&Self::Facts>;

    /// The device that was opened, of which the library says `facts`.
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
    // SAFETY: after a success the interface promises the table of the kind that was opened, which begins with that of every device.
    let calls = unsafe { table::<DeviceTable>(device.calls.cast()) }.map_err(refused)?;
    if device.handle.is_null() {
        let why = "it was opened, yet its handle is NULL";
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
    // SAFETY: as above; from here on a failure drops `handle`, which closes the device.
    let calls = unsafe { table::<T>(device.calls.cast()) }.map_err(refused)?;
    Ok(Opened { handle, calls })
}

/// The part that the tables of all kinds begin with.
#[derive(Clone, Copy)]
#[repr(transparent)]
struct DeviceTable(abi::DeviceCalls);

// SAFETY: it is `repr(C)` inside, begins with `size: u32`, and holds numbers and optional functions alone.
unsafe impl Table for DeviceTable {
    const NAME: &'static str = "taceva_device_calls";
}

impl Handle {
    pub(crate) fn driver(&self) -> &DriverKey {
        &self.driver
    }

    /// True for a device of a simulated bench, which has a time of its own. Asked while the device is opened.
    pub(crate) fn is_simulated(&self) -> bool {
        PluginBench::of(&self._rig, "").is_some()
    }

    /// Makes a call on the device, unless the plugin has panicked in it before; a panic now is remembered.
    pub fn call(
        &self,
        doing: &'static str,
        run: impl FnOnce(*mut c_void, &mut abi::Error) -> abi::Status,
    ) -> Result<(), DriverError> {
        if self.is_dead.load(Ordering::Acquire) {
            let why = "the plugin has panicked in this device before, which is dead since then";
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

    /// Makes a call that may come from any thread; `None` once the device is closed.
    pub(crate) fn call_beside<R>(&self, run: impl FnOnce(*mut c_void) -> R) -> Option<R> {
        // A lock that cannot be had for reading is held by whoever closes: there is nothing left to reach.
        let is_open = self.is_open.try_read().ok()?;
        (*is_open && !self.is_dead.load(Ordering::Acquire)).then(|| run(self.raw))
    }

    /// Whether the device has a table under `id`.
    pub fn extension_is_there(&self, id: &str) -> bool {
        self.calls.extension.is_some_and(|extension| {
            // SAFETY: [owner & open]: only the owner asks.
            let found = unsafe { extension(self.raw, abi::Text::from(id)) };
            !found.is_null()
        })
    }

    /// The table of an ability, where the device has it.
    pub(crate) fn extension<T: Table>(
        &self,
        id: &'static str,
        doing: &'static str,
    ) -> Result<Option<T>, DriverError> {
        let Some(extension) = self.calls.extension else {
            return Ok(None);
        };
        // SAFETY: [owner & open]: only the owner asks, while it opens the device.
        let found = unsafe { extension(self.raw, abi::Text::from(id)) };
        if found.is_null() {
            return Ok(None);
        }
        // SAFETY: for this id the interface promises this table.
        let read = unsafe { table::<T>(found) };
        read.map(Some)
            .map_err(|failure| failure.of(&self.driver, doing))
    }
}

impl Owned {
    /// What may outlive the device.
    pub(crate) fn share(&self) -> Arc<Handle> {
        Arc::clone(&self.0)
    }

    /// What ends a pending call, where the device can.
    pub fn interrupt(&self) -> Option<Arc<dyn Interrupt>> {
        let interrupt = self.0.calls.interrupt?;
        Some(Arc::new(Interrupter {
            handle: self.share(),
            interrupt,
        }))
    }

    /// The failure of a check that the host makes.
    pub(crate) fn failed(
        &self,
        kind: ErrorKind,
        doing: &'static str,
        why: impl Into<String>,
    ) -> DriverError {
        Failure::new(kind, why).of(&self.0.driver, doing)
    }

    /// A function of the table `id` of an ability that the device has, as `says` puts it.
    pub(crate) fn ability<T: Table, F>(
        &self,
        id: &'static str,
        doing: &'static str,
        says: &str,
        function: impl FnOnce(T) -> Option<F>,
    ) -> Result<F, DriverError> {
        let found = self.extension::<T>(id, doing)?.and_then(function);
        found.ok_or_else(|| {
            let why = format!("{says}, yet has no `{id}`");
            self.failed(ErrorKind::Abi, doing, why)
        })
    }

    /// A function of the table that this kind of device cannot do without.
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
            // SAFETY: [owner & open], the last call: `is_open` is true once, and whoever interrupts is kept out by the lock.
            unsafe { close(self.0.raw) };
        }
        *is_open = false;
    }
}

/// Ends the pending call of a device.
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
